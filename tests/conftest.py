"""What all tests share: the same random examples in every run, or with CQLTL_FUZZ=1 (`make fuzz`) fresh ones."""

from __future__ import annotations

import os

from hypothesis import settings

settings.register_profile("fixed", derandomize=True, deadline=None)  # machines are noisy
settings.register_profile("fresh", print_blob=True, deadline=None)
settings.load_profile("fresh" if os.environ.get("CQLTL_FUZZ") else "fixed")

"""What all tests share: the same random examples in every run, or with CQLTL_FUZZ=1 (`make fuzz`) fresh ones; and which
tests run one after the other where `make test` runs two at a time.
"""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

import pytest
from hypothesis import settings
from xdist.scheduler import LoadScopeScheduling

settings.register_profile("fixed", derandomize=True, deadline=None)  # machines are noisy
settings.register_profile("fresh", print_blob=True, deadline=None)
settings.load_profile("fresh" if os.environ.get("CQLTL_FUZZ") else "fixed")


class _Together(LoadScopeScheduling):
    """The tests of a file stay together, and so do those of the service, which share a server in this order."""

    def _split_scope(self, nodeid: str) -> str:
        file = nodeid.partition("::")[0]
        parts = Path(file).parts[1:]
        shared = parts[0] == "service" and parts[1] not in ("jobs", "store", "worker")
        return "service" if shared else file


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_make_scheduler(config: pytest.Config, log: Any) -> LoadScopeScheduling:
    """Groups by `xdist_group`, which would be the usual way, are lost on pytest 9.2."""
    return _Together(config, log)

"""What all tests share: the same random examples in every run, or with CQLTL_FUZZ=1 (`make fuzz`) fresh ones; and which
tests run one after the other where `make test` runs two at a time.
"""

from __future__ import annotations

import os
from pathlib import Path

import pytest
from hypothesis import settings

TESTS = Path(__file__).parent

settings.register_profile("fixed", derandomize=True, deadline=None)  # machines are noisy
settings.register_profile("fresh", print_blob=True, deadline=None)
settings.load_profile("fresh" if os.environ.get("CQLTL_FUZZ") else "fixed")


@pytest.hookimpl(tryfirst=True)  # before xdist reads the groups
def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """The tests of a file stay together, and so do those of the service, which share a server in this order."""
    for item in items:
        place = item.path.relative_to(TESTS)
        shared = place.parts[0] == "service" and place.parts[1] not in ("jobs", "store", "worker")
        item.add_marker(pytest.mark.xdist_group("service" if shared else str(place)))

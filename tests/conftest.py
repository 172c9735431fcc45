"""What all tests share: the same random examples in every run, or with CQLTL_FUZZ=1 (`make fuzz`) fresh ones; and which
tests run one after the other where `make test` runs two at a time.
"""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

os.environ.setdefault("OMP_NUM_THREADS", "1")  # before torch is loaded: threads that wait for each other slow both down

import pytest
from hypothesis import settings
from xdist.scheduler import LoadScopeScheduling

ROOT = Path(__file__).parents[1]
LONG = ("service", "tests/service/jobs", "tests/benchmarks/test_reliability")
"""Beginnings of the scopes that take minutes."""

settings.register_profile("fixed", derandomize=True, deadline=None, max_examples=50)  # machines are noisy
settings.register_profile("fresh", print_blob=True, deadline=None)
settings.load_profile("fresh" if os.environ.get("CQLTL_FUZZ") else "fixed")


def _scope(path: str) -> str:
    """The tests of a file stay together, and so do those of the service, which share a server in this order: those of
    its HTTP contract one, the others another.
    """
    _, *parts = Path(path).parts
    if parts[0] == "service" and parts[1] not in ("jobs", "store", "worker"):
        return "service/http" if parts[1] == "http" else "service"
    return path


class _Together(LoadScopeScheduling):
    def _split_scope(self, nodeid: str) -> str:
        return _scope(nodeid.partition("::")[0])


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """What stays together longest comes first, so that both processes end at the same time."""
    items.sort(key=lambda item: not _scope(str(item.path.relative_to(ROOT))).startswith(LONG))


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_make_scheduler(config: pytest.Config, log: Any) -> LoadScopeScheduling:
    """Groups by `xdist_group`, which would be the usual way, are lost on pytest 9.2."""
    return _Together(config, log)

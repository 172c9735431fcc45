"""Both executors, each as it is deployed."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from tests.service.jobs.deployments import Deployment, Embedded, Queued
from tests.service.postgres import Postgres

Deploy = Callable[..., Deployment]

KINDS = ("sqlite", "postgresql")
ON_BOTH = [KINDS[0], pytest.param(KINDS[1], marks=pytest.mark.long)]
"""What takes minutes runs on one of them, and on both with `make promises`."""


def _make(request: pytest.FixtureRequest, folder: Path, **environment: str) -> Deployment:
    if request.param == "sqlite":
        return Embedded(folder, **environment)
    server: Postgres = request.getfixturevalue("postgres")
    return Queued(folder, CQLTL_DATABASE_URL=server.database(), **environment)


@pytest.fixture(scope="module", params=KINDS)
def shared(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Deployment]:
    """A deployment that the tests of a module share, so none may break it."""
    found = _make(request, tmp_path_factory.mktemp("shared"))
    yield found
    found.close()


@pytest.fixture(scope="module", params=ON_BOTH)
def sturdy(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Deployment]:
    """A deployment that the tests of a module share, and whose worker processes they kill."""
    found = _make(request, tmp_path_factory.mktemp("sturdy"))
    yield found
    found.close()


@pytest.fixture(params=ON_BOTH)
def deploy(request: pytest.FixtureRequest, tmp_path: Path) -> Iterator[Deploy]:
    """Makes deployments of a test's own, with settings of its own."""
    found: list[Deployment] = []

    def make(**environment: str) -> Deployment:
        found.append(_make(request, tmp_path, **environment))
        return found[-1]

    yield make
    for deployment in found:
        deployment.close()

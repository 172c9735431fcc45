"""Both executors, each as it is deployed."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from tests.service.jobs.deployments import Deployment, Embedded

Deploy = Callable[..., Deployment]

KINDS: dict[str, Callable[..., Deployment]] = {"sqlite": Embedded}


@pytest.fixture(scope="module", params=KINDS)
def shared(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Deployment]:
    """A deployment that the tests of a module share, so none may break it."""
    found = KINDS[request.param](tmp_path_factory.mktemp("shared"))
    yield found
    found.close()


@pytest.fixture(params=KINDS)
def deploy(request: pytest.FixtureRequest, tmp_path: Path) -> Iterator[Deploy]:
    """Makes deployments of a test's own, with settings of its own."""
    found: list[Deployment] = []

    def make(**environment: str) -> Deployment:
        found.append(KINDS[request.param](tmp_path, **environment))
        return found[-1]

    yield make
    for deployment in found:
        deployment.close()

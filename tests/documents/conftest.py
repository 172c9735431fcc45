"""A copy of the repository for tests that set something up."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.documents.machine import copied


@pytest.fixture(scope="module")
def copy() -> Iterator[Path]:
    """One for all tests of a file: setting up takes minutes."""
    with copied() as folder:
        yield folder

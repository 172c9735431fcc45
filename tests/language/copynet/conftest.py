"""A small pair of networks, trained in a few seconds, that answers most of what it was trained on."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
import torch

from models.language.copynet import Models, Settings, train
from models.language.dataset import Split, split

SMALL = Settings(epochs=24, batch=24, learning_rate=1e-2, embedding=24, encoder=24, decoder=32, dropout=0.0)


@pytest.fixture(scope="session", autouse=True)
def _one_thread() -> Iterator[None]:
    threads = torch.get_num_threads()
    torch.set_num_threads(1)
    yield
    torch.set_num_threads(threads)


@pytest.fixture(scope="session")
def small_data() -> Split:
    """An eighth of T of the navigation domain."""
    part = split("navigation")
    return Split(part.training[::8], part.validation[::8])


@pytest.fixture(scope="session")
def small(small_data: Split) -> Models:
    return train("navigation", SMALL, seed=0, data=small_data)

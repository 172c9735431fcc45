"""What the encoder is asked, and that it makes no difference."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pytest

from models.language.encoder import RememberingReader, encoder
from models.language.runtime import Floats


class _Counting:
    """An encoder that tells what it read."""

    def __init__(self) -> None:
        self.batches: list[list[tuple[str, ...]]] = []
        self.size = encoder().size

    def read(self, texts: Sequence[Sequence[str]]) -> Floats:
        self.batches.append([tuple(text) for text in texts])
        return encoder().read(texts)


ONE, OTHER, LONG = ("lift", "it"), ("go",), ("put", "the", "zorbel", "in", "the", "box")


BATCHES = ([ONE, OTHER, ONE], [OTHER, LONG], [LONG, ONE])


@pytest.mark.parametrize(
    ("together", "read"), [(False, [[ONE], [OTHER], [LONG]]), (True, [[ONE, OTHER], [LONG]])], ids=["alone", "together"]
)
def test_a_text_is_read_once(together: bool, read: list[list[tuple[str, ...]]]) -> None:
    counting = _Counting()
    remembering = RememberingReader(counting, together)
    for batch in BATCHES:
        remembering.read(batch)
    assert counting.batches == read
    assert remembering.size == counting.size


@pytest.mark.parametrize("together", [False, True], ids=["alone", "together"])
def test_vectors_are_those_of_the_encoder(together: bool) -> None:
    remembering = RememberingReader(encoder(), together)
    for batch in BATCHES:
        found, expected = remembering.read(batch), encoder().read(batch)
        assert found.shape == expected.shape
        np.testing.assert_allclose(found, expected, rtol=1e-4, atol=1e-5)

"""Networks that read together: the means of what each says, whatever classes each leaves out."""

from __future__ import annotations

import pytest

from models.language import SpanTranslator
from models.language.spans.ensemble import SpanEnsemble
from models.language.spans.reader import Read, SpanReader, SpanReading
from models.language.tokens import words


class Said:
    """A reader that says what it was given."""

    def __init__(self, like: SpanReader, *readings: tuple[str, int, float], none: float) -> None:
        self.model = like.model
        self._read: Read = (
            tuple(SpanReading(task, (((place, place + 1),),), share, frozenset()) for task, place, share in readings),
            none,
        )

    def read(self, spoken: object) -> Read:
        """See `SpanReader`."""
        return self._read


@pytest.fixture(scope="module")
def shipped() -> SpanReader:
    return SpanTranslator.load().reader


def test_probabilities_are_means(shipped: SpanReader) -> None:
    tasks = [task for task, _ in shipped.model.config.tasks]
    one = Said(shipped, (tasks[2], 0, 0.5), (tasks[2], 1, 0.25), none=0.25)
    other = Said(shipped, (tasks[0], 1, 0.25), (tasks[2], 1, 0.5), none=0.125)
    readings, none = SpanEnsemble([one, other]).read(("go",))  # type: ignore[list-item]
    said = [(reading.task, reading.mentions[0][0][0], reading.probability) for reading in readings]
    assert said == [(tasks[0], 1, 0.125), (tasks[2], 1, 0.375), (tasks[2], 0, 0.25)]
    assert none == 0.1875


def test_a_reader_twice_reads_as_once(shipped: SpanReader) -> None:
    text = words("please put the blue mug into the drawer")
    once, none = SpanEnsemble([shipped]).read(text)
    assert once == shipped.read(text)[0]
    assert (once, none) == SpanEnsemble([shipped, shipped]).read(text)


def test_an_ensemble_is_not_empty() -> None:
    with pytest.raises(ValueError, match="has a reader"):
        SpanEnsemble([])

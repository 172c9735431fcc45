"""Word numbers and the extended vocabulary."""

from __future__ import annotations

import pytest

from models.language.copynet.vocabulary import END, PAD, START, UNKNOWN, Vocabulary


@pytest.fixture
def vocabulary() -> Vocabulary:
    return Vocabulary.build([["take", "the", "ball"]], [["pickup", "(", "ball", ")", END], ["again", END]])


def test_outputs_come_first(vocabulary: Vocabulary) -> None:
    assert vocabulary.words == (END, "(", ")", "again", "ball", "pickup", PAD, START, UNKNOWN, "take", "the")
    assert vocabulary.outputs == 6
    assert [vocabulary.end, vocabulary.pad, vocabulary.start, vocabulary.unknown] == [0, 6, 7, 8]
    assert "ball" in vocabulary
    assert "zorb" not in vocabulary
    assert vocabulary.number("zorb") == vocabulary.unknown


def test_copied_words_are_no_outputs() -> None:
    vocabulary = Vocabulary.build([["take", "ball"]], [["pickup", "ball", END]], copied={"ball", "take"})
    assert vocabulary.words == (END, "pickup", PAD, START, UNKNOWN, "ball", "take")
    assert vocabulary.outputs == 2
    source = vocabulary.source(["take", "ball"])
    assert vocabulary.target(["pickup", "ball", END], source) == (1, 5, 0)


def test_unknown_words_get_numbers_of_their_own(vocabulary: Vocabulary) -> None:
    source = vocabulary.source(["take", "zorb", "the", "blarg", "zorb"])
    assert source.unknown == ("zorb", "blarg")
    assert source.extended == (9, 11, 10, 12, 11)
    assert source.ids == (9, 8, 10, 8, 8)
    target = vocabulary.target(["pickup", "(", "blarg", "zorb", ")", END], source)
    assert target == (5, 1, 12, 11, 2, 0)
    assert vocabulary.spell(target, source.unknown) == ("pickup", "(", "blarg", "zorb", ")", END)


def test_hidden_words_are_unknown_in_text_and_answer(vocabulary: Vocabulary) -> None:
    source = vocabulary.source(["take", "the", "ball"], hidden={"ball"})
    assert source.extended == (9, 10, 11)
    assert vocabulary.target(["ball"], source) == (11,)


def test_what_cannot_be_said(vocabulary: Vocabulary) -> None:
    source = vocabulary.source(["take", "zorb"])
    assert vocabulary.target(["take"], source) == (9,)  # cannot be generated, can be copied
    for word in ("the", "other"):
        with pytest.raises(ValueError, match="neither generated nor copied"):
            vocabulary.target([word], source)


@pytest.mark.parametrize(
    ("words", "outputs"),
    [((END, PAD, START, UNKNOWN), 2), ((END, PAD, START, UNKNOWN, "a", "a"), 1), ((END,), 1)],
)
def test_refused(words: tuple[str, ...], outputs: int) -> None:
    with pytest.raises(ValueError, match="every word once"):
        Vocabulary(words, outputs)

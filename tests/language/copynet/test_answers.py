"""Answers to many texts at once, from a pair trained on a few commands."""

from __future__ import annotations

import pytest

from models.language import TextTooLongError
from models.language.copynet import Models, answers, formulas, outputs, pos_answers
from models.language.copynet.queries import read_query
from models.language.copynet.vocabulary import END
from models.language.dataset import Split
from models.logic import parse
from models.queries import ContextualQuery

NOTHING = ["", "  ?!", "\x00"]


def test_most_of_training_is_answered(small: Models, small_data: Split) -> None:
    texts = [example.text for example in small_data.training]
    queries = [query == e.query for query, e in zip(answers(small.cq, texts), small_data.training, strict=True)]
    read = [formula == parse(e.ltl) for formula, e in zip(formulas(small.ltl, texts), small_data.training, strict=True)]
    assert sum(queries) >= 0.9 * len(texts)
    assert sum(read) >= 0.9 * len(texts)


def test_answers_stand_in_the_order_of_the_texts(small: Models, small_data: Split) -> None:
    texts = [example.text for example in small_data.validation]
    mixed = [text for pair in zip(texts, NOTHING * len(texts), strict=False) for text in pair]
    for ask in (answers, pos_answers):
        together = ask(small.cq, mixed)
        assert together[::2] == [ask(small.cq, [text])[0] for text in texts]
        assert together[1::2] == [None] * len(texts)
    assert formulas(small.ltl, mixed)[::2] == [formulas(small.ltl, [text])[0] for text in texts]
    assert outputs(small.cq, NOTHING) == [()] * 3
    assert answers(small.cq, []) == []


def test_part_of_speech_answers(small: Models) -> None:
    text = "Go to the bakery, then go to the pier"
    (spelled,) = outputs(small.cq, [text])
    (query,) = pos_answers(small.cq, [text])
    assert query == ContextualQuery(spelled[0], ("bakery", "pier"))
    (nothing,) = pos_answers(small.cq, ["go there now"])
    assert nothing is not None
    assert nothing.arguments == ()


def test_an_output_without_an_end_is_malformed(small: Models) -> None:
    (short,) = outputs(small.cq, ["Go to the bank"], steps=3)
    assert len(short) == 3
    assert END not in short
    assert read_query(short) is None


def test_too_long(small: Models) -> None:
    for ask in (answers, pos_answers):
        with pytest.raises(TextTooLongError):
            ask(small.cq, ["Go to the bank", "go " * 1_000])

"""The output language: what is well-formed."""

from __future__ import annotations

import pytest

from models.language.output import is_spoken, read, spell
from models.language.vocabulary import END, NO_TASK
from models.queries import ContextualQuery

ARITIES = {"ship": 3, "pickup": 1}


def test_spelled_and_read_back() -> None:
    query = ContextualQuery("ship", ("teddy bear", "box", "living room"))
    spelled = spell(query)
    assert spelled == ("ship", "(", "teddy", "bear", ",", "box", ",", "living", "room", ")", END)
    assert read(spelled, ARITIES) == query
    assert spell(None) == (NO_TASK, END)
    assert read(spell(None), ARITIES) is None


@pytest.mark.parametrize(
    "text",
    [
        "pickup ( ball )",  # no end
        "pickup ( ) END",
        "pickup ( ball , cube ) END",  # too many arguments
        "ship ( ball , box ) END",  # too few
        "ship ( ball , , box ) END",
        "pickup ball ) END",
        "pickup ( ball END",
        "pickup ( ( ball ) END",
        "pickup ( ball ) ) END",
        "pickup ( ball END ) END",
        "wave ( ball ) END",
        "( ball ) END",
        "END",
        "",
    ],
)
def test_malformed(text: str) -> None:
    assert read([END if word == "END" else word for word in text.split()], ARITIES) is None


def test_longer_than_a_query_may_be() -> None:
    long = "z" * 1_500
    assert read(["ship", "(", long, ",", long, ",", long, ")", END], ARITIES) is None


def test_arguments_are_phrases_of_the_text() -> None:
    text = ["put", "the", "teddy", "bear", "in", "the", "box"]
    assert is_spoken(ContextualQuery("t", ("teddy bear", "box")), text)
    assert not is_spoken(ContextualQuery("t", ("teddy box",)), text)
    assert not is_spoken(ContextualQuery("t", ("bear teddy",)), text)
    assert not is_spoken(ContextualQuery("t", ("ball",)), text)

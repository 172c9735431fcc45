"""The output language of contextual queries: what is well-formed."""

from __future__ import annotations

import pytest

from models.language.copynet.queries import is_spoken, query_or_none, read_query, spell_query
from models.language.copynet.vocabulary import END
from models.language.dataset import Domain, generate
from models.queries import ContextualQuery


def _words(text: str) -> list[str]:
    return [END if word == "END" else word for word in text.split()]


def test_spelled_and_read_back() -> None:
    query = ContextualQuery("ship", ("teddy bear", "box", "living room"))
    spelled = spell_query(query)
    assert spelled == ("ship", "(", "teddy", "bear", ",", "box", ",", "living", "room", ")", END)
    assert read_query(spelled) == query


@pytest.mark.parametrize("domain", list(Domain))
def test_every_query_of_the_datasets(domain: Domain) -> None:
    data = generate(domain)
    for query in {example.query for example in (*data.seen, *data.unseen)}:
        assert read_query(spell_query(query)) == query


def test_wrong_answers_are_read_too() -> None:
    assert read_query(_words("ship ( ball , box ) END")) == ContextualQuery("ship", ("ball", "box"))
    assert read_query(_words("wave ( ball ) END")) == ContextualQuery("wave", ("ball",))


@pytest.mark.parametrize(
    "text",
    [
        "pickup ( ball )",  # no end
        "pickup ( ) END",
        "ship ( ball , , box ) END",
        "ship ( ball , ) END",
        "pickup ball ) END",
        "pickup ( ball END",
        "pickup ( ( ball ) END",
        "pickup ( ball ) ) END",
        "pickup ( ball END ) END",
        "o'hare ( ball ) END",  # a word of the text in the place of the task
        "( ( ball ) END",
        "( ball ) END",
        "END",
        "",
    ],
)
def test_malformed(text: str) -> None:
    assert read_query(_words(text)) is None


def test_longer_than_a_query_may_be() -> None:
    long = "z" * 1_500
    assert read_query(["ship", "(", long, ",", long, ",", long, ")", END]) is None
    assert query_or_none("pickup", ["ball"] * 17) is None


def test_arguments_are_phrases_of_the_text() -> None:
    text = ["put", "the", "teddy", "bear", "in", "the", "box"]
    assert is_spoken(ContextualQuery("t", ("teddy bear", "box")), text)
    assert not is_spoken(ContextualQuery("t", ("teddy box",)), text)
    assert not is_spoken(ContextualQuery("t", ("bear teddy",)), text)
    assert not is_spoken(ContextualQuery("t", ("ball",)), text)

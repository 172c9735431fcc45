"""Any wording filled with any phrases: text, query, formula, grounding, and where each argument is mentioned."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from models.language import VocabularyError
from models.language.dataset import Domain, Example, Word, fill, generate
from models.language.tokens import words
from models.queries import ContextualQuery


def test_an_example_by_hand() -> None:
    example = fill(
        "manipulation",
        "ship",
        "Load up the {container} with the {object}, then take the {container} to: the {location}!",
        {"object": "teddy bear", "container": "tea chest", "location": "rock garden"},
    )
    assert example == Example(
        domain=Domain.MANIPULATION,
        text="Load up the tea chest with the teddy bear, then take the tea chest to: the rock garden!",
        query=ContextualQuery("ship", ("teddy bear", "tea chest", "rock garden")),
        ltl="F (in(teddy_bear, tea_chest) & F (in(teddy_bear, tea_chest) & at(tea_chest, rock_garden)))",
        grounding=("teddy_bear", "tea_chest", "rock_garden"),
        mentions=(((7, 9),), ((3, 5), (12, 14)), ((16, 18),)),
    )
    assert example.task == "ship"


def test_homonyms_are_told_apart() -> None:
    """The colour is mentioned before the fruit, and either is mentioned once."""
    chosen = {"object": Word("orange", "orange_fruit"), "color": "orange"}
    example = fill("manipulation", "pickup_colored", "Take the {color} {object}", chosen)
    assert example.mentions == (((3, 4),), ((2, 3),))
    assert example.grounding == ("orange_fruit", "orange")
    assert not example.distinct


@pytest.mark.parametrize("domain", list(Domain))
def test_the_mentions_of_s_and_u_are_their_arguments(domain: Domain) -> None:
    for example in (*generate(domain).seen, *generate(domain).unseen):
        spoken = words(example.text)
        said = [[" ".join(spoken[start:end]) for start, end in spans] for spans in example.mentions]
        assert [set(phrases) for phrases in said] == [{phrase} for phrase in example.query.arguments]
        places = [place for spans in example.mentions for start, end in spans for place in range(start, end)]
        assert len(places) == len(set(places))


_name = st.lists(st.from_regex(r"[a-z]+(-[a-z]+)?", fullmatch=True), min_size=1, max_size=4).map(" ".join)


@given(
    st.lists(
        st.sampled_from(["the ", "{first}", "{first}.", ", ", " then ", "{second}", "{second}?", "go - "]), max_size=12
    ),
    _name,
    _name,
)
def test_mentions_of_any_wording(pieces: list[str], first: str, second: str) -> None:
    wording = " ".join([*pieces, "{first}", "{second}"])
    example = fill("navigation", "navigate_two", wording, {"first": first, "second": second})
    assert example.text == wording.replace("{first}", first).replace("{second}", second)
    spoken = words(example.text)
    for phrase, slot, spans in zip((first, second), ("{first}", "{second}"), example.mentions, strict=True):
        assert len(spans) == wording.count(slot)
        assert all(" ".join(spoken[start:end]) == phrase for start, end in spans)


@pytest.mark.parametrize(
    ("wording", "phrases"),
    [
        ("Go to the place", {"first": "bakery"}),
        ("Go to the {first} and {second}", {"first": "bakery"}),
        ("Go to the {first}", {}),
        ("Go to the {first}", {"first": "bakery", "second": "bank"}),
        ("Go to the {first", {"first": "bakery"}),
        ("Go to the {first}s", {"first": "bakery"}),
        ("Go to the ex-{first}", {"first": "bakery"}),
        ("Go to the {first}{first}", {"first": "bakery"}),
        ("Go to the {first}.net", {"first": "bakery"}),
        ("Go to the {first}", {"first": "Bakery"}),
        ("Go to the {first}", {"first": "bakery!"}),
        ("Go to the {first}", {"first": " "}),
    ],
)
def test_refused(wording: str, phrases: dict[str, str]) -> None:
    with pytest.raises(VocabularyError) as caught:
        fill("navigation", "navigate_one", wording, phrases)
    assert caught.value.slug == "invalid-vocabulary"


def test_no_such_task() -> None:
    with pytest.raises(KeyError):
        fill("navigation", "ship", "Go to the {first}", {"first": "bakery"})

"""Two clauses of an arrangement as one."""

from __future__ import annotations

import pytest

from models.language.composition.arrangement import Arrangement, arranged_as, unended, words_of
from models.language.composition.clauses import Clause
from models.language.spans.tags import Span

TEXT = ["load", "it", ",", "carry", "it", ";", "then", "rest", ",", "no", "noise"]
SPANS = {1: (0, 2), 2: (3, 5), 3: (7, 8), 4: (9, 11)}


def arranged(shape: str, *numbers: int, forbidden: tuple[int, ...] = ()) -> Arrangement:
    """With the spans of the text for clauses of these numbers, in the order given."""
    spans = [SPANS[place] for place in range(1, len(numbers) + 1)]
    clauses = [
        Clause(number, tuple(word for word in TEXT[slice(*span)] if word.isalnum()), number in forbidden)
        for number, span in zip(numbers, spans, strict=True)
    ]
    return Arrangement(shape, tuple(clauses), tuple(spans), (), 0.5)


def joined(arrangement: Arrangement) -> list[tuple[str, list[str]]]:
    return [(found.shape, [" ".join(c.words) for c in found.clauses]) for found in arrangement.joined(TEXT)]


def test_neighbours_in_a_sequence() -> None:
    assert joined(arranged("then(1, 2, 3)", 1, 2, 3)) == [
        ("then(1, 2)", ["load it carry it", "rest"]),
        ("then(1, 2)", ["load it", "carry it then rest"]),
    ]


def test_a_part_with_nothing_else_becomes_the_clause() -> None:
    assert joined(arranged("and(then(1, 2), avoid(3))", 1, 2, 3, forbidden=(3,))) == [
        ("and(1, avoid(2))", ["load it carry it", "rest"])
    ]


def test_clauses_keep_their_order_in_the_text_and_are_marked() -> None:
    (found,) = arranged("and(avoid(1), then(2, 3))", 1, 2, 3, forbidden=(1,)).joined(TEXT)
    assert [(clause.number, clause.forbidden, clause.several) for clause in found.clauses] == [
        (1, True, False),
        (2, False, True),
    ]
    assert found.spans == ((0, 2), (3, 8))
    assert found.share == 0.5


@pytest.mark.parametrize(
    "arrangement",
    [
        arranged("then(1, 2)", 1, 2),  # that is one task alone, which is asked anyway
        arranged("or(1, 2, 3)", 1, 2, 3),
        arranged("then(1, 2, 3)", 3, 2, 1),  # said backwards
        arranged("and(1, until(avoid(2), 3))", 1, 2, 3, forbidden=(2, 3)),
    ],
)
def test_what_is_never_one_task(arrangement: Arrangement) -> None:
    assert joined(arrangement) == []


@pytest.mark.parametrize(
    ("spoken", "expected"),
    [
        (("go", ",", "now", "?", "!"), ("go", ",", "now")),
        (("go", ",", "now"), ("go", ",", "now")),
        ((".", "."), ()),
        ((), ()),
    ],
)
def test_the_end_of_a_text_is_left_out(spoken: tuple[str, ...], expected: tuple[str, ...]) -> None:
    assert unended(spoken) == expected


@pytest.mark.parametrize(
    ("spans", "said"),
    [
        (((1, 3), (6, 10)), "put the ball in the box"),
        (((11, 13),), "the zoo"),
    ],
)
def test_what_is_done_to_a_thing_is_put_as_if_it_were_done(spans: tuple[Span, ...], said: str) -> None:
    spoken = ["once", "the", "ball", ",", "dear", ",", "put", "in", "the", "box", ";", "the", "zoo"]
    assert " ".join(words_of(spans, spoken)) == said


@pytest.mark.parametrize(
    ("text", "clauses"),
    [
        ("go to shelf b and to shelf c", ["shelf b", "shelf c"]),
        ("go to shelf 7 , and to shelf 12", ["shelf 7", "shelf 12"]),
        ("go to shelf a ball and to shelf c", ["shelf", "shelf c"]),
    ],
)
def test_a_letter_or_number_belongs_to_the_name_before_it(text: str, clauses: list[str]) -> None:
    spoken = text.split()
    places = [place for place, word in enumerate(spoken) if word == "shelf"]
    found = arranged_as("and(1, 2)", [[(place, place + 1)] for place in places], spoken)
    assert found is not None
    assert [" ".join(clause.words) for clause in found.clauses] == clauses

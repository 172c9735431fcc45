"""Lang2LTL's commands: families, waypoints in order, counts, and the formulas that they make."""

from __future__ import annotations

import pytest

from models.language.human.data import Utterance
from models.language.human.families import Known, numbered
from models.language.human.lang2ltl import formula_holdout, utterance_holdout
from models.language.human.waypoints import Families, count, exchangeable, letters, waypoints

UTTERANCES = [
    Utterance("visit b and a", "visit", ("a", "b"), "& F a F b"),
    Utterance("visit a b and c", "visit", ("a", "b", "c"), "& F a & F b F c"),
    Utterance("visit b only after a", "sequenced_visit", ("a", "b"), "F & a F b"),
    Utterance("a then b then c", "sequenced_visit", ("a", "b", "c"), "F & a F & b F c"),
    Utterance("reach a once", "lower", ("a",), "F a"),
    Utterance("visit a twice", "lower", ("a", "a"), "F & a U a & ! a U ! a F a"),
    Utterance("leave a and do this one more time", "lower", ("a", "a"), "F & a U a & ! a U ! a F a"),
]


def test_waypoints_and_counts_are_read_off_a_sentence() -> None:
    sentence = waypoints().sentence("Go to c and then twice, no, three times to a.")
    assert letters(sentence) == ["c", "a"]
    assert count(sentence) == 3
    assert count(waypoints().sentence("visit a")) == 1


def test_sentences_about_other_waypoints_and_counts_become_the_same() -> None:
    one, other = (
        waypoints().in_order(waypoints().sentence(text)) for text in ("visit d four times", "visit a two times")
    )
    assert one.words == other.words == ("visit", "bakery", "three", "times")


def test_families_are_learned_from_their_formulas() -> None:
    families = Families.of(UTTERANCES)
    assert families.counting == {"lower"}
    assert families.unordered == {"visit", "lower"}
    assert families.formula("visit", ["c", "b", "a", "d"], 1) == "& F a & F b & F c F d"
    assert families.formula("sequenced_visit", ["d", "b", "a", "c"], 1) == "F & d F & b F & a F c"
    assert families.formula("lower 0", ["c"], 3) == "F & c U c & ! c U ! c F & c U c & ! c U ! c F c"
    assert families.formula("lower 1", ["c"], 1) == "F & c U c & ! c U ! c F c"
    assert families.formula("lower 0", ["c", "d"], 2) == ""


def test_what_is_learned_of_an_utterance() -> None:
    families = Families.of(UTTERANCES)
    sentences = [waypoints().sentence(utterance.text) for utterance in UTTERANCES]
    kinds = [families.kind(*pair).template for pair in zip(UTTERANCES, sentences, strict=True)]
    assert kinds == ["visit", "visit", "sequenced_visit", "sequenced_visit", "lower 0", "lower 0", "lower 1"]
    orders = [families.order(*pair) for pair in zip(UTTERANCES, sentences, strict=True)]
    assert [order.things for order in orders[:3] if order is not None] == [("b", "a"), ("a", "b", "c"), ("a", "b")]
    assert families.order(UTTERANCES[0], waypoints().sentence("visit a")) is None


@pytest.mark.parametrize(
    ("formula", "expected"),
    [("& F a & F b F c", True), ("| a b", True), ("F & a F b", False), ("U a b", False), ("& U ! b a F b", False)],
)
def test_propositions_that_may_be_exchanged(formula: str, expected: bool) -> None:
    propositions = [letter for letter in "abc" if letter in formula.split()]
    assert exchangeable(Known(2, len(propositions), numbered(formula, propositions))) is expected


def test_a_formula_that_is_held_out_is_in_no_training_set() -> None:
    tested = []
    for split in formula_holdout(UTTERANCES, 0):
        assert {one.formula for one in split.training}.isdisjoint(one.formula for one in split.test)
        tested += split.test
    assert sorted(tested, key=str) == sorted(UTTERANCES, key=str)


def test_a_fifth_of_each_formulas_utterances_is_held_out() -> None:
    many = [Utterance(f"visit a {number}", "visit", ("a",), "F a") for number in range(10)]
    (split,) = utterance_holdout(many, 3)
    assert (len(split.training), len(split.test)) == (8, 2)
    assert set(split.training).isdisjoint(split.test)

"""Rules of formula families, inferred from some lengths, against formulas written by hand and against Spot."""

from __future__ import annotations

import pytest
import spot

from models.language.human.families import Known, infer, named, numbered

LETTERS = "abcdh"
SEQUENCES = {
    "visit": {1: "F a", 2: "& F a F b", 3: "& F a & F b F c", 4: "& F a & F b & F c F d"},
    "sequenced": {2: "F & a F b", 3: "F & a F & b F c", 4: "F & a F & b F & c F d"},
    "ordered": {2: "& U ! b a F b", 3: "& U ! b a & U ! c b F c", 4: "& U ! b a & U ! c b & U ! d c F d"},
    "at most": {
        1: "! F & a U a & ! a U ! a F a",
        2: "! F & a U a & ! a U ! a F & a U a & ! a U ! a F a",
        3: "! F & a U a & ! a U ! a F & a U a & ! a U ! a F & a U a & ! a U ! a F a",
    },
    "exactly": {
        1: "M a | ! a G | a G ! a",
        2: "M & a F & ! a F a | ! a G | a G | ! a G | a G ! a",
        3: "M & a F & ! a F & a F & ! a F a | ! a G | a G | ! a G | a G | ! a G | a G ! a",
    },
}


def known(family: str, length: int) -> Known:
    propositions = 1 if family in ("at most", "exactly") else length
    return Known(length, propositions, numbered(SEQUENCES[family][length], LETTERS[:propositions]))


@pytest.mark.parametrize("family", sorted(SEQUENCES))
@pytest.mark.parametrize("held_out", [1, 2, 3, 4])
def test_a_length_that_was_not_seen_follows_from_the_others(family: str, held_out: int) -> None:
    if held_out not in SEQUENCES[family]:
        pytest.skip("the family has no such length")
    seen = [known(family, length) for length in SEQUENCES[family] if length != held_out]
    rule = infer(seen)
    assert rule is not None
    expected = known(family, held_out)
    said = rule.formula(held_out, expected.propositions)
    assert said == expected.words
    assert all(rule.formula(one.length, one.propositions) == one.words for one in seen)


def test_a_longer_formula_than_any_means_what_it_should() -> None:
    rule = infer([known("ordered", length) for length in (2, 3)])
    assert rule is not None
    words = rule.formula(5, 5)
    assert words is not None
    inferred = spot.formula(named(words, LETTERS))
    by_hand = spot.formula("(!b U a) & (!c U b) & (!d U c) & (!h U d) & F h")
    assert spot.are_equivalent(inferred, by_hand)


def test_at_most_four_visits_allow_four_and_no_fifth() -> None:
    rule = infer([known("at most", length) for length in (1, 2, 3)])
    assert rule is not None
    words = rule.formula(4, 1)
    assert words is not None
    formula = spot.formula(named(words, "a"))
    for visits in range(1, 7):
        word = spot.parse_word("; ".join(["a; !a"] * visits) + "; cycle{!a}")
        accepted = spot.contains(formula.translate(), word.as_automaton())
        assert accepted == (visits <= 4)


def test_formulas_without_a_common_rule_have_none() -> None:
    assert infer([Known(1, 1, ("F", 0)), Known(2, 2, ("U", "!", 0, 1))]) is None
    assert infer([Known(2, 2, ("U", 0, 1))]) is None


def test_propositions_that_there_are_not_are_never_said() -> None:
    rule = infer([known("visit", length) for length in (1, 2, 3)])
    assert rule is not None
    assert rule.formula(5, 3) is None
    assert rule.formula(0, 0) is None

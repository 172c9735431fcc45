"""Evaluating templates: grounding, simultaneous substitution, refusals."""

from __future__ import annotations

import pytest

from models.errors import CqltlError
from models.logic import parse
from models.logic import to_text as formula_text
from models.queries import (
    AmbiguousGroundingError,
    ArityMismatchError,
    Example,
    Template,
    evaluate,
    learn,
    parse_query,
)
from models.world import (
    Environment,
    TypeMismatchError,
    UnknownObjectError,
    UnknownPropositionError,
    load_environment,
)


def taught(environment: Environment, query: str, ltl: str) -> Template:
    return learn([Example(parse_query(query), parse(ltl))], environment)


@pytest.mark.parametrize(
    ("learned", "query", "expected"),
    [
        (
            ("tour(p, q)", "F (at(robot, p) & F at(robot, q))"),
            "tour(q, p)",
            "F (at(robot, q) & F at(robot, p))",
        ),
        (
            ("tour(p, q)", "F (at(robot, p) & F at(robot, q))"),
            "tour(q, q)",
            "F (at(robot, q) & F at(robot, q))",
        ),
        (("go(p)", "F at(robot, p)"), "go(the long table)", "F at(robot, table)"),
        (("find(ball, red)", "F colored(ball, red)"), "find(orange, orange)", "F colored(orange, orange)"),
        (("store(ball, crate)", "F by(ball, crate)"), "store(bag, bag)", "F by(sachet, sack)"),
        (("bring(ball)", "F lies(ball, q)"), "bring(orange)", "F lies(orange, q)"),
    ],
)
def test_evaluates(store: Environment, learned: tuple[str, str], query: str, expected: str) -> None:
    task = evaluate(taught(store, *learned), parse_query(query), store)
    assert formula_text(task.formula) == expected


def test_bindings_say_what_each_phrase_named(store: Environment) -> None:
    task = evaluate(taught(store, "store(ball, crate)", "F by(ball, crate)"), parse_query("store(bag, sack)"), store)
    assert [(b.position, b.phrase, b.candidate.symbol.name, b.candidate.symbol.kind) for b in task.bindings] == [
        (1, "bag", "sachet", "thing"),
        (2, "sack", "sack", "bin"),
    ]
    assert all(binding.candidate.reason for binding in task.bindings)


@pytest.mark.parametrize(
    ("query", "error", "pointer"),
    [
        ("see(ball, p, q)", ArityMismatchError, ""),
        ("see(ball)", ArityMismatchError, ""),
        ("see(unicorn, p)", UnknownObjectError, "/arguments/0"),
        ("see(ball, crate)", TypeMismatchError, "/arguments/1"),
        ("see(bag, p)", AmbiguousGroundingError, "/arguments/0"),
    ],
)
def test_refusals_name_their_place(store: Environment, query: str, error: type[CqltlError], pointer: str) -> None:
    template = taught(store, "see(ball, p)", "F lies(ball, p)")
    with pytest.raises(error) as caught:
        evaluate(template, parse_query(query), store)
    assert [place.pointer for place in caught.value.places] == [pointer]


def test_an_ambiguous_phrase_comes_with_its_candidates(store: Environment) -> None:
    with pytest.raises(AmbiguousGroundingError) as caught:
        evaluate(taught(store, "see(ball, p)", "F lies(ball, p)"), parse_query("see(bag, p)"), store)
    assert caught.value.position == 1
    assert sorted(candidate.symbol.name for candidate in caught.value.candidates) == ["sachet", "sack"]


def test_a_world_without_the_function_is_refused(store: Environment) -> None:
    other = load_environment({"name": "tiny", "kind": "explicit", "states": 1, "labels": {"a": [0]}})
    with pytest.raises(UnknownPropositionError, match="lies"):
        evaluate(taught(store, "see(ball, p)", "F lies(ball, p)"), parse_query("see(ball, p)"), other)

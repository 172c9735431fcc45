"""The CQ-LTL algorithm on cases worked out by hand."""

from __future__ import annotations

import pytest

from models.errors import CqltlError
from models.logic import parse
from models.logic import to_text as formula_text
from models.queries import (
    AmbiguousParameterMappingError,
    Example,
    InconsistentExamplesError,
    UnusedParameterError,
    learn,
    parse_query,
)
from models.world import (
    Environment,
    TypeMismatchError,
    UnknownObjectError,
    UnknownPropositionError,
)


def example(query: str, ltl: str) -> Example:
    return Example(parse_query(query), parse(ltl))


def template(environment: Environment, *pairs: tuple[str, str]) -> str:
    return formula_text(learn([example(*pair) for pair in pairs], environment).formula)


@pytest.mark.parametrize(
    ("query", "ltl", "expected"),
    [
        ("go(p)", "F at(robot, p)", "F at(robot, $1)"),
        ("go(long table)", "F at(robot, table)", "F at(robot, $1)"),
        ("go(the long table)", "F at(robot, table)", "F at(robot, $1)"),
        ("tour(p, q)", "F (at(robot, q) & F at(robot, p))", "F (at(robot, $2) & F at(robot, $1))"),
        # a parameter used several times
        ("stay(p)", "F G at(robot, p) & G F at(robot, p)", "F G at(robot, $1) & G F at(robot, $1)"),
        # objects that no argument names stay constants
        ("bring(ball)", "F lies(ball, q)", "F lies($1, q)"),
        ("home()", "F at(robot, p)", "F at(robot, p)"),
        # attribute values are parameters too
        ("find(ball, red)", "F (lies(ball, q) & colored(ball, red))", "F (lies($1, q) & colored($1, $2))"),
        # `orange` is a fruit and a colour; only the one that the formula mentions can be meant
        ("find(ball, orange)", "F colored(ball, orange)", "F colored($1, $2)"),
        ("take(orange)", "F lies(orange, q)", "F lies($1, q)"),
        # `bag` is a thing and a bin; likewise
        ("store(ball, bag)", "F by(ball, sack)", "F by($1, $2)"),
        ("store(bag, crate)", "F by(sachet, crate)", "F by($1, $2)"),
        # one argument fits two things of the formula, but one of them is surely the other argument
        ("store(sachet, bag)", "F by(sachet, sack)", "F by($1, $2)"),
        # every operator is kept
        (
            "guard(p, q)",
            "!at(robot, q) U at(robot, p) -> X at(robot, q) R at(robot, p) <-> false",
            "!at(robot, $2) U at(robot, $1) -> X at(robot, $2) R at(robot, $1) <-> false",
        ),
    ],
)
def test_one_example(store: Environment, query: str, ltl: str, expected: str) -> None:
    assert template(store, (query, ltl)) == formula_text(parse(expected))


@pytest.mark.parametrize(
    ("query", "ltl"),
    [
        ("tour(p, p)", "F (at(robot, p) & F at(robot, p))"),  # the paper's non-distinct groundings
        ("store(bag, bag)", "F by(sachet, sack)"),
        ("find(orange, orange)", "F colored(orange, orange)"),
        ("go(p, p)", "F at(robot, p)"),
        ("three(p, p, q)", "F at(robot, p) & G at(robot, q)"),
    ],
)
def test_groundings_that_are_not_distinct_are_refused(store: Environment, query: str, ltl: str) -> None:
    with pytest.raises(AmbiguousParameterMappingError) as caught:
        learn([example(query, ltl)], store)
    pointers = [place.pointer for place in caught.value.places]
    assert pointers == ["/0/query/arguments/0", "/0/query/arguments/1"]


def test_a_second_example_settles_what_the_first_could_not(store: Environment) -> None:
    vague = ("tour(p, p)", "F (at(robot, p) & F at(robot, p))")
    clear = ("tour(q, p)", "F (at(robot, p) & F at(robot, q))")
    assert template(store, vague, clear) == "F (at(robot, $2) & F at(robot, $1))"
    assert template(store, clear, vague) == "F (at(robot, $2) & F at(robot, $1))"


def test_a_second_example_tells_a_repeated_parameter_from_a_coincidence(store: Environment) -> None:
    # alone, the first says that $1 feeds both places; the second shows that the last place is the constant p
    assert template(store, ("go(p)", "F (at(robot, p) & F at(robot, p))")) == "F (at(robot, $1) & F at(robot, $1))"
    both = [
        ("go(p)", "F (at(robot, p) & F at(robot, p))"),
        ("go(q)", "F (at(robot, q) & F at(robot, p))"),
    ]
    assert template(store, *both) == "F (at(robot, $1) & F at(robot, p))"


def test_examples_that_leave_two_mappings_are_refused(store: Environment) -> None:
    pairs = [
        ("tour(p, p)", "G at(robot, p) | F at(robot, p)"),
        ("tour(q, q)", "G at(robot, q) | F at(robot, q)"),
    ]
    with pytest.raises(AmbiguousParameterMappingError):
        template(store, *pairs)


@pytest.mark.parametrize(
    ("pairs", "error", "pointer"),
    [
        ([("go(p)", "F at(robot, q)")], UnusedParameterError, "/0/query/arguments/0"),
        ([("go(p, ball)", "F at(robot, p)")], UnusedParameterError, "/0/query/arguments/1"),
        ([("go(moon)", "F at(robot, p)")], UnknownObjectError, "/0/query/arguments/0"),
        ([("go(p)", "F at(robot, moon)")], UnknownObjectError, "/0/formula"),
        ([("go(p)", "F at(robot, $1)")], UnknownObjectError, "/0/formula"),
        ([("go(p)", "F flies(robot, p)")], UnknownPropositionError, "/0/formula"),
        ([("go(p)", "F at(p, robot)")], TypeMismatchError, "/0/formula"),
        ([("go(p)", "F at(robot, p)"), ("go(q)", "G at(robot, q)")], InconsistentExamplesError, "/1/formula"),
        ([("go(p)", "F at(robot, p)"), ("run(q)", "F at(robot, q)")], InconsistentExamplesError, "/1/query"),
        (
            [("go(p)", "F at(robot, p)"), ("go(p, q)", "F at(robot, p)")],
            InconsistentExamplesError,
            "/1/query",
        ),
        (
            [("go(p)", "F at(robot, p)"), ("go(q)", "F at(robot, p)")],
            UnusedParameterError,
            "/1/query/arguments/0",
        ),
        ([("go(p)", "F at(robot, p)"), ("go(q)", "F at(robot, oz)")], UnknownObjectError, "/1/formula"),
    ],
)
def test_refusals_name_their_place(
    store: Environment, pairs: list[tuple[str, str]], error: type[CqltlError], pointer: str
) -> None:
    with pytest.raises(error) as caught:
        template(store, *pairs)
    assert [place.pointer for place in caught.value.places] == [pointer]


def test_a_constant_that_differs_between_examples_is_refused(store: Environment) -> None:
    with pytest.raises(InconsistentExamplesError, match="p and q"):
        template(store, ("take(ball)", "F lies(ball, p)"), ("take(orange)", "F lies(orange, q)"))


def test_parameters_have_the_kinds_of_every_place_they_feed(store: Environment) -> None:
    learned = learn([example("put(ball, crate, q)", "F (by(ball, crate) & lies(ball, q))")], store)
    assert learned.kinds == (frozenset({"thing"}), frozenset({"bin"}), frozenset({"place"}))
    assert learn([example("see(ball)", "F lies(ball, p)")], store).kinds == (frozenset({"thing", "bin"}),)
    assert learned.arity == 3


def test_many_indistinct_arguments_are_refused_at_once(store: Environment) -> None:
    arguments = ", ".join(["bag"] * 16)
    with pytest.raises(AmbiguousParameterMappingError):
        learn([example(f"many({arguments})", "F by(sachet, sack)")], store)

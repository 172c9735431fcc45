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
    PartOfSpeech,
    TypeMismatchError,
    UnknownObjectError,
    UnknownPropositionError,
    builtin_environments,
    load_environment,
    resolve,
    toys_spec,
)


def taught(environment: Environment, query: str, ltl: str) -> Template:
    return learn([Example(parse_query(query), parse(ltl))], environment)


def taught_twice(environment: Environment) -> Template:
    """`see`, once with a thing and once with a bin, so that nothing tells which of the two a phrase means."""
    pairs = [("see(ball, p)", "F lies(ball, p)"), ("see(crate, p)", "F lies(crate, p)")]
    return learn([Example(parse_query(query), parse(ltl)) for query, ltl in pairs], environment)


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
    template = taught_twice(store)
    with pytest.raises(error) as caught:
        evaluate(template, parse_query(query), store)
    assert [place.pointer for place in caught.value.places] == [pointer]


def test_an_ambiguous_phrase_comes_with_its_candidates(store: Environment) -> None:
    with pytest.raises(AmbiguousGroundingError) as caught:
        evaluate(taught_twice(store), parse_query("see(bag, p)"), store)
    assert caught.value.position == 1
    assert sorted(candidate.symbol.name for candidate in caught.value.candidates) == ["sachet", "sack"]


def test_a_phrase_that_names_nothing_is_said_before_one_that_fits_several(store: Environment) -> None:
    with pytest.raises(UnknownObjectError, match="nowhere"):
        evaluate(taught_twice(store), parse_query("see(bag, nowhere)"), store)


@pytest.mark.parametrize(("shown", "meant"), [("ball", "sachet"), ("crate", "sack")])
def test_what_a_task_was_taught_with_decides_between_things_of_one_name(
    store: Environment, shown: str, meant: str
) -> None:
    template = taught(store, f"see({shown}, p)", f"F lies({shown}, p)")
    assert formula_text(evaluate(template, parse_query("see(bag, q)"), store).formula) == f"F lies({meant}, q)"
    # it prefers, and forbids nothing
    assert formula_text(evaluate(template, parse_query("see(ball, q)"), store).formula) == "F lies(ball, q)"
    assert formula_text(evaluate(template, parse_query("see(crate, q)"), store).formula) == "F lies(crate, q)"


def test_the_preference_holds_where_nothing_is_known_of_the_colors(store: Environment) -> None:
    toys = load_environment(
        {
            "name": "bags",
            "kind": "oomdp",
            "domain": "toys",
            "objects": {
                "here": {"class": "cell", "attributes": dict.fromkeys(("north", "south", "east", "west"), "here")},
                "robot": {"class": "robot"},
                "bag": {"class": "box"},
                "bag_toy": {"class": "toy", "synonyms": ["bag"]},
                "ball": {"class": "toy"},
            },
            "state": {"robot": {"at": "here"}, **{name: {"in": "here"} for name in ("bag", "bag_toy", "ball")}},
        }
    )
    template = taught(toys, "pick(ball, red)", "F (holding(ball) & colored(ball, red))")
    expected = "F (holding(bag_toy) & colored(bag_toy, blue))"
    assert formula_text(evaluate(template, parse_query("pick(bag, blue)"), toys).formula) == expected


def test_a_world_without_the_function_is_refused(store: Environment) -> None:
    other = load_environment({"name": "tiny", "kind": "explicit", "states": 1, "labels": {"a": [0]}})
    with pytest.raises(UnknownPropositionError, match="lies"):
        evaluate(taught(store, "see(ball, p)", "F lies(ball, p)"), parse_query("see(ball, p)"), other)


@pytest.mark.parametrize(
    ("query", "expected"),
    [
        ("pickup_colored(toy, red)", "F (holding(cylinder) & colored(cylinder, red))"),
        ("pickup_colored(one, green)", "F (holding(sphere) & colored(sphere, green))"),
        ("pickup_colored(small one, orange)", "F (holding(orange) & colored(orange, orange))"),
        # what is named is meant, whatever is said of it: the formula then cannot be satisfied
        ("pickup_colored(cylinder, green)", "F (holding(cylinder) & colored(cylinder, green))"),
    ],
)
def test_attribute_values_help_to_find_the_object(query: str, expected: str) -> None:
    toys = load_environment(dict(builtin_environments())["toys"])
    template = taught(toys, "pickup_colored(sphere, red)", "F (holding(sphere) & colored(sphere, red))")
    assert formula_text(evaluate(template, parse_query(query), toys).formula) == expected


@pytest.mark.parametrize(
    ("query", "error", "said"),
    [
        ("pickup_colored(toy, yellow)", UnknownObjectError, '"yellow toy"'),
        ("pickup_colored(toy, blue)", AmbiguousGroundingError, '"blue toy"'),
    ],
)
def test_an_object_that_the_values_do_not_settle_is_refused(query: str, error: type[CqltlError], said: str) -> None:
    spec = toys_spec(columns=2, rows=1, toys=[("cube", "blue"), ("sphere", "blue"), ("cone", "red")])
    toys = load_environment(spec)
    template = taught(toys, "pickup_colored(cone, red)", "F (holding(cone) & colored(cone, red))")
    with pytest.raises(error, match=said):
        evaluate(template, parse_query(query), toys)


def test_what_is_denied_of_an_object_does_not_describe_it() -> None:
    spec = toys_spec(columns=2, rows=1, toys=[("sphere", "red"), ("cube", "blue"), ("cone", "red")])
    toys = load_environment(spec)
    template = taught(toys, "pick_not(cone, blue)", "F (holding(cone) & !colored(cone, blue))")
    with pytest.raises(AmbiguousGroundingError, match='"toy" fits several'):
        evaluate(template, parse_query("pick_not(toy, red)"), toys)


@pytest.mark.parametrize(
    ("pos", "ltl"), [("noun", 'F about("thing.orange")'), ("adjective", 'F about("color.orange")')]
)
def test_the_part_of_speech_decides_where_the_kinds_do_not(store: Environment, pos: PartOfSpeech, ltl: str) -> None:
    template = taught(store, "talk(ball)", "F about(ball)")
    with pytest.raises(AmbiguousGroundingError) as caught:
        evaluate(template, parse_query("talk(orange)"), store)
    assert caught.value.choices == ("thing.orange", "color.orange")
    task = evaluate(template, parse_query("talk(orange)"), store, parts_of_speech=[pos])
    assert formula_text(task.formula) == ltl
    assert resolve(parse(ltl), store) == task.formula
    colored = taught(store, "find(ball, red)", "F colored(ball, red)")
    task = evaluate(colored, parse_query("find(orange, orange)"), store)
    assert formula_text(task.formula) == "F colored(orange, orange)"

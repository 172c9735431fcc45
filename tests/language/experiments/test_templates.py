"""Templates from translations that are right in both languages."""

from __future__ import annotations

from dataclasses import replace

from models.language.dataset import Domain
from models.language.experiments.commands import CommandSet, paper_sets
from models.language.experiments.templates import given, jointly_accurate
from models.logic import parse, to_text
from models.queries import parse_query

SEEN, _ = paper_sets(Domain.MANIPULATION)


def _set(*texts: str) -> CommandSet:
    chosen = [pair for pair in zip(SEEN.examples, SEEN.expected, strict=True) if pair[0].text in texts]
    return replace(SEEN, examples=tuple(e for e, _ in chosen), expected=tuple(f for _, f in chosen))


def test_templates_of_the_data() -> None:
    templates = {task: to_text(t.formula) for domain in Domain for task, t in given(paper_sets(domain)[0]).items()}
    assert templates == {
        "move_to": "F near(robot, $1)",
        "pickup": "F holding($1)",
        "pickup_colored": "F (holding($1) & colored($1, $2))",
        "ship": "F (in($1, $2) & F (in($1, $2) & at($2, $3)))",
        "navigate_one": "F at(robot, $1)",
        "navigate_two": "F (at(robot, $1) & F at(robot, $2))",
        "navigate_three": "F (at(robot, $1) & F (at(robot, $2) & F at(robot, $3)))",
    }


def test_only_what_both_translate_rightly_teaches() -> None:
    commands = _set("Grab the ball", "Grab the cube", "Approach the ball")
    assert commands.texts == ("Approach the ball", "Grab the cube", "Grab the ball")
    queries = [parse_query("move_to(ball)"), parse_query("pickup(cube)"), parse_query("pickup(cube)")]
    formulas = [parse("F near(robot, cube)"), parse("F F holding(cube)"), parse("F holding(ball)")]
    lessons = jointly_accurate(commands, queries, formulas)
    assert lessons.accurate == {"pickup": 1}
    # an equivalent formula is right; the template has its form
    assert {task: to_text(t.formula) for task, t in lessons.templates.items()} == {"pickup": "F F holding($1)"}


def test_nothing_is_learned_from_nothing_or_from_what_does_not_resolve() -> None:
    commands = _set("Grab the ball", "Grab the cube")
    lessons = jointly_accurate(commands, [None, parse_query("pickup(cube)")], [parse("F holding(ball)"), None])
    assert (lessons.accurate, lessons.templates) == ({}, {})
    lessons = jointly_accurate(commands, [example.query for example in commands.examples], [parse("F nowhere")] * 2)
    assert (lessons.accurate, lessons.templates) == ({}, {})


def test_an_example_whose_arguments_are_the_same_phrase_teaches_nothing() -> None:
    commands = _set("Pickup the orange orange")
    lessons = jointly_accurate(commands, [commands.examples[0].query], commands.expected)
    assert (lessons.accurate, lessons.templates) == ({"pickup_colored": 1}, {})
    commands = _set("Pickup the orange orange", "Pickup the red ball")
    assert set(given(commands)) == {"pickup_colored"}

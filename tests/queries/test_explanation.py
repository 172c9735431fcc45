"""Queries read back: words that were taught, readings of formulas, and both put together."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from models.logic import parse
from models.queries import (
    ContextualQuery,
    Example,
    ExplanationError,
    GroundedQuery,
    Template,
    check_words,
    evaluate,
    evaluate_query,
    explain_query,
    learn,
    parse_query,
    parse_task,
    put_in,
)
from models.world import Environment, explain, load_environment, toys_spec


@pytest.fixture(scope="module")
def toys() -> Environment:
    return load_environment(toys_spec())


@pytest.fixture(scope="module")
def templates(toys: Environment) -> dict[str, Template]:
    lessons = {
        "store(cylinder, box)": "F in(cylinder, box)",
        "go(kitchen)": "F near(robot, kitchen)",
        "tour(kitchen, bedroom)": "F (near(robot, kitchen) & F near(robot, bedroom))",
        "tint(cylinder, red)": "F colored(cylinder, red)",
        "rest()": "G near(robot, kitchen)",
    }
    learned = [learn([Example(parse_task(query), parse(ltl))], toys) for query, ltl in lessons.items()]
    return {template.task: template for template in learned}


WORDS = {"store": "the {1} ends up in the {2}"}


def grounded(text: str, templates: dict[str, Template], environment: Environment | None) -> GroundedQuery:
    def ground(task: ContextualQuery):
        template = templates[task.task]
        return put_in(template, task) if environment is None else evaluate(template, task, environment)

    return evaluate_query(parse_query(text), ground)


STORED = "the cylinder ends up in the box"


@pytest.mark.parametrize(
    ("query", "said"),
    [
        ("store(the cylinder, box)", STORED),
        ("then(store(cylinder, box), go(kitchen))", f"{STORED}, and then the robot is at the kitchen"),
        (
            "then(go(kitchen), store(cylinder, box), go(bedroom))",
            f"eventually the robot is at the kitchen, and then {STORED}, and then the robot is at the bedroom",
        ),
        (
            "then(tour(kitchen, bedroom), store(cylinder, box))",
            "(eventually the robot is at the kitchen, and then the robot is at the bedroom), and then " + STORED,
        ),
        ("and(store(cylinder, box), avoid(go(kitchen)))", f"{STORED}, and the robot is never at the kitchen"),
        ("or(store(cylinder, box), go(kitchen))", f"{STORED}, or eventually the robot is at the kitchen"),
        ("avoid(store(cylinder, box))", f"it never happens that {STORED}"),
        ("repeat(store(cylinder, box))", f"again and again {STORED}"),
        (
            "until(avoid(store(cylinder, box)), go(kitchen))",
            f"eventually the robot is at the kitchen, and until then it never happens that {STORED}",
        ),
        (
            "without(store(cylinder, box), go(kitchen))",
            f"{STORED} while it is not so that the robot is at the kitchen",
        ),
        (
            "then(store(cylinder, box), or(go(kitchen), avoid(store(cylinder, box))))",
            f"{STORED}, and then (eventually the robot is at the kitchen, or it never happens that {STORED})",
        ),
    ],
)
def test_words_that_were_taught(toys: Environment, templates: dict[str, Template], query: str, said: str) -> None:
    assert explain_query(grounded(query, templates, toys), WORDS, toys).explanation == said


@pytest.mark.parametrize(
    ("words", "query", "said"),
    [
        ("the {1} ends up in the {2}", "store(every toy, box)", "the cylinder and the cube end up in the box"),
        ("the {1} ends up in the {2}", "store(any toy, box)", "the cylinder or the cube ends up in the box"),
        ("{1} is always near {2}", "store(every toy, box)", "the cylinder and the cube are always near the box"),
        ("{1} carries what {2} has", "store(every toy, box)", "the cylinder and the cube carry what the box has"),
        ("{1} reaches {2}", "store(every toy, box)", "the cylinder and the cube reach the box"),
    ],
)
def test_verbs_agree_with_several_things(templates: dict[str, Template], words: str, query: str, said: str) -> None:
    """Where the verb follows at once."""
    world = load_environment(toys_spec(toys=[("cylinder", "red"), ("cube", "red")]))
    assert explain_query(grounded(query, templates, world), {"store": words}, world).explanation == said


@pytest.mark.parametrize(
    "query",
    ["then(go(kitchen), go(bedroom))", "and(go(kitchen), avoid(tour(kitchen, bedroom)))", "repeat(go(bedroom))"],
)
def test_without_words_a_query_is_read_as_its_formula(
    toys: Environment, templates: dict[str, Template], query: str
) -> None:
    found = grounded(query, templates, toys)
    assert explain_query(found, WORDS, toys).explanation == explain(found.formula, toys)


def test_every_part_has_its_formula_and_says_it(toys: Environment, templates: dict[str, Template]) -> None:
    found = grounded("and(then(store(cylinder, box), go(kitchen)), avoid(go(bedroom)))", templates, toys)
    root = explain_query(found, WORDS, toys)
    assert (root.path, root.formula) == ((), found.formula)
    then, avoid = root.parts
    assert (then.path, then.formula) == ((0,), parse("F (in(cylinder, box) & F near(robot, kitchen))"))
    assert [(part.path, part.explanation) for part in then.parts] == [
        ((0, 0), STORED),
        ((0, 1), "eventually the robot is at the kitchen"),
    ]
    assert (avoid.path, avoid.explanation) == ((1,), "the robot is never at the bedroom")
    assert avoid.parts[0].formula == parse("F near(robot, bedroom)")


def test_words_with_commas_are_set_off(toys: Environment, templates: dict[str, Template]) -> None:
    found = grounded("then(go(kitchen), store(cylinder, box))", templates, toys)
    words = {"store": "take {1}, then put it in {2}"}
    assert explain_query(found, words, toys).explanation == (
        "eventually the robot is at the kitchen, and then (take the cylinder, then put it in the box)"
    )


def test_values_have_no_article(toys: Environment, templates: dict[str, Template]) -> None:
    found = grounded("tint(cylinder, red)", templates, toys)
    assert explain_query(found, {"tint": "{1} turns {2}"}, toys).explanation == "the cylinder turns red"


@pytest.mark.parametrize(
    ("query", "said"),
    [
        ("store(the small ball, box)", "the small ball ends up in the box"),
        ('store("ball, and then the box", crate)', 'the "ball, and then the box" ends up in the crate'),
        ("then(store(ball, box), rest())", "the ball ends up in the box, and then near(robot, kitchen) always holds"),
    ],
)
def test_without_an_environment_phrases_stand_for_things(templates: dict[str, Template], query: str, said: str) -> None:
    assert explain_query(grounded(query, templates, None), WORDS).explanation == said


def test_words_are_cleaned() -> None:
    assert check_words(" {2} is given {1}. ", 2) == "{2} is given {1}"
    assert check_words("the robot rests", 0) == "the robot rests"


@pytest.mark.parametrize(
    ("words", "arity", "detail"),
    [
        ("put {1} in {3}", 2, "character 12: {3} is no argument; the arguments are {1} {2}"),
        ("put {1} away", 2, "{2} is missing"),
        ("rest {1}", 0, "the task has no arguments"),
        ("put {toy}", 1, "character 5: {toy} is no argument"),
        ("put {01}", 1, "{01} is no argument"),
        ("put {} {1}", 1, "{} is no argument"),
        ("put {1", 1, "character 5: a lone {"),
        ("put {1}}", 1, "character 8: a lone }"),
        ("put {{1}}", 1, "a lone {"),
        ("", 0, "1 to 500 characters"),
        (" . ", 0, "1 to 500 characters"),
        ("a\nb", 0, "on one line"),
        ("a" * 501, 0, "1 to 500 characters"),
    ],
)
def test_words_that_do_not_fit_the_task(words: str, arity: int, detail: str) -> None:
    with pytest.raises(ExplanationError) as refused:
        check_words(words, arity)
    assert detail in refused.value.detail
    assert [place.pointer for place in refused.value.places] == [""]


@given(st.text(st.sampled_from("ab {}123.,"), max_size=20), st.integers(0, 3))
def test_words_that_are_taken_say_every_argument_and_no_other(words: str, arity: int) -> None:
    try:
        taken = check_words(words, arity)
    except ExplanationError:
        return
    for position in range(1, arity + 1):
        assert f"{{{position}}}" in taken
        taken = taken.replace(f"{{{position}}}", "")
    assert not {"{", "}"} & set(taken)

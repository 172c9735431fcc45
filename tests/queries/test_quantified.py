"""Templates over phrases that speak of several things: the formulas, and that they mean what the single ones do."""

from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from models.logic import FormulaTooLargeError, conjunction, disjunction, equivalent, parse
from models.logic import to_text as formula_text
from models.queries import (
    AmbiguousGroundingError,
    Binding,
    ContextualQuery,
    Example,
    GroundedQuery,
    Template,
    evaluate,
    evaluate_query,
    explain_query,
    learn,
    parse_query,
)
from models.queries.template import MAX_COMBINATIONS
from models.world import Environment, Quantifier, UnknownObjectError, load_environment
from tests.world.worlds import NURSERY

ENVIRONMENT = load_environment(NURSERY)
PAIRS = {
    "pickup(cube)": "F holding(cube)",
    "move_to(cube)": "F near(robot, cube)",
    "pickup_colored(cube, red)": "F (holding(cube) & colored(cube, red))",
    "ship(cube, box, bedroom)": "F (in(cube, box) & F (in(cube, box) & at(box, bedroom)))",
    "keep(cube, box)": "G in(cube, box)",
    "visit(cube, kitchen)": "F (near(robot, cube) & F near(robot, kitchen))",
}


def _learned(query: str, ltl: str) -> Template:
    return learn([Example(parse_task_of(query), parse(ltl))], ENVIRONMENT)


def parse_task_of(text: str) -> ContextualQuery:
    query = parse_query(text)
    assert isinstance(query, ContextualQuery)
    return query


TEMPLATES = {parse_task_of(query).task: _learned(query, ltl) for query, ltl in PAIRS.items()}


def grounded(text: str, environment: Environment = ENVIRONMENT) -> GroundedQuery:
    return evaluate_query(parse_query(text), lambda task: evaluate(TEMPLATES[task.task], task, environment))


@pytest.mark.parametrize(
    ("query", "expected"),
    [
        ("pickup(any red toy)", "F holding(red_ball) | F holding(cube)"),
        ("pickup(both boxes)", "F holding(box) & F holding(crate)"),
        ("pickup(any duck)", "F holding(duck)"),
        ("pickup(everything in the kitchen)", "F holding(box) & F holding(blue_ball)"),
        ("pickup(the smaller of the two boxes)", "F holding(crate)"),
        ("move_to(the object in the kitchen)", "F near(robot, blue_ball)"),
        (
            "pickup_colored(any toy, red)",
            "F (holding(red_ball) & colored(red_ball, red)) | F (holding(cube) & colored(cube, red))",
        ),
        (
            "keep(every red toy, any box)",
            "(G in(red_ball, box) | G in(red_ball, crate)) & (G in(cube, box) | G in(cube, crate))",
        ),
        (
            "keep(any red toy, every box)",
            "(G in(red_ball, box) & G in(red_ball, crate)) | (G in(cube, box) & G in(cube, crate))",
        ),
        ("avoid(pickup(any red toy))", "G !holding(red_ball) & G !holding(cube)"),
        ("avoid(pickup(both red toys))", "G !holding(red_ball) | G !holding(cube)"),
        (
            "then(pickup(any red toy), move_to(kitchen))",
            "F (holding(red_ball) & F near(robot, kitchen)) | F (holding(cube) & F near(robot, kitchen))",
        ),
        (
            "then(pickup(both red toys), move_to(kitchen))",
            "F (holding(red_ball) & F near(robot, kitchen)) & F (holding(cube) & F near(robot, kitchen))",
        ),
        (
            "until(avoid(pickup(anything in the kitchen)), move_to(bedroom))",
            "(!holding(box) & !holding(blue_ball)) U near(robot, bedroom)",
        ),
        (  # the same toy: "pick up any red toy and put it in the box"
            "then(pickup(any red toy), keep(any red toy, box))",
            "F (holding(red_ball) & G in(red_ball, box)) | F (holding(cube) & G in(cube, box))",
        ),
        (  # each toy in turn, not all before any
            "then(pickup(both red toys), move_to(both red toys))",
            "F (holding(red_ball) & F near(robot, red_ball)) & F (holding(cube) & F near(robot, cube))",
        ),
        (  # of everything in the kitchen, what can be kept in a box
            "then(pickup(everything in the kitchen), keep(everything in the kitchen, box))",
            "F (holding(blue_ball) & G in(blue_ball, box))",
        ),
        (  # however deep
            "and(then(pickup(any red toy), move_to(kitchen)), repeat(move_to(any red toy)))",
            "(F (holding(red_ball) & F near(robot, kitchen)) & G F near(robot, red_ball)) "
            "| (F (holding(cube) & F near(robot, kitchen)) & G F near(robot, cube))",
        ),
        (  # what is never to be done is apart
            "and(move_to(any red toy), avoid(pickup(any red toy)))",
            "(F near(robot, red_ball) | F near(robot, cube)) & G !holding(red_ball) & G !holding(cube)",
        ),
        (
            "without(move_to(either box), pickup(either box))",
            "F (near(robot, box) & !(holding(box) | holding(crate))) "
            "| F (near(robot, crate) & !(holding(box) | holding(crate)))",
        ),
        (  # a choice between two tasks is each for itself
            "or(pickup(both red toys), move_to(both red toys))",
            "(F holding(red_ball) & F holding(cube)) | (F near(robot, red_ball) & F near(robot, cube))",
        ),
        ("repeat(move_to(either box))", "G (F near(robot, box) | F near(robot, crate))"),
    ],
)
def test_the_formula(query: str, expected: str) -> None:
    assert formula_text(grounded(query).formula) == expected


def test_bindings_have_all_that_is_meant() -> None:
    found = grounded("ship(any red toy, the crate, bedroom)").bindings
    assert [(path, b.quantifier.value, [c.symbol.name for c in b.candidates]) for path, b in found] == [
        ((), "any", ["red_ball", "cube"]),
        ((), "one", ["crate"]),
        ((), "one", ["bedroom"]),
    ]
    assert all(isinstance(binding, Binding) and binding.candidate == binding.candidates[0] for _, binding in found)


def test_the_kinds_that_were_taught_do_not_narrow_what_is_said_of_several() -> None:
    """The task was taught with a toy; "everything" is boxes too, while a homonym is the toy."""
    assert formula_text(grounded("pickup(everything red)").formula) == (
        "F holding(crate) & F holding(red_ball) & F holding(cube)"
    )


def test_phrases_go_by_the_state_of_the_environment() -> None:
    moved = ENVIRONMENT.in_state({"cube": {"in": "kitchen"}, "blue_ball": {"in": "bathroom"}})
    assert formula_text(grounded("pickup(the toy in the kitchen)", moved).formula) == "F holding(cube)"


@pytest.mark.parametrize(
    ("query", "refusal", "says"),
    [
        ("pickup(both toys)", AmbiguousGroundingError, "fits several"),
        ("pickup(a toy)", AmbiguousGroundingError, "fits several"),
        ("pickup(the toys)", AmbiguousGroundingError, "fits several"),
        ("pickup(any green toy)", UnknownObjectError, 'nothing in nursery fits "any green toy"'),
        ("pickup(the toy in the bathroom)", UnknownObjectError, 'fits "the toy in the bathroom"'),
        ("pickup(the green toy)", UnknownObjectError, 'is called "the green toy"'),
    ],
)
def test_refusals(query: str, refusal: type[Exception], says: str) -> None:
    with pytest.raises(refusal, match=says):
        grounded(query)


def test_words_of_a_task_name_all_that_is_meant() -> None:
    words = {"pickup": "the robot gets {1}", "keep": "{1} stays in {2}"}

    def said(query: str) -> str:
        return explain_query(grounded(query), words, ENVIRONMENT).explanation

    assert said("pickup(any red toy)") == "the robot gets the red ball or the cube"
    assert said("pickup(both boxes)") == "the robot gets the box and the crate"
    assert said("keep(the cube, any box)") == "the cube stays in the box or the crate"


def test_what_tasks_share_is_what_all_of_them_can_be_about() -> None:
    """Boxes can be picked up, but not kept in a box."""
    both = grounded("then(pickup(everything in the kitchen), keep(everything in the kitchen, box))").bindings
    assert [[c.symbol.name for c in binding.candidates] for _, binding in both] == [
        ["blue_ball"],
        ["blue_ball"],
        ["box"],
    ]
    assert {binding.quantifier for _, binding in both[:2]} == {Quantifier.ALL}


def test_too_many_combinations_are_refused() -> None:
    objects = {f"place {n}": {"class": "place"} for n in range(MAX_COMBINATIONS + 1)}
    data = {
        "name": "plain",
        "kind": "oomdp",
        "domain_spec": {
            "name": "plain",
            "classes": {"place": {}, "robot": {"state": {"at": "place"}}},
            "constants": {"robot": "robot"},
            "functions": {"at": {"arguments": ["r: robot", "p: place"], "is": "r.at == p"}},
            "actions": {"wait": {"outcomes": [{}]}},
        },
        "objects": objects,
        "state": {"robot": {"at": "place 0"}},
    }
    environment = load_environment(data)
    template = learn([Example(parse_task_of("go(place 1)"), parse('F at(robot, "place 1")'))], environment)
    with pytest.raises(FormulaTooLargeError, match=f"65 combinations of things in plain; at most {MAX_COMBINATIONS}"):
        evaluate(template, parse_task_of("go(any place)"), environment)
    with pytest.raises(FormulaTooLargeError, match=f"more than {MAX_COMBINATIONS} combinations"):
        grounded("then(move_to(any item), move_to(any item), move_to(each item), move_to(each item))")


@pytest.mark.parametrize("phrase", ["any toy", "every cube", "both boxes"])
def test_an_example_names_one_thing(phrase: str) -> None:
    with pytest.raises(UnknownObjectError, match="in an example, name one"):
        learn([Example(ContextualQuery("get", (phrase,)), parse("F holding(cube)"))], ENVIRONMENT)


THINGS = {
    "toy": ["red_ball", "blue_ball", "cube", "duck"],
    "red toy": ["red_ball", "cube"],
    "ball": ["red_ball", "blue_ball"],
    "toy in a box": ["red_ball", "blue_ball"],
    "small thing": ["red_ball", "duck"],
    "duck": ["duck"],
}
BOXES = {"box": ["box", "crate"], "red box": ["crate"], "box in the kitchen": ["box"]}


@settings(max_examples=25, deadline=None)
@given(
    st.sampled_from(["keep", "ship"]),
    st.sampled_from(["any", "every", "all", "one of the"]),
    st.sampled_from(sorted(THINGS)),
    st.sampled_from(["either", "each", "some"]),
    st.sampled_from(sorted(BOXES)),
)
def test_several_mean_what_the_single_ones_do_together(
    task: str, first: str, thing: str, second: str, box: str
) -> None:
    """By Spot, against the formulas of the members named one by one; the first argument is outermost."""
    rest = ", bedroom" if task == "ship" else ""
    join = {True: conjunction, False: disjunction}
    single = join[first in ("every", "all")](
        *(
            join[second == "each"](*(grounded(f"{task}({one}, {other}{rest})").formula for other in BOXES[box]))
            for one in THINGS[thing]
        )
    )
    assert equivalent(grounded(f"{task}({first} {thing}, {second} {box}{rest})").formula, single)

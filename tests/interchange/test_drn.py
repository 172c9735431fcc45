"""Worlds and products in DRN: Storm's model of the text against the world, and against each other."""

from __future__ import annotations

import random
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from models.interchange import (
    ExportTooLargeError,
    drn_model,
    drn_product,
    label_names,
    prism_model,
    product_property,
    property_text,
)
from models.interchange.names import action_names
from models.logic import Atom, Binary, Formula, Nary, Op, Unary, atoms, parse, to_text, translate
from models.world import UnknownPropositionError, World, load_environment, resolve, toys_spec
from tests.interchange.environments import OOMDP, explicit_spec, loaded
from tests.interchange.isomorphism import STUCK, assert_same, dynamics, from_drn, maximum, storm_dynamics
from tests.interchange.test_prism import some_atoms
from tests.planning.doubles import ArrayWorld, random_world

stormpy = pytest.importorskip("stormpy")

TOYS_FORMULAS = [
    "F in(cylinder, box)",
    "F (in(cylinder, box) & F (in(cylinder, box) & at(box, bedroom)))",
    "(!near(robot, box)) U holding(cylinder)",
    "G F at(robot, bedroom) & G F at(robot, kitchen)",
    "F G at(cylinder, bedroom)",
    "G !holding(box) & F at(cylinder, kitchen)",
    "G (at(robot, bedroom) -> X !at(robot, bedroom)) & G F at(robot, bedroom)",
]


def commented_states(text: str, world: World) -> dict[int, int]:
    """DRN's number of a state to the world's, by the comments."""
    found = {}
    for number, comment in re.findall(r"^state (\d+) .*\n//\[(.*)\]$", text, re.MULTILINE):
        state: dict[str, dict[str, str]] = {}
        for owner, attribute, value in re.findall(r"(?:^| & )([^=&]*)\.(\w+)=([^&]*?)(?= & |$)", comment):
            if owner:
                state.setdefault(owner, {})[attribute] = value
        found[int(number)] = world.encode(state)
    return found


def check(world: World, wanted: list[Atom], folder: Path, *, reachable: bool) -> None:
    text = drn_model(world, atoms=wanted, reachable=reachable)
    model = from_drn(text, folder)
    expected = dynamics(world, reachable=reachable)
    states = commented_states(text, world)
    truth = world.labels(wanted, np.array(list(expected)))
    extra = int(not truth.any(axis=1).all())
    assert model.nr_states == len(expected) + extra
    if extra:
        states[len(expected)] = -1
    actual, _ = storm_dynamics(model, states)
    names = action_names(world.actions)
    assert_same(
        {state: moves for state, moves in actual.items() if state >= 0},
        expected,
        dict(zip((*world.actions, STUCK), names, strict=True)),
    )
    assert [states[state] for state in model.initial_states] == [world.initial]
    for (_, label), holds in zip(label_names(wanted).items(), truth, strict=True):
        found = {states[state] for state in model.labeling.get_states(label)}
        assert found == ({s for s, h in zip(expected, holds, strict=True) if h} or {-1})


@pytest.mark.parametrize("reachable", [False, True])
@pytest.mark.parametrize("name", [name for name in OOMDP if name != "two toys on a grid"])
def test_storms_model_of_a_world_is_the_world(name: str, reachable: bool, tmp_path: Path) -> None:
    environment = loaded(name)
    check(environment.world, some_atoms(environment), tmp_path, reachable=reachable)


@pytest.mark.parametrize("seed", range(20))
def test_storms_model_of_an_explicit_world_is_the_world(seed: int, tmp_path: Path) -> None:
    world = load_environment(explicit_spec(random_world(seed))).world
    check(world, [Atom("a"), Atom("b")], tmp_path, reachable=bool(seed % 2))


def random_formula(pick: random.Random, depth: int) -> Formula:
    """Any LTL over a and b."""
    if depth == 0:
        return Atom(pick.choice("ab"))
    op = pick.choice(list(Op))
    operands = [random_formula(pick, depth - 1) for _ in range(2)]
    if op in (Op.AND, Op.OR):
        flat = [part for o in operands for part in (o.operands if isinstance(o, Nary) and o.op is op else (o,))]
        return Nary(op, tuple(flat))
    if op in (Op.NOT, Op.NEXT, Op.FINALLY, Op.GLOBALLY):
        return Unary(op, operands[0])
    return Binary(op, *operands)


@pytest.mark.parametrize("block", range(4))
def test_the_product_has_the_value_that_storm_finds_for_the_formula(block: int, tmp_path: Path) -> None:
    """Storm translates the formula itself: this checks the property's text, the product and its marks."""
    for seed in range(1_000 * block, 1_000 * block + 25):
        pick = random.Random(seed)
        world = random_world(seed)
        formula = random_formula(pick, pick.choice([1, 2, 3]))
        wanted = atoms(formula)
        direct = maximum(
            from_drn(drn_model(world, atoms=wanted), tmp_path), property_text(formula, label_names(wanted))
        )
        assert product_value(world, formula, tmp_path) == pytest.approx(direct, abs=1e-6), (seed, to_text(formula))


def product_value(world: World | ArrayWorld, formula: Formula, folder: Path) -> float:
    automaton = translate(formula)
    return maximum(from_drn(drn_product(world, automaton), folder), product_property(automaton))


@pytest.mark.parametrize("formula", TOYS_FORMULAS)
def test_products_of_toys(formula: str, tmp_path: Path) -> None:
    environment = load_environment(toys_spec(columns=3, slip=0.1))
    task = resolve(parse(formula), environment)
    labels = label_names(atoms(task))
    model = from_drn(drn_model(environment.world, atoms=atoms(task), reachable=True), tmp_path)
    direct = maximum(model, property_text(task, labels))
    assert product_value(environment.world, task, tmp_path) == pytest.approx(direct, abs=1e-6)


def test_a_product_remembers_the_marks_of_the_last_transition(tmp_path: Path) -> None:
    """In G F a the marks cannot be read off the automaton's states, of which there is one."""
    world = ArrayWorld(2, {0: {"go": {1: 1.0}}, 1: {"go": {0: 1.0}}}, {"a": frozenset({1})})
    automaton = translate(parse("G F a"))
    text = drn_product(world, automaton)
    model = from_drn(text, tmp_path)
    assert automaton.states == 1
    assert set(model.labeling.get_states("a")) == set(model.labeling.get_states("mark_0"))
    assert f"// {product_property(automaton)}\n" in text
    assert "//[world.state=1 & memory=0 & mark_0]\n" in text


def test_the_initial_label_is_read_first(tmp_path: Path) -> None:
    world = ArrayWorld(2, {0: {"go": {1: 1.0}}}, {"a": frozenset({0}), "b": frozenset({1})})
    for formula, value in [("a", 1.0), ("X b", 1.0), ("b", 0.0), ("X a", 0.0), ("X X b", 1.0)]:
        assert product_value(world, parse(formula), tmp_path) == value


def test_labels_of_atoms_keep_clear_of_those_of_the_product(tmp_path: Path) -> None:
    world = ArrayWorld(1, {}, {"accepting": frozenset({0}), "init": frozenset({0})})
    text = drn_product(world, translate(parse("F (accepting & init)")))
    labels = from_drn(text, tmp_path).labeling.get_labels()
    assert labels == {"init", "accepting", "rejecting", "accepting_2", "init_2"}
    assert "// label accepting_2 is accepting\n" in text


def test_comments_can_be_left_out() -> None:
    world = loaded("toys").world
    assert "//[" not in drn_model(world, comments=False)
    assert "//[" not in drn_product(world, translate(parse("true")), comments=False)


def test_the_text(tmp_path: Path) -> None:
    world = ArrayWorld(3, {0: {"go": {1: 0.25, 0: 0.75}, "sit down": {0: 1.0}}}, {"a": frozenset({1})}, name="small")
    assert drn_model(world, atoms=[Atom("a")], reachable=True).splitlines() == [
        "// small, written by cqltl",
        "// action sit_down is sit down",
        "@type: MDP",
        "@value_type: double",
        "@parameters",
        "",
        "@reward_models",
        "steps",
        "@nr_states",
        "2",
        "@nr_choices",
        "3",
        "@model",
        "state 0 [1] init",
        "//[world.state=0]",
        "\taction go",
        "\t\t0 : 0.75",
        "\t\t1 : 0.25",
        "\taction sit_down",
        "\t\t0 : 1",
        "state 1 [1] a",
        "//[world.state=1]",
        "\taction stay",
        "\t\t1 : 1",
    ]


def test_rewards_count_steps(tmp_path: Path) -> None:
    world = ArrayWorld(2, {0: {"go": {1: 0.25, 0: 0.75}}}, {"a": frozenset({1})})
    model = from_drn(drn_model(world, atoms=[Atom("a")]), tmp_path)
    assert maximum(model, 'R{"steps"}min=? [ F "a" ]') == pytest.approx(4)


def test_unknown_atoms_are_refused() -> None:
    with pytest.raises(UnknownPropositionError):
        drn_model(loaded("toys").world, atoms=[Atom("nonsense")])


def test_too_many_states_are_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    world: Any = loaded("toys").world
    for limit, call in [
        ("listing.MAX_EXPORT_STATES", lambda: drn_model(world)),
        ("listing.MAX_EXPORT_STATES", lambda: drn_model(world, reachable=True)),
        ("listing.MAX_SCANNED_STATES", lambda: drn_model(world)),
        ("listing.MAX_STATES", lambda: drn_model(world, reachable=True)),
        ("product.MAX_EXPORT_STATES", lambda: drn_product(world, translate(parse("X X true")))),
    ]:
        with monkeypatch.context() as patch:
            patch.setattr(f"models.interchange.{limit}", 20)
            with pytest.raises(ExportTooLargeError):
                call()


def test_a_world_too_large_for_planning_is_refused_state_by_state_only() -> None:
    environment = load_environment(toys_spec(columns=8, rows=7, toys=12))
    with pytest.raises(ExportTooLargeError, match="too large to be listed"):
        drn_model(environment.world, reachable=True)
    assert "[pick_box]" in prism_model(environment)

"""Environments in the PRISM language: the text, and Storm's model of it against the world."""

from __future__ import annotations

import random
from pathlib import Path

import numpy as np
import pytest

from models.interchange import ExportTooLargeError, label_names, prism_model, property_text
from models.interchange.grounded import GroundedModel
from models.interchange.names import action_names
from models.logic import Atom, Name, atoms, parse
from models.world import Environment, UnknownPropositionError, load_environment, resolve, toys_spec
from models.world.oomdp import OomdpWorld
from tests.interchange.environments import OOMDP, explicit_spec, loaded
from tests.interchange.isomorphism import (
    STUCK,
    assert_same,
    dynamics,
    fewest_steps,
    from_prism,
    maximum,
    reach_probability,
    storm_dynamics,
)
from tests.planning.doubles import random_world
from tests.world.worlds import TINY, changed

stormpy = pytest.importorskip("stormpy")


def some_atoms(environment: Environment, seed: int = 0, count: int = 12) -> list[Atom]:
    """Random applications of the environment's functions."""
    pick = random.Random(seed)
    found: list[Atom] = []
    for function in environment.functions.values():
        for _ in range(count):
            options = [environment.symbols(*sorted(parameter.kinds)) for parameter in function.parameters]
            if all(options):
                found.append(Atom(function.name, tuple(Name(pick.choice(symbols).name) for symbols in options)))
    return list(dict.fromkeys(found))


def world_states(environment: Environment, program: object, model: object) -> dict[int, int]:
    """Storm's number of a state to the world's, by the values of the module's variables."""
    world = environment.world
    variables = {v.name: v.expression_variable for m in program.modules for v in m.integer_variables}
    if not isinstance(world, OomdpWorld):
        return {s.id: model.state_valuations.get_int64_value(s.id, variables["s"]) for s in model.states}
    identifiers = GroundedModel(world).identifiers
    radix = [len(variable.values) for variable in world.variables]
    found = {}
    for state in model.states:
        digits = [
            model.state_valuations.get_int64_value(state.id, variables[identifiers[p]]) if p in identifiers else 0
            for p in range(len(radix))
        ]
        found[state.id] = int(np.ravel_multi_index(digits, radix))
    return found


def identifiers(environment: Environment) -> dict[str, str]:
    """The identifier of each action."""
    world = environment.world
    if not isinstance(world, OomdpWorld):
        return dict(zip((*world.actions, STUCK), action_names(world.actions, reserved=("s", "world")), strict=True))
    model = GroundedModel(world)
    return {command.name: command.identifier for command in model.commands()} | {STUCK: model.stay}


def check(environment: Environment, folder: Path, wanted: list[Atom]) -> None:
    """The same states, choices, probabilities, labels and initial state."""
    exact = isinstance(environment.world, OomdpWorld)
    program, model = from_prism(prism_model(environment, atoms=wanted), folder, exact=exact)
    states = world_states(environment, program, model)
    expected = dynamics(environment.world)
    actual, choices = storm_dynamics(model, states)
    assert_same(actual, expected, identifiers(environment))
    assert choices == sum(map(len, expected.values()))
    assert [states[state] for state in model.initial_states] == [environment.world.initial]
    reached = np.array(list(states.values()))
    truth = environment.world.labels(wanted, reached)
    for (_, label), holds in zip(label_names(wanted).items(), truth, strict=True):
        assert sorted(states[s] for s in model.labeling.get_states(label)) == sorted(reached[holds].tolist()), label


@pytest.mark.parametrize("name", OOMDP)
def test_storms_model_of_the_text_is_the_world(name: str, tmp_path: Path) -> None:
    environment = loaded(name)
    check(environment, tmp_path, some_atoms(environment))


@pytest.mark.parametrize("block", range(3))
def test_storms_model_of_an_explicit_environment_is_the_world(block: int, tmp_path: Path) -> None:
    for seed in range(block * 10, block * 10 + 10):
        check(load_environment(explicit_spec(random_world(seed))), tmp_path, [Atom("a"), Atom("b")])


@pytest.mark.parametrize("entries", [1, 64])
def test_what_is_not_simplified_means_the_same(entries: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("models.interchange.truth.MAX_COMBINATIONS", entries)
    monkeypatch.setattr("models.interchange.rendering._CHAINED", 2)
    monkeypatch.setattr("models.interchange.rendering._LISTED", 1)
    for name in ("toys", "chain", "switches", "awkward", "long navigation"):
        environment = loaded(name)
        check(environment, tmp_path, some_atoms(environment))


@pytest.mark.parametrize(
    ("name", "formula"),
    [
        ("toys", "F (in(cylinder, box) & at(box, bathroom))"),
        ("two toys", "F (at(sphere, kitchen) & holding(cylinder))"),
        ("walls", "F in(cylinder, box)"),
        ("navigation", "F at(robot, goal)"),
    ],
)
def test_probabilities_and_steps_are_those_of_the_world(name: str, formula: str, tmp_path: Path) -> None:
    environment = loaded(name)
    task = resolve(parse(formula), environment)
    wanted = atoms(task)
    labels = label_names(wanted)
    _, model = from_prism(prism_model(environment, atoms=wanted), tmp_path)
    moves = dynamics(environment.world)
    reached = np.array(list(moves))
    goal = reached[environment.world.labels(wanted, reached).all(axis=0)].tolist()
    start = environment.world.initial
    assert maximum(model, property_text(task, labels)) == pytest.approx(reach_probability(moves, goal)[start])
    conjunction = " & ".join(f'"{label}"' for label in labels.values())
    steps = maximum(model, f'R{{"steps"}}min=? [ F {conjunction} ]')
    assert steps == pytest.approx(fewest_steps(moves, goal, start), abs=1e-5)


def test_the_text_is_readable() -> None:
    environment = load_environment(toys_spec(columns=2, slip=0.1))
    wanted = [Atom("near", (Name("robot"), Name("box"))), Atom("in", (Name("cylinder"), Name("box")))]
    assert prism_model(environment, atoms=wanted) == (Path(__file__).with_name("toys.prism")).read_text()


def test_an_explicit_environment_as_text() -> None:
    assert prism_model(load_environment(TINY), atoms=[Atom("a")]).splitlines() == [
        "// tiny: explicit environment, written by cqltl",
        "mdp",
        "",
        "module world",
        "  s : [0..2] init 0;",
        "",
        "  [go] s = 0 -> 0.9 : (s' = 1) + 0.1 : (s' = 0);",
        "  [go] s = 1 -> (s' = 2);",
        "  [stay] s = 2 -> (s' = 2);",
        "endmodule",
        "",
        'label "a" = s = 1; // a',
        "",
        'rewards "steps"',
        "  true : 1;",
        "endrewards",
    ]


def test_a_stuck_state_of_an_explicit_environment_stays(tmp_path: Path) -> None:
    environment = load_environment(changed(TINY, ("transitions/2/from", 0), ("states", 1_500), ("labels/a", [1, 3, 4])))
    text = prism_model(environment, atoms=[Atom("a"), Atom("b")])
    assert "  [stay_2] s >= 2 -> true; // where nothing is possible\n" in text
    check(environment, tmp_path, [Atom("a"), Atom("b")])


def test_an_impossible_outcome_is_left_out() -> None:
    assert "slip / 2" not in prism_model(load_environment(toys_spec()))


def test_an_unknown_atom_is_refused() -> None:
    for environment in (loaded("toys"), load_environment(TINY)):
        with pytest.raises(UnknownPropositionError):
            prism_model(environment, atoms=[Atom("nonsense")])


def test_too_much_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    with monkeypatch.context() as patch:
        patch.setattr("models.interchange.conditions.MAX_PARTS", 50)
        with pytest.raises(ExportTooLargeError, match="DRN"):
            prism_model(loaded("toys"))
    for limit in ("models.interchange.rendering.MAX_CHARACTERS", "models.interchange.prism.MAX_CHARACTERS"):
        with monkeypatch.context() as patch:
            patch.setattr(limit, 100)
            with pytest.raises(ExportTooLargeError, match="100 characters"):
                prism_model(loaded("toys"))

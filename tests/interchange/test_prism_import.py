"""PRISM models as explicit environments: round trips, PRISM's features, and what is refused."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from models.interchange import (
    PrismConstantError,
    PrismModelError,
    PrismSyntaxError,
    StormMissingError,
    label_names,
    prism_model,
    read_prism,
)
from models.logic import Atom, atoms, parse
from models.world import Environment, load_environment, resolve
from tests.interchange.environments import OOMDP, explicit_spec, loaded
from tests.interchange.isomorphism import dynamics, fewest_steps, reach_probability
from tests.interchange.test_prism import some_atoms
from tests.planning.doubles import random_world

pytest.importorskip("stormpy")

TASKS = {
    "toys": "F in(cylinder, box)",
    "two toys": "F (at(sphere, kitchen) & holding(cylinder))",
    "walls": "F at(box, kitchen)",
    "navigation": "F at(robot, goal)",
    "switches": "F (lit(one) & lit(two))",
    "chain": "F together(x, y)",
}
OPEN = """mdp
const int N;
const double p;
const bool b;
module m
  x : [0..N] init 0;
  [go] b & x < N -> p : (x' = x + 1) + 1 - p : true;
endmodule
"""


def model(body: str, *, head: str = "mdp", variables: str = "x : [0..2] init 0;", after: str = "") -> str:
    return f"{head}\nmodule m\n{variables}\n{body}\nendmodule\n{after}"


def read(text: str, **options: Any) -> tuple[dict[str, Any], Environment]:
    data = read_prism(text, **options)
    return data, load_environment(data)


def by_state(data: dict[str, Any]) -> dict[int, dict[str, dict[int, float]]]:
    found: dict[int, dict[str, dict[int, float]]] = {state: {} for state in range(data["states"])}
    for transition in data["transitions"]:
        found[transition["from"]][transition["action"]] = dict(map(tuple, transition["to"]))
    return found


def values(environment: Environment, wanted: tuple[Atom, ...]) -> tuple[int, float, float]:
    """Reachable states, and the probability and steps (0 if unsure) to the states in which all atoms hold."""
    world = environment.world
    moves = dynamics(world)
    reached = np.array(list(moves))
    goal = reached[world.labels(wanted, reached).all(axis=0)].tolist()
    chance = reach_probability(moves, goal)[world.initial]
    steps = fewest_steps(moves, goal, world.initial, sweeps=5_000) if chance > 1 - 1e-9 else 0.0
    return len(moves), chance, steps


@pytest.mark.parametrize("name", TASKS)
def test_a_round_trip_keeps_the_values(name: str) -> None:
    environment = loaded(name)
    wanted = atoms(resolve(parse(TASKS[name]), environment))
    again = load_environment(read_prism(prism_model(environment, atoms=wanted), name="again"))
    renamed = tuple(Atom(label) for label in label_names(wanted).values())
    assert values(again, renamed) == pytest.approx(values(environment, wanted), abs=1e-9)


@pytest.mark.parametrize("name", OOMDP)
def test_a_second_round_trip_changes_nothing(name: str) -> None:
    environment = loaded(name)
    first = load_environment(read_prism(prism_model(environment, atoms=some_atoms(environment)), name="again"))
    wanted = [Atom(label) for label in first.functions]
    second = load_environment(read_prism(prism_model(first, atoms=wanted), name="again"))
    assert len(dynamics(first.world)) == len(dynamics(second.world))
    assert first.world.actions == second.world.actions or set(second.world.actions) - set(first.world.actions) == {
        "stay"
    }
    assert first.world.labels(wanted).sum(axis=1).tolist() == second.world.labels(wanted).sum(axis=1).tolist()


@given(st.integers(0, 10_000))
@settings(max_examples=25, deadline=None, suppress_health_check=list(HealthCheck))
def test_random_models_survive_a_round_trip(seed: int) -> None:
    environment = load_environment(explicit_spec(random_world(seed)))
    again = load_environment(read_prism(prism_model(environment, atoms=[Atom("a"), Atom("b")])))
    for atom in (Atom("a"), Atom("b")):
        assert values(environment, (atom,)) == pytest.approx(values(again, (atom,)), rel=1e-4, abs=1e-9)


def test_actions_labels_and_deadlocks() -> None:
    text = model(
        "[go] x = 0 -> 0.4 : (x' = 1) + 0.6 : true;\n[] x = 0 -> (x' = 2);\n[] x = 0 -> true;\n[go] x = 0 -> (x' = 1);",
        after='label "none" = x = 1; label "none_" = x > 0; label "X" = x = 0;',
    )
    data, _ = read(text)
    assert by_state(data) == {
        0: {"go": {0: 0.6, 1: 0.4}, "choice0": {2: 1.0}, "choice1": {0: 1.0}, "go_2": {1: 1.0}},
        1: {},
        2: {},
    }
    assert data["labels"] == {"none_2": [1], "none_": [1, 2], "X": [0]}
    assert (data["initial"], data["name"]) == (0, "prism")


def test_names_of_choices_never_meet() -> None:
    text = model(
        "[choice0] x = 0 -> true; [] x = 0 -> (x' = 1); [a_2] x = 0 -> true; [a] x = 0 -> true; [a] x = 0 -> true;"
    )
    data, _ = read(text)
    assert [t["action"] for t in data["transitions"]] == ["choice0", "choice1", "a_2", "a", "a_3"]


def test_a_dtmc_has_one_action() -> None:
    data, environment = read(model("[] x < 2 -> 0.5 : (x' = x + 1) + 0.5 : true;", head="dtmc"))
    assert environment.world.actions == ("step",)
    assert by_state(data)[0] == {"step": {0: 0.5, 1: 0.5}}


def test_synchronised_modules_and_formulas() -> None:
    text = (
        "mdp\nformula busy = x = 1;\nmodule m\n x : [0..1] init 0;\n [a] !busy -> (x' = 1);\nendmodule\n"
        'module n = m [x = y, y = x] endmodule\nlabel "both" = busy & y = 1;'
    )
    data, _ = read(text)
    assert by_state(data) == {0: {"a": {1: 1.0}}, 1: {}}
    assert data["labels"] == {"both": [1]}


def test_rounded_probabilities_are_scaled() -> None:
    data, _ = read(model("[a] x = 0 -> 0.333333 : (x' = 1) + 0.666667 : (x' = 2) + 0 : true;"))
    assert by_state(data)[0]["a"] == {1: 0.333333, 2: 0.666667}
    data, _ = read(model("[a] x = 0 -> 0.333333 : (x' = 1) + 0.66666 : (x' = 2);"))
    assert sum(by_state(data)[0]["a"].values()) == pytest.approx(1.0, abs=1e-15)


def test_constants() -> None:
    for constants in ({"N": 2, "p": 0.25, "b": True}, {"N": "2", "p": "1/4", "b": "true"}):
        data, _ = read(OPEN, constants=constants)
        assert data["states"] == 3
        assert by_state(data)[0]["go"] == {0: 0.75, 1: 0.25}
    assert read(OPEN, constants={"N": 3, "p": 1, "b": False})[0]["transitions"] == []


@pytest.mark.parametrize(
    ("constants", "message"),
    [
        ({}, "leaves constants open; give a value to N, p, b"),
        ({"N": 2, "b": True}, "give a value to p"),
        ({"N": 2, "p": 0.5, "b": True, "q": 1}, "no constant q is to be given: open are N, p, b"),
        ({"N": 2.5, "p": 0.5, "b": True}, "the constant N is a whole number, not 2.5"),
        ({"N": 2, "p": "x", "b": True}, "the constant p is a number, not x"),
        ({"N": 2, "p": True, "b": True}, "the constant p is a number, not True"),
        ({"N": 2, "p": 0.5, "b": "maybe"}, "the constant b is true or false, not maybe"),
        ({"N": 2, "p": "1/0", "b": True}, "the constant p is a number, not 1/0"),
        ({"N": 2, "p": "inf", "b": True}, "the constant p is a number, not inf"),
        ({"N": 2, "p": 1.5, "b": True}, "negative probabilities"),
    ],
)
def test_wrong_constants_are_refused(constants: dict[str, Any], message: str) -> None:
    with pytest.raises(PrismConstantError) as refusal:
        read_prism(OPEN, constants=constants)
    assert message in refusal.value.detail


def test_constants_of_a_model_without_open_ones_are_refused() -> None:
    with pytest.raises(PrismConstantError, match="the model leaves none open"):
        read_prism(model("[] true -> true;"), constants={"N": 1})


@pytest.mark.parametrize(
    ("text", "line", "column"),
    [
        ("", 1, 1),
        ("mdp\nmodule m\n\tx : [0..2 init 0;\nendmodule", 3, 12),
        ("mdp\nmodule m\n  \tx : [0..2] init 0;\n \t[] x = 1 -> zz (x' = 1);\nendmodule\n", 4, 15),
        (model("[] y = 1 -> true;"), 4, None),
    ],
)
def test_a_syntax_error_has_a_place(text: str, line: int, column: int | None) -> None:
    with pytest.raises(PrismSyntaxError) as refusal:
        read_prism(text)
    error = refusal.value
    assert error.line == line
    assert column in (None, error.column)
    assert error.detail.startswith(f"line {line}, column {error.column}: expecting ")
    shown, caret = (error.caret or "").split("\n")
    assert shown.strip() in text
    assert caret.strip() == "^"
    assert error.places[0].detail == error.detail


def test_a_refusal_of_storms_without_a_place() -> None:
    with pytest.raises(PrismSyntaxError, match="a variable that does not exist") as refusal:
        read_prism(model("[] x = 1 -> (y' = 1);"))
    assert refusal.value.line is refusal.value.caret is None


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (model("[] x = 0 -> 2 : (x' = 1);", head="ctmc"), "of type CTMC; only MDP and DTMC"),
        (model("[] x = 0 -> (x' = 1);", head="ma"), "of type MA"),
        (model("[] x = 0 -> (x' = 1);", head="pomdp\nobservables x endobservables"), "of type POMDP"),
        (model("[] x = 0 -> (x' = 1);", head="pta"), "of type PTA"),
        (
            model("[] true -> true;", variables="x : [0..2];", after="init x < 2 endinit"),
            "2 initial states; give it one",
        ),
        (model("[] true -> true;", variables="x : [0..2];", after="init x > 2 endinit"), "single initial state"),
        (model("[] x = 0 -> (x' = 5);"), "out-of-bounds value (5) for the variable 'x'"),
        (
            model("[a] x = 0 -> 0.4 : (x' = 1) + 0.5 : true;"),
            "the probabilities of a in state 0 are not between 0 and 1 with the sum 1, but 0.5, 0.4",
        ),
    ],
)
def test_other_models_are_refused(text: str, message: str) -> None:
    with pytest.raises(PrismModelError) as refusal:
        read_prism(text)
    assert message in refusal.value.detail


def test_too_large_a_model_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    text = model("[] x < 2 -> (x' = x + 1);")
    with monkeypatch.context() as patch:
        patch.setattr("models.interchange.prism_import.MAX_EXPLICIT_STATES", 2)
        with pytest.raises(PrismModelError, match="3 states; the limit is 2"):
            read_prism(text)
    with monkeypatch.context() as patch:
        patch.setattr("models.interchange.extraction.MAX_EXPLICIT_OUTCOMES", 1)
        with pytest.raises(PrismModelError, match="2 outcomes; the limit is 1"):
            read_prism(text)


def test_storm_stops_in_time(capfd: pytest.CaptureFixture[str]) -> None:
    text = model("[] true -> (x' = min(x + 1, 1000000000));", variables="x : [0..1000000000] init 0;")
    with pytest.raises(PrismModelError, match="takes longer than 1 s"):
        read_prism(text, timeout_s=1)
    assert read_prism(model("[] true -> true;"), timeout_s=5)["states"] == 1


def test_a_file_names_the_environment(tmp_path: Path) -> None:
    file = tmp_path / "two dice.nm"
    file.write_text(model("[] true -> true;"), encoding="utf-8")
    assert read_prism(file)["name"] == "two dice"
    assert read_prism(file, name="dice")["name"] == "dice"


def test_a_file_that_cannot_be_read_is_refused(tmp_path: Path) -> None:
    with pytest.raises(PrismModelError, match="No such file"):
        read_prism(tmp_path / "nowhere.prism")
    (tmp_path / "latin.prism").write_bytes(b"\xe9")
    with pytest.raises(PrismModelError, match="not UTF-8"):
        read_prism(tmp_path / "latin.prism")


def test_without_storm_there_is_a_hint(monkeypatch: pytest.MonkeyPatch) -> None:
    with monkeypatch.context() as patch:
        patch.setitem(sys.modules, "stormpy", None)
        with pytest.raises(StormMissingError, match=r"pip install 'cqltl\[prism\]'"):
            read_prism("mdp")
    with monkeypatch.context() as patch:
        patch.setitem(sys.modules, "stormpy", type(sys)("stormpy"))
        with pytest.raises(StormMissingError, match="not Storm's"):
            read_prism("mdp")


def test_storm_is_silent_and_its_log_level_restored(capfd: pytest.CaptureFixture[str]) -> None:
    import stormpy

    before = stormpy.developer.get_log_level()
    with pytest.raises(PrismSyntaxError):
        read_prism("nonsense")
    assert stormpy.developer.get_log_level() == before
    assert capfd.readouterr() == ("", "")

"""The dense solver against the sparse one, exact solutions by policy iteration, and its policy's Markov chain."""

from __future__ import annotations

from importlib import import_module
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from models.logic import Automaton, parse, translate
from models.planning import ModelTooLargeError, Options, Plan, check, dense, plan, sparse, to_bytes
from models.planning.options import no_progress
from models.planning.solution import Solution
from models.world import OomdpWorld, compile_world, load_environment, navigation_spec, toys_spec
from tests.planning import brute
from tests.planning.doubles import ArrayWorld
from tests.planning.random_tasks import Task, navigation_task, toys_task

module = import_module("models.planning.dense.solve")  # its name in the package is that of its function
WHOLE = Options(relevance=False)
ORDER = "F (in(cylinder, box) & F at(box, kitchen))"
TOUR = "F (at(box, kitchen) & F (at(box, bedroom) & F (at(robot, kitchen) & F in(cylinder, box))))"


def world_of(data: Any) -> OomdpWorld:
    world = compile_world(load_environment(data))
    assert isinstance(world, OomdpWorld)
    return world


@pytest.fixture(scope="module")
def rooms() -> OomdpWorld:
    return world_of(toys_spec(columns=3, rows=1, toys=1, slip=0.2))


def solutions(world: OomdpWorld, automaton: Automaton, start: int | None = None) -> tuple[Any, Solution | None]:
    """By the dense solver and by the sparse one."""
    begin = world.initial if start is None else start
    found, known = (
        solver.solve(world, automaton, begin, options=WHOLE, progress=no_progress) for solver in (dense, sparse)
    )
    return found, known


@pytest.fixture(autouse=True)
def patient(monkeypatch: pytest.MonkeyPatch) -> None:
    """Small worlds in which it creeps are otherwise left to the sparse solver."""
    monkeypatch.setattr(module, "SLOW", 10**9)


def compare(world: OomdpWorld, text: str) -> str:
    """The two agree in every state and memory; says how the dense one answered."""
    automaton = translate(parse(text))
    found, known = solutions(world, automaton)
    if found is dense.UNSURE:
        if known is not None:
            chance = known.probability[arising(automaton, known.letter, world.valid())]
            assert ((chance > 0) & (chance < 1 - 1e-9)).any(), "nothing is possible and not sure"
        return "unsure"
    if found is None or known is None:
        assert found is known
        return "impossible"
    assert (found.letter == known.letter).all()
    met = arising(automaton, found.letter, world.valid())
    assert found.probability[met] == pytest.approx(known.probability[met], abs=1e-9)
    assert found.expected_steps[met] == pytest.approx(known.expected_steps[met], rel=1e-7, abs=1e-9)
    assert (found.action[:, ~world.valid()] == -1).all()
    assert (found.lower, found.upper) == (1.0, 1.0)
    assert known.lower == pytest.approx(1.0, abs=1e-9)
    return "solved"


def arising(automaton: Automaton, letter: NDArray[Any], valid: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """[R, S] which memories that decide nothing there are after a state was read."""
    found = np.zeros((automaton.states, len(letter)), dtype=np.bool_)
    for memory in range(automaton.states):
        found[automaton.successors[memory, letter], np.arange(len(letter))] = True
    return found[~(automaton.accepting | automaton.rejecting)] & valid


def tasks(block: int) -> list[Task]:
    made = []
    for seed in range(block * 12, block * 12 + 12):
        made += [toys_task(seed, following=seed % 2 == 1), navigation_task(seed, following=seed % 3 == 1)]
    return made


@pytest.mark.parametrize("block", range(3))
def test_it_agrees_with_the_sparse_solver_everywhere(block: int) -> None:
    answers = [compare(task.world, task.text) for task in tasks(block)]
    assert answers.count("solved") >= 8
    assert answers.count("unsure") >= 1


@pytest.mark.parametrize("block", range(3))
def test_plans_are_exact_and_their_policies_attain_them(block: int, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sparse, "solve", lambda *_arguments, **_named: None)
    solved = 0
    for task in tasks(block):
        answer = task.answer
        if answer.probability < 1 - 1e-12 and answer.probability > 0:
            continue
        result = plan(task.world, parse(task.text), options=WHOLE)
        if dense_applies(task):
            assert (result.outcome == "solved") == (answer.probability > 0)
            solved += exact(task.world, result, answer)
    assert solved >= 8


def dense_applies(task: Task) -> bool:
    automaton = translate(parse(task.text))
    found = dense.solve(task.world, automaton, task.world.initial, options=WHOLE, progress=no_progress)
    return found is not dense.UNSURE


def exact(world: OomdpWorld, result: Plan, answer: brute.Answer) -> bool:
    """The plan's bounds hold the exact values, and its policy is worth what it says."""
    if result.policy is None or result.expected_steps is None or result.expected_steps_upper is None:
        return False
    slack = 1e-9 * (1 + answer.steps)
    assert result.expected_steps - slack <= answer.steps <= result.expected_steps_upper + slack
    assert result.expected_steps_upper == pytest.approx(answer.steps, rel=1e-6)
    found = check(world, result.policy)
    assert found.sound
    assert found.probability == pytest.approx(1.0, abs=1e-9)
    assert result.expected_steps - slack <= found.expected_steps <= result.expected_steps_upper + slack
    return True


@pytest.mark.parametrize(("formula", "live"), [(ORDER, 2), (TOUR, 4), ("F (holding(box) & X X holding(box))", 4)])
def test_formulas_with_several_memories(rooms: OomdpWorld, formula: str, live: int) -> None:
    automaton = translate(parse(formula))
    assert np.count_nonzero(~automaton.accepting & ~automaton.rejecting) == live
    assert compare(rooms, formula) == "solved"
    result = plan(rooms, parse(formula), options=WHOLE)
    assert result.policy is not None
    assert check(rooms, result.policy).expected_steps == pytest.approx(result.expected_steps, rel=1e-7)


@pytest.mark.parametrize("length", [1, 5, 12, 60])
def test_the_length_of_rows_changes_nothing(rooms: OomdpWorld, length: int, monkeypatch: pytest.MonkeyPatch) -> None:
    known, _ = solutions(rooms, translate(parse(ORDER)))
    monkeypatch.setattr("models.planning.dense.tables.LENGTH", length)
    found, _ = solutions(rooms, translate(parse(ORDER)))
    assert (found.action == known.action).all()
    assert found.expected_steps == pytest.approx(known.expected_steps, rel=1e-9)


# Where it does not apply, and what there is nothing to do about.


def test_what_is_possible_but_not_sure_is_left_to_the_other() -> None:
    world = world_of(navigation_spec(columns=3, rows=1, slip=0.2))
    automaton = translate(parse("X X at(robot, goal)"))
    found, known = solutions(world, automaton)
    assert found is dense.UNSURE
    assert known is not None
    assert known.lower == pytest.approx(0.64)
    result = plan(world, automaton.formula)
    assert result.lower == pytest.approx(known.lower)


def test_other_formulas_worlds_and_devices_are_left_to_the_other(rooms: OomdpWorld) -> None:
    def answer(world: Any, text: str, options: Options = WHOLE) -> Any:
        return dense.solve(world, translate(parse(text)), 0, options=options, progress=no_progress)

    assert answer(rooms, "G F at(robot, kitchen)") is dense.UNSURE
    assert answer(rooms, "G at(robot, kitchen)") is dense.UNSURE
    assert answer(rooms, ORDER, Options(device="cuda")) is dense.UNSURE
    assert answer(ArrayWorld(1, {0: {"go": {0: 1.0}}}, {"a": frozenset({0})}), "F a") is dense.UNSURE


def test_what_cannot_be_reached_has_no_solution(rooms: OomdpWorld) -> None:
    assert solutions(rooms, translate(parse("F (at(robot, kitchen) & at(robot, bedroom))"))) == (None, None)
    decided = translate(parse("!at(robot, kitchen)"))  # decided by the label of the start
    assert solutions(rooms, decided) == (None, None)


def test_what_holds_at_once_takes_no_steps(rooms: OomdpWorld) -> None:
    for formula in ("F at(robot, kitchen)", "at(robot, kitchen)", "true", "F true"):
        result = plan(rooms, parse(formula), options=WHOLE)
        assert (result.outcome, result.lower, result.expected_steps) == ("solved", 1.0, 0.0)
        assert result.policy is not None
        step = result.policy.step(rooms.initial, result.initial_memory)
        assert (step.status, step.expected_steps) == ("satisfied", 0.0)


# Limits, cancelling, determinism.


def test_too_much_memory_is_refused_before_anything_is_made(rooms: OomdpWorld, monkeypatch: pytest.MonkeyPatch) -> None:
    def untouched(*_arguments: Any) -> Any:
        raise AssertionError("made in spite of the limit")

    monkeypatch.setattr(module, "compress", untouched)
    monkeypatch.setattr(OomdpWorld, "labels", untouched)
    automaton = translate(parse(ORDER))
    with pytest.raises(ModelTooLargeError) as caught:
        dense.solve(rooms, automaton, rooms.initial, options=Options(max_bytes=1_000), progress=no_progress)
    assert caught.value.slug == "model-too-large"


def test_the_estimate_covers_what_the_arrays_take(rooms: OomdpWorld, monkeypatch: pytest.MonkeyPatch) -> None:
    """A world with many actions has many entries for each state."""
    made: list[int] = []
    real = module.compress

    def measured(*arguments: Any) -> Any:
        found = real(*arguments)
        made.append(sum(array.nbytes for array in found.rows[1:]) + found.valid.nbytes)
        return found

    monkeypatch.setattr(module, "compress", measured)
    world = dials(30)
    automaton = translate(parse("F done"))
    with pytest.raises(ModelTooLargeError) as caught:
        dense.solve(world, automaton, world.initial, options=Options(max_bytes=1), progress=no_progress)
    dense.solve(world, automaton, world.initial, options=WHOLE, progress=no_progress)
    assert made[0] + 20 * world.size <= caught.value.estimate


def dials(positions: int) -> OomdpWorld:
    """Two dials, each turned from any position to any other one."""
    return world_of(
        {
            "name": "dials",
            "kind": "oomdp",
            "domain_spec": {
                "name": "dials",
                "attributes": {"position": [f"p{i}" for i in range(positions)]},
                "classes": {"dial": {"state": {"at": "position"}}},
                "functions": {"done": {"is": "all(x: dial; x.at == p0)"}},
                "actions": {
                    "turn": {"arguments": ["x: dial", "p: position"], "outcomes": [{"set": {"x.at": "p"}}]},
                },
            },
            "objects": {"left": {"class": "dial"}, "right": {"class": "dial"}},
            "state": {"left": {"at": "p1"}, "right": {"at": "p2"}},
        }
    )


class StopError(Exception):
    pass


@pytest.mark.parametrize("stage", ["graph", "steps"])
def test_an_exception_from_progress_cancels(rooms: OomdpWorld, stage: str) -> None:
    heard: list[str] = []

    def stop(name: str, sweep: int, _lower: float, _upper: float, _states: int, _left: float = 0) -> None:
        heard.append(name)
        if name == stage and sweep == 2:
            raise StopError

    with pytest.raises(StopError):
        dense.solve(rooms, translate(parse(ORDER)), rooms.initial, options=WHOLE, progress=stop)
    assert heard[-2:] == [stage, stage]


@pytest.mark.parametrize("sweeps", [1, 2, 5])
def test_what_is_cut_short_says_so_and_its_bounds_hold(sweeps: int) -> None:
    cut = 0
    for seed in range(20):
        world = world_of(toys_spec(columns=3, rows=2 + seed % 2, toys=1, slip=0.5, seed=seed))
        exactly = plan(world, parse(ORDER), options=WHOLE)
        result = plan(world, parse(ORDER), options=Options(relevance=False, max_sweeps=sweeps))
        if exactly.expected_steps is None or result.expected_steps is None or result.policy is None:
            continue
        assert result.expected_steps <= exactly.expected_steps * (1 + 1e-9)
        assert result.expected_steps_upper is not None
        assert result.expected_steps_upper >= exactly.expected_steps * (1 - 1e-9)
        found = check(world, result.policy)
        assert found.probability >= result.lower - 1e-9
        assert found.expected_steps <= result.expected_steps_upper * (1 + 1e-9)
        cut += result.expected_steps_upper == np.inf or result.expected_steps_upper > 1.001 * result.expected_steps
    assert cut >= 3


def test_a_policy_gets_there_however_rarely_an_action_succeeds() -> None:
    """To grasp and to stay idle are worth the same but for a relative difference of 1e-12."""
    world = world_of(toys_spec(columns=2, rows=1, toys=1, slip=1 - 1e-12))
    result = plan(world, parse("F in(cylinder, box)"), options=Options(relevance=False, max_sweeps=100))
    assert result.policy is not None
    assert result.expected_steps_upper is not None
    assert result.expected_steps_upper > 1e11
    assert check(world, result.policy).probability >= result.lower - 1e-6


def test_the_same_input_gives_the_same_bytes() -> None:
    for seed in range(6):
        made = []
        for _ in range(2):
            task = toys_task(seed)
            result = plan(task.world, parse(task.text), options=WHOLE)
            made.append(None if result.policy is None else to_bytes(result.policy))
        assert made[0] == made[1]


def test_a_small_world_in_which_it_creeps_is_left_to_the_sparse_solver(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, "SLOW", 200)
    world = world_of(toys_spec(columns=4, rows=1, toys=1, slip=0.999999))
    automaton = translate(parse("F in(cylinder, box)"))
    assert dense.solve(world, automaton, world.initial, options=WHOLE) is dense.UNSURE
    result = plan(world, parse("F in(cylinder, box)"), options=WHOLE)
    assert result.policy is not None
    assert check(world, result.policy).expected_steps == pytest.approx(result.expected_steps, rel=1e-6)

"""The most probable run that satisfies the formula, against plain searches over the world's own dynamics."""

from __future__ import annotations

import heapq
import random
from dataclasses import replace
from itertools import pairwise
from math import prod

import pytest

from models.logic import parse, translate
from models.planning import Policy, Trajectory, plan
from models.planning import trajectory as module
from models.planning.chain import explore
from models.planning.trajectory import most_probable_run
from models.world import World, compile_world, load_environment, toys_spec
from tests.planning import brute
from tests.planning.doubles import ArrayWorld, Transitions, random_world
from tests.planning.test_random_models import random_formula


def run_of(moves: Transitions, goal: int, *, formula: str = "F a", size: int = 0) -> Trajectory:
    model = ArrayWorld(size or goal + 1, moves, {"a": frozenset({goal})})
    found = plan(model, parse(formula)).trajectory
    assert found is not None
    return found


def states(found: Trajectory) -> list[int]:
    return [step.state for step in found.steps]


def test_a_likelier_way_back_does_not_lead_astray() -> None:
    found = run_of({0: {"go": {1: 0.6, 3: 0.4}}, 1: {"back": {0: 1.0}}}, 3)
    assert (states(found), found.complete, found.probability) == ([0, 3], True, 0.4)


def test_the_whole_run_counts_not_its_first_step() -> None:
    branches = range(3, 12)
    moves = {0: {"go": {1: 0.6, 2: 0.4}}, 1: {"go": dict.fromkeys(branches, 1 / 9)}}
    found = run_of(moves | {s: {"go": {12: 1.0}} for s in (2, *branches)}, 12)
    assert (states(found), found.complete, found.probability) == ([0, 2, 12], True, 0.4)


def test_runs_that_end_in_different_states_are_different_runs() -> None:
    moves = {0: {"go": {1: 0.55, 2: 0.45}}, 1: {"go": {3: 0.5, 4: 0.5}}, 2: {"go": {5: 0.9, 6: 0.1}}}
    found = plan(ArrayWorld(7, moves, {"a": frozenset({3, 4, 5})}), parse("F a")).trajectory
    assert found is not None
    assert states(found) == [0, 2, 5]
    assert found.probability == pytest.approx(0.405)


def test_of_equally_probable_runs_the_shorter_one() -> None:
    found = run_of({0: {"try": {0: 0.8, 1: 0.1, 2: 0.1}}, 1: {"go": {2: 1.0}}}, 2)
    assert (states(found), found.probability) == ([0, 2], 0.1)


def test_a_run_may_visit_a_state_again_with_another_memory() -> None:
    moves = {0: {"on": {1: 1.0}}, 1: {"back": {0: 1.0}, "stay": {1: 1.0}}}
    found = run_of(moves, 1, formula="F (a & X (!a & X a))")
    assert states(found) == [0, 1, 0, 1]
    assert found.complete


def test_what_is_satisfied_at_once_takes_one_step() -> None:
    found = run_of({0: {"go": {0: 1.0}}}, 0)
    assert (states(found), found.steps[0].action, found.complete, found.probability) == ([0], None, True, 1.0)


def test_a_run_that_ends_waiting_has_no_action_there() -> None:
    found = run_of({0: {"go": {1: 1.0}}}, 1, formula="F (a & X a)")
    assert [(step.state, step.action) for step in found.steps] == [(0, "go"), (1, None), (1, None)]


@pytest.mark.parametrize(("longest", "complete"), [(4, False), (5, True), (6, True)])
def test_a_run_is_cut_at_the_limit(monkeypatch: pytest.MonkeyPatch, longest: int, complete: bool) -> None:
    monkeypatch.setattr(module, "MAX_LENGTH", longest)
    found = run_of({s: {"go": {s + 1: 0.5, 6: 0.5}} for s in range(5)}, 5, size=7)
    assert states(found) == list(range(6 if complete else 4))
    assert all(step.action == "go" for step in found.steps[:5])
    assert (found.complete, found.probability) == (complete, 0.5 ** (len(found.steps) - 1))


def test_a_policy_that_never_succeeds_has_no_run_to_show() -> None:
    """As of a plan that was cut short: the trap is nearest."""
    world = ArrayWorld(3, {0: {"fall": {2: 1.0}, "walk": {1: 0.9, 2: 0.1}}}, {"a": frozenset({1})})
    result = plan(world, parse("F a"))
    assert result.policy is not None
    fall = result.policy.action.copy()
    fall[:, 0] = world.actions.index("fall")
    policy = replace(result.policy, action=fall)
    found = most_probable_run(explore(world, policy), policy, translate(parse("F a")))
    assert (states(found), found.complete, found.probability) == ([0], False, 1.0)


def most_probable(world: ArrayWorld, policy: Policy) -> float:
    """The probability of the likeliest satisfying run: Dijkstra on products, on the policy's own answers."""
    best: dict[tuple[int, int], float] = {}
    queue = [(-1.0, world.initial, policy.initial_memory)]
    while queue:
        negative, state, memory = heapq.heappop(queue)
        if (state, memory) in best:
            continue
        best[state, memory] = -negative
        step = policy.step(state, memory)
        if step.done:
            return -negative
        if step.status == "running":
            moves = {state: 1.0} if step.action is None else world.transitions[state][step.action]
            for target, chance in moves.items():
                heapq.heappush(queue, (negative * chance, target, step.memory))
    return 0.0


@pytest.mark.parametrize("block", range(5))
def test_it_is_as_probable_as_any_run_of_random_policies(block: int) -> None:
    longest = 0
    for seed in range(block * 40, block * 40 + 40):
        world = random_world(seed)
        formula = ("and", *(("F", random_formula(random.Random(s), 1 + (s < 0))) for s in (seed, -seed)))
        result = plan(world, parse(brute.text(formula)))
        if result.policy is None or result.trajectory is None:
            continue
        found = result.trajectory
        assert found.complete
        assert (found.steps[0].state, found.steps[0].memory) == (world.initial, result.initial_memory)
        chances = []
        for here, there in pairwise(found.steps):
            step = result.policy.step(here.state, here.memory)
            assert (step.action, step.memory, step.status) == (here.action, there.memory, "running")
            moves = {here.state: 1.0} if here.action is None else world.transitions[here.state][here.action]
            chances.append(moves[there.state])
        last = found.steps[-1]
        assert last.action is None
        assert result.policy.step(last.state, last.memory).done
        assert found.probability == pytest.approx(prod(chances))
        assert found.probability == pytest.approx(most_probable(world, result.policy), rel=1e-6)
        longest = max(longest, len(chances))
    assert longest >= 3  # the block has runs in which there is something to choose


def test_in_toys_every_step_is_the_intended_one() -> None:
    world: World = compile_world(load_environment(toys_spec(columns=3, rows=1, toys=1, slip=0.2)))
    result = plan(world, parse("F (in(cylinder, box) & F at(box, kitchen))"))
    assert result.trajectory is not None
    assert result.trajectory.complete
    assert result.policy is not None
    last = result.trajectory.steps[-1]
    assert world.decode(last.state)["box"]["in"] == "kitchen"
    assert result.trajectory == plan(world, parse("F (in(cylinder, box) & F at(box, kitchen))")).trajectory

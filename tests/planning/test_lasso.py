"""Trajectories that go on for ever satisfy their formula, by an evaluator that knows nothing of automata."""

from __future__ import annotations

import random
from dataclasses import replace
from itertools import pairwise
from math import prod

import numpy as np
import pytest

from models.logic import Atom, Formula, parse, translate
from models.planning import Policy, Trajectory, check, plan
from models.planning.chain import explore
from models.planning.lasso import bottoms, circle
from models.world import compile_world, load_environment, toys_spec
from tests.logic.lasso import holds
from tests.planning.doubles import ArrayWorld, random_world

LASTING = (
    "G F a",
    "F G a",
    "G F a & G F b",
    "F G a | G F b",
    "F G !a",
    "G F a & F G !b",
    "G F a -> G F b",
    "(G F a & F G !c) | (G F b & F G !a)",
    "F a & G F b",
    "G (a -> F b)",
    "G F (a & X b)",
    "F G (a | X b)",
    "!c U (a & G F b)",
    "G F a & G F b & G F c",
    "(G F a <-> F G b) | F c",
    "G (a -> X !a) & G F a",
    "a R (b | X a) | G F c",
)


def label(world: ArrayWorld, state: int) -> frozenset[Atom]:
    return frozenset(Atom(name) for name, states in world.holds.items() if state in states)


def chance(world: ArrayWorld, state: int, action: str | None, target: int) -> float:
    """Of coming to `target`; to wait is to stay, and only possible where there is nothing to do."""
    if action is None:
        assert not world.transitions[state]
        return float(target == state)
    return world.transitions[state][action].get(target, 0.0)


def check_run(world: ArrayWorld, formula: Formula, policy: Policy, found: Trajectory) -> str:
    """The run is one of the policy's and satisfies the formula; says how it ends."""
    assert found.complete
    assert (found.steps[0].state, found.steps[0].memory) == (world.initial, policy.initial_memory)
    chances, statuses = [], []
    for here, there in pairwise(found.steps):
        step = policy.step(here.state, here.memory)
        assert (step.action, step.memory) == (here.action, there.memory)
        chances.append(chance(world, here.state, here.action, there.state))
        statuses.append(step.status)
    assert all(one > 0 for one in chances)
    last = policy.step(found.steps[-1].state, found.steps[-1].memory)
    decided = [*statuses, last.status].index("sustaining" if found.loop is not None else "satisfied")
    assert statuses[:decided] == ["running"] * decided
    assert found.probability == pytest.approx(prod(chances[:decided]))
    word = [label(world, step.state) for step in found.steps]
    if found.loop is None:
        assert last.status == "satisfied"
        assert holds(formula, word, [frozenset()])
        assert holds(formula, word, [frozenset(map(Atom, "abc"))])
        return "satisfied"
    # The circle closes: the last step stands again at the state, and reads it into the memory, of step `loop`.
    first, again = found.steps[found.loop], found.steps[-1]
    assert found.loop < len(found.steps) - 1
    assert (first.state, first.action) == (again.state, again.action)
    assert policy.step(first.state, first.memory).memory == last.memory
    assert holds(formula, word[: found.loop], word[found.loop : -1])
    return "circle"


@pytest.mark.parametrize("block", range(8))
def test_runs_of_random_policies_satisfy_the_formula(block: int) -> None:
    ends = []
    for seed in range(block * 40, block * 40 + 40):
        world = random_world(seed, atoms="abc")
        formula = parse(LASTING[seed % len(LASTING)])
        result = plan(world, formula)
        if result.policy is not None:
            assert result.trajectory is not None
            ends.append(check_run(world, formula, result.policy, result.trajectory))
    assert ends.count("circle") >= 10


@pytest.mark.parametrize("seed", range(30))
def test_runs_in_larger_worlds(seed: int) -> None:
    pick = random.Random(seed)
    moves = {
        state: {
            name: dict.fromkeys(pick.sample(range(60), pick.choice([1, 2, 3])), 0.0)
            for name in "pq"[: pick.choice([1, 2])]
        }
        for state in range(60)
    }
    moves = {s: {n: dict.fromkeys(m, 1 / len(m)) for n, m in choices.items()} for s, choices in moves.items()}
    world = ArrayWorld(60, moves, {name: frozenset(pick.sample(range(60), 6)) for name in "abc"})
    formula = parse(LASTING[seed % len(LASTING)])
    result = plan(world, formula)
    if result.policy is None:
        assert result.upper == 0
        return
    assert result.trajectory is not None
    check_run(world, formula, result.policy, result.trajectory)


@pytest.mark.parametrize("seed", range(40))
def test_a_component_is_accepted_when_its_policy_is(seed: int) -> None:
    """Bottom components of a chain, against the shares of runs that `check` and the plan come to."""
    world = random_world(seed, atoms="abc")
    formula = parse(LASTING[seed % len(LASTING)])
    result = plan(world, formula)
    if result.policy is None:
        return
    automaton = translate(formula)
    chain = explore(world, result.policy)
    found = bottoms(chain, result.policy, automaton)
    inside = found.label[chain.source]
    leaving = (inside >= 0) & (found.label[chain.target] != inside)
    assert not leaving.any(), "runs do not leave a bottom component"
    assert check(world, result.policy).probability == pytest.approx(result.lower, abs=1e-6)
    around = circle(chain, found, 0, -np.log(chain.probability) + 1e-9)
    assert (around is None) == (not found.accepted[found.label[found.label >= 0]].any())


def test_the_shortest_circle_is_taken_with_the_marks_it_needs() -> None:
    moves = {0: {"go": {1: 1.0}}, 1: {"go": {2: 1.0}}, 2: {"back": {1: 1.0}, "round": {3: 1.0}}, 3: {"go": {1: 1.0}}}
    world = ArrayWorld(4, moves, {"a": frozenset({2}), "b": frozenset({3}), "c": frozenset()})
    for formula, circle_of in (("G F a", [1, 2]), ("G F b", [1, 2, 3])):
        found = plan(world, parse(formula)).trajectory
        assert found is not None
        assert found.loop is not None
        assert sorted(step.state for step in found.steps[found.loop : -1]) == circle_of
        assert found.probability == 1.0


def test_a_stuck_state_is_a_circle_of_its_own() -> None:
    world = ArrayWorld(2, {0: {"go": {1: 1.0}}}, {"a": frozenset({1}), "b": frozenset(), "c": frozenset()})
    found = plan(world, parse("G F a")).trajectory
    assert found is not None
    assert ([step.state for step in found.steps][-2:], found.steps[-1].action) == ([1, 1], None)


def test_patrolling_toys() -> None:
    world = compile_world(load_environment(toys_spec(columns=3, rows=1, toys=1, slip=0.2)))
    formula = parse("G F at(robot, kitchen) & G F at(box, bathroom) & G F at(box, kitchen)")
    result = plan(world, formula)
    found = result.trajectory
    assert result.policy is not None
    assert found is not None
    assert found.loop is not None
    atoms = translate(formula).atoms
    labels = world.labels(atoms, np.array([step.state for step in found.steps]))
    word = [frozenset(atom for atom, on in zip(atoms, column, strict=True) if on) for column in labels.T]
    assert holds(formula, word[: found.loop], word[found.loop : -1])
    for here, there in pairwise(found.steps):
        assert here.action is not None
        outcomes = world.outcomes(world.actions.index(here.action), np.array([here.state]))
        assert outcomes.probability[outcomes.successor[:, 0] == there.state, 0].sum() > 0


@pytest.mark.parametrize(
    ("formula", "accepted"), [("F G a", False), ("F G !a", False), ("G F a & F G !b", True), ("G F a & F G !c", False)]
)
def test_a_policy_that_goes_round_where_it_must_not_is_found_out(formula: str, accepted: bool) -> None:
    """Whatever was planned, round 0 and 1 it goes: a again and again but not always, b never, c again and again."""
    moves = {0: {"go": {1: 1.0}, "stay": {0: 1.0}}, 1: {"go": {0: 1.0}, "stay": {1: 1.0}}}
    planned = ArrayWorld(2, moves, {"a": frozenset({0}), "b": frozenset(), "c": frozenset({1})})
    policy = plan(planned, parse(formula)).policy
    assert policy is not None
    going = replace(policy, action=np.zeros_like(policy.action))
    chain = explore(planned, going)
    found = bottoms(chain, going, translate(parse(formula)))
    assert found.accepted[found.label[found.label >= 0]].tolist() == [accepted] * 2
    assert check(planned, going).probability == float(accepted)
    assert (circle(chain, found, 0, np.ones(len(chain.target))) is not None) == accepted

"""The shortest rounds against linear programming, and by hand."""

from __future__ import annotations

import random

import numpy as np
import pytest
from scipy.optimize import linprog

from models.logic import parse
from models.planning import Options, plan
from tests.planning.doubles import ArrayWorld, Transitions


def communicating(seed: int) -> ArrayWorld:
    """A random MDP whose states all lead to each other: one end component."""
    pick = random.Random(seed)
    size = pick.randint(2, 25)
    moves: dict[int, dict[str, dict[int, float]]] = {}
    for state in range(size):
        moves[state] = {}
        for action in range(pick.randint(1, 3)):
            targets = dict.fromkeys([(state + 1) % size, *pick.sample(range(size), pick.randint(0, min(2, size)))])
            weights = [pick.choice([1, 2, 5]) for _ in targets]
            moves[state][f"a{action}"] = {t: w / sum(weights) for t, w in zip(targets, weights, strict=True)}
    marked = frozenset(pick.sample(range(size), max(1, size // 6)))
    return ArrayWorld(size, moves, {"a": marked}, initial=0)


def most_visits(world: ArrayWorld) -> float:
    """The greatest long-run share of steps that enter `a`: the dual linear program of the average-reward MDP
    (Puterman, "Markov Decision Processes", 8.8).
    """
    pairs = [(state, move) for state, moves in world.transitions.items() for move in moves.values()]
    balance = np.zeros((world.size + 1, len(pairs)))
    reward = np.zeros(len(pairs))
    for column, (state, move) in enumerate(pairs):
        balance[state, column] += 1
        balance[world.size, column] = 1
        for target, chance in move.items():
            balance[target, column] -= chance
            reward[column] += chance * (target in world.holds["a"])
    right = np.append(np.zeros(world.size), 1.0)
    found = linprog(-reward, A_eq=balance, b_eq=right, bounds=(0, None))
    assert found.success
    return float(-found.fun)


@pytest.mark.parametrize("block", range(4))
def test_rounds_are_as_short_as_linear_programming_says(block: int) -> None:
    for seed in range(block * 15, block * 15 + 15):
        world = communicating(seed)
        answer = plan(world, parse("G F a"))
        assert answer.round_steps is not None
        least, most = answer.round_steps
        truth = 1.0 / most_visits(world)
        assert least <= truth * (1 + 1e-7), seed
        assert most >= truth * (1 - 1e-7), seed
        assert most - least <= 1e-6 * most, seed


def ring(size: int) -> Transitions:
    return {state: {"on": {(state + 1) % size: 1.0}} for state in range(size)}


@pytest.mark.parametrize("size", [3, 40, 300, 2_000])
def test_a_long_round_is_as_long_as_it_is(size: int) -> None:
    answer = plan(ArrayWorld(size, ring(size), {"a": frozenset({size - 1})}), parse("G F a"))
    assert answer.round_steps == pytest.approx((size, size), rel=1e-6)


def test_the_way_to_the_round_loses_nothing() -> None:
    # Two rings of the same length, and a detour that leads from one into the other.
    rings = {0: {"on": {1: 1.0}, "detour": {4: 1.0}}, 1: {"on": {2: 1.0}}, 2: {"on": {0: 1.0}}}
    others = {3: {"on": {5: 1.0}, "back": {0: 1.0}}, 4: {"on": {3: 1.0}}, 5: {"on": {6: 1.0}}, 6: {"on": {3: 1.0}}}
    answer = plan(ArrayWorld(7, {**rings, **others}, {"a": frozenset({2, 6})}), parse("G F a"))
    assert answer.policy is not None
    assert answer.policy.step(0, answer.initial_memory).action == "on"
    assert answer.policy.step(3, answer.initial_memory).action == "on"


def test_what_is_cut_short_says_so_and_still_goes_round() -> None:
    answer = plan(ArrayWorld(50, ring(50), {"a": frozenset({49})}), parse("G F a"), options=Options(max_sweeps=2))
    assert answer.policy is not None
    assert answer.round_steps is not None
    assert answer.round_steps[0] <= 50 <= answer.round_steps[1]
    assert answer.policy.step(7, answer.initial_memory).action == "on"

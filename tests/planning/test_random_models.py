"""Random MDPs with traps, end components and unreachable parts, and random co-safe formulas, against exact
solutions.
"""

from __future__ import annotations

import random

import pytest

from models.logic import parse
from models.planning import Options, Policy, plan, to_bytes
from models.planning.options import Device
from tests.planning import brute
from tests.planning.doubles import DEVICES, ArrayWorld, random_world


def random_formula(pick: random.Random, depth: int) -> brute.LTL:
    """A co-safe formula; mostly eventualities, so that not everything is decided at once."""
    if depth == 0:
        return (pick.choice(["ap", "not"]), pick.choice("ab"))
    match pick.randrange(8):
        case 0:
            return ("and", random_formula(pick, depth - 1), random_formula(pick, depth - 1))
        case 1:
            return ("or", random_formula(pick, depth - 1), random_formula(pick, depth - 1))
        case 2:
            return ("X", random_formula(pick, depth - 1))
        case 3 | 4:
            return ("F", random_formula(pick, depth - 1))
        case _:
            return ("U", random_formula(pick, depth - 1), random_formula(pick, depth - 1))


def solve(world: ArrayWorld, formula: brute.LTL) -> brute.Answer:
    return brute.solve(
        lambda s: world.transitions[s],
        lambda s: frozenset(n for n, states in world.holds.items() if s in states),
        world.initial,
        formula,
    )


@pytest.mark.parametrize("device", DEVICES)
@pytest.mark.parametrize("block", range(10))
def test_values_equal_the_exact_ones(block: int, device: Device) -> None:
    between = 0
    for seed in range(block * 40, block * 40 + 40):
        world = random_world(seed)
        formula = (
            "U",
            random_formula(random.Random(seed), 1),
            random_formula(random.Random(-seed), 1 + seed % 2),
        )
        answer = solve(world, formula)
        result = plan(world, parse(brute.text(formula)), options=Options(device=device))
        assert result.lower - 1e-11 <= answer.probability <= result.upper + 1e-11, seed
        assert result.upper - result.lower <= 1e-6, seed
        assert (result.outcome == "solved") == (answer.probability > 0), seed
        if result.outcome == "solved":
            assert result.expected_steps == pytest.approx(answer.steps, rel=1e-6, abs=1e-7), seed
            assert result.policy is not None
            _check_every_reachable_value(world, result.policy, formula, answer)
        between += 0 < answer.probability < 1
    assert between >= 2  # the block exercises probabilities that are neither 0 nor 1


def _check_every_reachable_value(world: ArrayWorld, policy: Policy, formula: brute.LTL, answer: brute.Answer) -> None:
    """Follow every action of the world with the policy's memory and the reference's monitor side by side."""
    monitor = brute.Monitor(formula)
    todo = [(policy.initial_memory, monitor.initial, world.initial)]
    seen = set(todo)
    while todo:
        memory, q, state = todo.pop()
        after = monitor.read(q, frozenset(n for n, states in world.holds.items() if state in states))
        probability, steps = answer.nodes[after, state]
        step = policy.step(state, memory)
        assert step.probability == pytest.approx(probability, abs=1e-6)
        assert step.expected_steps == pytest.approx(steps, rel=1e-6, abs=1e-7)
        assert step.done == (after in monitor.holds)
        assert (step.status == "lost") == (probability == 0)
        if step.status == "running":
            for move in world.transitions[state].values():
                new = {(step.memory, after, target) for target in move} - seen
                seen |= new
                todo += new


@pytest.mark.parametrize("seed", range(12))
def test_re_entry_from_every_state_is_as_good_as_a_fresh_plan(seed: int) -> None:
    world = random_world(seed, states=8)
    formula = random_formula(random.Random(seed), 2)
    parsed = parse(brute.text(formula))
    plans = [plan(world, parsed, initial=state) for state in range(world.size)]
    best = max(plans, key=lambda p: p.policy is not None)
    if best.policy is None:
        assert all(p.upper == 0 for p in plans)
        return
    for state, fresh in enumerate(plans):
        step = best.policy.step(state, best.initial_memory)
        assert step.probability == pytest.approx(fresh.lower, abs=1e-6)
        assert step.expected_steps == pytest.approx(fresh.expected_steps or 0.0, rel=1e-6)


def test_the_same_input_gives_the_same_bytes() -> None:
    for seed in range(20):
        world = random_world(seed)
        formula = parse(brute.text(random_formula(random.Random(seed), 2)))
        first, second = plan(world, formula), plan(random_world(seed), formula)
        if first.policy is not None and second.policy is not None:
            assert to_bytes(first.policy) == to_bytes(second.policy)
        assert (first.lower, first.upper, first.expected_steps) == (
            second.lower,
            second.upper,
            second.expected_steps,
        )


def test_a_coarse_epsilon_keeps_the_bounds_sound() -> None:
    for seed in range(30):
        world = random_world(seed)
        formula = random_formula(random.Random(seed), 2)
        result = plan(world, parse(brute.text(formula)), options=Options(epsilon=0.1, max_sweeps=3))
        answer = solve(world, formula)
        assert result.lower - 1e-12 <= answer.probability <= result.upper + 1e-12, seed

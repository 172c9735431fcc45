"""The Markov chain of a policy against a plain search with the policy's own answers."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from models.logic import parse
from models.planning import NOTHING, WAIT, Policy, check, plan
from models.planning import chain as module
from models.planning.chain import Chain, explore
from models.world import OomdpWorld, World, compile_world, load_environment, toys_spec
from tests.planning.doubles import ArrayWorld, listed, random_world
from tests.planning.random_tasks import navigation_task, toys_task

FORMULAS = ("F (a & F b)", "G F a", "F G a | G F b", "!b U a", "G F a & F G !b", "F (a & X X b)")
Node = tuple[int, int]
"""A state of the world and the memory after reading it."""


def move(world: World, policy: Policy, node: Node) -> dict[Node, float]:
    """Where the policy leads, with which probabilities."""
    state, after = node
    action = int(policy.acting(np.array([state]), np.array([after]))[0])
    if action == NOTHING:
        return {}
    moves = {state: 1.0}
    if action != WAIT:
        outcomes = world.outcomes(action, np.array([state]))
        assert outcomes.enabled[0]
        chances = zip(outcomes.successor[:, 0].tolist(), outcomes.probability[:, 0].tolist(), strict=True)
        moves = {successor: chance for successor, chance in chances if chance > 0}
    return {(target, policy.step(target, after).memory): chance for target, chance in moves.items()}


def searched(world: World, policy: Policy) -> dict[Node, dict[Node, float]]:
    start = (policy.initial_state, policy.step(policy.initial_state, policy.initial_memory).memory)
    found: dict[Node, dict[Node, float]] = {}
    waiting = [start]
    while waiting:
        node = waiting.pop()
        if node not in found:
            found[node] = move(world, policy, node)
            waiting += found[node]
    return found


def told(chain: Chain) -> dict[Node, dict[Node, float]]:
    """The chain by name; nothing stands twice."""
    nodes = list(zip(chain.state.tolist(), chain.after.tolist(), strict=True))
    assert len(set(nodes)) == len(nodes)
    found: dict[Node, dict[Node, float]] = {}
    for place, node in enumerate(nodes):
        outcomes = range(chain.first[place], chain.first[place + 1])
        found[node] = {nodes[chain.target[k]]: float(chain.probability[k]) for k in outcomes}
        assert len(found[node]) == len(outcomes)
        assert (chain.source[outcomes.start : outcomes.stop] == place).all()
    return found


def policies() -> list[tuple[World, Policy]]:
    made: list[tuple[World, Policy]] = []
    for seed in range(90):
        world: World = random_world(seed)
        if seed % 3 == 0:
            world = listed(random_world(seed))
        policy = plan(world, parse(FORMULAS[seed % len(FORMULAS)])).policy
        if policy is not None:
            made.append((world, policy))
    for seed in range(6):
        for task in (toys_task(seed), navigation_task(seed)):
            policy = plan(task.world, parse(task.text)).policy
            if policy is not None:
                made.append((task.world, policy))
    return made


@pytest.fixture(scope="module")
def known() -> list[tuple[World, Policy]]:
    return policies()


def test_it_is_what_the_policy_does(known: list[tuple[World, Policy]]) -> None:
    sizes = []
    for world, policy in known:
        chain = explore(world, policy)
        assert chain.whole
        assert told(chain) == searched(world, policy)
        assert chain.state[0] == policy.initial_state
        sizes.append(len(chain.state))
    assert len(sizes) > 30
    assert max(sizes) > 20


@pytest.mark.parametrize("most", [1, 2, 3, 5, 8])
def test_what_is_cut_off_is_a_beginning_of_the_whole(known: list[tuple[World, Policy]], most: int) -> None:
    cut = 0
    for world, policy in known:
        whole, some = explore(world, policy), explore(world, policy, most=most)
        count = len(some.state)
        assert 1 <= count <= most
        assert (some.state == whole.state[:count]).all()
        assert (some.after == whole.after[:count]).all()
        assert (some.action == whole.action[:count]).all()
        assert some.whole == (count == len(whole.state))
        full = told(whole)
        for node, moves in told(some).items():
            assert moves.items() <= full[node].items()
        cut += not some.whole
    assert cut >= 5


@pytest.mark.parametrize("stretch", [1, 2, 5])
def test_a_chain_is_the_same_in_stretches_of_any_length(stretch: int, monkeypatch: pytest.MonkeyPatch) -> None:
    told_of: list[int] = []
    for seed in range(0, 60, 3):
        world = listed(random_world(seed))
        policy = plan(world, parse(FORMULAS[seed % len(FORMULAS)])).policy
        if policy is None:
            continue
        whole, before = explore(world, policy), len(told_of)
        monkeypatch.setattr(module, "BUDGET", stretch)
        again = explore(world, policy, progress=lambda *event: told_of.append(event[1]))
        monkeypatch.undo()
        assert told(again) == told(whole)
        assert again.first.tolist() == whole.first.tolist()
        assert len(told_of) - before >= len(whole.target) // (stretch + 3)


@pytest.mark.parametrize("as_listed", [False, True])
def test_a_policy_that_does_what_is_not_possible_is_found_out(as_listed: bool) -> None:
    world: World = ArrayWorld(3, {0: {"go": {1: 1.0}}, 1: {"on": {2: 1.0}}}, {"a": frozenset({2})})
    if as_listed:
        world = listed(world)
    policy = plan(world, parse("F a")).policy
    assert policy is not None
    wrong = replace(policy, action=np.where(policy.action == 0, 1, policy.action))
    with pytest.raises(AssertionError, match="takes on where it is not possible"):
        explore(world, wrong)


def test_waiting_stays_and_reads_again() -> None:
    world = ArrayWorld(2, {0: {"go": {1: 1.0}}}, {"a": frozenset({1})})
    policy = plan(world, parse("F (a & X X a)")).policy
    assert policy is not None
    chain = explore(world, policy)
    assert chain.state.tolist() == [0, 1, 1, 1]
    assert chain.action.tolist() == [0, WAIT, WAIT, NOTHING]
    assert len(set(chain.after.tolist())) == 4


def test_states_whose_numbers_fill_a_word() -> None:
    """State and memory together take more than 63 bits."""
    world = compile_world(load_environment(toys_spec(columns=5, rows=2, toys=15)))
    assert isinstance(world, OomdpWorld)
    start = world.encode({"robot": {"at": "room_10"}})
    tour = "at(robot, kitchen)"
    for room in ("room_10", "kitchen", "room_10", "kitchen", "room_10"):
        tour = f"at(robot, {room}) & F ({tour})"
    result = plan(world, parse(f"F ({tour})"), initial=start)
    assert result.policy is not None
    assert start * result.policy.memories > 2**63
    chain = explore(world, result.policy)
    assert told(chain) == searched(world, result.policy)
    assert check(world, result.policy).expected_steps == pytest.approx(result.expected_steps)

"""Probability 0 and 1 by graph analysis, products and end components, against fixed points in plain Python."""

from __future__ import annotations

from itertools import combinations

import numpy as np
import pytest
from numpy.typing import NDArray

from models.planning import end_components as decomposition
from models.planning import graph, qualities
from models.planning.end_components import end_components
from models.planning.graph import reach
from models.planning.qualities import analyse
from tests.planning.doubles import ArrayWorld, random_world
from tests.planning.stages import Stages, stages

FORMULAS = ("F a", "F (a & F b)", "!b U a", "(X a) | (b U (a & X b))")


def moves(s: Stages) -> dict[int, list[set[int]]]:
    """The support of every choice of every node."""
    p = s.product
    return {
        node: [
            set(p.successor[p.first_outcome[c] : p.first_outcome[c + 1]].tolist())
            for c in range(p.first_choice[node], p.first_choice[node + 1])
        ]
        for node in range(p.nodes)
    }


def naive_possible(s: Stages) -> set[int]:
    reached = {s.product.accepted}
    choices = moves(s)
    while new := {n for n in choices if n not in reached and any(m & reached for m in choices[n])}:
        reached |= new
    return reached


def naive_certain(s: Stages) -> set[int]:
    """The nested fixed point, written down as it is defined."""
    choices, outer = moves(s), {*range(s.product.nodes), s.product.accepted}
    while True:
        inner = {s.product.accepted}
        while new := {n for n in choices if n not in inner and any(m <= outer and m & inner for m in choices[n])}:
            inner |= new
        if inner == outer:
            return outer
        outer = inner


@pytest.mark.parametrize("formula", FORMULAS)
def test_possible_and_certain_are_the_fixed_points(formula: str) -> None:
    for seed in range(60):
        s = stages(random_world(seed), formula)
        assert set(s.qualities.possible.nonzero()[0].tolist()) == naive_possible(s), seed
        certain = naive_certain(s)
        assert set(s.qualities.certain.nonzero()[0].tolist()) == certain, seed
        flat = [m <= certain for supports in moves(s).values() for m in supports]
        assert s.qualities.keeps_certain.tolist() == flat, seed


@pytest.mark.parametrize("budget", [1, 7])
def test_searches_come_to_the_same_in_stretches_of_any_length(budget: int, monkeypatch: pytest.MonkeyPatch) -> None:
    heard: list[int] = []
    for seed in range(30):
        s = stages(random_world(seed), FORMULAS[seed % len(FORMULAS)])
        inside = s.qualities.possible & ~s.qualities.certain
        components = end_components(s.product, s.graph, inside)
        for module in (graph, qualities, decomposition):
            monkeypatch.setattr(module, "BUDGET", budget)
        found = analyse(s.product, s.graph, progress=lambda *event: heard.append(event[-1]))
        again = end_components(s.product, s.graph, inside, progress=lambda *event: heard.append(event[-1]))
        monkeypatch.undo()
        for name in ("possible", "certain", "keeps_certain", "order"):
            assert getattr(found, name).tolist() == getattr(s.qualities, name).tolist(), seed
        assert [one.tolist() for one in again] == [one.tolist() for one in components], seed
    assert len(heard) > 200


def test_the_order_of_a_search_is_by_distance_and_then_by_number() -> None:
    for seed in range(30):
        s = stages(random_world(seed), "F (a & F b)")
        found = reach(s.graph, np.array([s.product.accepted], dtype=np.int32))
        reached = found.mask.nonzero()[0].tolist()
        assert found.order.tolist() == sorted(reached, key=lambda node: (found.distance[node], node))


def is_end_component(choices: dict[int, list[set[int]]], nodes: set[int]) -> bool:
    """Every node can stay inside, and from each one all are reachable without leaving."""
    inside = {n: [m for m in choices[n] if m <= nodes] for n in nodes}
    if not all(inside.values()):
        return False
    for start in nodes:
        reached, todo = {start}, [start]
        while todo:
            new = set().union(*inside[todo.pop()]) - reached
            reached |= new
            todo += new
        if reached != nodes:
            return False
    return True


def test_end_components_are_the_maximal_ones() -> None:
    found_some = 0
    for seed in range(40):
        s = stages(random_world(seed, states=6), "F a")
        choices = moves(s)
        inside = s.qualities.possible & ~s.qualities.certain
        allowed = [n for n in choices if inside[n]]
        every = [
            set(c) for size in range(1, len(allowed) + 1) for c in combinations(allowed, size)
            if is_end_component(choices, set(c))
        ]  # fmt: skip
        maximal = {frozenset(c) for c in every if not any(c < d for d in every)}
        component, stays = end_components(s.product, s.graph, inside)
        groups: dict[int, set[int]] = {}
        for node in (component >= 0).nonzero()[0].tolist():
            groups.setdefault(int(component[node]), set()).add(node)
        assert {frozenset(g) for g in groups.values()} == maximal, seed
        flat = [(n, m) for n, supports in choices.items() for m in supports]
        assert stays.tolist() == [any(n in c and m <= c for c in maximal) for n, m in flat], seed
        found_some += bool(maximal)
    assert found_some >= 3


def peeled(size: int) -> ArrayWorld:
    """Every node may try for the goal, but risks the node below it; only in the lowest is all lost."""
    last = size - 1
    moves = {s: {"rest": {s: 1.0}, "try": {s - 1: 0.5, last: 0.5}} for s in range(1, last)}
    return ArrayWorld(size, moves, {"a": frozenset({last})}, initial=last - 1)


def test_removal_node_by_node_takes_time_in_proportion() -> None:
    s = stages(peeled(2_000), "F a")
    levels: list[int] = []
    found = analyse(s.product, s.graph, progress=lambda *event: levels.append(event[-1]))
    assert found.certain.nonzero()[0].tolist() == [s.product.accepted]
    assert found.possible.sum() == 1_999
    assert len(levels) > 2_000  # the removal of each node is told of
    assert sum(levels) < 8 * 2_000  # and looks only at what it cuts


def test_end_components_that_fall_apart_node_by_node_take_one_removal() -> None:
    size = 2_000
    moves = {s: {"go": {s - 1: 0.5, s + 1: 0.5}} for s in range(1, size - 1)}
    s = stages(ArrayWorld(size, moves, {"a": frozenset({size - 1})}), "F a")
    looked: list[int] = []
    component, stays = end_components(
        s.product,
        s.graph,
        s.qualities.possible & ~s.qualities.certain,
        progress=lambda *event: looked.append(event[-1]),
    )
    assert sum(looked) < 10 * size
    assert (component < 0).all()
    assert not stays.any()


@pytest.mark.parametrize("seed", range(30))
def test_a_search_finds_the_nearest_way_to_the_targets(seed: int) -> None:
    s = stages(random_world(seed), "F (a & F b)")
    allowed = np.random.default_rng(seed).random(len(s.product.action)) < 0.7
    targets = [s.product.accepted, s.product.lost]
    for mask in (None, allowed):
        found = reach(s.graph, np.array(targets, dtype=np.int32), allowed=mask)
        assert found.distance.tolist() == naive_distances(s, targets, mask)
        for node in (found.distance > 0).nonzero()[0].tolist():
            choice = found.choice[node]
            assert s.product.first_choice[node] <= choice < s.product.first_choice[node + 1]
            assert mask is None or mask[choice]
            entered = s.product.successor[s.product.first_outcome[choice] : s.product.first_outcome[choice + 1]]
            assert found.distance[node] - 1 in found.distance[entered]
        assert (found.choice[found.distance <= 0] == -1).all()


def naive_distances(s: Stages, targets: list[int], mask: NDArray[np.bool_] | None) -> list[int]:
    """Fewest steps that may lead to a target, by rounds over all nodes; -1 where none do."""
    distance = dict.fromkeys(targets, 0)
    choices, step = moves(s), 0
    while True:
        step += 1
        new = {
            node
            for node, sets in choices.items()
            if node not in distance
            and any(
                (mask is None or mask[s.product.first_choice[node] + place]) and targets_ & distance.keys()
                for place, targets_ in enumerate(sets)
            )
        }
        if not new:
            return [distance.get(node, -1) for node in range(s.product.nodes + 2)]
        distance |= dict.fromkeys(new, step)


def test_the_product_reads_the_label_of_the_state_entered() -> None:
    for seed in range(40):
        s = stages(random_world(seed), "F (a & X b)")
        p, world, automaton = s.product, s.world, s.automaton
        letters = [
            sum((state in world.holds[atom.function]) << bit for bit, atom in enumerate(automaton.atoms))
            for state in range(world.size)
        ]
        live = ~(automaton.accepting | automaton.rejecting)
        for memory in range(automaton.states):
            for state in range(world.size):
                after = int(automaton.successors[memory, letters[state]])
                assert p.next_memory[memory, state] == after
                node = p.node_of(memory, state)
                if not live[after]:
                    assert node == (p.accepted if automaton.accepting[after] else p.lost)
                    continue
                choice = slice(p.first_choice[node], p.first_choice[node + 1])
                expected = world.transitions[state] or {"": {state: 1.0}}
                assert len(p.action[choice]) == len(expected)
                entered = {p.node_of(after, target) for move in expected.values() for target in move}
                first, last = p.first_outcome[choice.start], p.first_outcome[choice.stop]
                assert set(p.successor[first:last].tolist()) == entered

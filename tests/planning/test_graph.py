"""Probability 0 and 1 by graph analysis, products and end components, against fixed points in plain Python."""

from __future__ import annotations

from itertools import combinations

import pytest

from models.planning.end_components import end_components
from tests.planning.doubles import random_world
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

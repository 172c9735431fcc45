"""An independent, slow, plain reference: formulas by progression, products as dictionaries, Howard's policy
iteration.

Nothing of models.planning or of the automata is used: a formula is a nested tuple in negation normal form,
("ap", name), ("not", name), ("and", f, g), ("or", f, g), ("X", f), ("F", f), ("U", f, g), which is co-safe.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Mapping
from dataclasses import dataclass
from functools import cache
from itertools import product as combinations
from typing import Any

import numpy as np

Node = Hashable
Dynamics = Callable[[Any], Mapping[str, Mapping[Any, float]]]
Labels = Callable[[Any], frozenset[str]]
LTL = tuple[Any, ...]
Clauses = frozenset[frozenset[LTL]]
"""A disjunction of conjunctions of formulas that must hold from the next letter on."""

TRUE: Clauses = frozenset({frozenset()})
FALSE: Clauses = frozenset()


def text(f: LTL) -> str:
    """In the infix notation of the logic."""
    match f:
        case ("ap", name):
            return str(name)
        case ("not", name):
            return f"!{name}"
        case ("and", left, right):
            return f"({text(left)} & {text(right)})"
        case ("or", left, right):
            return f"({text(left)} | {text(right)})"
        case ("U", left, right):
            return f"({text(left)} U {text(right)})"
        case (op, operand):
            return f"({op} ({text(operand)}))"
    raise AssertionError(f)


def names(f: LTL) -> frozenset[str]:
    """The propositions of a formula."""
    return frozenset({f[1]}) if f[0] in ("ap", "not") else frozenset().union(*(names(g) for g in f[1:]))


def _or(left: Clauses, right: Clauses) -> Clauses:
    union = left | right
    return frozenset(c for c in union if not any(d < c for d in union))


def _and(left: Clauses, right: Clauses) -> Clauses:
    return _or(frozenset(c | d for c in left for d in right), FALSE)


@cache
def _progress(f: LTL, letter: frozenset[str]) -> Clauses:
    match f:
        case ("ap", name):
            return TRUE if name in letter else FALSE
        case ("not", name):
            return FALSE if name in letter else TRUE
        case ("and", left, right):
            return _and(_progress(left, letter), _progress(right, letter))
        case ("or", left, right):
            return _or(_progress(left, letter), _progress(right, letter))
        case ("X", operand):
            return frozenset({frozenset({operand})})
        case ("F", operand):
            return _or(_progress(operand, letter), frozenset({frozenset({f})}))
        case ("U", left, right):
            return _or(_progress(right, letter), _and(_progress(left, letter), frozenset({frozenset({f})})))
    raise AssertionError(f)


class Monitor:
    """The deterministic automaton of a formula, by progression, with what is certain worked out over its
    states.
    """

    def __init__(self, f: LTL) -> None:
        self.initial: Clauses = frozenset({frozenset({f})})
        propositions = sorted(names(f))
        self.letters = [
            frozenset(n for n, on in zip(propositions, bits, strict=True) if on)
            for bits in combinations([False, True], repeat=len(propositions))
        ]
        self._names = frozenset(propositions)
        edges: dict[Clauses, list[Clauses]] = {}
        todo = [self.initial]
        while todo:
            q = todo.pop()
            if q not in edges:
                edges[q] = [self._read(q, letter) for letter in self.letters]
                todo += edges[q]
        self.holds = {TRUE}  # every continuation satisfies the formula
        while new := {q for q in edges if q not in self.holds and all(r in self.holds for r in edges[q])}:
            self.holds |= new
        alive = set(self.holds)  # some continuation does
        while new := {q for q in edges if q not in alive and any(r in alive for r in edges[q])}:
            alive |= new
        self.fails = set(edges) - alive

    @staticmethod
    def _read(q: Clauses, letter: frozenset[str]) -> Clauses:
        result = FALSE
        for clause in q:
            one = TRUE
            for f in clause:
                one = _and(one, _progress(f, letter))
            result = _or(result, one)
        return result

    def read(self, q: Clauses, label: frozenset[str]) -> Clauses:
        """The state after one letter."""
        return self._read(q, label & self._names)


@dataclass(frozen=True)
class Answer:
    """Exact values at the initial state, and the reachable product's by (monitor state after reading, state)."""

    probability: float
    steps: float
    nodes: dict[Node, tuple[float, float]]


def solve(dynamics: Dynamics, labels: Labels, initial: Any, f: LTL) -> Answer:
    """Maximal probability, and the fewest expected steps among the policies that reach it."""
    monitor = Monitor(f)
    start = (monitor.read(monitor.initial, labels(initial)), initial)
    choices: dict[Node, list[dict[Node, float]]] = {}
    todo: list[Any] = [start]
    while todo:
        node = todo.pop()
        if node in choices:
            continue
        q, state = node
        choices[node] = []
        if q in monitor.holds or q in monitor.fails:
            continue
        moves = list(dynamics(state).values()) or [{state: 1.0}]
        for move in moves:
            entered: dict[Node, float] = {}
            for target, chance in move.items():
                key = (monitor.read(q, labels(target)), target)
                entered[key] = entered.get(key, 0.0) + chance
            choices[node].append(entered)
            todo += entered
    goal = {node for node in choices if node[0] in monitor.holds}  # type: ignore[index]
    value = _best_probability(choices, goal)
    decided = {node for node in choices if node in goal or value[node] == 0.0}
    kept = {
        node: [m for m in moves if _worth(m, value) >= value[node] - 1e-9]
        for node, moves in choices.items()
        if node not in decided
    }
    steps = _iterate(kept, dict.fromkeys(decided, 0.0), cost=1.0, sign=-1.0)
    value = {node: min(1.0, max(0.0, v)) for node, v in value.items()}
    return Answer(value[start], steps[start], {n: (value[n], steps[n]) for n in choices})


def _worth(move: Mapping[Node, float], value: Mapping[Node, float]) -> float:
    return sum(chance * value[target] for target, chance in move.items())


def _best_probability(choices: dict[Node, list[dict[Node, float]]], goal: set[Node]) -> dict[Node, float]:
    towards = _attract(choices, goal)
    open_ = {node: choices[node] for node in towards}
    known = {node: float(node in goal) for node in choices if node not in towards}
    return _iterate(open_, known, cost=0.0, sign=1.0)


def _attract(choices: Mapping[Node, list[dict[Node, float]]], goal: set[Node]) -> dict[Node, int]:
    """For each node that may reach `goal`, a choice that may bring it closer."""
    reached, towards = set(goal), {}
    while True:
        new = {
            node: number
            for node, moves in choices.items()
            if node not in reached
            for number, move in reversed(list(enumerate(moves)))
            if any(target in reached for target in move)
        }
        if not new:
            return towards
        towards.update(new)
        reached |= set(new)


def _iterate(
    choices: Mapping[Node, list[dict[Node, float]]], known: Mapping[Node, float], *, cost: float, sign: float
) -> dict[Node, float]:
    """Policy iteration from a policy that heads for the known nodes; a choice is replaced by a strictly
    better one only.

    For probabilities the known nodes of value 0 do not attract, so the first policy may stop nowhere else.
    """
    nodes = list(choices)
    number = {node: i for i, node in enumerate(nodes)}
    targets = {n for n, v in known.items() if v > 0} if cost == 0 else set(known)
    towards = _attract(choices, targets)
    policy = [towards[node] for node in nodes]
    while True:
        matrix, right = np.eye(len(nodes)), np.full(len(nodes), cost)
        for i, node in enumerate(nodes):
            for target, chance in choices[node][policy[i]].items():
                if target in number:
                    matrix[i, number[target]] -= chance
                else:
                    right[i] += chance * known[target]
        x = np.linalg.solve(matrix, right) if nodes else right
        value = dict(known) | {node: float(x[i]) for i, node in enumerate(nodes)}
        changed = False
        for i, node in enumerate(nodes):
            worth = [sign * (cost + _worth(move, value)) for move in choices[node]]
            best = int(np.argmax(worth))
            if worth[best] > worth[policy[i]] + 1e-10 * max(1.0, abs(worth[best])):
                policy[i], changed = best, True
        if not changed:
            return value

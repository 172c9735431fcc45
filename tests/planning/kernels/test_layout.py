"""Problems copied out of products, and the marks of products, against plain loops."""

from __future__ import annotations

import numpy as np
import pytest

from models.planning.choices import gather
from tests.planning.doubles import random_world
from tests.planning.stages import stages


@pytest.mark.parametrize("seed", range(40))
def test_a_problem_has_the_choices_kept_by_unknown_and_the_rest_as_constants(seed: int) -> None:
    p = stages(random_world(seed), "F (a & F b)").product
    draw = np.random.default_rng(seed)
    kept = draw.random(len(p.action)) < 0.8
    unknown = np.full(p.nodes + 2, -1, dtype=np.int32)
    some = np.flatnonzero(draw.random(p.nodes) < 0.7)
    numbers = np.unique(draw.integers(0, max(1, len(some)), len(some)), return_inverse=True)[1]
    unknown[some] = numbers  # several nodes may share one, in no order
    known, cost = draw.random(p.nodes + 2), draw.random(len(p.action))
    problem, rows = gather(p, kept, unknown=unknown, known=known, cost=cost)
    owner = np.repeat(np.arange(p.nodes), np.diff(p.first_choice))
    expected = sorted((int(unknown[owner[c]]), c) for c in np.flatnonzero(kept) if unknown[owner[c]] >= 0)
    assert rows.tolist() == [c for _, c in expected]
    counts = np.bincount([u for u, _ in expected], minlength=int(unknown.max(initial=-1)) + 1)
    assert problem.first_choice.tolist() == [0, *np.cumsum(counts).tolist()]
    most = 0
    for place, (_, c) in enumerate(expected):
        outcomes = range(p.first_outcome[c], p.first_outcome[c + 1])
        open_ = [
            (int(unknown[p.successor[i]]), float(p.probability[i])) for i in outcomes if unknown[p.successor[i]] >= 0
        ]
        here = range(problem.first_outcome[place], problem.first_outcome[place + 1])
        assert [(int(problem.successor[i]), float(problem.probability[i])) for i in here] == open_
        settled = sum(p.probability[i] * known[p.successor[i]] for i in outcomes if unknown[p.successor[i]] < 0)
        assert problem.constant[place] == pytest.approx(cost[c] + settled, rel=1e-15)
        most = max(most, len(outcomes) - len(open_))
    assert problem.settled == most


@pytest.mark.parametrize("seed", range(20))
def test_choices_carry_the_marks_of_their_outcomes(seed: int) -> None:
    s = stages(random_world(seed), "G F a & G F b | F G a")
    p, automaton = s.product, s.automaton
    letter = automaton.letters(s.world.labels(automaton.atoms))
    assert automaton.acceptance
    for memory in np.flatnonzero(~automaton.accepting & ~automaton.rejecting):
        for state in range(s.world.size):
            node = p.node[memory, state]
            if node >= p.nodes:
                continue
            moves = s.world.transitions[state]
            ordered = [moves[name] for name in s.world.actions if name in moves] or [{state: 1.0}]
            for place, move in enumerate(ordered):
                choice = p.first_choice[node] + place
                carried = {target: int(automaton.marks[memory, letter[target]]) for target in move}
                assert p.marks[choice] == np.bitwise_or.reduce(list(carried.values()))
                for bit, meets in p.meets.items():
                    chance = sum(move[target] for target, marks in carried.items() if marks & bit)
                    assert meets[choice] == pytest.approx(chance, rel=1e-15)

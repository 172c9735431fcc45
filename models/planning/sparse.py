"""Planning on listed transitions: every formula of LTL in every finite world that fits in memory."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from models.logic import Automaton
from models.planning.compiled import check_memory, check_outcomes, compile_world
from models.planning.evaluation import Attained, attained_probability
from models.planning.graph import Predecessors, predecessors
from models.planning.options import Options, Progress
from models.planning.policy import INVALID, NOTHING, WAIT
from models.planning.probability import Probability, maximal_probability
from models.planning.product import Product, build_product
from models.planning.qualities import Qualities, analyse
from models.planning.recurrence import Recurrence, accepting_components
from models.planning.solution import Solution, smallest
from models.planning.steps import Steps, conserving, fewest_steps
from models.world import World

SLACKS = (1e-10, 1e-12, 1e-14)
"""How much probability a choice may seem to lose and still count as tied; tried in turn until the policy
attains what it should."""


def solve(
    world: World,
    automaton: Automaton,
    start: int,
    *,
    options: Options,
    progress: Progress,
) -> Solution | None:
    """The best policy from everywhere, with bounds of its values in `start`; None where they are 0.

    Raises ModelTooLargeError before allocating, DeviceUnavailableError.
    """
    live = int(np.count_nonzero(~automaton.accepting & ~automaton.rejecting))
    check_memory(world, automaton.states, live, options)
    compiled = compile_world(world, progress=progress)
    check_outcomes(compiled, automaton.states, live, options)
    letter = automaton.letters(world.labels(automaton.atoms))
    whole = build_product(compiled, automaton, letter)
    graph = predecessors(whole)
    recurrence = accepting_components(whole, graph, automaton.acceptance, options=options, progress=progress)
    product = whole
    if recurrence.inside.any():
        product = whole.contracted(recurrence.inside)
        graph = predecessors(product)
    qualities = analyse(product, graph, progress=progress)
    node = product.node_of(automaton.initial, start)
    if not qualities.possible[node]:
        return None
    probability = maximal_probability(product, graph, qualities, node, options=options, progress=progress)
    steps, attained = _optimise(product, graph, qualities, probability, node, options, progress)
    rows = np.flatnonzero(~automaton.accepting & ~automaton.rejecting)
    column = product.node[rows]
    return Solution(
        letter=smallest(np.where(compiled.valid, letter, INVALID)),
        action=smallest(_actions(whole, product, steps, recurrence)[whole.node[rows]]),
        probability=attained.value[column],
        expected_steps=steps.lower[column],
        lower=float(attained.lower[node]),
        upper=float(probability.upper[node]),
        steps=(float(steps.lower[node]), float(steps.upper[node])),
        component=np.append(recurrence.component, [-1, -1])[whole.node[rows]] if len(recurrence.least) else None,
        rounds=np.stack([recurrence.least, recurrence.most], axis=1),
    )


def _actions(whole: Product, product: Product, steps: Steps, recurrence: Recurrence) -> NDArray[np.int32]:
    """[n + 2] of `whole`: index into the world's actions, NOTHING or WAIT."""
    choice = recurrence.chosen.copy()
    outside = np.flatnonzero(~recurrence.inside[:-2])
    # A node keeps its choices and their order when others are contracted.
    choice[outside] = np.where(
        steps.chosen < 0, -1, whole.first_choice[outside] + steps.chosen - product.first_choice[:-1]
    )
    action = np.full(whole.nodes + 2, NOTHING, dtype=np.int32)
    acting = np.flatnonzero(choice >= 0)
    taken = whole.action[choice[acting]]
    action[acting] = np.where(taken < 0, WAIT, taken)
    return action


def _optimise(
    product: Product,
    graph: Predecessors,
    qualities: Qualities,
    probability: Probability,
    node: int,
    options: Options,
    progress: Progress,
) -> tuple[Steps, Attained]:
    """The fewest steps over the choices tied for the best probability, and what their policy attains.

    Which choices tie is only known as exactly as the values. A choice that is worse by a hair may be taken
    again and again, so the policy is evaluated, and ties are read more strictly until it attains the lower
    bound within epsilon.
    """
    best: tuple[Steps, Attained] | None = None
    least = np.inf
    for slack in SLACKS:
        kept = conserving(product, qualities, probability, max(slack, 0.0 if best else probability.slack))
        steps = fewest_steps(product, graph, qualities, kept, node, options=options, progress=progress)
        if steps is None:
            break
        attained = attained_probability(
            product, qualities, probability, steps, node, options=options, progress=progress
        )
        shortfall = float((probability.lower - attained.lower).max())
        if shortfall < least:
            best, least = (steps, attained), shortfall
        if shortfall <= options.epsilon or options.hurry("evaluate"):
            break
    if best is None:
        raise AssertionError("the choices of maximal probability always decide the outcome")
    return best

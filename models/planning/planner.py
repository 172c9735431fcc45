"""From a world and a formula to a policy: the stages of planning in order.

world ─► arrays ─┐
formula ─► automaton ─► product ─► probability 0 and 1 ─► bounds ─► fewest steps ─► policy ─► evaluation
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np

from models.logic import Automaton, Dialect, Formula, to_text, translate
from models.planning.compiled import check_memory, check_outcomes, check_size, compile_world
from models.planning.evaluation import Attained, attained_probability
from models.planning.graph import Predecessors, predecessors
from models.planning.options import Options, Progress, no_progress
from models.planning.policy import NOTHING, WAIT, Policy
from models.planning.probability import Probability, maximal_probability
from models.planning.product import Product, build_product, read_labels
from models.planning.qualities import Qualities, analyse
from models.planning.steps import Steps, conserving, fewest_steps
from models.planning.trajectory import Trajectory, most_probable_run
from models.world import StateError, World

Outcome = Literal["solved", "unsatisfiable", "unreachable"]

SLACKS = (1e-10, 1e-12, 1e-14)
"""How much probability a choice may seem to lose and still count as tied; tried in turn until the policy
attains what it should."""


@dataclass(frozen=True, slots=True)
class Sizes:
    """How large the model was."""

    states: int
    product_states: int
    automaton_states: int


@dataclass(frozen=True, slots=True, eq=False)
class Plan:
    """The answer.

    "unsatisfiable": no word at all satisfies the formula. "unreachable": this world, from the initial state,
    cannot. Both have probability 0 and neither policy nor trajectory. "solved": the policy satisfies the
    formula with probability at least `lower`, and no policy does with more than `upper`; `expected_steps` are
    its steps until the outcome is decided, the fewest among policies of that probability, and lie between
    `expected_steps` and `expected_steps_upper`, which is infinite if iteration was cut short.
    """

    outcome: Outcome
    lower: float
    upper: float
    expected_steps: float | None
    expected_steps_upper: float | None
    initial_state: int
    initial_memory: int
    policy: Policy | None
    trajectory: Trajectory | None
    sizes: Sizes


def plan(
    world: World,
    formula: Formula,
    *,
    initial: int | None = None,
    options: Options | None = None,
    progress: Progress = no_progress,
) -> Plan:
    """Plan a resolved, co-safe formula from the state `initial` (default: the world's).

    Deterministic. Raises FormulaNotCosafeError and FormulaTooLargeError (formula), UnknownPropositionError
    and its kin (atoms), StateError (initial state), ModelTooLargeError (before allocating),
    DeviceUnavailableError, and whatever `progress` raises.
    """
    settings = options or Options()
    start = world.initial if initial is None else initial
    automaton = translate(formula)
    check_size(world.size, automaton.states, settings)
    _check_initial(world, start)
    if automaton.rejecting[automaton.initial]:
        return _hopeless("unsatisfiable", world, automaton, start)
    live = int(np.count_nonzero(~automaton.accepting & ~automaton.rejecting))
    check_memory(world, automaton.states, live, settings)
    compiled = compile_world(world, progress=progress)
    check_outcomes(compiled, automaton.states, live, settings)
    next_memory = read_labels(automaton, world.labels(automaton.atoms), compiled.valid)
    product = build_product(compiled, automaton, next_memory)
    graph = predecessors(product)
    qualities = analyse(product, graph, progress=progress)
    node = product.node_of(automaton.initial, start)
    if not qualities.possible[node]:
        return _hopeless("unreachable", world, automaton, start)
    probability = maximal_probability(product, graph, qualities, node, options=settings, progress=progress)
    steps, attained = _optimise(product, graph, qualities, probability, node, settings, progress)
    return Plan(
        outcome="solved",
        lower=float(attained.lower[node]),
        upper=float(probability.upper[node]),
        expected_steps=float(steps.lower[node]),
        expected_steps_upper=float(steps.upper[node]),
        initial_state=start,
        initial_memory=automaton.initial,
        policy=_policy(world, automaton, product, steps, attained, start),
        trajectory=most_probable_run(
            compiled, product, steps.chosen, world.actions, state=start, memory=automaton.initial
        ),
        sizes=_sizes(world, automaton),
    )


def _check_initial(world: World, state: int) -> None:
    if not 0 <= state < world.size:
        raise StateError(f"state {state} is not one of 0 to {world.size - 1}")
    if not world.valid(np.array([state], dtype=np.int64))[0]:
        raise StateError(f"the world does not allow this state: {world.decode(state)}")


def _sizes(world: World, automaton: Automaton) -> Sizes:
    return Sizes(world.size, world.size * automaton.states, automaton.states)


def _hopeless(outcome: Outcome, world: World, automaton: Automaton, start: int) -> Plan:
    """Probability 0, and nothing to do about it."""
    return Plan(
        outcome=outcome,
        lower=0.0,
        upper=0.0,
        expected_steps=None,
        expected_steps_upper=None,
        initial_state=start,
        initial_memory=automaton.initial,
        policy=None,
        trajectory=None,
        sizes=_sizes(world, automaton),
    )


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
        kept = conserving(product, qualities, probability, max(slack, 0.0 if best else 2 * probability.gap))
        steps = fewest_steps(product, graph, qualities, kept, node, options=options, progress=progress)
        if steps is None:
            break
        attained = attained_probability(
            product, qualities, probability, steps, node, options=options, progress=progress
        )
        shortfall = float((probability.lower - attained.lower).max())
        if shortfall < least:
            best, least = (steps, attained), shortfall
        if shortfall <= options.epsilon:
            break
    if best is None:
        raise AssertionError("the choices of maximal probability always decide the outcome")
    return best


def _policy(
    world: World, automaton: Automaton, product: Product, steps: Steps, attained: Attained, start: int
) -> Policy:
    """Values by node, read by memory before the label."""
    action = np.full(product.nodes + 2, NOTHING, dtype=np.int32)
    acting = np.flatnonzero(steps.chosen >= 0)
    taken = product.action[steps.chosen[acting]]
    action[acting] = np.where(taken < 0, WAIT, taken)
    column = product.columns_before()
    return Policy(
        variables=world.variables,
        actions=world.actions,
        formula=to_text(automaton.formula, Dialect.INFIX),
        atoms=tuple(to_text(atom, Dialect.INFIX) for atom in automaton.atoms),
        hoa=automaton.hoa,
        initial_state=start,
        initial_memory=automaton.initial,
        accepted=automaton.accepting,
        action=action[column],
        next_memory=product.next_memory,
        probability=attained.value[column],
        expected_steps=steps.lower[column],
    )

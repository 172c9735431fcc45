"""From a world and a formula to a policy: the stages of planning in order.

world ─► arrays ─┐
formula ─► automaton ─► product ─► accepting end components ─► probability 0 and 1 ─► bounds ─► fewest steps
─► evaluation ─► policy
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from models.logic import Automaton, Dialect, Formula, Op, Unary, to_text, translate
from models.planning.chosen import Chosen
from models.planning.compiled import CompiledWorld, check_memory, check_outcomes, check_size, compile_world
from models.planning.evaluation import Attained, attained_probability
from models.planning.graph import Predecessors, predecessors
from models.planning.options import Options, Progress, no_progress
from models.planning.policy import INVALID, Policy
from models.planning.policy_data import smallest
from models.planning.probability import Probability, maximal_probability
from models.planning.product import Product, build_product
from models.planning.qualities import Qualities, analyse
from models.planning.recurrence import accepting_components
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

    The goal is the formula, or its negation where the objective is the least probability. "unsatisfiable": no word at
    all satisfies the goal. "unreachable": this world, from the initial state, cannot. Both have neither policy nor
    trajectory. "solved": the policy satisfies the goal with probability at least `lower`, and no policy does with more
    than `upper`; where the goal is the negation both are turned round, so that they bound the least probability of the
    formula. `expected_steps` are the policy's steps until the outcome is decided (the goal holds whatever follows, or
    will if the policy goes on for ever, or cannot any more), the fewest among policies of that probability, and lie
    between `expected_steps` and `expected_steps_upper`, which is infinite if iteration was cut short. `round_steps`
    bounds the expected steps of a round of what then has to be done for ever; None where there is nothing of the kind.
    """

    outcome: Outcome
    lower: float
    upper: float
    expected_steps: float | None
    expected_steps_upper: float | None
    round_steps: tuple[float, float] | None
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
    """Plan a resolved formula from the state `initial` (default: the world's).

    Deterministic. Raises FormulaTooLargeError, UnknownPropositionError and its kin (atoms), StateError (initial state),
    ModelTooLargeError (before allocating), DeviceUnavailableError, and whatever `progress` raises.
    """
    settings = options or Options()
    start = world.initial if initial is None else initial
    if settings.objective == "min":
        return _turned_round(_plan(world, Unary(Op.NOT, formula), start, settings, progress))
    return _plan(world, formula, start, settings, progress)


def _turned_round(plan: Plan) -> Plan:
    """The least probability of a formula, from the greatest of its negation."""
    return replace(plan, lower=1.0 - plan.upper, upper=1.0 - plan.lower)


def _plan(world: World, formula: Formula, start: int, settings: Options, progress: Progress) -> Plan:
    """The greatest probability of a formula."""
    automaton = translate(formula)
    check_size(world.size, automaton.states, settings)
    _check_initial(world, start)
    if automaton.rejecting[automaton.initial]:
        return _hopeless("unsatisfiable", world, automaton, start)
    live = int(np.count_nonzero(~automaton.accepting & ~automaton.rejecting))
    check_memory(world, automaton.states, live, settings)
    compiled = compile_world(world, progress=progress)
    check_outcomes(compiled, automaton.states, live, settings)
    letter = automaton.letters(world.labels(automaton.atoms))
    whole = build_product(compiled, automaton, letter)
    graph = predecessors(whole)
    recurrence = accepting_components(whole, graph, automaton.acceptance, options=settings, progress=progress)
    product = whole
    if recurrence.inside.any():
        product = whole.contracted(recurrence.inside)
        graph = predecessors(product)
    qualities = analyse(product, graph, progress=progress)
    node = product.node_of(automaton.initial, start)
    if not qualities.possible[node]:
        return _hopeless("unreachable", world, automaton, start)
    probability = maximal_probability(product, graph, qualities, node, options=settings, progress=progress)
    steps, attained = _optimise(product, graph, qualities, probability, node, settings, progress)
    chosen = Chosen.of(whole, product, steps.chosen, recurrence)
    return Plan(
        outcome="solved",
        lower=float(attained.lower[node]),
        upper=float(probability.upper[node]),
        expected_steps=float(steps.lower[node]),
        expected_steps_upper=float(steps.upper[node]),
        round_steps=chosen.rounds(whole.node_of(automaton.initial, start), recurrence),
        initial_state=start,
        initial_memory=automaton.initial,
        policy=_policy(world, automaton, compiled, letter, chosen, attained, steps, start),
        trajectory=most_probable_run(chosen, compiled, world.actions, state=start, memory=automaton.initial),
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
        round_steps=None,
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
    world: World,
    automaton: Automaton,
    compiled: CompiledWorld,
    letter: NDArray[np.int32],
    chosen: Chosen,
    attained: Attained,
    steps: Steps,
    start: int,
) -> Policy:
    """Values by row and state, read by memory after the label."""
    live = np.flatnonzero(~automaton.accepting & ~automaton.rejecting)
    row = np.full(automaton.states, -1, dtype=np.int32)
    row[live] = np.arange(len(live), dtype=np.int32)
    column = chosen.product.node[live]
    return Policy(
        variables=world.variables,
        actions=world.actions,
        formula=to_text(automaton.formula, Dialect.INFIX),
        atoms=tuple(to_text(atom, Dialect.INFIX) for atom in automaton.atoms),
        hoa=automaton.hoa,
        initial_state=start,
        initial_memory=automaton.initial,
        successors=automaton.successors,
        accepted=automaton.accepting,
        row=row,
        letter=smallest(np.where(compiled.valid, letter, INVALID)),
        action=smallest(chosen.actions()[chosen.whole.node[live]]),
        probability=attained.value[column],
        expected_steps=steps.lower[column],
    )

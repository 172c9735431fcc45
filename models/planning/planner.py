"""From a world and a formula to a policy: the stages of planning in order.

formula ─► automaton ─┐
world ─► its part that matters ─► labels ─► dense rows, where the world has them and the outcome is sure
            └─► what can be reached ─┴────► listed transitions: product, end components, bounds, steps ─► policy

A solver gives the policy on all states (`dense`, `sparse`); what its runs do is then read off its Markov chain.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import count
from typing import Literal

import numpy as np

from models.logic import Automaton, Dialect, Formula, Op, Unary, to_text, translate
from models.planning import codec, dense, sparse
from models.planning.chain import Chain, explore
from models.planning.compiled import OUTCOME_BYTES, PRODUCT_OUTCOME_BYTES, check_size
from models.planning.errors import ModelTooLargeError
from models.planning.options import Options, Progress, no_progress
from models.planning.policy import Policy
from models.planning.solution import Solution
from models.planning.trajectory import Trajectory, most_probable_run
from models.world import (
    OomdpWorld,
    ProjectedWorld,
    ReachableWorld,
    StateError,
    World,
    reachable_part,
    relevant_part,
)

MOST_REACHABLE = 1_000_000
"""States up to which the reachable part of a world that is too large as a whole is explored: some seconds."""

MOST_INDICES = 2**53
"""State indices beyond which nothing is explored: whoever reads a policy as JSON has floating-point numbers."""

Outcome = Literal["solved", "unsatisfiable", "unreachable"]


@dataclass(frozen=True, slots=True)
class Sizes:
    """How large the model was, as far as it mattered."""

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
    formula. `expected_steps` are the policy's steps (what they cost, where actions have costs) until the outcome is
    decided: the goal holds whatever follows, or will if the policy goes on for ever, or cannot any more. They are the
    fewest among policies of that probability, and lie between `expected_steps` and `expected_steps_upper`, which is
    infinite if iteration was cut short. `round_steps` bounds the expected steps of a round of what then has to be done
    for ever; None where there is nothing of the kind, or the policy's runs are too many to see.
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
    _check_initial(world, start)
    part = _part(world, automaton, start, settings)
    if automaton.rejecting[automaton.initial]:
        return _hopeless("unsatisfiable", part, automaton, start)
    begin = part.initial if isinstance(part, ProjectedWorld) else start
    try:
        solution = _solve(part, automaton, begin, settings, progress)
    except ModelTooLargeError:
        smaller = _reachable(part, automaton, begin, settings, progress)
        if smaller is None:
            raise
        part = smaller
        solution = _solve(part, automaton, part.initial, settings, progress)
    if solution is None:
        return _hopeless("unreachable", part, automaton, start)
    policy = _policy(world, part, automaton, solution, start)
    chain = explore(world, policy, progress=progress)
    return Plan(
        outcome="solved",
        lower=solution.lower,
        upper=solution.upper,
        expected_steps=solution.steps[0],
        expected_steps_upper=solution.steps[1],
        round_steps=_rounds(chain, policy, solution),
        initial_state=start,
        initial_memory=automaton.initial,
        policy=policy,
        trajectory=most_probable_run(chain, policy, automaton),
        sizes=_sizes(part, automaton),
    )


def _solve(part: World, automaton: Automaton, start: int, settings: Options, progress: Progress) -> Solution | None:
    """The best policy on all states of the part; None where its values are 0 in `start`."""
    check_size(part.size, automaton.states, settings)
    solution = dense.solve(part, automaton, start, options=settings, progress=progress)
    if solution is dense.UNSURE:
        solution = sparse.solve(part, automaton, start, options=settings, progress=progress)
    return solution if isinstance(solution, Solution) else None


def _reachable(
    part: World, automaton: Automaton, start: int, settings: Options, progress: Progress
) -> ReachableWorld | None:
    """What can be reached of a part that is too large as a whole; None where that is too large as well."""
    if part.size > MOST_INDICES or part.listed is not None:
        return None
    levels = count(1)
    return reachable_part(
        part,
        start,
        most_states=min(MOST_REACHABLE, settings.max_states // automaton.states),
        most_outcomes=settings.max_bytes // (OUTCOME_BYTES + PRODUCT_OUTCOME_BYTES),
        tell=lambda found: progress("compile", next(levels), 0.0, np.inf, found),
    )


def _part(world: World, automaton: Automaton, start: int, settings: Options) -> World:
    """The part of the world that the formula depends on."""
    if not settings.relevance or automaton.acceptance or not isinstance(world, OomdpWorld):
        return world
    after = automaton.successors
    twice = after[after, np.arange(after.shape[1])]
    if (twice != after).any():  # to read a letter twice is not always the same as to read it once
        return world
    return relevant_part(world, automaton.atoms, start) or world


def _rounds(chain: Chain, policy: Policy, solution: Solution) -> tuple[float, float] | None:
    """Bounds of the expected steps of a round, over the end components that the policy may come to."""
    if solution.component is None or not chain.whole:
        return None
    row = policy.row[chain.after]
    component = np.where(row >= 0, solution.component[row, policy.place(chain.state)], -1)
    met = np.unique(component[component >= 0])
    if not len(met):
        return None
    return float(solution.rounds[met, 0].min()), float(solution.rounds[met, 1].max())


def _check_initial(world: World, state: int) -> None:
    if not 0 <= state < world.size:
        raise StateError(f"state {state} is not one of 0 to {world.size - 1}")
    valid = world.is_valid(state) if isinstance(world, OomdpWorld) else world.valid(np.array([state]))[0]
    if not valid:
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


def _policy(world: World, part: World, automaton: Automaton, solution: Solution, start: int) -> Policy:
    """Values by row and place, read by memory after the label."""
    live = np.flatnonzero(~automaton.accepting & ~automaton.rejecting)
    row = np.full(automaton.states, -1, dtype=np.int32)
    row[live] = np.arange(len(live), dtype=np.int32)
    strides = codec.strides(world.variables)
    harmless = tuple(tuple(range(len(variable.values))) for variable in world.variables)
    inner = part.whole if isinstance(part, ReachableWorld) else part
    if isinstance(inner, ProjectedWorld):
        strides, harmless = inner.projection.inner, inner.projection.harmless
    return Policy(
        variables=world.variables,
        strides=strides,
        harmless=harmless,
        indices=part.states if isinstance(part, ReachableWorld) else None,
        actions=world.actions,
        formula=to_text(automaton.formula, Dialect.INFIX),
        atoms=tuple(to_text(atom, Dialect.INFIX) for atom in automaton.atoms),
        hoa=automaton.hoa,
        initial_state=start,
        initial_memory=automaton.initial,
        successors=automaton.successors,
        accepted=automaton.accepting,
        row=row,
        letter=solution.letter,
        action=solution.action,
        probability=solution.probability,
        expected_steps=solution.expected_steps,
    )

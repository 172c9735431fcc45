"""From a world and a formula to a policy: the stages of planning in order.

formula ─► automaton ─┐
world ─► its part that matters ─► labels ─► dense rows, where the world has them and the outcome is sure
            └─► what can be reached ─┴────► listed transitions: product, end components, bounds, steps ─► policy

A solver gives the policy on all states (`dense`, `sparse`); what its runs do is then read off its Markov chain.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from models.logic import Automaton, Formula, Op, Unary, translate
from models.planning.finding import Hopeless
from models.planning.narrowing import first_part, narrowed
from models.planning.obstacles import obstacles
from models.planning.options import Options, Progress, no_progress
from models.planning.policy import Policy
from models.planning.trajectory import Trajectory, most_probable_run
from models.world import OomdpWorld, StateError, World

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
    all satisfies the goal. "unreachable": this world, from the initial state, cannot; `obstacles` are why, if that is
    known (`models.planning.obstacles`). Both have neither policy nor trajectory. "solved": the policy satisfies the
    goal with probability at least `lower`, and no policy does with more than `upper`; where the goal is the negation
    both are turned round, so that they bound the least probability of the formula. `expected_steps` are the policy's
    steps (what they cost, where actions have costs) until the outcome is decided: the goal holds whatever follows, or
    will if the policy goes on for ever, or cannot any more. They are the fewest among policies of that probability, and
    lie between `expected_steps` and `expected_steps_upper`, which is infinite if iteration was cut short. `round_steps`
    bounds the expected steps of a round of what then has to be done for ever; None where there is nothing of the kind,
    or the policy's runs are too many to see.
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
    obstacles: tuple[Formula, ...] = ()


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
    if automaton.rejecting[automaton.initial]:
        return _hopeless("unsatisfiable", first_part(world, automaton, start, settings), automaton, start)
    found = narrowed(world, automaton, start, options=settings, progress=progress)
    if isinstance(found, Hopeless):
        return _hopeless("unreachable", found.part, automaton, start, obstacles(found.part, automaton, start, settings))
    return Plan(
        outcome="solved",
        lower=found.solution.lower,
        upper=found.solution.upper,
        expected_steps=found.solution.steps[0],
        expected_steps_upper=found.solution.steps[1],
        round_steps=found.rounds,
        initial_state=start,
        initial_memory=automaton.initial,
        policy=found.policy,
        trajectory=most_probable_run(found.chain, found.policy, automaton),
        sizes=_sizes(found.part, automaton),
    )


def _check_initial(world: World, state: int) -> None:
    if not 0 <= state < world.size:
        raise StateError(f"state {state} is not one of 0 to {world.size - 1}")
    valid = world.is_valid(state) if isinstance(world, OomdpWorld) else world.valid(np.array([state]))[0]
    if not valid:
        raise StateError(f"the world does not allow this state: {world.decode(state)}")


def _sizes(world: World, automaton: Automaton) -> Sizes:
    return Sizes(world.size, world.size * automaton.states, automaton.states)


def _hopeless(outcome: Outcome, world: World, automaton: Automaton, start: int, why: tuple[Formula, ...] = ()) -> Plan:
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
        obstacles=why,
    )

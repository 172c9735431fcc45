"""Among the policies of maximal probability, one with the fewest expected steps until the outcome is decided.

A stochastic shortest path with positive costs (Bertsekas and Tsitsiklis, "An analysis of stochastic shortest path
problems", 1991) over the choices that keep the maximal probability, ending where the formula can no longer
fail or can no longer be met. Staying undecided for ever is not optimal there, since it costs infinitely much.

A step costs 1 unless the world says otherwise; let c be the least cost of any, and T the optimality operator. Where
the values v come from does not matter, since two inequalities turn them into bounds. If T v <= v + r c with r < 1, then
u = v / (1 - r) satisfies T u <= u: to scale values but not a cost of at least c leaves out at least r c / (1 - r),

    T u <= (T v - r c) / (1 - r) <= v / (1 - r) = u,

and u is no less than the optimum. The same holds for the policy that is greedy in v up to ties, with r taken over its
own choices: it decides the outcome with probability one and needs at most v / (1 - r). It can therefore not circle on a
tie, and its values need no further evaluation. If v <= T v + r c, then v / (1 + r) is no more than the optimum.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from models.planning.choices import Choices, Vector, gather
from models.planning.direct import DIRECT_LIMIT, Improver
from models.planning.graph import Predecessors, reach
from models.planning.kernels import layout
from models.planning.operator import Operator, operator_of
from models.planning.options import Options, Progress, no_progress
from models.planning.probability import DIRECT_AFTER, Probability
from models.planning.product import Product
from models.planning.qualities import Qualities
from models.planning.ragged import owners
from models.planning.trend import UNKNOWN, Trend

RESIDUAL = 1e-8
"""Change in a sweep, in units of the least cost, at which iteration stops: the relative error of the expected steps."""

TIE = 1e-9
"""Relative difference of expected steps within which the first action is taken."""


@dataclass(frozen=True, slots=True, eq=False)
class Steps:
    """A policy and its expected steps until the outcome is decided, by node and column.

    `upper` is infinite where iteration was cut short before it could bound anything; the policy still decides
    the outcome with probability one.
    """

    chosen: NDArray[np.int32]  # [n]  choice of each node; -1 at nodes of probability 0
    lower: Vector  # [n + 2]
    upper: Vector  # [n + 2]


def conserving(product: Product, qualities: Qualities, probability: Probability, slack: float) -> NDArray[np.bool_]:
    """[C] the choices of undecided nodes that keep the maximal probability, up to `slack` where it is not
    known exactly.

    At nodes of probability one no number is involved.
    """
    kept = qualities.certain[owners(product.first_choice)] & qualities.keeps_certain
    maybe = qualities.possible & ~qualities.certain
    layout.keep(*product.moves, product.probability, maybe, probability.estimate, slack, kept)
    return kept


def fewest_steps(
    product: Product,
    graph: Predecessors,
    qualities: Qualities,
    kept: NDArray[np.bool_],
    initial: int,
    *,
    options: Options,
    progress: Progress = no_progress,
) -> Steps | None:
    """Minimise the expected steps over the choices `kept`; None if they cannot decide the outcome from every
    node.
    """
    ends = np.flatnonzero(~qualities.possible | (np.arange(product.nodes + 2) >= product.nodes)).astype(np.int32)
    reached = reach(graph, ends, allowed=kept)
    if not reached.mask[:-2].all():
        return None
    nodes = reached.order[reached.distance[reached.order] > 0]  # a sweep carries values on from the nearest ones
    chosen = np.full(product.nodes, -1, dtype=np.int32)
    lower, upper = np.zeros(product.nodes + 2), np.zeros(product.nodes + 2)
    if not len(nodes):
        return Steps(chosen, lower, upper)
    unknown = np.full(product.nodes + 2, -1, dtype=np.int32)
    unknown[nodes] = np.arange(len(nodes), dtype=np.int32)
    none = np.zeros(product.nodes + 2)
    choices, taken = gather(product, kept, unknown=unknown, known=none, cost=product.cost)
    towards = np.flatnonzero(taken == reached.choice[graph.owner[taken]]).astype(np.int32)
    least = float(product.cost[taken].min())
    start: Vector = reached.distance[nodes].astype(np.float64) * least
    policy, low, error = _solve(choices, start, least, towards, int(unknown[initial]), options, progress)
    chosen[nodes] = taken[policy]
    lower[nodes] = low
    upper[nodes] = low / (1.0 - error) if error < 1.0 else np.inf
    return Steps(chosen, lower, upper)


def _solve(
    choices: Choices,
    start: Vector,
    least: float,
    towards: NDArray[np.int32],
    watched: int,
    options: Options,
    progress: Progress,
) -> tuple[NDArray[np.int32], Vector, float]:
    """The policy, its values from below and their relative error (see the module).

    `start` is the distance at the `least` cost, a first lower bound; `towards` the policy that follows it, the last
    resort.
    """
    operator = operator_of(choices, options.device)
    x = operator.vector(start)
    residual = min(RESIDUAL, options.epsilon)

    trend = Trend(residual, most=DIRECT_AFTER if choices.unknowns <= DIRECT_LIMIT else options.max_sweeps)

    def tell(sweep: int, change: float, left: float = UNKNOWN) -> None:
        if progress is not no_progress:
            value = operator.at(x, watched) if watched >= 0 else 0.0
            upper = value / (1.0 - change) if change < 1.0 else np.inf
            progress("steps", sweep, value / (1.0 + change), upper, choices.unknowns, left)

    for sweep in options.sweeps("steps"):
        change = operator.improve(x) / least
        tell(sweep, change, trend.left(change))
        if change <= residual:
            break
        if sweep % DIRECT_AFTER == 0 and change * least <= choices.roundoff * float(operator.numpy(x).max()):
            break
        if sweep == DIRECT_AFTER and choices.unknowns <= DIRECT_LIMIT:
            x = _solve_directly(operator, x, towards, least, partial(tell, sweep, change))
    operator.improve(x)
    exact = bool((choices.probability == 1).all() and (choices.constant == np.floor(choices.constant)).all())
    rounding = 0.0 if exact else choices.roundoff * float(operator.numpy(x).max())  # whole numbers are exact
    for tie in (TIE, 0.0):  # where steps are many a tie may be worth more than a step
        policy, above, below = operator.greedy(x, maximise=False, tie=tie, least=least)
        above, below = max(above, 0.0) + rounding, max(below, 0.0) + rounding
        if above + below < least:
            break
    low = operator.numpy(x) / (1.0 + below / least)
    error = (above + below) / least
    return (policy if error < 1.0 else towards), low, error


def _solve_directly(
    operator: Operator, x: Any, towards: NDArray[np.int32], least: float, alive: Callable[[], None]
) -> Any:
    """The optimum from policy iteration, if it gives one; else `x`."""
    greedy, above, _ = operator.greedy(x, maximise=False, tie=TIE, least=least)
    proposal = Improver(operator.choices, maximise=False).improve(greedy if above < least else towards, alive)
    return x if proposal is None else operator.vector(proposal.value)

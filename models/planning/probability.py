"""Maximal probability of reaching acceptance, with bounds that hold.

Nodes of probability 0 and 1 are settled by graph analysis. Each maximal end component of the rest is one unknown with
the choices that leave it, so that every policy leaves the unknowns for sure, and the values are the only fixed point.

Lower bounds rise by modified policy iteration. Upper bounds are guessed a little above them and proved: a vector that
no pass raises is one (optimistic value iteration: Hartmanns and Kaminski, "Optimistic value iteration", CAV 2020).
Where no guess is proved soon, interval iteration takes over, from 1 down (Haddad and Monmege, "Interval iteration
algorithm for MDPs and IMDPs", TCS 2018; Baier, Klein, Leuschner, Parker and Wunderlich, "Ensuring the reliability of
your model checker: interval iteration for Markov decision processes", CAV 2017). Every pass rounds its result outwards,
as in Hartmanns, "Correct probabilistic model checking with floating-point arithmetic" (TACAS 2022), so that the bounds
hold in floating point too.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from models.planning.choices import Choices, Vector, gather
from models.planning.direct import DIRECT_LIMIT, probability_bounds
from models.planning.end_components import end_components
from models.planning.graph import Predecessors
from models.planning.kernels import layout
from models.planning.operator import Operator, operator_of
from models.planning.options import Options, Progress, no_progress
from models.planning.product import Product
from models.planning.qualities import Qualities
from models.planning.trend import UNKNOWN, Trend

PRECISION = 1e-11
"""Gap that is aimed at, well under any useful epsilon: ties between actions are decided on these values."""

RISE = 1e-13
"""Rise in a pass at which lower bounds count as the values."""

GUESSES = (1e-10, 1e-8, 1e-7)
"""How far above the lower bounds upper ones are guessed."""

PROOF_SWEEPS = 60
"""Passes after which a guess is given up."""

DIRECT_AFTER = 100
"""Sweeps after which a small system is solved directly instead."""


@dataclass(frozen=True, slots=True, eq=False)
class Probability:
    """Bounds of the maximal probability, by node and column."""

    lower: Vector  # [n + 2]
    upper: Vector  # [n + 2]
    proved: bool  # the lower bounds are the values but for rounding, and the upper ones were proved

    @property
    def gap(self) -> float:
        """The largest difference of the bounds."""
        return float((self.upper - self.lower).max())

    @property
    def estimate(self) -> Vector:
        """[n + 2] the best guess: the lower bounds, which iteration brings to the values while upper ones are only
        proved; the middle where both were squeezed together.
        """
        return self.lower if self.proved else (self.lower + self.upper) / 2

    @property
    def slack(self) -> float:
        """How far the worth of choices that tie may seem to differ."""
        return 0.0 if self.proved else 2 * self.gap


def maximal_probability(
    product: Product,
    graph: Predecessors,
    qualities: Qualities,
    initial: int,
    *,
    options: Options,
    progress: Progress = no_progress,
) -> Probability:
    """Bound the maximal probability of acceptance from every node; `initial` is the one that progress
    reports.

    The gap is at most `options.epsilon` everywhere unless the sweeps ended first.
    """
    lower = qualities.certain.astype(np.float64)
    upper = qualities.certain.astype(np.float64)
    maybe, proved = qualities.possible & ~qualities.certain, True
    if maybe.any():
        unknown, choices = _quotient(product, graph, qualities, lower, progress)
        low, high, proved = iterate_intervals(choices, int(unknown[initial]), options=options, progress=progress)
        lower[maybe] = low[unknown[maybe]]
        upper[maybe] = high[unknown[maybe]]
    return Probability(lower, upper, proved)


def _quotient(
    product: Product, graph: Predecessors, qualities: Qualities, known: Vector, progress: Progress
) -> tuple[NDArray[np.int32], Choices]:
    """The unknown of each node (-1 where known), nearest to acceptance first, and their choices: an end component is
    one unknown.
    """
    maybe = qualities.possible & ~qualities.certain
    component, stays = end_components(product, graph, maybe, progress=progress)
    unknown = np.full(product.nodes + 2, -1, dtype=np.int32)
    layout.number_unknowns(qualities.order, maybe, component, unknown)
    choices, _ = gather(product, ~stays, unknown=unknown, known=known)
    return unknown, choices


def iterate_intervals(
    choices: Choices, watched: int, *, options: Options, progress: Progress = no_progress
) -> tuple[Vector, Vector, bool]:
    """Lower and upper bounds of the maximal values of choices under which every policy leaves the unknowns
    for sure; and whether the lower ones are the values but for rounding.

    `watched` is the unknown whose bounds progress reports; -1 for a value that is settled already.
    """
    operator = operator_of(choices, options.device)
    lower, upper = operator.vector(0.0), operator.vector(1.0)
    known = watched < 0

    def tell(sweep: int, left: float = UNKNOWN) -> None:
        if progress is not no_progress:
            low, high = (1.0, 1.0) if known else (operator.at(lower, watched), operator.at(upper, watched))
            progress("probability", sweep, low, high, choices.unknowns, left)

    sweeps, cut = 0, False
    trend = Trend(RISE, most=DIRECT_AFTER if choices.unknowns <= DIRECT_LIMIT else options.max_sweeps)
    for sweeps in options.sweeps("probability"):
        rise = operator.ascend(lower)
        tell(sweeps, trend.left(rise))
        if rise <= RISE:
            break
        if sweeps == DIRECT_AFTER and choices.unknowns <= DIRECT_LIMIT:
            break
    else:
        cut = True
    proved, most = _prove(operator, lower, options.epsilon, partial(tell, sweeps)), options.max_sweeps
    if proved is None and not cut and choices.unknowns <= DIRECT_LIMIT:
        solved = _solve_directly(operator, lower, upper, partial(tell, sweeps))
        if solved is not None:
            lower, upper, most = *solved, sweeps + DIRECT_AFTER  # where iteration creeps, no closer in a million sweeps
    if proved is not None:
        upper = operator.vector(np.minimum(operator.numpy(proved), operator.numpy(upper)))
        tell(sweeps + 1, 0.0)
        return operator.numpy(lower), operator.numpy(upper), True
    return *_close(operator, lower, upper, sweeps, most, options, tell), False


def _prove(operator: Operator, lower: Any, epsilon: float, alive: Callable[[float], None]) -> Any | None:
    """Upper bounds at most `epsilon` above the lower ones, or None where no such guess is proved. `alive` hears how
    many passes are left at most for the guess.
    """
    for guess in (guess for guess in GUESSES if guess <= epsilon / 2):
        upper = operator.vector(np.minimum(1.0, operator.numpy(lower) + guess))
        growth = np.inf
        for number in range(1, PROOF_SWEEPS + 1):
            before, growth = growth, operator.cover(upper)
            alive(0.0 if growth == 0.0 else PROOF_SWEEPS - number)
            if growth == 0.0:
                return upper
            if growth > 2 * guess or (growth > before and growth > guess):
                break
    return None


def _close(
    operator: Operator,
    lower: Any,
    upper: Any,
    done: int,
    most: int,
    options: Options,
    tell: Callable[[int, float], None],
) -> tuple[Vector, Vector]:
    """Both bounds by interval iteration, until they are `PRECISION` apart, no sweep brings them closer, or after `most`
    sweeps, of which so many are `done`; but then at least until they are `options.epsilon` apart.
    """
    gap, aim = 1.0, min(PRECISION, options.epsilon)
    trend = Trend(aim, most=most - done)
    for sweep in options.sweeps("probability", after=done):
        previous, gap = gap, operator.narrow(lower, upper, sweep)
        tell(sweep, trend.left(gap))
        if gap <= aim or (sweep >= most and gap <= options.epsilon):
            break
        if gap == previous and sweep % DIRECT_AFTER == 0:  # as close as floating point gets
            break
    return operator.numpy(lower), operator.numpy(upper)


def _solve_directly(operator: Operator, lower: Any, upper: Any, alive: Callable[[], None]) -> tuple[Any, Any] | None:
    """Both bounds tightened by the direct solver's; None where it has none."""
    policy, _, _ = operator.greedy(lower, maximise=True, tie=0.0)
    bounds = probability_bounds(operator.choices, policy, alive)
    if bounds is None:
        return None
    low, high = np.maximum(operator.numpy(lower), bounds[0]), np.minimum(operator.numpy(upper), bounds[1])
    return operator.vector(low), operator.vector(high)

"""What a policy attains: its Markov chain, evaluated with an error bound."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from models.planning.choices import Vector, gather
from models.planning.direct import DIRECT_LIMIT, Improver
from models.planning.operator import Operator, operator_of
from models.planning.options import MOST_SWEEPS, Options, Progress, no_progress
from models.planning.probability import DIRECT_AFTER, Probability
from models.planning.product import Product
from models.planning.qualities import Qualities
from models.planning.steps import Steps
from models.planning.trend import Trend

ERROR = 1e-9
"""Error of the evaluated probabilities that is aimed at."""


@dataclass(frozen=True, slots=True, eq=False)
class Attained:
    """The probability with which a policy is accepted, by node and column."""

    value: Vector  # [n + 2]
    lower: Vector  # [n + 2]  the policy is accepted at least this often


def attained_probability(
    product: Product,
    qualities: Qualities,
    probability: Probability,
    steps: Steps,
    initial: int,
    *,
    options: Options,
    progress: Progress = no_progress,
) -> Attained:
    """Evaluate the policy of `steps` from every node.

    From nodes of probability one it never leaves them and ends with probability one, so it attains exactly
    one. For the others, a vector that one step of the policy changes by at most d is within d times the
    policy's expected steps of the truth.
    """
    value = qualities.certain.astype(np.float64)
    lower = value.copy()
    nodes = np.flatnonzero(qualities.possible & ~qualities.certain)
    if not len(nodes):
        return Attained(value, lower)
    unknown = np.full(product.nodes + 2, -1, dtype=np.int32)
    unknown[nodes] = np.arange(len(nodes), dtype=np.int32)
    taken = np.zeros(len(product.action), dtype=np.bool_)
    taken[steps.chosen[nodes]] = True
    chain, _ = gather(product, taken, unknown=unknown, known=value)
    change, x = np.inf, probability.estimate[nodes]
    bound = steps.upper / float(product.cost.min())  # on the steps: each costs that at least
    longest = float(bound[nodes].max())
    operator = operator_of(chain, options.device)
    most = MOST_SWEEPS if len(nodes) > DIRECT_LIMIT else DIRECT_AFTER

    def tell(sweep: int, left: float) -> None:
        progress("evaluate", sweep, 0.0, 1.0, len(nodes), left)

    change, x = _settle(operator, x, ERROR / longest, options.sweeps("evaluate", most=most), tell)
    if change * longest > ERROR and len(nodes) <= DIRECT_LIMIT:
        solved = Improver(chain, maximise=True).evaluate(np.arange(len(nodes), dtype=np.int32))
        start = x if solved is None else solved
        change, x = _settle(operator, start, ERROR / longest, options.sweeps("evaluate"), tell)
    progress("evaluate", 1, *_watched(unknown, initial, x), len(nodes))
    value[nodes] = x
    error = (change + chain.roundoff) * bound[nodes]
    lower[nodes] = np.clip(x - error, 0.0, 1.0) if np.isfinite(longest) else 0.0
    return Attained(value, lower)


def _watched(unknown: NDArray[np.int32], node: int, x: Vector) -> tuple[float, float]:
    value = float(x[unknown[node]]) if unknown[node] >= 0 else 1.0
    return value, value


def _settle(
    operator: Operator, start: Vector, small: float, sweeps: Iterable[int], tell: Callable[[int, float], None]
) -> tuple[float, Vector]:
    """Iterate until a sweep changes nothing by more than `small` or rounding; how far one step of the chain may
    change the vector, and the vector. `tell` hears of every sweep, and how many are left.
    """
    x = operator.vector(start)
    aim = max(small, operator.choices.roundoff)
    trend = Trend(aim)
    change = np.inf
    for sweep in sweeps:
        change = operator.settle(x, sweep)
        tell(sweep, trend.left(change))
        if change <= aim:
            break
    return change, operator.numpy(x)

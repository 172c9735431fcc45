"""The training split T of S and its validation tenth (paper, Table I)."""

from __future__ import annotations

import random
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from models.language.dataset.corpus import Domain, read_corpus
from models.language.dataset.examples import Example, by_task, generate

VALIDATION = 0.1
"""The part of T that is held back for validation."""
MAX_SHARE = 0.5
"""The most of one task class that T may take, so that S always holds commands of every class that T does not."""


@dataclass(frozen=True, slots=True)
class Split:
    """T in two disjoint parts: what the weights are fitted to, and what is only looked at."""

    training: tuple[Example, ...]
    validation: tuple[Example, ...]


def split(domain: Domain | str, *, seed: int = 0) -> Split:
    """T, drawn from S without replacement, in shuffled order, the same for the same seed.

    The paper gives the size of T and not how it was drawn. Here every task class gets the same number of examples, but
    at most half of those it has (`MAX_SHARE`): classes are an order of magnitude apart in size, and a uniform draw
    would leave five commands of `navigate_one`. Validation takes a tenth of every class, rounded so that the total is
    exactly a tenth of T.
    """
    domain = Domain(domain)
    generator = random.Random(f"{domain}/{seed}")
    groups = by_task(generate(domain).seen)
    quotas = equal_quotas(read_corpus(domain).training, {t: int(len(g) * MAX_SHARE) for t, g in groups.items()})
    drawn = {task: generator.sample(group, quotas[task]) for task, group in groups.items()}
    held = proportional_quotas(round(VALIDATION * sum(quotas.values())), quotas)
    training = [example for task, group in drawn.items() for example in group[held[task] :]]
    validation = [example for task, group in drawn.items() for example in group[: held[task]]]
    return Split(_shuffled(training, generator), _shuffled(validation, generator))


def equal_quotas(total: int, limits: Mapping[str, int]) -> dict[str, int]:
    """Shares of a total that are as equal as the limits allow; raises ValueError when the limits add up to less."""
    if sum(limits.values()) < total:
        raise ValueError(f"cannot draw {total} of {sum(limits.values())}")
    quotas: dict[str, int] = {}
    for rank, task in enumerate(sorted(limits, key=lambda task: limits[task])):
        left = total - sum(quotas.values())
        quotas[task] = min(limits[task], left // (len(limits) - rank))
    return quotas


def proportional_quotas(total: int, sizes: Mapping[str, int]) -> dict[str, int]:
    """Shares of a total in proportion to the sizes, at least one each, by largest remainder."""
    exact = {task: total * size / sum(sizes.values()) for task, size in sizes.items()}
    quotas = {task: max(1, int(share)) for task, share in exact.items()}
    by_remainder = sorted(exact, key=lambda task: quotas[task] - exact[task])
    for task in by_remainder[: total - sum(quotas.values())]:
        quotas[task] += 1
    return quotas


def _shuffled(examples: Sequence[Example], generator: random.Random) -> tuple[Example, ...]:
    return tuple(generator.sample(examples, len(examples)))

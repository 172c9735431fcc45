"""Which of two operands a formula has first, where the logic does not care: `or ( red , blue )` or `or ( blue , red )`.

Exact match of formulas cares. People say either, and the formulas follow a habit; so the order is learned.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from functools import cache
from itertools import combinations

from models.language.human.lifting import Lifted, arity
from models.language.human.spelling import read

COMMUTATIVE = frozenset({"and", "or"})


@dataclass(frozen=True, slots=True)
class OperandOrder:
    """How often one thing stood before another in the training formulas, as operands that may be swapped."""

    counts: Counter[tuple[str, str]] = field(default_factory=Counter)

    @classmethod
    def of(cls, commands: Iterable[Lifted]) -> OperandOrder:
        """Count the training formulas."""
        order = cls()
        for command in commands:
            for one, other in swappable(command.template):
                order.counts[command.things[one], command.things[other]] += 1
        return order

    def usual(self, template: str, things: Sequence[str]) -> tuple[str, ...]:
        """The things in the usual order among those that mean the same; as they are where neither is more usual."""
        order = list(things)
        for one, other in swappable(template):
            first, second = order[one], order[other]
            if self.counts[second, first] > self.counts[first, second]:
                order[one], order[other] = second, first
        return tuple(order)


@cache
def swappable(template: str) -> tuple[tuple[int, int], ...]:
    """The pairs of holes, counted from 0, whose exchange leaves the meaning: they are operands of one `and` or `or`."""
    holes = range(arity(template))
    same = _normal(template)
    return tuple(
        (one, other)
        for one, other in combinations(holes, 2)
        if _normal(_exchanged(template, one + 1, other + 1)) == same
    )


def _exchanged(template: str, one: int, other: int) -> str:
    exchange = {f"${one}": f"${other}", f"${other}": f"${one}"}
    return " ".join(exchange.get(word, word) for word in template.split())


def _normal(template: str) -> str:
    """The template with the operands of commutative operators sorted; as it is where it is none of Pan's spelling."""
    spelled = read(template)
    return template if spelled is None else str(spelled.sorted(COMMUTATIVE))

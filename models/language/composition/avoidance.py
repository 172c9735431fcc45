"""The ways in which "avoid" is meant: one standard, the others offered beside it.

"Go to the museum but avoid the bridge" may forbid the bridge for good, until the museum is reached, or only at the
moment when it is (`models.queries.meaning`). People who label such commands disagree too.
"""

from __future__ import annotations

from collections.abc import Iterator

from models.queries import Composition, Operator, Query

SHARES = (0.9, 0.07, 0.03)
"""How likely each meaning is: for good, until then, at that moment."""


def meanings(query: Query) -> Iterator[tuple[Query, float]]:
    """The query, and where it is `and(P, avoid(Q))` its other meanings; with their shares."""
    if not isinstance(query, Composition) or query.operator is not Operator.AND or len(query.operands) != 2:
        yield query, 1.0
        return
    forbidding = [part for part in query.operands if isinstance(part, Composition) and part.operator is Operator.AVOID]
    asking = [part for part in query.operands if part not in forbidding]
    if len(forbidding) != 1 or len(asking) != 1 or _lasts(asking[0]):
        yield query, 1.0
        return
    yield query, SHARES[0]
    yield Composition(Operator.UNTIL, (forbidding[0], asking[0])), SHARES[1]
    yield Composition(Operator.WITHOUT, (asking[0], forbidding[0].operands[0])), SHARES[2]


def _lasts(query: Query) -> bool:
    """Whether it is never done, so that nothing can be avoided until then."""
    return isinstance(query, Composition) and query.operator in (Operator.REPEAT, Operator.AVOID, Operator.UNTIL)

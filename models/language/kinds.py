"""Which of two tasks is meant, by the kinds of things that they were taught with.

"Go to the fountain" may be `move_to(fountain)` or `navigate_one(fountain)`. Where landmarks are what `navigate_one` was
taught with, and not `move_to`, the first is said of other things.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Sequence

from models.queries import ContextualQuery, GroundedQuery, Query, Template

RIVAL = 0.1
"""Part of a reading's probability from which another one counts as what may be meant instead, equal to what is left of
the probability of a strange one (`models.language.reading.STRANGE`), so that no less probable one would win anyway:
what is hardly near to switching on the machine does not tell that nobody goes to machines.
"""


def strangers(
    grounded: Sequence[tuple[GroundedQuery | None, float]], template_of: Callable[[str], Template | None]
) -> list[int]:
    """For each reading of a text, given with its probability, how many of its arguments are things of a kind that their
    task was not taught with, beyond those of the reading with the fewest among the readings that say the same of the
    same with other tasks, and are not much less probable.

    None of a reading that is not grounded.
    """
    counts = [0 if query is None else _strange(query, template_of) for query, _ in grounded]
    outlines = [None if query is None else _outline(query.query) for query, _ in grounded]
    known = list(zip(outlines, counts, (probability for _, probability in grounded), strict=True))
    return [
        count - min(rival for same, rival, likely in known if same == outline and likely >= RIVAL * probability)
        for outline, count, probability in known
    ]


def _strange(grounded: GroundedQuery, template_of: Callable[[str], Template | None]) -> int:
    tasks = {path: template_of(task.task) for path, task in grounded.query.tasks}
    count = 0
    for path, binding in grounded.bindings:
        template = tasks[path]
        taught = template.taught[binding.position - 1] if template is not None and template.taught else frozenset()
        count += bool(taught) and taught.isdisjoint(candidate.symbol.kind for candidate in binding.candidates)
    return count


def _outline(query: Query) -> Hashable:
    """A query without the names of its tasks."""
    if isinstance(query, ContextualQuery):
        return query.arguments
    return (query.operator, *map(_outline, query.operands))

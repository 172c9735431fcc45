"""Which of two tasks is meant, by the kinds of things that they were taught with.

"Go to the fountain" may be `move_to(fountain)` or `navigate_one(fountain)`. Where landmarks are what `navigate_one` was
taught with, and not `move_to`, the first is said of other things.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Sequence

from models.queries import ContextualQuery, GroundedQuery, Query, Template


def strangers(grounded: Sequence[GroundedQuery | None], template_of: Callable[[str], Template | None]) -> list[int]:
    """For each reading of a text, how many of its arguments are things of a kind that their task was not taught with,
    beyond those of the reading with the fewest among the readings that say the same of the same with other tasks.

    None of a reading that is not grounded.
    """
    counts = [0 if query is None else _strange(query, template_of) for query in grounded]
    least: dict[Hashable, int] = {}
    outlines = [None if query is None else _outline(query.query) for query in grounded]
    for outline, count in zip(outlines, counts, strict=True):
        least[outline] = min(count, least.get(outline, count))
    return [count - least[outline] for outline, count in zip(outlines, counts, strict=True)]


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

"""One phrase for several things in several tasks of a query: "pick up any toy and put it in the box".

A pronoun stands for the phrase that it repeats, so `then(pickup(any toy), store(any toy, box))` is about one and the
same toy in both tasks, whichever it is: the disjunction over the toys of the composition for each. In the same way
"every toy" is each toy in turn, the conjunction. This holds for the operands of `then` and `and`, however deep the
tasks are in them; what cannot be meant in all of the tasks is left out in each. What is not to be done is apart: "but
never touch any toy" is about every toy, whatever was done with one.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace

from models.queries.contextual_query import Composition, ContextualQuery, Operator, Query
from models.queries.template import Binding, GroundedTask
from models.world import Quantifier, Symbol

Path = tuple[int, ...]
Tasks = Mapping[Path, GroundedTask]


@dataclass(frozen=True, slots=True)
class _Shared:
    """What tasks say of several things, by their paths, and what can be meant in all of them."""

    quantifier: Quantifier
    phrase: str
    paths: frozenset[Path]
    symbols: tuple[Symbol, ...]


def agreed(query: Query, tasks: Tasks, path: Path = ()) -> Tasks:
    """The tasks with what several of them say of the same things reduced to what can be meant in all."""
    if isinstance(query, ContextualQuery):
        return tasks
    for shared in _shared(query, tasks, path):
        tasks = _narrowed(tasks, shared, shared.symbols, shared.quantifier)
    for place, operand in enumerate(query.operands):
        tasks = agreed(operand, tasks, (*path, place))
    return tasks


def choices(query: Composition, tasks: Tasks, path: Path) -> tuple[Quantifier, list[Tasks]] | None:
    """For the first phrase that the operands of the part at a path share, the tasks for each thing that it may be; None
    where they share none.
    """
    for shared in _shared(query, tasks, path):
        chosen = [_narrowed(tasks, shared, (symbol,), Quantifier.ONE) for symbol in shared.symbols]
        return shared.quantifier, chosen
    return None


def _shared(query: Composition, tasks: Tasks, path: Path) -> Iterator[_Shared]:
    """What two operands or more say of several things."""
    if query.operator not in (Operator.THEN, Operator.AND):
        return
    found: dict[tuple[Quantifier, str], list[tuple[Path, Binding]]] = {}
    for at in _to_be_done(query, path):
        for binding in tasks[at].bindings:
            if binding.quantifier is not Quantifier.ONE:
                found.setdefault((binding.quantifier, _phrase(binding)), []).append((at, binding))
    for (quantifier, phrase), bindings in found.items():
        things = [[candidate.symbol for candidate in binding.candidates] for _, binding in bindings]
        common = tuple(symbol for symbol in things[0] if all(symbol in others for others in things))
        if len({at[len(path)] for at, _ in bindings}) > 1 and common:
            yield _Shared(quantifier, phrase, frozenset(at for at, _ in bindings), common)


def _to_be_done(query: Query, path: Path) -> Iterator[Path]:
    """The paths of the tasks in the part at a path, but for those that are not to be done."""
    if isinstance(query, ContextualQuery):
        yield path
    elif query.operator is not Operator.AVOID:
        operands = query.operands[:1] if query.operator is Operator.WITHOUT else query.operands
        for place, operand in enumerate(operands):
            yield from _to_be_done(operand, (*path, place))


def _phrase(binding: Binding) -> str:
    return " ".join(binding.phrase.lower().split())


def _narrowed(tasks: Tasks, shared: _Shared, symbols: tuple[Symbol, ...], quantifier: Quantifier) -> Tasks:
    """The tasks with only some symbols for what they share, under a quantifier."""

    def narrowed(binding: Binding) -> Binding:
        if (binding.quantifier, _phrase(binding)) != (shared.quantifier, shared.phrase):
            return binding
        found = tuple(candidate for candidate in binding.candidates if candidate.symbol in symbols)
        return replace(binding, candidates=found, quantifier=quantifier)

    return {
        at: task.rebound(tuple(map(narrowed, task.bindings))) if at in shared.paths else task
        for at, task in tasks.items()
    }

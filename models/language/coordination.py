"""Names that share all other words: "put the ball and the orange in the box" says one task of each of them.

A network that finds clauses takes the first of the names for a clause of its own, and guesses its verb. Said of one
name at a time, the command has nothing to guess; what the readings differ in is put together again.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from itertools import chain, pairwise

from models.language.tokens import find, is_mark, marked_words
from models.queries import Composition, ContextualQuery, Operator, Query, QuerySyntaxError
from models.world import Environment, mentions
from models.world.phrase_index import DETERMINERS

JOINING = {
    ("and",): Operator.AND,
    ("as", "well", "as"): Operator.AND,
    ("along", "with"): Operator.AND,
    ("together", "with"): Operator.AND,
    ("or",): Operator.OR,
}
"""Words between names, and how what is said of each is put together."""
BEFORE = frozenset({"both", "either"})
"""Words before names that are joined."""
EACH = {"them": "it"}
"""Pronouns for things together, and what each of them is called: "... and put them in the box"."""
VERBS = {"are": "is", "were": "was", "have": "has"}
"""Verbs right after names that are joined, and after one: "once the ball and the bag are in the box"."""
CARRYING = frozenset({Operator.THEN, Operator.AND, Operator.OR, Operator.REPEAT})
"""Operators within which what is said of two names is said of each; to avoid both may be to avoid either."""
MOST = 8
"""Most joined names of a command that is said of one at a time."""

_Range = tuple[int, int]


@dataclass(frozen=True, slots=True)
class Joined:
    """A command with names that are joined: the names, folded, and the command said of one of them at a time."""

    operator: Operator
    names: tuple[tuple[str, ...], ...]
    texts: tuple[str, ...]

    def tears(self, query: Query) -> bool:
        """Whether a query does to one of the names what it does not do to another, or speaks of none."""
        said = [{task.task for _, task in query.tasks if _speaks_of(task, name)} for name in self.names]
        return not said[0] or any(tasks != said[0] for tasks in said)

    def put_together(self, queries: Sequence[Query]) -> Query | None:
        """The query of the whole; None where those of the texts differ in more than the name."""
        with suppress(QuerySyntaxError):  # too long or too deep
            return self._put_together(tuple(queries))
        return None

    def _put_together(self, queries: tuple[Query, ...]) -> Query | None:
        """At the deepest part that has all that differs."""
        first = queries[0]
        if len({tuple((path, task.task) for path, task in query.tasks) for query in queries}) > 1:
            return None
        if isinstance(first, ContextualQuery):
            return _composed(self.operator, queries) if self._differ_in_names(queries) else None
        same = [query for query in queries if isinstance(query, Composition) and query.operator is first.operator]
        differing = _differing([query.operands for query in same])
        if len(same) < len(queries) or not differing or not _carries(first.operator, differing):
            return None
        if len(differing) > 1:
            return _composed(self.operator, queries)
        (place,) = differing
        part = self._put_together(tuple(query.operands[place] for query in same))
        if part is None:
            return None
        return replace(first, operands=(*first.operands[:place], part, *first.operands[place + 1 :]))

    def _differ_in_names(self, queries: Sequence[Query]) -> bool:
        """Whether each query of the same task says its name, in one argument or in parts ("cylinder", "red")."""
        rows = [query.arguments for query in queries if isinstance(query, ContextualQuery)]
        differing = _differing(rows)
        return bool(differing) and all(
            set(row[place].split()) <= set(name)
            for place in differing
            for row, name in zip(rows, self.names, strict=True)
        )


def joined(text: str, environment: Environment) -> Iterator[Joined]:
    """The names of an environment that stand joined in a command, left to right: "A and B", "either A or B",
    "A, B and C".

    Raises:
        TextTooLongError: the text is beyond the limits of a command.
    """
    said = marked_words(text)
    groups = list(_groups(said, named(said, environment)))
    if sum(len(group) for group, _ in groups) > MOST:
        return
    for group, operator in groups:
        first = _with_article(said, group[0])
        begin = first - 1 if first > 0 and said[first - 1] in BEFORE else first
        after = [EACH.get(word, word) for word in said[group[-1][1] :]]
        after[:1] = [VERBS.get(word, word) for word in after[:1]]
        texts = [" ".join((*said[:begin], *said[_with_article(said, each) : each[1]], *after)) for each in group]
        yield Joined(operator, tuple(said[begin:end] for begin, end in group), tuple(texts))


def named(said: tuple[str, ...], environment: Environment) -> list[_Range]:
    """The ranges of words that name things of an environment; no name goes on beyond a mark."""
    marks = [place for place, word in enumerate(said) if is_mark(word)]
    return [
        (before + 1 + begin, before + 1 + end)
        for before, after in pairwise([-1, *marks, len(said)])
        for begin, end in mentions(said[before + 1 : after], environment)
    ]


def _groups(said: Sequence[str], named: Sequence[_Range]) -> Iterator[tuple[list[_Range], Operator]]:
    """Ranges of names with nothing between them but commas and one conjunction, which stands before the last."""
    group, operator = list(named[:1]), None
    for before, after in pairwise(named):
        joining = _conjunction(said[before[1] : after[0]])
        if joining is None or operator not in (None, JOINING.get(joining)):
            if operator is not None:
                yield group, operator
            group, operator = [after], None
        else:
            group.append(after)
            operator = JOINING.get(joining)
    if operator is not None:
        yield group, operator


def _conjunction(between: Sequence[str]) -> tuple[str, ...] | None:
    """The words that join two names, none for a comma alone; None where others stand between them, or nothing."""
    joining = [word for word in between if word not in DETERMINERS]
    spoken = tuple(word for word in joining if word != ",")
    return spoken if joining and (not spoken or spoken in JOINING) else None


def _with_article(said: Sequence[str], named: _Range) -> int:
    """Where a name begins with the article before it."""
    begin = named[0]
    while begin > 0 and said[begin - 1] in DETERMINERS:
        begin -= 1
    return begin


def _carries(operator: Operator, differing: Sequence[int]) -> bool:
    """Whether what is said of two names within these operands is said of each; "until" may wait for both."""
    return operator in CARRYING or (operator is Operator.UNTIL and list(differing) == [1])


def _speaks_of(task: ContextualQuery, name: Sequence[str]) -> bool:
    return any(find(name, phrase.split()) is not None for phrase in task.arguments)


def _composed(operator: Operator, queries: Sequence[Query]) -> Composition:
    """The queries put together; what the operator has put together already lies side by side with the rest."""
    parts = (q.operands if isinstance(q, Composition) and q.operator is operator else (q,) for q in queries)
    return Composition(operator, tuple(chain.from_iterable(parts)))


def _differing(rows: Sequence[Sequence[object]]) -> list[int]:
    """The places where rows of one length differ."""
    return [place for place, column in enumerate(zip(*rows, strict=True)) if len(set(column)) > 1]

"""Learned templates."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import asdict, dataclass
from typing import Any

from sqlalchemy import Connection, Row, bindparam, delete, insert, select, update

from service.errors import UnknownTemplateError
from service.store.tables import templates

# Every translation asks these two; built once, they take half the time.
_AMONG = select(templates).where(templates.c.task.in_(bindparam("tasks", expanding=True)))
_EXAMPLES = select(templates.c.examples).order_by(templates.c.task)


@dataclass(frozen=True, slots=True)
class StoredPair:
    """A contextual query and the grounded LTL it was learned with, as texts, and the environment's name."""

    contextual_query: str
    ltl: str
    environment: str


@dataclass(frozen=True, slots=True)
class StoredExample:
    """An utterance and the contextual query it says, as text."""

    text: str
    contextual_query: str


@dataclass(frozen=True, slots=True)
class StoredTemplate:
    """The template of one task. `kinds` and `taught` hold a sorted tuple of kinds per argument; `taught` is empty when
    it is not known. `reading` is the formula in English with slots such as `{1}`, empty in stores of before 0.3;
    `explanation` the words that were taught for it, empty when none were.
    """

    task: str
    template: str
    lifted: str
    kinds: tuple[tuple[str, ...], ...]
    taught: tuple[tuple[str, ...], ...]
    pairs: tuple[StoredPair, ...]
    examples: tuple[StoredExample, ...]
    warnings: tuple[str, ...]
    revision: int
    reading: str = ""
    explanation: str = ""

    @property
    def words(self) -> str:
        """What the task says, with slots for its arguments: the words that were taught, else the formula's reading."""
        return self.explanation or self.reading

    @property
    def arity(self) -> int:
        """Number of arguments of the task."""
        return len(self.kinds)


class TemplateRepository:
    """Templates by task, within one transaction."""

    def __init__(self, connection: Connection) -> None:
        self._connection = connection

    def find(self, task: str) -> StoredTemplate | None:
        """The template of the task, or None."""
        row = self._connection.execute(select(templates).where(templates.c.task == task)).first()
        return None if row is None else _read(row)

    def among(self, tasks: Collection[str]) -> dict[str, StoredTemplate]:
        """The templates of those of the tasks that have one, by task."""
        if not tasks:
            return {}
        rows = self._connection.execute(_AMONG, {"tasks": sorted(tasks)})
        return {row.task: _read(row) for row in rows}

    def get(self, task: str) -> StoredTemplate:
        """The template of the task; raises `UnknownTemplateError`."""
        found = self.find(task)
        if found is None:
            raise UnknownTemplateError(f'no template is stored for a task "{task[:100]}"; POST /learn teaches one')
        return found

    def page(self, *, after: str = "", limit: int) -> list[StoredTemplate]:
        """Up to `limit` templates in order of task, from the first whose task is greater than `after`."""
        rows = self._connection.execute(
            select(templates).where(templates.c.task > after).order_by(templates.c.task).limit(limit)
        )
        return [_read(row) for row in rows]

    def examples(self) -> list[StoredExample]:
        """Every taught utterance, in order of task."""
        rows = self._connection.scalars(_EXAMPLES)
        return [StoredExample(**example) for row in rows for example in row]

    def put(self, template: StoredTemplate) -> None:
        """Store the template, in place of the task's present one if there is one."""
        values = asdict(template)
        if self.find(template.task) is None:
            self._connection.execute(insert(templates).values(values))
        else:
            self._connection.execute(update(templates).where(templates.c.task == template.task).values(values))

    def delete(self, task: str) -> None:
        """Remove the template; raises `UnknownTemplateError`."""
        self.get(task)
        self._connection.execute(delete(templates).where(templates.c.task == task))


def _read(row: Row[Any]) -> StoredTemplate:
    return StoredTemplate(
        task=row.task,
        template=row.template,
        lifted=row.lifted,
        kinds=tuple(tuple(kinds) for kinds in row.kinds),
        taught=tuple(tuple(kinds) for kinds in row.taught),
        pairs=tuple(StoredPair(**pair) for pair in row.pairs),
        examples=tuple(StoredExample(**example) for example in row.examples),
        warnings=tuple(row.warnings),
        revision=row.revision,
        reading=row.reading,
        explanation=row.explanation,
    )

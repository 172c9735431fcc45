"""Learned templates."""

from __future__ import annotations

from collections.abc import Collection, Iterable
from dataclasses import asdict, dataclass
from typing import Any

from sqlalchemy import Connection, Row, bindparam, delete, insert, select, update

from service.errors import UnknownTemplateError
from service.names import MOST_COMPARED, or_rather
from service.store.examples import ExampleRepository, StoredExample
from service.store.tables import templates
from service.store.versions import LESSONS, raise_version

# Every translation asks this; built once, it takes half the time.
_AMONG = select(templates).where(templates.c.task.in_(bindparam("tasks", expanding=True)))


@dataclass(frozen=True, slots=True)
class StoredPair:
    """A contextual query and the grounded LTL it was learned with, as texts, and the environment's name."""

    contextual_query: str
    ltl: str
    environment: str


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

    @property
    def examples(self) -> ExampleRepository:
        """What was taught by utterances."""
        return ExampleRepository(self._connection)

    def find(self, task: str) -> StoredTemplate | None:
        """The template of the task, or None."""
        return self.among([task]).get(task)

    def among(self, tasks: Collection[str]) -> dict[str, StoredTemplate]:
        """The templates of those of the tasks that have one, by task."""
        if not tasks:
            return {}
        return self._with_examples(self._connection.execute(_AMONG, {"tasks": sorted(tasks)}))

    def get(self, task: str) -> StoredTemplate:
        """The template of the task; raises `UnknownTemplateError`."""
        found = self.find(task)
        if found is None:
            known = self._connection.scalars(select(templates.c.task).limit(MOST_COMPARED)).all()
            hint = or_rather(task, known) or "; POST /learn teaches one"
            raise UnknownTemplateError(f'no template is stored for a task "{task[:100]}"{hint}')
        return found

    def page(self, *, after: str = "", limit: int) -> list[StoredTemplate]:
        """Up to `limit` templates in order of task, from the first whose task is greater than `after`."""
        asked = select(templates).where(templates.c.task > after).order_by(templates.c.task).limit(limit)
        return list(self._with_examples(self._connection.execute(asked)).values())

    def every(self) -> dict[str, StoredTemplate]:
        """All templates by task, in order of task."""
        return self._with_examples(self._connection.execute(select(templates).order_by(templates.c.task)))

    def put(self, template: StoredTemplate) -> None:
        """Store the template, in place of the task's present one if there is one."""
        values = asdict(template)
        del values["examples"]
        known = self._connection.scalar(select(templates.c.task).where(templates.c.task == template.task))
        if known is None:
            self._connection.execute(insert(templates).values(values))
        else:
            self._connection.execute(update(templates).where(templates.c.task == template.task).values(values))
        self.examples.keep(template.task, template.examples)
        self._changed()

    def delete(self, task: str) -> None:
        """Remove the template and its examples; raises `UnknownTemplateError`."""
        self.get(task)
        self.examples.keep(task, ())
        self._connection.execute(delete(templates).where(templates.c.task == task))
        self._changed()

    def delete_example(self, task: str, key: str) -> None:
        """Remove one example of a task; raises `UnknownTemplateError`, `UnknownExampleError`."""
        known = self.get(task)
        self.examples.delete(task, key)
        revised = update(templates).where(templates.c.task == task).values(revision=known.revision + 1)
        self._connection.execute(revised)
        self._changed()

    def _changed(self) -> None:
        raise_version(self._connection, LESSONS)

    def _with_examples(self, rows: Iterable[Row[Any]]) -> dict[str, StoredTemplate]:
        found = {row.task: row for row in rows}
        taught = self.examples.of(found)
        return {task: _read(row, taught[task]) for task, row in found.items()}


def _read(row: Row[Any], examples: tuple[StoredExample, ...]) -> StoredTemplate:
    return StoredTemplate(
        task=row.task,
        template=row.template,
        lifted=row.lifted,
        kinds=tuple(tuple(kinds) for kinds in row.kinds),
        taught=tuple(tuple(kinds) for kinds in row.taught),
        pairs=tuple(StoredPair(**pair) for pair in row.pairs),
        examples=examples,
        warnings=tuple(row.warnings),
        revision=row.revision,
        reading=row.reading,
        explanation=row.explanation,
    )

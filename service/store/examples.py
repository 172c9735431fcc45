"""Utterances that were taught, each with the contextual query that it says."""

from __future__ import annotations

import hashlib
from collections.abc import Collection, Iterable
from dataclasses import dataclass

from sqlalchemy import Connection, delete, insert, select, update

from service.errors import UnknownExampleError
from service.store.tables import examples

_COLUMNS = (examples.c.task, examples.c.text, examples.c.contextual_query)


@dataclass(frozen=True, slots=True)
class StoredExample:
    """An utterance, as it was given, and the contextual query it says, as text."""

    text: str
    contextual_query: str

    @property
    def id(self) -> str:
        """Sixteen hexadecimal digits, the same for the same example wherever it is stored."""
        return hashlib.sha256(f"{self.contextual_query}\0{self.text}".encode()).hexdigest()[:16]


class ExampleRepository:
    """Examples by task, in the order in which they were taught, within one transaction."""

    def __init__(self, connection: Connection) -> None:
        self._connection = connection

    def of(self, tasks: Collection[str]) -> dict[str, tuple[StoredExample, ...]]:
        """The examples of each of the tasks."""
        asked = select(*_COLUMNS).where(examples.c.task.in_(sorted(tasks))).order_by(examples.c.task, examples.c.number)
        return _by_task(self._connection.execute(asked), tasks)

    def every(self) -> dict[str, tuple[StoredExample, ...]]:
        """All examples by task, in order of task."""
        rows = list(self._connection.execute(select(*_COLUMNS).order_by(examples.c.task, examples.c.number)))
        return _by_task(rows, [task for task, _, _ in rows])

    def readings(self) -> dict[str, bytes]:
        """What was read in the examples, by their id, as far as it was noted."""
        rows = self._connection.execute(
            select(examples.c.id, examples.c.reading).where(examples.c.reading.is_not(None))
        )
        return {row.id: row.reading for row in rows}

    def note(self, readings: Iterable[tuple[str, bytes]]) -> None:
        """Keep what was read in examples, by id; those that are gone are passed over."""
        for key, reading in readings:
            self._connection.execute(update(examples).where(examples.c.id == key).values(reading=reading))

    def keep(self, task: str, kept: Iterable[StoredExample]) -> None:
        """Make these the examples of a task; those that stay keep what was noted of them."""
        known = {row.id for row in self._connection.execute(select(examples.c.id).where(examples.c.task == task))}
        wanted = {example.id: (number, example) for number, example in enumerate(kept)}
        for key in sorted(known - wanted.keys()):
            self._connection.execute(delete(examples).where(examples.c.task == task, examples.c.id == key))
        for key, (number, example) in wanted.items():
            if key in known:
                here = (examples.c.task == task) & (examples.c.id == key)
                self._connection.execute(update(examples).where(here).values(number=number))
            else:
                values = {"text": example.text, "contextual_query": example.contextual_query, "reading": None}
                self._connection.execute(insert(examples).values(task=task, id=key, number=number, **values))

    def delete(self, task: str, key: str) -> None:
        """Remove one example of a task; raises `UnknownExampleError`."""
        gone = self._connection.execute(delete(examples).where(examples.c.task == task, examples.c.id == key))
        if gone.rowcount == 0:
            raise UnknownExampleError(f'{task} has no example with the id "{key[:100]}"')


def _by_task(rows: Iterable[tuple[str, str, str]], tasks: Iterable[str]) -> dict[str, tuple[StoredExample, ...]]:
    found: dict[str, list[StoredExample]] = {task: [] for task in tasks}
    for task, text, query in rows:
        found[task].append(StoredExample(text, query))
    return {task: tuple(group) for task, group in found.items()}

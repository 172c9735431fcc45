"""Transactions over the repositories."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass

from sqlalchemy import Connection, Engine, insert, select, text

from service.store.answers import AnswerRepository
from service.store.dialect import lock_writers
from service.store.engine import WRITE, open_engine
from service.store.environments import EnvironmentRepository
from service.store.jobs import JobRepository
from service.store.policies import PolicyRepository
from service.store.tables import facts
from service.store.templates import TemplateRepository
from service.store.versions import Versions, read_versions, read_versions_at_once


@dataclass(frozen=True, slots=True)
class Transaction:
    """The repositories within one transaction."""

    connection: Connection

    @property
    def environments(self) -> EnvironmentRepository:
        """Environments by name."""
        return EnvironmentRepository(self.connection)

    @property
    def templates(self) -> TemplateRepository:
        """Templates by task."""
        return TemplateRepository(self.connection)

    @property
    def policies(self) -> PolicyRepository:
        """Policies by id."""
        return PolicyRepository(self.connection)

    @property
    def jobs(self) -> JobRepository:
        """Jobs by id."""
        return JobRepository(self.connection)

    @property
    def answers(self) -> AnswerRepository:
        """Answers by idempotency key."""
        return AnswerRepository(self.connection)

    def versions(self) -> Versions:
        """What counts the changes of all that translations go by."""
        return read_versions(self.connection)

    def fact(self, name: str) -> str | None:
        """A single fact about the store, or None."""
        return self.connection.scalar(select(facts.c.value).where(facts.c.name == name))

    def add_fact(self, name: str, value: str) -> None:
        """Note a fact that was not there."""
        self.connection.execute(insert(facts).values(name=name, value=value))


class Store:
    """Opens transactions on one database."""

    def __init__(self, url: str, *, max_bytes: int = 0) -> None:
        self._engine: Engine = open_engine(url, max_bytes=max_bytes)

    @contextmanager
    def read(self) -> Iterator[Transaction]:
        """A transaction that only reads."""
        with self._engine.connect() as connection:
            yield Transaction(connection)

    @contextmanager
    def write(self, *, exclusive: bool = True) -> Iterator[Transaction]:
        """A transaction that writes, and commits at its end.

        It holds the lock of all `exclusive` writers from its start, so what it reads stays true until it writes.
        Without it, only its single statements are sure to see what others committed; SQLite has one lock for all.
        """
        with self._engine.connect() as connection:
            connection.execution_options(**{WRITE: True})
            with connection.begin():
                if exclusive:
                    lock_writers(connection)
                yield Transaction(connection)

    def versions(self) -> Versions:
        """As `Transaction.versions`, of now; raises SQLAlchemyError."""
        try:
            return read_versions_at_once(self._engine)
        except self._engine.dialect.loaded_dbapi.Error:
            with self.read() as transaction:  # says what is wrong, if it still is
                return transaction.versions()

    def ping(self) -> None:
        """Raise when the database does not answer or lacks its tables."""
        with self.read() as transaction:
            transaction.connection.execute(text("SELECT count(*) FROM facts"))

    def close(self) -> None:
        """Close every connection."""
        self._engine.dispose()

"""Environments, as the data they were given as."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from sqlalchemy import Connection, Text, bindparam, cast, delete, insert, select, update

from models.errors import Place
from service.errors import EnvironmentExistsError, UnknownEnvironmentError
from service.names import MOST_COMPARED, or_rather
from service.store.tables import environments
from service.store.versions import WORLDS, raise_version

_TEXT = select(cast(environments.c.data, Text)).where(environments.c.name == bindparam("name"))


@dataclass(frozen=True, slots=True)
class StoredEnvironment:
    """The data of one environment; `revision` counts from 1 and grows with each replacement."""

    name: str
    kind: str
    data: Mapping[str, Any]
    revision: int


class EnvironmentRepository:
    """Environments by name, within one transaction."""

    def __init__(self, connection: Connection) -> None:
        self._connection = connection

    def get(self, name: str) -> StoredEnvironment:
        """The environment; raises `UnknownEnvironmentError`."""
        found = self.find(name)
        if found is None:
            raise self._unknown(name)
        return found

    def find(self, name: str) -> StoredEnvironment | None:
        """The environment, or None."""
        row = self._connection.execute(select(environments).where(environments.c.name == name)).first()
        return None if row is None else StoredEnvironment(row.name, row.kind, row.data, row.revision)

    def text(self, name: str) -> str:
        """The data of the environment as JSON text; raises `UnknownEnvironmentError`."""
        found = self._connection.scalar(_TEXT, {"name": name})
        if found is None:
            raise self._unknown(name)
        return str(found)

    def page(self, *, after: str = "", limit: int) -> list[StoredEnvironment]:
        """Up to `limit` environments in order of name, from the first whose name is greater than `after`."""
        rows = self._connection.execute(
            select(environments).where(environments.c.name > after).order_by(environments.c.name).limit(limit)
        )
        return [StoredEnvironment(row.name, row.kind, row.data, row.revision) for row in rows]

    def add(self, name: str, kind: str, data: Mapping[str, Any]) -> StoredEnvironment:
        """Store a new environment; raises `EnvironmentExistsError`."""
        if self._connection.scalar(select(environments.c.name).where(environments.c.name == name)) is not None:
            detail = f'an environment called "{name}" is stored already; PUT replaces it, and `cqltl import --replace`'
            raise EnvironmentExistsError(detail, places=[Place("/name", detail)])
        self._connection.execute(insert(environments).values(name=name, kind=kind, data=dict(data), revision=1))
        raise_version(self._connection, WORLDS)
        return StoredEnvironment(name, kind, data, 1)

    def put(self, name: str, kind: str, data: Mapping[str, Any]) -> StoredEnvironment:
        """Store an environment, in place of the one of that name if there is one."""
        revision = self._connection.scalar(select(environments.c.revision).where(environments.c.name == name))
        if revision is None:
            return self.add(name, kind, data)
        self._connection.execute(
            update(environments)
            .where(environments.c.name == name)
            .values(kind=kind, data=dict(data), revision=revision + 1)
        )
        raise_version(self._connection, WORLDS)
        return StoredEnvironment(name, kind, data, revision + 1)

    def delete(self, name: str) -> None:
        """Remove the environment; raises `UnknownEnvironmentError`."""
        self.get(name)
        self._connection.execute(delete(environments).where(environments.c.name == name))
        raise_version(self._connection, WORLDS)

    def _unknown(self, name: str) -> UnknownEnvironmentError:
        known = self._connection.scalars(select(environments.c.name).limit(MOST_COMPARED)).all()
        return UnknownEnvironmentError(f'no environment is called "{name[:100]}"{or_rather(name, known)}')

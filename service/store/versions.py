"""Versions of what translations go by: numbers that grow with every change, as facts of the store.

They are raised in the transaction of the change, by writers that have the lock of all `exclusive` ones.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from contextlib import closing
from typing import NamedTuple

from sqlalchemy import Connection, Engine, insert, select, update

from service.store.tables import facts

LESSONS = "lessons"
"""Fact that counts the changes of what was taught."""
WORLDS = "worlds"
"""Fact that counts the changes of environments."""

_READ = select(facts.c.name, facts.c.value).where((facts.c.name == LESSONS) | (facts.c.name == WORLDS))
_SQL = str(_READ.compile(compile_kwargs={"literal_binds": True}))


class Versions(NamedTuple):
    """As long as one stays the same, so does all that it counts the changes of: `lessons` all templates and examples,
    `worlds` all environments.
    """

    lessons: int
    worlds: int


def read_versions(connection: Connection) -> Versions:
    """The versions, as the transaction sees them."""
    return _versions(connection.execute(_READ).all())


def read_versions_at_once(engine: Engine) -> Versions:
    """The versions of now. Every request asks for them, so it is the driver that is asked: a fifth of the time."""
    with closing(engine.raw_connection()) as connection, closing(connection.cursor()) as cursor:
        cursor.execute(_SQL)
        return _versions(cursor.fetchall())


def _versions(rows: Iterable[Sequence[str]]) -> Versions:
    found = {name: int(value) for name, value in rows}
    return Versions(found.get(LESSONS, 0), found.get(WORLDS, 0))


def raise_version(connection: Connection, name: str) -> None:
    """Note a change."""
    value = connection.scalar(select(facts.c.value).where(facts.c.name == name))
    if value is None:
        connection.execute(insert(facts).values(name=name, value="1"))
    else:
        connection.execute(update(facts).where(facts.c.name == name).values(value=str(int(value) + 1)))

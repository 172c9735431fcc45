"""Whether a database is one of ours and whole, asked before anything is written to it."""

from __future__ import annotations

import sqlite3
from collections.abc import Collection, Iterator
from contextlib import contextmanager
from pathlib import Path
from urllib.parse import quote

from sqlalchemy import Connection, inspect, text
from sqlalchemy.engine import make_url
from sqlalchemy.exc import DBAPIError

from service.errors import CannotStartError
from service.store.engine import BUSY_TIMEOUT_S, is_postgresql, open_engine

MAGIC = b"SQLite format 3\0"
"""How every SQLite file begins (sqlite.org/fileformat.html, 1.3)."""

CHECKED_BYTES = 256 * 2**20
"""Larger files are not read whole at every start; `cqltl doctor` does."""

TABLES = frozenset({"facts", "templates", "environments", "policies"})
"""Tables that every revision has."""


class UnusableStoreError(CannotStartError):
    """The database is not one of ours, is damaged, or does not answer."""


def check_store(url: str, known: Collection[str], *, whole: bool = False) -> None:
    """Raise `UnusableStoreError` for a database that must not be touched; `known` are the revisions of this version.

    A database without any table is as good as a new one. `whole` reads all of a SQLite file, however large it is.
    """
    if is_postgresql(url):
        with opened(url) as connection:
            _check_encoding(shown(url), str(connection.scalar(text("SHOW server_encoding"))))
            tables = set(inspect(connection).get_table_names())
            revision = _revision(connection, tables)
        _check_tables(shown(url), tables & TABLES, revision, known)  # it may hold other things too
        return
    path = sqlite_file(url)
    if path is not None and path.exists():
        _check_file(path, known, whole)


def sqlite_file(url: str) -> Path | None:
    """The file of a SQLite URL; None where it has none of its own."""
    parsed = make_url(url)
    name = parsed.database or ""
    if parsed.get_backend_name() != "sqlite" or name in ("", ":memory:") or name.startswith("file:"):
        return None
    return Path(name)


def first_line(error: BaseException) -> str:
    """What an error of a database says, without the statement and the advice that follow."""
    said = str(error.orig if isinstance(error, DBAPIError) and error.orig is not None else error)
    return said.strip().partition("\n")[0] or type(error).__name__


def shown(url: str) -> str:
    """A URL without its password."""
    return make_url(url).render_as_string(hide_password=True)


@contextmanager
def opened(url: str) -> Iterator[Connection]:
    """A connection of its own; raises `UnusableStoreError`."""
    engine = open_engine(url)
    try:
        with engine.connect() as connection:
            yield connection
    except (DBAPIError, OSError) as error:
        raise UnusableStoreError(f"{shown(url)}: {first_line(error)}") from error
    finally:
        engine.dispose()


def _check_file(path: Path, known: Collection[str], whole: bool) -> None:
    try:
        with path.open("rb") as file:
            head, size = file.read(len(MAGIC)), path.stat().st_size
    except OSError as error:
        raise UnusableStoreError(f"{path}: {error.strerror or error}") from error
    if not head:
        journal = path.with_name(f"{path.name}-wal")
        if journal.exists() and journal.stat().st_size:
            raise UnusableStoreError(f"{path} is empty, but {journal.name} beside it is not: it was truncated")
        return
    if head != MAGIC:
        raise UnusableStoreError(f"{path} is not a SQLite database; it was left as it is")
    try:
        _check_sqlite(path, known, thorough=whole or size <= CHECKED_BYTES)
    except sqlite3.Error as error:
        if error.sqlite_errorcode & 0xFF not in (sqlite3.SQLITE_READONLY, sqlite3.SQLITE_BUSY):
            # Those two are of one who writes, or was killed when it did: not for a reader to put right.
            raise UnusableStoreError(f"{path} is damaged ({error}); it was left as it is") from error


def _check_sqlite(path: Path, known: Collection[str], *, thorough: bool) -> None:
    connection = sqlite3.connect(f"file:{quote(str(path.absolute()))}?mode=ro", uri=True, timeout=BUSY_TIMEOUT_S)
    try:
        tables = {name for (name,) in connection.execute("SELECT name FROM sqlite_master WHERE type = 'table'")}
        found = connection.execute("SELECT version_num FROM alembic_version") if "alembic_version" in tables else []
        _check_tables(str(path), tables, next((str(revision) for (revision,) in found), None), known)
        if thorough:
            (said,) = connection.execute("PRAGMA quick_check(1)").fetchone()
            if said != "ok":
                what = " ".join(str(said).split())
                raise UnusableStoreError(f"{path} is damaged ({what}); it was left as it is")
    finally:
        connection.close()


def _revision(connection: Connection, tables: Collection[str]) -> str | None:
    if "alembic_version" not in tables:  # another may migrate meanwhile: one look at the tables decides
        return None
    found = connection.scalar(text("SELECT version_num FROM alembic_version"))
    return None if found is None else str(found)


def _check_encoding(place: str, encoding: str) -> None:
    """PostgreSQL checks and compares texts, JSON among them, as its encoding says; what a new server has is not UTF8
    where it was set up without a locale.
    """
    if encoding != "UTF8":
        raise UnusableStoreError(
            f"{place} is in the encoding {encoding}, not UTF8: take a database that was made with "
            "CREATE DATABASE ... ENCODING 'UTF8' TEMPLATE template0"
        )


def _check_tables(place: str, tables: set[str], revision: str | None, known: Collection[str]) -> None:
    if revision is None:
        if tables:
            raise UnusableStoreError(f"{place} belongs to something else than cqltl; it was left as it is")
        return
    if revision not in known:
        raise UnusableStoreError(
            f"{place} is of a newer version of cqltl, or of something else (revision {revision}); it was left as it is"
        )
    if not tables >= TABLES:
        raise UnusableStoreError(f"{place} lacks tables of cqltl: {', '.join(sorted(TABLES - tables))}")

"""The only place that opens a database engine."""

from __future__ import annotations

from functools import partial
from pathlib import Path
from typing import Any

from sqlalchemy import Connection, Engine, create_engine, event
from sqlalchemy.engine import make_url

BUSY_TIMEOUT_S = 10.0
"""Longest wait for another writer, in seconds."""
CONNECT_TIMEOUT_S = 10
"""Longest wait for PostgreSQL to let one in, in seconds."""
WRITE = "cqltl_write"
"""Execution option of a connection that will write: SQLite then takes the write lock at once."""

POOL = 20
"""Connections to PostgreSQL that are kept; as many more may be open for a while."""


def is_postgresql(url: str) -> bool:
    """The URL names a PostgreSQL database."""
    return make_url(url).get_backend_name() == "postgresql"


def open_engine(url: str, *, max_bytes: int = 0) -> Engine:
    """An engine for the URL: PostgreSQL, or SQLite in WAL mode, with the folder of its file made when missing, which
    grows to `max_bytes` at most unless they are 0.
    """
    parsed = make_url(url)
    if is_postgresql(url):
        # Connections that a restart of the database broke are replaced before they are used.
        return create_engine(
            parsed.set(drivername="postgresql+psycopg"),
            pool_pre_ping=True,
            pool_size=POOL,
            max_overflow=POOL,
            # Whatever the database is in: of one in SQL_ASCII the driver would give bytes for every text.
            connect_args={"connect_timeout": CONNECT_TIMEOUT_S, "client_encoding": "utf8"},
        )
    if parsed.get_backend_name() != "sqlite":
        return create_engine(parsed)
    if parsed.database and parsed.database != ":memory:":
        Path(parsed.database).parent.mkdir(parents=True, exist_ok=True)
    engine = create_engine(parsed, connect_args={"timeout": BUSY_TIMEOUT_S})
    event.listen(engine, "connect", _configure_sqlite)
    if max_bytes:
        event.listen(engine, "connect", partial(_limit_sqlite, max_bytes))
    event.listen(engine, "begin", _begin_sqlite)
    return engine


def _configure_sqlite(connection: Any, _record: object) -> None:
    connection.isolation_level = None  # the driver must not begin transactions; _begin_sqlite does
    connection.execute("PRAGMA journal_mode = WAL")
    connection.execute("PRAGMA synchronous = FULL")  # a commit survives a power cut, not only a killed process


def _limit_sqlite(max_bytes: int, connection: Any, _record: object) -> None:
    (page,) = connection.execute("PRAGMA page_size").fetchone()
    connection.execute(f"PRAGMA max_page_count = {max(1, max_bytes // page)}")


def _begin_sqlite(connection: Connection) -> None:
    # A deferred transaction that reads and then writes fails when another writer came between; taking the
    # lock first makes it wait instead.
    write = connection.get_execution_options().get(WRITE, False)
    connection.exec_driver_sql("BEGIN IMMEDIATE" if write else "BEGIN")

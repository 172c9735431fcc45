"""The store: whether it can be reached, is one of ours, whole and of this version, and has room. Nothing is written."""

from __future__ import annotations

import os
import shutil
import sqlite3
from pathlib import Path
from urllib.parse import quote

from sqlalchemy import inspect, text

from service.doctor.findings import Finding, Findings, ok, tried, warning, wrong
from service.errors import CannotStartError
from service.settings import Settings
from service.store.engine import is_postgresql
from service.store.migrate import revisions
from service.store.soundness import check_store, opened, shown, sqlite_file

LITTLE_BYTES = 256 * 2**20
"""Free space below which a warning is due: some thousand policies."""


def examine_database(settings: Settings) -> Findings:
    """Look at the store that the settings name."""
    url = settings.url
    try:
        check_store(url, revisions(), whole=True)
    except CannotStartError as error:
        yield wrong("store", str(error))
    else:
        yield from _postgresql(url) if is_postgresql(url) else _sqlite(url)
    path = sqlite_file(url)
    if path is not None:
        yield from _room(settings, path)


def _postgresql(url: str) -> Findings:
    with opened(url) as connection:
        server = connection.scalar(text("SHOW server_version"))
        yield ok("store", f"{shown(url)}, PostgreSQL {server}")
        known = inspect(connection).has_table("alembic_version")
        yield _migrated(connection.scalar(text("SELECT version_num FROM alembic_version")) if known else None)
    if known:
        yield tried("queue", lambda: _queue(url))


def _queue(url: str) -> str:
    with opened(url) as connection:
        count = connection.scalar(text("SELECT count(*) FROM procrastinate_workers"))
        waiting = connection.scalar(text("SELECT count(*) FROM jobs WHERE state = 'queued' AND owner IS NULL"))
    return f"{waiting} plans wait; {count} workers are known"


def _sqlite(url: str) -> Findings:
    path = sqlite_file(url)
    if path is None or not path.exists() or not path.stat().st_size:
        yield ok("store", f"{path or shown(url)} is made at the first start")
        return
    yield ok("store", f"{path}, {path.stat().st_size} bytes, SQLite {sqlite3.sqlite_version}")
    connection = sqlite3.connect(f"file:{quote(str(path.absolute()))}?mode=ro", uri=True)
    try:
        tables = {name for (name,) in connection.execute("SELECT name FROM sqlite_master")}
        row = connection.execute("SELECT version_num FROM alembic_version").fetchone() if tables else None
        yield _migrated(None if row is None else row[0])
        said = [line for (line,) in connection.execute("PRAGMA integrity_check(5)")]
        broken = connection.execute("PRAGMA foreign_key_check").fetchall()
        if said == ["ok"] and not broken:
            yield ok("integrity", "every page and every index is sound")
        else:
            yield wrong("integrity", "; ".join(said) if said != ["ok"] else f"{len(broken)} rows refer to none")
    except sqlite3.Error as error:
        yield wrong("integrity", str(error))
    finally:
        connection.close()


def _migrated(revision: str | None) -> Finding:
    head = revisions()[0]
    if revision == head:
        return ok("migrations", f"at {head}, the newest")
    return warning("migrations", f"at {revision or 'none'}; the next start brings it to {head}")


def _room(settings: Settings, path: Path) -> Findings:
    folder = path.parent.absolute()
    there = next(found for found in (folder, *folder.parents) if found.exists())
    closed = path.exists() and not os.access(path, os.W_OK)
    if closed or not there.is_dir() or not os.access(there, os.W_OK | os.X_OK):
        yield wrong("room", f"{path} cannot be written")
        return
    free = shutil.disk_usage(there).free
    if free < LITTLE_BYTES:
        yield warning("room", f"{free} bytes are free at {there}")
    else:
        yield ok("room", f"{free // 2**20} MiB are free at {there}")
    size = path.stat().st_size if path.exists() else 0
    if settings.max_store_bytes and size > 0.9 * settings.max_store_bytes:
        yield warning("room", f"{path} is near CQLTL_MAX_STORE_BYTES ({size} of {settings.max_store_bytes} bytes)")

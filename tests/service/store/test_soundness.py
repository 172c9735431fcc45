"""Databases that are not touched: of others, damaged, newer."""

from __future__ import annotations

import random
import shutil
import sqlite3
from pathlib import Path

import pytest
from sqlalchemy import Engine, event

from service.store.engine import open_engine
from service.store.migrate import migrate, revisions
from service.store.soundness import UnusableStoreError, check_store
from tests.service.postgres import Postgres


def url_of(path: Path) -> str:
    return f"sqlite:///{path}"


@pytest.fixture
def store(tmp_path: Path) -> Path:
    """A store of some pages, closed."""
    path = tmp_path / "store.sqlite3"
    migrate(url_of(path))
    connection = sqlite3.connect(path)
    with connection:
        rows = [(f"name{number}", "x" * 3_000) for number in range(60)]
        connection.executemany("INSERT INTO facts (name, value) VALUES (?, ?)", rows)
    connection.execute("PRAGMA wal_checkpoint(TRUNCATE)")
    connection.close()
    return path


def refused(path: Path) -> str:
    """That it is refused, in a line, and left as it is: the line."""
    before = path.read_bytes()
    with pytest.raises(UnusableStoreError) as caught:
        migrate(url_of(path))
    assert path.read_bytes() == before
    line = str(caught.value)
    assert "\n" not in line
    assert str(path) in line
    return line


def test_what_is_ours_is_taken(store: Path, tmp_path: Path) -> None:
    migrate(url_of(store))
    migrate(url_of(tmp_path / "new" / "store.sqlite3"))
    (tmp_path / "empty.sqlite3").touch()
    migrate(url_of(tmp_path / "empty.sqlite3"))


def test_what_is_ours_and_was_not_closed_is_taken(store: Path, tmp_path: Path) -> None:
    """As a killed server leaves it: the newest pages are in the journal only."""
    connection = sqlite3.connect(store)
    connection.execute("PRAGMA wal_autocheckpoint = 0")
    with connection:
        connection.execute("UPDATE facts SET value = value || 'y'")
    copy = tmp_path / "killed" / store.name
    copy.parent.mkdir()
    for end in ("", "-wal"):
        shutil.copy(f"{store}{end}", f"{copy}{end}")
    connection.close()
    migrate(url_of(copy))
    with sqlite3.connect(copy) as found:
        assert found.execute("SELECT count(*) FROM facts WHERE value LIKE '%y'").fetchone() == (60,)
    found.close()


@pytest.mark.parametrize("content", [b"hello", b"%PDF-1.7\n" * 1_000, b"\0" * 8_192, b"SQLite format 2\0" * 300])
def test_another_file(tmp_path: Path, content: bytes) -> None:
    path = tmp_path / "store.sqlite3"
    path.write_bytes(content)
    assert "not a SQLite database" in refused(path)


@pytest.mark.parametrize("share", [0.9, 0.5, 0.1])
def test_a_truncated_file(store: Path, share: float) -> None:
    content = store.read_bytes()
    store.write_bytes(content[: int(len(content) * share)])
    assert "damaged" in refused(store)


def test_only_the_first_bytes_of_a_file(store: Path) -> None:
    store.write_bytes(store.read_bytes()[:50])
    assert "damaged" in refused(store)


def test_a_file_that_was_truncated_to_nothing_beside_its_journal(store: Path) -> None:
    Path(f"{store}-wal").write_bytes(b"something")
    store.write_bytes(b"")
    assert "truncated" in refused(store)


@pytest.mark.parametrize("seed", range(5))
def test_pages_of_noise(store: Path, seed: int) -> None:
    noise = random.Random(seed)
    content = bytearray(store.read_bytes())
    for page in noise.sample(range(1, len(content) // 4_096), 25):
        content[page * 4_096 : page * 4_096 + 200] = noise.randbytes(200)
    store.write_bytes(content)
    assert "damaged" in refused(store)


def test_the_database_of_another_program(tmp_path: Path) -> None:
    path = tmp_path / "store.sqlite3"
    connection = sqlite3.connect(path)
    connection.execute("PRAGMA journal_mode = WAL")
    connection.execute("CREATE TABLE moz_places (url TEXT)")
    connection.close()
    assert "something else" in refused(path)


def test_the_database_of_another_program_that_migrates_the_same_way(store: Path) -> None:
    with sqlite3.connect(store) as connection:
        connection.execute("DROP TABLE templates")
    connection.close()
    assert "lacks tables of cqltl: templates" in refused(store)


def test_the_store_of_a_newer_version(store: Path) -> None:
    with sqlite3.connect(store) as connection:
        connection.execute("UPDATE alembic_version SET version_num = '9999'")
    connection.close()
    assert "newer version of cqltl, or of something else (revision 9999)" in refused(store)


def test_a_folder_in_place_of_the_file(tmp_path: Path) -> None:
    (tmp_path / "store.sqlite3").mkdir()
    with pytest.raises(UnusableStoreError, match="directory"):
        check_store(url_of(tmp_path / "store.sqlite3"), ["0001"])


def test_a_folder_that_cannot_be_made(tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    with pytest.raises(UnusableStoreError, match="file"):
        migrate(url_of(tmp_path / "file" / "store.sqlite3"))


def test_postgresql_of_something_else(postgres: Postgres) -> None:
    url = postgres.database()
    engine = open_engine(url)
    with engine.begin() as connection:
        connection.exec_driver_sql("CREATE TABLE unrelated (a int)")
    migrate(url)  # databases are shared
    with engine.begin() as connection:
        connection.exec_driver_sql("UPDATE alembic_version SET version_num = '9999'")
    with pytest.raises(UnusableStoreError, match="9999"):
        migrate(url)
    engine.dispose()


def test_postgresql_that_another_migrates_while_it_is_looked_at(postgres: Postgres) -> None:
    url, known, seen = postgres.database(), revisions(), False

    def migrate_once(*_: object) -> None:
        nonlocal seen
        if not seen:
            seen = True
            migrate(url)

    event.listen(Engine, "after_cursor_execute", migrate_once)
    try:
        check_store(url, known)  # its first statement finds no table, its next would find all
    finally:
        event.remove(Engine, "after_cursor_execute", migrate_once)
    assert seen
    check_store(url, known)


@pytest.mark.parametrize("encoding", ["SQL_ASCII", "LATIN1"])
def test_postgresql_in_another_encoding(postgres: Postgres, encoding: str) -> None:
    url = postgres.database(f"ENCODING '{encoding}' TEMPLATE template0")
    with pytest.raises(UnusableStoreError, match=f"{encoding}, not UTF8"):
        migrate(url)


def test_postgresql_that_is_not_there() -> None:
    with pytest.raises(UnusableStoreError, match=r"127\.0\.0\.1") as caught:
        migrate("postgresql+psycopg://someone:secret@127.0.0.1:9/none")
    assert "\n" not in str(caught.value)
    assert "secret" not in str(caught.value)

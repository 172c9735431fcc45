"""The store: migrations, concurrent writers, what is refused."""

from __future__ import annotations

import json
import subprocess
import sys
import threading
from dataclasses import asdict, replace
from pathlib import Path
from typing import Any

import pytest
from alembic import command
from alembic.autogenerate import compare_metadata
from alembic.config import Config
from alembic.migration import MigrationContext
from sqlalchemy import JSON, Integer, String, column, insert, inspect, text
from sqlalchemy import table as sql_table

from service.errors import (
    EnvironmentExistsError,
    UnknownEnvironmentError,
    UnknownExampleError,
    UnknownPolicyError,
    UnknownTemplateError,
)
from service.store import Store, StoredExample, StoredPair, StoredPolicy, StoredTemplate, Transaction
from service.store.engine import open_engine
from service.store.migrate import migrate
from service.store.policies import PolicyEntry
from service.store.tables import metadata

OLD_TEMPLATES = sql_table(
    "templates",
    *(column(name, String) for name in ("task", "template", "lifted")),
    *(column(name, JSON) for name in ("kinds", "taught", "pairs", "examples", "warnings")),
    column("revision", Integer),
)
"""As of before the examples had a table of their own."""


@pytest.fixture(params=["sqlite", "postgresql"])
def empty(request: pytest.FixtureRequest, tmp_path: Path) -> str:
    """The URL of a database without tables."""
    if request.param == "sqlite":
        return f"sqlite:///{tmp_path / 'folder' / 'store.sqlite3'}"
    return str(request.getfixturevalue("postgres").database())


@pytest.fixture
def url(empty: str) -> str:
    migrate(empty)
    return empty


def ours(table: str) -> bool:
    """Not a table of the queue."""
    return not table.startswith("procrastinate_")


def of_the_code(thing: Any, name: str | None, kind: str, _reflected: bool, _compared: object) -> bool:
    """For Alembic: whether the code is to have it."""
    return ours(str(name) if kind == "table" else str(getattr(thing, "table", "")))


def template(task: str, revision: int = 1) -> StoredTemplate:
    return StoredTemplate(
        task=task,
        template="F holding($1)",
        lifted="F holding(t)",
        kinds=(("box", "toy"),),
        taught=(("toy",),),
        pairs=(StoredPair(f"{task}(a)", "F holding(a)", "toys"),),
        examples=(StoredExample("take a", f"{task}(a)"),),
        warnings=("odd",),
        revision=revision,
        reading="eventually the robot is holding {1}",
        explanation="{1} is taken",
    )


def test_the_migrations_make_the_tables_of_the_code(url: str) -> None:
    engine = open_engine(url)
    with engine.connect() as connection:
        context = MigrationContext.configure(connection, opts={"include_object": of_the_code})
        assert compare_metadata(context, metadata) == []
        if connection.dialect.name == "sqlite":
            assert connection.exec_driver_sql("PRAGMA journal_mode").scalar() == "wal"
    engine.dispose()


def test_migrating_twice_changes_nothing(url: str) -> None:
    store = Store(url)
    with store.write() as transaction:
        transaction.templates.put(template("t"))
    migrate(url)
    with store.read() as transaction:
        assert transaction.templates.get("t") == template("t")
    store.close()


def alembic(url: str) -> Config:
    config = Config()
    config.set_main_option("script_location", str(Path(__file__).parents[3] / "migrations"))
    config.attributes["url"] = url
    return config


def put_as_before_0_3(transaction: Transaction, new: StoredTemplate) -> None:
    """Store a template where the columns of explanations are not there yet."""
    values = {name: value for name, value in asdict(new).items() if name not in ("reading", "explanation")}
    transaction.connection.execute(insert(OLD_TEMPLATES).values(values))


def test_templates_of_before_0_3_are_kept_and_have_no_reading(tmp_path: Path) -> None:
    url = f"sqlite:///{tmp_path / 'store.sqlite3'}"
    command.upgrade(alembic(url), "0003")
    store = Store(url)
    with store.write() as transaction:
        put_as_before_0_3(transaction, template("t"))
    migrate(url)
    with store.write() as transaction:
        known = transaction.templates.get("t")
        assert known == replace(template("t"), reading="", explanation="")
        assert known.words == ""
        transaction.templates.put(template("t"))
    command.downgrade(alembic(url), "0003")
    migrate(url)
    with store.read() as transaction:
        assert transaction.templates.get("t") == known
    store.close()


def test_the_first_revision_can_be_undone(url: str) -> None:
    command.downgrade(alembic(url), "base")
    engine = open_engine(url)
    assert set(inspect(engine).get_table_names()) == {"alembic_version"}
    engine.dispose()


def test_two_who_migrate_at_once_do_not_collide(empty: str) -> None:
    script = "import sys; from service.store.migrate import migrate; migrate(sys.argv[1])"
    both = [subprocess.Popen([sys.executable, "-c", script, empty]) for _ in range(2)]
    assert [process.wait(60) for process in both] == [0, 0]
    store = Store(empty)
    store.ping()
    store.close()


def test_policies_of_before_0_3_are_deleted_and_all_else_is_kept(empty: str) -> None:
    url = empty
    command.upgrade(alembic(url), "0002")
    store = Store(url)
    with store.write() as transaction:
        put_as_before_0_3(transaction, template("t"))
        transaction.environments.add("e", "oomdp", {"a": 1})
        old = text("INSERT INTO policies (id, environment, ltl, data) VALUES ('p', 'e', 'F a', :data)")
        transaction.connection.execute(old, {"data": b"cqltl\x00p1"})
    migrate(url)
    new = StoredPolicy("p", "e", "F a", "max", "{}", b"cqltl\x00p2")
    with store.write() as transaction:
        assert transaction.policies.page(limit=9) == []
        with pytest.raises(UnknownPolicyError):
            transaction.policies.get("p")
        assert transaction.templates.get("t") == replace(template("t"), reading="", explanation="")
        assert transaction.environments.get("e").data == {"a": 1}
        transaction.policies.add(new)
    command.downgrade(alembic(url), "0002")
    migrate(url)
    with store.read() as transaction:
        assert transaction.policies.page(limit=9) == []
        assert transaction.templates.get("t").examples == template("t").examples
    store.close()


def test_what_was_taught_has_a_version_and_examples_can_go_one_by_one(url: str) -> None:
    store, added = Store(url), StoredExample("get hold of a", "t(a)")
    taught = replace(template("t"), examples=(*template("t").examples, added))
    with store.write() as transaction:
        assert transaction.versions().lessons == 0
        transaction.templates.put(template("t"))
        transaction.templates.examples.note([(template("t").examples[0].id, b"read"), (added.id, b"not there yet")])
        transaction.templates.put(taught)
        assert transaction.versions().lessons == 2
        assert transaction.templates.get("t") == taught
        assert transaction.templates.examples.readings() == {template("t").examples[0].id: b"read"}
        transaction.templates.delete_example("t", taught.examples[0].id)
        assert transaction.templates.get("t") == replace(taught, examples=(added,), revision=2)
        assert transaction.versions().lessons == 3
        with pytest.raises(UnknownExampleError):
            transaction.templates.delete_example("t", taught.examples[0].id)
        transaction.templates.delete("t")
        assert transaction.templates.every() == {}
        assert transaction.templates.examples.every() == {}
        assert transaction.versions().lessons == 4
    store.close()


def test_rows_come_back_as_they_were_put(url: str) -> None:
    store, policy = Store(url), StoredPolicy("p", "e", "F a", "min", '{"name": "e"}', b"\x00\xff")
    with store.write() as transaction:
        transaction.templates.put(template("b"))
        transaction.templates.put(template("a"))
        transaction.templates.put(template("a", 2))
        transaction.environments.add("e", "oomdp", {"z": [1], "a": {"nested": "ö"}})
        transaction.policies.add(policy)
        transaction.policies.add(policy)
    with store.read() as transaction:
        assert transaction.templates.page(limit=9) == [template("a", 2), template("b")]
        assert transaction.templates.page(after="a", limit=9) == [template("b")]
        assert list(transaction.templates.every()) == ["a", "b"]
        assert transaction.templates.among(["a", "c"]) == {"a": template("a", 2)}
        assert transaction.templates.among([]) == {}
        assert list(transaction.environments.get("e").data) == ["z", "a"]
        assert json.loads(transaction.environments.text("e")) == {"z": [1], "a": {"nested": "ö"}}
        assert transaction.policies.get("p") == policy
        assert transaction.policies.page(limit=9) == [PolicyEntry("p", "e", "F a", "min")]
    store.close()


def test_a_failed_transaction_stores_nothing(url: str) -> None:
    store = Store(url)

    def write() -> None:
        with store.write() as transaction:
            transaction.templates.put(template("half"))
            transaction.environments.add("half", "oomdp", {})
            transaction.templates.delete("missing")

    with pytest.raises(UnknownTemplateError):
        write()
    with store.read() as transaction:
        assert transaction.templates.find("half") is None
        for read in (transaction.environments.get, transaction.environments.text):
            with pytest.raises(UnknownEnvironmentError, match="half"):
                read("half")
    store.close()


def test_names_are_taken_once(url: str) -> None:
    store = Store(url)
    with store.write() as transaction:
        assert transaction.environments.add("e", "oomdp", {}).revision == 1
        with pytest.raises(EnvironmentExistsError):
            transaction.environments.add("e", "explicit", {})
        assert transaction.environments.put("e", "explicit", {}).revision == 2
    store.close()


def test_eight_writers_lose_nothing(url: str) -> None:
    """Read, then write what was read plus one: with deferred transactions most of these would fail."""
    store, each = Store(url), 25
    with store.write() as transaction:
        transaction.templates.put(template("count", 0))
    failures: list[Exception] = []

    def write() -> None:
        own = Store(url)
        for _ in range(each):
            try:
                with own.write() as transaction:
                    known = transaction.templates.get("count")
                    transaction.templates.put(template("count", known.revision + 1))
            except Exception as error:
                failures.append(error)
        own.close()

    threads = [threading.Thread(target=write) for _ in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert failures == []
    with store.read() as transaction:
        assert transaction.templates.get("count").revision == 8 * each
    store.close()

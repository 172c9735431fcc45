"""A store of every revision there has been comes to the newest one with what it holds."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from alembic import command
from alembic.config import Config
from alembic.script import ScriptDirectory
from sqlalchemy import MetaData, Table, insert, select

from service.store import Store
from service.store.engine import open_engine
from service.store.migrate import migrate

MIGRATIONS = Path(__file__).parents[3] / "migrations"
EXAMPLE = {"text": "take the sphere", "contextual_query": "take(sphere)"}
POLICIES_ARE_KEPT_FROM = "0003"
"""Those of before are in a form that is not read any more."""

ROWS: dict[str, dict[str, Any]] = {
    "environments": {"name": "e", "kind": "oomdp", "data": {"a": [1, "ü"]}, "revision": 3},
    "templates": {
        "task": "take",
        "template": "F holding($1)",
        "lifted": "F holding(t)",
        "kinds": [["box", "toy"]],
        "taught": [["toy"]],
        "pairs": [{"contextual_query": "take(sphere)", "ltl": "F holding(sphere)", "environment": "toys"}],
        "examples": [EXAMPLE],
        "warnings": ["odd"],
        "revision": 2,
        "reading": "eventually the robot is holding {1}",
        "explanation": "{1} is taken",
    },
    "examples": {"task": "take", "id": "0123456789abcdef", "number": 0, "reading": b"read", **EXAMPLE},
    "policies": {
        "id": "p",
        "environment": "e",
        "ltl": "F holding(sphere)",
        "objective": "max",
        "world": '{"kind": "explicit"}',
        "data": b"cqltl\x00p2\xff",
    },
    "facts": {"name": "f", "value": "v"},
    "jobs": {
        "id": "j",
        "state": "failed",
        "accepted": True,
        "queue": "plan",
        "environment": "e",
        "ltl": "F a",
        "work": "{}",
        "told": "{}",
        "progress": None,
        "answer": None,
        "policy_id": None,
        "error": '{"slug": "out-of-time", "detail": "too long"}',
        "attempts": 1,
        "owner": None,
        "lease_until": None,
        "created_at": 1.5,
        "deadline": 2.5,
        "ended_at": 2.5,
    },
    "kept_answers": {
        "operation": "plan",
        "key": "k",
        "digest": "d",
        "job_id": "j",
        "status": None,
        "location": None,
        "body": None,
        "created_at": 1.5,
    },
}
"""A row of each table, with every column that it has had in any revision."""


def revisions() -> list[str]:
    config = Config()
    config.set_main_option("script_location", str(MIGRATIONS))
    return [script.revision for script in reversed(list(ScriptDirectory.from_config(config).walk_revisions()))]


@pytest.fixture(params=["sqlite", "postgresql"])
def url(request: pytest.FixtureRequest, tmp_path: Path) -> str:
    if request.param == "sqlite":
        return f"sqlite:///{tmp_path / 'store.sqlite3'}"
    return str(request.getfixturevalue("postgres").database())


def upgrade(url: str, revision: str) -> None:
    config = Config()
    config.set_main_option("script_location", str(MIGRATIONS))
    config.attributes["url"] = url
    command.upgrade(config, revision)


def tables(url: str) -> dict[str, Table]:
    """Ours, as they are in the database; the queue has others."""
    engine, found = open_engine(url), MetaData()
    found.reflect(engine, only=lambda name, _: not name.startswith(("procrastinate_", "alembic_")))
    engine.dispose()
    return found.tables  # type: ignore[return-value]


def rows(url: str) -> dict[str, list[dict[str, Any]]]:
    engine = open_engine(url)
    with engine.connect() as connection:
        found = {
            name: [dict(row) for row in connection.execute(select(table)).mappings()]
            for name, table in tables(url).items()
        }
    engine.dispose()
    return found


def fill(url: str) -> None:
    """A row in each table that is there, with the columns that are there."""
    engine = open_engine(url)
    with engine.begin() as connection:
        for name, table in tables(url).items():
            row = {column.name: ROWS[name][column.name] for column in table.columns}
            connection.execute(insert(table).values(row))
    engine.dispose()


@pytest.mark.parametrize("revision", revisions())
def test_what_a_store_holds_is_kept_from_every_revision(url: str, revision: str) -> None:
    upgrade(url, revision)
    fill(url)
    before = rows(url)
    assert all(len(found) == 1 for found in before.values())
    migrate(url)
    after = rows(url)
    assert set(before) <= set(after)
    for name, (row,) in before.items():
        if name == "policies" and revision < POLICIES_ARE_KEPT_FROM:
            assert after[name] == []
            continue
        (kept,) = after[name]
        still = {column: value for column, value in row.items() if column in kept}
        assert {column: kept[column] for column in still} == still
    (example,) = after["examples"]  # in a table of their own by now
    assert {column: example[column] for column in ("task", "text", "contextual_query")} == {"task": "take", **EXAMPLE}


@pytest.mark.parametrize("revision", revisions())
def test_the_code_reads_and_writes_what_every_revision_left(url: str, revision: str) -> None:
    upgrade(url, revision)
    fill(url)
    migrate(url)
    store = Store(url)
    with store.write() as transaction:
        known = transaction.templates.get("take")
        assert (known.template, known.revision) == ("F holding($1)", 2)
        assert [example.text for example in known.examples] == [EXAMPLE["text"]]
        assert transaction.environments.get("e").data == ROWS["environments"]["data"]
        assert [entry.id for entry in transaction.policies.page(limit=9)] == (
            [] if revision < POLICIES_ARE_KEPT_FROM else ["p"]
        )
        transaction.templates.put(known)
        transaction.environments.put("e", "oomdp", {"b": 2})
    with store.read() as transaction:
        assert transaction.environments.get("e").revision == 4
    store.close()


def test_revisions_follow_each_other() -> None:
    found = revisions()
    assert found == [f"{number:04}" for number in range(1, len(found) + 1)]

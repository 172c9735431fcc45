"""What the doctor says of a sound service, and of several that are broken each in one way."""

from __future__ import annotations

import shutil
import sqlite3
from pathlib import Path

import pytest

from service.doctor import Finding
from service.doctor import installation as installed
from service.doctor.database import examine_database
from service.doctor.sense import examine_settings
from service.keys import add_key
from service.settings import Settings
from service.store.migrate import migrate
from tests.service.conftest import run_cli
from tests.service.postgres import Postgres


def of(findings: object, about: str) -> Finding:
    (found,) = [finding for finding in findings if finding.about == about]  # type: ignore[attr-defined]
    assert "\n" not in found.line
    return found


@pytest.fixture
def settings(tmp_path: Path) -> Settings:
    found = Settings(data_dir=tmp_path)
    migrate(found.url)
    return found


def levels(settings: Settings) -> dict[str, str]:
    return {finding.about: finding.level for finding in examine_database(settings)}


def test_a_sound_service(tmp_path: Path) -> None:
    result = run_cli("doctor", data=tmp_path)
    assert result.returncode == 0, result.stdout
    assert {line.split()[0] for line in result.stdout.splitlines()} <= {"ok", "warning"}
    for about in ("settings", "store", "room", "python", "libraries", "weights", "spot", "planning", "processes"):
        assert f" {about}: " in result.stdout
    assert not list(tmp_path.iterdir()), "it wrote something"


def test_without_spot_and_weights(tmp_path: Path) -> None:
    """Modules of these names are found first, and cannot be imported."""
    for name in ("spot", "safetensors"):
        (tmp_path / name).mkdir()
        (tmp_path / name / "__init__.py").write_text(f"raise ImportError('no {name} here')\n")
    here = str(Path(__file__).parents[3])
    result = run_cli("doctor", data=tmp_path / "data", PYTHONPATH=f"{tmp_path}:{here}")
    assert result.returncode == 1
    wrong = {line.split()[1].rstrip(":"): line for line in result.stdout.splitlines() if line.startswith("wrong")}
    assert "no safetensors here" in wrong["weights"]
    assert "Spot" in wrong["spot"]
    assert "Traceback" not in result.stdout


def test_a_store_that_is_well(settings: Settings) -> None:
    assert levels(settings) == {"store": "ok", "migrations": "ok", "integrity": "ok", "room": "ok"}


def test_a_store_that_is_not_there_yet(tmp_path: Path) -> None:
    assert levels(Settings(data_dir=tmp_path / "a" / "b")) == {"store": "ok", "room": "ok"}
    assert not (tmp_path / "a").exists()


def test_an_older_store(settings: Settings, tmp_path: Path) -> None:
    with sqlite3.connect(tmp_path / "cqltl.sqlite3") as connection:
        connection.execute("UPDATE alembic_version SET version_num = '0001'")
    connection.close()
    assert levels(settings)["migrations"] == "warning"


def test_a_damaged_store(settings: Settings, tmp_path: Path) -> None:
    path = tmp_path / "cqltl.sqlite3"
    path.write_bytes(path.read_bytes()[:20_000])
    found = of(examine_database(settings), "store")
    assert found.level == "wrong"
    assert "damaged" in found.detail


def test_an_index_that_does_not_fit_its_table(settings: Settings, tmp_path: Path) -> None:
    """What only the thorough check of SQLite finds."""
    connection = sqlite3.connect(tmp_path / "cqltl.sqlite3", isolation_level=None)
    connection.execute("INSERT INTO facts (name, value) VALUES ('one', 'x')")
    found = dict(connection.execute("SELECT name, rootpage FROM sqlite_master").fetchall())
    page, other = found["ix_jobs_state"], found["sqlite_autoindex_facts_1"]
    connection.execute("PRAGMA writable_schema = ON")
    connection.execute("UPDATE sqlite_master SET rootpage = ? WHERE name = 'sqlite_autoindex_facts_1'", (page,))
    connection.execute("UPDATE sqlite_master SET rootpage = ? WHERE name = 'ix_jobs_state'", (other,))
    connection.close()
    assert levels(settings)["integrity"] == "wrong"


def test_a_folder_that_cannot_be_one(tmp_path: Path) -> None:
    (tmp_path / "data").write_text("a file")
    assert levels(Settings(data_dir=tmp_path / "data"))["room"] == "wrong"


def test_a_disk_that_is_nearly_full(settings: Settings, monkeypatch: pytest.MonkeyPatch) -> None:
    usage = shutil.disk_usage("/")._replace(free=1_000)
    monkeypatch.setattr("service.doctor.database.shutil.disk_usage", lambda _: usage)
    assert levels(settings)["room"] == "warning"


def test_a_store_near_its_limit(settings: Settings, tmp_path: Path) -> None:
    size = (tmp_path / "cqltl.sqlite3").stat().st_size
    found = list(examine_database(settings.model_copy(update={"max_store_bytes": size})))
    assert [finding.level for finding in found if finding.about == "room"] == ["ok", "warning"]


def test_postgresql(postgres: Postgres) -> None:
    settings = Settings(database_url=postgres.database())
    assert levels(settings) == {"store": "ok", "migrations": "warning"}
    migrate(settings.url)
    assert levels(settings) == {"store": "ok", "migrations": "ok", "queue": "ok"}


def test_postgresql_that_is_not_there() -> None:
    found = of(examine_database(Settings(database_url="postgresql://u:secret@127.0.0.1:9/none")), "store")
    assert found.level == "wrong"
    assert "secret" not in found.detail


@pytest.mark.parametrize(
    ("given", "about", "level"),
    [
        ({"host": "0.0.0.0"}, "CQLTL_HOST", "wrong"),
        ({"host": "0.0.0.0", "allow_unauthenticated": True}, "CQLTL_ALLOW_UNAUTHENTICATED", "warning"),
        ({"api_keys_file": Path("/no/such/file")}, "CQLTL_API_KEYS_FILE", "wrong"),
        ({"allowed_origins": "https://a.example, robots"}, "CQLTL_ALLOWED_ORIGINS", "wrong"),
        ({"wait_s": 90.0}, "CQLTL_WAIT_S", "warning"),
        ({"plan_timeout_s": 4_000.0}, "CQLTL_PLAN_TIMEOUT_S", "warning"),
        ({"workers": 256}, "CQLTL_WORKERS", "warning"),
        ({"worker_memory_bytes": 1_000_000}, "CQLTL_WORKER_MEMORY_BYTES", "wrong"),
        ({"max_connections": 10, "max_in_flight": 20}, "CQLTL_MAX_IN_FLIGHT", "warning"),
    ],
)
def test_settings_that_make_no_sense(given: dict[str, object], about: str, level: str) -> None:
    assert of(examine_settings(Settings().model_copy(update=given)), about).level == level


def test_settings_that_do(tmp_path: Path) -> None:
    add_key(tmp_path / "keys", "robot", ["plan"])
    given = {"host": "0.0.0.0", "api_keys_file": tmp_path / "keys", "allowed_origins": "*, https://a.example:8443"}
    given["workers"] = 1
    (found,) = examine_settings(Settings().model_copy(update=given))
    assert (found.level, found.about) == ("ok", "settings")


def test_libraries_that_are_missing_or_others(monkeypatch: pytest.MonkeyPatch) -> None:
    class Distribution:
        requires = ("numpy>=99", "no-such-package>=1", "pytest; extra == 'dev'", "also-missing; python_version < '3'")

    monkeypatch.setattr(installed, "distribution", lambda _: Distribution)
    found = installed._libraries()
    assert found.level == "wrong"
    assert "no-such-package>=1" in found.detail
    assert "numpy" in found.detail
    assert "pytest" not in found.detail
    assert "also-missing" not in found.detail


def test_processes_that_do_not_start(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("service.worker.pool.warm_planning", fail)
    found = installed.tried("processes", lambda: installed._processes(Settings()))
    assert found.level == "wrong"
    assert "cannot be started" in found.detail


def fail() -> None:
    raise RuntimeError("nothing to load")


@pytest.mark.parametrize("url", ["nonsense", "mysql://host/name", "postgresql+psycopg//host"])
def test_a_database_that_is_none_is_named(tmp_path: Path, url: str) -> None:
    result = run_cli("doctor", data=tmp_path, CQLTL_DATABASE_URL=url)
    assert result.returncode == 2
    assert result.stderr.startswith("CQLTL_DATABASE_URL: ")
    assert "Traceback" not in result.stderr

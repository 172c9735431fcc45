"""API keys: the file, the ring, the command."""

from __future__ import annotations

import hashlib
import os
from pathlib import Path

import pytest

from service.binding import CannotListenError, listen
from service.keys import KeyRing, KeysError, add_key, read_keys, remove_key
from service.settings import Settings
from tests.service.conftest import run_cli, run_here


def test_a_key_is_kept_as_a_digest_that_only_its_owner_reads(tmp_path: Path) -> None:
    path = tmp_path / "keys"
    secret = add_key(path, "robot-7", ["plan", "read"])
    text = path.read_text()
    assert secret not in text
    assert text == f"robot-7 read,plan {hashlib.sha256(secret.encode()).hexdigest()}\n"
    assert path.stat().st_mode & 0o777 == 0o600
    assert len(secret) > 40
    assert add_key(path, "robot-8", ["plan"]) != secret
    assert list(tmp_path.iterdir()) == [path]


def test_scopes(tmp_path: Path) -> None:
    path = tmp_path / "keys"
    robot, boss = add_key(path, "robot", ["plan"]), add_key(path, "boss", ["admin"])
    ring = KeyRing(path)
    found = ring.find(robot)
    assert found is not None
    assert [found.allows(scope) for scope in ("plan", "read", "admin", None)] == [True, False, False, True]
    found = ring.find(boss)
    assert found is not None
    assert all(found.allows(scope) for scope in ("plan", "read", "teach", "admin", None))
    assert ring.find("") is None
    assert ring.find(robot + "x") is None


def test_what_changes_holds_at_once(tmp_path: Path) -> None:
    path = tmp_path / "keys"
    first = add_key(path, "first", ["read"])
    ring = KeyRing(path)
    second = add_key(path, "second", ["read"])
    assert ring.find(second) is not None
    remove_key(path, "first")
    assert ring.find(first) is None
    path.write_text("half a li")
    assert ring.find(second) is not None
    path.unlink()
    assert ring.find(second) is not None


DIGEST = "0" * 64


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("", "no key"),
        ("# nothing\n\n", "no key"),
        ("robot read\n", ":1: a line is"),
        (f"robot read {DIGEST}x\n", ":1: a line is"),
        (f"# x\nrobot read,fly {DIGEST}\n", ":2: 'fly' is no scope"),
        (f"robot read {DIGEST}\nrobot plan {'1' * 64}\n", ":2: there is another"),
        (None, "No such file"),
    ],
)
def test_a_file_that_opens_nothing_is_refused_in_a_line(tmp_path: Path, text: str | None, said: str) -> None:
    path = tmp_path / "keys"
    if text is not None:
        path.write_text(text)
    with pytest.raises(KeysError, match=said) as caught:
        KeyRing(path)
    assert str(path) in str(caught.value)
    assert "\n" not in str(caught.value)


def test_names_are_told_apart(tmp_path: Path) -> None:
    path = tmp_path / "keys"
    add_key(path, "robot", ["read"])
    for name in ("robot", "a b", "", "x" * 65, "a\nb"):
        with pytest.raises(KeysError):
            add_key(path, name, ["read"])
    with pytest.raises(KeysError, match="no key of the name"):
        remove_key(path, "other")
    assert [key.name for key in read_keys(path).values()] == ["robot"]


def test_the_command(tmp_path: Path) -> None:
    path = tmp_path / "keys"
    added = run_here("keys", "add", "robot", "--file", str(path), data=tmp_path)
    assert added.returncode == 0, added.stderr
    assert KeyRing(path).find(added.stdout.strip()) is not None
    listed = run_here("keys", "list", data=tmp_path, CQLTL_API_KEYS_FILE=str(path))
    assert listed.stdout == "robot read,translate,plan\n"
    assert run_here("keys", "add", "robot", "--file", str(path), data=tmp_path).returncode == 1
    assert run_here("keys", "add", "x", "--scopes", "fly", "--file", str(path), data=tmp_path).returncode == 2
    assert run_here("keys", "list", data=tmp_path).returncode == 2
    assert run_here("keys", "remove", "robot", "--file", str(path), data=tmp_path).returncode == 0
    assert run_here("keys", "list", "--file", str(path), data=tmp_path).stdout == ""


def test_beyond_loopback_there_are_keys_or_the_word_for_it(tmp_path: Path) -> None:
    for host in ("0.0.0.0", "::", ""):
        with pytest.raises(CannotListenError):
            listen(Settings(api_keys_file=None, allow_unauthenticated=False), host, 0)
    result = run_cli("serve", "--port", "0", data=tmp_path / "unused", CQLTL_HOST="0.0.0.0")
    assert result.returncode == 1
    assert result.stderr.count("\n") == 1
    assert "cqltl keys add" in result.stderr
    assert not (tmp_path / "unused").exists()


def test_a_server_without_its_keys_does_not_start(tmp_path: Path) -> None:
    missing = os.fspath(tmp_path / "missing")
    result = run_cli("serve", "--port", "0", data=tmp_path / "unused", CQLTL_API_KEYS_FILE=missing)
    assert (result.returncode, result.stderr) == (1, f"{missing}: No such file or directory\n")

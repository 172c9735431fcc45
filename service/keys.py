"""API keys: who may do what. The file holds a digest of each key, so whoever reads it can use none of them.

A line of the file is `name scope,scope digest`; empty lines and those that begin with # say nothing. A key is 32 random
bytes, which nobody guesses, so SHA-256 is digest enough. The file is read again when it has changed: what is added or
removed there holds at once.
"""

from __future__ import annotations

import hashlib
import os
import re
import secrets
import threading
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from service.errors import CannotStartError

SCOPES = ("read", "translate", "plan", "teach", "admin")
"""What a key may be good for; `admin` is good for everything."""

PREFIX = "cqltl_"
"""What keys begin with, so that one that leaked is known for what it is."""

_NAME = re.compile(r"[A-Za-z0-9._-]{1,64}")
_DIGEST = re.compile(r"[0-9a-f]{64}")


class KeysError(CannotStartError):
    """The file of keys cannot be used; the message is a line that says why."""


@dataclass(frozen=True, slots=True)
class ApiKey:
    """A key as it is kept."""

    name: str
    scopes: frozenset[str]
    digest: str

    @property
    def line(self) -> str:
        """It in the file."""
        return f"{self.name} {','.join(scope for scope in SCOPES if scope in self.scopes)} {self.digest}\n"

    def allows(self, scope: str | None) -> bool:
        """Whether it is good for that; None asks for any key."""
        return scope is None or scope in self.scopes or "admin" in self.scopes


def read_keys(path: Path) -> dict[str, ApiKey]:
    """The keys of a file by digest; raises `KeysError`."""
    try:
        lines = path.read_text(encoding="utf-8").splitlines()
    except (OSError, UnicodeDecodeError) as error:
        raise KeysError(f"{path}: {getattr(error, 'strerror', None) or error}") from error
    found: dict[str, ApiKey] = {}
    for number, line in enumerate(lines, start=1):
        if line.strip() and not line.startswith("#"):
            key = _read_line(line.split(), f"{path}:{number}")
            if key.name in {other.name for other in found.values()}:
                raise KeysError(f"{path}:{number}: there is another key of the name {key.name}")
            found[key.digest] = key
    return found


def add_key(path: Path, name: str, scopes: Sequence[str]) -> str:
    """Make a key and keep its digest: the key, which nobody can ask for again; raises `KeysError`."""
    if not _NAME.fullmatch(name):
        raise KeysError(f"{name!r} is no name: letters, digits, dots, dashes and underscores, 64 at most")
    known = read_keys(path) if path.exists() else {}
    if any(key.name == name for key in known.values()):
        raise KeysError(f"{path}: there is another key of the name {name}")
    secret = PREFIX + secrets.token_urlsafe(32)
    key = ApiKey(name, frozenset(scopes), digest_of(secret))
    _write(path, [*known.values(), key])
    return secret


def remove_key(path: Path, name: str) -> None:
    """Forget a key; raises `KeysError` where there is none of that name."""
    known = read_keys(path)
    kept = [key for key in known.values() if key.name != name]
    if len(kept) == len(known):
        raise KeysError(f"{path}: there is no key of the name {name}")
    _write(path, kept)


def digest_of(secret: str) -> str:
    """What is kept of a key."""
    return hashlib.sha256(secret.encode()).hexdigest()


class KeyRing:
    """The keys of a file as it is now. Where it cannot be read any more the keys stay as they were."""

    def __init__(self, path: Path) -> None:
        self._path = path
        self._lock = threading.Lock()
        self._seen = self._stamp()
        self._keys = read_keys(path)
        if not self._keys:
            raise KeysError(f"{path} has no key; `cqltl keys add` makes one")

    def find(self, secret: str) -> ApiKey | None:
        """The key that was sent, if it is one."""
        self._refresh()
        return self._keys.get(digest_of(secret))

    def _refresh(self) -> None:
        stamp = self._stamp()
        if stamp != self._seen and stamp is not None:
            with self._lock:
                try:
                    self._keys, self._seen = read_keys(self._path), stamp
                except KeysError:  # half written; it is looked at again with the next request
                    return

    def _stamp(self) -> tuple[int, int, int] | None:
        try:
            found = self._path.stat()
        except OSError:
            return None
        return found.st_mtime_ns, found.st_size, found.st_ino


def _read_line(words: list[str], place: str) -> ApiKey:
    if len(words) != 3 or not _NAME.fullmatch(words[0]) or not _DIGEST.fullmatch(words[2]):
        raise KeysError(f"{place}: a line is a name, scopes with commas between, and the digest of a key")
    scopes = words[1].split(",")
    if unknown := [scope for scope in scopes if scope not in SCOPES]:
        raise KeysError(f"{place}: {unknown[0]!r} is no scope; scopes are {', '.join(SCOPES)}")
    return ApiKey(words[0], frozenset(scopes), words[2])


def _write(path: Path, keys: Sequence[ApiKey]) -> None:
    """All or nothing, for the eyes of the owner only."""
    path.parent.mkdir(parents=True, exist_ok=True)
    fresh = path.with_name(f"{path.name}.{os.getpid()}.new")
    try:
        with os.fdopen(os.open(fresh, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600), "w", encoding="utf-8") as file:
            file.writelines(key.line for key in keys)
            file.flush()
            os.fsync(file.fileno())
        fresh.replace(path)
    except OSError as error:
        fresh.unlink(missing_ok=True)
        raise KeysError(f"{path}: {error.strerror or error}") from error

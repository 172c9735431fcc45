"""What an examination finds."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Literal

Level = Literal["ok", "warning", "wrong"]


@dataclass(frozen=True, slots=True)
class Finding:
    """One thing that was looked at; `wrong` is what the service does not work with."""

    level: Level
    about: str
    detail: str

    @property
    def line(self) -> str:
        """It for people."""
        return f"{self.level:<8} {self.about}: {' '.join(self.detail.split())}"


def ok(about: str, detail: str) -> Finding:
    """All is well."""
    return Finding("ok", about, detail)


def warning(about: str, detail: str) -> Finding:
    """It works, and perhaps not as was meant."""
    return Finding("warning", about, detail)


def wrong(about: str, detail: str) -> Finding:
    """It does not work."""
    return Finding("wrong", about, detail)


def tried(about: str, examine: Callable[[], str]) -> Finding:
    """What an examination says where it goes well, or why it does not: a doctor does not faint."""
    try:
        return ok(about, examine())
    except Exception as error:
        return wrong(about, f"{type(error).__name__}: {error}")


Findings = Iterator[Finding]

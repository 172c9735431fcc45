"""Long ways to say what the networks know in a short one: "under no circumstances" is "never"."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from models.queries import Query

_NEVER = re.compile(
    r"\b(?:under no circumstances?|on no account|in no case|by no means|at no (?:time|point)"
    r"|(?:don['’]t|dont|do not)(?: you)? ever)\b",
    re.IGNORECASE,
)


@dataclass(frozen=True, slots=True)
class Restated:
    """A command in other words, with the same meaning."""

    text: str

    @property
    def texts(self) -> tuple[str, ...]:
        """The one text."""
        return (self.text,)

    def tears(self, _query: Query, /) -> bool:
        """Never: what is sure of the words as they are said has no need of others."""
        return False

    def put_together(self, queries: Sequence[Query]) -> Query | None:
        """The query of the text."""
        (query,) = queries
        return query


def restated(text: str) -> Iterator[Restated]:
    """The command with the short words for the long ones, if there are any."""
    if _NEVER.search(text):
        yield Restated(_NEVER.sub("never", text))

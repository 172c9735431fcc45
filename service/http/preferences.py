"""The header `Prefer` (RFC 7240): how long a client wants to wait."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Annotated

from fastapi import Header

PreferHeader = Annotated[
    str,
    Header(
        alias="Prefer",
        max_length=1_000,
        description="RFC 7240: `wait=N`, answer with a job after N seconds; `respond-async`, answer with one at once.",
    ),
]


@dataclass(frozen=True, slots=True)
class Wait:
    """Seconds to wait, and what the header `Preference-Applied` says of it; None where nothing was preferred."""

    seconds: float
    applied: str | None


def wait_of(prefer: str, *, default_s: float, longest_s: float) -> Wait:
    """What a client prefers. What is not understood is ignored, and the first of equal preferences counts."""
    found: dict[str, str] = {}
    for preference in prefer.split(","):
        name, _, value = preference.partition(";")[0].partition("=")
        found.setdefault(name.strip().lower(), value.strip().strip('"'))
    if re.fullmatch(r"\d{1,9}", found.get("wait", "")):
        seconds = min(float(found["wait"]), longest_s)
        return Wait(seconds, f"wait={seconds:g}")
    if "respond-async" in found:
        return Wait(0.0, "respond-async")
    return Wait(min(default_s, longest_s), None)

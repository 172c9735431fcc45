"""What may name objects, values and environments."""

from __future__ import annotations

from models.world.limits import MAX_NAME
from models.world.names import NONE


def name_fault(name: str) -> str | None:
    """Why a text cannot name an object or value, or None."""
    if not name.strip() or name != name.strip():
        return "a name may not be empty or begin or end with a space"
    if len(name) > MAX_NAME:
        return f"a name may have at most {MAX_NAME} characters"
    if not name.isprintable() or '"' in name or "\\" in name:
        return "a name may not hold control characters, quotes or backslashes"
    return f"{NONE} is the name of no value" if name == NONE else None


def environment_name_fault(name: str) -> str | None:
    """Why a text cannot name an environment, or None. The name is one segment of a URL path."""
    if name in (".", "..") or "/" in name or "\\" in name:
        return "the name is part of a web address: it may not hold / or \\, nor be . or .."
    return name_fault(name)

"""What a key must be good for, by request. A test compares this with the routes that there are."""

from __future__ import annotations

OPEN = frozenset({"livez", "readyz", "docs", "openapi.json", "static", "static-offline-docs", ""})
"""First parts of paths that need no key: whether the service is well, and what it is. The last one is the page."""

UNLIMITED = frozenset({"livez", "readyz", "metrics"})
"""First parts of paths that are answered however much else is asked for."""

_ALWAYS = {
    "translate": "translate",
    "ground": "translate",
    "explain": "translate",
    "learn": "teach",
    "plan": "plan",
    "metrics": "read",
}
_READING = ("templates", "environments", "policies", "jobs")
_CHANGING = {
    ("POST", "policies"): "plan",  # step, simulate
    ("POST", "jobs"): "plan",  # cancel
    ("DELETE", "policies"): "admin",
}


def first_part(path: str) -> str:
    """`/jobs/7` → `jobs`."""
    return path.lstrip("/").partition("/")[0]


def scope_of(method: str, path: str) -> str | None:
    """The scope that a request needs. None: any key, since there is no such route."""
    part = first_part(path)
    if part in _ALWAYS:
        return _ALWAYS[part]
    if part in _READING:
        return "read" if method in ("GET", "HEAD") else _CHANGING.get((method, part), "teach")
    return None

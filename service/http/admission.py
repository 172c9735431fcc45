"""How the OpenAPI document says what comes before the routes: API keys, rates, and clients that are too slow."""

from __future__ import annotations

from typing import Any

from service.http.problems import STATUS
from service.http.scopes import OPEN, UNLIMITED, first_part, scope_of

_SCHEME = {
    "type": "http",
    "scheme": "bearer",
    "description": "An API key of `cqltl keys add`; needed where the service has keys, as it must beyond loopback.",
}


def document_admission(document: dict[str, Any]) -> None:
    """Add the scheme of API keys, and to each operation what it may be refused with before it is looked at."""
    document["components"]["securitySchemes"] = {"ApiKey": _SCHEME}
    for path, operations in document["paths"].items():
        part = first_part(path)
        for method, operation in operations.items():
            slugs = ["request-timeout"] if "requestBody" in operation else []
            if part not in OPEN:
                scope = scope_of(method.upper(), path)
                operation["security"] = [{}, {"ApiKey": [] if scope is None else [scope]}]
                slugs += ["unauthorized", "forbidden"]
            if part not in UNLIMITED:
                slugs += ["rate-limited", "overloaded"]
            # Any head may be too long, and only the socket knows; where `parameters` are, a request may well have one.
            if "parameters" in operation:
                operation["responses"].setdefault("431", {"description": "`http-error`: the head is too long"})
            for slug in slugs:
                operation["responses"].setdefault(str(STATUS[slug]), {"description": f"`{slug}`"})

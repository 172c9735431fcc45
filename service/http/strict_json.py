"""JSON as RFC 8259 and I-JSON (RFC 7493) have it. Python's own parser reads more: numbers that are none, members that
come twice (the last one wins), texts that no database keeps.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from typing import Any, NoReturn

from models.source import locate
from service.http.problems import problem_of
from service.http.schemas.problems import Problem

_SUSPECT = re.compile(rb"\\u(?:0000|[dD][89a-fA-F])")
"""How a body of UTF-8 writes what `_UNKEPT` finds; the rest of such characters is no JSON or no UTF-8."""
_UNKEPT = re.compile("[\x00\ud800-\udfff]")
"""U+0000, which PostgreSQL's texts do not hold, and halves of surrogate pairs, which no UTF-8 holds."""


class _Unclear(ValueError):
    """Python would read it, others would read something else."""


class Flawed(Exception):
    """A body is not JSON to rely on; `problem` says why."""

    def __init__(self, problem: Problem) -> None:
        super().__init__(problem.detail)
        self.problem = problem


def read_json(body: bytes, max_depth: int) -> Any:
    """What a body says; raises `Flawed` for what is wrong with it as JSON, before anybody looks at what it says."""
    try:
        text = body.decode("utf-8")
    except UnicodeDecodeError as error:
        raise _malformed(f"the body is not JSON: byte {error.start} is not UTF-8") from None
    try:
        value = _DECODER.decode(text)
    except json.JSONDecodeError as error:
        place = locate(text, min(error.pos, len(text)))
        detail = f"the body is not JSON: {error.msg}"
        raise _malformed(detail, line=place.line, column=place.column, caret=place.caret) from None
    except RecursionError:
        raise _too_deep(max_depth) from None
    except ValueError as error:  # also a number of more digits than Python reads
        raise _malformed(f"the body is not JSON to rely on: {error}") from None
    if body.count(b"[") + body.count(b"{") > max_depth and _deeper(value, max_depth):
        raise _too_deep(max_depth)
    if _SUSPECT.search(body) and (unkept := _first_unkept(value)) is not None:
        raise Flawed(unkept)
    return value


def _malformed(detail: str, **members: Any) -> Flawed:
    return Flawed(problem_of({"slug": "malformed-json", "detail": detail, **members}))


def _too_deep(most: int) -> Flawed:
    detail = f"arrays and objects are nested deeper than {most} levels"
    return Flawed(problem_of({"slug": "body-too-deep", "detail": detail}))


def _object(members: list[tuple[str, Any]]) -> dict[str, Any]:
    found = dict(members)
    if len(found) != len(members):
        names = [name for name, _ in members]
        twice = next(name for name in names if names.count(name) > 1)
        raise _Unclear(f"an object has the member {json.dumps(twice[:100])} more than once")
    return found


def _no_number(name: str) -> NoReturn:
    raise _Unclear(f"{name} is not a number of JSON")


_DECODER = json.JSONDecoder(object_pairs_hook=_object, parse_constant=_no_number)


def _deeper(value: Any, most: int) -> bool:
    level = [value]
    for _ in range(most):
        level = [part for each in level for part in _parts(each) if isinstance(part, (dict, list))]
        if not level:
            return False
    return True


def _parts(value: Any) -> Any:
    if isinstance(value, dict):
        return value.values()
    return value if isinstance(value, list) else ()


def _first_unkept(value: Any) -> Problem | None:
    for pointer, text in _texts(value, ""):
        if found := _UNKEPT.search(text):
            detail = f"a text has U+{ord(found[0]):04X}, which is not a character"
            places = [{"pointer": pointer, "detail": detail}]
            return problem_of({"slug": "validation", "detail": f"{pointer}: {detail}", "errors": places})
    return None


def _texts(value: Any, pointer: str) -> Iterator[tuple[str, str]]:
    """Every text with its JSON pointer; names of members with that of their object."""
    if isinstance(value, str):
        yield pointer, value
    elif isinstance(value, list):
        for number, part in enumerate(value):
            yield from _texts(part, f"{pointer}/{number}")
    elif isinstance(value, dict):
        for name, part in value.items():
            yield pointer, name
            if not _UNKEPT.search(name):
                yield from _texts(part, f"{pointer}/{name.replace('~', '~0').replace('/', '~1')}")

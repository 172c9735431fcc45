"""RELIABILITY.md names tests that there are, and has some for each promise."""

from __future__ import annotations

import ast
import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
PROMISES = (ROOT / "RELIABILITY.md").read_text(encoding="utf-8").split("\n## ")[1:]
NAMED = re.compile(r"`(tests/[\w/]+\.py)::(\w+)`")


@pytest.mark.parametrize("promise", PROMISES, ids=lambda promise: promise.partition("\n")[0])
def test_promises_have_tests(promise: str) -> None:
    named = NAMED.findall(promise)
    assert named
    for line in promise.split("\n- ")[1:]:
        assert NAMED.search(line), f"no test: {line}"
    for path, name in named:
        tree = ast.parse((ROOT / path).read_text(encoding="utf-8"))
        found = {node.name for node in tree.body if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef)}
        assert name in found, f"{path} has no {name}"


def test_nothing_that_looks_like_a_test_is_left_unread() -> None:
    text = "\n".join(PROMISES)
    assert len(NAMED.findall(text)) == text.count("::")

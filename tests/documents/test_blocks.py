"""Every code block of README.md and docs/*.md is executed; `apart.py` names those that are not run with their page."""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Mapping
from contextlib import nullcontext
from pathlib import Path

import pytest
import yaml
from pydantic import TypeAdapter

from benchmarks.server import serving
from models.interchange import prism_model
from models.logic import parse
from models.queries import parse_query
from models.world import builtin_environments, compile_world, load_environment
from service.http import schemas
from tests.documents import commands, session
from tests.documents.apart import APART, entry
from tests.documents.blocks import PAGES, ROOT, Block, blocks, indented, read

BLOCKS = [block for page in PAGES for block in blocks(page)]
LANGUAGES = {"sh", "yaml", "python", "prism", "json", "text", "ltl", "query"}


def is_the_order_of_imports(block: Block) -> None:
    """The layers that import-linter enforces: every package of the core, service first."""
    contracts = commands.PROJECT["tool"]["importlinter"]["contracts"]
    layers = [set(re.findall(r"[\w.]+", layer)) for layer in contracts[0]["layers"]]
    drawn = [set(re.findall(r"[\w.]+", layer)) for layer in block.text.split("─►")]
    assert all(layer <= shown for layer, shown in zip(layers, drawn, strict=False))
    packages = {path.parent.name for path in (ROOT / "models").glob("*/__init__.py")}
    assert set().union(*drawn) == {"service", *(f"models.{name}" for name in packages)}


def names_what_is_there(block: Block) -> None:
    """Packages and routes."""
    for package in re.findall(r"\b(?:models|service)(?:/\w+)+", block.text):
        assert (ROOT / package).is_dir() or (ROOT / package).with_suffix(".py").is_file(), package
    served = read("openapi.yaml")
    for route in re.findall(r"(?<!\w)/[a-z][^\s,]*", block.text):
        assert f"\n  {route}:\n" in served, route


def is_written_by_the_export(block: Block) -> None:
    world = dict(builtin_environments())["toys-4x1-cylinder"]
    toys = prism_model(load_environment({**world, "parameters": {"slip": 0.1}}))
    assert re.sub(r"\s+", " ", block.text) in re.sub(r"\s+", " ", toys)


DRAWINGS: dict[tuple[str, str], Callable[[Block], None]] = {
    ("docs/architecture.md", "service ─►"): is_the_order_of_imports,
    ("docs/architecture.md", "English"): names_what_is_there,
    ("docs/planning.md", "[pick_cylinder]"): is_written_by_the_export,
}
"""How the `text` blocks begin that nothing printed, and what has to be true of them."""


def answered(block: Block) -> bool:
    """Whether a block shows what the one before it printed."""
    return block.follows and not block.info and block.language in ("json", "text")


def is_request(block: Block) -> bool:
    return block.language == "json" and re.fullmatch(r"(POST|PUT) /\S*", block.info) is not None


def is_value(block: Block) -> bool:
    return block.language == "json" and re.fullmatch(r"[A-Z]\w+", block.info) is not None


def is_run(block: Block) -> bool:
    saved = block.language == "python" and block.info
    return (block.language in ("sh", "python") and not saved) or is_request(block)


@pytest.mark.parametrize("page", PAGES)
def test_every_block_says_what_it_is(page: str) -> None:
    assert indented(page) == [], "a block that is indented and not fenced is not run"
    for block in blocks(page):
        assert block.language in LANGUAGES, f"{block.place}: no language, or one that nothing runs"
        if block.language == "text":
            assert answered(block) or entry(DRAWINGS, block), f"{block.place}: printed by nothing, and no drawing"
        if block.language == "json":
            assert answered(block) or is_request(block) or is_value(block), f"{block.place}: what is it? see blocks.py"
        if block.language == "prism":
            assert block.info, f"{block.place}: a file has a name"


def test_every_page_and_block_is_found() -> None:
    assert len(PAGES) == 1 + len(list((ROOT / "docs").glob("*.md")))
    for page in PAGES:
        assert len(re.findall("^```", read(page), re.MULTILINE)) == 2 * len(blocks(page))


@pytest.mark.parametrize("table", [APART, DRAWINGS], ids=["apart", "drawings"])
def test_exceptions_are_of_one_block_each(table: Mapping[tuple[str, str], object]) -> None:
    for page, start in table:
        assert [b.page for b in BLOCKS if b.text.startswith(start)].count(page) == 1, (page, start)


@pytest.mark.parametrize("block", [b for b in BLOCKS if entry(APART, b)], ids=lambda block: block.place)
def test_what_is_not_run_with_its_page_could_be(block: Block) -> None:
    commands.check(block.text)


@pytest.mark.parametrize("block", [b for b in BLOCKS if entry(DRAWINGS, b)], ids=lambda block: block.place)
def test_drawings_are_true(block: Block) -> None:
    check = entry(DRAWINGS, block)
    assert check is not None
    check(block)


@pytest.mark.parametrize("block", [b for b in BLOCKS if b.language == "yaml"], ids=lambda block: block.place)
def test_worlds_load(block: Block) -> None:
    assert compile_world(load_environment(yaml.safe_load(block.text))).size > 0


@pytest.mark.parametrize("block", [b for b in BLOCKS if b.language in ("ltl", "query")], ids=lambda block: block.place)
def test_formulas_and_queries_are_read(block: Block) -> None:
    for line in block.text.splitlines():
        assert (parse if block.language == "ltl" else parse_query)(line) is not None


@pytest.mark.parametrize("block", [b for b in BLOCKS if is_value(b)], ids=lambda block: block.place)
def test_values_fit_their_schemas(block: Block) -> None:
    TypeAdapter(getattr(schemas, block.info)).validate_python(json.loads(block.text))


@pytest.mark.long
@pytest.mark.parametrize("page", [p for p in PAGES if any(is_run(b) and not entry(APART, b) for b in blocks(p))])
def test_a_reader_gets_what_the_page_shows(page: str, tmp_path: Path) -> None:
    """All that a page runs, in its order, in one shell, with a new server."""
    if not session.has_curl():
        pytest.skip("no curl of version 7.82 or newer (Debian and Ubuntu: apt install curl)")
    found = blocks(page)
    runnable = [block for block in found if not entry(APART, block)]
    with serving(CQLTL_WAIT_S="60") if session.needs_server(runnable) else nullcontext() as client:
        printed = session.run(runnable, tmp_path, "" if client is None else str(client.base_url).rstrip("/"))
    assert set(printed) == {block for block in runnable if is_run(block)}
    before = None
    for block in found:
        if not answered(block):
            before = block
        elif before in printed and block.language == "text":
            assert printed[before].rstrip() == block.text.rstrip(), block.place
        elif before in printed:
            assert session.agrees(json.loads(block.text), session.last_json(printed[before])) == [], block.place
    for name in re.findall(r"--output (\S+\.svg)", read(page)):
        drawn = (tmp_path / name).read_text(encoding="utf-8")
        assert (ROOT / "docs" / "pictures" / name).read_text(encoding="utf-8") == drawn, f"docs/pictures/{name} is old"


def test_answers_are_compared() -> None:
    """The comparison itself can fail."""
    answer = {"a": [1, {"b": 0.333333}], "c": "x"}
    assert session.agrees({"a": [1, {"b": 0.33333}]}, answer) == []
    assert session.agrees({"c": "..."}, answer) == []
    assert session.agrees({"a": [1]}, answer) == ["/a: [1, {'b': 0.333333}] instead of [1]"]
    assert session.agrees({"d": 1}, answer) == ["/d is not there"]
    assert session.agrees({"a": [2, {"b": 0.3}]}, answer) == ["/a/0: 1 instead of 2", "/a/1/b: 0.333333 instead of 0.3"]
    assert session.last_json('{"a": 1}{"b": 2}\n') == {"b": 2}


@pytest.mark.parametrize("text", ["make tea", "cqltl brew", "python -m models.tea", "export CQLTL_TEA=1", "tea", "if"])
def test_commands_that_would_not_work_are_found(text: str) -> None:
    with pytest.raises((AssertionError, SystemExit)):
        commands.check(text)

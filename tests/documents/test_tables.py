"""The documents say what the code does: every slug, every setting, every table."""

from __future__ import annotations

import importlib
import inspect
import pkgutil
import re
from pathlib import Path

import models
import service
from models.errors import CqltlError
from models.logic import Formula, FormulaSyntaxError, PropertyClass, classify, parse
from models.queries import Operator, compose
from models.world import explain
from service.http.problems import STATUS
from service.settings import Settings

DOCS = Path(__file__).parents[2] / "docs"

SETTINGS = Settings.model_fields

INTERNAL = {"error", "invalid-name", "invalid-policy", "invalid-vocabulary", "invalid-weights", "invalid-training"}
INTERNAL |= {"export-too-large", "storm-missing", "prism-syntax", "prism-constant", "prism-model", "uncheckable"}
"""Slugs of refusals that no request can meet: some are the command line's, some turn into something else."""


def slugs(kind: type[CqltlError]) -> set[str]:
    return {kind.slug}.union(*(slugs(child) for child in kind.__subclasses__()))


def test_every_slug_has_a_status_and_is_documented() -> None:
    for package in (models, service):
        for module in pkgutil.walk_packages(package.__path__, f"{package.__name__}."):
            if not module.name.endswith("__main__"):
                importlib.import_module(module.name)
    rows = re.findall(r"^\| `([a-z-]+)` \| (\d+) \|", (DOCS / "http.md").read_text(encoding="utf-8"), re.MULTILINE)
    documented = {slug: int(status) for slug, status in rows}
    assert documented == STATUS
    assert slugs(CqltlError) - INTERNAL <= set(STATUS)


def test_every_kind_of_task_is_documented_with_formulas_of_it() -> None:
    text = (DOCS / "http.md").read_text(encoding="utf-8").partition("| `kind` | in plain words")[2]
    rows = re.findall(r"^\| (`[a-z`, ]+`) \| (.*?) \| (`.*`) \|$", text, re.MULTILINE)
    known = []
    for names, plain, formulas in rows:
        kinds = [PropertyClass(name) for name in re.findall("`([a-z]+)`", names)]
        found = [classify(parse(formula.replace("\\|", "|"))) for formula in re.findall("`(.*?)`", formulas)]
        assert plain == "; ".join(kind.plain for kind in kinds)
        assert list(dict.fromkeys(found)) == kinds
        known += kinds
    assert sorted(known) == sorted(PropertyClass)


def test_every_setting_is_documented_with_its_default() -> None:
    rows = re.findall(r"^\| `CQLTL_(\w+)` \| (?:`(.*?)`)? ?\|", (DOCS / "settings.md").read_text(), re.MULTILINE)
    found = {name.upper(): "" if field.default is None else str(field.default) for name, field in SETTINGS.items()}
    assert dict(rows) == found


def test_every_setting_has_a_meaning_and_every_number_a_unit() -> None:
    rows = re.findall(r"^\| `CQLTL_(\w+)` \|.*?\|(.*?)\|(.*?)\|$", (DOCS / "settings.md").read_text(), re.MULTILINE)
    assert [name for name, _, meaning in rows if not meaning.strip()] == []
    units = {name: unit.strip() for name, unit, _ in rows}
    numbers = [name.upper() for name, field in SETTINGS.items() if field.annotation in (int, float)]
    assert [name for name in numbers if not units[name]] == []
    assert [name for name in numbers if name.endswith("_S") != (units[name] == "seconds")] == []
    assert [name for name in numbers if name.endswith("_BYTES") != (units[name] == "bytes")] == []


def test_fixed_limits_are_what_the_table_says() -> None:
    rows = rows_under("settings.md", "| constant | value | unit | meaning |")
    for name, value, unit, meaning in rows:
        module, _, constant = name.strip("`").rpartition(".")
        assert str(getattr(importlib.import_module(module), constant)) == value.strip("`"), name
        assert unit
        assert set(re.findall(r"`([a-z-]+)`", meaning)) <= set(STATUS), name


def test_every_limit_of_commands_queries_and_formulas_is_in_the_table() -> None:
    said = {row[0].strip("`") for row in rows_under("settings.md", "| constant | value | unit | meaning |")}
    for module in ("language.tokens", "queries.contextual_query", "logic.formula", "logic.translation"):
        code = importlib.import_module(f"models.{module}")
        limits = {f"models.{module}.{name}" for name, value in vars(code).items() if is_limit(name, value)}
        own = {limit for limit in limits if f"{limit.rpartition('.')[2]} =" in inspect.getsource(code)}
        assert own <= said, own - said


def is_limit(name: str, value: object) -> bool:
    return name.startswith("MAX_") and isinstance(value, int)


def test_no_setting_is_read_elsewhere() -> None:
    """One table: the code asks the environment for nothing of ours but through it."""
    known = {f"CQLTL_{name.upper()}" for name in SETTINGS}
    for package in (models, service):
        for file in Path(package.__path__[0]).rglob("*.py"):
            said = set(re.findall(r"CQLTL_[A-Z_]+[A-Z]", file.read_text(encoding="utf-8")))
            assert said <= known, file


def cells(line: str) -> list[str]:
    """The cells of a row, in which `\\|` is no border."""
    return [cell.strip().replace("\\|", "|") for cell in re.split(r"(?<!\\)\|", line)[1:-1]]


def rows_under(page: str, header: str) -> list[list[str]]:
    """The rows of the table with this header."""
    text = (DOCS / page).read_text(encoding="utf-8").partition(f"\n{header}\n")[2]
    lines = text.splitlines()[1:]
    return [cells(line) for line in lines[: next(n for n, line in enumerate(lines) if not line.startswith("|"))]]


def test_every_reading_of_a_formula_is_what_is_said() -> None:
    rows = rows_under("ltl.md", "| formula | reads |")
    assert len(rows) > 20
    for formulas, readings in rows:
        written, said = re.findall("`(.*?)`", formulas), readings.split("; ")
        for formula, reading in zip(written, said * len(written) if len(said) == 1 else said, strict=True):
            assert explain(parse(formula)) == reading, formula


def test_every_spelling_of_an_operator_is_read() -> None:
    """Spelt in any way, an operator is one of those of its row; what has no operand or two is found by trying."""
    rows = rows_under("ltl.md", "| operator | meaning | infix | also read |")
    assert len(rows) > 8
    for name, _, standard, others in rows:
        meant = {applied(symbol) for symbol in re.findall("`(.*?)`", standard)}
        assert {applied(symbol) for symbol in re.findall("`(.*?)`", others)} <= meant, name


def applied(symbol: str) -> Formula:
    """The formula that an operator makes of as many operands as it takes."""
    for text in (f"a {symbol} b", f"{symbol} a", symbol):
        try:
            return parse(text)
        except FormulaSyntaxError:
            continue
    raise AssertionError(f"{symbol} is not read")


def test_every_composition_means_what_the_table_says() -> None:
    a, b = parse("F a"), parse("F b")
    operands = {Operator.AVOID: [a], Operator.REPEAT: [a], Operator.UNTIL: [compose(Operator.AVOID, [a]), b]}
    rows = rows_under("http.md", "| composition | means | for tasks `F a`, `F b` |")
    said = {re.findall("`([a-z]+)", how)[0]: parse(re.findall("`(.*?)`", formula)[0]) for how, _, formula in rows}
    assert set(said) == set(Operator)
    for name, formula in said.items():
        assert compose(Operator(name), operands.get(Operator(name), [a, b])) == formula, name

"""The domains and environments that come with the package, as data files beside this module."""

from __future__ import annotations

from functools import lru_cache
from pathlib import Path
from typing import Any

from models.data import read_yaml
from models.world.domain import Domain
from models.world.domain_reader import read_domain
from models.world.report import Report
from models.world.specs import DOMAIN

_HERE = Path(__file__).parent


@lru_cache(maxsize=1)
def builtin_domains() -> tuple[str, ...]:
    """Names of the built-in domains."""
    return tuple(sorted(path.stem for path in (_HERE / "domains").glob("*.yaml")))


@lru_cache(maxsize=8)
def builtin_domain(name: str) -> Domain:
    """A built-in domain, checked. Raises WorldError when its file is wrong."""
    data = read_yaml((_HERE / "domains" / f"{name}.yaml").read_text(encoding="utf-8"))
    report = Report(what=f"the domain {name}")
    domain = read_domain(DOMAIN.validate_python(data), report)
    report.close()
    assert domain is not None
    return domain


def builtin_environments() -> tuple[tuple[str, dict[str, Any]], ...]:
    """Name and data of each environment that a new service starts with; fresh copies."""
    files = sorted((_HERE / "environments").glob("*.yaml"))
    loaded = (read_yaml(path.read_text(encoding="utf-8")) for path in files)
    return tuple((str(data["name"]), data) for data in loaded)

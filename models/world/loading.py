"""From data to an Environment: shape, meaning, compilation. Everything wrong comes out as one WorldError."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from pydantic import ValidationError

from models.world.actions import ActionError
from models.world.domain import Domain
from models.world.domain_reader import read_domain
from models.world.environment import Environment
from models.world.environment_reader import read_environment
from models.world.explicit import ExplicitWorld, read_explicit
from models.world.expression import ExpressionError
from models.world.library import builtin_domain, builtin_domains
from models.world.names import clipped, hint, listing
from models.world.oomdp import OomdpWorld
from models.world.report import Report
from models.world.specs import ENVIRONMENT, ExplicitSpec, OomdpSpec

_KINDS = ("oomdp", "explicit")


def load_environment(data: Mapping[str, Any]) -> Environment:
    """Reads, checks and compiles an environment given as plain data (see docs/worlds.md).

    Raises WorldError with a place (JSON pointer into `data`) for each fault found.
    """
    report = Report()
    spec = _shape(data, report)
    report.close()
    assert spec is not None
    loaded = _explicit(spec, report) if isinstance(spec, ExplicitSpec) else _oomdp(spec, report)
    report.close()
    assert loaded is not None
    return loaded


_QUOTE = 'YAML reads on, off, yes and no as true and false where they are not in quotes ("on")'


def _shape(data: object, report: Report) -> OomdpSpec | ExplicitSpec | None:
    if isinstance(data, Mapping) and (kind := data.get("kind")) not in _KINDS:
        wrong = "the kind is missing" if kind is None else "there is no such kind of environment"
        report.add(["kind"], f"{wrong}: give {listing(_KINDS)}")
        return None
    try:
        return ENVIRONMENT.validate_python(data)
    except ValidationError as error:
        for fault in error.errors(include_url=False, include_context=False):
            truth = fault["type"] == "string_type" and isinstance(fault["input"], bool)
            said = f"{str(fault['input']).lower()} is not text: {_QUOTE}" if truth else _sentence(fault["msg"])
            path = [part for part in fault["loc"] if part != "[key]"]
            report.add(path[1:] if path[:1] and path[0] in _KINDS else path, said)
        return None


def _sentence(message: str) -> str:
    text = clipped(message.removeprefix("Value error, "))
    return text[:1].lower() + text[1:]


def _explicit(spec: ExplicitSpec, report: Report) -> Environment | None:
    vocabulary = read_explicit(spec, report)
    if report.places:
        return None
    return Environment(spec.name, "explicit", None, vocabulary, ExplicitWorld.read(spec, vocabulary))


def _oomdp(spec: OomdpSpec, report: Report) -> Environment | None:
    domain = _domain(spec, report)
    read = read_environment(spec, domain, report) if domain else None
    if domain is None or read is None:
        return None
    model, vocabulary = read
    root = ("domain_spec",) if spec.domain_spec is not None else ("domain",)
    try:
        with np.errstate(all="ignore"):
            world = OomdpWorld(model, vocabulary)
    except ActionError as error:
        inside = error.path if spec.domain_spec is not None else ()
        report.add([*root, *inside], error.detail)
        return None
    except ExpressionError as error:
        report.add([], str(error))
        return None
    if not world.is_valid(world.initial):
        report.add(["state"], "the initial state breaks a constraint of the domain")
    return Environment(spec.name, "oomdp", domain.name, vocabulary, world)


def _domain(spec: OomdpSpec, report: Report) -> Domain | None:
    if spec.domain_spec is not None:
        inner = Report(("domain_spec",))
        domain = read_domain(spec.domain_spec, inner)
        report.places.extend(inner.places)
        return domain
    assert spec.domain is not None
    if spec.domain not in builtin_domains():
        known = builtin_domains()
        report.add(["domain"], f"there is no built-in domain {spec.domain}{hint(spec.domain, known)}")
        return None
    return builtin_domain(spec.domain)

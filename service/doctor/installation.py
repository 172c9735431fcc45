"""The installation: Python, libraries, weights, Spot, compiled loops, processes."""

from __future__ import annotations

import asyncio
import platform
import sys
import time
from importlib.metadata import PackageNotFoundError, distribution, version

from packaging.requirements import Requirement

from service.doctor.findings import Finding, Findings, ok, tried, warning, wrong
from service.settings import Settings

SLOW_S = 20.0
"""Loading takes longer than this only where loops are compiled, which a cache would have saved."""


def examine_installation(settings: Settings) -> Findings:
    """Look at everything that is there before a request."""
    yield ok("python", f"{platform.python_version()} on {platform.system()} {platform.machine()}")
    yield _libraries()
    yield tried("weights", _weights)
    yield tried("spot", _spot)
    yield _kernels()
    yield tried("processes", lambda: _processes(settings))


def _libraries() -> Finding:
    try:
        required = [Requirement(text) for text in distribution("cqltl").requires or []]
    except PackageNotFoundError:
        return wrong("libraries", "cqltl is not installed: pip install it, or `make serve`")
    needed = [found for found in required if found.marker is None or found.marker.evaluate({"extra": ""})]
    missing, other = [], []
    for requirement in needed:
        try:
            there = version(requirement.name)
        except PackageNotFoundError:
            missing.append(str(requirement))
            continue
        if not requirement.specifier.contains(there, prereleases=True):
            other.append(f"{requirement.name} {there} ({requirement.specifier} is needed)")
    if missing or other:
        lists = {"not installed": missing, "of other versions": other}
        return wrong("libraries", "; ".join(f"{how}: {', '.join(names)}" for how, names in lists.items() if names))
    return ok("libraries", f"cqltl {version('cqltl')} and the {len(needed)} that it needs")


def _weights() -> str:
    from service.translators import Translators

    found = Translators.shipped()
    text = "pick up the sphere"
    for name in ("default", "cq-copynet", "cq-copynet-pos"):
        if not found.queries(name).translate(text):
            raise RuntimeError(f'the translator {name} understands nothing in "{text}"')
    if not found.formulas("ltl-copynet").translate(text):
        raise RuntimeError(f'the translator ltl-copynet understands nothing in "{text}"')
    _ = found.matcher
    return "all translators are loaded and read a command"


def _spot() -> str:
    from models.logic import equivalent, parse
    from models.logic.spot import library

    found = library()
    if not equivalent(parse("F a"), parse("true U a")) or equivalent(parse("F a"), parse("G a")):
        raise RuntimeError("Spot says that formulas are equivalent which are not, or the other way round")
    return f"{found.version()} at {found.__file__}"


def _kernels() -> Finding:
    began = time.monotonic()
    found = tried("planning", _planned)
    if found.level == "ok" and time.monotonic() - began > SLOW_S:
        where = "`python -m models.planning` compiles once, where the folder of the package can be written"
        return warning("planning", f"{found.detail}, which every start would wait for: {where}")
    return found


def _planned() -> str:
    from models.planning.warming import warm

    began = time.monotonic()
    warm()
    return f"loaded, compiled and tried in {time.monotonic() - began:.1f} s"


def _processes(settings: Settings) -> str:
    from service.worker import Workers, run_classification

    workers = Workers(planners=1, max_waiting=0, memory_bytes=settings.worker_memory_bytes)
    workers.start(warm=True)
    try:
        workers.loaded()
        from models.logic import parse

        asyncio.run(workers.plan(run_classification, parse("G F a"), timeout_s=30))
    finally:
        workers.stop()
    return f"worker processes start and answer ({sys.executable})"

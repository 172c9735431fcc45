"""`cqltl export` and `cqltl import`: environments for PRISM and Storm; environments and PRISM models from files.

What only these commands need is imported when they run, since the others share the parser.
"""

from __future__ import annotations

import argparse
import json
import sys
from collections.abc import Mapping
from pathlib import Path
from typing import Any
from urllib.parse import quote

from models.errors import CqltlError
from service.settings import Settings

ENVIRONMENT_FILES = (".yaml", ".yml", ".json")
"""How files end that hold an environment as it is sent over HTTP; all others are read as PRISM models."""


def add_commands(commands: Any) -> None:
    """The arguments of both commands."""
    export = commands.add_parser("export", help="an environment in the PRISM language, or in DRN for Storm")
    where = export.add_mutually_exclusive_group(required=True)
    where.add_argument("environment", nargs="?", help="name of a stored environment")
    where.add_argument("--environment-file", type=Path, help="an environment as YAML or JSON")
    export.add_argument("--format", choices=["prism", "drn"], help="prism (default), or drn: state by state")
    export.add_argument("--ltl", help="a formula: its propositions become labels, itself a property in a comment")
    export.add_argument("--product", action="store_true", help="the product with the formula's automaton, in DRN")
    export.add_argument("--reachable", action="store_true", help="only states that are reachable, in DRN")
    export.add_argument("--output", type=Path, help="write to this file")
    export.add_argument("--server", help="address of a running server; without it none is needed")

    read = commands.add_parser("import", help="store an environment: YAML, JSON, or a PRISM model (extra `prism`)")
    read.add_argument("file", type=Path, help="*.yaml and *.json are environments, all else is PRISM")
    read.add_argument("--name", help="name of the environment; a PRISM model has none of its own")
    read.add_argument("--replace", action="store_true", help="replace the environment of that name, if there is one")
    read.add_argument(
        "--constant",
        dest="constants",
        action="append",
        default=[],
        type=_constant,
        metavar="N=5",
        help="value of a constant that the model leaves open",
    )
    read.add_argument(
        "--rewards", help="reward structure that says what actions cost; by default costs, or the only one"
    )
    read.add_argument("--timeout", type=int, default=60, help="seconds until Storm is stopped")
    read.add_argument("--output", type=Path, help="write the environment as JSON to this file instead of storing it")
    read.add_argument("--server", help="address of a running server; without it none is needed")


def export(settings: Settings, options: argparse.Namespace, data: Mapping[str, Any] | None) -> int:
    """Write an environment (`data`, or the stored one that is named); the exit status."""
    from service.client import UnreachableError, client

    if options.product and (options.ltl is None or options.format == "prism"):
        print("--product needs --ltl, and is written in DRN", file=sys.stderr)
        return 2
    try:
        if data is None:
            with client(options.server, settings) as asking:
                status, found = asking.ask("GET", f"/environments/{options.environment}")
            if status != 200:
                print(found.get("detail", found), file=sys.stderr)
                return 1
            data = found["spec"]
        text = _exported(data, options)
    except (CqltlError, UnreachableError) as error:
        print(error.detail if isinstance(error, CqltlError) else error, file=sys.stderr)
        return 1
    if options.output is None:
        sys.stdout.write(text)
    else:
        options.output.write_text(text, encoding="utf-8")
    return 0


def _exported(data: Mapping[str, Any], options: argparse.Namespace) -> str:
    from models.interchange import drn_model, drn_product, label_names, prism_model, property_text
    from models.logic import atoms, parse, translate
    from models.world import compile_world, load_environment, resolve

    environment = load_environment(data)
    formula = resolve(parse(options.ltl), environment) if options.ltl else None
    wanted = () if formula is None else atoms(formula)
    if options.product and formula is not None:
        return drn_product(compile_world(environment), translate(formula))
    if options.format == "drn":
        text = drn_model(compile_world(environment), atoms=wanted, reachable=options.reachable)
    else:
        text = prism_model(environment, atoms=wanted)
    return text if formula is None else f"// {property_text(formula, label_names(wanted))}\n{text}"


def import_environment(settings: Settings, options: argparse.Namespace) -> int:
    """Read an environment or a PRISM model and store it, or write it as JSON; the exit status."""
    from service.client import UnreachableError, client
    from service.store.soundness import shown

    model = options.file.suffix not in ENVIRONMENT_FILES
    if model and options.name is None:
        print("a PRISM model needs a --name", file=sys.stderr)
        return 2
    if not model and (options.constants or options.rewards):
        print("--constant and --rewards are for PRISM models", file=sys.stderr)
        return 2
    try:
        data = _model(options) if model else _named(read_environment(options.file), options.name)
        if options.output is not None:
            options.output.write_text(json.dumps(data, indent=1) + "\n", encoding="utf-8")
            return 0
        name = data.get("name") if isinstance(data, dict) else None
        method, path = "POST", "/environments"
        if options.replace and isinstance(name, str):
            method, path = "PUT", f"{path}/{quote(name, safe='')}"
        with client(options.server, settings) as asking:
            status, answer = asking.ask(method, path, data)
    except (CqltlError, UnreachableError) as error:
        print(getattr(error, "detail", error), file=sys.stderr)
        if caret := getattr(error, "caret", ""):
            print(caret, file=sys.stderr)
        return 1
    if status >= 400:
        print(json.dumps(answer, indent=2, ensure_ascii=False), file=sys.stderr)
        return 1
    print(f"{answer['name']}: {_counted(data)}")
    if options.server is None:
        print(f"stored in {shown(settings.url)}; --server stores it in that of a service", file=sys.stderr)
    return 0


def read_environment(path: Path) -> Any:
    """The data of a YAML or JSON file; the command ends where it cannot be read."""
    import yaml

    try:
        found = yaml.safe_load(path.read_text(encoding="utf-8"))  # JSON is YAML
        return json.loads(json.dumps(found, default=str))  # what looks like a date is text here
    except (OSError, UnicodeDecodeError, yaml.YAMLError, TypeError) as error:
        sys.exit(f"{path}: {error}")


def _named(data: Any, name: str | None) -> Any:
    """The data under another name, if one is given; what is no mapping is for the service to refuse."""
    return {**data, "name": name} if name is not None and isinstance(data, dict) else data


def _model(options: argparse.Namespace) -> dict[str, Any]:
    from models.interchange import read_prism

    return read_prism(
        options.file,
        name=options.name,
        constants=dict(options.constants),
        rewards=options.rewards,
        timeout_s=options.timeout,
    )


def _counted(data: Mapping[str, Any]) -> str:
    """What a stored environment has."""
    if data["kind"] == "explicit":
        costs = ", with costs" if any("cost" in transition for transition in data["transitions"]) else ""
        return f"{data['states']} states, {len(data['transitions'])} transitions{costs}"
    from models.world import compile_world, load_environment

    world = compile_world(load_environment(data))
    return f"{world.size:,} states, {len(world.actions)} actions"


def _constant(text: str) -> tuple[str, str]:
    name, sign, value = text.partition("=")
    if not (name and sign and value):
        raise argparse.ArgumentTypeError("a constant is written name=value")
    return name, value

"""How long a translation takes: in the process, and as a whole HTTP request.

    python -m benchmarks.translate [--sample 50] [--json FILE]

Translates `--sample` commands of S and of U of both domains, the same ones each time, one at a time, with one
thread, after as many others that are not counted: what was asked before would be answered from memory. The columns are
the translator alone; with grounding, five readings put into their templates in an environment that holds every name of
the set; and a POST to /translate on a server of its own over loopback, without and with that environment, on a
connection that is kept open. That is sent by `http.client`, which takes little time of its own; httpx takes one to two
milliseconds of every request. Each cell is the median and the 95th percentile.
"""

from __future__ import annotations

import argparse
import json
import platform
import random
import statistics
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from http import HTTPStatus
from http.client import HTTPConnection
from pathlib import Path
from typing import Any, get_args

import httpx

from benchmarks.server import serving
from models.language import BEAM_WIDTH
from models.language.dataset import Domain, Part, generate, grounding_environment
from models.language.reading import rank, rank_formulas
from models.language.scene import Scene
from models.logic import parse
from models.queries import Template
from models.world import Environment, load_environment
from service.translators import TranslatorKey, Translators

COLUMNS = ("alone", "with grounding", "HTTP", "HTTP, grounded")


@dataclass(frozen=True, slots=True)
class Command:
    """A command, and an environment that has what it names."""

    text: str
    environment: Environment


def commands(size: int) -> tuple[list[Command], list[Command]]:
    """`size` commands of S and of U of each domain to begin with, and as many others to be timed."""
    first: list[Command] = []
    timed: list[Command] = []
    for domain in Domain:
        data = generate(domain)
        for part, examples in ((Part.SEEN, data.seen), (Part.UNSEEN, data.unseen)):
            environment = load_environment(grounding_environment(domain, part))
            sample = [Command(e.text, environment) for e in random.Random(0).sample(examples, 2 * size)]
            first += sample[:size]
            timed += sample[size:]
    return first, timed


def templates(client: httpx.Client) -> dict[str, Template]:
    """The templates of a server by task."""
    found = client.get("/templates", params={"limit": 200}).json()["items"]
    return {item["task"]: _template(item) for item in found}


def _template(item: dict[str, Any]) -> Template:
    kinds, taught = (
        tuple(frozenset(parameter[name].split(" | ")) for parameter in item["parameters"])
        for name in ("type", "taught")
    )
    return Template(item["task"], parse(item["template"]), parse(item["lifted"]), kinds, taught)


def ways(name: str, client: httpx.Client) -> dict[str, Callable[[Command], object]]:
    """What to time for one translator, by column."""
    translators, known = Translators.shipped(), templates(client)

    def translate(command: Command, candidates: int = 1) -> Any:
        found = translators.formulas(name) if translators.gives_formulas(name) else translators.queries(name)
        return found.translate(command.text, candidates=candidates)

    def ground(command: Command) -> object:
        said = translate(command, BEAM_WIDTH)
        if translators.gives_formulas(name):
            return rank_formulas(((f.formula, f.confidence) for f in said), environment=command.environment)
        return rank(said, Scene(command.text, command.environment, known.get))

    connection = HTTPConnection(client.base_url.host, client.base_url.port or 80)

    def post(command: Command, **members: str) -> object:
        body = json.dumps({"text": command.text, "translator": name, **members})
        connection.request("POST", "/translate", body, {"Content-Type": "application/json"})
        response = connection.getresponse()
        answer = response.read()
        if response.status != HTTPStatus.OK:
            raise RuntimeError(answer.decode())
        return answer

    def post_in_environment(command: Command) -> object:
        return post(command, environment=command.environment.name)

    return dict(zip(COLUMNS, (translate, ground, post, post_in_environment), strict=True))


def measure(way: Callable[[Command], object], first: Sequence[Command], timed: Sequence[Command]) -> dict[str, float]:
    """Median and 95th percentile of the milliseconds of a timed command."""
    for command in first:
        way(command)
    taken = []
    for command in timed:
        began = time.perf_counter()
        way(command)
        taken.append((time.perf_counter() - began) * 1000)
    return {"median_ms": statistics.median(taken), "p95_ms": statistics.quantiles(taken, n=20)[-1]}


def main(arguments: Sequence[str] | None = None) -> None:
    """Measure and print the table."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0] if __doc__ else None)
    parser.add_argument("--sample", type=int, default=50, help="commands of S and of U of each domain")
    parser.add_argument("--translators", nargs="+", default=list(get_args(TranslatorKey)), help="which to measure")
    parser.add_argument("--json", type=Path)
    options = parser.parse_args(arguments)
    first, timed = commands(options.sample)
    with serving() as client:
        for domain in Domain:
            for part in Part:
                client.post("/environments", json=grounding_environment(domain, part)).raise_for_status()
        table = {
            name: {column: measure(way, first, timed) for column, way in ways(name, client).items()}
            for name in options.translators
        }
    print(f"{len(timed)} commands, median and p95; Python {platform.python_version()}, {platform.machine()}\n")
    print(f"| translator | {' | '.join(COLUMNS)} |")
    print("|---" * (len(COLUMNS) + 1) + "|")
    for name, row in table.items():
        cells = (f"{cell['median_ms']:.1f}, {cell['p95_ms']:.1f} ms" for cell in row.values())
        print(f"| `{name}` | {' | '.join(cells)} |")
    if options.json:
        options.json.write_text(json.dumps(table, indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()

"""The command line, `cqltl`: what runs the service, what asks it, and what reads and writes files."""

from __future__ import annotations

import argparse
import asyncio
import gc
import json
import os
import signal
import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Any
from urllib.parse import quote

from pydantic import ValidationError

from service.binding import listen
from service.errors import CannotStartError
from service.exchange import add_commands, export, import_environment, read_environment
from service.keys_command import add_keys_command, keys
from service.settings import Settings
from service.store.engine import is_postgresql

if TYPE_CHECKING:
    from service.client import Client

INTERRUPTED = 130
"""The exit status of what was interrupted, as shells have it."""
PLAN_OPTIONS = ("objective", "verify", "no_relevance")
"""Arguments of `plan` that are members of the request's `options`."""
NOT_MEMBERS = ("command", "server", "environment_file", "format", "gif", "answer")
"""Arguments that are no members of a request."""


def main(arguments: Sequence[str] | None = None) -> int:
    """Run one command; the result is the exit status: 0 done, 1 refused, 2 not understood, 130 interrupted."""
    options = _parser().parse_args(arguments)
    try:
        settings = Settings()
    except ValidationError as error:
        for item in error.errors():
            print(f"CQLTL_{'_'.join(map(str, item['loc'])).upper()}: {item['msg']}", file=sys.stderr)
        return 2
    if is_postgresql(settings.url) and not all(map(find_spec, ("psycopg", "procrastinate"))):
        print(
            "CQLTL_DATABASE_URL: PostgreSQL needs the extra `postgres`: pip install 'cqltl[postgres]'", file=sys.stderr
        )
        return 2
    commands: dict[str, Callable[[Settings, argparse.Namespace], int]] = {
        "serve": _serve,
        "worker": _worker,
        "keys": _keys,
        "doctor": _doctor,
        "openapi": _openapi,
        "export": _export,
        "import": _import,
    }
    try:
        return commands.get(options.command, _request)(settings, options)
    except CannotStartError as error:
        print(error, file=sys.stderr)
        return 1
    except KeyboardInterrupt:  # Ctrl-C while it loads or waits, which needs no explanation
        return INTERRUPTED


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="cqltl", description="English robot commands to plans.")
    commands = parser.add_subparsers(dest="command", required=True)

    serve = commands.add_parser("serve", help="migrate the store and serve over HTTP")
    serve.add_argument("--host", help="address to bind (CQLTL_HOST, 127.0.0.1)")
    serve.add_argument("--port", type=_port, help="port to bind, 0 for any free one (CQLTL_PORT, 8000)")

    worker = commands.add_parser("worker", help="plan for the servers on a PostgreSQL database")
    worker.add_argument("--queues", type=_queues, default=["plan"], help="plan (default), gpu, or plan,gpu")

    add_keys_command(commands)
    commands.add_parser("doctor", help="say what is wrong with the installation, the store or the settings")

    translate = _remote(commands.add_parser("translate", help="English to a contextual query and LTL"))
    translate.add_argument("text")
    translate.add_argument("--environment", help="name of a stored environment; without it there is no LTL")
    _translator(translate)
    _answers(translate)
    translate.add_argument("--candidates", type=int, default=1, help="how many readings to print")

    learn = _remote(commands.add_parser("learn", help="learn a task class from a contextual query and its LTL"))
    learn.add_argument("contextual_query")
    learn.add_argument("ltl")
    learn.add_argument("--environment", required=True)
    learn.add_argument("--example", dest="examples", action="append", default=[], help="an utterance of the query")
    learn.add_argument("--explanation", help='what it is read back as: "the {1} ends up in the {2}"')
    learn.add_argument("--replace", action="store_true", help="replace another template of the task")

    explain = _remote(commands.add_parser("explain", help="a formula or a contextual query in plain English"))
    said = explain.add_mutually_exclusive_group(required=True)
    said.add_argument("ltl", nargs="?")
    said.add_argument("--contextual-query")
    explain.add_argument("--environment", help="whose words to use; without it, atoms are read as written")

    plan = _remote(commands.add_parser("plan", help="a policy for a command, a contextual query or a formula"))
    what = plan.add_mutually_exclusive_group(required=True)
    what.add_argument("text", nargs="?")
    what.add_argument("--contextual-query")
    what.add_argument("--ltl")
    _translator(plan)
    _answers(plan)
    where = plan.add_mutually_exclusive_group(required=True)
    where.add_argument("--environment")
    where.add_argument("--environment-file", type=Path, help="an environment as YAML or JSON")
    plan.add_argument("--objective", choices=["max", "min"], help="max (default), or min: the least probability")
    plan.add_argument("--verify", action="store_true", help="also evaluate the policy apart from planning")
    plan.add_argument("--no-relevance", action="store_true", help="plan in the whole world, with what cannot matter")
    plan.add_argument("--format", choices=["text", "json"], help="text draws the run: the default on a terminal")
    plan.add_argument("--gif", type=Path, help="also write the run as an animation (needs the extra `gif`)")

    add_commands(commands)
    document = _remote(commands.add_parser("openapi", help="print the OpenAPI document"))
    document.add_argument("--output", type=Path, help="write it to this file")
    document.add_argument("--check", type=Path, help="fail when this file differs from it")
    return parser


def _translator(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--translator", help="default, cq-copynet, cq-copynet-pos or ltl-copynet")


def _answers(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--answer",
        action="append",
        default=[],
        help="to the question, or none where no choice is right; again for the next",
    )


def _port(text: str) -> int:
    number = int(text)
    if not 0 <= number <= 65535:
        raise argparse.ArgumentTypeError("a port is a number from 0 to 65535")
    return number


def _queues(text: str) -> list[str]:
    names = [name.strip() for name in text.split(",") if name.strip()]
    if not names or not set(names) <= {"plan", "gpu"}:
        raise argparse.ArgumentTypeError("queues are plan and gpu, separated by a comma")
    return names


def _remote(parser: argparse.ArgumentParser) -> argparse.ArgumentParser:
    parser.add_argument("--server", help="address of a running server; without it none is needed")
    return parser


def _serve(settings: Settings, options: argparse.Namespace) -> int:
    port = settings.port if options.port is None else options.port
    with listen(settings, options.host or settings.host, port) as listener:  # first: what is refused loads nothing
        with _ending_at_once():
            from service.forkserver import launch
            from service.keys import KeyRing
            from service.store.migrate import migrate

            if settings.api_keys_file:
                KeyRing(settings.api_keys_file)
            migrate(settings.url)
            launch()  # before this process loads what it needs itself, so that both load at once
            gc.disable()  # until all is loaded (`service.server`): to look through it takes a tenth of the time
            from service.server import serve

        serve(settings, listener)
    return 0


@contextmanager
def _ending_at_once() -> Iterator[None]:
    """Ctrl-C ends the process, whatever it does: there is nothing to put in order yet, and libraries that are
    interrupted print what they were at.
    """
    before = signal.signal(signal.SIGINT, lambda *_: os._exit(INTERRUPTED))
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before)


def _worker(settings: Settings, options: argparse.Namespace) -> int:
    if not is_postgresql(settings.url):
        print("the service plans itself on SQLite; workers need a CQLTL_DATABASE_URL of PostgreSQL", file=sys.stderr)
        return 2
    from service.forkserver import launch

    launch()
    from service.jobs.queue_worker import work
    from service.logs import configure
    from service.store.migrate import migrate

    configure(settings.log_format, settings.log_level)
    said = f"cqltl works on {', '.join(options.queues)}"
    migrate(settings.url)
    asyncio.run(work(settings, options.queues, lambda: print(said, flush=True)))
    return 0


def _keys(settings: Settings, options: argparse.Namespace) -> int:
    return keys(settings, options)


def _doctor(settings: Settings, _options: argparse.Namespace) -> int:
    from service.doctor import examine

    levels = []
    for finding in examine(settings):
        print(finding.line, flush=True)
        levels.append(finding.level)
    return 1 if "wrong" in levels else 0


def _request(settings: Settings, options: argparse.Namespace) -> int:
    """Send the command as the request it stands for, and print the answer."""
    from service.client import UnreachableError, client

    body = {
        name: value
        for name, value in vars(options).items()
        if name not in (*NOT_MEMBERS, *PLAN_OPTIONS) and value not in (None, [], False)
    }
    if chosen := _plan_options(options):
        body["options"] = chosen
    if getattr(options, "environment_file", None) is not None:
        body["environment_spec"] = read_environment(options.environment_file)
    try:
        with client(options.server, settings) as asking:
            status, answer = _asked(asking, options, body)
            if options.command == "plan" and status < 400:
                return _show(asking, options, body, answer)
    except UnreachableError as error:
        print(error, file=sys.stderr)
        return 1
    print(json.dumps(answer, indent=2, ensure_ascii=False), file=sys.stdout if status < 400 else sys.stderr)
    return 0 if status < 400 else 1


def _asked(asking: Client, options: argparse.Namespace, body: dict[str, Any]) -> tuple[int, Any]:
    """The answer to a request, and to what is asked back."""
    path = f"/{options.command}"
    status, answer = asking.ask("POST", path, body)
    for choice in getattr(options, "answer", []):
        body["answers"] = [*body.get("answers", []), _answer(choice, answer.get("question"))]
        status, answer = asking.ask("POST", path, body)
    return status, answer


def _answer(choice: str, question: dict[str, Any] | None) -> dict[str, Any]:
    """A choice as the answer to a question; what is asked about is taken from that."""
    about = {} if question is None else {name: question[name] for name in ("part", "argument")}
    nothing = choice == "none" and "none" not in (question or {}).get("choices", [])
    said = {name: value for name, value in about.items() if value is not None}
    return {"choice": None if nothing else choice, **said}


def _plan_options(options: argparse.Namespace) -> dict[str, Any]:
    """The members of a plan's `options` that were given."""
    objective, verify, whole = (getattr(options, name, None) for name in PLAN_OPTIONS)
    found: dict[str, Any] = {"objective": objective} if objective else {}
    if verify:
        found["verify"] = True
    if whole:
        found["relevance"] = False
    return found


def _show(asking: Client, options: argparse.Namespace, body: dict[str, Any], answer: Any) -> int:
    """Print a plan as JSON, or draw its run; and write the animation if one is asked for."""
    from service.showing import animate, show, wants_text

    text = wants_text(options.format)
    if not text:
        print(json.dumps(answer, indent=2, ensure_ascii=False))
    if not text and options.gif is None:
        return 0
    spec = body.get("environment_spec")
    if spec is None:
        _, found = asking.ask("GET", f"/environments/{quote(options.environment)}")
        spec = found["spec"]
    if text:
        print(show(answer, spec))
    failed = None if options.gif is None else animate(answer, spec, options.gif)
    if failed:
        print(failed, file=sys.stderr)
    return 1 if failed else 0


def _export(settings: Settings, options: argparse.Namespace) -> int:
    return export(settings, options, options.environment_file and read_environment(options.environment_file))


def _import(settings: Settings, options: argparse.Namespace) -> int:
    return import_environment(settings, options)


def _openapi(settings: Settings, options: argparse.Namespace) -> int:
    """Print, write or compare the document of this version, or of the server that is asked."""
    import yaml

    from service.client import UnreachableError, document

    try:
        found = document(server=options.server, settings=settings)
    except UnreachableError as error:
        print(error, file=sys.stderr)
        return 1
    separate = json.loads(json.dumps(found))  # what two places share would be an alias, of which generators read few
    text = yaml.safe_dump(separate, sort_keys=False, allow_unicode=True, width=100)
    if options.check is not None:
        if options.check.read_text(encoding="utf-8") == text:
            return 0
        print(f"{options.check} is not what the app serves; `make openapi` writes it anew", file=sys.stderr)
        return 1
    if options.output is not None:
        options.output.write_text(text, encoding="utf-8")
    else:
        print(text, end="")
    return 0


if __name__ == "__main__":
    sys.exit(main())

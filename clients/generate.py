"""Generates clients from openapi.yaml: two for Python, one each for TypeScript and C++.

    python -m clients.generate [--output build/clients] [NAME ...]

Needs the extra `clients`: `pip install -e '.[clients]'`, which brings a Java runtime along. The names:

- `python`: openapi-generator's, package `cqltl_client`, synchronous, pydantic models
- `python-httpx`: openapi-python-client's, package `cqltl_httpx_client`, synchronous and asynchronous
- `typescript`: openapi-generator's `typescript-fetch`, package `cqltl-client`
- `cpp`: openapi-generator's `cpp-restsdk`, library `CqltlClient`; `cpp/EnvironmentSpec.h` belongs to it
"""

from __future__ import annotations

import argparse
import os
import shutil
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path

HERE = Path(__file__).parent
DOCUMENT = HERE.parent / "openapi.yaml"

_GENERATOR = {
    "python": ["python", "--additional-properties=packageName=cqltl_client,projectName=cqltl-client"],
    "typescript": ["typescript-fetch", "--additional-properties=npmName=cqltl-client,supportsES6=true"],
    "cpp": [
        "cpp-restsdk",
        "--additional-properties=packageName=CqltlClient",
        "--schema-mappings=EnvironmentSpec=Object",
        '--import-mappings=EnvironmentSpec=#include "EnvironmentSpec.h"',
    ],
}
_BOTH_ANSWERS = (  # of a plan in time and of one that became a job, openapi-generator takes the first type for each
    ("Promise<runtime.ApiResponse<PlanResponse>>", "Promise<runtime.ApiResponse<PlanResponse | JobOut>>"),
    ("Promise<PlanResponse>", "Promise<PlanResponse | JobOut>"),
    (
        "(response, (jsonValue) => PlanResponseFromJSON(jsonValue))",
        "<PlanResponse | JobOut>(response, (jsonValue) =>\n"
        "            response.status === 202 ? JobOutFromJSON(jsonValue) : PlanResponseFromJSON(jsonValue))",
    ),
)
"""What is put in the place of what in the TypeScript client's `PlanningApi`."""
NAMES = (*_GENERATOR, "python-httpx")


class GenerationError(Exception):
    """A generator refused the document, or is not installed."""


def generate(name: str, output: Path) -> Path:
    """Generate one of `NAMES` in a folder of its own below `output`; that folder, empty before."""
    folder = output.absolute() / name
    shutil.rmtree(folder, ignore_errors=True)
    folder.parent.mkdir(parents=True, exist_ok=True)
    if name == "python-httpx":
        package = folder / "cqltl_httpx_client"
        folder.mkdir()
        _run("openapi-python-client", "generate", "--path", DOCUMENT, "--meta", "none", "--output-path", package)
    else:
        _run("openapi-generator-cli", "generate", "-i", DOCUMENT, "-o", folder, "-g", *_GENERATOR[name])
    if name == "cpp":
        shutil.copy(HERE / "cpp" / "EnvironmentSpec.h", folder / "include")
    if name == "typescript":
        _tell_jobs_from_plans(folder / "src" / "apis" / "PlanningApi.ts")
    return folder


def _tell_jobs_from_plans(path: Path) -> None:
    """Let `plan` return either; raises `GenerationError` where the generator has come to write something else."""
    text = path.read_text(encoding="utf-8")
    for old, new in _BOTH_ANSWERS:
        if old not in text:
            raise GenerationError(f"{path} has no {old!r} to be mended")
        text = text.replace(old, new, 1)
    path.write_text(text, encoding="utf-8")


def _run(program: str, *arguments: str | Path) -> None:
    """Run a program of this environment; raises `GenerationError` with what it said."""
    found = Path(sys.executable).with_name(program)
    if not found.is_file():
        raise GenerationError(f"{program} is not installed: pip install -e '.[clients]'")
    path = os.pathsep.join([str(found.parent), os.environ.get("PATH", "")])
    command = [str(found), *map(str, arguments)]
    result = subprocess.run(command, env={**os.environ, "PATH": path}, capture_output=True, text=True, check=False)
    if result.returncode != 0:
        raise GenerationError(f"{program} failed:\n{result.stdout}{result.stderr}")


def main(arguments: Sequence[str] | None = None) -> None:
    """Generate what is asked for, or all."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0] if __doc__ else None)
    parser.add_argument("names", nargs="*", metavar="NAME", help=f"of {', '.join(NAMES)}; all of them by default")
    parser.add_argument("--output", type=Path, default=Path("build/clients"))
    options = parser.parse_args(arguments)
    if unknown := set(options.names) - set(NAMES):
        parser.error(f"no such client: {', '.join(sorted(unknown))}")
    for name in options.names or NAMES:
        try:
            print(generate(name, options.output))
        except GenerationError as error:
            sys.exit(str(error))


if __name__ == "__main__":
    main()

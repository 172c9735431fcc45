"""Runs the blocks of a page as a reader would: in order, in one shell, in the repository, against a new server."""

from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any

from tests.documents.blocks import ROOT, Block

ADDRESS = "http://127.0.0.1:8000"
"""Where the pages say that the service is."""
LINKED = ("docker", "docs", "examples", "models", "openapi.yaml", "pyproject.toml", "service", "tests")

PREAMBLE = """set -euo pipefail
curl() { command curl --silent --show-error --fail-with-body "$@"; }
"""


def needs_server(blocks: list[Block]) -> bool:
    return any(ADDRESS in block.text or block.info.startswith(("GET /", "POST /", "PUT /")) for block in blocks)


def run(blocks: list[Block], folder: Path, server: str) -> dict[Block, str]:
    """What each block printed that is run.

    Raises:
        AssertionError: a block failed that does not show a problem as its answer, or one that does did not fail.
    """
    _prepare(folder)
    script = [PREAMBLE]
    ran: list[Block] = []
    for number, block in enumerate(blocks):
        command = _command(block, folder, number, server)
        if command is None:
            continue
        after = blocks[number + 1] if number + 1 < len(blocks) else None
        output = folder / "outputs" / f"{number}"
        refused = after is not None and '"urn:cqltl:problem:' in after.text and after.follows
        script.append(f"echo {number} > outputs/last")
        script.append(f"{{\n{command}\n}} > {output}" + (" && exit 99 || true" if refused else ""))
        ran.append(block)
    text = "\n".join(script).replace(ADDRESS, server)
    result = subprocess.run(
        ["bash", "-c", text], cwd=folder, env=_environment(folder, server), capture_output=True, text=True, timeout=300
    )
    last = int((folder / "outputs" / "last").read_text())
    said = (folder / "outputs" / f"{last}").read_text(encoding="utf-8")
    assert result.returncode == 0, f"{blocks[last].place}: {result.stderr}{said}"
    return {block: (folder / "outputs" / f"{blocks.index(block)}").read_text(encoding="utf-8") for block in ran}


def agrees(shown: Any, found: Any, path: str = "") -> list[str]:
    """Where an answer is not what is shown of it: objects may have more, `"..."` is anything, numbers are rounded."""
    if shown == "...":
        return []
    if isinstance(shown, dict) and isinstance(found, dict):
        missing = [f"{path}/{name} is not there" for name in shown.keys() - found.keys()]
        return missing + [
            fault
            for name in shown.keys() & found.keys()
            for fault in agrees(shown[name], found[name], f"{path}/{name}")
        ]
    if isinstance(shown, list) and isinstance(found, list) and len(shown) == len(found):
        pairs = enumerate(zip(shown, found, strict=True))
        return [fault for n, (one, other) in pairs for fault in agrees(one, other, f"{path}/{n}")]
    if isinstance(shown, float) and isinstance(found, float) and abs(shown - found) <= 1e-4 * max(1.0, abs(shown)):
        return []
    return [] if shown == found else [f"{path}: {found!r} instead of {shown!r}"]


def last_json(text: str) -> Any:
    """The last of the JSON values that stand one after the other."""
    decoder, position, value = json.JSONDecoder(), 0, None
    while position < len(text.rstrip()):
        position += len(text[position:]) - len(text[position:].lstrip())
        value, position = decoder.raw_decode(text, position)
    return value


def _command(block: Block, folder: Path, number: int, server: str) -> str | None:
    """What the shell does for a block; files are written already."""
    text = block.text.replace(ADDRESS, server)
    if block.language == "sh":
        return re.sub(r"\.venv/bin/", "", block.text)
    if block.language == "json" and (request := re.fullmatch(r"(POST|PUT) (/\S*)", block.info)):
        (folder / f"body-{number}.json").write_text(text, encoding="utf-8")
        return f"curl --request {request[1]} --json @body-{number}.json {ADDRESS}{request[2]}"
    if block.language in ("yaml", "python", "prism") and block.info:
        (folder / block.info).write_text(text, encoding="utf-8")
        return None
    if block.language == "python":
        (folder / f"block-{number}.py").write_text(text, encoding="utf-8")
        return f"python block-{number}.py"
    return None


def _prepare(folder: Path) -> None:
    (folder / "outputs").mkdir()
    for name in LINKED:
        (folder / name).symlink_to(ROOT / name)
    programs = folder / "bin"
    programs.mkdir()
    for name, arguments in (("cqltl", " -m service"), ("python", "")):
        path = programs / name
        path.write_text(f'#!/bin/sh\nexec {sys.executable}{arguments} "$@"\n')
        path.chmod(0o755)


def _environment(folder: Path, server: str) -> dict[str, str]:
    """Nothing of the settings of whoever runs the tests."""
    ours = {name: value for name, value in os.environ.items() if not name.startswith(("CQLTL_", "OTEL_"))}
    return ours | {
        "PATH": f"{folder / 'bin'}:{os.environ['PATH']}",
        "PYTHONPATH": str(ROOT),
        "PYTHONWARNINGS": "ignore",
    }


def has_curl() -> bool:
    """curl of 7.82 or newer, for `--json`."""
    if (program := shutil.which("curl")) is None:
        return False
    said = subprocess.run([program, "--version"], capture_output=True, text=True, check=True).stdout
    return tuple(map(int, said.split()[1].split(".")[:2])) >= (7, 82)

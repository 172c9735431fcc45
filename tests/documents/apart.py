"""The blocks of the pages that are not run with the rest of their page, by how they begin, and why not. Each table has
tests of its own that run its blocks.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import TypeVar

from tests.documents.blocks import Block, blocks

Entry = TypeVar("Entry")

SETUP = {
    ("README.md", "make serve"): "`make test`, its second line, is what runs the tests",
    ("docs/tutorial.md", "make serve"): "the rest of the page has a server of its own",
    ("docs/running.md", "make wheel"): "builds and installs",
    (
        "docs/settings.md",
        "export CQLTL_DATABASE_URL=postgresql",
    ): "needs PostgreSQL, and three processes that do not end",
    ("docs/clients.md", "pip install -e '.[clients]'"): "downloads generators",
}
"""Run by `test_setup.py`, `make setup-check`."""

DOCKER = {
    ("docs/running.md", "docker compose --file docker/compose.yaml up"): "needs Docker",
    ("docs/running.md", "docker compose --file docker/compose.yaml exec"): "needs Docker",
    ("docs/running.md", "export CQLTL_DB_PASSWORD"): "needs Docker",
}
"""Run by `test_docker.py`, `make docker-check`."""

TRAINING = {
    ("docs/language.md", "make train"): "trains networks for hours",
    ("docs/experiments.md", "pip install -e '.[dev]'"): "trains networks for hours",
    ("docs/experiments.md", "make evaluate-human"): "needs data that are not in the repository",
}
"""Run by `test_training.py`, `make training-check`, with little of everything."""

APART = SETUP | DOCKER | TRAINING


def entry(table: Mapping[tuple[str, str], Entry], block: Block) -> Entry | None:
    """What a table says of a block."""
    found = [value for (page, start), value in table.items() if page == block.page and block.text.startswith(start)]
    return found[0] if found else None


def lines(table: Mapping[tuple[str, str], object], page: str) -> list[list[str]]:
    """The commands of each block of a page that a table names, without their comments."""
    found = [block.text.replace("\\\n", "") for block in blocks(page) if entry(table, block)]
    return [[line.partition("  #")[0].strip() for line in text.splitlines()] for text in found]

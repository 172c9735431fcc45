"""The blocks of the pages that are not run with the rest of their page, by how they begin."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TypeVar

from tests.documents.blocks import Block

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
"""Run by `tests/documents/test_setup.py`, each in its own way; they take minutes."""

UNRUN = {
    ("docs/running.md", "docker compose --file docker/compose.yaml up"): "needs Docker",
    ("docs/running.md", "docker compose --file docker/compose.yaml exec"): "needs Docker",
    ("docs/running.md", "export CQLTL_DB_PASSWORD"): "needs Docker",
    ("docs/language.md", "make train"): "trains networks for hours",
    ("docs/experiments.md", "pip install -e '.[dev]'"): "trains networks for hours",
    ("docs/experiments.md", "make evaluate-human"): "needs data that are not in the repository",
}
"""Not run, and why not. What their commands name has to be there."""

APART = SETUP | UNRUN


def entry(table: Mapping[tuple[str, str], Entry], block: Block) -> Entry | None:
    """What a table says of a block."""
    found = [value for (page, start), value in table.items() if page == block.page and block.text.startswith(start)]
    return found[0] if found else None

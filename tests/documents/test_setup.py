"""What the pages say of setting up is run as a reader would, in a copy of the repository on a machine that has nothing
yet but Python (`make setup-check`; some ten minutes).
"""

from __future__ import annotations

import re
import venv
from contextlib import ExitStack
from pathlib import Path

import pytest

from clients.generate import NAMES
from tests.documents.apart import SETUP, lines
from tests.documents.machine import environment, free_port, plans, run, running
from tests.service.postgres import Postgres

pytestmark = pytest.mark.long

ADDRESS = re.compile(r"http://127\.0\.0\.1:\d+")


@pytest.mark.parametrize("page", ["README.md", "docs/tutorial.md"])
def test_it_serves_after_one_command(copy: Path, page: str) -> None:
    """The first time it sets up, with the line that it prints as the proof."""
    serve = lines(SETUP, page)[0][0]
    assert serve == "make serve"
    variables = environment(CQLTL_PORT=free_port())
    with running(serve, copy, variables, until="/translate") as printed:
        assert '"ltl"' in run(printed[printed.index("curl ") :], copy, variables)


def test_the_wheel(copy: Path, tmp_path: Path) -> None:
    """`make wheel` in the copy; then another environment, without a checkout."""
    venv.create(tmp_path / "venv", with_pip=True)
    *prepare, serve = (
        line.replace("/var/lib/cqltl", str(tmp_path / "store")) for line in lines(SETUP, "docs/running.md")[0]
    )
    variables = environment(tmp_path / "venv" / "bin", CQLTL_PORT=free_port())
    for line in prepare:
        run(line, copy, variables)
    with running(serve, tmp_path, variables, until="cqltl serves") as printed:
        assert plans(ADDRESS.findall(printed)[0])
    assert (tmp_path / "store" / "cqltl.sqlite3").is_file()


def test_the_clients(copy: Path) -> None:
    variables = environment(copy / ".venv" / "bin")
    for line in lines(SETUP, "docs/clients.md")[0]:
        run(line, copy, variables)
    assert {path.name for path in (copy / "build" / "clients").iterdir()} == set(NAMES)


def test_many_machines(copy: Path, tmp_path: Path) -> None:
    """Each command is a process of its own, on a database server of the tests' own."""
    run(".venv/bin/pip install --quiet -e '.[postgres]'", copy, environment())
    postgres = Postgres()
    try:
        url = str(postgres.database())
        export, serve, *workers = lines(SETUP, "docs/settings.md")[0]
        assert export.startswith("export CQLTL_DATABASE_URL=postgresql+psycopg://")
        variables = environment(copy / ".venv" / "bin", CQLTL_DATABASE_URL=url)
        with ExitStack() as processes:
            command = serve.replace("8000", free_port())
            printed = processes.enter_context(running(command, tmp_path, variables, until="cqltl serves"))
            for worker in workers:
                processes.enter_context(running(worker, tmp_path, variables, until="cqltl works on"))
            assert plans(ADDRESS.findall(printed)[0])
    finally:
        postgres.stop()

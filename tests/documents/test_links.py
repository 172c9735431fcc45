"""What the pages point at is there, and each picture and figure has the command beside it that makes it."""

from __future__ import annotations

import importlib
import re

import pytest

from tests.documents import commands
from tests.documents.blocks import PAGES, ROOT, prose, read

COMMAND = re.compile(r"`((?:make [a-z-]+|python -m [\w.]+).*?)`")


def links() -> list[tuple[str, str]]:
    found = ((page, re.findall(r"\]\((?!https?:)([^)\s]+)\)", re.sub(r"`[^`]*`", "", prose(page)))) for page in PAGES)
    return [(page, target) for page, targets in found for target in targets]


def anchors(page: str) -> set[str]:
    """What GitHub makes of the headings of a page."""
    headings = re.findall(r"^#+ (.*)$", prose(page), re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings}


@pytest.mark.parametrize(("page", "target"), links())
def test_links_lead_somewhere(page: str, target: str) -> None:
    path, _, anchor = target.partition("#")
    file = ((ROOT / page).parent / path).resolve() if path else ROOT / page
    assert file.exists()
    assert not anchor or anchor in anchors(str(file.relative_to(ROOT)))


def test_every_page_is_linked_from_the_readme() -> None:
    assert {target for page, target in links() if page == "README.md"} >= set(PAGES) - {"README.md"}


@pytest.mark.parametrize("page", PAGES)
def test_every_picture_has_the_command_beside_it_that_makes_it(page: str) -> None:
    paragraphs = re.split(r"\n\s*\n", read(page))
    for number, paragraph in enumerate(paragraphs):
        if paragraph.startswith("!["):
            beside = " ".join(paragraphs[max(number - 2, 0) : number + 2])
            name = re.search(r"\]\((?:.*/)?(.*)\)", paragraph)
            assert name is not None
            assert COMMAND.search(beside) or f"--output {name[1]}" in beside, paragraph


def test_every_result_has_a_command_that_is_there() -> None:
    rows = re.findall(r"^\| (?!-)(.*?) \| (.*?) \| (.*?) \|$", read("README.md"), re.MULTILINE)
    assert len(rows) > 5
    for what, _, by in rows[1:]:
        found = COMMAND.findall(by)
        assert found, what
        for command in found:
            commands.check(command)


def test_every_command_that_the_prose_names_is_there() -> None:
    for page in PAGES:
        for command in COMMAND.findall(prose(page)):
            commands.check(command)


def test_the_architecture_names_what_is_there() -> None:
    text = prose("docs/architecture.md")
    for path in re.findall(r"`((?:models|service|migrations|clients|docker|benchmarks|tests)/[\w./]*)`", text):
        assert (ROOT / path).exists(), path
    for package, name in re.findall(r"`(world|logic|queries|language|planning)\.([\w.]+)[`:]", text):
        found = importlib.import_module(f"models.{package}")
        for part in name.split("."):
            try:
                found = getattr(found, part)
            except AttributeError:
                found = importlib.import_module(f"{found.__name__}.{part}")

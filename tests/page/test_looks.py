"""How the page looks, to be inspected in build/screenshots, and whether everybody can use it."""

from __future__ import annotations

import gzip
from typing import Any

import httpx
import pytest

from service.http.page import FILES, POLICY
from tests.page.conftest import SCREENSHOTS, Open, command, faster, said

pytestmark = pytest.mark.long
SHIP = "Put the towel in the basket, then put the basket in the bathroom"


@pytest.mark.parametrize("scheme", ["light", "dark"])
@pytest.mark.parametrize("width", [1280, 390])
def test_screenshots(visit: Open, width: int, scheme: str) -> None:
    page = visit(width=width, scheme=scheme)
    page.screenshot(path=SCREENSHOTS / f"first-{width}-{scheme}.png", full_page=True)
    command(page, SHIP)
    said(page, "3. ")
    page.click("#play")
    page.wait_for_selector(".automaton .current")
    page.evaluate("scrollTo({ top: 0, behavior: 'instant' })")
    page.screenshot(path=SCREENSHOTS / f"run-{width}-{scheme}.png", full_page=True)
    page.check("#values")
    page.check("#arrows")
    page.wait_for_selector(".heat")
    page.locator(".stage").screenshot(path=SCREENSHOTS / f"values-{width}-{scheme}.png")
    assert page.evaluate("document.documentElement.scrollWidth") <= width, "nothing sticks out"
    for world, text in (("toys", "Pick up a toy"), ("city", "Go to the museum, then the bakery, then the zoo")):
        page.select_option("#world-name", world)
        page.wait_for_function("world => location.hash === '#' + world", arg=world)
        command(page, text)
        page.wait_for_selector("#question:not([hidden])" if world == "toys" else "#play:not([disabled])")
        page.screenshot(path=SCREENSHOTS / f"{world}-{width}-{scheme}.png", full_page=True)
        assert page.evaluate("document.documentElement.scrollWidth") <= width


@pytest.mark.parametrize("width", [1280, 390])
@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_axe_finds_no_serious_violation(visit: Open, axe: str, scheme: str, width: int) -> None:
    page = visit(width=width, scheme=scheme)
    assert serious(page, axe) == []
    command(page, "Bring the towel")
    page.wait_for_selector("#question:not([hidden])")
    assert serious(page, axe) == []
    faster(page)
    command(page, SHIP)
    said(page, "Done: the task holds")
    page.check("#values")
    page.click(".steps .curl summary >> nth=0")
    page.click(".more summary")
    page.fill("#teach-ltl", "F (")
    page.get_by_role("button", name="Teach", exact=True).click()
    page.wait_for_selector("#teach-ltl-problem:not([hidden])")
    assert serious(page, axe) == []


def test_all_controls_are_reached_by_keyboard_and_named(visit: Open) -> None:
    page = visit()
    command(page, SHIP)
    page.wait_for_selector("#play:not([disabled])")
    page.click("#play")
    page.evaluate("document.activeElement.blur()")
    wanted = page.evaluate(
        "() => [...document.querySelectorAll('a[href], button:not(:disabled), select, input:not(:disabled), summary')]"
        ".filter(e => e.checkVisibility()).length"
    )
    reached: set[str] = set()
    for _ in range(3 * wanted):
        page.keyboard.press("Tab")
        reached.add(
            page.evaluate(
                "() => { const e = document.activeElement; e.dataset.seen ??= String(Math.random());"
                " return e.matches('a[href], button, select, input, summary') ? e.dataset.seen : ''; }"
            )
        )
    assert len(reached - {""}) == wanted


def test_the_page_is_light_and_bound_to_this_machine(site: httpx.Client) -> None:
    files = [path for path in FILES.iterdir() if path.is_file()]
    assert sum(len(gzip.compress(path.read_bytes())) for path in files) < 1_000_000
    assert site.get("/").headers["content-security-policy"] == POLICY
    for path in files:
        text = path.read_text(encoding="utf-8")
        assert "https://" not in text
        assert site.get(f"/static/{path.name}").status_code == 200


def test_it_is_painted_at_once_and_the_first_plan_comes_within_a_second(visit: Open) -> None:
    page = visit()
    paint = page.evaluate("performance.getEntriesByName('first-contentful-paint')[0].startTime")
    assert paint < 1_000, "300 ms on a machine that does nothing else"
    page.evaluate("performance.mark('sent')")
    command(page, "Go to the washing machine")
    page.wait_for_selector("#promise:not([hidden])")
    assert page.evaluate("performance.now() - performance.getEntriesByName('sent')[0].startTime") < 3_000, "1 s there"


def serious(page: Any, axe: str) -> list[str]:
    """What axe-core finds serious or critical."""
    page.evaluate(axe)  # as the developer tools do it: the page's policy forbids scripts in the page
    found = page.evaluate("() => axe.run(document, { resultTypes: ['violations'] })")
    return [
        f"{violation['id']}: {node['target']}"
        for violation in found["violations"]
        if violation["impact"] in ("serious", "critical")
        for node in violation["nodes"]
    ]

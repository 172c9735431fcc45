"""The picture of the page in the README: `python -m tests.page.draw`."""

from __future__ import annotations

import io
from pathlib import Path

from PIL import Image
from playwright.sync_api import sync_playwright

from benchmarks.server import serving
from tests.page.conftest import CHROMIUM

FILE = Path(__file__).parents[2] / "docs" / "pictures" / "page.png"


def draw() -> None:
    """Photograph the house in the middle of a run."""
    with serving() as client, sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=CHROMIUM, args=["--no-sandbox"])
        page = browser.new_page(viewport={"width": 1280, "height": 1440}, reduced_motion="reduce")
        page.goto(f"{client.base_url}#house")
        page.wait_for_selector("body[data-ready]")
        page.fill("#command", "Put the towel in the basket, then put the basket in the bathroom")
        page.click("#go")
        page.wait_for_selector(".automaton .current")
        page.click("#play")
        while "towel in robot" not in page.locator("#status").inner_text():
            page.click("#step")
        for _ in range(3):
            page.click("#step")
        page.check("#arrows")
        page.wait_for_selector(".arrow-sign")
        page.evaluate("scrollTo({ top: 0, behavior: 'instant' })")
        page.evaluate("document.activeElement.blur()")
        shot = page.screenshot()
        browser.close()
    FILE.parent.mkdir(parents=True, exist_ok=True)
    Image.open(io.BytesIO(shot)).convert("RGB").save(FILE, optimize=True)


if __name__ == "__main__":
    draw()

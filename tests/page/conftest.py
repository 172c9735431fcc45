"""An installed Chromium, driven by Playwright, on a server of its own; without either, these tests are skipped."""

from __future__ import annotations

import shutil
import subprocess
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import httpx
import pytest

from benchmarks.server import serving

ROOT = Path(__file__).parents[2]
SCREENSHOTS = ROOT / "build" / "screenshots"
CHROMIUM = next(
    (found for name in ("chromium", "chromium-browser", "google-chrome") if (found := shutil.which(name))), None
)

Open = Callable[..., Any]
"""Opens the page, at a width and in a colour scheme, in a world."""


@pytest.fixture(scope="session")
def browser() -> Iterator[Any]:
    """A headless browser."""
    playwright = pytest.importorskip(
        "playwright.sync_api", reason="the page is tested with Playwright: pip install playwright"
    )
    if CHROMIUM is None:
        pytest.skip("the page is tested in Chromium: apt-get install chromium")
    with playwright.sync_playwright() as running:
        found = running.chromium.launch(executable_path=CHROMIUM, args=["--no-sandbox"])
        yield found
        found.close()


@pytest.fixture(scope="session")
def site(browser: Any) -> Iterator[httpx.Client]:
    """A client of a new server."""
    with serving() as client:
        yield client


@pytest.fixture
def visit(browser: Any, site: httpx.Client) -> Iterator[Open]:
    """Opens pages; the test fails when one of them reports an error or asks another machine for anything."""
    faults: list[str] = []
    contexts: list[Any] = []
    home = str(site.base_url).rstrip("/")

    def watched(request: Any) -> None:
        if not request.url.startswith((home, "data:", "blob:")):
            faults.append(f"asked for {request.url}")

    def noted(message: Any) -> None:
        # Chromium says of every answer above 399 that it came; a problem that the page shows in words is no fault.
        if message.type in ("error", "warning") and "Failed to load resource" not in message.text:
            faults.append(f"console: {message.text}")

    def opened(world: str = "house", *, width: int = 1280, scheme: str = "light") -> Any:
        context = browser.new_context(
            viewport={"width": width, "height": 900}, color_scheme=scheme, reduced_motion="reduce"
        )
        contexts.append(context)
        context.set_default_timeout(20_000)
        page = context.new_page()
        page.on("request", watched)
        page.on("console", noted)
        page.on("pageerror", lambda error: faults.append(f"error: {error}"))
        page.goto(f"{home}/#{world}")
        page.wait_for_selector("body[data-ready]")
        return page

    yield opened
    for context in contexts:
        context.close()
    assert not faults


@pytest.fixture(scope="session")
def axe(tmp_path_factory: pytest.TempPathFactory) -> str:
    """The text of axe-core, by npm."""
    if (npm := shutil.which("npm")) is None:
        pytest.skip("axe-core comes with npm, which is not installed")
    folder = tmp_path_factory.mktemp("axe")
    command = [npm, "install", "--silent", "--no-audit", "--no-fund", "--prefix", str(folder), "axe-core@4"]
    try:
        subprocess.run(command, check=True, capture_output=True, timeout=120)
    except (subprocess.SubprocessError, OSError) as error:
        pytest.skip(f"npm could not install axe-core: {error}")
    return (folder / "node_modules" / "axe-core" / "axe.min.js").read_text(encoding="utf-8")


def command(page: Any, text: str) -> None:
    """Type a command and send it."""
    page.fill("#command", text)
    page.press("#command", "Enter")


def said(page: Any, words: str) -> None:
    """Wait until the line under the world says so."""
    page.wait_for_function("words => document.getElementById('status').textContent.includes(words)", arg=words)


def faster(page: Any) -> None:
    """As fast as the slider goes."""
    page.evaluate(
        "() => { const s = document.getElementById('speed'); s.value = 8; s.dispatchEvent(new Event('input')); }"
    )

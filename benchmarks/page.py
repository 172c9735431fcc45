"""How soon the page is painted, and its first plan there, on a server that has just begun to listen.

    python -m benchmarks.page [--repeats 5]

Each time a new server with a new store and a new browser: milliseconds to the first contentful paint, as Chromium tells
it, and from the sentence being sent until its plan is shown. Needs Playwright and Chromium (`pip install playwright`,
Debian and Ubuntu: apt install chromium). The exit status is 1 where a median is beyond what `PROMISED` says.
"""

from __future__ import annotations

import argparse
import shutil
import statistics
import sys
from collections.abc import Sequence
from typing import Any

from benchmarks.server import serving

PROMISED = {"first paint": 300.0, "first plan": 1_000.0}
"""Milliseconds, on a machine that does nothing else."""
BROWSERS = ("chromium", "chromium-browser", "google-chrome")
SENTENCE = "Put the towel in the basket, then put the basket in the bathroom"


def run(chromium: Any, executable: str) -> list[float]:
    """Milliseconds of each of `PROMISED`."""
    with serving() as client:
        browser = chromium.launch(executable_path=executable, args=["--no-sandbox"])
        page = browser.new_page()
        page.goto(str(client.base_url))
        page.wait_for_selector("body[data-ready]")
        paint = page.evaluate("performance.getEntriesByName('first-contentful-paint')[0].startTime")
        page.fill("#command", SENTENCE)
        page.evaluate("performance.mark('sent')")
        page.press("#command", "Enter")
        page.wait_for_selector("#promise:not([hidden])")
        plan = page.evaluate("performance.now() - performance.getEntriesByName('sent')[0].startTime")
        browser.close()
    return [paint, plan]


def main(arguments: Sequence[str] | None = None) -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0] if __doc__ else None)
    parser.add_argument("--repeats", type=int, default=5)
    options = parser.parse_args(arguments)
    executable = next((found for name in BROWSERS if (found := shutil.which(name))), None)
    if executable is None:
        sys.exit("Chromium is missing (Debian and Ubuntu: apt install chromium)")
    from playwright.sync_api import sync_playwright  # not needed by any other benchmark

    with sync_playwright() as playwright:
        runs = [run(playwright.chromium, executable) for _ in range(options.repeats)]
    late = []
    for (name, most), taken in zip(PROMISED.items(), zip(*runs, strict=True), strict=True):
        median = statistics.median(taken)
        print(f"{name}: median {median:.0f} ms, worst of {len(taken)} {max(taken):.0f} ms")
        late += [f"{name}: {median:.0f} ms, not {most:.0f} ms"] if median > most else []
    if late:
        sys.exit("\n".join(late))


if __name__ == "__main__":
    main()

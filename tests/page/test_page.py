"""What a visitor does on the page, in a browser."""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import httpx
import pytest

from benchmarks.server import serving
from service.keys import add_key
from tests.page.conftest import SCREENSHOTS, Open, command, faster, said
from tests.world.worlds import TINY

pytestmark = pytest.mark.long
SHIP = "Put the towel in the basket, then put the basket in the bathroom"
LESSON = {"contextual_query": "finish()", "ltl": "F b", "environment": "tiny", "examples": ["head for the end"]}
SVG = "{http://www.w3.org/2000/svg}"


def test_a_command_is_understood_planned_and_done(visit: Open) -> None:
    page = visit()
    faster(page)
    command(page, SHIP)
    said(page, "Done: the task holds")
    steps = page.locator("#steps > li")
    assert steps.count() == 5
    assert [steps.nth(n).locator("h3").inner_text() for n in range(5)] == [
        "Sentence",
        "Query",
        "Template",
        "Formula",
        "In English",
    ]
    assert [re.sub(r"\d", "", text) for text in page.locator("mark").all_inner_texts()] == [
        "towel",
        "basket",
        "bathroom",
    ]
    assert "ship(towel, basket, bathroom)" in steps.nth(1).inner_text()
    assert "F (in($1, $2) & F (in($1, $2) & at($2, $3)))" in steps.nth(2).inner_text()
    assert "F (in(towel, basket)" in steps.nth(3).inner_text()
    assert page.locator(".automaton .state.current").count() == 1
    assert "satisfied" in page.locator(".automaton .state.current").text_content()
    assert "100 %" in page.locator("#promise").inner_text()


def test_every_step_shows_a_curl_command_that_does_the_same(visit: Open, site: httpx.Client) -> None:
    page = visit()
    command(page, SHIP)
    page.check("#values")
    page.wait_for_selector("#policy-curl pre", state="attached")
    blocks = [block.text_content() for block in page.locator("main .curl pre").all()]
    assert len(blocks) >= 9  # five steps, the plan, the automaton, the run, the values
    for block in blocks:
        body = re.search(r"--json '(.*)'", block)
        path = re.search(r"'http://[^/]+(/.*)'$", block)[1]  # type: ignore[index]  # it is there
        answer = site.post(path, json=json.loads(body[1].replace("'\\''", "'"))) if body else site.get(path)
        assert answer.status_code == 200, block


def test_a_question_is_answered_by_a_button(visit: Open) -> None:
    page = visit("toys")
    faster(page)
    command(page, "Pick up a toy")
    page.wait_for_selector("#question:not([hidden])")
    assert page.locator("#question-text").inner_text() == "Which toy?"
    assert page.evaluate("document.activeElement.closest('#choices') !== null")
    page.get_by_role("button", name="bag").click()
    said(page, "Done: the task holds")
    assert "F holding(bag)" in page.locator("#steps").inner_text()
    assert page.locator("#question").is_hidden()


def test_a_task_is_taught_and_used_on_something_else(visit: Open) -> None:
    page = visit()
    faster(page)
    page.fill("#teach-text", "Flick on the oven")
    page.fill("#teach-query", "flick_on(oven)")
    page.fill("#teach-ltl", "F running(oven")
    page.get_by_role("button", name="Teach", exact=True).click()
    page.wait_for_selector("#teach-ltl-problem:not([hidden])")
    page.fill("#teach-ltl", "F running(oven)")
    page.get_by_role("button", name="Teach", exact=True).click()
    page.wait_for_selector("#taught button")
    assert "F running($1)" in page.locator("#taught").inner_text()
    assert page.locator("#teach-ltl-problem").is_hidden()
    command(page, "Flick on the washing machine")
    said(page, "Done: the task holds")
    status = page.locator("[data-object=washing_machine] [data-part=status]")
    assert status.text_content() == "on"
    assert page.locator("[data-object=oven] [data-part=status]").text_content() == "off"


def test_a_long_plan_shows_its_progress_and_is_cancelled(visit: Open, site: httpx.Client) -> None:
    page = visit()
    # Nothing can be left out of the world for it, and each of the three is another part of the memory.
    command(page, "Pick up the cup and pick up the towel and pick up the basket again and again")
    page.wait_for_selector("#progress:not([hidden])")
    page.wait_for_function("document.getElementById('progress-text').textContent !== ''")
    page.locator("#progress").scroll_into_view_if_needed()
    page.screenshot(path=SCREENSHOTS / "progress.png")
    follow, cancel = (block.text_content() for block in page.locator("#progress .curl pre").all())
    page.get_by_role("button", name="Cancel").click()
    said(page, "Planning was cancelled.")
    assert page.locator("#progress").is_hidden()
    job = site.get("/jobs").json()["items"][0]
    assert job["state"] == "cancelled"
    assert follow.endswith(f"{job['url']}/events'")
    assert re.search(rf"--request POST \\\n  '.*{job['url']}/cancel'", cancel)


def test_a_long_plan_is_cancelled_by_its_curl_command(visit: Open, site: httpx.Client) -> None:
    page = visit()
    command(page, "Pick up the cup and pick up the towel and pick up the basket again and again")
    page.wait_for_selector("#progress:not([hidden])")
    cancel = page.locator("#progress .curl pre").nth(1).text_content()
    assert site.post(re.search(r"'http://[^/]+(/.*)'$", cancel)[1]).status_code == 200  # type: ignore[index]  # it is there
    said(page, "Planning was cancelled.")


@pytest.mark.parametrize("thing", ["robot", "towel"])
def test_what_is_dragged_in_the_middle_of_a_run_carries_on_from_there(visit: Open, thing: str) -> None:
    page = visit()
    command(page, SHIP)
    said(page, "1. ")
    page.click("#play")
    drag(page, thing, "spot_5_1")
    said(page, f"{thing.title()} was moved to living room (column 5, row 1). The policy carries on.")
    faster(page)
    said(page, "Done: the task holds")


def test_the_theme_is_chosen(visit: Open) -> None:
    page = visit(scheme="light")
    paper = "getComputedStyle(document.body).backgroundColor"
    light = page.evaluate(paper)
    page.get_by_role("button", name="Theme").click()
    assert page.evaluate(paper) == light
    page.get_by_role("button", name="Theme: light").click()
    assert page.evaluate(paper) != light
    page.get_by_role("button", name="Theme: dark").click()
    assert page.evaluate(paper) == light, "the visitor's own"


def test_an_object_is_moved_by_keyboard_in_the_middle_of_a_run(visit: Open) -> None:
    page = visit()
    command(page, SHIP)
    said(page, "1. ")
    page.click("#play")
    page.focus(".more summary")
    page.keyboard.press("Enter")
    page.select_option("#move-what", "towel")
    page.select_option("#move-where", "spot_5_1")
    page.focus("#move button")
    page.keyboard.press("Enter")
    said(page, "Towel was moved to living room (column 5, row 1). The policy carries on.")
    faster(page)
    said(page, "Done: the task holds")


def test_what_the_plan_does_not_cover_is_planned_anew(visit: Open) -> None:
    page = visit()
    command(page, SHIP)
    said(page, "1. ")
    page.click("#play")
    # Plans cover whatever can be dragged here; that of a world too large to plan for all would say this.
    problem = {"type": "urn:cqltl:problem:invalid-state", "title": "invalid state", "status": 422, "errors": []}
    refusal = json.dumps({**problem, "detail": "the plan was made for what can be reached: plan again"})
    page.route(
        "**/run",
        lambda route: route.fulfill(status=422, content_type="application/problem+json", body=refusal),
        times=1,
    )
    drag(page, "robot", "spot_5_1")
    said(page, "Robot was moved to living room (column 5, row 1). The plan was made anew from here.")
    asked = page.locator("#plan-curl pre").text_content()
    assert '"robot":{"at":"spot_5_1"}' in asked
    faster(page)
    said(page, "Done: the task holds")


def test_things_moved_before_anything_is_planned_are_where_plans_begin(visit: Open) -> None:
    page = visit("toys")
    drag(page, "sphere", "kitchen")
    said(page, "Plans begin from here.")
    page.click(".more summary")
    page.get_by_role("button", name="Put everything back").click()
    said(page, "Everything is where it was at first.")
    command(page, "Pickup the sphere")
    said(page, "Next: east")
    page.select_option("#world-name", "house")
    page.wait_for_function("() => location.hash === '#house'")
    page.select_option("#world-name", "toys")
    page.wait_for_function("() => location.hash === '#toys'")
    drag(page, "sphere", "kitchen")
    said(page, "Plans begin from here.")
    command(page, "Pickup the sphere")
    said(page, "Next: pick(sphere)")


def test_slip_is_changed_by_a_slider(visit: Open) -> None:
    page = visit("toys")
    command(page, "Pickup the sphere")
    page.wait_for_selector("#promise:not([hidden])")
    before = page.locator("#promise").inner_text()
    page.evaluate(
        "() => { const s = document.getElementById('slip'); s.value = 0.4;"
        " s.dispatchEvent(new Event('input')); s.dispatchEvent(new Event('change')); }"
    )
    page.wait_for_function(
        "before => { const p = document.getElementById('promise'); return !p.hidden && p.innerText !== before; }",
        arg=before,
    )
    assert page.locator("#slip-value").inner_text() == "40 %"
    steps = [
        float(re.search(r"Expected steps\n([\d.]+)", text)[1])
        for text in (before, page.locator("#promise").inner_text())
    ]  # type: ignore[index]
    assert steps[1] > steps[0]


def test_a_world_is_planned_with_the_slip_that_it_has(visit: Open, site: httpx.Client) -> None:
    toys = site.get("/environments/toys-4x1-sphere").json()["spec"]
    slipping = toys | {"name": "slipping", "parameters": {**toys.get("parameters", {}), "slip": 0.123}}
    assert site.put("/environments/slipping", json=slipping).status_code in (200, 201)
    page = visit("slipping")
    command(page, "Pickup the sphere")
    page.wait_for_selector("#promise:not([hidden])")
    assert page.locator("#slip-value").inner_text() == "12.3 %"
    assert '"environment":"slipping"' in page.locator("#plan-curl pre").text_content()


def test_a_reading_is_confirmed_or_not(visit: Open) -> None:
    page = visit("city")
    command(page, "Visit the museum twice")
    page.wait_for_selector("#question:not([hidden])")
    assert page.locator("#question-text").inner_text().startswith('"twice" is not understood')
    page.get_by_role("button", name="None of these").click()
    page.wait_for_selector("#command-problem:not([hidden])")
    assert page.locator("#question").is_hidden()
    told = page.locator("#command-problem").inner_text()
    assert told.startswith("No known task fits this. The nearest known ones are ")
    page.wait_for_function("document.activeElement.id == 'command'")


def test_what_is_left_out_is_asked_for(visit: Open) -> None:
    page = visit()
    faster(page)
    command(page, "Switch on the")
    page.get_by_role("button", name="The washing machine is switched on").click()
    said(page, "Done: the task holds")


def test_a_service_that_asks_for_keys_is_used_with_one(browser: Any, tmp_path: Path) -> None:
    key = add_key(tmp_path / "keys", "visitor", ["read", "translate", "plan"])
    with serving(tmp_path / "data", CQLTL_API_KEYS_FILE=str(tmp_path / "keys")) as guarded:
        context = browser.new_context(reduced_motion="reduce")
        page = context.new_page()
        page.goto(str(guarded.base_url))
        page.wait_for_selector("#key-form:not([hidden])")
        page.fill("#key", key)
        page.press("#key", "Enter")
        page.wait_for_selector("body[data-ready]")
        assert page.locator("#key-form").is_hidden()
        faster(page)
        command(page, SHIP)
        said(page, "Done: the task holds")
        shown = page.locator("#plan-curl pre").text_content()
        assert key not in shown
        assert "$CQLTL_API_KEY" in shown
        context.close()


def test_values_and_arrows_are_those_of_the_policy(visit: Open, site: httpx.Client) -> None:
    page = visit("toys-4x1-sphere")
    command(page, "Pickup the sphere")
    page.wait_for_selector("#values:not([disabled])")
    page.click("#restart")
    page.check("#values")
    page.check("#arrows")
    page.wait_for_selector(".arrow-sign")
    assert page.locator(".arrow-sign").all_text_contents() == ["→", "→", "→"]
    assert page.locator(".doing").all_text_contents() == ["pick"]
    assert page.locator(".value").all_text_contents() == ["4.0", "3.0", "2.0", "1.0"]


def test_a_world_without_a_map_is_listed_and_runs(visit: Open, site: httpx.Client) -> None:
    assert site.put("/environments/tiny", json=TINY | {"name": "tiny"}).status_code in (200, 201)
    assert site.post("/learn", json=LESSON).status_code in (200, 201)
    page = visit("tiny")
    assert page.locator("#world").inner_text() == "mdp state 0"
    faster(page)
    command(page, "Head for the end")
    said(page, "Done: the task holds")
    assert page.locator("#world").inner_text() == "mdp state 2"


def test_refusals_are_said_where_they_belong(visit: Open) -> None:
    page = visit()
    command(page, "Sing me a song about the sea")
    page.wait_for_selector("#command-problem:not([hidden])")
    assert "No known task fits" in page.locator("#command-problem").inner_text()


SPOTS = """async ([svg, state]) => {
    const { World } = await import('/static/world.js');
    const world = new World(document.createElement('div'), { onmove: {} });
    world.load(svg, state);
    return Object.fromEntries([...world.spots(state)].map(([name, spot]) => [name, [spot.x, spot.y, spot.scale]]));
}"""
LOADING = "Put the red parcel on the trolley, then put the trolley in the loading bay"


@pytest.mark.parametrize(("world", "text"), [("house", SHIP), ("warehouse", LOADING)])
def test_the_page_puts_things_where_the_pictures_have_them(
    visit: Open, site: httpx.Client, world: str, text: str
) -> None:
    page = visit(world)
    plan = site.post("/plan", json={"text": text, "environment": world}).json()
    for step in site.post(f"{plan['policy']['url']}/run", json={"seed": 1}).json()["steps"]:
        state = step["state"]
        svg = site.get(f"/environments/{world}/image", params={"state": json.dumps(state)}).text
        groups = [group for group in ElementTree.fromstring(svg).iter(f"{SVG}g") if group.get("data-object")]
        expected = {group.get("data-object"): place(group.get("transform") or "") for group in groups}
        found = page.evaluate(SPOTS, [svg, state])
        assert found.keys() == expected.keys()
        for name, spot in expected.items():
            assert found[name] == pytest.approx(spot, abs=0.01), (name, state)


def place(transform: str) -> tuple[float, float, float]:
    numbers = [float(number) for number in re.findall(r"-?\d+(?:\.\d+)?", transform)]
    return numbers[0], numbers[1], numbers[2] if len(numbers) > 2 else 1.0


def drag(page: Any, thing: str, cell: str) -> None:
    """With the mouse, from the middle of a thing to the middle of a cell."""
    page.locator("#world").scroll_into_view_if_needed()
    grip = page.locator(f"[data-object={thing}]").bounding_box()
    target = page.locator(f"[data-cell={cell}]").bounding_box()
    page.mouse.move(grip["x"] + grip["width"] / 2, grip["y"] + grip["height"] * 0.45)
    page.mouse.down()
    page.mouse.move(target["x"] + target["width"] / 2, target["y"] + target["height"] / 2, steps=5)
    page.mouse.up()

"""What was answered is kept: kill -9, restart, and two servers on one store."""

from __future__ import annotations

import sqlite3
import threading
from pathlib import Path

import httpx
import pytest

from benchmarks.server import address, serving, started
from models.world import toys_spec
from service.seeds import COMMON, NEW, READ, WORLDS
from tests.service.conftest import run_cli


def test_what_was_answered_survives_kill_dash_nine(tmp_path: Path) -> None:
    with started(tmp_path) as process:
        url = address(process)
        lesson = {"contextual_query": "hold(sphere)", "ltl": "F holding(sphere)", "environment": "toys"}
        world = {**toys_spec(columns=2, rows=1, toys=[("cube", "red")]), "name": "mine"}
        assert httpx.post(f"{url}/environments", json=world, timeout=60).status_code == 201
        plan = httpx.post(f"{url}/plan", json={"ltl": "F holding(cube)", "environment": "mine"}, timeout=60).json()
        gone = ("templates/pickup", "environments/navigation")
        assert [httpx.delete(f"{url}/{path}", timeout=60).status_code for path in gone] == [204, 204]
        template = httpx.post(f"{url}/learn", json=lesson, timeout=60)
        process.kill()  # right after the 201
    assert template.status_code == 201
    with serving(tmp_path) as client:
        assert client.get("/templates/hold").json() == template.json()
        assert [client.get(path).status_code for path in gone] == [404, 404]
        kept = client.get("/environments/mine").json()["spec"]
        assert client.put("/environments/mine", json=kept).json()["spec"] == kept
        assert {name: thing["class"] for name, thing in kept["objects"].items()} == {"box": "box", "cube": "toy"}
        step = client.post(f"{plan['policy']['url']}/step", json={"state": plan["initial"]["state"]}).json()
        assert step["action"] == plan["trajectory"][0]["action"]
        grounded = client.post("/ground", json={"contextual_query": "hold(cylinder)", "environment": "toys"})
        assert grounded.json()["ltl"] == "F holding(cylinder)"


def test_an_older_store_gets_what_is_new_and_keeps_its_own(tmp_path: Path) -> None:
    """The first tasks get their readings, the worlds their samples, the store the common tasks; what was deleted,
    changed or taught stays so.
    """
    with serving(tmp_path) as client:
        common = {task: client.get(f"/templates/{task}").json() for task in ("put_in", "bring")}
        for task in (*common, "switch_on"):
            assert client.delete(f"/templates/{task}").status_code == 204
        mine = {"contextual_query": "switch_on(oven)", "ltl": "G F running(oven)", "environment": "house"}
        assert client.post("/learn", json=mine).status_code == 201
        ship = client.get("/templates/ship").json()
        spec = {name: client.get(f"/environments/{name}").json()["spec"] for name in ("toys", "navigation")}
        plain = {
            name: {k: v for k, v in data.items() if k not in ("samples", "lessons")} for name, data in spec.items()
        }
        client.put("/environments/toys", json=plain["toys"])
        client.put("/environments/navigation", json={**plain["navigation"], "parameters": {"slip": 0.5}})
        for path in ("templates/pickup", *(f"environments/{n}" for n in (*NEW, "toys-4x1-sphere"))):
            assert client.delete(path).status_code == 204
    with sqlite3.connect(tmp_path / "cqltl.sqlite3") as store:
        store.execute("UPDATE templates SET reading = ''")
        store.execute("DELETE FROM facts WHERE name IN (?, ?, ?)", (READ, WORLDS, COMMON))
    store.close()
    with serving(tmp_path) as client:
        assert client.get("/templates/ship").json() == {**ship, "revision": ship["revision"] + 1}
        assert client.get("/templates/pickup").status_code == 404
        for task, known in common.items():
            assert client.get(f"/templates/{task}").json()["template"] == known["template"]
            assert len(client.get(f"/templates/{task}/examples").json()["items"]) >= 9
        assert client.get("/templates/switch_on").json()["template"] == "G F running($1)"
        listed = {item["name"]: item["samples"] for item in client.get("/environments").json()["items"]}
        assert set(listed) == {*NEW, "toys", "toys-4x1-cylinder", "navigation"}
        assert client.get("/environments/toys").json()["spec"] == spec["toys"]
        assert listed["navigation"] == [], "it was changed, so it stays as it is"


def test_two_servers_share_a_store(tmp_path: Path) -> None:
    """Both start on an empty folder at once; what one learns, the other knows at once."""
    with started(tmp_path) as one, started(tmp_path) as two:
        urls = address(one), address(two)
        codes: list[int] = []

        def teach(url: str, number: int) -> None:
            lesson = {
                "contextual_query": f"task{number}(sphere)",
                "ltl": "F holding(sphere)",
                "environment": "toys",
                "examples": [f"perform number {number} on the sphere"],
            }
            codes.append(httpx.post(f"{url}/learn", json=lesson, timeout=60).status_code)

        threads = [threading.Thread(target=teach, args=(urls[n % 2], n)) for n in range(16)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        assert codes == [201] * 16
        for url in urls:
            listed = httpx.get(f"{url}/templates", params={"limit": 200}, timeout=60).json()
            tasks = [item["task"] for item in listed["items"]]
            assert {f"task{n}" for n in range(16)} <= set(tasks)
            for number in range(16):
                body = {"text": f"perform number {number} on the cylinder", "environment": "toys"}
                answer = httpx.post(f"{url}/translate", json=body, timeout=60).json()
                assert answer["contextual_query"]["text"] == f"task{number}(cylinder)"


@pytest.mark.parametrize("setting", [("CQLTL_PORT", "high"), ("CQLTL_WORKERS", "0")])
def test_a_wrong_setting_is_named(tmp_path: Path, setting: tuple[str, str]) -> None:
    result = run_cli("serve", data=tmp_path, **dict([setting]))
    assert result.returncode == 2
    assert result.stderr.startswith(setting[0])
    assert not list(tmp_path.iterdir())

"""Two services that never met, with stores of their own, answer the same requests with the same bytes."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import httpx

from benchmarks.server import serving

SHIP = "Put the cylinder in the box, then put the box in the bedroom"
POSTS: list[tuple[str, dict[str, Any]]] = [
    ("/translate", {"text": SHIP}),
    ("/translate", {"text": SHIP, "environment": "toys", "candidates": 3}),
    ("/translate", {"text": "fetch the sphere and then go to the kitchen", "environment": "toys", "candidates": 5}),
    ("/translate", {"text": "go to the kitchen", "translator": "ltl-copynet", "environment": "navigation"}),
    ("/translate", {"text": "qwx zzy", "environment": "toys"}),
    ("/translate/batch", {"texts": [SHIP, "Pickup the sphere"], "environment": "toys"}),
    ("/ground", {"contextual_query": "pickup(any toy)", "environment": "toys"}),
    ("/explain", {"ltl": "F (at(robot, kitchen) & F at(robot, bedroom))", "environment": "toys"}),
    ("/plan", {"text": SHIP, "environment": "toys-4x1-cylinder"}),
    ("/plan", {"ltl": "G F at(robot, kitchen) & G F at(robot, bathroom)", "environment": "toys-4x1-sphere"}),
    ("/plan", {"ltl": "F holding(sphere", "environment": "toys"}),
    ("/learn", {"contextual_query": "store(sphere, box)", "ltl": "F in(sphere, box)", "environment": "toys"}),
]
GETS = ("/templates", "/environments", "/environments/toys", "/environments/toys/image", "/openapi.json")


def test_same_requests_same_bytes(tmp_path: Path) -> None:
    """Neither Python's order of hashes nor what was kept of earlier requests makes a difference."""
    folders = [tmp_path / name for name in ("one", "other")]
    with (
        serving(folders[0], PYTHONHASHSEED="1") as one,
        serving(
            folders[1], PYTHONHASHSEED="2", CQLTL_TRANSLATION_CACHE_BYTES="0", CQLTL_POLICY_CACHE_BYTES="0"
        ) as other,
    ):
        for path, body in [*POSTS, *POSTS]:
            first, second = (client.post(path, json=body, headers={"Prefer": "wait=60"}) for client in (one, other))
            assert first.status_code == second.status_code
            assert untimed(first) == untimed(second), (path, body)
        policies = [row["id"] for row in one.get("/policies").json()["items"]]
        assert len(policies) >= 2
        for path in (
            *GETS,
            "/policies",
            *(f"/policies/{key}{part}" for key in policies for part in ("", "/automaton")),
        ):
            assert one.get(path).content == other.get(path).content, path
        for policy in policies:
            for path, body in (("run", {"seed": 3}), ("simulate", {"runs": 50, "seed": 3})):
                first, second = (client.post(f"/policies/{policy}/{path}", json=body) for client in (one, other))
                assert first.content == second.content, (path, first.text)


def untimed(response: httpx.Response) -> bytes | str:
    """The answer, but for its `timing`."""
    said = response.json()
    if not isinstance(said, dict) or "timing" not in said:
        return response.content
    return json.dumps({name: value for name, value in said.items() if name != "timing"})

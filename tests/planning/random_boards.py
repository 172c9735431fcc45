"""Random worlds of dials that actions turn: some the formulas speak of, others that only may matter, or never do."""

from __future__ import annotations

import random
from collections.abc import Sequence
from typing import Any

import spot

from models.world import OomdpWorld, compile_world, load_environment

SPOKEN = ("one", "two")
SPARE = ("red", "blue", "green")


def board(actions: dict[str, Any], start: dict[str, str], *, values: Sequence[str] = ("off", "on")) -> OomdpWorld:
    """A world of dials; `a` and `b` say that `one` and `two` are turned up."""
    world = compile_world(
        load_environment(
            {
                "name": "board",
                "kind": "oomdp",
                "domain_spec": {
                    "name": "board",
                    "attributes": {"value": list(values)},
                    "classes": {"dial": {"state": {"at": "value"}}},
                    "constants": dict.fromkeys(start, "dial"),
                    "functions": {
                        "a": {"is": f"one.at == {values[-1]}"},
                        "b": {"is": f"{'two' if 'two' in start else 'one'}.at == {values[0]}"},
                    },
                    "actions": actions,
                },
                "objects": {},
                "state": {name: {"at": value} for name, value in start.items()},
            }
        )
    )
    assert isinstance(world, OomdpWorld)
    return world


def random_board(pick: random.Random) -> OomdpWorld:
    """Two dials that are spoken of, one to three others, and actions that turn either, with guards on all of them."""
    values = ["low", "mid", "high"][: pick.choice([2, 2, 3])]
    spare = SPARE[: pick.randint(1, 3)]
    dials = [*SPOKEN, *spare]

    def guard() -> str:
        chosen = pick.sample(dials, pick.choice([0, 0, 1, 1, 2]))
        return " and ".join(f"{d}.at {pick.choice(['==', '!='])} {pick.choice(values)}" for d in chosen) or "true"

    def turned(among: Sequence[str]) -> dict[str, str]:
        return {f"{d}.at": pick.choice(values) for d in pick.sample(among, pick.choice([1, 1, min(2, len(among))]))}

    def action(among: Sequence[str]) -> dict[str, Any]:
        made: dict[str, Any] = {"when": guard(), "cost": pick.choice([1, 1, 2, 0.5])}
        if pick.random() < 0.5:
            return {**made, "outcomes": [{"set": turned(among)}]}
        other = pick.choice([{}, {"set": turned(among)}])
        return {**made, "outcomes": [{"probability": 0.75, "set": turned(among)}, {"probability": 0.25, **other}]}

    actions = {f"turn_{i}": action(SPOKEN) for i in range(pick.randint(1, 4))}
    actions |= {f"fiddle_{i}": action(spare) for i in range(pick.randint(0, 4))}
    if pick.random() < 0.2:
        actions["rest"] = {"when": guard(), "outcomes": [{}]}
    return board(actions, {d: pick.choice(values) for d in dials}, values=values)


def random_formula(seed: int, pick: random.Random) -> str:
    """A formula of `randltl` over a and b."""
    drawn = spot.randltl(["a", "b"], 20, seed=seed, tree_size=pick.randint(3, 9), simplify=3)
    found = next((f for f in drawn if not f.is_boolean()), spot.formula("G F a"))
    return str(spot.unabbreviate(found, "^").to_str("spot", True))

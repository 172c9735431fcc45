"""`cqltl plan` for people: the world and the run as text, or as an animated GIF."""

from __future__ import annotations

import sys
from collections.abc import Mapping
from itertools import pairwise
from pathlib import Path
from typing import Any

from models.world import Environment, load_environment
from models.world.picture import MOST_CELLS, changes, picture, size_of, to_text, write_gif

MOST_STEPS = 40
"""Most steps of a run that are written out, and most frames of an animation."""


def show(answer: Mapping[str, Any], spec: Mapping[str, Any]) -> str:
    """What a plan does, in the world of the data: the map at its beginning and its end, and every step between."""
    environment = load_environment(spec)
    probability, steps = answer["probability"], answer["trajectory"]
    lines = [answer["ltl"], answer["explanation"], "", f"{answer['outcome']}: {_likely(probability)}"]
    if answer["outcome"] != "solved":
        return "\n".join([*lines, *(f"from here: {why['explanation']}" for why in answer.get("obstacles", []))])
    if answer["expected_steps"] is not None:
        lines[-1] += f", expected steps {answer['expected_steps']:.6g}"
    lines += ["", "at first:", to_text(environment, steps[0]["state"]), ""]
    for number, (one, two) in enumerate(pairwise(steps), start=1):
        if number > MOST_STEPS:
            lines.append(f"... and {len(steps) - 1 - MOST_STEPS} more")
            break
        lines.append(f"{number:3}. {one['action'] or 'wait'}: {changes(one['state'], two['state'])}")
    if answer["trajectory_loop"] is not None:
        lines.append(f"     and so on, from step {answer['trajectory_loop'] + 1}")
    if len(steps) > 1:
        lines += ["", "at the end of this run:", to_text(environment, steps[-1]["state"])]
    return "\n".join(lines)


def animate(answer: Mapping[str, Any], spec: Mapping[str, Any], path: Path) -> str | None:
    """Write the run of a plan as an animated GIF; why it could not be, or None."""
    steps = answer["trajectory"][: MOST_STEPS + 1]
    if not steps:
        return "there is no run to animate: the task cannot be done"
    environment = load_environment(spec)
    if size_of(environment) > MOST_CELLS:
        return f"the world has more than {MOST_CELLS} cells or things, too many for a picture"
    try:
        write_gif(path, [_frame(environment, steps, number) for number in range(len(steps))])
    except ImportError:
        return f"--gif needs Pillow: {sys.executable} -m pip install pillow"
    except OSError as error:
        return f"{path}: {error}"
    return None


def wants_text(chosen: str | None) -> bool:
    """Whether the answer is to be shown to a person: as chosen, else where standard output is a terminal."""
    return chosen == "text" or (chosen is None and sys.stdout.isatty())


def _frame(environment: Environment, steps: list[Mapping[str, Any]], number: int) -> Any:
    step = steps[number]
    caption = f"{number} of {len(steps) - 1}" + (f": {step['action']}" if step["action"] else "")
    return picture(environment, step["state"], run=[s["state"] for s in steps[: number + 1]], caption=caption)


def _likely(bounds: Mapping[str, float]) -> str:
    if bounds["upper"] - bounds["lower"] < 1e-5:
        return f"probability {bounds['lower']:.6g}"
    return f"probability between {bounds['lower']:.6g} and {bounds['upper']:.6g}"

"""Environments as the worker processes get them, as JSON text; the last few stay compiled."""

from __future__ import annotations

import json
from functools import lru_cache

from models.world import Environment, World, compile_world, load_environment


@lru_cache(maxsize=16)
def read_environment(text: str) -> Environment:
    """The environment of a JSON text."""
    return load_environment(json.loads(text))


@lru_cache(maxsize=4)
def read_world(text: str) -> World:
    """The compiled world of a JSON text."""
    return compile_world(read_environment(text))

"""What a new store is given: the built-in environments, and the paper's task classes learned from one example each."""

from __future__ import annotations

from importlib.resources import files
from typing import Any

import yaml

from models.world import builtin_environments
from service.lessons import Lesson, learn_template
from service.services import Services

FACT = "seeded"
"""Noted when seeding is complete, so that what a user deletes stays deleted."""


async def seed(services: Services) -> None:
    """Give a new store its built-in data; interrupted, it is taken up again at the next start."""
    with services.store.read() as transaction:
        if transaction.fact(FACT) is not None:
            return
    with services.store.write() as transaction:
        for name, data in builtin_environments():
            transaction.environments.put(name, data["kind"], data)
    for pair in _read()["templates"]:
        await learn_template(services, Lesson(pair["contextual_query"], pair["ltl"], pair["environment"], replace=True))
    with services.store.write() as transaction:
        if transaction.fact(FACT) is None:
            transaction.add_fact(FACT, "1")


def _read() -> dict[str, Any]:
    data: dict[str, Any] = yaml.safe_load((files("service") / "seeds.yaml").read_text(encoding="utf-8"))
    return data

"""What a new store is given: the built-in environments, and the paper's task classes learned from one example each."""

from __future__ import annotations

from contextlib import suppress
from importlib.resources import files
from typing import Any

import yaml

from models.errors import CqltlError
from models.queries import parse_task
from models.world import builtin_environments
from service.lessons import Lesson, learn_template
from service.services import Services

FACT = "seeded"
"""Noted when seeding is complete, so that what a user deletes stays deleted."""
TAUGHT = "seeds know what they were taught with"
"""Noted when the templates have the kinds of what they were learned with; stores of before 0.2 have not."""
READ = "seeds are read in English"
"""Noted when the templates have their readings; stores of before 0.3 have not."""
WORLDS = "worlds have samples"
"""Noted when the store was given the worlds of 0.3, and sample commands; stores of before have not."""
NEW = ("city", "house", "warehouse")
"""The worlds that came with 0.3. What else a store lacks of the built-in ones was deleted."""


async def seed(services: Services) -> None:
    """Give a new store its built-in data; interrupted, it is taken up again at the next start."""
    with services.store.read() as transaction:
        seeded, worlds, *complete = (transaction.fact(fact) is not None for fact in (FACT, WORLDS, TAUGHT, READ))
    if seeded:
        if not worlds:
            _add_worlds(services)
        if not all(complete):
            await _complete(services)
        return
    with services.store.write() as transaction:
        for name, data in builtin_environments():
            transaction.environments.put(name, data["kind"], data)
    for pair in _read()["templates"]:
        await learn_template(services, Lesson(pair["contextual_query"], pair["ltl"], pair["environment"], replace=True))
    with services.store.write() as transaction:
        for fact in (FACT, TAUGHT, READ, WORLDS):
            if transaction.fact(fact) is None:
                transaction.add_fact(fact, "1")


def _add_worlds(services: Services) -> None:
    """Store the new worlds, and the samples of those that are as they were."""
    with services.store.write() as transaction:
        for name, data in builtin_environments():
            known = transaction.environments.find(name)
            plain = {member: value for member, value in data.items() if member not in ("samples", "lessons")}
            if (known is None and name in NEW) or (known is not None and known.data == plain):
                transaction.environments.put(name, data["kind"], data)
        transaction.add_fact(WORLDS, "1")


async def _complete(services: Services) -> None:
    """Learn the seeds again that are still there, which adds what their templates lack and changes nothing else."""
    for pair in _read()["templates"]:
        with services.store.read() as transaction:
            known = transaction.templates.find(parse_task(pair["contextual_query"]).task)
        if known is not None:
            with suppress(CqltlError):  # it was replaced, or its environment was: then it is not the seed any more
                await learn_template(services, Lesson(pair["contextual_query"], pair["ltl"], pair["environment"]))
    with services.store.write() as transaction:
        for fact in (TAUGHT, READ):
            if transaction.fact(fact) is None:
                transaction.add_fact(fact, "1")


def _read() -> dict[str, Any]:
    data: dict[str, Any] = yaml.safe_load((files("service") / "seeds.yaml").read_text(encoding="utf-8"))
    return data

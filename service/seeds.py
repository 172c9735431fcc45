"""What a new store is given: the built-in environments, the paper's task classes learned from one example each, and
common tasks of these environments.
"""

from __future__ import annotations

from contextlib import suppress
from dataclasses import replace
from importlib.resources import files
from typing import Literal

from models.data import read_yaml
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
COMMON = "common tasks"
"""Noted when the store was given the tasks that the paper has not; stores of before 0.4 were not."""
NEW = ("city", "house", "warehouse")
"""The worlds that came with 0.3. What else a store lacks of the built-in ones was deleted."""


async def seed(services: Services) -> None:
    """Give a new store its built-in data, and an older one what is new; interrupted, it is taken up again at the next
    start.
    """
    with services.store.read() as transaction:
        seeded, worlds, common, *complete = (
            transaction.fact(fact) is not None for fact in (FACT, WORLDS, COMMON, TAUGHT, READ)
        )
    if not seeded:
        await _begin(services)
    else:
        if not worlds:
            _add_worlds(services)
        if not all(complete):
            await _complete(services)
    if not common:
        await _add_common(services)


async def _begin(services: Services) -> None:
    with services.store.write() as transaction:
        for name, data in builtin_environments():
            transaction.environments.put(name, data["kind"], data)
    for lesson in seeds("paper"):
        await learn_template(services, replace(lesson, replace=True))
    _note(services, FACT, TAUGHT, READ, WORLDS)


async def _add_common(services: Services) -> None:
    """Learn the common tasks that the store does not know; what a user taught by such a name stays."""
    for lesson in seeds("common"):
        with services.store.read() as transaction:
            known = transaction.templates.find(parse_task(lesson.query).task)
        if known is None:
            with suppress(CqltlError):  # its environment was replaced or deleted
                await learn_template(services, lesson)
    _note(services, COMMON)


def _add_worlds(services: Services) -> None:
    """Store the new worlds, and the samples of those that are as they were."""
    with services.store.write() as transaction:
        for name, data in builtin_environments():
            known = transaction.environments.find(name)
            plain = {member: value for member, value in data.items() if member not in ("samples", "lessons")}
            if (known is None and name in NEW) or (known is not None and known.data == plain):
                transaction.environments.put(name, data["kind"], data)
    _note(services, WORLDS)


async def _complete(services: Services) -> None:
    """Learn the seeds again that are still there, which adds what their templates lack and changes nothing else."""
    for lesson in seeds("paper"):
        with services.store.read() as transaction:
            known = transaction.templates.find(parse_task(lesson.query).task)
        if known is not None:
            with suppress(CqltlError):  # it was replaced, or its environment was: then it is not the seed any more
                await learn_template(services, lesson)
    _note(services, TAUGHT, READ)


def _note(services: Services, *facts: str) -> None:
    with services.store.write() as transaction:
        for fact in facts:
            if transaction.fact(fact) is None:
                transaction.add_fact(fact, "1")


def seeds(group: Literal["paper", "common"]) -> list[Lesson]:
    """The lessons of a group in `seeds.yaml`."""
    data = read_yaml((files("service") / "seeds.yaml").read_text(encoding="utf-8"))
    return [
        Lesson(
            seed["contextual_query"],
            seed["ltl"],
            seed["environment"],
            examples=tuple(seed.get("examples", ())),
            explanation=seed.get("explanation"),
        )
        for seed in data[group]
    ]

"""Reads the files of task classes."""

from __future__ import annotations

import re
from dataclasses import dataclass
from functools import cache
from importlib.resources import files

from pydantic import BaseModel, ConfigDict, Field

from models.errors import Place
from models.language.dataset.corpus import load_yaml
from models.language.errors import VocabularyError

_SLOT = re.compile(r"\{(\d)\}")


@dataclass(frozen=True, slots=True)
class TaskClass:
    """A task class of a world.

    Attributes:
        names: for each argument, what it may be called.
        means: what is so once it is done, in English.
        wordings: how people ask for it. Here as in `means`, `{1}` stands for the first argument.
    """

    world: str
    task: str
    names: tuple[tuple[str, ...], ...]
    means: str
    wordings: tuple[str, ...]


class _Class(BaseModel):
    model_config = ConfigDict(extra="forbid", strict=True, frozen=True)
    task: str
    arguments: list[str] = Field(max_length=3)
    means: str
    wordings: list[str] = Field(min_length=10)


class _World(BaseModel):
    model_config = ConfigDict(extra="forbid", strict=True, frozen=True)
    world: str
    kinds: dict[str, list[str]]
    classes: list[_Class]


@cache
def task_classes() -> tuple[TaskClass, ...]:
    """All classes, in order of world; raises VocabularyError for a wording without an argument of its class."""
    folder = files("models.language.dataset.tasks")
    names = sorted(entry.name for entry in folder.iterdir() if entry.name.endswith(".yaml"))
    worlds = [load_yaml((folder / name).read_text(encoding="utf-8"), _World) for name in names]
    return tuple(_read(world, entry) for world in worlds for entry in world.classes)


def _read(world: _World, entry: _Class) -> TaskClass:
    wanted = {str(number) for number in range(1, len(entry.arguments) + 1)}
    for wording in entry.wordings:
        if set(_SLOT.findall(wording)) != wanted:
            detail = f"{world.world}: the wording {wording!r} does not have the arguments of {entry.task}"
            raise VocabularyError(detail, places=[Place("/classes", detail)])
    names = tuple(tuple(world.kinds[kind]) for kind in entry.arguments)
    return TaskClass(world.world, entry.task, names, entry.means, tuple(entry.wordings))

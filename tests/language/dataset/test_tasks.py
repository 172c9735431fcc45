"""The task classes that the matching network learns from, and those by which it is measured."""

from __future__ import annotations

import re
from importlib.resources import files
from itertools import chain

import yaml

from models.language.dataset.tasks import task_classes
from models.language.tokens import words

SLOT = re.compile(r"\{\d\}")


def skeleton(wording: str) -> tuple[str, ...]:
    """The words of a wording, with every slot alike."""
    return words(SLOT.sub(" thing ", wording))


def measured() -> set[tuple[str, ...]]:
    folder = files("models.language.dataset") / "teaching"
    parts = [yaml.safe_load(file.read_text(encoding="utf-8")) for file in folder.iterdir() if "-" in file.name]
    tasks = list(chain.from_iterable(part["tasks"] for part in parts if "tasks" in part))
    assert len(tasks) == 48
    return {skeleton(wording) for task in tasks for wording in task["wordings"]}


def test_classes_are_many_and_each_is_said_in_many_ways() -> None:
    classes = task_classes()
    assert len({(task.world, task.task) for task in classes}) == len(classes)
    for task in classes:
        slots = {f"{{{number}}}" for number in range(1, len(task.names) + 1)}
        assert len({skeleton(wording) for wording in task.wordings}) == len(task.wordings) >= 10, task.task
        for text in (task.means, *task.wordings):
            assert set(SLOT.findall(text)) == slots, (task.world, task.task, text)


def test_no_wording_is_one_by_which_teaching_is_measured() -> None:
    taught = {skeleton(wording) for task in task_classes() for wording in task.wordings}
    assert not taught & measured()

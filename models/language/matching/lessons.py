"""What the matching network learns from: task classes of many worlds, each said in many ways of many things."""

from __future__ import annotations

import random
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from models.language.dataset import Domain, paraphrases, read_corpus
from models.language.dataset.tasks import TaskClass
from models.language.spans.names import names
from models.language.spans.tags import Span
from models.language.tokens import words

DRAWS, CARDS = 2, 2
"""Texts drawn of each wording, and of each card."""
NAMES = 24
"""Names drawn for each argument of a class of the paper."""
EVENTUALLY = 0.5
"""Part of the cards that speak as explanations of formulas do."""
_SLOT = re.compile(r"(\{\d\})")
_ARTICLE = re.compile(r"\b(the|a|an) ")


@dataclass(frozen=True, slots=True)
class Said:
    """Folded words, and for each argument of the task the first range of words that mentions it; `every` are all."""

    words: tuple[str, ...]
    mentions: tuple[Span, ...]
    every: tuple[Span, ...]


@dataclass(frozen=True, slots=True)
class Lesson:
    """A task class: for each wording some texts, and some of its card, which is what a task has without examples."""

    world: str
    task: str
    wordings: tuple[tuple[Said, ...], ...]
    cards: tuple[Said, ...]


def lesson(task: TaskClass, generator: random.Random) -> Lesson:
    """The texts of a class, with things drawn by their names."""
    wordings = [tuple(_said(text, _draw(task, generator)) for _ in range(DRAWS)) for text in task.wordings]
    cards = [
        _said(text, _draw(task, generator)) for _ in range(CARDS) for text in (_meaning(task, generator), _call(task))
    ]
    return Lesson(task.world, task.task, tuple(wordings), tuple(cards))


def _meaning(task: TaskClass, generator: random.Random) -> str:
    """What the task brings about, as people say it or as a formula is explained: "eventually {1} is in {2}"."""
    if generator.random() < EVENTUALLY:
        return f"eventually {_ARTICLE.sub('', task.means)}"
    return task.means


def _call(task: TaskClass) -> str:
    """The name of the task before its arguments: "admit {1} {2}"."""
    slots = " ".join(f"{{{number}}}" for number in range(1, len(task.names) + 1))
    return f"{task.task.replace('_', ' ')} {slots}"


def _draw(task: TaskClass, generator: random.Random) -> list[str]:
    """A name for each argument, different ones where there are enough."""
    chosen: list[str] = []
    for called in task.names:
        left = [name for name in called if name not in chosen] or list(called)
        chosen.append(generator.choice(left))
    return chosen


def _said(text: str, names: Sequence[str]) -> Said:
    said: list[str] = []
    spans: list[tuple[int, Span]] = []
    for part in _SLOT.split(text):
        if _SLOT.fullmatch(part):
            argument = int(part[1]) - 1
            phrase = words(names[argument])
            spans.append((argument, (len(said), len(said) + len(phrase))))
            said += phrase
        else:
            said += words(part)
    first = dict(reversed(spans))
    return Said(tuple(said), tuple(first[place] for place in range(len(names))), tuple(span for _, span in spans))


def texts_of(lessons: Sequence[Lesson]) -> Iterator[Said]:
    """Every text of some classes."""
    for entry in lessons:
        for group in (*entry.wordings, entry.cards):
            yield from group


def paper_classes(generator: random.Random) -> list[TaskClass]:
    """The paper's task classes with all wordings that training has of them, as classes of two worlds more."""
    found = []
    for domain in Domain:
        further = paraphrases(domain, "training")
        for task in read_corpus(domain).tasks:
            slots = {f"{{{slot}}}": f"{{{number}}}" for number, slot in enumerate(task.arguments, start=1)}
            wordings = [_numbered(text, slots) for text in dict.fromkeys((*task.wordings, *further[task.name]))]
            drawn = tuple(
                tuple(" ".join(names().draw(slot, generator)) for _ in range(NAMES)) for slot in task.arguments
            )
            call = " ".join([task.name.replace("_", " "), *slots.values()])
            found.append(TaskClass(domain, task.name, drawn, call, tuple(wordings)))
    return found


def _numbered(text: str, slots: Mapping[str, str]) -> str:
    for name, number in slots.items():
        text = text.replace(name, number)
    return text


def without_task(text: str) -> Said:
    """A text that asks for nothing."""
    return Said(tuple(words(text)), (), ())

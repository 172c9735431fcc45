"""How readings from several sources weigh against each other: taught ones, near ones, and those of the networks."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import replace

from models.language.reading import AMBIGUOUS, GROUNDED, SENSELESS, Reading
from models.language.translation import Translation
from models.queries import Composition, ContextualQuery, Operator

DOUBTED = 0.3
"""What is left of the probability of a composition around one taught task."""
MEANT = 0.55
"""Share of a task that is near to a text that seems to forbid something; the rest is to forbid it."""
AROUND = 0.5
"""Probability of the compositions around a task from which it is not taken for the whole."""


def doubted(heard: Translation, near: Sequence[Translation], own: Collection[str] = ()) -> Translation:
    """A composition around one taught task is rather a task in other words: "no lamp should be left on". Not if the
    whole text is nearest to that one: then it says something of it, "don't put it in the box"; nor around one of the
    networks' `own` tasks.
    """
    tasks = [task.task for _, task in heard.query.tasks]
    if isinstance(heard.query, ContextualQuery) or len(tasks) > 1 or tasks[0] in own:
        return heard
    if near and tasks == [task.task for _, task in near[0].query.tasks]:
        return heard
    return replace(heard, confidence=DOUBTED * heard.confidence)


def parted(near: Translation, heard: Sequence[Translation], own: Collection[str] = ()) -> Translation:
    """A task that is probably a clause of what was heard is hardly all that the text says, the less where it is
    forbidden; nor is one of the same things as a clause that is the networks' `own`, or of what several such clauses
    name: whoever says "pick up the cup, then go to the kitchen" says more than to bring it there.
    """
    said = {task.task for _, task in near.query.tasks}
    things = {task.arguments for _, task in near.query.tasks}
    named = _words(near)
    around = sum(
        translation.confidence
        for translation in heard
        if isinstance(translation.query, Composition)
        and (
            any(t.task in said or (t.task in own and t.arguments in things) for _, t in translation.query.tasks)
            or _says_all(translation, named, own)
        )
    )
    return replace(near, confidence=DOUBTED * near.confidence) if around >= AROUND else near


def _says_all(heard: Translation, named: Collection[str], own: Collection[str]) -> bool:
    """Whether several clauses that the networks know speak of all that is named."""
    tasks = [task.task for _, task in heard.query.tasks]
    return len(tasks) > 1 and all(task in own for task in tasks) and _words(heard).issuperset(named)


def _words(said: Translation) -> set[str]:
    return {word for _, task in said.query.tasks for phrase in task.arguments for word in phrase.split()}


def forbidden_too(near: Sequence[Translation]) -> tuple[Translation, ...]:
    """What is near to a text that seems to forbid something: nearly as likely it is that which is forbidden, so that it
    has to be asked: "the ball must never get into the crate". To be near tells not which: "do not let it dry out".
    """
    avoided = [Translation(Composition(Operator.AVOID, (t.query,)), (1 - MEANT) * t.confidence) for t in near]
    return (*(replace(said, confidence=MEANT * said.confidence) for said in near), *avoided)


def merged(taught: Sequence[Reading], learned: Sequence[Reading]) -> tuple[Reading, ...]:
    """The taught readings that make sense, then the others; just the learned ones where only those do.

    A taught reading that takes a word for misspelt makes less sense than a learned one that takes all as said.
    """
    best = learned[0].weight if learned else SENSELESS
    least = AMBIGUOUS if best == GROUNDED else SENSELESS
    fitting = [reading for reading in taught if reading.weight >= least and reading.weight > SENSELESS]
    if not fitting and best > SENSELESS:
        return tuple(learned)
    first = _shared(fitting or taught)
    known = {reading.query for reading in first}
    rest = [replace(r, confidence=0.0) if first else r for r in learned if r.query not in known]
    return (*first, *rest)


def _shared(readings: Sequence[Reading]) -> list[Reading]:
    """The readings with confidences that add up to 1; those of no confidence share it when nothing else is left."""
    total = sum(reading.confidence for reading in readings)
    return [replace(r, confidence=r.confidence / total if total else 1 / len(readings)) for r in readings]

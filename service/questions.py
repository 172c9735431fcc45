"""Asking back: what a command leaves open as one question with choices, and readings with a question answered."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Literal

from models.errors import Place
from models.language.contraries import contrary
from models.language.tokens import words
from models.language.unsayable import unsayable
from models.queries import (
    AmbiguousGroundingError,
    ContextualQuery,
)
from models.world import Environment, Symbol, UnknownObjectError, speaks_of_others
from service.errors import AnswerError
from service.filling import filled, reread, task_at, things_for
from service.taught import Taught
from service.understanding import Understanding

CLOSE = 0.6
"""A reading that is as probable as this part of the likeliest may be meant as well."""
DOUBTFUL = 0.25
"""A reading that is less probable than this is asked about, whatever else may be meant."""
DOUBTFUL_NEAR = 0.5
"""The same for a task that was taught with examples: where as many commands say tasks that nobody taught as such that
somebody did, what is near with less is wrong more often than right (`benchmarks.teaching --untaught`).
"""


@dataclass(frozen=True, slots=True)
class Question:
    """What to ask back. `about` is `thing` (which thing an argument names) or `reading` (which query was meant).

    `part` points to the task of the argument within the query, `argument` is its position from 1; both are of no
    account for readings. `says` tells in English what each of the choices is, in their order.
    """

    about: Literal["thing", "reading"]
    text: str
    choices: tuple[str, ...]
    says: tuple[str, ...]
    part: str = ""
    argument: int | None = None


@dataclass(frozen=True, slots=True)
class Answer:
    """One of the choices of a question, or None for none of them; `part` and `argument` as in the question."""

    choice: str | None
    part: str = ""
    argument: int | None = None


def question_of(
    text: str, readings: Sequence[Understanding], taught: Taught, environment: Environment | None
) -> Question | None:
    """What has to be asked before the readings of a text, best first, can be acted on; None when nothing is open.

    Asked is, in this order: which of the things that a phrase fits, or which thing is called by an unknown word where
    all other arguments are known; whether the best is meant where the text says something else that means nothing here,
    or more than a query can; and which of the readings is meant, when another is nearly as probable or the best is
    improbable itself.
    """
    if not readings or environment is None:
        return None
    best = readings[0]
    if isinstance(best.refusal, AmbiguousGroundingError):
        return _which(best.refusal, environment)
    if isinstance(best.refusal, UnknownObjectError):
        return _called(best, best.refusal, taught, environment)
    return _confirmation(text, best, taught, environment) or _either(readings, taught, environment)


def left_out(completions: Sequence[Understanding], environment: Environment) -> Question:
    """Which of the readings is meant that fill the gap of a command."""
    choices = tuple(str(reading.query) for reading in completions)
    says = tuple(reading.meaning.explanation(environment) for reading in completions if reading.meaning is not None)
    return Question("reading", "something is left out; which of these is meant?", choices, says)


def answered(
    text: str,
    readings: Sequence[Understanding],
    answers: Sequence[Answer],
    taught: Taught,
    environment: Environment | None,
    *,
    first: Question | None = None,
) -> tuple[Understanding, ...]:
    """The reading that is left when the questions are answered one after the other, the `first` of which may be given;
    none after an answer that none of the choices is right.

    Raises:
        AnswerError: an answer is not one to the question that is asked then; the place names it.
    """
    left = tuple(readings)
    for number, answer in enumerate(answers):
        question = first if first is not None and number == 0 else question_of(text, left, taught, environment)
        if question is None:
            raise _wrong(number, "", "nothing is asked here")
        if answer.choice is None:
            left = ()
            continue
        if answer.choice not in question.choices:
            raise _wrong(number, "/choice", f'"{answer.choice}" is none of the choices: {", ".join(question.choices)}')
        if question.about == "reading":
            left = tuple(replace(r, confidence=1.0) for r in left if str(r.query) == answer.choice)
            continue
        if (answer.part, answer.argument) != (question.part, question.argument):
            raise _wrong(number, "/argument", f'asked is argument {question.argument} of the part "{question.part}"')
        query = left[0].query
        assert query is not None
        named = filled(query, answer.part, answer.argument or 0, answer.choice)
        left = (reread(text, replace(left[0], query=named), taught, environment),)
    return left


def _which(refusal: AmbiguousGroundingError, environment: Environment) -> Question:
    return Question(
        "thing",
        f"which {refusal.phrase}?",
        refusal.choices,
        tuple(_description(candidate.symbol, environment) for candidate in refusal.candidates),
        refusal.places[0].pointer.rpartition("/arguments/")[0] if refusal.places else "",
        refusal.position,
    )


def _called(
    reading: Understanding, refusal: UnknownObjectError, taught: Taught, environment: Environment
) -> Question | None:
    """What an unknown word means, if any thing in its place makes sense of the reading."""
    part, found, place = refusal.places[0].pointer.rpartition("/arguments/") if refusal.places else ("", "", "")
    task = task_at(reading.query, part) if found and reading.query is not None else None
    template = None if task is None else taught.template(task.task)
    if task is None or template is None or reading.query is None:
        return None
    argument = int(place) + 1
    if speaks_of_others(task.arguments[argument - 1], environment):
        return None  # every word is known; there is just no such thing
    choices, says = [], []
    for symbol in things_for(template, argument, environment):
        named = replace(reading, query=filled(reading.query, part, argument, symbol.name))
        if reread(task.arguments[argument - 1], named, taught, environment).meaning is not None:
            choices.append(symbol.name)
            says.append(_description(symbol, environment))
    if not choices:
        return None
    return Question("thing", f'what is "{task.arguments[argument - 1]}"?', tuple(choices), tuple(says), part, argument)


def _confirmation(text: str, best: Understanding, taught: Taught, environment: Environment) -> Question | None:
    """Whether a reading that is not certain is meant in place of what the words say and what means nothing here, though
    they say the contrary of a task, or without what the text says besides and no query can: how often, how long, when,
    or under which condition. An utterance that a task was taught with may.
    """
    if best.query is None or best.meaning is None or best.confidence >= 1.0:
        return None
    if best.instead_of is not None:
        return _meant(best.instead_of.detail, best, environment)
    spoken = words(text)
    for _, task in best.query.tasks:
        if (against := contrary(spoken, task, taught.wordings.own_words.get(task.task, ()))) is not None:
            return _meant(f'"{against[0]}" is the contrary of "{against[1]}"', best, environment)
    passed_over = unsayable(text, best.query)
    stored = [taught.stored[task.task] for _, task in best.query.tasks if task.task in taught.stored]
    said = (example.text for template in stored for example in template.examples)
    if passed_over is None or any(unsayable(example, best.query) == passed_over for example in said):
        return None
    return _meant(f'"{passed_over}" is not understood', best, environment)


def _meant(doubt: str, best: Understanding, environment: Environment) -> Question:
    assert best.meaning is not None
    says = best.meaning.explanation(environment)
    return Question("reading", f"{doubt}; do you mean: {says}?", (str(best.query),), (says,))


def _either(readings: Sequence[Understanding], taught: Taught, environment: Environment) -> Question | None:
    """Which of the readings that are nearly as probable as the first and mean something else; or whether any of the
    readings that make sense is meant, where the first is hardly probable.
    """
    best = readings[0]
    if best.meaning is None:
        return None
    doubtful = best.confidence < _least(best, taught)
    meant = {best.meaning.formula: (best.query, best.meaning)}
    for reading in readings[1:]:
        if reading.meaning is not None and (doubtful or reading.confidence >= CLOSE * best.confidence > 0):
            meant.setdefault(reading.meaning.formula, (reading.query, reading.meaning))
    if any(query is None for query, _ in meant.values()) or (len(meant) < 2 and not doubtful):
        return None
    says = tuple(meaning.explanation(environment) for _, meaning in meant.values())
    if len(set(says)) < 2 and not doubtful:
        return None
    choices = tuple(str(query) for query, _ in meant.values())
    return Question("reading", f"do you mean: {'; or: '.join(says)}?", choices, says)


def _least(reading: Understanding, taught: Taught) -> float:
    """The probability from which a reading is not asked about."""
    query = reading.query
    stored = taught.stored.get(query.task) if isinstance(query, ContextualQuery) else None
    return DOUBTFUL if stored is None or not stored.examples else DOUBTFUL_NEAR


def _description(symbol: Symbol, environment: Environment) -> str:
    """The name, the class, and what never changes of it: "cylinder: a toy, red, small"."""
    is_object = environment.vocabulary.is_object
    static = environment.vocabulary.static.get(symbol, {}).values()
    values = [value.name for value in static if value.name != symbol.name and not is_object(value)]
    article = "an" if symbol.kind[0] in "aeiou" else "a"
    return ", ".join([f"{symbol.name}: {article} {symbol.kind}", *values]).replace("_", " ")


def _wrong(number: int, member: str, detail: str) -> AnswerError:
    return AnswerError(detail, places=[Place(f"/answers/{number}{member}", detail)])

"""An utterance of a task: its words, and where they mention the arguments.

Where an argument is mentioned can be marked: `{1}` stands for the first argument of the query, `{1: the old radio}` for
it in other words. Without marks, the words of each argument are looked for.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, replace

from models.errors import CqltlError, Place
from models.language.tokens import check_length, words
from models.queries import ContextualQuery

DETERMINERS = frozenset({"the", "teh", "a", "an", "this", "that", "my", "your"})
"""Not part of the phrase that they stand before; "teh" is how "the" comes out in haste."""
Span = tuple[int, int]
"""A half-open range of the words of a text."""
_MARK = re.compile(r"\{\s*(\d{1,2})\s*(?::([^{}]*))?\}")


class ExampleArgumentNotFoundError(CqltlError):
    """An utterance does not contain the words of an argument of its query."""

    slug = "example-argument-not-found"


class ExampleMarkError(CqltlError):
    """A mark of an utterance is no mark of an argument of its query."""

    slug = "example-mark"


@dataclass(frozen=True, slots=True)
class Utterance:
    """Folded words, the query that they say, and for each of its arguments the ranges of words that mention it, left to
    right; a determiner belongs to no mention.
    """

    words: tuple[str, ...]
    query: ContextualQuery
    mentions: tuple[tuple[Span, ...], ...]

    @classmethod
    def of(cls, text: str, query: ContextualQuery) -> Utterance:
        """Read a text with or without marks. Marks may name an argument in other words than the query does: then the
        utterance says the query with these.

        Raises:
            ExampleArgumentNotFoundError: an argument's words do not stand in the text, or no mark has its number.
            ExampleMarkError: a mark has no argument's number, holds no word, or says an argument in two ways.
            TextTooLongError: the text is beyond the limits of a command.
        """
        check_length(text)
        return _marked(text, query) if "{" in text else _searched(text, query)

    @property
    def mentioned(self) -> frozenset[int]:
        """The places of the words that mention arguments."""
        return frozenset(place for spans in self.mentions for begin, end in spans for place in range(begin, end))


def is_marked(text: str) -> bool:
    """Whether a text has marks, or tries to."""
    return "{" in text


def _marked(text: str, query: ContextualQuery) -> Utterance:
    said: list[str] = []
    phrases: list[tuple[str, ...] | None] = [None] * len(query.arguments)
    mentions: list[list[Span]] = [[] for _ in phrases]
    at = 0
    for mark in _MARK.finditer(text):
        said += words(text[at : mark.start()])
        at, number = mark.end(), int(mark[1])
        if not 1 <= number <= len(phrases):
            raise _wrong_mark(f"the mark {mark[0]} names no argument: {query.task} has {len(phrases)}")
        phrase = plain(words(query.arguments[number - 1] if mark[2] is None else mark[2]))
        if not phrase:
            raise _wrong_mark(f"the mark {mark[0]} holds no word")
        if phrases[number - 1] not in (None, phrase):
            raise _wrong_mark(f"the mark {mark[0]} says argument {number} in other words than an earlier one")
        phrases[number - 1] = phrase
        mentions[number - 1].append((len(said), len(said) + len(phrase)))
        said += phrase
    rest = text[at:]
    if "{" in rest or "}" in _MARK.sub("", text):
        raise _wrong_mark('marks are written "{1}" or "{1: words}"')
    said += words(rest)
    arguments = []
    for position, named in enumerate(phrases, start=1):
        if named is None:
            raise _not_found(f"no mark {{{position}}} says where argument {position} of {query.task} is mentioned")
        arguments.append(" ".join(named))
    return Utterance(tuple(said), replace(query, arguments=tuple(arguments)), tuple(map(tuple, mentions)))


def _searched(text: str, query: ContextualQuery) -> Utterance:
    """Longer arguments are found first, each wherever it stands."""
    said = words(text)
    phrases = [plain(words(argument)) for argument in query.arguments]
    taken: set[int] = set()
    mentions: list[tuple[Span, ...]] = [()] * len(phrases)
    for slot in sorted(range(len(phrases)), key=lambda index: -len(phrases[index])):
        mentions[slot] = tuple(_places(said, phrases[slot], taken))
        if not mentions[slot]:
            raise _not_found(
                f'the utterance does not contain argument {slot + 1} of {query.task}, "{query.arguments[slot]}"'
            )
    return Utterance(said, query, tuple(mentions))


def _places(said: Sequence[str], phrase: Sequence[str], taken: set[int]) -> list[Span]:
    """Where a phrase stands in words that are not taken; they are taken then."""
    found, at = [], 0
    while phrase and at + len(phrase) <= len(said):
        here = range(at, at + len(phrase))
        if tuple(said[at : at + len(phrase)]) == tuple(phrase) and taken.isdisjoint(here):
            taken.update(here)
            found.append((at, at + len(phrase)))
            at += len(phrase)
        else:
            at += 1
    return found


def plain(phrase: tuple[str, ...]) -> tuple[str, ...]:
    """The phrase without its determiner; a determiner alone stays."""
    return phrase[1:] if len(phrase) > 1 and phrase[0] in DETERMINERS else phrase


def _not_found(detail: str) -> ExampleArgumentNotFoundError:
    return ExampleArgumentNotFoundError(detail, places=[Place("", detail)])


def _wrong_mark(detail: str) -> ExampleMarkError:
    return ExampleMarkError(detail, places=[Place("", detail)])

"""Finds the arguments of an utterance by what its words name in an environment."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import islice

from models.errors import Place
from models.language.teaching.utterance import ExampleArgumentNotFoundError, Span
from models.language.teaching.wording import CONNECTIVES
from models.language.tokens import words
from models.queries import ContextualQuery, Template
from models.world import Environment, ground
from models.world.mentions import NO_EDGE

MAX_PHRASE_WORDS = 6
"""Longest phrase that is looked for."""


def find_arguments(text: str, template: Template, environment: Environment) -> ContextualQuery:
    """The query that a text says whose words name things of the environment: each parameter takes the one phrase that
    fits it, of several the longest.

    Raises:
        ExampleArgumentNotFoundError: no phrase fits a parameter, more phrases fit than there are parameters, or they
            could be taken in more than one order.
        TextTooLongError: the text is beyond the limits of a command.
    """
    said = words(text)
    wanted = template.taught or template.kinds
    phrases = {span: _fitting(said[slice(*span)], wanted, environment) for span in _spans(said)}
    named = _longest([span for span, fits in phrases.items() if fits])
    ways = []
    if len(named) == len(wanted):
        ways = list(islice(_orders([phrases[span] for span in named]), 2))
    if len(ways) != 1:
        raise _refusal(said, named, template.task, len(wanted), bool(ways))
    return ContextualQuery(template.task, tuple(" ".join(said[slice(*named[place])]) for place in ways[0]))


def _orders(fits: Sequence[frozenset[int]]) -> Iterator[tuple[int, ...]]:
    """Every way to give each parameter a phrase of its own that fits it: the phrase's number for each parameter."""

    def extend(order: tuple[int, ...]) -> Iterator[tuple[int, ...]]:
        if len(order) == len(fits):
            yield order
            return
        for number, places in enumerate(fits):
            if number not in order and len(order) in places:
                yield from extend((*order, number))

    return extend(())


def _spans(said: Sequence[str]) -> Iterator[Span]:
    """The ranges of words that may be phrases."""
    for begin in range(len(said)):
        for end in range(begin + 1, min(begin + MAX_PHRASE_WORDS, len(said)) + 1):
            if said[begin] not in NO_EDGE and said[end - 1] not in NO_EDGE and CONNECTIVES.isdisjoint(said[begin:end]):
                yield begin, end


def _fitting(phrase: Sequence[str], wanted: Sequence[frozenset[str]], environment: Environment) -> frozenset[int]:
    """The parameters that a phrase fits, as it is spelled."""
    said = " ".join(phrase)
    return frozenset(
        place
        for place, kinds in enumerate(wanted)
        if any(found.misspelt is None for found in ground(said, environment, kinds=kinds).candidates)
    )


def _longest(spans: Sequence[Span]) -> list[Span]:
    """The spans that lie in no other one, left to right."""
    return sorted(span for span in spans if not any(_within(span, other) for other in spans))


def _within(one: Span, other: Span) -> bool:
    return one != other and other[0] <= one[0] and one[1] <= other[1]


def _refusal(
    said: Sequence[str], named: Sequence[Span], task: str, arity: int, several: bool
) -> ExampleArgumentNotFoundError:
    found = ", ".join(f'"{" ".join(said[slice(*span)])}"' for span in named) or "nothing"
    why = "which names which argument cannot be told" if several else f"{task} has {arity}"
    detail = (
        f"the arguments of {task} cannot be found in the utterance: it names {found}, and {why}; "
        'mark them, as in "put the {1: ball} in the {2: box}"'
    )
    return ExampleArgumentNotFoundError(detail, places=[Place("", detail)])

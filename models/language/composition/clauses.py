"""From the clauses of a text to queries: what is left out of a clause, and whom "it" means, is found in the others."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import combinations, islice, product
from math import prod
from typing import Protocol

from models.language.composition.shapes import ONE_CLAUSE
from models.language.teaching.utterance import DETERMINERS
from models.language.tokens import find, is_mark
from models.language.translation import Translation
from models.queries import ContextualQuery


class Understand(Protocol):
    """What a clause may say, by its text."""

    def __call__(self, text: str, /) -> Sequence[Translation]:
        """The readings of a clause, best first."""

    def prepare(self, texts: Iterable[str], /) -> None:
        """Read several at once; they will be asked for."""


PRONOUNS = frozenset({"it", "them", "that", "this", "one", "him", "her", "both"})
PLACE_PRONOUNS = frozenset({"there", "here"})
GOING = ("go", "to", "the")
"""What is said of a place when nothing is: "the bakery, then the zoo"."""
JOINING = frozenset({"either", "both", "and", "or", "then", "first", "but"})
"""Words in front of all clauses that are no part of their verb."""
LIKELIER = 0.75
"""Share of the first of two ways to complete a clause, or to read a pronoun; the environment may turn it round."""
SHARES: Mapping[int, Sequence[float]] = {0: (), 1: (1.0,), 2: (LIKELIER, 1 - LIKELIER), 3: (0.5, 0.25, 0.25)}
"""The same where there are so many ways."""
LED = 0.8
"""Probability that a bare clause and the words before it are one task, from which it is read so."""
VERBS = (3, 2)
"""Words of a verb and what belongs to it, of more that stand before a clause: "before you", "go to"."""
ALTERNATIVES = 4
"""Readings of one clause that are looked at."""
MOST = 12
"""Ways to read all clauses together that are looked at."""
UNLIKE = 0.25
"""Factor for two clauses of the same verb that are read as unlike tasks, though each may be the other's: whoever says
"between bay 3 and bay 7" speaks of two places or of two things.
"""


@dataclass(frozen=True, slots=True)
class Clause:
    """One clause: its number in the shape, its words, whether it is avoided or awaited, whether it is a task that is
    said in several clauses, and the words between the clause before and it.
    """

    number: int
    words: tuple[str, ...]
    forbidden: bool
    several: bool = False
    lead: tuple[str, ...] = ()


def readings(
    clauses: Sequence[Clause], understand: Understand, *, before: Sequence[str] = ()
) -> Iterator[tuple[dict[int, ContextualQuery], float]]:
    """Ways to read the clauses (in the order of the text) together, with their probabilities; best first within a
    clause. None where a clause cannot be understood. `before` are the words in front of the first clause.
    """
    understand.prepare(" ".join(clause.words) for clause in clauses)
    spoken = {clause.number: _spoken(clause, understand) for clause in clauses}
    if any(clause.several and not spoken[clause.number] for clause in clauses):
        return  # what is no task in several clauses is no name either
    whole = {clause.number for clause in clauses if not is_bare(clause.words, spoken[clause.number])}
    led = {
        clause.number: found
        for clause in clauses
        if clause.number not in whole and (found := _led(clause, understand)) is not None
    }
    whole.update(led)
    spoken.update({number: said for number, (_, said) in led.items()})
    clauses = [replace(each, words=led[each.number][0]) if each.number in led else each for each in clauses]
    texts = {
        clause.number: _completions(clause, _donor(clauses, place, whole), spoken, before)
        for place, clause in enumerate(clauses)
        if clause.number not in whole
    }
    understand.prepare(text for carried, going in texts.values() for text in (*carried, going))
    options = [
        list(spoken[clause.number][:ALTERNATIVES])
        if clause.number in whole
        else _completed(clause, texts[clause.number], understand)
        for clause in clauses
    ]
    verbs = [_verb(clause, _donor(clauses, place, whole), whole, spoken) for place, clause in enumerate(clauses)]
    for chosen, likely in _together(options, verbs):
        for queries, share in _resolved(list(zip(clauses, chosen, strict=True))):
            yield queries, likely * share


def _spoken(clause: Clause, understand: Understand) -> Sequence[Translation]:
    """What a clause may say by itself."""
    said = understand(" ".join(clause.words))
    if not clause.several:
        return said
    return [one for one in said if not any(task.task in ONE_CLAUSE for _, task in one.query.tasks)]


def is_bare(words: Sequence[str], said: Sequence[Translation]) -> bool:
    """Whether a clause only names things: its words are those of its arguments, or it says nothing that is known."""
    if not said:
        return True
    return not _besides(words, _task(said[0]))


def are_commands(clauses: Sequence[Clause], understand: Understand) -> bool:
    """Whether each clause says by itself what to do, and with what."""
    texts = [" ".join(clause.words) for clause in clauses]
    understand.prepare(texts)
    return not any(is_bare(clause.words, understand(text)) for clause, text in zip(clauses, texts, strict=True))


def _led(clause: Clause, understand: Understand) -> tuple[tuple[str, ...], Sequence[Translation]] | None:
    """A bare clause with the words before it that are its verb, and what that says: "then go to", "the attic"."""
    lead = tuple(word for word in clause.lead if word not in JOINING)
    if clause.forbidden or not lead:
        return None
    texts = list(dict.fromkeys((*lead[-length:], *clause.words) for length in (len(lead), *VERBS)))
    understand.prepare(" ".join(text) for text in texts)
    for text in texts:
        said = understand(" ".join(text))
        if sum(translation.confidence for translation in said) >= LED and not is_bare(text, said):
            return text, said
    return None


def _donor(clauses: Sequence[Clause], place: int, whole: set[int]) -> Clause | None:
    """The clause whose verb is meant: the nearest one before, or the first after."""
    before = [clause for clause in clauses[:place] if clause.number in whole]
    after = [clause for clause in clauses[place + 1 :] if clause.number in whole]
    return before[-1] if before else after[0] if after else None


def _verb(
    clause: Clause, donor: Clause | None, whole: set[int], spoken: Mapping[int, Sequence[Translation]]
) -> tuple[str, ...]:
    """The words with which a clause says what to do; another's where it has none, none where no clause has any."""
    own = clause if clause.number in whole else donor
    if own is None or not spoken[own.number]:
        return ()
    return _besides(own.words, _task(spoken[own.number][0]))


def _besides(words: Sequence[str], query: ContextualQuery) -> tuple[str, ...]:
    """The words that name none of the things of a query."""
    named = {word for phrase in query.arguments for word in phrase.split()}
    return tuple(word for word in words if word not in named and word not in DETERMINERS and not is_mark(word))


def _together(
    options: Sequence[Sequence[Translation]], verbs: Sequence[tuple[str, ...]]
) -> list[tuple[tuple[Translation, ...], float]]:
    """The likeliest ways to read all clauses with their probabilities, which add up to what they would if the clauses
    had nothing to do with each other.
    """
    alike = [pair for pair in combinations(range(len(verbs)), 2) if verbs[pair[0]] == verbs[pair[1]]]
    may = [{_task(translation).task for translation in option} for option in options]
    found: list[tuple[tuple[Translation, ...], float]] = []
    total = 0.0
    for chosen in islice(product(*options), 4 * MOST):
        likely = prod(translation.confidence for translation in chosen)
        tasks = [_task(translation).task for translation in chosen]
        unlike = [tasks[i] != tasks[j] and tasks[i] in may[j] and tasks[j] in may[i] for i, j in alike]
        total += likely
        found.append((chosen, likely * UNLIKE ** sum(unlike)))
    scale = total / (sum(likely for _, likely in found) or 1.0)
    ranked = sorted(found, key=lambda reading: -reading[1])[:MOST]
    return [(chosen, likely * scale) for chosen, likely in ranked]


def _task(translation: Translation) -> ContextualQuery:
    """What a clause says, which is one task."""
    assert isinstance(translation.query, ContextualQuery)
    return translation.query


def _completions(
    clause: Clause, donor: Clause | None, spoken: Mapping[int, Sequence[Translation]], before: Sequence[str]
) -> tuple[tuple[str, ...], str]:
    """The texts of a bare clause with what another says of its names, or with the verb in front of all; and the clause
    as a place to go to.
    """
    words = clause.words[1:] if clause.words[0] in DETERMINERS else clause.words
    going = " ".join((*GOING, *words))
    verb = [word for word in before if word not in JOINING]
    if donor is not None:
        carried = _carried(donor, spoken[donor.number][0], words)
        if verb and len(carried) > 1:  # "put the orange or the ball in the box": the donor has no verb either
            carried = (*(" ".join((*verb, text)) for text in carried), *carried)
        return carried, going
    return () if clause.forbidden or not verb else (" ".join((*verb, "the", *words)),), going


def _completed(clause: Clause, texts: tuple[tuple[str, ...], str], understand: Understand) -> list[Translation]:
    """What a bare clause says, completed in one way or another."""
    carried = [list(said)[:ALTERNATIVES] for text in texts[0] if (said := understand(text))][:2]
    going = list(understand(texts[1]))[:ALTERNATIVES]
    ways = [way for way in ([going, *carried] if clause.forbidden else [*carried, going]) if way]
    found: dict[ContextualQuery, float] = {}
    for way, share in zip(ways, SHARES[len(ways)], strict=True):
        for translation in way:
            query = _task(translation)
            found[query] = found.get(query, 0.0) + share * translation.confidence
    return [Translation(query, min(1.0, share)) for query, share in found.items()]


def _carried(donor: Clause, said: Translation, words: Sequence[str]) -> tuple[str, ...]:
    """The donor's text with other words for its arguments where these stand together; else, where it is one clause, for
    the first, and for the last: "put the ball in the box", "the cup" or "the bag".
    """
    text, arguments = donor.words, _task(said).arguments
    spans = sorted(
        (at, at + len(phrase.split())) for phrase in arguments if (at := find(phrase.split(), text)) is not None
    )
    if not spans or len(spans) != len(arguments):
        return ()
    begin, end = spans[0][0], max(end for _, end in spans)
    covered = {place for start, stop in spans for place in range(start, stop)}
    apart = any(place not in covered and text[place] not in DETERMINERS for place in range(begin, end))
    if apart and donor.several:
        return ()
    replaced = [spans[0], spans[-1]] if apart else [(begin, end)]
    return tuple(" ".join((*text[:start], *words, *text[stop:])) for start, stop in replaced)


def _resolved(chosen: Sequence[tuple[Clause, Translation]]) -> Iterator[tuple[dict[int, ContextualQuery], float]]:
    """The queries by number, with what pronouns stand for; the likeliest first."""
    options: list[tuple[dict[int, ContextualQuery], float, tuple[str, ...], tuple[str, ...]]] = [({}, 1.0, (), ())]
    for clause, translation in chosen:
        query = _task(translation)
        grown = []
        for queries, share, things, places in options:
            for arguments, part in _replaced(query.arguments, things, places):
                made = ContextualQuery(query.task, arguments)
                focus, named = _focus(clause, arguments), tuple(a for a in arguments[::-1] if a not in places)
                if clause.forbidden:  # "don't go to the lab until you have been there" is not about the lab
                    said = ((*things, *focus), (*places, *named))
                else:
                    said = ((*focus, *things), (*named, *places))
                grown.append(({**queries, clause.number: made}, share * part, *said))
        options = sorted(grown, key=lambda option: -option[1])[:4]
    for queries, share, _, _ in options:
        yield queries, share


def _focus(clause: Clause, arguments: Sequence[str]) -> tuple[str, ...]:
    """What a clause is about, as it was said: of `pickup_colored(ball, red)` the red ball."""
    said = " ".join(clause.words)
    described = (f"{other} {arguments[0]}" for other in arguments[1:])
    return tuple([phrase for phrase in described if phrase in said][:1] or arguments[:1])


def _replaced(
    arguments: Sequence[str], things: Sequence[str], places: Sequence[str]
) -> Iterator[tuple[tuple[str, ...], float]]:
    """Arguments with pronouns replaced by what was named before (nearest first); none if nothing was."""
    choices: list[list[tuple[str, float]]] = []
    for argument in arguments:
        kind = things if argument in PRONOUNS else places if argument in PLACE_PRONOUNS else None
        if kind is None:
            choices.append([(argument, 1.0)])
        else:
            known = list(dict.fromkeys([*kind, *things, *places]))[:2]
            weights = [LIKELIER, 1 - LIKELIER] if len(known) == 2 else [1.0]
            choices.append(list(zip(known, weights, strict=False)))
    for chosen in product(*choices):
        yield tuple(argument for argument, _ in chosen), prod(share for _, share in chosen)

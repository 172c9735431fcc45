"""Phrases of a command to the symbols of an environment: one, several with why, or none.

A phrase is tried in six ways, and the first that finds something decides:

1. it is the name of a symbol, or a synonym of one ("cylinder", "the H&M", "orange");
2. the same, but for a plural ("the cylinders");
3. it compares things on an ordered attribute ("the smaller of the two boxes", "the biggest red toy in the kitchen");
4. it says how a thing stands to another one, as things are now ("the toy in the box", "the lamp in the red room");
5. it describes objects: a head noun (the end of a name or synonym, the class, "one") with attribute values and
   further words of the name in any order ("the small red bucket", "toy that is red", "red");
6. one word is misspelt by one letter, or a space is wrong, and the phrase so corrected is one of the above ("sphree").

Kinds narrow all six. What means something of another kind as it stands is no misspelling: with a cart and a card at
hand, "card" is never read as "cart". Where kinds leave both a value and an object with the name, the part of speech
decides: an adjective is a value, a noun an object.

A phrase that is no name and begins with a quantifier ("any", "every", "both of") speaks of all the objects that what
follows can mean: those of the name, and those of the description, but for an exception ("all rooms but the hall").
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import wraps
from typing import Literal

from models.world.degrees import DISTANCE, Degree
from models.world.description import FILLERS, GENERIC, Candidate, Kinds, anything, described, named
from models.world.environment import Environment
from models.world.limits import MAX_RELATED
from models.world.names import singular
from models.world.phrase_index import WHATEVER, Words
from models.world.quantifiers import Quantifier, counted, excepted, quantified
from models.world.vocabulary import Symbol, Vocabulary

PartOfSpeech = Literal["noun", "adjective"]
_LONGEST = 20  # words
_Read = Callable[[Words, Kinds | None], list[Candidate]]
"""A way to take words by their letters."""
_Figures = Callable[[Words, Kinds | None], Iterable[list[Candidate]]]


@dataclass(frozen=True, slots=True)
class Grounding:
    """What a phrase may mean, in the environment's order of symbols: with the quantifier `ONE` one of the candidates is
    meant, with `ANY` whichever of them, with `ALL` every one of them.
    """

    phrase: str
    candidates: tuple[Candidate, ...]
    quantifier: Quantifier = Quantifier.ONE


def ground(
    phrase: str,
    environment: Environment,
    *,
    kinds: Kinds | None = None,
    pos: PartOfSpeech | None = None,
) -> Grounding:
    """The symbols, of the given kinds if any, that a phrase may mean; none of a phrase of more than 20 words."""
    reader = _Reader(environment)
    said = quantified(phrase)
    whole = (*said.before, *said.rest)
    if not whole or len(whole) > _LONGEST:
        return Grounding(phrase, ())
    if said.quantifier is not Quantifier.ONE:
        if reader.named(whole, None):  # "All Saints"
            return Grounding(phrase, _decided(reader.named(whole, kinds), environment.vocabulary, pos))
        rest, exception = excepted(said.rest)
        found = reader.every(rest, kinds)
        if exception:
            left_out = reader.excluded(exception)
            found = [candidate for candidate in found if candidate.symbol not in left_out] if left_out else []
        return _number_kept(phrase, found, said.quantifier, said.number)
    return Grounding(phrase, _decided(reader.one(whole, kinds), environment.vocabulary, pos))


def speaks_of_others(phrase: str, environment: Environment) -> bool:
    """Whether a phrase is more than a name or a description: it speaks of several things, compares things, or says how
    one stands to another.
    """
    said, vocabulary = quantified(phrase), environment.vocabulary
    return (
        said.quantifier is not Quantifier.ONE
        or any(vocabulary.comparing(said.rest))
        or any(vocabulary.relations.splits(said.rest))
    )


def _number_kept(phrase: str, found: Sequence[Candidate], quantifier: Quantifier, number: int | None) -> Grounding:
    """All that was found; of "both boxes" nothing where there is one box, and a doubt where there are three."""
    if quantifier is Quantifier.ALL and number is not None and number != len(found):
        return Grounding(phrase, tuple(found) if len(found) > number else ())
    return Grounding(phrase, tuple(found), quantifier)


def _decided(found: list[Candidate], vocabulary: Vocabulary, pos: PartOfSpeech | None) -> tuple[Candidate, ...]:
    values = [candidate for candidate in found if not vocabulary.is_object(candidate.symbol)]
    objects = [candidate for candidate in found if vocabulary.is_object(candidate.symbol)]
    if pos == "adjective" and values:
        return tuple(values)
    if pos == "noun" and objects:
        return tuple(objects)
    return (*objects, *values)


def _remembering(read: Callable[[_Reader, Words, Kinds | None], list[Candidate]]) -> Callable[..., list[Candidate]]:
    """What was read once is not read again: a phrase is part of others, in many ways."""

    @wraps(read)
    def remembered(reader: _Reader, said: Words, kinds: Kinds | None) -> list[Candidate]:
        key = (read.__name__, said, kinds)
        if key not in reader.memory:
            reader.memory[key] = read(reader, said, kinds)
        return reader.memory[key]

    return remembered


class _Reader:
    """Reads phrases in one environment."""

    def __init__(self, environment: Environment) -> None:
        self._environment = environment
        self._vocabulary = environment.vocabulary
        self.memory: dict[tuple[str, Words, Kinds | None], list[Candidate]] = {}

    def one(self, said: Words, kinds: Kinds | None) -> list[Candidate]:
        """What a phrase without quantifier may mean."""
        return self._spelled(self._one, said, kinds)

    def excluded(self, said: Words) -> set[Symbol]:
        """What an exception may mean, of whatever kind: "the hall and any red one"; none where a part means nothing."""
        found: set[Symbol] = set()
        for part in re.split(r" (?:and|or|nor) ", " ".join(said)):
            meant = quantified(part)
            read = self.one if meant.quantifier is Quantifier.ONE else self.every
            candidates = read(meant.rest, None)
            if not candidates:
                return set()
            found.update(candidate.symbol for candidate in candidates)
        return found

    def every(self, said: Words, kinds: Kinds | None) -> list[Candidate]:
        """All objects that a phrase can mean."""
        return self._spelled(self._every, said, kinds)

    def named(self, said: Words, kinds: Kinds | None) -> list[Candidate]:
        """The symbols of that name."""
        return named(said, self._vocabulary, kinds)

    def _spelled(self, read: _Read, said: Words, kinds: Kinds | None) -> list[Candidate]:
        """What the words mean as they stand; where that is nothing at all, with a typing mistake put right."""
        if (found := read(said, kinds)) or (kinds is not None and read(said, None)):
            return found
        return self._corrected(read, said, kinds)

    @_remembering
    def _one(self, said: Words, kinds: Kinds | None) -> list[Candidate]:
        ways = (self.named, self._compared, self._related, self._described)
        return next((found for read in ways if (found := read(said, kinds))), [])

    @_remembering
    def _every(self, said: Words, kinds: Kinds | None) -> list[Candidate]:
        if _is_generic(said):
            known = [] if WHATEVER in said else self._described(said, kinds)
            return self._objects(known or anything(self._environment, kinds))
        ways = (self._compared, self._every_related, self._described)
        more = next((found for read in ways if (found := read(said, kinds))), [])
        return self._objects(self._ordered([*self.named(said, kinds), *more]))

    def _described(self, said: Words, kinds: Kinds | None) -> list[Candidate]:
        return described(said, self._environment, kinds)

    @_remembering
    def _compared(self, said: Words, kinds: Kinds | None) -> list[Candidate]:
        """Those of the things said that come first or last on the scale of a word that compares."""
        for place, length, degrees in self._vocabulary.comparing(said):
            if self._vocabulary.relations.mentioned(said[:place]):
                return []  # "the toy in the smaller box" compares no toys
            rest = (*said[:place], *_of_what(said[place + length :]))
            things = self._every(rest or (WHATEVER,), kinds)
            found = [each for degree in degrees for each in self._extreme(things, degree, said[place : place + length])]
            if found:
                return self._ordered(found)
        return []

    def _extreme(self, things: Sequence[Candidate], degree: Degree, said: Words) -> list[Candidate]:
        """The things furthest in a direction; with a comparative, those beyond another. All where all are alike."""
        ranks = {each.symbol: self._rank(each.symbol, degree) for each in things}
        placed = {symbol: rank for symbol, rank in ranks.items() if rank is not None}
        if not placed:
            return []
        first, last = min(placed.values()), max(placed.values())
        least = last if degree.superlative or first == last else first + 1
        meant = {symbol for symbol, rank in placed.items() if rank >= least}
        word = " ".join(said)
        return [replace(each, reason=f"{each.reason}, the {word}") for each in things if each.symbol in meant]

    def _rank(self, symbol: Symbol, degree: Degree) -> int | None:
        """How far an object's value is in the direction of a degree; None for one without."""
        if degree.kind == DISTANCE:
            distance = self._environment.situation.distance(symbol)
            return None if distance is None else degree.direction * distance
        facts = (self._vocabulary.static.get(symbol, {}), self._environment.situation.values(symbol))
        values = (value for attributes in facts for value in attributes.values() if value.kind == degree.kind)
        value = next(values, None)
        return None if value is None else degree.direction * self._vocabulary.scales[degree.kind].ranks[value.name]

    @_remembering
    def _related(self, said: Words, kinds: Kinds | None) -> list[Candidate]:
        """The things that stand to another thing as the words say."""
        return self._standing(said, kinds, self._figures)

    def _every_related(self, said: Words, kinds: Kinds | None) -> list[Candidate]:
        return self._standing(said, kinds, lambda figure, kinds: (self._every(figure, kinds),))

    def _standing(self, said: Words, kinds: Kinds | None, figures_of: _Figures) -> list[Candidate]:
        relations, situation = self._vocabulary.relations, self._environment.situation
        for split in relations.splits(said):
            if any(self._vocabulary.comparing(split.figure)):
                continue  # "the smallest box in the kitchen" is the smallest of those there
            holds = relations.test(split.relation, situation)
            for grounds in self._grounds(split.ground):
                for figures in figures_of(split.figure, kinds):
                    if found := _those_that(holds, figures, grounds, split.relation):
                        return found
        return []

    def _figures(self, figure: Words, kinds: Kinds | None) -> Iterator[list[Candidate]]:
        """What is sought: a thing of that name, else of that description."""
        yield self._objects(self.named(figure, kinds))
        yield self._related(figure, kinds)
        yield self._objects(self._described(figure, kinds))
        if _is_generic(figure):
            yield anything(self._environment, kinds)

    def _grounds(self, ground: Words) -> Iterator[list[Candidate]]:
        """What it stands to: the thing of that name; else, or of "a box", whatever can be called so."""
        said = quantified(" ".join(ground))
        if said.quantifier is Quantifier.ONE and ground[0] not in ("a", "an"):
            yield self._objects(self._one(said.rest, None))
        yield self._every(counted(said.rest)[0], None)

    def _objects(self, found: Iterable[Candidate]) -> list[Candidate]:
        return [each for each in found if self._vocabulary.is_object(each.symbol)]

    def _corrected(self, read: _Read, said: Words, kinds: Kinds | None) -> list[Candidate]:
        """What the words mean with one typing mistake put right, in every way that makes sense."""
        found: dict[Symbol, Candidate] = {}
        for correction in self._vocabulary.phrases.corrections(said):
            if correction.wrong not in FILLERS | GENERIC:
                for candidate in read(correction.spoken, kinds):
                    reason = f'{candidate.reason}, reading "{correction.wrong}" as "{correction.meant}"'
                    found.setdefault(candidate.symbol, replace(candidate, reason=reason, misspelt=correction.wrong))
        return self._ordered(found.values())

    def _ordered(self, found: Iterable[Candidate]) -> list[Candidate]:
        """The candidates in the environment's order, each symbol once, as it was found first."""
        by_symbol: dict[Symbol, Candidate] = {}
        for candidate in found:
            by_symbol.setdefault(candidate.symbol, candidate)
        if len(by_symbol) < 2:
            return list(by_symbol.values())
        return [by_symbol[symbol] for symbol in self._vocabulary.symbols() if symbol in by_symbol]


def _is_generic(said: Words) -> bool:
    """Whether the words say nothing of a thing: "one", "objects"."""
    content = [singular(word) for word in said if word not in FILLERS]
    return bool(content) and GENERIC.issuperset(content)


def _of_what(said: Words) -> Words:
    """The words after one that compares, without what only leads to the things: "of the two boxes" -> "boxes"."""
    if said[:2] == ("one", "of"):
        said = said[1:]
    return counted(said[1:])[0] if said[:1] == ("of",) and len(said) > 1 else said


def _those_that(
    holds: Callable[[Symbol, Symbol], bool], figures: Sequence[Candidate], grounds: Sequence[Candidate], relation: Words
) -> list[Candidate]:
    """The figures that stand to one of the grounds at least, with that one as a further reason."""
    if len(figures) * len(grounds) > MAX_RELATED:
        return []
    found = []
    for figure in figures:
        ground = next((each.symbol for each in grounds if holds(figure.symbol, each.symbol)), None)
        if ground is not None:
            found.append(replace(figure, reason=f"{figure.reason}, {' '.join(relation)} {ground.name}"))
    return found

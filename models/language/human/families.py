"""The rule behind a family of formulas, learned from some of its lengths: `F & a F b`, `F & a F & b F c`, and so on.

A rule is a row of parts: words, or a block of words that is said `n + c` times for a formula of length n, about one
proposition after the other. It is found by looking for repeated blocks, and must say every known formula of the family;
of several rules the one with the fewest words is taken (minimum description length, Rissanen 1978). Nothing in it is
about particular families.

Words are operators, or propositions by number from 0. The length of a family is how many propositions a formula has,
or how often it counts the only one.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cache

Word = str | int
MOST_LOOPS = 2
LONGEST_BLOCK = 16


@dataclass(frozen=True, slots=True)
class Place:
    """A proposition of a rule: number `offset` from the first, from the last, or from the one that a turn is about."""

    origin: str  # "first", "last" or "turn"
    offset: int

    def at(self, length: int, turn: int) -> int:
        """Which proposition it is in a formula with `length` of them, in a block's turn number `turn` from 0."""
        return {"first": 0, "last": length - 1, "turn": turn}[self.origin] + self.offset


Pattern = tuple[str | Place, ...]


@dataclass(frozen=True, slots=True)
class Part:
    """Words that are said once (`extra` is None), or in `length + extra` turns."""

    words: Pattern
    extra: int | None = None

    def said(self, length: int, propositions: int) -> Iterator[Word]:
        """The words in a formula of a length with so many propositions."""
        for turn in range(1 if self.extra is None else length + self.extra):
            for word in self.words:
                yield word if isinstance(word, str) else word.at(propositions, turn)


@dataclass(frozen=True, slots=True)
class Rule:
    """What every formula of a family is made of."""

    parts: tuple[Part, ...]

    @property
    def size(self) -> int:
        """Its words, and one for each repetition."""
        return sum(len(part.words) + (part.extra is not None) for part in self.parts)

    def formula(self, length: int, propositions: int) -> tuple[Word, ...] | None:
        """The formula of a length; None when it would be about propositions that there are not."""
        if any(part.extra is not None and length + part.extra < 0 for part in self.parts):
            return None
        words = tuple(word for part in self.parts for word in part.said(length, propositions))
        fits = all(isinstance(word, str) or 0 <= word < propositions for word in words)
        return words if fits else None


@dataclass(frozen=True, slots=True)
class Known:
    """A formula of a family, of a length, about some number of propositions."""

    length: int
    propositions: int
    words: tuple[Word, ...]


def infer(known: Sequence[Known]) -> Rule | None:
    """The shortest rule that says all of these formulas; None without a rule that repeats anything.

    Of rules that are as short, one that counts propositions from the last is preferred: a family's last proposition is
    more often special than its third.
    """
    formulas = sorted(known, key=lambda one: -one.length)
    single = len({one.length for one in known}) == 1  # only its own repetition speaks for a rule, and little of it
    loops = 1 if single else MOST_LOOPS
    starts = [0] * len(formulas)
    rules = [Rule(parts) for origin in ("last", "first") for parts in _rows(formulas, starts, origin, loops)]
    repeating = [
        rule for rule in rules if any(part.extra is not None for part in rule.parts) and _goes_on(rule, formulas[0])
    ]
    if single:
        repeating = [rule for rule in repeating if rule.size < len(formulas[0].words)]
    return min(repeating, key=lambda rule: (rule.size, len(rule.parts)), default=None)


def _goes_on(rule: Rule, longest: Known) -> bool:
    """Whether a rule says the length after the longest, with one proposition more unless it counts the only one."""
    counting = longest.propositions < longest.length
    return rule.formula(longest.length + 1, longest.propositions + (not counting)) is not None


def _rows(known: Sequence[Known], at: Sequence[int], origin: str, loops: int) -> Iterator[tuple[Part, ...]]:
    """The rows of parts, with some blocks, that say what is left of every formula from the places `at` on.

    The parts are those of the first formula, the longest. Outside of blocks, propositions are counted from `origin`.
    """
    longest, start = known[0], at[0]
    rest = Part(_placed(longest.words[start:], longest, origin))
    if _after(rest, known, at) == [len(one.words) for one in known]:
        yield (rest,) if rest.words else ()
    if loops == 0:
        return
    for begin in range(start, len(longest.words)):
        before = Part(_placed(longest.words[start:begin], longest, origin))
        reached = _after(before, known, at)
        if reached is None:
            return
        for block, turns in _blocks(longest.words, begin):
            loop = Part(block, turns - longest.length)
            after = _after(loop, known, reached)
            if after is not None:
                row = (before, loop) if begin > start else (loop,)
                yield from ((*row, *others) for others in _rows(known, after, origin, loops - 1))


def _after(part: Part, known: Sequence[Known], at: Sequence[int]) -> list[int] | None:
    """Where each formula goes on after a part that begins at these places; None when one does not say it there."""
    places = []
    for one, place in zip(known, at, strict=True):
        said = tuple(part.said(one.length, one.propositions))
        if one.words[place : place + len(said)] != said or (part.extra is not None and one.length + part.extra < 0):
            return None
        places.append(place + len(said))
    return places


def _blocks(words: tuple[Word, ...], begin: int) -> Iterator[tuple[Pattern, int]]:
    """Blocks from a place on: what they say, and how many turns there are.

    The turns are as many as there are, as a rule that stopped earlier would have to say the rest again.
    """
    for size in range(1, min(LONGEST_BLOCK, len(words) - begin) + 1):
        for moving in (True, False):
            block = _block(words[begin : begin + size], moving=moving)
            if block is None:
                continue
            turns = 1
            while _turn(block, turns) == words[begin + turns * size : begin + (turns + 1) * size]:
                turns += 1
            yield block, turns


@cache
def _block(words: tuple[Word, ...], *, moving: bool) -> Pattern | None:
    """The words as a block: its propositions move on by one in each turn, or stay. None with nothing to move."""
    if moving and all(isinstance(word, str) for word in words):
        return None
    origin = "turn" if moving else "first"
    return tuple(word if isinstance(word, str) else Place(origin, word) for word in words)


def _turn(block: Pattern, turn: int) -> tuple[Word, ...]:
    return tuple(word if isinstance(word, str) else word.at(0, turn) for word in block)


def _placed(words: Sequence[Word], known: Known, origin: str) -> Pattern:
    shift = known.propositions - 1 if origin == "last" else 0
    return tuple(word if isinstance(word, str) else Place(origin, word - shift) for word in words)


def numbered(formula: str, propositions: Sequence[str]) -> tuple[Word, ...]:
    """The words of a prefix formula, with propositions by number in the order of `propositions`."""
    numbers: Mapping[str, int] = {name: number for number, name in enumerate(dict.fromkeys(propositions))}
    return tuple(numbers.get(word, word) for word in formula.split())


def named(words: Sequence[Word], propositions: Sequence[str]) -> str:
    """The inverse of `numbered`."""
    return " ".join(word if isinstance(word, str) else propositions[word] for word in words)

"""Lang2LTL's commands about waypoints: a family of formulas, and the waypoints or the count that make it one of them.

A family is learned as a task class, apart from the order of the waypoints; the formula of a length comes from the rule
of its family (`families`), so that a command may have a formula that no training command had.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from itertools import pairwise

from models.language.human.data import Utterance
from models.language.human.environment import Environment, Sentence
from models.language.human.families import Known, Rule, Word, infer, named, numbered
from models.language.human.lifting import Lifted
from models.language.tokens import words

NUMBERS = (
    ("three", "third", "thrice"),
    ("two", "second", "twice"),
    ("four", "fourth"),
    ("five", "fifth"),
    ("six", "sixth"),
    ("one", "once", "single"),
)
VALUES = {"three": 3, "two": 2, "four": 4, "five": 5, "six": 6, "one": 1}
LETTERS = {"a": "bakery", "b": "museum", "c": "library", "d": "school", "h": "park"}
"""The propositions of the data, and what waypoints are called where they are renamed."""
COMMUTATIVE = ("&", "|")
BINARY = (*COMMUTATIVE, "U", "W", "R", "M", "i", "e")
UNARY = ("!", "F", "G", "X")


@cache
def waypoints() -> Environment:
    """The letters, and the words that count."""
    places = {letter: (words(name), (letter,)) for letter, name in LETTERS.items()}
    counts = {forms[0]: tuple((form,) for form in forms) for forms in NUMBERS}
    return Environment({"place": places, "number": counts})


def letters(sentence: Sentence) -> list[str]:
    """The waypoints of a sentence, in the order of mention."""
    return [thing for thing in dict.fromkeys(name.thing for name in sentence.names) if thing in LETTERS]


def count(sentence: Sentence) -> int:
    """The last number of a sentence, 1 without any."""
    return next((VALUES[name.thing] for name in reversed(sentence.names) if name.thing in VALUES), 1)


@dataclass(frozen=True, slots=True)
class Families:
    """What was learned of the families of some utterances.

    Attributes:
        known: the formulas of each family by length.
        rules: the rule of each family that has one.
        counting: families whose length is how often they count the only waypoint.
        unordered: families whose waypoints may be exchanged.
    """

    known: Mapping[str, Mapping[int, Known]]
    rules: Mapping[str, Rule]
    counting: frozenset[str]
    unordered: frozenset[str]

    @classmethod
    def of(cls, utterances: Sequence[Utterance]) -> Families:
        """Learn from the formulas of utterances."""
        known: dict[str, dict[int, Known]] = {}
        counting: set[str] = set()
        for utterance in utterances:
            length, different = len(utterance.propositions), tuple(dict.fromkeys(utterance.propositions))
            spoken = numbered(utterance.formula, different)
            known.setdefault(utterance.family, {})[length] = Known(length, len(different), spoken)
            if len(different) < length:
                counting.add(utterance.family)
        rules = {family: _rule(tuple(formulas.values())) for family, formulas in known.items()}
        unordered = {
            family for family, formulas in known.items() if all(exchangeable(one) for one in formulas.values())
        }
        found = {family: rule for family, rule in rules.items() if rule is not None}
        return cls(known, found, frozenset(counting), frozenset(unordered))

    def kind(self, utterance: Utterance, sentence: Sentence) -> Lifted:
        """The family as a class to be learned; of a counting one with how far its count is from what is said."""
        if utterance.family not in self.counting:
            return Lifted(sentence, utterance.family, ())
        return Lifted(sentence, f"{utterance.family} {len(utterance.propositions) - count(sentence)}", ())

    def order(self, utterance: Utterance, sentence: Sentence) -> Lifted | None:
        """The order of the waypoints, to be learned; None when the sentence does not name those of the formula."""
        propositions = tuple(dict.fromkeys(utterance.propositions))
        said = letters(sentence)
        if sorted(said) != sorted(propositions):
            return None
        things = tuple(said) if utterance.family in self.unordered else propositions
        return Lifted(sentence, order_template(len(things)), things)

    def formula(self, kind: str, ordered: Sequence[str], counted: int) -> str:
        """The formula of a class as `kind` names it, about waypoints in order; empty when no rule says it."""
        family, _, offset = kind.partition(" ")
        propositions = sorted(ordered) if family in self.unordered else list(ordered)
        length = counted + int(offset) if offset else len(propositions)
        if not propositions or (offset and len(propositions) != 1):
            return ""
        known = self.known[family].get(length)
        if known is not None and known.propositions == len(propositions):
            return named(known.words, propositions)
        said = self.rules[family].formula(length, len(propositions)) if family in self.rules else None
        return "" if said is None else named(said, propositions)


def order_template(count: int) -> str:
    """The class of the commands about so many waypoints."""
    return " ".join(f"${number}" for number in range(1, count + 1))


def exchangeable(known: Known) -> bool:
    """Whether neighbouring propositions may be exchanged in a prefix formula: operands of `&` and `|` have no order."""
    same = normal(known.words)
    return all(
        normal([_exchanged(word, one, other) for word in known.words]) == same
        for one, other in pairwise(range(known.propositions))
    )


def _exchanged(word: Word, one: int, other: int) -> Word:
    if word == one:
        return other
    return one if word == other else word


def normal(spoken: Sequence[Word]) -> str:
    """A prefix formula with the operands of commutative operators flattened and sorted."""
    text, _ = _read(list(spoken))
    return text


def _read(spoken: list[Word]) -> tuple[str, list[Word]]:
    """One formula from the front, and what is left."""
    head, rest = spoken[0], spoken[1:]
    if head in UNARY:
        operand, rest = _read(rest)
        return f"({head} {operand})", rest
    if head not in BINARY:
        return str(head), rest
    if head not in COMMUTATIVE:
        left, rest = _read(rest)
        right, rest = _read(rest)
        return f"({left} {head} {right})", rest
    operands: list[str] = []
    wanted = 2
    while wanted:
        if rest[0] == head:
            rest, wanted = rest[1:], wanted + 1
            continue
        operand, rest = _read(rest)
        operands.append(operand)
        wanted -= 1
    return f"({head} {' '.join(sorted(operands))})", rest


@cache
def _rule(known: tuple[Known, ...]) -> Rule | None:
    return infer(known)

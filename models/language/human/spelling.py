"""Formulas as the published data sets spell them: `and ( finally ( the red room ) , always ( the first floor ) )`."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass

_MARKS = ("(", ")", ",")
_BARE = re.compile(r"\Afinally ([^()]+)\Z")


@dataclass(frozen=True, slots=True)
class Spelled:
    """An operator with its operands, or words that say a proposition, without any."""

    head: str
    operands: tuple[Spelled, ...] = ()

    def __str__(self) -> str:
        """The spelling."""
        return f"{self.head} ( {' , '.join(map(str, self.operands))} )" if self.operands else self.head

    def walk(self) -> Iterator[Spelled]:
        """This, and all within it, from the left."""
        yield self
        for operand in self.operands:
            yield from operand.walk()

    def sorted(self, commutative: frozenset[str]) -> Spelled:
        """The same with the operands of commutative operators in order."""
        operands = [operand.sorted(commutative) for operand in self.operands]
        return Spelled(self.head, tuple(sorted(operands, key=str) if self.head in commutative else operands))


def in_one_spelling(formula: str) -> str:
    """CleanUp has `finally go to ...` alone, and `finally ( go to ... )` within others: both are the latter."""
    return _BARE.sub(r"finally ( \1 )", formula)


def read(text: str) -> Spelled | None:
    """The formula of a text; None where its parentheses or commas are amiss."""
    spoken = text.split()
    found, rest = _read(spoken)
    return None if rest or str(found) != " ".join(spoken) else found


def _read(spoken: list[str]) -> tuple[Spelled, list[str]]:
    """One formula from the front, and what is left."""
    end = next((place for place, word in enumerate(spoken) if word in _MARKS), len(spoken))
    head, spoken = " ".join(spoken[:end]), spoken[end:]
    if spoken[:1] != ["("]:
        return Spelled(head), spoken
    operands = []
    while spoken[:1] in (["("], [","]):
        operand, spoken = _read(spoken[1:])
        operands.append(operand)
    return Spelled(head, tuple(operands)), spoken[1:]

"""What the clauses of a command may say: as they were taught, or else as they are read."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field, replace
from typing import Protocol

from models.language.composition.arrangement import unmarked
from models.language.composition.shapes import in_one_clause, of_several_clauses
from models.language.spans.translator import SpanTranslator, understood
from models.language.tokens import find, is_mark
from models.language.translation import BEAM_WIDTH, Translation, weighed

ALONE = 0.5
"""Probability of being one task from which nothing else is looked for."""
CERTAIN = 0.9
"""Probability of being one task from which a sequence is not looked at, nor any mark of punctuation."""
ASKED = 0.6
"""Probability that a clause which says nothing else is near to what was taught."""
TAUGHT = 0.9
"""Most share of the taught readings of a clause; the environment may turn it round."""

JOINING = frozenset({"and", "then", "but", "or"})
"""Words that join a command to another."""
PRONOUNS = frozenset({"it", "them", "this", "that", "these", "those", "one"})
"""What is said of a thing that was named before."""


class Taught(Protocol):
    """What understands clauses as they were taught."""

    def translate_all(self, texts: Sequence[str], *, candidates: int = 1) -> list[tuple[Translation, ...]]:
        """The readings of each text, best first, with confidences that add up to at most 1; raises TextTooLongError."""


@dataclass(slots=True, eq=False)
class SpokenClauses:
    """What clauses may say: as they were taught, or else as they are read; each is read once."""

    single: SpanTranslator
    taught: Taught | None
    nearby: Taught | None
    _read: dict[str, tuple[Translation, ...]] = field(default_factory=dict)
    _known: dict[str, tuple[Translation, ...]] = field(default_factory=dict)

    def __call__(self, text: str, /) -> Sequence[Translation]:
        """See `Understand`."""
        self.prepare([text])
        read = self._read[text]
        taught = self._known.get(text, ())
        if not taught:
            return read
        if not read:
            return _asked(taught)
        if sum(translation.confidence for translation in taught) < CERTAIN:
            return weighed(taught, read)
        known = {translation.query for translation in taught}
        total = sum(translation.confidence for translation in taught)
        first = [replace(t, confidence=TAUGHT * t.confidence) for t in taught]
        rest = [replace(t, confidence=(1 - TAUGHT * total) * t.confidence) for t in read if t.query not in known]
        return sorted([*first, *rest], key=lambda t: -t.confidence)

    def alone(self, text: str) -> tuple[Translation, ...]:
        """What the whole text says as one task, not counting what was taught."""
        if text not in self._read:
            self._read[text] = self.single.translate(text, candidates=BEAM_WIDTH)
        return self._read[text]

    def prepare(self, texts: Iterable[str], /) -> None:
        """See `Understand`."""
        texts = list(texts)
        new = [text for text in dict.fromkeys(texts) if text not in self._read]
        if new:
            self._read.update(zip(new, self.single.translate_all(new, candidates=BEAM_WIDTH), strict=True))
        unknown = [text for text in dict.fromkeys(texts) if text not in self._known]
        for taught, asked in ((self.taught, True), (self.nearby, False)):
            part = [text for text in unknown if (understood(self._read[text]) >= ALONE) is asked]
            if part and taught is not None:
                self._known.update(zip(part, taught.translate_all(part, candidates=BEAM_WIDTH), strict=True))


def _asked(taught: Sequence[Translation]) -> Sequence[Translation]:
    """What a clause may say that says nothing else: as it asks for something, that is likelier than by itself."""
    total = sum(translation.confidence for translation in taught)
    return [replace(t, confidence=t.confidence * ASKED / total) for t in taught] if total < ASKED else taught


def goes_elsewhere(whole: Sequence[Translation], spoken: Sequence[str], understand: SpokenClauses) -> bool:
    """Whether the last clause of what is read as one task of several clauses is a command of its own, and of nothing
    but the last argument: who puts the ball in the box "and goes to the hall" need not take it there.
    """
    if not whole or not of_several_clauses(whole[0].query):
        return False
    ((_, task),) = whole[0].query.tasks
    begin = next((at for at in range(len(spoken) - 2, -1, -1) if is_mark(spoken[at]) or spoken[at] in JOINING), -1)
    clause = unmarked(spoken[begin + 1 :])
    *others, last = (argument.split() for argument in task.arguments)
    if begin < 0 or not PRONOUNS.isdisjoint(clause) or any(find(other, clause) is not None for other in others):
        return False
    alone = understand.alone(" ".join(clause))
    return understood(alone) >= CERTAIN and in_one_clause(alone[0].query) and _arguments(alone[0]) == [last]


def _arguments(translation: Translation) -> list[list[str]]:
    return [argument.split() for _, task in translation.query.tasks for argument in task.arguments]

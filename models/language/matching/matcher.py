"""Reads commands by comparing them with what was taught: examples of tasks, and the cards of tasks.

Shapes: S words, D of their vectors, V vectors of what is asked for, R of roles, M ways to see what is mentioned, K
tasks.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from itertools import permutations
from pathlib import Path
from typing import Self

import numpy as np
from numpy.typing import NDArray

from models.language.encoder import DeepReader, encoder
from models.language.encoder.layers import build
from models.language.matching.config import UPPER
from models.language.matching.mentions import Seen, ways_to_see
from models.language.matching.model import MatchModel, load_model
from models.language.matching.nearness import Known, KnownCommands, Vectors, free_words
from models.language.spans.tags import Span
from models.language.spans.translator import quantified
from models.language.teaching.utterance import Utterance, plain
from models.language.teaching.wording import CONNECTIVES
from models.language.tokens import words
from models.language.translation import Translation
from models.queries import ContextualQuery

MOST_TASKS = 6
"""Tasks that are looked at for each way to see what a text mentions."""
LEAST = 1e-3
"""Readings less probable than this are not given."""
MOST_MENTIONS = 5
"""Texts with more mentions are not matched with their parts: the orders would be too many."""
LIKELIER = 1.5
"""Logarithm of how much likelier than others a text is to be a command that names things of the environment."""


def _nothing_named(_said: tuple[str, ...]) -> Sequence[Span]:
    return ()


@dataclass(frozen=True, slots=True, eq=False)
class TaughtTask:
    """A task with what was read in its examples and in its cards, which say what it is for without an example."""

    task: str
    arity: int
    examples: tuple[Known, ...]
    cards: tuple[Known, ...]


@dataclass(frozen=True, slots=True, eq=False)
class Shelf:
    """Tasks to compare with, as arrays."""

    tasks: tuple[TaughtTask, ...]
    arities: NDArray[np.intp]  # [K]
    _known: KnownCommands = field(repr=False)

    @classmethod
    def of(cls, tasks: Iterable[TaughtTask]) -> Self:
        """Of some tasks."""
        kept = tuple(tasks)
        known = KnownCommands.of([(*task.examples, *task.cards) for task in kept])
        return cls(kept, np.array([task.arity for task in kept], np.intp), known)

    def nearness(self, asked: Vectors, sharpness: float) -> Vectors:
        """[M, K] of what a text asks for, [M, V], to the examples and cards of each task; -1 without any. See
        `KnownCommands.nearness`.
        """
        return self._known.nearness(asked, sharpness)


@dataclass(frozen=True, slots=True, eq=False)
class Matcher:
    """Reads texts, and compares them with a shelf."""

    model: MatchModel
    reader: DeepReader

    @classmethod
    def load(cls, folder: Path | None = None) -> Self:
        """With the model of a folder, or the one that is shipped; raises WeightsError."""
        model = load_model(folder)
        return cls(model, DeepReader(encoder(), build(model.upper, UPPER)))

    def to_bytes(self, known: Known) -> bytes:
        """What was read, in half precision: the key of the model, what is asked for, and the roles."""
        numbers = np.concatenate([known.asked, known.roles.ravel()])
        return self.model.key + numbers.astype("<f2").tobytes()

    def from_bytes(self, data: bytes | None) -> Known | None:
        """The inverse of `to_bytes`; None of what another model read, or of nothing."""
        key, config = self.model.key, self.model.heads.config
        if data is None or data[: len(key)] != key:
            return None
        numbers = np.frombuffer(data[len(key) :], "<f2").astype(np.float32)
        return Known(numbers[: config.hidden], numbers[config.hidden :].reshape(-1, config.role))

    def known(self, utterances: Sequence[Utterance]) -> list[Known]:
        """What there is to compare with in utterances of which it is known what they mention."""
        if not utterances:
            return []
        vectors = self.reader.read([utterance.words for utterance in utterances])
        return [self._known(vectors[row, : len(each.words)], each) for row, each in enumerate(utterances)]

    def _known(self, vectors: Vectors, utterance: Utterance) -> Known:
        free = free_words(len(utterance.words), [span for spans in utterance.mentions for span in spans])
        (asked,) = self.model.heads.asked(vectors, [free])
        roles = self.model.heads.roles(vectors, [spans[0] for spans in utterance.mentions])
        halved = (part.astype("<f2").astype(np.float32) for part in (asked, roles))  # as they are read from a store
        return Known(*halved)

    def match(
        self,
        text: str,
        shelf: Shelf,
        *,
        candidates: int,
        fits: Callable[[str], bool] = bool,
        named: Callable[[tuple[str, ...]], Sequence[Span]] = _nothing_named,
    ) -> tuple[Translation, ...]:
        """The queries of tasks on the shelf that a text may say, likeliest first, with their probabilities.

        Args:
            fits: tasks that do not are passed over.
            named: the ranges of folded words that are known to name things, left to right; a command is likely to be
                about all of them and nothing else.

        Raises:
            TextTooLongError: the text is beyond the limits of a command.
        """
        return self.match_all([text], shelf, candidates=candidates, fits=fits, named=named)[0]

    def match_all(
        self,
        texts: Sequence[str],
        shelf: Shelf,
        *,
        candidates: int,
        fits: Callable[[str], bool] = bool,
        named: Callable[[tuple[str, ...]], Sequence[Span]] = _nothing_named,
    ) -> list[tuple[Translation, ...]]:
        """As `match`, for several texts at once, which is faster than one after the other."""
        spoken = [words(text) for text in texts]
        asked = [said for said in dict.fromkeys(spoken) if said and shelf.tasks]
        fitting = np.array([fits(task.task) for task in shelf.tasks], bool)
        found = {
            said: self._matched(said, vectors, shelf, candidates, fitting, named(said))
            for said, vectors in zip(asked, self._vectors(asked), strict=True)
        }
        return [found.get(said, ()) for said in spoken]

    def _matched(
        self,
        said: tuple[str, ...],
        vectors: Vectors,
        shelf: Shelf,
        candidates: int,
        fitting: NDArray[np.bool_],
        named: Sequence[Span],
    ) -> tuple[Translation, ...]:
        found: dict[ContextualQuery, float] = {}
        for task, mentions, likely in self._tasks(ways_to_see(self.model.heads, said, vectors, named), shelf, fitting):
            if any(not CONNECTIVES.isdisjoint(said[slice(*span)]) for span in mentions.spans):
                continue  # no phrase goes on in another clause
            if sum(end - begin for begin, end in mentions.spans) >= len(said):
                continue  # nothing but names asks for nothing
            for order, part in task.orders(mentions):
                spans = (quantified(said, mentions.spans[place], mentions.spans) for place in order)
                phrases = tuple(" ".join(plain(said[slice(*span)])) for span in spans)
                query = ContextualQuery(task.task.task, phrases)
                found[query] = found.get(query, 0.0) + likely * part
        ranked = sorted(found, key=lambda query: (-found[query], str(query)))
        return tuple(Translation(q, min(1.0, found[q])) for q in ranked[:candidates] if found[q] >= LEAST)

    def _vectors(self, texts: Sequence[tuple[str, ...]]) -> list[Vectors]:
        """[S, D] of the words of each text."""
        if not texts:
            return []
        read = self.reader.read(texts)
        return [read[row, : len(text)] for row, text in enumerate(texts)]

    def nearest(self, text: str, shelf: Shelf, *, count: int) -> tuple[tuple[str, float], ...]:
        """The tasks on the shelf that are nearest to a text, with their nearness from -1 to 1."""
        said = words(text)
        if not said or not shelf.tasks:
            return ()
        (vectors,) = self._vectors([said])
        asked = np.stack([seen.asked for seen in ways_to_see(self.model.heads, said, vectors)])
        near = shelf.nearness(asked, self.model.sharpness).max(axis=0)  # [K]
        best = sorted(range(len(near)), key=lambda place: (-near[place], shelf.tasks[place].task))[:count]
        return tuple((shelf.tasks[place].task, float(near[place])) for place in best)

    def _tasks(
        self, seen: Sequence[Seen], shelf: Shelf, fitting: NDArray[np.bool_]
    ) -> Iterator[tuple[_Candidate, Seen, float]]:
        """Tasks with what the text mentions, and the probabilities of both together.

        Whether a task is meant at all is asked of each way to see the text by itself: it is no likelier a command for
        there being many ways. Which task it is then, and so which way is right, is asked of all of them together.
        """
        near = shelf.nearness(np.stack([way.asked for way in seen]), self.model.sharpness)
        points = self.model.points(near)  # [M, K]
        usable = fitting & (shelf.arities == np.array([[len(way.spans)] for way in seen]))
        likelier = np.array([[LIKELIER if way.named else 0.0] for way in seen])
        before = np.array([[way.probability] for way in seen])
        odds = np.where(usable, np.exp(points + likelier), 0.0)  # [M, K]
        each = odds.sum(axis=1, keepdims=True)
        asked = (before * each / (1.0 + each)).sum()  # 1 for none of them
        odds *= before
        if not odds.any():
            return
        for row, way in enumerate(seen):
            for place in np.argsort(-odds[row], kind="stable")[:MOST_TASKS]:
                likely = float(asked * odds[row, place] / odds.sum())
                if likely >= LEAST:
                    yield _Candidate(shelf.tasks[place], self.model.role_temperature), way, likely


@dataclass(frozen=True, slots=True, eq=False)
class _Candidate:
    """A task that a text may say."""

    task: TaughtTask
    temperature: float

    def orders(self, seen: Seen) -> Iterator[tuple[tuple[int, ...], float]]:
        """For each argument the mention that it is, in every order, with the probabilities of these."""
        count = len(seen.spans)
        orders = list(permutations(range(count))) if count <= MOST_MENTIONS else [tuple(range(count))]
        known = [known.roles for known in (*self.task.examples, *self.task.cards) if len(known.roles) == count]
        if len(orders) == 1 or not known:
            yield orders[0], 1.0
            return
        points = [
            max(float((seen.roles[list(order)] * roles).sum()) for roles in known) / self.temperature
            for order in orders
        ]
        top = max(points)
        odds = [math.exp(point - top) for point in points]
        yield from ((order, odd / sum(odds)) for order, odd in zip(orders, odds, strict=True))

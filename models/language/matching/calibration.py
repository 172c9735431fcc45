"""What turns nearness into probabilities that hold, from tasks that the network was not fitted to."""

from __future__ import annotations

import random
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import permutations, product

import numpy as np
from numpy.typing import NDArray

from models.language.matching.batches import Course, Text
from models.language.matching.heads import Heads
from models.language.matching.lessons import Lesson, Said
from models.language.matching.model import MatchModel
from models.language.matching.nearness import Known, KnownCommands, free_words
from models.language.matching.network import MatchNet
from models.language.runtime import Floats

SHELVES, TASKS = 20, 60
"""Shelves that are drawn, and tasks on each."""
MOST_EXAMPLES = 5
SHOWN = 2
"""Cards of each task on a shelf: what it brings about, and its name."""
STEEPNESS = (8.0, 10.0, 12.0, 14.0, 17.0, 20.0, 25.0, 30.0, 35.0, 40.0)
SHARPNESS = (3.0, 5.0, 8.0, 12.0, 20.0)
THRESHOLDS = tuple(step / 20 for step in range(4, 30))
ROLES = (0.05, 0.1, 0.15, 0.2, 0.3, 0.5)


@dataclass(frozen=True, slots=True, eq=False)
class _Readings:
    """The network's readings of texts, whose vectors [S, D] are known."""

    heads: Heads
    read: Mapping[Text, Floats]

    def asked(self, texts: Sequence[Said]) -> Floats:
        """[N, V] what texts ask for."""
        vectors = (self.read[text.words].astype(np.float32) for text in texts)
        frees = (free_words(len(text.words), text.every) for text in texts)
        return np.concatenate([self.heads.asked(v, [free]) for v, free in zip(vectors, frees, strict=True)])

    def roles(self, text: Said) -> Floats:
        """[M, R] the parts that its mentions play."""
        return self.heads.roles(self.read[text.words].astype(np.float32), text.mentions)


@dataclass(frozen=True, slots=True)
class _Trial:
    """A text and the tasks of a shelf: nearness to them for each sharpness, [C, K], and which is right, -1: none."""

    near: NDArray[np.float32]
    right: int


def calibrated(
    network: MatchNet, course: Course, held_out: Sequence[Lesson], refused: Sequence[Said], *, seed: int
) -> MatchModel:
    """What was learned with the constants under which what is right in tasks that it never saw is likeliest.

    The tasks with as many arguments as the text are those that compete, as in use.
    """
    generator = random.Random(seed)
    readings = _Readings(network.heads(), course.read(network))
    drawn = [trial for _ in range(SHELVES) for trial in _shelf(readings, course, held_out, refused, generator)]
    trials = _Trials.of(drawn)
    made = (readings.heads, network.upper())
    temperature = _role_temperature(readings, held_out)
    models = [
        MatchModel(*made, steepness, threshold, sharpness, temperature, {})
        for steepness, threshold, sharpness in product(STEEPNESS, THRESHOLDS, SHARPNESS)
    ]
    return max(models, key=trials.likelihood)


@dataclass(frozen=True, slots=True, eq=False)
class _Trials:
    """T trials as arrays: nearness for each sharpness [C, T, K], padded where `here` [T, K] is false; `right` [T] is -1
    where no task is.
    """

    near: NDArray[np.float32]
    here: NDArray[np.bool_]
    right: NDArray[np.intp]

    @classmethod
    def of(cls, trials: Sequence[_Trial]) -> _Trials:
        width = max(trial.near.shape[1] for trial in trials)
        near = np.zeros((len(SHARPNESS), len(trials), width), np.float32)
        here = np.zeros((len(trials), width), bool)
        for row, trial in enumerate(trials):
            count = trial.near.shape[1]
            near[:, row, :count], here[row, :count] = trial.near, True
        return cls(near, here, np.array([trial.right for trial in trials]))

    def likelihood(self, model: MatchModel) -> float:
        """The logarithm of the probability of what is right in all trials."""
        near = self.near[SHARPNESS.index(model.sharpness)]
        points = np.where(self.here, model.points(near), -np.inf)
        mine = np.where(self.right < 0, 0.0, points[np.arange(len(points)), self.right])
        none = np.zeros((len(points), 1))
        return float((mine - np.logaddexp.reduce(np.concatenate([points, none], axis=1), axis=1)).sum())


def _shelf(
    readings: _Readings,
    course: Course,
    held_out: Sequence[Lesson],
    refused: Sequence[Said],
    generator: random.Random,
) -> Iterator[_Trial]:
    """Texts with a shelf on which their tasks are or are not: half of the held-out ones, and tasks that were seen."""
    shown = generator.sample(list(held_out), len(held_out) // 2)
    kept = shown + generator.sample(list(course.lessons), TASKS - len(shown))
    split = [_example_texts(lesson, generator) for lesson in kept]
    taught = ((*texts, *lesson.cards[:SHOWN]) for lesson, (texts, _) in zip(kept, split, strict=True))
    none = np.zeros((0, readings.heads.config.role), np.float32)
    shelf = KnownCommands.of([[Known(asked, none) for asked in readings.asked(texts)] for texts in taught])
    arities = [len(lesson.cards[0].mentions) for lesson in kept]
    asked = [(text, number) for number, lesson in enumerate(shown) for text in split[number][1][:4]]
    absent = [lesson for lesson in held_out if lesson not in shown]
    asked += [(generator.choice(generator.choice(lesson.wordings)), -1) for lesson in absent]
    asked += [(text, -1) for text in generator.choices(list(refused), k=len(shown))]
    vectors = readings.asked([text for text, _ in asked])
    near = [shelf.nearness(vectors, sharpness) for sharpness in SHARPNESS]
    for row, (text, right) in enumerate(asked):
        fitting = [place for place, arity in enumerate(arities) if arity == len(text.mentions)]
        place = fitting.index(right) if right >= 0 else -1
        yield _Trial(np.stack([each[row, fitting] for each in near]), place)


def _example_texts(lesson: Lesson, generator: random.Random) -> tuple[list[Said], list[Said]]:
    """Texts of a few wordings to teach with, and of the others to ask."""
    groups = generator.sample(lesson.wordings, len(lesson.wordings))
    count = generator.randint(1, MOST_EXAMPLES)
    drawn = [generator.choice(group) for group in groups]
    return drawn[:count], drawn[count:]


def _role_temperature(readings: _Readings, held_out: Sequence[Lesson]) -> float:
    """That under which the right order of mentions is likeliest, with one example."""
    trials = []
    for lesson in held_out:
        count = len(lesson.cards[0].mentions)
        if count < 2:
            continue
        for (first, *_), (second, *_) in zip(lesson.wordings, lesson.wordings[1:], strict=False):
            one, other = readings.roles(first), readings.roles(second)
            trials.append([float((one[list(order)] * other).sum()) for order in permutations(range(count))])

    def likelihood(temperature: float) -> float:
        return float(sum(p[0] / temperature - np.logaddexp.reduce(np.array(p) / temperature) for p in trials))

    return max(ROLES, key=likelihood)

"""What turns nearness into probabilities that hold, from tasks that the network was not fitted to."""

from __future__ import annotations

import random
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import permutations, product

import numpy as np
from numpy.typing import NDArray

from models.language.matching.heads import Heads
from models.language.matching.late import Command, Known, KnownWords
from models.language.matching.lessons import Lesson, Said
from models.language.matching.model import MatchModel
from models.language.matching.training import Course, batch

SHELVES, TASKS = 20, 60
"""Shelves that are drawn, and tasks on each."""
MOST_EXAMPLES = 5
SHOWN = 2
"""Cards of each task on a shelf: what it brings about, and its name."""
STEEPNESS = (8.0, 10.0, 12.0, 14.0, 17.0, 20.0, 25.0, 30.0, 35.0, 40.0)
SHARPNESS = (3.0, 5.0, 8.0, 12.0, 20.0)
THRESHOLDS = tuple(step / 20 for step in range(4, 30))
ROLES = (0.05, 0.1, 0.15, 0.2, 0.3, 0.5)


@dataclass(frozen=True, slots=True)
class _Trial:
    """A text and the tasks of a shelf: nearness to them for each sharpness, [C, K], and which is right, -1: none."""

    near: NDArray[np.float32]
    right: int


def calibrated(
    heads: Heads, course: Course, held_out: Sequence[Lesson], refused: Sequence[Said], *, seed: int
) -> MatchModel:
    """What was learned with the constants under which what is right in tasks that it never saw is likeliest.

    The tasks with as many arguments as the text are those that compete, as in use.
    """
    generator = random.Random(seed)
    drawn = [trial for _ in range(SHELVES) for trial in _shelf(heads, course, held_out, refused, generator)]
    trials = _Trials.of(drawn)
    temperature = _role_temperature(heads, course, held_out)
    models = [
        MatchModel(heads, steepness, threshold, sharpness, temperature, {})
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
    heads: Heads, course: Course, held_out: Sequence[Lesson], refused: Sequence[Said], generator: random.Random
) -> Iterator[_Trial]:
    """Texts with a shelf on which their tasks are or are not: half of the held-out ones, and tasks that were seen."""
    shown = generator.sample(list(held_out), len(held_out) // 2)
    kept = shown + generator.sample(list(course.lessons), TASKS - len(shown))
    split = [_example_texts(lesson, generator) for lesson in kept]
    taught = ((*texts, *lesson.cards[:SHOWN]) for lesson, (texts, _) in zip(kept, split, strict=True))
    shelf = KnownWords.of([_known(heads, course, texts) for texts in taught])
    arities = [len(lesson.cards[0].mentions) for lesson in kept]
    asked = [(text, number) for number, lesson in enumerate(shown) for text in split[number][1][:4]]
    absent = [lesson for lesson in held_out if lesson not in shown]
    asked += [(generator.choice(generator.choice(lesson.wordings)), -1) for lesson in absent]
    asked += [(text, -1) for text in generator.choices(list(refused), k=len(shown))]
    for (text, right), (command, free) in zip(asked, _read(heads, course, [text for text, _ in asked]), strict=True):
        fitting = [place for place, arity in enumerate(arities) if arity == len(text.mentions)]
        near = np.stack([shelf.nearness(command, [free], sharpness)[0, fitting] for sharpness in SHARPNESS])
        yield _Trial(near, fitting.index(right) if right >= 0 else -1)


def _example_texts(lesson: Lesson, generator: random.Random) -> tuple[list[Said], list[Said]]:
    """Texts of a few wordings to teach with, and of the others to ask."""
    groups = generator.sample(lesson.wordings, len(lesson.wordings))
    count = generator.randint(1, MOST_EXAMPLES)
    drawn = [generator.choice(group) for group in groups]
    return drawn[:count], drawn[count:]


def _known(heads: Heads, course: Course, texts: Sequence[Said]) -> list[Known]:
    """As known commands without arguments."""
    none = np.zeros((0, heads.config.role), np.float32)
    return [Known(command.words[free], command.weights(free), none) for command, free in _read(heads, course, texts)]


def _read(heads: Heads, course: Course, texts: Sequence[Said]) -> list[tuple[Command, list[int]]]:
    """What texts ask for, with their free words."""
    vectors, free, _, _ = batch(texts, course)
    read = vectors.numpy()
    return [
        (Command.of(heads, read[row, : len(text.words)]), free[row].nonzero().flatten().tolist())
        for row, text in enumerate(texts)
    ]


def _role_temperature(heads: Heads, course: Course, held_out: Sequence[Lesson]) -> float:
    """That under which the right order of mentions is likeliest, with one example."""
    trials = []
    for lesson in held_out:
        count = len(lesson.cards[0].mentions)
        if count < 2:
            continue
        for (first, *_), (second, *_) in zip(lesson.wordings, lesson.wordings[1:], strict=False):
            one, other = (heads.roles(course.read[t.words].float().numpy(), t.mentions) for t in (first, second))
            trials.append([float((one[list(order)] * other).sum()) for order in permutations(range(count))])

    def likelihood(temperature: float) -> float:
        return float(sum(p[0] / temperature - np.logaddexp.reduce(np.array(p) / temperature) for p in trials))

    return max(ROLES, key=likelihood)

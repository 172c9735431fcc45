"""The evaluation on Lang2LTL's lifted commands: hold-outs of utterances, and of whole formulas."""

from __future__ import annotations

import random
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from models.language.human.baseline import LinearBaseline
from models.language.human.course import HumanCourse
from models.language.human.data import FOLDS, Utterance
from models.language.human.environment import Sentence
from models.language.human.lifting import Lifted, lift_formula
from models.language.human.system import Plan, grounded, shipped, word_reader
from models.language.human.waypoints import Families, count, letters, order_template, waypoints
from models.language.spans.reader import Read, SpanReader
from models.language.spans.training import train

HELD_OUT = 0.2
"""Part of the utterances of each formula that is held out."""


@dataclass(frozen=True, slots=True)
class UtteranceSplit:
    """One training set and one test set."""

    training: Sequence[Utterance]
    test: Sequence[Utterance]


@dataclass(frozen=True, slots=True)
class UtteranceOutcome:
    """One test utterance: whether its text was a training text, whether its family was in training, and the results."""

    duplicate: bool
    family_known: bool
    right: bool
    baseline: bool


def utterance_holdout(utterances: Sequence[Utterance], seed: int) -> Iterator[UtteranceSplit]:
    """A fifth of each formula's utterances is tested by what is learned from the others."""
    generator = random.Random(f"utterances/{seed}")
    held: set[int] = set()
    for members in _by_formula(utterances).values():
        held |= set(generator.sample(members, round(HELD_OUT * len(members))))
    yield _split(utterances, held)


def formula_holdout(utterances: Sequence[Utterance], seed: int) -> Iterator[UtteranceSplit]:
    """Five parts of the formulas; each part's utterances are tested by what is learned from the other parts'."""
    formulas = _by_formula(utterances)
    order = random.Random(f"formulas/{seed}").sample(sorted(formulas), len(formulas))
    for fold in range(FOLDS):
        yield _split(utterances, {place for formula in order[fold::FOLDS] for place in formulas[formula]})


def measure_utterances(
    split: UtteranceSplit, *, seed: int, plan: Plan, log: Callable[[str], None]
) -> list[UtteranceOutcome]:
    """Train on one part of a split and test on the other."""
    sentences = [waypoints().sentence(utterance.text) for utterance in split.test]
    system = WaypointSystem.fit(split.training, seed=seed, plan=plan, log=log)
    seen = {utterance.text for utterance in split.training}
    said = system.formulas(sentences)
    linear = system.baseline(split.training, sentences)
    return [
        UtteranceOutcome(
            utterance.text in seen,
            utterance.family in system.families.known,
            one == utterance.formula,
            other == utterance.formula,
        )
        for utterance, one, other in zip(split.test, said, linear, strict=True)
    ]


@dataclass(frozen=True, slots=True, eq=False)
class WaypointSystem:
    """Two networks, of the family and of the order of the waypoints, and the rules of the families."""

    kinds: SpanReader
    orders: SpanReader
    families: Families

    @classmethod
    def fit(
        cls, utterances: Sequence[Utterance], *, seed: int, plan: Plan, log: Callable[[str], None]
    ) -> WaypointSystem:
        """Train both networks, each from a shipped one."""
        families = Families.of(utterances)
        sentences = [waypoints().sentence(utterance.text) for utterance in utterances]
        pairs = list(zip(utterances, sentences, strict=True))
        kinds = [families.kind(utterance, sentence) for utterance, sentence in pairs]
        orders = [order for pair in pairs if (order := families.order(*pair)) is not None]
        kind_start, order_start = plan.starts
        kind_reader = _fitted(kinds, kind_start, seed=seed, plan=plan)
        log("network 1 of 2")
        order_reader = _fitted(orders, order_start, seed=seed + 1, plan=plan)
        log("network 2 of 2")
        return cls(kind_reader, order_reader, families)

    def formulas(self, sentences: Sequence[Sentence]) -> list[str]:
        """The formula of each sentence; empty when none can be said."""
        renamed = [waypoints().in_order(sentence) for sentence in sentences]
        kinds = self.kinds.read_all([sentence.words for sentence in renamed])
        orders = self.orders.read_all([sentence.words for sentence in renamed])
        return [
            self.families.formula(_best(kind), _ordered(sentence, order), count(sentence))
            for sentence, kind, order in zip(renamed, kinds, orders, strict=True)
        ]

    def baseline(self, utterances: Sequence[Utterance], sentences: Sequence[Sentence]) -> list[str]:
        """What a linear classifier of lifted sentences says, which chooses among the formulas of training."""
        lifted = []
        for utterance in utterances:
            template, things = lift_formula(utterance.formula, list(dict.fromkeys(utterance.propositions)))
            sentence = waypoints().sentence(utterance.text)
            if set(things) <= set(letters(sentence)):
                lifted.append(Lifted(sentence, template, things))
        return LinearBaseline.fit(lifted, waypoints()).formulas(sentences)


def _fitted(commands: Sequence[Lifted], start_name: str, *, seed: int, plan: Plan) -> SpanReader:
    start = shipped(start_name)
    course = HumanCourse.of(commands, waypoints(), seed=seed, known=start.config.words, drawn=plan.drawn)
    return SpanReader.of(train(course, plan.sized(start), seed=seed, words=word_reader(), start=start), word_reader())


def _best(read: Read) -> str:
    """The class that is most probable."""
    return max(read[0], key=lambda reading: reading.probability).task


def _ordered(sentence: Sentence, read: Read) -> tuple[str, ...]:
    """The waypoints in order: of the readings about as many as there are the best, or else as they are mentioned."""
    said = letters(sentence)
    fitting = [reading for reading in read[0] if reading.task == order_template(len(said))]
    for reading in sorted(fitting, key=lambda reading: -reading.probability):
        things = grounded(sentence, reading)
        if things is not None and sorted(things) == sorted(said):
            return things
    return tuple(said)


def _by_formula(utterances: Sequence[Utterance]) -> dict[tuple[str, int], list[int]]:
    """The places of the utterances of each formula, which is a family and a length."""
    found: dict[tuple[str, int], list[int]] = {}
    for place, utterance in enumerate(utterances):
        found.setdefault((utterance.family, len(utterance.propositions)), []).append(place)
    return found


def _split(utterances: Sequence[Utterance], held: set[int]) -> UtteranceSplit:
    return UtteranceSplit(
        [utterance for place, utterance in enumerate(utterances) if place not in held],
        [utterance for place, utterance in enumerate(utterances) if place in held],
    )


def summary_of_utterances(runs: Sequence[Sequence[UtteranceOutcome]]) -> dict[str, Any]:
    """Rates over runs, and over all test utterances those of parts: of families that were in training, of texts that
    were in training.
    """
    every = [outcome for run in runs for outcome in run]
    return {
        "tested": [len(run) for run in runs],
        "right": [_rate([outcome.right for outcome in run]) for run in runs],
        "baseline": [_rate([outcome.baseline for outcome in run]) for run in runs],
        "known families": _part([outcome for outcome in every if outcome.family_known]),
        "duplicates": _part([outcome for outcome in every if outcome.duplicate]),
        "others": _part([outcome for outcome in every if not outcome.duplicate]),
    }


def _part(outcomes: Sequence[UtteranceOutcome]) -> dict[str, Any]:
    right, baseline = [one.right for one in outcomes], [one.baseline for one in outcomes]
    if not outcomes:
        return {"tested": 0, "right": None, "baseline": None}
    return {"tested": len(outcomes), "right": _rate(right), "baseline": _rate(baseline)}


def _rate(right: Sequence[bool]) -> float:
    return sum(right) / len(right)

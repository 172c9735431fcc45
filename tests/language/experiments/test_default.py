"""The default translator's part, with translators that do what is known."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import pytest

from models.language.dataset import Domain
from models.language.experiments.commands import AS_IS, paper_sets
from models.language.experiments.default import WITH, WITHOUT, default_part, default_steps
from models.language.experiments.default_system import DefaultSystem
from models.language.experiments.measurement import measure
from models.language.experiments.settings import Settings
from models.language.experiments.variants import CASE, TYPO, WAYS
from models.language.spans.training import Settings as SpanSettings
from models.language.tokens import words
from models.language.translation import Translation
from models.queries import ContextualQuery, parse_query

SETTINGS = Settings(seeds=(0, 1), spans=SpanSettings(epochs=3), most=6, open_world=12, paraphrases=2, refusals=30)
KNOWN = {
    words(example.text): example.query
    for domain in Domain
    for commands in paper_sets(domain)
    for example in commands.examples
}


@dataclass(frozen=True, slots=True)
class _Rote:
    """Knows S and U by heart, whatever their case and punctuation, and nothing else."""

    confidence: float

    def translate(self, text: str, *, candidates: int = 1) -> tuple[Translation, ...]:
        query = KNOWN.get(words(text))
        return () if query is None else (Translation(query, self.confidence),)


@pytest.fixture(scope="module")
def result() -> tuple[dict[str, Any], list[str]]:
    done: list[str] = []

    def factory(seed: int) -> DefaultSystem:
        for _ in range(SETTINGS.spans.epochs):
            done.append("train")
        return DefaultSystem.of(_Rote(confidence=0.75 if seed else 1.0))

    return default_part(SETTINGS, factory, done.append), done


def test_every_step_is_told(result: tuple[dict[str, Any], list[str]]) -> None:
    assert len(result[1]) == default_steps(SETTINGS)


def test_accuracy(result: tuple[dict[str, Any], list[str]]) -> None:
    accuracy = result[0]["accuracy"]
    assert list(accuracy) == [AS_IS, *WAYS]
    assert list(accuracy[AS_IS]) == ["S", "U", "W"]
    for name in ("S", "U"):
        for domain in Domain:
            for choice in (WITH, WITHOUT):
                assert accuracy[AS_IS][name][domain][choice]["overall"]["ltl"]["low"] == 1.0
                assert accuracy[CASE][name][domain][choice]["overall"]["query"]["low"] == 1.0
                assert accuracy[TYPO][name][domain][choice]["overall"]["ltl"]["high"] == 0.0
    assert accuracy[AS_IS]["W"]["navigation"][WITH]["overall"]["commands"] == 12
    assert accuracy[AS_IS]["W"]["navigation"][WITH]["overall"]["ltl"]["high"] == 0.0
    assert result[0]["failures"][TYPO]["U"]["navigation"]["navigate_one"]["no answer"]["count"] == [6, 6]


def test_nothing_changes_and_everything_is_refused(result: tuple[dict[str, Any], list[str]]) -> None:
    assert result[0]["changed"] == {"S": [0, 0], "U": [0, 0]}
    assert result[0]["refusals"] == {"texts": [30, 30], "refused": [30, 30], "accepted": []}


def test_calibration_is_of_what_was_answered(result: tuple[dict[str, Any], list[str]]) -> None:
    calibration = result[0]["calibration"]
    commands = 6 * (4 + 3)
    assert calibration[WITH]["U"]["answers"] == [commands, commands]
    assert calibration[WITH]["U"]["error"] == {"mean": 0.125, "deviation": 0.1768, "low": 0.0, "high": 0.25}
    assert [entry["count"] for entry in calibration[WITHOUT]["S"]["reliability"]] == [commands, commands]
    assert calibration[WITH]["W"] == {"answers": [0, 0], "error": _nothing(), "reliability": []}


def _nothing() -> dict[str, float]:
    return {"mean": 0.0, "deviation": 0.0, "low": 0.0, "high": 0.0}


@dataclass(frozen=True, slots=True)
class _Undecided:
    """Reads every text as two queries, the better one about something that is nowhere."""

    def translate(self, text: str, *, candidates: int = 1) -> tuple[Translation, ...]:
        last = words(text)[-1]
        readings = (
            Translation(ContextualQuery("pickup", ("unicorn",)), 0.6),
            Translation(ContextualQuery("pickup", (last,)), 0.3),
        )
        return readings[:candidates]


def test_the_environment_decides_between_readings() -> None:
    commands = paper_sets(Domain.MANIPULATION)[1]
    grabs = [e.text for e in commands.examples if e.text.startswith("Grab the") and e.task == "pickup"]
    system = DefaultSystem.of(_Undecided())
    for answer in system.answer(grabs, commands.environment):
        assert answer.formula is not None
        assert answer.confidence > 0.8
    for answer in system.unranked().answer(grabs, commands.environment):
        assert (answer.query, answer.formula, answer.refusal) == (
            parse_query("pickup(unicorn)"),
            None,
            "unknown-object",
        )


def test_a_task_without_a_template_has_a_query_and_no_formula() -> None:
    commands = paper_sets(Domain.MANIPULATION)[1]
    system = DefaultSystem(_Undecided(), {})
    answer = system.answer(["Grab the mug"], commands.environment)[0]
    assert (answer.query, answer.formula, answer.refusal) == (parse_query("pickup(unicorn)"), None, "no-template")
    assert measure(system, commands.thinned(1)).overall.ltl == 0

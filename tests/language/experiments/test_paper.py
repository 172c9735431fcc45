"""The paper's part, over runs that are written by hand: nothing is trained, and every number is known."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from models.language.copynet import Settings as CopyNetSettings
from models.language.dataset import Domain
from models.language.experiments.paper import paper_part, paper_steps
from models.language.experiments.paper_runs import made_with, thinned_sets
from models.language.experiments.paper_systems import CQ, LTL, POS
from models.language.experiments.runs import Runs
from models.language.experiments.settings import Settings
from models.language.experiments.transcript import Transcript

SETTINGS = Settings(seeds=(5, 6), copynet=CopyNetSettings(epochs=2), most=8)
HOMONYMS = {"orange", "bag"}


def _transcript(domain: Domain, *, wrong: int) -> Transcript:
    """CQ-CopyNet right but for the first commands of U; +POS right on S; LTL-CopyNet right on S, and lost on U."""
    seen, unseen = thinned_sets(domain, SETTINGS)
    queries = [example.query for example in (*seen.examples, *unseen.examples)]
    spoilt = [
        replace(query, arguments=("", *query.arguments[1:])[1:] or ("nothing",))
        for query in queries[len(seen.examples) :][:wrong]
    ]
    after = len(seen.examples) + wrong
    return Transcript(
        queries=(*queries[: len(seen.examples)], *spoilt, *queries[after:]),
        tagged=(*queries[: len(seen.examples)], *(None for _ in unseen.examples)),
        formulas=(*seen.expected, *(seen.expected[0] for _ in unseen.examples)),
    )


def _silent(domain: Domain) -> Transcript:
    nothing = (None,) * sum(len(commands.examples) for commands in thinned_sets(domain, SETTINGS))
    return Transcript(nothing, nothing, nothing)


@pytest.fixture(scope="module")
def result(tmp_path_factory: pytest.TempPathFactory) -> tuple[dict[str, Any], list[str]]:
    runs = Runs(tmp_path_factory.mktemp("runs"))
    for domain in Domain:
        for seed in SETTINGS.seeds:
            ended = _transcript(domain, wrong=2 if seed == 6 else 0).as_json()
            run = {
                "points": {1: _silent(domain).as_json(), 2: ended},
                "final": ended,
                "record": {"seed": seed, "epochs": [{"loss": 1 / 3}]},
            }
            runs.write(f"paper-{domain}-{seed}", made_with(SETTINGS), run)
    done: list[str] = []
    return paper_part(SETTINGS, runs, done.append), done


def test_every_step_is_told(result: tuple[dict[str, Any], list[str]]) -> None:
    assert len(result[1]) == paper_steps(SETTINGS) == 2 * 2 * (2 + 2 + 1)
    assert not any("train" in step for step in result[1])


def test_curves(result: tuple[dict[str, Any], list[str]]) -> None:
    part = result[0]["navigation"]
    assert (part["epochs"], part["seeds"]) == ([1, 2], [5, 6])
    assert [spread["mean"] for spread in part["curves"][CQ]["S"]["overall"]["ltl"]] == [0.0, 1.0]
    assert [spread["mean"] for spread in part["curves"][POS]["U"]["overall"]["query"]] == [0.0, 0.0]
    low_high = [(spread["low"], spread["high"]) for spread in part["curves"][CQ]["U"]["overall"]["ltl"]]
    assert low_high == [(0.0, 0.0), (round(22 / 24, 4), 1.0)]


def test_final_scores_and_homonyms(result: tuple[dict[str, Any], list[str]]) -> None:
    seen, _ = thinned_sets(Domain.MANIPULATION, SETTINGS)
    final = result[0]["manipulation"]["final"]
    clear = sum(HOMONYMS.isdisjoint(example.query.arguments) for example in seen.examples)
    assert 0 < clear < 32
    assert final[CQ]["S"]["overall"]["query"]["mean"] == 1.0
    assert final[CQ]["S"]["overall"]["ltl"]["mean"] == round(clear / 32, 4)
    assert final[LTL]["S"]["overall"]["text"]["low"] == 1.0
    assert final[LTL]["U"]["overall"]["ltl"]["high"] == 0.0
    assert final[CQ]["U"]["move_to"]["commands"] == 8


def test_failures_by_cause(result: tuple[dict[str, Any], list[str]]) -> None:
    failures = result[0]["manipulation"]["failures"]
    seen, _ = thinned_sets(Domain.MANIPULATION, SETTINGS)
    said = sum(e.task == "ship" and not HOMONYMS.isdisjoint(e.query.arguments) for e in seen.examples)
    assert failures[CQ]["S"]["ship"]["ambiguous grounding"]["count"] == [said, said]
    assert failures[CQ]["U"]["move_to"]["wrong argument"]["count"] == [0, 2]
    assert failures[POS]["U"]["ship"]["no answer"]["count"] == [8, 8]
    assert failures[LTL]["U"]["move_to"]["wrong proposition"]["count"] == [8, 8]
    assert failures[LTL]["U"]["ship"]["wrong structure"]["count"] == [8, 8]


def test_templates_and_what_they_are_learned_from(result: tuple[dict[str, Any], list[str]]) -> None:
    lessons = result[0]["manipulation"]["lessons"][CQ]
    assert lessons["ship"]["templates"] == ["F (in($1, $2) & F (in($1, $2) & at($2, $3)))"]
    assert lessons["ship"]["accurate"] == [8, 8]
    assert list(result[0]["navigation"]["lessons"]) == [CQ, POS]


def test_how_the_networks_were_trained(result: tuple[dict[str, Any], list[str]]) -> None:
    training = result[0]["navigation"]["training"]
    assert training == [{"seed": seed, "epochs": [{"loss": 0.3333}]} for seed in (5, 6)]


def test_other_settings_train_again(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    asked = []

    def train(domain: Domain, settings: CopyNetSettings, *, seed: int, **_: object) -> None:
        asked.append((domain, settings.epochs, seed))
        raise KeyboardInterrupt

    monkeypatch.setattr("models.language.experiments.paper_runs.train", train)
    runs = Runs(tmp_path)
    runs.write("paper-manipulation-5", made_with(SETTINGS), {})
    other = replace(SETTINGS, copynet=CopyNetSettings(epochs=3))
    with pytest.raises(KeyboardInterrupt):
        paper_part(other, runs, lambda _: None)
    assert asked == [("manipulation", 3, 5)]
    assert runs.read("paper-manipulation-5", made_with(SETTINGS)) == {}

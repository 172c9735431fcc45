"""What a command may mean: taught wordings, translators of queries, translators of formulas."""

from __future__ import annotations

import threading
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import pytest

from models.language import BEAM_WIDTH, Translation
from models.language.copynet import FormulaTranslation
from models.logic import parse, to_text
from models.queries import parse_query
from models.world import Environment, builtin_environments, load_environment
from service.jobs import EmbeddedExecutor
from service.services import Services
from service.settings import Settings
from service.store import Store, StoredExample, StoredTemplate
from service.store.migrate import migrate
from service.translators import Translators
from service.understanding import Understanding, understand
from service.worker import Workers

TOYS = load_environment(dict(builtin_environments())["toys"])


@dataclass
class Said:
    """A translator with fixed readings."""

    readings: tuple[Translation, ...] = ()
    asked: int = 0

    def translate(self, text: str, *, candidates: int = 1) -> tuple[Translation, ...]:
        self.asked = candidates
        return self.readings[:candidates]


@dataclass
class Formulas:
    """A translator with fixed formulas."""

    readings: tuple[FormulaTranslation, ...] = ()

    def translate(self, text: str, *, candidates: int = 1) -> tuple[FormulaTranslation, ...]:
        return self.readings[:candidates]


@pytest.fixture
def network() -> Said:
    return Said()


@pytest.fixture
def ltl() -> Formulas:
    return Formulas()


@pytest.fixture
def services(tmp_path: Path, network: Said, ltl: Formulas) -> Iterator[Services]:
    settings = Settings(data_dir=tmp_path, database_url="")
    migrate(settings.url)
    store = Store(settings.url)
    with store.write() as transaction:
        for stored in (
            template("fetch", "F holding($1)", ("box", "toy"), "bring the sphere here", "fetch(sphere)"),
            template("visit", "F at(robot, $1)", ("cell",)),
        ):
            transaction.templates.put(stored)
    translators = Translators({"default": lambda: network, "cq-copynet": lambda: network}, {"ltl-copynet": lambda: ltl})
    workers = Workers(planners=1, max_waiting=0)
    jobs = EmbeddedExecutor(store, workers, settings, threading.Event())
    yield Services(settings=settings, store=store, workers=workers, jobs=jobs, translators=translators)
    store.close()


def template(task: str, formula: str, kinds: tuple[str, ...], *example: str) -> StoredTemplate:
    examples = (StoredExample(*example),) if example else ()
    return StoredTemplate(task, formula, formula, (kinds,), (), (), examples, ("careful",), 1)


def readings(*found: tuple[str, float]) -> tuple[Translation, ...]:
    return tuple(Translation(parse_query(query), confidence) for query, confidence in found)


def understood(
    services: Services, text: str, environment: Environment | None = TOYS, *, by: str = "default", candidates: int = 3
) -> list[tuple[str, float]]:
    found = understand(services, services.known(), text, environment, translator=by, candidates=candidates)
    return [(str(each.query), pytest.approx(each.confidence)) for each in found]


def test_what_makes_sense_in_the_environment_comes_first(services: Services, network: Said) -> None:
    network.readings = readings(("visit(sphere)", 0.6), ("fetch(sphere)", 0.3))
    first, second = understand(services, services.known(), "go to the sphere", TOYS, translator="default", candidates=2)
    assert (str(first.query), str(second.query)) == ("fetch(sphere)", "visit(sphere)")
    assert first.meaning is not None
    assert (to_text(first.meaning.formula), first.meaning.warnings) == ("F holding(sphere)", ("careful",))
    assert second.refusal is not None
    assert second.meaning is None


def test_more_readings_are_weighed_than_are_asked_for(services: Services, network: Said) -> None:
    network.readings = readings(("visit(sphere)", 0.6), ("fetch(sphere)", 0.3))
    assert [query for query, _ in understood(services, "go to the sphere", candidates=1)] == ["fetch(sphere)"]
    assert network.asked > BEAM_WIDTH
    far_from_all_taught = "sphere umbrella politics"
    assert understood(services, far_from_all_taught, None, candidates=1) == [("visit(sphere)", 0.6)]
    assert network.asked == 1


def test_taught_wordings_come_before_the_network_of_the_default_only(services: Services, network: Said) -> None:
    network.readings = readings(("visit(kitchen)", 0.9))
    text = "bring the cylinder here"
    assert understood(services, text) == [("fetch(cylinder)", 1.0), ("visit(kitchen)", 0.0)]
    assert understood(services, text, None) == [("fetch(cylinder)", 1.0), ("visit(kitchen)", 0.0)]
    assert understood(services, text, by="cq-copynet") == [("visit(kitchen)", pytest.approx(0.9))]


@pytest.mark.parametrize(
    ("phrase", "network_says", "first"),
    [
        ("kitchen", "visit(kitchen)", "visit(kitchen)"),  # the taught reading makes no sense
        ("unicorn", "visit(unicorn)", "fetch(unicorn)"),  # neither does
        ("sphree", "visit(kitchen)", "visit(kitchen)"),  # the taught one needs a correction, the other does not
        ("sphree", "visit(kitchne)", "fetch(sphree)"),  # both do
        ("sphree", "visit(unicorn)", "fetch(sphree)"),
    ],
)
def test_taught_readings_give_way_to_those_that_make_more_sense(
    services: Services, network: Said, phrase: str, network_says: str, first: str
) -> None:
    network.readings = readings((network_says, 0.8))
    assert understood(services, f"bring the {phrase} here")[0][0] == first


def test_a_task_that_is_not_stored_is_not_understood(services: Services, network: Said) -> None:
    network.readings = readings(("juggle(sphere)", 0.9), ("fetch(sphere)", 0.05))
    assert understood(services, "juggle the sphere") == []


def test_a_wrong_number_of_arguments_is_told(services: Services, network: Said) -> None:
    network.readings = readings(("fetch(sphere, kitchen)", 0.9))
    for environment in (TOYS, None):
        (found,) = understand(services, services.known(), "fetch", environment, translator="cq-copynet", candidates=1)
        assert found.refusal is not None
        assert found.refusal.slug == "arity-mismatch"


def test_formulas_are_resolved(services: Services, ltl: Formulas) -> None:
    ltl.readings = (
        FormulaTranslation(parse("F holding(unicorn)"), 0.6),
        FormulaTranslation(parse("F sphere_in_box"), 0.3),
    )

    def ask(environment: Environment | None) -> tuple[Understanding, ...]:
        return understand(
            services, services.known(), "put it away", environment, translator="ltl-copynet", candidates=2
        )

    first, second = ask(TOYS)
    assert first.meaning is not None
    assert (first.query, to_text(first.meaning.formula)) == (None, "F in(sphere, box)")
    assert (second.meaning, second.refusal is None) == (None, False)
    assert [each.meaning and to_text(each.meaning.formula) for each in ask(None)] == [
        "F holding(unicorn)",
        "F sphere_in_box",
    ]

"""What makes sense in an environment comes first."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from models.language import Translation
from models.language.reading import (
    AMBIGUOUS,
    FAR_LIKELIER,
    GROUNDED,
    IMPROBABLE,
    MISSPELT,
    SENSELESS,
    Reading,
    rank,
    rank_formulas,
    read,
)
from models.language.scene import Scene
from models.logic import parse, to_text
from models.queries import AmbiguousGroundingError, ArityMismatchError, Example, learn, parse_query
from models.world import UnknownObjectError, builtin_environments, load_environment

WORLDS = {name: load_environment(data) for name, data in builtin_environments()}
TOYS, NAVIGATION = WORLDS["toys"], WORLDS["navigation"]
LESSONS = (
    ("move_to(sphere)", "F near(robot, sphere)", TOYS),
    ("pickup(sphere)", "F holding(sphere)", TOYS),
    ("store(sphere, box)", "F in(sphere, box)", TOYS),
    ("navigate_one(library)", "F at(robot, library)", NAVIGATION),
)
TEMPLATES = {
    template.task: template
    for template in (learn([Example(parse_query(query), parse(ltl))], world) for query, ltl, world in LESSONS)
}


def said(*readings):
    return [Translation(parse_query(query), confidence) for query, confidence in readings]


def ranked(*readings, text="", environment=TOYS):
    return rank(said(*readings), Scene(text, environment, TEMPLATES.get))


def test_what_makes_sense_comes_first():
    first, second = ranked(("navigate_one(sphere)", 0.6), ("move_to(sphere)", 0.3))
    assert str(first.query) == "move_to(sphere)"
    assert to_text(first.grounded.formula) == "F near(robot, sphere)"
    total = 0.6 * SENSELESS + 0.3 * GROUNDED
    assert first.confidence == pytest.approx(0.9 * 0.3 * GROUNDED / total)
    assert second.confidence == pytest.approx(0.9 * 0.6 * SENSELESS / total)
    assert second.grounded is None
    assert second.refusal.slug == "type-mismatch"


def test_the_unlikely_does_not_win_because_it_can_be_done():
    first, _ = ranked(("pickup(unicorn)", 0.9), ("move_to(kitchen)", 0.5 * SENSELESS))
    assert str(first.query) == "pickup(unicorn)"
    assert isinstance(first.refusal, UnknownObjectError)


def test_weights():
    data = dict(builtin_environments())["toys"]
    data = {**data, "objects": {**data["objects"], "small_box": {"class": "box"}, "large_box": {"class": "box"}}}
    del data["objects"]["box"]
    data["state"] = {owner: value for owner, value in data["state"].items() if owner != "box"}
    data["state"] |= {"small_box": {"in": "kitchen"}, "large_box": {"in": "kitchen"}}
    environment = load_environment(data)
    weights = {
        "pickup(sphere)": GROUNDED,
        "pickup(sphree)": MISSPELT,
        "store(sphere, box)": AMBIGUOUS,
        "store(sphere, bxo)": AMBIGUOUS * MISSPELT,
        "pickup(unicorn)": SENSELESS,
        "pickup(kitchen)": SENSELESS,
        "pickup(sphere, box)": SENSELESS,
    }
    translations = said(*((query, 0.1) for query in weights))
    readings = read(translations, Scene("", environment, TEMPLATES.get))
    assert {str(reading.query): reading.weight for reading in readings} == pytest.approx(weights)
    order = [str(r.query) for r in rank(translations, Scene("", environment, TEMPLATES.get))]
    assert order == sorted(weights, key=lambda query: -weights[query])
    assert isinstance(readings[2].refusal, AmbiguousGroundingError)
    assert isinstance(readings[-1].refusal, ArityMismatchError)


def test_without_an_environment_nothing_moves():
    readings = ranked(("navigate_one(sphere)", 0.6), ("move_to(sphere)", 0.3), environment=None)
    assert [(str(r.query), r.confidence, r.grounded, r.refusal) for r in readings] == [
        ("navigate_one(sphere)", pytest.approx(0.6), None, None),
        ("move_to(sphere)", pytest.approx(0.3), None, None),
    ]
    (wrong,) = ranked(("pickup(sphere, box)", 0.5), environment=None)
    assert isinstance(wrong.refusal, ArityMismatchError)


def test_a_task_without_a_template_is_left_out_and_not_taken_for_another():
    (only,) = ranked(("move_to(sphere)", 0.6), ("fetch(sphere)", 0.3))
    assert (str(only.query), only.confidence) == ("move_to(sphere)", pytest.approx(0.6))
    assert ranked(("fetch(sphere)", 0.6), ("move_to(sphere)", 0.3)) == ()
    assert ranked(("fetch(sphere)", 0.6)) == ()
    assert ranked() == ()


QUERIES = st.sampled_from(
    ["pickup(sphere)", "pickup(cylinder)", "pickup(unicorn)", "pickup(spher)", "move_to(kitchen)"]
)


@given(st.dictionaries(QUERIES, st.floats(0, 0.2), max_size=5))
def test_all_readings_together_stay_as_probable(confidences):
    readings = ranked(*confidences.items())
    assert sum(r.confidence for r in readings) == pytest.approx(sum(confidences.values()))
    assert {str(r.query) for r in readings} <= set(confidences)
    assert [r.confidence for r in readings] == sorted((r.confidence for r in readings), reverse=True)


@given(st.dictionaries(QUERIES, st.floats(0, 0.2) | st.floats(0, 0.001), max_size=5), st.sampled_from(["", "sphere"]))
def test_what_is_left_out_would_be_hardly_probable(confidences, text):
    scene, translations = Scene(text, TOYS, TEMPLATES.get), said(*confidences.items())
    every = _weighed(read(translations, scene), sum(confidences.values()))
    kept = {str(r.query): r.confidence for r in rank(translations, scene)}
    most = max(every.values(), default=0.0)
    assert all(probability <= 1.01 * IMPROBABLE * most for query, probability in every.items() if query not in kept)
    assert kept == pytest.approx({query: every[query] for query in kept}, rel=0.01)
    assert list(kept) == sorted(kept, key=lambda query: -every[query])


def _weighed(readings, total):
    """The probabilities of all readings by Bayes, as `models.language.reading` says."""
    weighed = {str(r.query): r.confidence * r.likelihood for r in readings}
    scale = total / (sum(weighed.values()) or 1.0)
    return {query: weight * scale for query, weight in weighed.items()}


def test_the_improbable_is_not_looked_at_beside_what_makes_full_sense():
    sure, hardly = ("pickup(sphere)", 0.9), ("move_to(sphere)", 0.9 * IMPROBABLE / 2)
    assert [str(r.query) for r in ranked(sure, hardly)] == ["pickup(sphere)"]
    assert [str(r.query) for r in ranked(("pickup(spher)", 0.9), hardly)] == ["pickup(spher)", "move_to(sphere)"]
    assert len(ranked(sure, hardly, text="the cylinder")) == 2  # of which the first says nothing
    assert len(ranked(sure, hardly, environment=None)) == 2


def test_what_is_far_likelier_by_the_words_is_noted_where_it_means_nothing():
    rather, hardly = ("pickup(kitchen)", 0.9), ("move_to(kitchen)", 0.9 / FAR_LIKELIER)
    first, second = ranked(rather, hardly)
    assert (str(first.query), str(first.instead_of.query)) == ("move_to(kitchen)", "pickup(kitchen)")
    assert first.instead_of.refusal.slug == "type-mismatch"
    assert second.instead_of is None
    assert ranked(("pickup(kitchen)", 0.8), hardly)[0].instead_of is None  # not so far
    assert ranked(("pickup(sphere)", 0.9), hardly)[0].instead_of is None
    assert (
        ranked(("pickup(kitchen)", 0.9), ("pickup(bedroom)", 0.01))[0].instead_of is None
    )  # nor is the other possible
    assert ranked(rather, hardly, environment=None)[0].instead_of is None


def test_a_reading_without_environment_has_full_weight():
    assert Reading(parse_query("pickup(sphere)"), 0.5).weight == GROUNDED


@pytest.fixture(scope="module")
def talks():
    """An orange and the colour orange, and a task that takes either."""
    domain = {
        "name": "talks",
        "attributes": {"color": ["orange", "red"]},
        "classes": {"thing": {}},
        "functions": {"about": {"arguments": ["x: thing | color"], "is": "x is thing", "says": "it is about {x}"}},
        "actions": {},
    }
    objects = {"orange": {"class": "thing"}, "ball": {"class": "thing"}}
    return load_environment({"name": "talks", "kind": "oomdp", "domain_spec": domain, "objects": objects})


@pytest.mark.parametrize(
    ("text", "meant"),
    [
        ("pick up the orange", "thing.orange"),
        ("PICK UP THE ORANGE!", "thing.orange"),
        ("Pick up, the Orange?", "thing.orange"),
        ("find something orange", "color.orange"),
        ("FIND SOMETHING ORANGE!!", "color.orange"),
        ("Find: Something Orange.", "color.orange"),
    ],
)
def test_parts_of_speech_do_not_depend_on_case_and_punctuation(talks, text, meant):
    template = learn([Example(parse_query("talk(ball)"), parse("F about(ball)"))], talks)
    (reading,) = rank(said(("talk(orange)", 0.9)), Scene(text, talks, {"talk": template}.get))
    assert reading.grounded is not None, reading.refusal
    assert to_text(reading.grounded.formula) == f'F about("{meant}")'


def test_a_homonym_outside_the_text_stays_in_doubt(talks):
    template = learn([Example(parse_query("talk(ball)"), parse("F about(ball)"))], talks)
    (reading,) = rank(said(("talk(orange)", 0.9)), Scene("hello", talks, {"talk": template}.get))
    assert isinstance(reading.refusal, AmbiguousGroundingError)


def test_formulas_that_the_environment_has_come_first():
    formulas = [(parse("F holding(unicorn)"), 0.5), (parse("F sphere_in_box"), 0.25)]
    first, second = rank_formulas(formulas, environment=TOYS)
    assert (to_text(first.formula), first.refusal) == ("F in(sphere, box)", None)
    assert first.confidence == pytest.approx(0.75 * 0.25 / (0.25 + 0.5 * SENSELESS))
    assert isinstance(second.refusal, UnknownObjectError)
    assert second.refusal.places[0].detail.startswith("F holding(unicorn): nothing is called unicorn")
    plain = rank_formulas(formulas, environment=None)
    assert [(reading.formula, reading.confidence) for reading in plain] == formulas

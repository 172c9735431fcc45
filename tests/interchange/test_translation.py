"""Random expressions of a domain: the symbolic translation and its PRISM text against the world's arrays."""

from __future__ import annotations

from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
from hypothesis import HealthCheck, given, reject, settings
from hypothesis import strategies as st

from models.interchange.errors import ExportTooLargeError
from models.interchange.grounded import GroundedModel
from models.interchange.truth import truth
from models.logic import Atom, Name
from models.world import Environment, WorldError, load_environment
from tests.interchange.environments import CHAIN
from tests.interchange.test_prism import check
from tests.world.worlds import changed

ENTITIES = st.recursive(
    st.sampled_from(["x.in", "y.in", "s", "A", "A.in", "B.in", "x.in.in"]),
    lambda inner: st.one_of(
        st.builds("inside({})".format, inner),
        st.builds("({} if {} == {} else {})".format, inner, inner, inner, inner),
        st.builds("({} if big({}) else {})".format, inner, inner, inner),
    ),
    max_leaves=5,
)
COUNTS = st.sampled_from(["count(z: small; z.in == {})", "count(z: big | spot; {} == z.in)", "count(z: spot; z != {})"])
NUMBERS = st.one_of(
    st.sampled_from(["0", "1", "2", "0.5", "p"]),
    st.builds(str.format, COUNTS, ENTITIES),
    st.builds("({} {} {})".format, st.builds(str.format, COUNTS, ENTITIES), st.sampled_from("+-*"), st.just("p")),
)
CONDITIONS = st.recursive(
    st.one_of(
        st.builds("{} {} {}".format, ENTITIES, st.sampled_from(["==", "!="]), ENTITIES),
        st.builds("big({})".format, ENTITIES),
        st.sampled_from(["x == y", "x.in.in == none", "y.in.in is none | spot", "x.in is not big", "true", "false"]),
        st.builds("{} {} {}".format, NUMBERS, st.sampled_from(["<", "<=", "==", "!=", ">", ">="]), NUMBERS),
        st.builds("any(z: spot | big; z == {} or {} == z.in)".format, ENTITIES, ENTITIES),
        st.builds("all(z: small; z.in == {} implies z.in.in == {})".format, ENTITIES, ENTITIES),
    ),
    lambda inner: st.one_of(
        inner.map(lambda c: f"not ({c})"),
        st.builds("({}) {} ({})".format, inner, st.sampled_from(["and", "or", "implies", "==", "!="]), inner),
        st.builds("(({}) if ({}) else ({}))".format, inner, inner, inner),
    ),
    max_leaves=6,
)


DEFINITIONS = {
    "inside": {"arguments": ["e: spot | big"], "is": "e.in if e is big else e"},
    "big": {"arguments": ["e: spot | big"], "is": "e is big"},
}


def environment(*changes: tuple[str, object]) -> Environment:
    """CHAIN with changes; rejects an example that is ill-typed, or whose initial state is illegal."""
    constants = {"s": "spot", "A": "big", "B": "big"}
    base = (("domain_spec/define", DEFINITIONS), ("domain_spec/constants", constants))
    try:
        return load_environment(changed(CHAIN, *base, *changes))
    except WorldError:
        reject()


def functions(conditions: list[str]) -> tuple[str, object]:
    """The conditions as propositional functions of x and y."""
    bodies = {f"f{i}": {"arguments": ["x: small", "y: small"], "is": text} for i, text in enumerate(conditions)}
    return "domain_spec/functions", bodies


def applications(count: int) -> list[Atom]:
    """Each function applied to equal and to different things."""
    return [Atom(f"f{i}", (Name("x"), Name(y))) for i in range(count) for y in "yx"]


@given(CONDITIONS)
@settings(max_examples=50, deadline=None, suppress_health_check=list(HealthCheck))
def test_a_condition_holds_where_the_world_says(condition: str) -> None:
    env = environment(functions([condition]))
    model = GroundedModel(env.world)
    digits = dict(enumerate(np.unravel_index(np.arange(env.world.size), model.radix)))
    for atom, expected in zip(applications(1), env.world.labels(applications(1)), strict=True):
        symbols = [env.vocabulary.named(term.text)[0] for term in atom.arguments]
        found = truth(model.proposition(atom.function, symbols), digits, {})
        assert np.array_equal(np.broadcast_to(found, expected.shape), expected)


@given(st.lists(CONDITIONS, min_size=1, max_size=3))
@settings(max_examples=12, deadline=None, suppress_health_check=list(HealthCheck))
def test_its_text_holds_where_the_world_says(conditions: list[str]) -> None:
    env = environment(functions(conditions))
    with TemporaryDirectory() as folder:
        try:
            check(env, Path(folder), applications(len(conditions)))
        except ExportTooLargeError:
            reject()


@given(CONDITIONS, CONDITIONS, st.tuples(ENTITIES, ENTITIES))
@settings(max_examples=10, deadline=None, suppress_health_check=list(HealthCheck))
def test_random_actions_are_those_of_the_world(guard: str, constraint: str, effects: tuple[str, str]) -> None:
    move = {
        "arguments": ["x: small", "y: small"],
        "when": f"({guard}) and inside({effects[0]}) is spot and {effects[1]} != none",
        "outcomes": [
            {"probability": "p", "set": {"A.in": f"inside({effects[0]})"}},
            {"probability": "1 - p", "set": {"x.in": effects[1]}},
        ],
    }
    legal = f"all(x: small; all(y: small; ({constraint}) or A.in == s))"
    env = environment(("domain_spec/actions/move", move), ("domain_spec/constraints/1", legal))
    with TemporaryDirectory() as folder:
        try:
            check(env, Path(folder), [])
        except ExportTooLargeError:  # a documented refusal
            reject()

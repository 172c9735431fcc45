"""Names in formulas: compound names, synonyms, what is refused."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from models.errors import CqltlError
from models.logic.formula import Atom, Name, Op, Parameter, Unary, conjunction
from models.world import (
    Symbol,
    TypeMismatchError,
    UnknownObjectError,
    UnknownPropositionError,
    atom_symbols,
    load_environment,
    resolve,
    toys_spec,
)
from tests.world.worlds import SWITCHES, TINY, changed

BUCKETS = changed(
    toys_spec(toys=[("ball", "red"), ("orange", "orange")], state={"ball": {"in": "kitchen"}}),
    ("objects/small_bucket", {"class": "box", "synonyms": ["pail"]}),
    ("state/small_bucket", {"in": "kitchen"}),
    ("objects/H&M (2nd floor)", {"class": "box", "synonyms": ["H&M"]}),
    ("state/H&M (2nd floor)", {"in": "kitchen"}),
)


@pytest.fixture(scope="module")
def toys():
    return load_environment(BUCKETS)


def atom(function, *names):
    return Atom(function, tuple(Parameter(n) if isinstance(n, int) else Name(n) for n in names))


@pytest.mark.parametrize(
    ("given", "expected"),
    [
        (atom("in", "ball", "small_bucket"), atom("in", "ball", "small_bucket")),
        (atom("ball_in_small_bucket"), atom("in", "ball", "small_bucket")),
        (atom("ball_in_pail"), atom("in", "ball", "small_bucket")),
        (atom("holding_small_bucket"), atom("holding", "small_bucket")),
        (atom("holding small bucket"), atom("holding", "small_bucket")),
        (atom("robot_at_bedroom"), atom("at", "robot", "bedroom")),
        (atom("Robot_At_Bedroom"), atom("at", "robot", "bedroom")),
        (atom("robot_near_ball"), atom("near", "robot", "ball")),
        (atom("ball_in_h&m_(2nd_floor)"), atom("in", "ball", "H&M (2nd floor)")),
        (atom("orange_is_orange"), atom("colored", "orange", "orange")),
        (atom("colored", "orange", "orange"), atom("colored", "orange", "orange")),
        (atom("in", "ball", "pail"), atom("in", "ball", "small_bucket")),
        (atom("in", "Ball", "small bucket"), atom("in", "ball", "small_bucket")),
        (atom("in", "ball", "h&m"), atom("in", "ball", "H&M (2nd floor)")),
        (atom("in", 1, "pail"), atom("in", 1, "small_bucket")),
        (atom("in", 2, 1), atom("in", 2, 1)),
    ],
)
def test_resolves(toys, given, expected):
    formula = Unary(Op.FINALLY, conjunction(given, atom("holding", "ball")))
    assert resolve(formula, toys) == Unary(Op.FINALLY, conjunction(expected, atom("holding", "ball")))
    assert resolve(resolve(given, toys), toys) == resolve(given, toys)


@pytest.mark.parametrize(
    ("given", "error", "message"),
    [
        (atom("inn", "ball", "pail"), UnknownPropositionError, "did you mean in"),
        (atom("in", "ball"), UnknownPropositionError, "takes 2 arguments, not 1"),
        (atom("in"), UnknownPropositionError, "takes 2 arguments, not 0"),
        (atom("a"), UnknownPropositionError, "no propositional function a"),
        (atom("x" * 5_000), UnknownPropositionError, "no propositional function"),
        (atom("in", "bal", "pail"), UnknownObjectError, "did you mean ball"),
        (atom("in", "...", "pail"), UnknownObjectError, "nothing is called"),
        (atom("ball_in_shoe"), UnknownObjectError, "nothing is called shoe"),
        (atom("holding_shoe"), UnknownObjectError, "nothing is called shoe"),
        (atom("in", "ball", "kitchen"), TypeMismatchError, "b of in.t, b. must be box, but kitchen is cell"),
        (atom("in", "pail", 1), TypeMismatchError, "must be toy, but pail is box"),
        (atom("colored", "ball", "ball"), TypeMismatchError, "must be color, but ball is toy and shape"),
    ],
)
def test_refuses(toys, given, error, message):
    with pytest.raises(error, match=message):
        resolve(Unary(Op.NOT, given), toys)
    assert issubclass(error, CqltlError)


def test_a_compound_name_with_two_readings_is_refused():
    data = changed(
        BUCKETS,
        ("objects/ball_in_box", {"class": "toy"}),
        ("state/ball_in_box", {"in": "kitchen"}),
        ("objects/box_in_crate", {"class": "box"}),
        ("state/box_in_crate", {"in": "kitchen"}),
        ("objects/crate", {"class": "box"}),
        ("state/crate", {"in": "kitchen"}),
    )
    with pytest.raises(UnknownPropositionError) as caught:
        resolve(atom("ball_in_box_in_crate"), load_environment(data))
    assert "in(ball, box_in_crate)" in caught.value.detail
    assert "in(ball_in_box, crate)" in caught.value.detail
    assert resolve(atom("ball_in_crate"), load_environment(data)) == atom("in", "ball", "crate")


def test_a_name_of_two_things_that_both_fit_is_refused():
    either = {"arguments": ["x: lamp | color"], "is": "x is lamp"}
    data = changed(
        SWITCHES,
        ("domain_spec/functions/either", either),
        ("objects/red", {"class": "lamp"}),
        ("state/red", {"level": "low"}),
    )
    with pytest.raises(TypeMismatchError, match=r"red \(lamp\) and red \(color\)"):
        resolve(atom("either", "red"), load_environment(data))


def test_a_shared_synonym_is_refused_and_a_name_beats_a_synonym():
    data = changed(BUCKETS, ("objects/box/synonyms", ["pail", "small_bucket"]))
    environment = load_environment(data)
    with pytest.raises(TypeMismatchError, match=r"box \(box\) and small_bucket"):
        resolve(atom("in", "ball", "pail"), environment)
    assert resolve(atom("in", "ball", "small_bucket"), environment) == atom("in", "ball", "small_bucket")


def test_symbols(toys):
    assert atom_symbols(atom("colored", "orange", "orange"), toys) == (
        Symbol("toy", "orange"),
        Symbol("color", "orange"),
    )
    assert atom_symbols(atom("at", 1, "kitchen"), toys) == (None, Symbol("cell", "kitchen"))


def test_labels_of_explicit_environments():
    tiny = load_environment(TINY)
    assert resolve(atom("a"), tiny) == atom("a")
    assert atom_symbols(atom("a"), tiny) == ()
    with pytest.raises(UnknownPropositionError, match="known: a, b"):
        resolve(atom("reach_goal"), tiny)
    with pytest.raises(UnknownPropositionError, match="takes 0 arguments, not 1"):
        resolve(atom("a", "b"), tiny)


NAMES = ["ball", "orange", "small_bucket", "box", "kitchen", "robot", "in", "at", "is", "near", "holding"]


@given(st.lists(st.sampled_from(NAMES), min_size=1, max_size=30).map("_".join))
def test_any_compound_name_is_read_or_refused(toys_environment, name):
    try:
        read = resolve(atom(name), toys_environment)
    except CqltlError:
        return
    assert isinstance(read, Atom)
    written = {"in": "{}_in_{}", "at": "{}_at_{}", "holding": "holding_{}", "colored": "{}_is_{}", "near": "{}_near_{}"}
    assert written[read.function].format(*(term.text for term in read.arguments)) == name


@pytest.fixture(scope="module")
def toys_environment(toys):
    return toys


def test_patterns_with_many_readings_stay_quick():
    """Objects a, a_x_a, a_x_a_x_a, ...: exponentially many ways to cut the name."""
    objects = {"_x_".join("a" * n): {"class": "lamp"} for n in range(1, 26)}
    state = {"robot": {"by": "none"}} | {name: {"level": "low"} for name in objects}
    names = ["u", "v", "w", "x", "y", "z"]
    function = {
        "arguments": [f"{name}: lamp" for name in names],
        "is": "true",
        "display": ["_x_".join(f"{{{name}}}" for name in names)],
    }
    data = changed(SWITCHES, ("objects", objects), ("state", state), ("domain_spec/functions", {"f": function}))
    with pytest.raises(UnknownPropositionError, match="can be read as"):
        resolve(atom("_x_".join("a" * 80)), load_environment(data))
    with pytest.raises(UnknownPropositionError, match="no propositional function"):
        resolve(atom("_x_".join("a" * 80) + "_b"), load_environment(data))

"""The AST: limits, values, and that nothing recurses."""

from __future__ import annotations

import copy
import pickle
import subprocess
import sys
import threading
from collections.abc import Callable

import pytest
from hypothesis import given

from models.logic import (
    FALSE,
    MAX_DEPTH,
    MAX_SIZE,
    TRUE,
    Atom,
    Binary,
    Constant,
    Dialect,
    Formula,
    FormulaTooLargeError,
    InvalidNameError,
    Name,
    Nary,
    Op,
    Parameter,
    Unary,
    atoms,
    conjunction,
    disjunction,
    fold,
    map_atoms,
    parse,
    substitute,
    to_text,
    walk,
)
from tests.logic.strategies import formulas, nasty_atoms

A, B, C = Atom("a"), Atom("b"), Atom("c")


def deepest() -> Formula:
    """A formula at the depth limit in which every kind of inner node alternates."""
    formula: Formula = A
    for step in range(MAX_DEPTH - 1):
        kinds: tuple[Callable[[Formula], Formula], ...] = (
            lambda f: Unary(Op.FINALLY, f),
            lambda f: conjunction(B, f),
            lambda f: Binary(Op.UNTIL, f, B),
            lambda f: disjunction(f, C),
        )
        formula = kinds[step % 4](formula)
    return formula


def test_conjunctions_flatten_and_their_grouping_does_not_matter() -> None:
    assert conjunction(A, conjunction(B, C)) == conjunction(conjunction(A, B), C) == Nary(Op.AND, (A, B, C))
    assert conjunction(A) == A
    assert conjunction() == TRUE
    assert disjunction() == FALSE
    assert disjunction(A, conjunction(B, C)) == Nary(Op.OR, (A, Nary(Op.AND, (B, C))))


def test_order_of_operands_is_part_of_the_value() -> None:
    assert conjunction(A, B) != conjunction(B, A)
    assert Unary(Op.FINALLY, A) != Unary(Op.GLOBALLY, A)
    assert Unary(Op.FINALLY, A) != A
    assert Binary(Op.UNTIL, A, B) != "a U b"


def test_nodes_refuse_operators_of_another_kind() -> None:
    with pytest.raises(ValueError, match="one operand"):
        Unary(Op.AND, A)
    with pytest.raises(ValueError, match="two operands"):
        Binary(Op.FINALLY, A, B)
    with pytest.raises(ValueError, match="list"):
        Nary(Op.UNTIL, (A, B))
    with pytest.raises(ValueError, match="flattened"):
        Nary(Op.AND, (A, Nary(Op.AND, (B, C))))


@pytest.mark.parametrize("text", ["", "a\nb", "\t", "\x00", "a\u2028", "\ud800"])
def test_names_that_cannot_be_printed_are_refused(text: str) -> None:
    with pytest.raises(InvalidNameError):
        Name(text)
    with pytest.raises(InvalidNameError):
        Atom(text)


def test_parameters_are_counted_from_one() -> None:
    with pytest.raises(InvalidNameError):
        Parameter(0)


def test_depth_and_size_are_measured_and_limited() -> None:
    formula = Unary(Op.FINALLY, conjunction(A, Binary(Op.UNTIL, B, C)))
    assert (formula.depth, formula.size) == (4, 6)
    with pytest.raises(FormulaTooLargeError):
        Unary(Op.NOT, deepest())
    with pytest.raises(FormulaTooLargeError):
        conjunction(*[A] * MAX_SIZE)
    assert conjunction(*[A] * (MAX_SIZE - 1)).size == MAX_SIZE


def test_substituting_formulas_for_atoms_cannot_outgrow_the_limit() -> None:
    wide = conjunction(*[A] * 4_000)
    with pytest.raises(FormulaTooLargeError):
        map_atoms(wide, lambda _: wide)
    doubled: Formula = A
    for _ in range(11):  # shared subformulas count as often as they occur
        doubled = Binary(Op.IFF, doubled, doubled)
    assert doubled.size == 4_095
    with pytest.raises(FormulaTooLargeError):
        Binary(Op.IFF, doubled, doubled)


def test_atoms_in_order_of_first_occurrence() -> None:
    assert atoms(parse("b U (a & b & c(x) & c(y))")) == (B, A, Atom("c", (Name("x"),)), Atom("c", (Name("y"),)))


def test_walk_is_in_reading_order() -> None:
    assert [to_text(node) for node in walk(parse("F (a & !b)"))] == ["F (a & !b)", "a & !b", "a", "!b", "b"]


def test_substitution_is_simultaneous() -> None:
    swapped = substitute(parse("in(a, b) U at(b, $1)"), {Name("a"): Name("b"), Name("b"): Name("a")})
    assert to_text(swapped) == "in(b, a) U at(a, $1)"
    assert to_text(substitute(swapped, {Parameter(1): Name("c")})) == "in(b, a) U at(a, c)"


def test_substitution_flattens_what_it_brings_together() -> None:
    assert map_atoms(parse("a & b"), lambda atom: conjunction(atom, C)) == conjunction(A, C, B, C)


def test_fold_gives_operands_left_to_right() -> None:
    assert fold(parse("a -> (b U c)"), lambda node, done: f"<{getattr(node, 'function', '')}{''.join(done)}>") == (
        "<<a><<b><c>>>"
    )


def test_repr_is_code_that_builds_the_formula() -> None:
    formula = parse('F (in(a, "b c") & !x($2) | 1 U b)')
    names = {kind.__name__: kind for kind in (Atom, Binary, Constant, Name, Nary, Op, Parameter, Unary)}
    assert eval(repr(formula), names) == formula


def test_equal_formulas_have_equal_hashes_and_copies_are_equal() -> None:
    one, other = parse("F (a & F b) -> c"), parse("◇(a ∧ ◇b) → c")
    assert one == other
    assert hash(one) == hash(other)
    assert len({one, other}) == 1
    assert copy.deepcopy(one) == one == copy.copy(one)


@given(formulas(nasty_atoms))
def test_pickling_keeps_the_value(formula: Formula) -> None:
    for protocol in (2, pickle.HIGHEST_PROTOCOL):
        again = pickle.loads(pickle.dumps(formula, protocol))
        assert again == formula
        assert hash(again) == hash(formula)
        assert (again.depth, again.size) == (formula.depth, formula.size)


def test_pickles_are_good_in_a_process_with_other_hashes() -> None:
    program = (
        "import pickle, sys; from models.logic import parse; "
        "f = pickle.loads(sys.stdin.buffer.read()); g = parse('F (a & F b) -> c'); "
        "print(f == g and hash(f) == hash(g))"
    )
    done = subprocess.run(
        [sys.executable, "-c", program],
        input=pickle.dumps(parse("F (a & F b) -> c")),
        capture_output=True,
        check=True,
        env={"PYTHONHASHSEED": "12345", "PYTHONPATH": ":".join(path or "." for path in sys.path)},
    )
    assert done.stdout.strip() == b"True"


def test_nothing_recurses_over_the_deepest_formula_even_on_a_nearly_full_stack() -> None:
    failures: list[BaseException] = []
    formula = deepest()

    def exercise() -> None:
        twin = pickle.loads(pickle.dumps(formula))
        assert twin == formula
        assert hash(copy.deepcopy(formula)) == hash(twin)
        assert repr(formula) == repr(twin)
        assert len(atoms(formula)) == 3
        assert substitute(formula, {Name("x"): Name("y")}) == formula
        for dialect in Dialect:
            assert parse(to_text(formula, dialect), dialect=dialect) == formula

    def descend(levels: int) -> None:
        if levels:
            descend(levels - 1)
        else:
            exercise()

    def body() -> None:
        try:
            descend(sys.getrecursionlimit() - 200)
        except BaseException as error:
            failures.append(error)

    to_text(parse("a"), Dialect.LATEX)  # loads the grammar, which needs a stack of its own
    thread = threading.Thread(target=body)
    thread.start()
    thread.join()
    assert not failures

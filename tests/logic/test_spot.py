"""Translation and comparison, judged by an evaluator of LTL on lassos, by Spot on its own text, and by hand."""

from __future__ import annotations

import itertools
import pickle
import random
import sys
from types import SimpleNamespace

import numpy as np
import pytest
import spot
from hypothesis import given, settings
from hypothesis import strategies as st

from models.logic import (
    FALSE,
    MAX_ATOMS,
    MAX_TABLE,
    TRUE,
    Atom,
    Automaton,
    Formula,
    FormulaTooLargeError,
    Pair,
    SpotMissingError,
    Unary,
    atoms,
    equivalent,
    is_cosafe,
    is_satisfiable,
    is_valid,
    parse,
    to_text,
    translate,
)
from models.logic.formula import Op
from tests.logic.lasso import holds
from tests.logic.strategies import cosafe_formulas, formulas, plain_atoms

Letter = frozenset[Atom]
ALPHABET = [
    frozenset(chosen) for n in range(4) for chosen in itertools.combinations([Atom("a"), Atom("b"), Atom("c")], n)
]
letters = st.sampled_from(ALPHABET)
words = st.tuples(st.lists(letters, max_size=4), st.lists(letters, min_size=1, max_size=3))


def number(automaton: Automaton, letter: Letter) -> int:
    return sum(1 << bit for bit, atom in enumerate(automaton.atoms) if atom in letter)


def accepts(automaton: Automaton, prefix: list[Letter], loop: list[Letter]) -> bool:
    """Whether the run on prefix · loop^ω gets to the accepting state, or satisfies one of the pairs for ever."""
    word = prefix + loop * automaton.states
    state = automaton.run(number(automaton, letter) for letter in word)[-1]
    if automaton.accepting[state] or automaton.rejecting[state]:
        return bool(automaton.accepting[state])
    marks = 0
    for letter in loop * automaton.states:  # at least once around the cycle that the run has come to
        marks |= int(automaton.marks[state, number(automaton, letter)])
        state = int(automaton.successors[state, number(automaton, letter)])
    return any(not marks & pair.finite and marks & pair.infinite == pair.infinite for pair in automaton.acceptance)


def check_shape(automaton: Automaton) -> None:
    """What holds of every automaton, whatever the formula."""
    count, width = automaton.successors.shape
    assert width == 2 ** len(automaton.atoms)
    assert automaton.initial == 0
    assert automaton.successors.dtype == np.int32
    assert automaton.successors.min() >= 0
    assert automaton.successors.max() < count
    assert automaton.accepting.sum() <= 1
    assert automaton.rejecting.sum() <= 1
    assert not (automaton.accepting & automaton.rejecting).any()
    for state in np.flatnonzero(automaton.accepting | automaton.rejecting):
        assert (automaton.successors[state] == state).all()
    can_accept = automaton.accepting.copy()
    for _ in range(count):
        can_accept |= can_accept[automaton.successors].any(axis=1)
    if not automaton.acceptance:
        assert (can_accept == ~automaton.rejecting).all()
    met = [0, *automaton.successors[0].tolist()]
    for state in range(1, count):
        met.extend(automaton.successors[state].tolist())
    assert list(dict.fromkeys(met)) == list(range(count))  # breadth first, letters ascending


@given(cosafe_formulas(plain_atoms), st.lists(words, min_size=5, max_size=15))
@settings(max_examples=80, deadline=None)
def test_the_automaton_accepts_just_the_words_that_satisfy_the_formula(
    formula: Formula, tries: list[tuple[list[Letter], list[Letter]]]
) -> None:
    automaton = translate(formula)
    check_shape(automaton)
    assert automaton.atoms == atoms(formula)
    for prefix, loop in tries:
        assert accepts(automaton, prefix, loop) == holds(formula, prefix, loop)


@given(formulas(plain_atoms, max_leaves=6), st.lists(words, min_size=3, max_size=8))
@settings(max_examples=80, deadline=None)
def test_cosafety_is_decided_on_the_language(formula: Formula, tries: list[tuple[list[Letter], list[Letter]]]) -> None:
    judged = spot.mp_class(spot.formula(to_text(formula))) in ("B", "G")
    assert is_cosafe(formula) == judged
    automaton = translate(formula)
    check_shape(automaton)
    assert (automaton.acceptance == ()) == judged
    for prefix, loop in tries:
        assert accepts(automaton, prefix, loop) == holds(formula, prefix, loop)


@given(formulas(plain_atoms, max_leaves=6), st.lists(words, min_size=1, max_size=10))
@settings(max_examples=80, deadline=None)
def test_every_operator_means_what_the_definitions_say(
    formula: Formula, tries: list[tuple[list[Letter], list[Letter]]]
) -> None:
    for prefix, loop in tries:
        literals = [
            "(" + " & ".join(a if Atom(a) in letter else "!" + a for a in "abc") + ")" for letter in [*prefix, *loop]
        ]
        cycle = "cycle{" + ";".join(literals[len(prefix) :]) + "}"
        word = spot.parse_word(";".join([*literals[: len(prefix)], cycle]))
        judged = not spot.product(spot.translate(to_text(formula)), word.as_automaton()).is_empty()
        assert holds(formula, prefix, loop) == judged


@given(cosafe_formulas(plain_atoms, max_leaves=5))
@settings(max_examples=80, deadline=None)
def test_no_state_is_superfluous(formula: Formula) -> None:
    automaton = translate(formula)
    kind = automaton.accepting.astype(np.int64)
    for _ in range(automaton.states):  # Moore's refinement
        _, kind = np.unique(np.column_stack([kind, kind[automaton.successors]]), axis=0, return_inverse=True)
    assert len(set(kind.tolist())) == automaton.states


def test_visit_in_order_by_hand() -> None:
    automaton = translate(parse("F (a & F b)"))
    assert automaton.atoms == (Atom("a"), Atom("b"))  # letter 1 is a, 2 is b, 3 is both
    assert automaton.successors.tolist() == [[0, 1, 0, 2], [1, 1, 2, 2], [2, 2, 2, 2]]
    assert automaton.accepting.tolist() == [False, False, True]
    assert automaton.rejecting.tolist() == [False, False, False]
    assert automaton.run([0, 2, 1, 0, 2]) == [0, 0, 0, 1, 1, 2]


def test_avoid_until_by_hand() -> None:
    automaton = translate(parse("!q U p"))
    assert automaton.successors.tolist() == [[0, 1, 2, 2], [1, 1, 1, 1], [2, 2, 2, 2]]
    assert (automaton.rejecting.tolist(), automaton.accepting.tolist()) == ([False, True, False], [False, False, True])


def test_next_counts_steps_from_the_initial_label() -> None:
    automaton = translate(parse("X a"))
    assert automaton.run([0, 1])[-1] == int(np.flatnonzero(automaton.accepting)[0])
    assert automaton.run([1, 0])[-1] == int(np.flatnonzero(automaton.rejecting)[0])


@pytest.mark.parametrize("text", ["false", "a & !a", "F a & G !a", "X false", "a U false"])
def test_an_unsatisfiable_formula_rejects_at_once(text: str) -> None:
    automaton = translate(parse(text))
    assert (automaton.states, automaton.rejecting.tolist(), automaton.accepting.tolist()) == (1, [True], [False])
    assert not is_satisfiable(parse(text))


@pytest.mark.parametrize("text", ["true", "a | !a", "F a | G !a", "G true", "X X true", "(G a) | F !a"])
def test_a_valid_formula_accepts_at_once(text: str) -> None:
    automaton = translate(parse(text))
    assert (automaton.states, automaton.accepting.tolist(), automaton.rejecting.tolist()) == (1, [True], [False])
    assert is_valid(parse(text))


@pytest.mark.parametrize(
    ("text", "states", "acceptance"),
    [
        ("F (a & F b)", 3, ()),
        ("G a", 2, (Pair(0, 1),)),  # kept for ever, or the state that rejects
        ("F p & G !q", 3, (Pair(0, 1),)),
        ("G F a", 1, (Pair(0, 1),)),
        ("G F a & G F b", 2, (Pair(0, 1),)),  # which of the two is waited for
        ("F G a", 1, (Pair(1, 0),)),
        ("G F a -> G F b", 1, (Pair(0, 1), Pair(2, 0))),
    ],
)
def test_acceptance_by_class(text: str, states: int, acceptance: tuple[Pair, ...]) -> None:
    automaton = translate(parse(text))
    check_shape(automaton)
    assert (automaton.states, automaton.acceptance) == (states, acceptance)
    assert is_cosafe(parse(text)) == (acceptance == ())


@given(formulas(plain_atoms, max_leaves=6))
@settings(max_examples=100, deadline=None)
def test_the_hoa_text_has_the_language_of_the_formula(formula: Formula) -> None:
    assert spot.are_equivalent(spot.automaton(translate(formula).hoa), spot.formula(to_text(formula)))


def test_the_four_meanings_of_avoid() -> None:
    always, until, there, only = (parse(text) for text in ("F p & G !q", "!q U p", "F (p & !q)", "G !q"))
    assert [is_cosafe(formula) for formula in (always, until, there, only)] == [False, True, True, False]
    for one, other in itertools.combinations((always, until, there, only), 2):
        assert not equivalent(one, other)
    # q, then p without q: fine for `there`, not for `until`; q together with p: the other way round.
    q_then_p, p_with_q = [0b00, 0b10, 0b01], [0b00, 0b11]
    p_first = translate(parse("F (p & !q) | (p & false & q)")).atoms
    assert p_first == (Atom("p"), Atom("q"))
    there_automaton, until_automaton = translate(there), translate(until)
    assert until_automaton.atoms == (Atom("q"), Atom("p"))
    assert there_automaton.accepting[there_automaton.run(q_then_p)[-1]]
    assert not there_automaton.accepting[there_automaton.run(p_with_q)[-1]]
    assert until_automaton.rejecting[until_automaton.run([0b00, 0b01, 0b10])[-1]]
    assert until_automaton.accepting[until_automaton.run(p_with_q)[-1]]


def test_the_ship_template_orders_nothing() -> None:
    assert equivalent(parse("F (a & F (a & b))"), parse("F (a & b)"))
    assert not equivalent(parse("F (a & F b)"), parse("F (a & b)"))
    assert not equivalent(parse("(!b U a) & F (a & b)"), parse("F (a & b)"))
    ship, short = translate(parse("F (a & F (a & b))")), translate(parse("F (a & b)"))
    assert ship.successors.tolist() == short.successors.tolist()


@given(formulas(plain_atoms, max_leaves=5), formulas(plain_atoms, max_leaves=5))
@settings(max_examples=80, deadline=None)
def test_equivalent_formulas_agree_on_words_and_others_do_not(left: Formula, right: Formula) -> None:
    chance = random.Random(to_text(left) + to_text(right))
    lassos = [
        (chance.choices(ALPHABET, k=chance.randrange(5)), chance.choices(ALPHABET, k=chance.randrange(1, 4)))
        for _ in range(60)
    ]
    differ = any(holds(left, *lasso) != holds(right, *lasso) for lasso in lassos)
    assert equivalent(left, right) == spot.are_equivalent(to_text(left), to_text(right))
    assert not (differ and equivalent(left, right))
    assert is_satisfiable(left) or not any(holds(left, *lasso) for lasso in lassos)
    assert not is_valid(left) or all(holds(left, *lasso) for lasso in lassos)


def test_atoms_with_arguments_are_told_apart_by_value() -> None:
    assert equivalent(parse('F in(a, "b")'), parse("F in(a, b)"))
    assert not equivalent(parse("F in(a, b)"), parse("F in(b, a)"))
    assert not equivalent(parse("p0 & q"), parse("q & p1"))
    assert translate(parse('"F a" U "p0"')).atoms == (Atom("F a"), Atom("p0"))


def test_the_hoa_text_is_the_same_automaton_with_readable_names() -> None:
    formula = parse('F (in(x, "H&M \\"\\\\o/\\"") & F (b & X c))')
    automaton = translate(formula)
    read = spot.automaton(automaton.hoa)
    assert [ap.ap_name() for ap in read.ap()] == [to_text(atom) for atom in automaton.atoms]
    assert (read.num_states(), read.get_init_state_number()) == (automaton.states, 0)
    table = np.full(automaton.successors.shape, -1)
    for edge in read.edges():
        for letter in range(table.shape[1]):
            literals = [spot.formula.ap(ap.ap_name()) for ap in read.ap()]
            cube = spot.formula.And(
                [lit if letter >> bit & 1 else spot.formula.Not(lit) for bit, lit in enumerate(literals)]
            )
            if spot.formula_to_bdd(cube, read.get_dict(), None) & edge.cond == spot.formula_to_bdd(
                cube, read.get_dict(), None
            ):
                table[edge.src, letter] = edge.dst
    assert (table == automaton.successors).all()
    assert [read.state_is_accepting(state) for state in range(automaton.states)] == automaton.accepting.tolist()


def test_translation_does_not_depend_on_what_went_before() -> None:
    formula = parse("F (a & X (b | c)) | (c U !d)")
    first = translate(formula)
    for text in ("d U (c & b)", "F x & F y & F z", "G F (q & p)"):
        is_satisfiable(parse(text))
    for text in ("X d | F (c & b)", "(z U y) & F x"):
        translate(parse(text))
    again = translate(formula)
    assert again.hoa == first.hoa
    assert (again.successors == first.successors).all()


def test_letters_and_reading_are_vectorised() -> None:
    automaton = translate(parse("F (a & F b)"))
    truth = np.array([[0, 1, 0, 1], [0, 0, 1, 1]], dtype=np.bool_)
    assert automaton.letters(truth).tolist() == [0, 1, 2, 3]
    assert automaton.read(np.zeros(4, dtype=np.int32), automaton.letters(truth)).tolist() == [0, 1, 0, 2]
    memory = np.arange(3)[:, None]
    assert automaton.read(memory, automaton.letters(truth)).shape == (3, 4)
    with pytest.raises(ValueError, match=r"truth must be \[2, n\]"):
        automaton.letters(truth[:1])
    assert translate(TRUE).letters(np.zeros((0, 5), dtype=np.bool_)).tolist() == [0] * 5


def test_automata_travel_between_processes_and_cannot_be_written_to() -> None:
    automaton = translate(parse("F (in(a, b) & F c)"))
    again = pickle.loads(pickle.dumps(automaton))
    assert (again.formula, again.atoms, again.hoa) == (automaton.formula, automaton.atoms, automaton.hoa)
    assert (again.successors == automaton.successors).all()
    with pytest.raises(ValueError, match="read-only"):
        automaton.successors[0, 0] = 1


def test_what_is_too_large_is_refused() -> None:
    any_of = parse(" | ".join(f"F p{i}" for i in range(MAX_ATOMS + 1)))
    all_of = parse(" & ".join(f"F p{i}" for i in range(MAX_ATOMS)))
    window = parse("F (a & " + "X " * 60 + "b)")  # the minimal automaton has 2 ** 60 states
    wide_window = parse("F (a & " + "X " * 12 + "(" + " | ".join(f"p{i}" for i in range(12)) + "))")
    for formula in (any_of, all_of, window, wide_window):
        with pytest.raises(FormulaTooLargeError):
            translate(formula)
    for compare in (is_satisfiable, is_valid, lambda f: equivalent(f, TRUE)):
        with pytest.raises(FormulaTooLargeError):
            compare(any_of)
    assert translate(parse("F (a & " + "X " * 8 + "b)")).states == 2**8 + 1


def test_sixteen_atoms_and_many_goals_are_not_too_large() -> None:
    parity = translate(parse(" <-> ".join(f"p{i}" for i in range(MAX_ATOMS))))
    assert parity.successors.shape == (3, 2**MAX_ATOMS)
    letter = np.arange(2**MAX_ATOMS)
    ones = sum((letter >> bit) & 1 for bit in range(MAX_ATOMS))
    assert (parity.accepting[parity.successors[0]] == (ones % 2 == 0)).all()
    goals = translate(parse(" & ".join(f"F p{i}" for i in range(8))))
    assert goals.successors.shape == (256, 256)
    assert goals.successors.size <= MAX_TABLE
    # The state tells the goals that have been reached.
    reached = {0: 0}
    for state in range(256):
        for bit in range(8):
            after = int(goals.successors[state, 1 << bit])
            assert reached.setdefault(after, reached[state] | 1 << bit) == reached[state] | 1 << bit


def test_deep_formulas_are_translated() -> None:
    deep: Formula = Atom("a")
    for _ in range(150):
        deep = Unary(Op.NEXT, deep)
    assert translate(deep).states == 153
    assert equivalent(parse("F " * 150 + "a"), parse("F a"))


def test_without_spot_a_sentence_says_how_to_get_it(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "spot", None)
    for call in (translate, is_cosafe, is_satisfiable, is_valid):
        with pytest.raises(SpotMissingError, match="pip install spottl") as caught:
            call(parse("F never_seen_before"))
        assert caught.value.slug == "spot-missing"
    assert to_text(parse("F a")) == "F a"
    monkeypatch.setitem(sys.modules, "spot", SimpleNamespace())
    with pytest.raises(SpotMissingError, match="not the Spot library"):
        equivalent(parse("F a"), FALSE)

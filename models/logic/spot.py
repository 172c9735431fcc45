"""The bridge to Spot: comparing formulas, and translating them to automata.

Spot (Duret-Lutz et al., "From Spot 2.0 to Spot 2.10", CAV 2022) is imported here and nowhere else, when first needed.
It never sees a caller's text: formulas are built with its constructors over the propositions p0, p1, ...

Translation is exponential, determinization doubly so. The checks here are cheap and bound the determinization; who
serves strangers runs these functions in a process that can be killed.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from models.logic.automaton import Automaton
from models.logic.effort import obligations
from models.logic.errors import FormulaNotCosafeError, FormulaTooLargeError, SpotMissingError
from models.logic.formula import FALSE, TRUE, Atom, Constant, Formula, Op, atoms, fold
from models.logic.printer import atom_text, to_text

MAX_ATOMS = 16
"""Most distinct atoms in what is translated or compared."""
MAX_TABLE = 1 << 22
"""Most entries of an automaton's table: states times 2 ** atoms."""
MAX_OBLIGATIONS = 1_024
"""Largest guess at the work (`effort.obligations`) with which Spot is called at all."""
_MAX_SUBSETS = 20_000  # states of any intermediate deterministic automaton
_MAX_EDGES = 2_000_000  # its edges, which bounds the time as well: some seconds

_CLASSES = (
    ("is_syntactic_safety", "it is a safety property: it can only be broken"),
    ("is_syntactic_obligation", "it is an obligation property: it mixes what can be finished with what has to be kept"),
    ("is_syntactic_recurrence", "it is a recurrence property: something has to happen again and again"),
    ("is_syntactic_persistence", "it is a persistence property: something has to hold from some time on"),
)


@dataclass(frozen=True, slots=True)
class _Vocabulary:
    """The atoms that stand behind Spot's p0, p1, ..., in that order."""

    atoms: tuple[Atom, ...]

    @classmethod
    def of(cls, *formulas: Formula) -> _Vocabulary:
        found = tuple(dict.fromkeys(atom for formula in formulas for atom in atoms(formula)))
        if len(found) > MAX_ATOMS:
            raise FormulaTooLargeError(f"there are {len(found)} different atoms; at most {MAX_ATOMS} can be handled")
        if any(obligations(formula) > MAX_OBLIGATIONS for formula in formulas):
            raise FormulaTooLargeError("the formula asks for too many things at once for an automaton to keep apart")
        return cls(found)

    def encode(self, formula: Formula) -> Any:
        """The formula as Spot's."""
        spot = _spot()
        index = {atom: spot.formula.ap(f"p{i}") for i, atom in enumerate(self.atoms)}
        make = {op: getattr(spot.formula, name) for op, name in _SPOT_OPERATORS.items()}

        def combine(node: Formula, operands: tuple[Any, ...]) -> Any:
            if isinstance(node, Atom):
                return index[node]
            if isinstance(node, Constant):
                return spot.formula.tt() if node.value else spot.formula.ff()
            return make[node.op](list(operands)) if node.op in (Op.AND, Op.OR) else make[node.op](*operands)

        return fold(formula, combine)


_SPOT_OPERATORS = {
    Op.NOT: "Not",
    Op.NEXT: "X",
    Op.FINALLY: "F",
    Op.GLOBALLY: "G",
    Op.AND: "And",
    Op.OR: "Or",
    Op.IMPLIES: "Implies",
    Op.IFF: "Equiv",
    Op.UNTIL: "U",
    Op.RELEASE: "R",
    Op.WEAK_UNTIL: "W",
    Op.STRONG_RELEASE: "M",
}


def equivalent(left: Formula, right: Formula) -> bool:
    """Whether the same infinite words satisfy both formulas.

    Raises FormulaTooLargeError beyond MAX_ATOMS, and SpotMissingError.
    """
    if left == right:
        return True
    vocabulary = _Vocabulary.of(left, right)
    return bool(_spot().are_equivalent(vocabulary.encode(left), vocabulary.encode(right)))


def is_satisfiable(formula: Formula) -> bool:
    """Whether some infinite word satisfies the formula. Raises as `equivalent` does."""
    return not equivalent(formula, FALSE)


def is_valid(formula: Formula) -> bool:
    """Whether every infinite word satisfies the formula. Raises as `equivalent` does."""
    return equivalent(formula, TRUE)


def is_cosafe(formula: Formula) -> bool:
    """Whether every word that satisfies the formula has a finite beginning after which it holds whatever follows.

    Decided on the language, not on the looks. Raises FormulaTooLargeError and SpotMissingError.
    """
    try:
        vocabulary = _Vocabulary.of(formula)
        encoded = vocabulary.encode(formula)
        return bool(encoded.is_syntactic_guarantee()) or _minimal(formula, vocabulary, encoded) is not None
    except FormulaNotCosafeError:
        return False


def translate(formula: Formula) -> Automaton:
    """The minimal complete deterministic automaton of a co-safe formula.

    Minimal as a weak deterministic automaton (Löding, "Efficient minimization of deterministic weak omega-automata",
    2001), hence the same for every way to write the formula with its atoms in the same order.

    Raises FormulaNotCosafeError, FormulaTooLargeError beyond MAX_ATOMS or MAX_TABLE, and SpotMissingError.
    """
    vocabulary = _Vocabulary.of(formula)
    minimal = _minimal(formula, vocabulary, vocabulary.encode(formula))
    graph = minimal.graph
    if graph.num_states() << len(vocabulary.atoms) > MAX_TABLE:
        raise _too_large()
    table = _table(graph, minimal.variables)
    order = _breadth_first(table, graph.get_init_state_number())
    number = np.empty(len(order), dtype=np.int32)  # old state -> new state
    number[order] = np.arange(len(order), dtype=np.int32)
    successors = number[table[order]]
    absorbing = (successors == np.arange(len(order))[:, None]).all(axis=1)
    marked = np.array([graph.state_is_accepting(int(state)) for state in order])
    return Automaton(
        formula=formula,
        atoms=vocabulary.atoms,
        initial=0,
        successors=successors,
        accepting=absorbing & marked,
        rejecting=absorbing & ~marked,
        hoa=_hoa(minimal, vocabulary, order, number),
    )


@dataclass(frozen=True, slots=True)
class _Minimal:
    """A minimal complete deterministic automaton of Spot's, and the BDD variable of each proposition."""

    graph: Any
    variables: tuple[int, ...]
    keeper: Any  # an automaton that keeps the variables allotted in order


def _minimal(formula: Formula, vocabulary: _Vocabulary, encoded: Any) -> _Minimal:
    spot = _spot()
    dictionary = spot.make_bdd_dict()  # a fresh one, so that no earlier call has a say in the order of variables
    keeper = spot.make_twa_graph(dictionary)
    variables = tuple(keeper.register_ap(f"p{i}") for i in range(len(vocabulary.atoms)))
    options = (
        f"wdba-minimize=1,wdba-det-max=0,det-max-states={_MAX_SUBSETS},det-max-edges={_MAX_EDGES},"
        "simul=0,ba-simul=0,det-simul=0,det-stutter=0,gf-guarantee=0"
    )
    graph = spot.translate(encoded, "buchi", "det", "low", "complete", "sbacc", dict=dictionary, xargs=options)
    if not spot.is_deterministic(graph):
        # Either it is no obligation property, or the determinization was given up.
        if encoded.is_syntactic_guarantee() or spot.mp_class(encoded) in ("B", "G", "S", "O"):
            raise _too_large()
        raise _not_cosafe(formula, encoded)
    if not _is_terminal(graph):
        raise _not_cosafe(formula, encoded)
    return _Minimal(graph, variables, keeper)


def _is_terminal(graph: Any) -> bool:
    """Whether a run can only accept by staying for ever in a state that every letter leads back to."""
    spot = _spot()
    components = spot.scc_info(graph)
    for index in range(components.scc_count()):
        if components.is_accepting_scc(index):
            states = components.states_of(index)
            edges = list(graph.out(states[0]))
            if len(states) != 1 or any(edge.dst != states[0] for edge in edges):
                return False
    return True


def _table(graph: Any, variables: Sequence[int]) -> NDArray[np.int32]:
    """The successor of each state under each letter: [states, 2 ** atoms]."""
    import buddy  # comes with Spot

    count = len(variables)
    table = np.full((graph.num_states(), 1 << count), -1, dtype=np.int32)
    axis = {variable: count - 1 - bit for bit, variable in enumerate(variables)}  # bit 0 is the last axis
    for state in range(graph.num_states()):
        cube = table[state].reshape((2,) * count)
        for edge in graph.out(state):
            _fill(cube, edge.cond, edge.dst, axis, [slice(None)] * count, buddy)
    return table


def _fill(
    cube: NDArray[np.int32], condition: Any, target: int, axis: dict[int, int], where: list[Any], buddy: Any
) -> None:
    """Write `target` for the letters that satisfy a BDD; as deep as there are atoms."""
    if condition == buddy.bddfalse:
        return
    if condition == buddy.bddtrue:
        cube[tuple(where)] = target
        return
    position = axis[buddy.bdd_var(condition)]
    for value, branch in ((0, buddy.bdd_low(condition)), (1, buddy.bdd_high(condition))):
        where[position] = value
        _fill(cube, branch, target, axis, where, buddy)
    where[position] = slice(None)


def _breadth_first(table: NDArray[np.int32], initial: int) -> NDArray[np.int64]:
    """The states in the order in which a breadth-first search finds them, letters ascending."""
    found = [initial]
    seen = {initial}
    for state in found:
        targets, first = np.unique(table[state], return_index=True)
        for target in targets[np.argsort(first)].tolist():
            if target not in seen:
                seen.add(target)
                found.append(target)
    return np.array(found, dtype=np.int64)


def _hoa(minimal: _Minimal, vocabulary: _Vocabulary, order: NDArray[np.int64], number: NDArray[np.int32]) -> str:
    """The renumbered automaton in the HOA format, with the atoms as the names of its propositions."""
    spot = _spot()
    renumbered = spot.make_twa_graph(minimal.graph.get_dict())
    for index in range(len(vocabulary.atoms)):
        renumbered.register_ap(f"p{index}")
    mark = renumbered.set_buchi()
    none = spot.mark_t([])
    renumbered.new_states(len(order))
    renumbered.set_init_state(0)
    for state in order.tolist():
        # Marks only where the run is decided: elsewhere the state is left for good, and a mark means nothing.
        edges = sorted((int(number[edge.dst]), edge.cond) for edge in minimal.graph.out(state))
        decided = minimal.graph.state_is_accepting(state) and all(to == number[state] for to, _ in edges)
        for target, condition in edges:
            renumbered.new_edge(int(number[state]), target, condition, mark if decided else none)
    renumbered.prop_state_acc(spot.trival(True))
    header = "AP: " + " ".join([str(len(vocabulary.atoms)), *map(_hoa_name, vocabulary.atoms)])
    lines = renumbered.to_str("hoa").split("\n")
    return "\n".join(header if line.startswith("AP:") else line for line in lines) + "\n"


def _hoa_name(atom: Atom) -> str:
    return '"' + atom_text(atom).replace("\\", "\\\\").replace('"', '\\"') + '"'


def _too_large() -> FormulaTooLargeError:
    return FormulaTooLargeError(
        f"the automaton of the formula is too large: more than {MAX_TABLE} transitions, or too many on the way to it"
    )


def _not_cosafe(formula: Formula, encoded: Any) -> FormulaNotCosafeError:
    shown = to_text(formula)
    shown = shown if len(shown) <= 200 else shown[:197] + "..."
    why = next((text for check, text in _CLASSES if getattr(encoded, check)()), "it is a reactivity property")
    return FormulaNotCosafeError(
        f"`{shown}` is not co-safe: no finite run can finish it ({why}); only tasks that can be finished are planned"
    )


def _spot() -> Any:
    """Spot's module. Raises SpotMissingError where it is not installed."""
    try:
        import spot
    except ImportError as error:
        raise SpotMissingError(
            "Spot is not installed, and automata and equivalence need it: on Linux x86-64 `pip install spottl`, "
            "elsewhere take it from Homebrew or conda"
        ) from error
    if not hasattr(spot, "translate"):
        raise SpotMissingError("the module `spot` found here is not the Spot library: install `spottl` instead")
    return spot

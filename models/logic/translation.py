"""Formulas to deterministic automata, by Spot.

Obligations (what can be finished, what has to be kept, and Boolean combinations of these) give the minimal weak
automaton (Löding, "Efficient minimization of deterministic weak omega-automata", 2001), all others a deterministic
parity automaton. The acceptance of either is a disjunction of pairs with at most one set to be met again and again
each, so the memory of a policy is the automaton's state alone.

Translation is exponential, determinization doubly so. The checks here are cheap and bound the determinization; who
serves strangers runs these functions in a process that can be killed.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from operator import itemgetter
from typing import Any

import numpy as np
from numpy.typing import NDArray

from models.logic.automaton import Automaton, Pair
from models.logic.errors import FormulaTooLargeError
from models.logic.formula import Atom, Formula
from models.logic.printer import atom_text
from models.logic.spot import Vocabulary, library

MAX_TABLE = 1 << 22
"""Most entries of an automaton's table: states times 2 ** atoms."""
_MAX_SUBSETS = 20_000  # states of any intermediate deterministic automaton
_MAX_EDGES = 2_000_000  # its edges, which bounds the time as well: some seconds
_SMALL = 1 << 12  # entries of tables that are remembered
_MOST_KNOWN = 256
_KNOWN: dict[Formula, Automaton] = {}  # automata cannot be written to, and the same formula comes again and again
_BOUNDED = f"det-max-states={_MAX_SUBSETS},det-max-edges={_MAX_EDGES}"
_WEAK = f"wdba-minimize=1,wdba-det-max=0,{_BOUNDED},simul=0,ba-simul=0,det-simul=0,det-stutter=0,gf-guarantee=0"


def is_cosafe(formula: Formula) -> bool:
    """Whether every word that satisfies the formula has a finite beginning after which it holds whatever follows.

    Decided on the language, not on the looks. Raises FormulaTooLargeError and SpotMissingError.
    """
    vocabulary = Vocabulary.of(formula)
    encoded = vocabulary.encode(formula)
    if encoded.is_syntactic_guarantee():
        return True
    graph = _Translator.of(vocabulary).weak(encoded)
    if graph is None:
        return False
    edges = _Edges.of(graph.graph, graph.variables)
    return not edges.marks[edges.recurring()].any()


def translate(formula: Formula) -> Automaton:
    """A complete deterministic automaton of a formula, small and in a normal form.

    For an obligation it is minimal, hence the same for every way to write the formula with its atoms in the same order.

    Raises FormulaTooLargeError beyond MAX_ATOMS or MAX_TABLE, and SpotMissingError.
    """
    known = _KNOWN.get(formula)
    if known is None:
        known = _translate(formula)
        if known.successors.size <= _SMALL:
            if len(_KNOWN) >= _MOST_KNOWN:
                _KNOWN.clear()
            _KNOWN[formula] = known
    return known


def _translate(formula: Formula) -> Automaton:
    vocabulary = Vocabulary.of(formula)
    made = _Translator.of(vocabulary).deterministic(vocabulary.encode(formula))
    if made.graph.num_states() << len(vocabulary.atoms) > MAX_TABLE:
        raise _too_large()
    edges = _Edges.of(made.graph, made.variables)
    edges = edges.merged(made.graph.get_init_state_number())
    acceptance = _pairs(made.graph, edges)
    return Automaton(
        formula=formula,
        atoms=vocabulary.atoms,
        initial=0,
        successors=edges.successors,
        marks=edges.marks,
        acceptance=acceptance,
        accepting=edges.accepting,
        rejecting=edges.rejecting,
        hoa=_hoa(made, vocabulary, edges),
    )


@dataclass(frozen=True, slots=True)
class _Made:
    """A complete deterministic automaton of Spot's, and the BDD variable of each proposition."""

    graph: Any
    variables: tuple[int, ...]
    keeper: Any  # an automaton that keeps the variables allotted in order


@dataclass(frozen=True, slots=True)
class _Translator:
    """Spot with a dictionary of its own, so that no earlier call has a say in the order of variables."""

    dictionary: Any
    keeper: Any
    variables: tuple[int, ...]

    @classmethod
    def of(cls, vocabulary: Vocabulary) -> _Translator:
        spot = library()
        dictionary = spot.make_bdd_dict()
        keeper = spot.make_twa_graph(dictionary)
        return cls(dictionary, keeper, tuple(keeper.register_ap(f"p{i}") for i in range(len(vocabulary.atoms))))

    def weak(self, encoded: Any) -> _Made | None:
        """The minimal weak automaton, or None of what is no obligation."""
        graph = self._translate(encoded, "buchi", "low", _WEAK, "sbacc")
        if _is_weak(graph):
            return _Made(graph, self.variables, self.keeper)
        if encoded.is_syntactic_guarantee() or library().mp_class(encoded) in ("B", "G", "S", "O"):
            raise _too_large()  # it is one, and its determinization was given up
        return None

    def deterministic(self, encoded: Any) -> _Made:
        """A deterministic automaton of any formula."""
        weak = self.weak(encoded)
        if weak is not None:
            return weak
        graph = self._translate(encoded, "parity", "medium", _BOUNDED)
        if not library().is_deterministic(graph):
            raise _too_large()
        return _Made(graph, self.variables, self.keeper)

    def _translate(self, encoded: Any, acceptance: str, level: str, options: str, *more: str) -> Any:
        return library().translate(
            encoded, acceptance, "det", level, "complete", *more, dict=self.dictionary, xargs=options
        )


def _is_weak(graph: Any) -> bool:
    """Whether the automaton is deterministic, and all cycles of a component are accepted or none is."""
    spot = library()
    return bool(spot.is_deterministic(graph)) and bool(spot.is_weak_automaton(graph))


@dataclass(frozen=True, slots=True, eq=False)
class _Edges:
    """An automaton as tables, and the Spot states that its states stand for."""

    successors: NDArray[np.int32]  # [Q, 2 ** atoms]
    marks: NDArray[np.uint32]  # [Q, 2 ** atoms]
    accepting: NDArray[np.bool_]  # [Q]  every word is accepted from here
    rejecting: NDArray[np.bool_]  # [Q]  none is
    origin: NDArray[np.int64]  # [Q]
    number: NDArray[np.int32]  # [Spot's states]  the state that each is part of
    component: NDArray[np.int32]  # [Q]  its strongly connected component

    @classmethod
    def of(cls, graph: Any, variables: Sequence[int]) -> _Edges:
        """State by state as Spot numbers them."""
        successors, marks = _tables(graph, variables)
        states = np.arange(len(successors))
        rejecting = _empty(graph, successors)
        accepting = _empty(_complement(graph), successors)
        number = states.astype(np.int32)
        return cls(successors, marks, accepting, rejecting, states, number, _components(successors))

    def recurring(self) -> NDArray[np.bool_]:
        """[Q, 2 ** atoms] which transitions of undecided states a run may take again and again."""
        live = ~(self.accepting | self.rejecting)
        stays: NDArray[np.bool_] = live[:, None] & (self.component[:, None] == self.component[self.successors])
        return stays

    def merged(self, initial: int) -> _Edges:
        """With one state for all that accept every word and one for all that accept none, numbered breadth first,
        letters ascending. A mark stands only where a run may come again.
        """
        target = np.arange(len(self.successors), dtype=np.int32)
        for decided in (self.accepting, self.rejecting):
            target[decided] = np.flatnonzero(decided)[:1]
        successors = target[self.successors]
        decided = self.accepting | self.rejecting
        successors[decided] = target[decided][:, None]
        order = _breadth_first(successors, int(target[initial]))
        number = np.zeros(len(target), dtype=np.int32)
        number[order] = np.arange(len(order), dtype=np.int32)
        kept = number[successors[order]]
        component = _components(kept)
        recurring = component[:, None] == component[kept]
        marks = np.where(recurring & ~decided[order][:, None], self.marks[order], np.uint32(0))
        return _Edges(kept, marks, self.accepting[order], self.rejecting[order], order, number[target], component)


def _complement(graph: Any) -> Any:
    """The same automaton, accepting what it rejected."""
    spot = library()
    other = spot.make_twa_graph(graph, spot.twa_prop_set.all())
    other.prop_weak(spot.trival.maybe())
    other.set_acceptance(graph.num_sets(), graph.get_acceptance().complement())
    return other


def _empty(graph: Any, successors: NDArray[np.int32]) -> NDArray[np.bool_]:
    """[Q] from which states no word is accepted."""
    components = library().scc_info(graph)
    components.determine_unknown_acceptance()
    accepts = np.zeros(len(successors), dtype=np.bool_)
    for index in range(components.scc_count()):
        if components.is_accepting_scc(index):
            accepts[list(components.states_of(index))] = True
    while True:
        more = accepts | accepts[successors].any(axis=1)
        if (more == accepts).all():
            return ~accepts
        accepts = more


def _components(successors: NDArray[np.int32]) -> NDArray[np.int32]:
    """[Q] the strongly connected component of each state."""
    from scipy import sparse
    from scipy.sparse import csgraph

    count = len(successors)
    edges = np.unique(np.stack([np.repeat(np.arange(count), successors.shape[1]), successors.ravel()]), axis=1)
    graph = sparse.csr_array((np.ones(edges.shape[1], dtype=np.int8), (edges[0], edges[1])), shape=(count, count))
    label: NDArray[np.int32] = csgraph.connected_components(graph, directed=True, connection="strong")[1]
    return label


def _tables(graph: Any, variables: Sequence[int]) -> tuple[NDArray[np.int32], NDArray[np.uint32]]:
    """The successor of each state under each letter, and the marks on the way: [states, 2 ** atoms]."""
    import buddy  # comes with Spot

    count = len(variables)
    table = np.full((graph.num_states(), 1 << count), -1, dtype=np.int32)
    axis = {variable: count - 1 - bit for bit, variable in enumerate(variables)}  # bit 0 is the last axis
    targets: list[int] = []
    marks: list[int] = []
    for state in range(graph.num_states()):
        cube = table[state].reshape((2,) * count)
        for edge in graph.out(state):
            _fill(cube, edge.cond, len(targets), axis, [slice(None)] * count, buddy)
            targets.append(edge.dst)
            marks.append(sum(1 << mark for mark in edge.acc.sets()))
    return np.array(targets, dtype=np.int32)[table], np.array(marks, dtype=np.uint32)[table]


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


def _pairs(graph: Any, edges: _Edges) -> tuple[Pair, ...]:
    """The acceptance condition as a disjunction of pairs, without those that no undecided run can satisfy."""
    recurring = edges.recurring()
    seen = int(np.bitwise_or.reduce(edges.marks[recurring], initial=0))
    recurs = bool(recurring.any())
    pairs = []
    for part in graph.get_acceptance().to_dnf().top_disjuncts():
        infinite, finite = (sum(1 << mark for mark in marks.sets()) for marks in part.used_inf_fin_sets())
        if infinite & (infinite - 1):
            raise AssertionError("parity acceptance asks for one set at a time")
        if recurs and infinite & ~seen == 0 and not part.is_f():
            pairs.append(Pair(finite & seen, infinite))
    return tuple(dict.fromkeys(pairs))


def _hoa(made: _Made, vocabulary: Vocabulary, edges: _Edges) -> str:
    """The renumbered automaton in the HOA format, with the atoms as the names of its propositions."""
    spot = library()
    acceptance, none = made.graph.acc(), spot.mark_t([])
    again = set(np.flatnonzero(edges.recurring().any(axis=1)).tolist())
    renumbered = spot.make_twa_graph(made.graph.get_dict())
    for index in range(len(vocabulary.atoms)):
        renumbered.register_ap(f"p{index}")
    renumbered.set_acceptance(made.graph.num_sets(), made.graph.get_acceptance())
    renumbered.new_states(len(edges.origin))
    renumbered.set_init_state(0)
    for state, origin in enumerate(edges.origin.tolist()):
        if edges.accepting[state] or edges.rejecting[state]:
            renumbered.new_edge(state, state, _anything(), _deciding(acceptance, bool(edges.accepting[state])))
            continue
        leaving = [(int(edges.number[edge.dst]), edge.cond, edge.acc) for edge in made.graph.out(origin)]
        for target, condition, marks in sorted(leaving, key=itemgetter(0)):
            renumbered.new_edge(state, target, condition, marks if state in again else none)
    renumbered.prop_state_acc(made.graph.prop_state_acc())
    header = "AP: " + " ".join([str(len(vocabulary.atoms)), *map(_hoa_name, vocabulary.atoms)])
    lines = renumbered.to_str("hoa").split("\n")
    return "\n".join(header if line.startswith("AP:") else line for line in lines) + "\n"


def _deciding(acceptance: Any, accepted: bool) -> Any:
    """Marks that, seen for ever, are accepted, or are not: none or a single one, as acceptance is Büchi or parity."""
    single = [[], *([mark] for mark in range(acceptance.num_sets()))]
    marks = (library().mark_t(chosen) for chosen in single)
    return next(chosen for chosen in marks if bool(acceptance.accepting(chosen)) == accepted)


def _anything() -> Any:
    import buddy

    return buddy.bddtrue


def _hoa_name(atom: Atom) -> str:
    return '"' + atom_text(atom).replace("\\", "\\\\").replace('"', '\\"') + '"'


def _too_large() -> FormulaTooLargeError:
    return FormulaTooLargeError(
        f"the automaton of the formula is too large: more than {MAX_TABLE} transitions, or too many on the way to it"
    )

"""Markov decision processes listed state by state."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from functools import cached_property
from typing import Any, Self

import numpy as np
from numpy.typing import NDArray

from models.logic.formula import Atom
from models.world.domain import Function
from models.world.limits import MAX_EXPLICIT_OUTCOMES
from models.world.name_faults import environment_name_fault, name_fault
from models.world.phrases import readable
from models.world.report import Report
from models.world.resolution import bind_names
from models.world.specs import ExplicitSpec, TransitionSpec
from models.world.states import decode_state, encode_state
from models.world.transitions import Transitions, scaled
from models.world.verbs import denial
from models.world.vocabulary import Vocabulary
from models.world.world import Outcomes, State, Variable

_TOLERANCE = 1e-9
OBJECT = "mdp"
ATTRIBUTE = "state"


class ExplicitWorld:
    """See `World`. One variable, `state` of the object `mdp`, with the values "0", "1", ..."""

    def __init__(
        self,
        name: str,
        *,
        initial: int,
        actions: Sequence[str],
        labels: Mapping[str, NDArray[np.int64]],
        transitions: Transitions,
        vocabulary: Vocabulary | None = None,
    ) -> None:
        """A world of listed transitions; `labels` are the states in which each proposition holds, ascending.

        Nothing is checked: `read_explicit` does that for what a caller sends.
        """
        self.name = name
        self.size = len(transitions.first_choice) - 1
        self.initial = initial
        self.actions = tuple(actions)
        self.listed = transitions
        self._labels = labels
        self._vocabulary = vocabulary or vocabulary_of(labels)

    @classmethod
    def read(cls, spec: ExplicitSpec, vocabulary: Vocabulary) -> Self:
        """The world that a checked description lists."""
        actions = tuple(dict.fromkeys(transition.action for transition in spec.transitions))
        return cls(
            spec.name,
            initial=spec.initial,
            actions=actions,
            labels={name: np.unique(np.array(states, dtype=np.int64)) for name, states in spec.labels.items()},
            transitions=_listed(spec, {action: number for number, action in enumerate(actions)}),
            vocabulary=vocabulary,
        )

    @cached_property
    def variables(self) -> tuple[Variable, ...]:
        """See `World.variables`."""
        return (Variable(OBJECT, ATTRIBUTE, tuple(map(str, range(self.size)))),)

    def valid(self, states: NDArray[np.int64] | None = None) -> NDArray[np.bool_]:
        """See `World.valid`: every state is."""
        return np.ones(self.size if states is None else len(states), dtype=np.bool_)

    def encode(self, state: State, *, base: int | None = None) -> int:
        """See `World.encode`."""
        return encode_state(state, self.variables, (1,), self.initial if base is None else base)

    def decode(self, index: int) -> dict[str, dict[str, str]]:
        """See `World.decode`."""
        return decode_state(index, self.variables, (1,))

    def labels(self, atoms: Sequence[Atom], states: NDArray[np.int64] | None = None) -> NDArray[np.bool_]:
        """See `World.labels`."""
        result = np.zeros((len(atoms), self.size if states is None else len(states)), dtype=np.bool_)
        for row, atom in enumerate(atoms):
            bind_names(atom, self._vocabulary)
            members = self._labels[atom.function]
            if states is None:
                result[row, members] = True
            elif len(members):
                nearest = members[np.minimum(np.searchsorted(members, states), len(members) - 1)]
                result[row] = nearest == states
        return result

    def outcomes(self, action: int, states: NDArray[np.int64] | None = None) -> Outcomes:
        """See `World.outcomes`."""
        listed = self.listed
        wanted = np.arange(self.size, dtype=np.int64) if states is None else states
        choice = self._choices(action, wanted)
        enabled = choice >= 0
        at = np.where(enabled, choice, 0)
        count = np.where(
            enabled, listed.first_outcome[at + 1] - listed.first_outcome[at] if len(listed.action) else 0, 0
        )
        width = max(1, int(count.max(initial=0)))
        place = listed.first_outcome[at] + np.arange(width)[:, None]  # [k, n]
        happens = np.arange(width)[:, None] < count
        place = np.where(happens, place, 0)
        return Outcomes(
            enabled,
            np.where(happens, listed.probability[place], 0.0),
            np.where(happens, listed.successor[place], wanted).astype(np.int64),
        )

    def cost(self, action: int, states: NDArray[np.int64] | None = None) -> NDArray[np.float64]:
        """See `World.cost`."""
        choice = self._choices(action, np.arange(self.size, dtype=np.int64) if states is None else states)
        return np.where(choice >= 0, self.listed.cost[np.maximum(choice, 0)] if len(self.listed.cost) else 1.0, 1.0)

    def _choices(self, action: int, states: NDArray[np.int64]) -> NDArray[np.int64]:
        """The choice of an action in each state, -1 where it is not enabled."""
        if not len(self._keys):
            return np.full(len(states), -1, dtype=np.int64)
        wanted = states * len(self.actions) + action
        place = np.minimum(np.searchsorted(self._keys, wanted), len(self._keys) - 1)
        return np.where(self._keys[place] == wanted, place, -1)

    @cached_property
    def _keys(self) -> NDArray[np.int64]:
        """[C] state and action of each choice as one number, ascending."""
        owner = np.repeat(np.arange(self.size, dtype=np.int64), np.diff(self.listed.first_choice))
        return owner * len(self.actions) + self.listed.action


def vocabulary_of(labels: Iterable[str]) -> Vocabulary:
    """The labels as nullary propositions."""
    return Vocabulary((), (), {name: _proposition(name) for name in labels}, {}, {}, {})


def read_explicit(spec: ExplicitSpec, report: Report) -> Vocabulary:
    """The vocabulary (its labels as nullary propositions); faults go to the report."""
    if fault := environment_name_fault(spec.name):
        report.add(["name"], fault)
    if spec.initial >= spec.states:
        report.add(["initial"], f"there is no state {spec.initial}: states are 0 to {spec.states - 1}")
    for name, states in spec.labels.items():
        if fault := name_fault(name):
            report.add(["labels", name], fault)
        for index, state in enumerate(states):
            if not 0 <= state < spec.states:
                report.add(["labels", name, index], f"there is no state {state}: states are 0 to {spec.states - 1}")
    _read_transitions(spec, report)
    return vocabulary_of(spec.labels)


def _read_transitions(spec: ExplicitSpec, report: Report) -> None:
    seen: set[tuple[int, str]] = set()
    if sum(len(transition.to) for transition in spec.transitions) > MAX_EXPLICIT_OUTCOMES:
        report.add(["transitions"], f"there are more than {MAX_EXPLICIT_OUTCOMES} outcomes")
    for index, transition in enumerate(spec.transitions):
        path = ("transitions", index)
        if fault := name_fault(transition.action):
            report.add([*path, "action"], fault)
        if transition.source >= spec.states:
            report.add([*path, "from"], f"there is no state {transition.source}: states are 0 to {spec.states - 1}")
        if (transition.source, transition.action) in seen:
            report.add(path, f"{transition.action} in state {transition.source} is given twice")
        seen.add((transition.source, transition.action))
        for number, (state, probability) in enumerate(transition.to):
            if not (state.is_integer() and 0 <= state < spec.states):
                detail = f"there is no state {state:g}: states are 0 to {spec.states - 1}"
                report.add([*path, "to", number, 0], detail)
            if not 0 <= probability <= 1 + _TOLERANCE:
                report.add([*path, "to", number, 1], "a probability is between 0 and 1")
        total = sum(probability for _, probability in transition.to)
        if abs(total - 1) > _TOLERANCE:
            report.add([*path, "to"], f"the probabilities sum to {total:.12g}, not 1")


def _proposition(name: str) -> Function:
    says = f"{readable(name)} holds"
    return Function(name, (), says, denial(says), ())


def _listed(spec: ExplicitSpec, numbers: Mapping[str, int]) -> Transitions:
    ordered = sorted(spec.transitions, key=lambda one: (one.source, numbers[one.action]))
    merged = [_merged(transition) for transition in ordered]
    counts = np.bincount([one.source for one in ordered], minlength=spec.states) if ordered else np.zeros(spec.states)
    return Transitions(
        first_choice=_first(counts),
        action=np.array([numbers[one.action] for one in ordered], dtype=np.int32),
        cost=np.array([one.cost for one in ordered], dtype=np.float64),
        first_outcome=_first(np.array([len(chances) for chances in merged], dtype=np.int64)),
        successor=np.array([state for chances in merged for state in chances], dtype=np.int32),
        probability=np.array([chance for chances in merged for chance in chances.values()], dtype=np.float64),
    )


def _first(counts: NDArray[Any]) -> NDArray[np.int32]:
    return np.concatenate([[0], np.cumsum(counts)]).astype(np.int32)


def _merged(transition: TransitionSpec) -> dict[int, float]:
    """Successor to probability, in the order given, without impossible ones."""
    chances: dict[int, float] = {}
    for state, chance in transition.to:
        if chance > 0:
            chances[int(state)] = chances.get(int(state), 0.0) + chance
    total = sum(chances.values())
    return {state: float(scaled(np.array(chance), np.array(total))) for state, chance in chances.items()}

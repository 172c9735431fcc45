"""Markov decision processes listed state by state."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from models.logic.formula import Atom
from models.world.domain import Function
from models.world.limits import MAX_EXPLICIT_CELLS
from models.world.name_faults import environment_name_fault, name_fault
from models.world.report import Report
from models.world.resolution import bind_names
from models.world.specs import ExplicitSpec, TransitionSpec
from models.world.states import decode_state, encode_state
from models.world.vocabulary import Vocabulary
from models.world.world import Outcomes, State, Variable

_TOLERANCE = 1e-9
OBJECT = "mdp"
ATTRIBUTE = "state"


class ExplicitWorld:
    """See `World`. One variable, `state` of the object `mdp`, with the values "0", "1", ..."""

    def __init__(self, spec: ExplicitSpec, vocabulary: Vocabulary) -> None:
        self.name = spec.name
        self.size = spec.states
        self.initial = spec.initial
        self.variables = (Variable(OBJECT, ATTRIBUTE, tuple(map(str, range(spec.states)))),)
        self._vocabulary = vocabulary
        self._labels = {name: np.unique(np.array(states, dtype=np.int64)) for name, states in spec.labels.items()}
        by_action: dict[str, list[TransitionSpec]] = {}
        for transition in spec.transitions:
            by_action.setdefault(transition.action, []).append(transition)
        self.actions = tuple(by_action)
        self._outcomes = [_dense(transitions, spec.states) for transitions in by_action.values()]

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
        every = self._outcomes[action]
        if states is None:
            return every
        return Outcomes(every.enabled[states], every.probability[:, states], every.successor[:, states])


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
    functions = {name: _proposition(name) for name in spec.labels}
    return Vocabulary((), (), functions, {}, {}, {})


def _read_transitions(spec: ExplicitSpec, report: Report) -> None:
    widest: dict[str, int] = {}
    seen: set[tuple[int, str]] = set()
    for index, transition in enumerate(spec.transitions):
        path = ("transitions", index)
        widest[transition.action] = max(widest.get(transition.action, 0), len(transition.to))
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
    if spec.states * sum(widest.values()) > MAX_EXPLICIT_CELLS:
        report.add(["transitions"], f"states times outcomes of the actions exceed {MAX_EXPLICIT_CELLS}")


def _proposition(name: str) -> Function:
    spoken = name.replace("_", " ")
    return Function(name, (), f"{spoken} holds", f"{spoken} does not hold", ())


def _dense(transitions: list[TransitionSpec], size: int) -> Outcomes:
    merged = [(transition.source, _merged(transition)) for transition in transitions]
    count = max(len(chances) for _, chances in merged)
    enabled = np.zeros(size, dtype=np.bool_)
    probability = np.zeros((count, size))
    successor = np.tile(np.arange(size, dtype=np.int64), (count, 1))  # what cannot happen leads nowhere
    for source, chances in merged:
        enabled[source] = True
        for index, (state, chance) in enumerate(chances.items()):
            successor[index, source] = state
            probability[index, source] = chance
    for array in (enabled, probability, successor):
        array.flags.writeable = False
    return Outcomes(enabled, probability, successor)


def _merged(transition: TransitionSpec) -> dict[int, float]:
    """Successor to probability, in the order given, without impossible ones."""
    chances: dict[int, float] = {}
    for state, chance in transition.to:
        if chance > 0:
            chances[int(state)] = chances.get(int(state), 0.0) + chance
    return chances

"""Storm's sparse models as the data of explicit environments."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Sequence
from itertools import count
from math import inf, ulp
from typing import Any

from models.interchange.errors import PrismModelError
from models.world.limits import MAX_EXPLICIT_OUTCOMES, MAX_NAME
from models.world.name_faults import name_fault

_TOLERANCE = 1e-5  # as PRISM's: PRISM models write 0.333 and 0.667 rounded
_ROUNDOFF = 1e-12  # a sum of floats that close to 1 is left as it is
_LISTED = 5  # most probabilities in a sentence
_ROOM = 10  # characters kept for the number that tells names apart
_STEP = "step"


def explicit_data(
    model: Any, *, name: str, labels: Sequence[str], kind: str, costs: Sequence[float] | None = None
) -> dict[str, Any]:
    """The data of an environment; `labels` are those of the program in its order, `costs` of the model's choices in
    their order. Raises PrismModelError.
    """
    deadlocks = set(model.labeling.get_states("deadlock")) if "deadlock" in model.labeling.get_labels() else set()
    transitions: list[dict[str, Any]] = []
    first = 0  # choice of the state
    for state in model.states:
        actions = list(state.actions)
        paid = None if costs is None else costs[first : first + len(actions)]
        first += len(actions)
        if state.id in deadlocks and len(actions) == 1 and not _named(actions[0]):
            continue  # the loop that Storm adds
        names = [_STEP] if kind == "DTMC" else _names([_named(action) for action in actions])
        for place, (action, chosen) in enumerate(zip(actions, names, strict=True)):
            cost = {} if paid is None or paid[place] == 1 else {"cost": paid[place]}
            transitions.append({"from": state.id, "action": chosen, **cost, "to": _outcomes(action, state.id, chosen)})
    _check_outcomes(model.nr_states, transitions)
    (initial,) = model.initial_states
    return {
        "name": name,
        "kind": "explicit",
        "states": model.nr_states,
        "initial": initial,
        "labels": {valid: sorted(model.labeling.get_states(label)) for label, valid in _propositions(labels).items()},
        "transitions": transitions,
    }


def costs_of(model: Any, structure: str, *, wanted: bool) -> list[float] | None:
    """What each choice costs by a reward structure of the model; where that is not positive and finite everywhere,
    None, or if it is `wanted` all the same, PrismModelError.
    """
    rewards = model.reward_models[structure]
    of_states = list(rewards.state_rewards) if rewards.has_state_rewards else [0.0] * model.nr_states
    of_choices = list(rewards.state_action_rewards) if rewards.has_state_action_rewards else [0.0] * model.nr_choices
    owner = [state.id for state in model.states for _ in state.actions]
    deadlocks = set(model.labeling.get_states("deadlock")) if "deadlock" in model.labeling.get_labels() else set()
    costs = [_rounded(of_states[state] + choice) for state, choice in zip(owner, of_choices, strict=True)]
    for state, cost in zip(owner, costs, strict=True):
        if state not in deadlocks and not 0 < cost < inf:
            if wanted:
                name = structure or "without a name"
                raise PrismModelError(f"costs are positive, but in state {state} the rewards {name} are {cost:g}")
            return None
    return costs


def _named(action: Any) -> str:
    """The action's label, "" for none."""
    return "_".join(sorted(action.labels))


def _names(given: Sequence[str]) -> list[str]:
    """A name for each choice of one state, all different, in the order of the choices; "" is a choice without one."""
    unnamed = count(0)
    used: set[str] = set()
    names = []
    for name in given:
        if name:
            names.append(_fresh(name, given, used))
        else:
            names.append(next(chosen for n in unnamed if (chosen := f"choice{n}") not in given))
        used.add(names[-1])
    return names


def _fresh(name: str, given: Collection[str], used: Collection[str], *, valid: bool = True) -> str:
    """The name, or one like it that is neither used nor given to something else."""
    short = name[: MAX_NAME - _ROOM]
    if valid and short == name and name not in used:
        return name
    return next(chosen for n in count(2) if (chosen := f"{short}_{n}") not in used and chosen not in given)


def _outcomes(action: Any, state: int, name: str) -> list[list[float]]:
    """Successors and probabilities, which sum to 1 as nearly as floats can."""
    pairs = [(entry.column, _rounded(entry.value)) for entry in action.transitions]
    total = sum(chance for _, chance in pairs)
    if not (abs(total - 1) <= _TOLERANCE and min(chance for _, chance in pairs) >= 0):  # also where it is no number
        shown = ", ".join(f"{chance:.6g}" for _, chance in pairs[:_LISTED])
        raise PrismModelError(
            f"the probabilities of {name} in state {state} are not between 0 and 1 with the sum 1, but {shown}"
        )
    scale = total if abs(total - 1) > _ROUNDOFF else 1.0
    return [[target, chance / scale] for target, chance in pairs if chance > 0]


def _rounded(value: float) -> float:
    """The decimal of 15 digits if it is next to the value: Storm makes 0.39999999999999997 of 0.4."""
    short = float(f"{value:.15g}")
    return short if abs(short - value) <= ulp(value) else value


def _propositions(labels: Collection[str]) -> dict[str, str]:
    """Each label with the proposition that it becomes: itself if the name is valid."""
    used: set[str] = set()
    found = {}
    for label in labels:
        found[label] = _fresh(label, labels, used, valid=name_fault(label) is None)
        used.add(found[label])
    return found


def _check_outcomes(states: int, transitions: Iterable[dict[str, Any]]) -> None:
    outcomes = sum(len(transition["to"]) for transition in transitions)
    if outcomes > MAX_EXPLICIT_OUTCOMES:
        raise PrismModelError(
            f"the model has {states} states with {outcomes} outcomes; the limit is {MAX_EXPLICIT_OUTCOMES}"
        )

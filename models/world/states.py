"""States by name and by number."""

from __future__ import annotations

from models.world.errors import StateError
from models.world.names import hint
from models.world.report import Report
from models.world.world import State, Variable


def encode_state(state: State, variables: tuple[Variable, ...], strides: tuple[int, ...], base: int) -> int:
    """The index of `base` with the named attributes changed. Raises StateError with every wrong place."""
    by_object: dict[str, dict[str, int]] = {}
    for position, variable in enumerate(variables):
        by_object.setdefault(variable.object, {})[variable.attribute] = position
    report = Report(what="the state", refusal=StateError)
    index = base
    for name, attributes in state.items():
        if name not in by_object:
            report.add([name], f"there is no object {name} with a state{hint(name, by_object)}")
            continue
        for attribute, value in attributes.items():
            if attribute not in by_object[name]:
                fix = hint(attribute, by_object[name])
                report.add([name, attribute], f"{name} has no state attribute {attribute}{fix}")
                continue
            position = by_object[name][attribute]
            values, stride = variables[position].values, strides[position]
            if value not in values:
                report.add([name, attribute], f"{attribute} of {name} cannot be {value}{hint(value, values)}")
                continue
            index += (values.index(value) - index // stride % len(values)) * stride
    report.close()
    return index


def decode_state(index: int, variables: tuple[Variable, ...], strides: tuple[int, ...]) -> dict[str, dict[str, str]]:
    """object -> attribute -> value of an index."""
    state: dict[str, dict[str, str]] = {}
    for variable, stride in zip(variables, strides, strict=True):
        values = variable.values
        state.setdefault(variable.object, {})[variable.attribute] = values[int(index) // stride % len(values)]
    return state

"""States by name and by number."""

from __future__ import annotations

from models.errors import Place
from models.world.errors import StateError
from models.world.names import hint
from models.world.report import pointer
from models.world.world import State, Variable

_SHOWN = 50


def encode_state(state: State, variables: tuple[Variable, ...], strides: tuple[int, ...], base: int) -> int:
    """The index of `base` with the named attributes changed. Raises StateError with every wrong place."""
    by_object: dict[str, dict[str, int]] = {}
    for position, variable in enumerate(variables):
        by_object.setdefault(variable.object, {})[variable.attribute] = position
    index, places = base, list[Place]()
    for name, attributes in state.items():
        if name not in by_object:
            places.append(Place(pointer((name,)), f"there is no object {name} with a state{hint(name, by_object)}"))
            continue
        for attribute, value in attributes.items():
            path = pointer((name, attribute))
            if attribute not in by_object[name]:
                fix = hint(attribute, by_object[name])
                places.append(Place(path, f"{name} has no state attribute {attribute}{fix}"))
                continue
            position = by_object[name][attribute]
            values, stride = variables[position].values, strides[position]
            if value not in values:
                places.append(Place(path, f"{attribute} of {name} cannot be {value}{hint(value, values)}"))
                continue
            index += (values.index(value) - index // stride % len(values)) * stride
    if places:
        more = f" (and {len(places) - 1} more)" if len(places) > 1 else ""
        raise StateError(f"not a state of this world: {places[0].detail}{more}", places=places[:_SHOWN])
    return index


def decode_state(index: int, variables: tuple[Variable, ...], strides: tuple[int, ...]) -> dict[str, dict[str, str]]:
    """object -> attribute -> value of an index."""
    state: dict[str, dict[str, str]] = {}
    for variable, stride in zip(variables, strides, strict=True):
        values = variable.values
        state.setdefault(variable.object, {})[variable.attribute] = values[int(index) // stride % len(values)]
    return state

"""Models in the PRISM language as explicit environments, read with Storm."""

from __future__ import annotations

import tempfile
from collections.abc import Mapping, Sequence
from fractions import Fraction
from pathlib import Path
from typing import Any

from models.interchange.errors import PrismConstantError, PrismModelError
from models.interchange.extraction import costs_of, explicit_data
from models.interchange.rewards import COSTS
from models.interchange.storm import bounded, model_error, sentence, silent, storm, syntax_error
from models.world.limits import MAX_EXPLICIT_STATES

Constant = bool | int | float | str
_READ = ("MDP", "DTMC")
_LISTED = 5  # most initial states or constants named in a sentence


def read_prism(
    source: str | Path,
    *,
    name: str | None = None,
    constants: Mapping[str, Constant] | None = None,
    rewards: str | None = None,
    timeout_s: int | None = None,
) -> dict[str, Any]:
    """The reachable part of a PRISM model, as the data of an `explicit` environment (see docs/worlds.md).

    `source` is the text, or the Path of a file, after which the environment is named unless `name` is given.
    `constants` gives the constants that the model leaves open, also as text (`"0.5"`, `"true"`). Labels become
    propositions, actions keep their names: commands without one are `choice0`, `choice1`, ... in each state, a second
    choice of the same name gets `_2`; the steps of a DTMC are all called `step`. A state in which the model deadlocks
    has no action. Probabilities are scaled to sum to 1.

    Rewards of a state and of a choice in it together become what the choice costs: those of the structure `rewards`,
    by default of `costs` or, without one, of the only structure there is. Costs are positive. A structure that is not
    so everywhere is refused where it was asked for, and left out by default.

    With `timeout_s` Storm stops after so many seconds (main thread only): a model may have far too many states.

    Raises StormMissingError, PrismSyntaxError, PrismConstantError, PrismModelError.
    """
    stormpy = storm()
    text = _text(source)
    with silent(stormpy), bounded(stormpy, timeout_s):
        program = _parsed(stormpy, text)
        kind = _kind(program)
        program = _instantiated(stormpy, program, constants or {})
        structure = _structure(program, rewards)
        model = _built(stormpy, program, timeout_s, rewards=structure is not None)
        default = source.stem if isinstance(source, Path) else "prism"
        return explicit_data(
            model,
            name=default if name is None else name,
            labels=_labels(program),
            kind=kind,
            costs=None if structure is None else costs_of(model, structure, wanted=rewards is not None),
        )


def _text(source: str | Path) -> str:
    if isinstance(source, str):
        return source
    try:
        return source.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        reason = error.strerror if isinstance(error, OSError) else "it is not UTF-8"
        raise PrismModelError(f"cannot read {source}: {reason}") from error


def _parsed(stormpy: Any, text: str) -> Any:
    with tempfile.TemporaryDirectory() as folder:  # Storm reads files only
        file = Path(folder) / "model.prism"
        file.write_text(text, encoding="utf-8")
        try:
            # Simplified, variables that never change become constants, and Storm dies of a division by one that is 0.
            return stormpy.parse_prism_program(file, prism_compatibility=True, simplify=False)
        except (RuntimeError, stormpy.exceptions.StormError) as error:
            raise syntax_error(error, text) from None


def _kind(program: Any) -> str:
    """Raises PrismModelError for a model that is neither an MDP nor a DTMC."""
    try:
        kind = str(program.model_type.name)
    except ValueError:  # stormpy has no name for it
        kind = "PTA or SMG"
    if kind not in _READ:
        raise PrismModelError(f"the model is of type {kind}; only MDP and DTMC can be read")
    return kind


def _instantiated(stormpy: Any, program: Any, constants: Mapping[str, Constant]) -> Any:
    open_ = {str(constant.name): constant.type for constant in program.get_undefined_constants()}
    unknown = [name for name in constants if name not in open_]
    if unknown:
        known = f"open are {_listed(list(open_))}" if open_ else "the model leaves none open"
        raise PrismConstantError(f"no constant {unknown[0]} is to be given: {known}")
    missing = [name for name in open_ if name not in constants]
    if missing:
        raise PrismConstantError(f"the model leaves constants open; give a value to {_listed(missing)}")
    values = {name: _constant(stormpy, name, open_[name], value) for name, value in constants.items()}
    if not values:
        return program
    try:
        return stormpy.instantiate_constants(program, values)[0]
    except (RuntimeError, stormpy.exceptions.StormError) as error:
        raise PrismConstantError(f"the constants cannot be given these values: {sentence(error)}") from None


def _constant(stormpy: Any, name: str, type_: Any, value: Constant) -> Any:
    """The value in the type that the constant is declared with."""
    text = str(value).strip()
    try:
        if type_.is_boolean:
            return {"true": True, "false": False}[text.lower()]
        if isinstance(value, bool):
            raise ValueError
        return int(text) if type_.is_integer else stormpy.Rational(str(Fraction(text)))
    except (KeyError, ValueError, ZeroDivisionError):
        wanted = "true or false" if type_.is_boolean else "a whole number" if type_.is_integer else "a number"
        raise PrismConstantError(f"the constant {name} is {wanted}, not {text[:40]}") from None


def _structure(program: Any, wanted: str | None) -> str | None:
    """The reward structure that has the costs, if any. Raises PrismModelError where the one `wanted` is not there."""
    names = [str(structure.name) for structure in program.reward_models]
    if wanted is not None:
        if wanted not in names:
            known = f"it has {_listed([name or '(unnamed)' for name in names])}" if names else "it has none"
            raise PrismModelError(f"the model has no reward structure {wanted}: {known}")
        return wanted
    if COSTS in names:
        return COSTS
    return names[0] if len(names) == 1 else None


def _built(stormpy: Any, program: Any, timeout_s: int | None, *, rewards: bool) -> Any:
    """The sparse model; raises PrismModelError."""
    options = stormpy.BuilderOptions()
    options.set_build_all_labels()
    options.set_build_choice_labels()
    options.set_build_all_reward_models(rewards)
    options.set_add_out_of_bounds_state()  # without it Storm wraps such values silently
    try:
        model = stormpy.build_model(program, options=options)
        if "out_of_bounds" in model.labeling.get_labels():
            _complain_of_bounds(stormpy, program)
    except (RuntimeError, stormpy.exceptions.StormError) as error:
        raise model_error(error, timeout_s) from None
    if model.nr_states > MAX_EXPLICIT_STATES:
        raise PrismModelError(f"the model has {model.nr_states} states; the limit is {MAX_EXPLICIT_STATES}")
    initial = list(model.initial_states)
    if len(initial) != 1:
        raise PrismModelError(f"the model has {len(initial)} initial states; give it one")
    return model


def _complain_of_bounds(stormpy: Any, program: Any) -> None:
    """Storm's checks name the update, but refuse sums of probabilities that are 1 up to rounding too."""
    options = stormpy.BuilderOptions()
    options.set_exploration_checks()
    stormpy.build_model(program, options=options)
    raise RuntimeError("an update leaves the range of a variable")


def _labels(program: Any) -> list[str]:
    return [str(label.name) for label in program.labels]


def _listed(names: Sequence[str]) -> str:
    shown = ", ".join(names[:_LISTED])
    return shown if len(names) <= _LISTED else f"{shown} and {len(names) - _LISTED} more"

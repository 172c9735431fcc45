"""Environments as models in the PRISM language (https://www.prismmodelchecker.org/manual/ThePRISMLanguage)."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from models.interchange.errors import ExportTooLargeError
from models.interchange.grounded import Command, GroundedModel, Update
from models.interchange.names import label_names
from models.interchange.prism_explicit import explicit_body
from models.interchange.rendering import MAX_CHARACTERS
from models.interchange.rewards import costs_of_actions, reward_lines
from models.logic import Atom, atom_text
from models.world import Environment
from models.world.oomdp import OomdpWorld
from models.world.resolution import bind_names


def prism_model(environment: Environment, *, atoms: Sequence[Atom] = ()) -> str:
    """The environment as one PRISM module of an mdp, with the same states, choices and probabilities.

    A state attribute is a bounded integer, an applied action a command, each atom a label (`label_names` says which)
    and the reward structure `steps` counts actions; where some cost other than 1, `costs` has what they cost.
    Parameters of the domain stay constants of the file; outcomes that their values make impossible are left out, so a
    parameter that was 0 needs a new export to become positive.
    Where no action is possible the command `stay` changes nothing for ever. Comments give the original names.

    Raises ExportTooLargeError, and UnknownPropositionError, UnknownObjectError or TypeMismatchError for an atom that
    is not of the environment.
    """
    world = environment.world
    origin = f"environment of the domain {environment.domain}" if environment.domain else "explicit environment"
    head = [f"// {environment.name}: {origin}, written by cqltl", "mdp"]
    if isinstance(world, OomdpWorld):
        parts = _oomdp_body(environment, world, GroundedModel(world), atoms)
    else:
        parts = explicit_body(world, atoms)
    text = "\n".join([*head, *parts]) + "\n"
    if len(text) > MAX_CHARACTERS:
        raise ExportTooLargeError(f"the PRISM text would have more than {MAX_CHARACTERS} characters")
    return text


def _oomdp_body(
    environment: Environment, world: OomdpWorld, model: GroundedModel, atoms: Sequence[Atom]
) -> Iterator[str]:
    yield from _constants(model)
    yield ""
    yield f"module {model.module}"
    yield from _variables(model)
    yield ""
    commands = model.commands()
    for command in commands:
        yield from _command(model, command)
    stuck = model.stuck(commands)
    if stuck is not None:
        yield f"  [{model.stay}] {model.write.condition(stuck)} -> true; // where nothing is possible"
    yield "endmodule"
    if atoms:
        yield ""
    for atom, label in label_names(atoms).items():
        condition = model.proposition(atom.function, bind_names(atom, environment.vocabulary))
        yield f'label "{label}" = {model.write.condition(condition)}; // {atom_text(atom)}'
    costs = [f"[{command.identifier}] true : {model.write.number(command.cost)}" for command in commands]
    if stuck is not None:
        costs.append(f"[{model.stay}] true : 1")
    yield from reward_lines(costs if (costs_of_actions(world) != 1).any() else [])


def _constants(model: GroundedModel) -> Iterator[str]:
    if model.parameters:
        yield ""
    for name, identifier in model.parameters.items():
        yield f"const double {identifier} = {model.parameter_text(name)};{_comment(name, identifier)}"
    if model.digit_names:
        yield ""
    for (name, digit), identifier in model.digit_names.items():
        yield f"const int {identifier} = {digit};{_comment(name, identifier)}"


def _variables(model: GroundedModel) -> Iterator[str]:
    for position, identifier in model.identifiers.items():
        variable = model.model.variables[position]
        original = f"{variable.owner.name}.{variable.attribute}"
        start = model.write.digits[position][model.model.initial[position]]
        yield f"  {identifier} : [0..{len(variable.values) - 1}] init {start}; // {original}"
    if not model.identifiers:
        yield "  nothing : bool init false; // the world has one state only"


def _command(model: GroundedModel, command: Command) -> Iterator[str]:
    start = f"  [{command.identifier}] {model.write.condition(command.guard)} ->"
    note = _comment(command.name, command.identifier)
    texts = [_update(model, update) for update in command.updates]
    if len(texts) == 1 and command.certain:
        yield f"{start} {texts[0]};{note}"
        return
    yield f"{start}{note}"
    for index, (update, text) in enumerate(zip(command.updates, texts, strict=True)):
        end = ";" if index == len(texts) - 1 else " +"
        yield f"    {model.write.number(update.probability, 1)} : {text}{end}"


def _update(model: GroundedModel, update: Update) -> str:
    assignments = [f"({model.identifiers[p]}' = {text})" for p, text in update.assignments.items()]
    return " & ".join(assignments) or "true"


def _comment(name: str, identifier: str) -> str:
    return f" // {name}" if name != identifier else ""

"""An OO-MDP environment grounded for the PRISM language: identifiers, commands, updates."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from itertools import product

from models.interchange.conditions import FALSE, Condition, Joined, Member
from models.interchange.names import Identifiers, number_text
from models.interchange.rendering import Renderer
from models.interchange.translation import Translator
from models.interchange.truth import always, variables
from models.interchange.values import Constant, Entity, Known, Lookup, Number, compare, literal, restrict
from models.world.domain import Action, Outcome
from models.world.model import Model
from models.world.names import NONE, application
from models.world.oomdp import OomdpWorld
from models.world.vocabulary import Symbol

_NEGLIGIBLE = 1e-15  # as in models.world.actions


@dataclass(frozen=True, slots=True)
class Update:
    """An outcome: position of a variable to the expression of its new digit."""

    probability: Number
    assignments: Mapping[int, str]


@dataclass(frozen=True, slots=True)
class Command:
    """An action with its arguments."""

    name: str
    identifier: str
    guard: Condition
    updates: tuple[Update, ...]
    cost: Number

    @property
    def certain(self) -> bool:
        """Whether there is one outcome, of probability 1."""
        chance = self.updates[0].probability
        return len(self.updates) == 1 and isinstance(chance, Constant) and chance.value == 1


class GroundedModel:
    """The parts of a PRISM module, with all identifiers chosen.

    Variables with one value only are no variables of the module.
    """

    def __init__(self, world: OomdpWorld) -> None:
        self.actions = frozenset(world.actions)
        self.model: Model = world.model  # the world has no public way to its expressions
        model, names = self.model, Identifiers()
        self.parameters = {name: names.new(name) for name in model.parameters}
        self.radix = [len(variable.values) for variable in model.variables]
        changing = [position for position, count in enumerate(self.radix) if count > 1]
        self.digit_names = self._digit_names(changing, names)
        self.identifiers = {
            p: names.new(f"{model.variables[p].owner.name}_{model.variables[p].attribute}") for p in changing
        }
        self.module, self.stay = names.new("world"), ""
        self._names = names
        self.translator = Translator(model, self.parameters)
        spelled = [[self._digit_name(value, digit) for digit, value in enumerate(v.values)] for v in model.variables]
        self.write = Renderer([self.identifiers.get(p, "") for p in range(len(self.radix))], spelled)
        self._digits = [{value: digit for digit, value in enumerate(v.values)} for v in model.variables]
        self._constraints = [self.translator.condition(text, {}) for text in model.domain.constraints]
        self._legal = self.translator.make.join(True, self._constraints)

    def parameter_text(self, name: str) -> str:
        """The value of a parameter."""
        return number_text(float(self.model.parameters[name]))

    def proposition(self, function: str, symbols: Sequence[Symbol]) -> Condition:
        """Where a propositional function holds of some symbols."""
        return self.translator.proposition(function, symbols)

    def commands(self) -> list[Command]:
        """The actions that are possible somewhere, in the order of the world's."""
        found = []
        for action in self.model.domain.actions:
            choices = [self.translator.members(argument.kinds) for argument in action.arguments]
            for chosen in product(*choices):
                name = application(action.name, (symbol.name for symbol in chosen))
                binding = {argument.name: s for argument, s in zip(action.arguments, chosen, strict=True)}
                command = self._command(action, name, binding) if name in self.actions else None
                if command is not None:
                    found.append(command)
        self.stay = self._names.new("stay")
        return found

    def stuck(self, commands: Sequence[Command]) -> Condition | None:
        """Where no command is possible, or None if there is no such legal state."""
        make = self.translator.make
        stuck = make.join(True, [make.negate(command.guard) for command in commands])
        nowhere = stuck is FALSE or always(make.negate(make.conjoin(self._legal, stuck)), self.radix)
        return None if nowhere else stuck

    def _command(self, action: Action, name: str, binding: Mapping[str, Symbol]) -> Command | None:
        scope = {argument: Known(symbol) for argument, symbol in binding.items()}
        make = self.translator.make
        guard = self.translator.condition(action.guard, scope)
        happening = []
        for outcome in action.outcomes:
            probability = self.translator.number(outcome.probability, scope)
            if isinstance(probability, Constant) and abs(probability.value) < _NEGLIGIBLE:
                continue
            changes = self._changes(outcome, binding, scope)
            for after in self._kept(changes):
                idle = make.negate(compare(make, ">", probability, literal(0.0)))
                kept = make.disjoin(idle, after)
                if not always(make.disjoin(make.negate(make.conjoin(self._legal, guard)), kept), self.radix):
                    guard = make.conjoin(guard, kept)
            happening.append((probability, changes))
        if guard is FALSE:
            return None
        known = _known(guard)
        updates = tuple(Update(probability, self._assignments(changes, known)) for probability, changes in happening)
        return Command(name, self._names.new(name), guard, updates, self.translator.number(action.cost, {}))

    def _changes(
        self, outcome: Outcome, binding: Mapping[str, Symbol], scope: Mapping[str, Known]
    ) -> dict[int, Entity]:
        changes: dict[int, Entity] = {}
        for effect in outcome.effects:
            owner = binding.get(effect.owner) or self.model.objects[effect.owner]
            position = self.translator.positions[owner, effect.attribute]
            changes[position] = self.translator.entity(effect.value, scope)
        return changes

    def _kept(self, changes: Mapping[int, Entity]) -> Iterable[Condition]:
        """Where each constraint that the changes touch holds after them."""
        after = self.translator.overriding(changes)
        for text, before in zip(self.model.domain.constraints, self._constraints, strict=True):
            if not variables(before).isdisjoint(changes):
                yield after.condition(text, {})

    def _assignments(self, changes: Mapping[int, Entity], known: Mapping[int, int]) -> dict[int, str]:
        assignments = {}
        for position, entity in changes.items():
            if position not in self.identifiers or _is_unchanged(position, entity, self.model):
                continue
            value = restrict(self.translator.make, entity, known)
            text = self.write.assignment(position, value, self._digits[position])
            if text not in (None, self.identifiers[position]):
                assignments[position] = str(text)
        return assignments

    def _digit_names(self, changing: Sequence[int], names: Identifiers) -> dict[tuple[str, int], str]:
        """Name of a value and its digit to a constant; the digit is part of it where it is not always the same."""
        places: dict[str, set[int]] = {}
        for position in changing:
            for digit, value in enumerate(self.model.variables[position].values):
                places.setdefault(value.name if value else NONE, set()).add(digit)
        return {
            (name, digit): names.new(name if len(digits) == 1 else f"{name}_{digit}")
            for name, digits in places.items()
            for digit in sorted(digits)
        }

    def _digit_name(self, value: Symbol | None, digit: int) -> str:
        return self.digit_names.get((value.name if value else NONE, digit), str(digit))


def _known(guard: Condition) -> dict[int, int]:
    """The digits that a guard leaves to variables."""
    parts = guard.operands if isinstance(guard, Joined) and guard.conjunctive else (guard,)
    return {part.position: part.digits for part in parts if isinstance(part, Member)}


def _is_unchanged(position: int, entity: Entity, model: Model) -> bool:
    own = model.variables[position].values
    return isinstance(entity, Lookup) and entity.position == position and entity.symbols == own

"""From the shape of an OO-MDP environment to a Model and a Vocabulary."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass, field, replace

from models.world.domain import Domain
from models.world.domain_reader import read_values
from models.world.grid import Grid, read_grid
from models.world.limits import MAX_OBJECTS, MAX_SYNONYMS, MAX_VALUES, MAX_VARIABLES
from models.world.model import Model, StateAttribute
from models.world.name_faults import environment_name_fault, name_fault
from models.world.names import NONE, hint, listing
from models.world.report import Report
from models.world.specs import ObjectSpec, OomdpSpec
from models.world.vocabulary import Symbol, Vocabulary

_COMPASS = ("north", "south", "east", "west")


def read_environment(spec: OomdpSpec, domain: Domain, report: Report) -> tuple[Model, Vocabulary] | None:
    """Model and vocabulary, or None after adding every fault found to the report."""
    return _Reader(spec, domain, report).read()


@dataclass(slots=True)
class _Reader:
    spec: OomdpSpec
    domain: Domain
    report: Report
    objects: dict[str, Symbol] = field(default_factory=dict)
    values: tuple[Symbol, ...] = ()
    members: dict[str, list[Symbol]] = field(default_factory=dict)
    static: dict[Symbol, dict[str, Symbol]] = field(default_factory=dict)
    grid: Grid | None = None

    def read(self) -> tuple[Model, Vocabulary] | None:
        if fault := environment_name_fault(self.spec.name):
            self.report.add(["name"], fault)
        parameters = self._parameters()
        self._values()
        neighbours = self._objects()
        if self.report.places:
            return None
        self._index()
        self._static(neighbours)
        variables = self._variables()
        initial = self._initial(variables)
        if self.report.places:
            return None
        symbols = (*self.objects.values(), *self.values)
        model = Model(
            self.spec.name,
            self.domain,
            parameters,
            symbols,
            self.objects,
            self.static,
            variables,
            tuple(initial),
            self.grid,
        )
        return model, self._vocabulary()

    def _parameters(self) -> dict[str, float]:
        declared = self.domain.parameters
        for name, value in self.spec.parameters.items():
            if name not in declared:
                self.report.add(["parameters", name], f"the domain has no parameter {name}{hint(name, declared)}")
            elif not declared[name].minimum <= value <= declared[name].maximum:
                low, high = declared[name].minimum, declared[name].maximum
                self.report.add(["parameters", name], f"{name} must be between {low:g} and {high:g}, not {value:g}")
        return {name: self.spec.parameters.get(name, parameter.default) for name, parameter in declared.items()}

    def _values(self) -> None:
        listed: list[Symbol] = []
        known = self.domain.attributes
        for kind in self.spec.values:
            if kind not in known:
                self.report.add(["values", kind], f"the domain has no attribute type {kind}{hint(kind, known)}")
        for kind, values in known.items():
            more = read_values(self.spec.values.get(kind, []), ("values", kind), self.report)
            listed += [Symbol(kind, value) for value in dict.fromkeys((*values, *more))]
        if len(listed) > MAX_VALUES:
            self.report.add(["values"], f"at most {MAX_VALUES} attribute values")
        self.values = tuple(listed)

    def _objects(self) -> Mapping[str, Mapping[str, str]]:
        classes = self.domain.classes
        self.objects = {name: Symbol(kind, name) for name, kind in self.domain.constants.items()}
        neighbours: Mapping[str, Mapping[str, str]] = {}
        if self.spec.grid is not None:
            neighbours = self._grid()
        for name, spec in self.spec.objects.items():
            self._object(name, spec)
        if len(self.objects) > MAX_OBJECTS:
            self.report.add(["objects"], f"at most {MAX_OBJECTS} objects, the grid's cells included")
        order = {kind: index for index, kind in enumerate(classes)}
        if not self.report.places:
            self.objects = dict(sorted(self.objects.items(), key=lambda item: order[item[1].kind]))
        return neighbours

    def _grid(self) -> Mapping[str, Mapping[str, str]]:
        grid = self.spec.grid
        assert grid is not None
        declared = self.domain.classes.get(grid.class_)
        if declared is None:
            known = self.domain.classes
            self.report.add(["grid", "class"], f"the domain has no class {grid.class_}{hint(grid.class_, known)}")
            return {}
        missing = [d for d in _COMPASS if grid.class_ not in declared.static.get(d, ())]
        if missing:
            self.report.add(["grid", "class"], f"{grid.class_} needs static {listing(missing, 'and')}: {grid.class_}")
        self.grid = read = read_grid(grid, self.report)
        for name in read.cells:
            if name in self.objects and self.objects[name].kind != grid.class_:  # a constant may be a cell
                self.report.add(["grid"], f"{name} is a {self.objects[name].kind} of the domain already")
            self.objects[name] = Symbol(grid.class_, name)
        return read.neighbours

    def _object(self, name: str, spec: ObjectSpec) -> None:
        path = ("objects", name)
        if fault := name_fault(name):
            self.report.add(path, fault)
        if spec.class_ not in self.domain.classes:
            known = self.domain.classes
            self.report.add([*path, "class"], f"the domain has no class {spec.class_}{hint(spec.class_, known)}")
        elif name in self.objects and self.objects[name].kind != spec.class_:
            self.report.add([*path, "class"], f"{name} is a {self.objects[name].kind} already")
        if len(spec.synonyms) > MAX_SYNONYMS:
            self.report.add([*path, "synonyms"], f"at most {MAX_SYNONYMS} synonyms")
        for index, synonym in enumerate(spec.synonyms[:MAX_SYNONYMS]):
            if fault := name_fault(synonym):
                self.report.add([*path, "synonyms", index], fault)
        self.objects.setdefault(name, Symbol(spec.class_, name))

    def _index(self) -> None:
        for symbol in (*self.objects.values(), *self.values):
            self.members.setdefault(symbol.kind, []).append(symbol)

    def _range(self, kinds: tuple[str, ...]) -> dict[str, Symbol | None]:
        """Value name to symbol; `none` where the kinds allow it. Homonyms keep the first."""
        found: dict[str, Symbol | None] = {}
        for kind in kinds:
            if kind == NONE:
                found[NONE] = None
            for symbol in self.members.get(kind, ()):
                found.setdefault(symbol.name, symbol)
        return found

    def _static(self, neighbours: Mapping[str, Mapping[str, str]]) -> None:
        ranges: dict[tuple[str, ...], dict[str, Symbol | None]] = {}
        for name, symbol in self.objects.items():
            declared = self.domain.classes[symbol.kind].static
            spec = self.spec.objects.get(name)
            given = {**neighbours.get(name, {}), **(spec.attributes if spec else {})}
            for attribute, value in given.items():
                path = ("objects", name, "attributes", attribute)
                if attribute not in declared:
                    self.report.add(
                        path, f"{symbol.kind} has no static attribute {attribute}{hint(attribute, declared)}"
                    )
                    continue
                kinds = declared[attribute]
                if kinds not in ranges:
                    ranges[kinds] = self._range(kinds)
                allowed = ranges[kinds]
                if value not in allowed and value != NONE:
                    self.report.add(path, f"{attribute} must be {listing(kinds)}, not {value}{hint(value, allowed)}")
                elif found := allowed.get(value):
                    self.static.setdefault(symbol, {})[attribute] = found

    def _variables(self) -> tuple[StateAttribute, ...]:
        ranges: dict[tuple[str, ...], tuple[Symbol | None, ...]] = {}
        variables: list[StateAttribute] = []
        for name, symbol in self.objects.items():
            for attribute, kinds in self.domain.classes[symbol.kind].state.items():
                if kinds not in ranges:
                    ranges[kinds] = self._distinct(kinds, attribute)
                if not ranges[kinds]:
                    self.report.add(["objects"], f"{attribute} of {name} has no possible value: no {listing(kinds)}")
                variables.append(StateAttribute(symbol, attribute, ranges[kinds]))
        if len(variables) > MAX_VARIABLES:
            self.report.add(["objects"], f"the objects have more than {MAX_VARIABLES} state attributes together")
        return tuple(variables)

    def _distinct(self, kinds: tuple[str, ...], attribute: str) -> tuple[Symbol | None, ...]:
        named = self._range(kinds)
        owners = Counter(symbol.name for kind in kinds for symbol in self.members.get(kind, ()))
        for name, count in owners.items():
            if count > 1:
                homonyms = listing((kind for kind in kinds if Symbol(kind, name) in self.members.get(kind, ())), "and")
                self.report.add(["objects"], f"{attribute} may be two things called {name}: {homonyms}")
        return tuple(named.values())

    def _initial(self, variables: tuple[StateAttribute, ...]) -> list[int]:
        known: dict[str, dict[str, StateAttribute]] = {}
        for variable in variables:
            known.setdefault(variable.owner.name, {})[variable.attribute] = variable
        for name, attributes in self.spec.state.items():
            if name not in self.objects:
                self.report.add(["state", name], f"there is no object {name}{hint(name, known)}")
                continue
            for attribute in attributes:
                if attribute not in known.get(name, {}):
                    fix = hint(attribute, known.get(name, {}))
                    self.report.add(["state", name, attribute], f"{name} has no state attribute {attribute}{fix}")
        ranges = {id(variable.values): variable.values for variable in variables}  # few tuples, shared by many
        digits = {
            key: {value.name if value else NONE: digit for digit, value in enumerate(values)}
            for key, values in ranges.items()
        }
        return [self._digit(variable, digits[id(variable.values)]) for variable in variables]

    def _digit(self, variable: StateAttribute, digits: Mapping[str, int]) -> int:
        owner, attribute = variable.owner.name, variable.attribute
        given = self.spec.state.get(owner, {}).get(attribute)
        if given is not None and given in digits:
            return digits[given]
        if given is not None:
            self.report.add(
                ["state", owner, attribute], f"{attribute} of {owner} cannot be {given}{hint(given, digits)}"
            )
        elif owner in self.spec.state:
            self.report.add(["state", owner], f"the initial value of {attribute} of {owner} is missing")
        else:
            self.report.add(["state"], f"the initial value of {attribute} of {owner} is missing")
        return 0

    def _vocabulary(self) -> Vocabulary:
        synonyms = {
            self.objects[name]: tuple(dict.fromkeys(spec.synonyms))
            for name, spec in self.spec.objects.items()
            if spec.synonyms
        }
        class_words = {name: (name, *declared.words) for name, declared in self.domain.classes.items()}
        values: dict[str, list[str]] = {}
        for value in self.values:
            values.setdefault(value.kind, []).append(value.name)
        return Vocabulary(
            tuple(self.objects.values()),
            self.values,
            self.domain.functions,
            synonyms,
            self.static,
            class_words,
            {name: declared.state for name, declared in self.domain.classes.items()},
            {kind: replace(scale, values=tuple(values[kind])) for kind, scale in self.domain.scales.items()},
            tuple(self.objects[name] for name in self.domain.constants),
        )

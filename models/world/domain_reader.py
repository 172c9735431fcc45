"""From the shape of a domain to a checked Domain."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from math import inf

from models.world.checker import BOOLEAN, NUMBER, BrokenDefinitionError, Checker, describe, scope_of
from models.world.domain import (
    Action,
    Argument,
    Definition,
    Domain,
    Effect,
    Function,
    FunctionParameter,
    ObjectClass,
    Outcome,
    Parameter,
)
from models.world.expression import Expression, ExpressionError, Truth, parse_expression
from models.world.limits import MAX_ARGUMENTS, MAX_DECLARATIONS, MAX_NAME, MAX_SYNONYMS, MAX_TEXT, MAX_TEXTS, MAX_VALUES
from models.world.name_faults import name_fault
from models.world.names import IDENTIFIER, NONE, hint
from models.world.phrases import readable
from models.world.report import Report
from models.world.scale_reader import read_scales
from models.world.specs import ActionSpec, DefinitionSpec, DomainSpec, FunctionSpec, OutcomeSpec
from models.world.verbs import denial

_HOLE = re.compile(r"\{([^{}]*)\}")
_RESERVED = frozenset({NONE, "true", "false", "not", "if", "else", "and", "or", "implies", "is"})


def read_domain(spec: DomainSpec, report: Report) -> Domain | None:
    """The domain, or None after adding every fault found to the report."""
    before = len(report.places)
    domain = _Reader(spec, report).read()
    return domain if len(report.places) == before else None


class _Reader:
    """Reads one domain, section by section."""

    def __init__(self, spec: DomainSpec, report: Report) -> None:
        self.spec = spec
        self.report = report
        self.kinds = (*spec.classes, *spec.attributes)

    def read(self) -> Domain | None:
        spec, report = self.spec, self.report
        if fault := name_fault(spec.name):
            report.add(["name"], fault)
        self._sizes()
        if sum(map(len, _expressions(spec))) > MAX_TEXTS:
            report.add([], f"the expressions have more than {MAX_TEXTS} characters together")
            return None
        attributes = {kind: self._values(kind, values) for kind, values in spec.attributes.items()}
        scales = read_scales(spec.ordered, attributes, report)
        classes = {name: self._class(name) for name in spec.classes}
        parameters = {name: self._parameter(name) for name in spec.parameters}
        self._constants()
        definitions = {
            name: self._definition((section, name), body)
            for section, name, body in self._definitions()
        }  # fmt: skip
        if report.places:
            return None
        checker = Checker(attributes, classes, spec.constants, parameters, definitions)
        self._check_definitions(checker)
        functions = {name: self._function(name, body, definitions[name]) for name, body in spec.functions.items()}
        actions = tuple(self._action(name, body, checker) for name, body in spec.actions.items())
        constraints = [self._typed(("constraints", i), text, {}, checker) for i, text in enumerate(spec.constraints)]
        return Domain(
            spec.name, parameters, attributes, classes, dict(spec.constants), definitions, functions, actions,
            tuple(constraints), tuple(spec.constraints), scales,
        )  # fmt: skip

    def _sizes(self) -> None:
        spec = self.spec
        sections: dict[str, Mapping[str, object] | list[str]] = {
            "parameters": spec.parameters,
            "attributes": spec.attributes,
            "ordered": spec.ordered,
            "classes": spec.classes,
            "constants": spec.constants,
            "define": spec.define,
            "functions": spec.functions,
            "actions": spec.actions,
            "constraints": spec.constraints,
        }
        for section, entries in sections.items():
            if len(entries) > MAX_DECLARATIONS:
                self.report.add([section], f"at most {MAX_DECLARATIONS} entries")
            if isinstance(entries, Mapping) and section != "constants":
                for name in entries:
                    self._identifier((section, name), name)
        for name in {*spec.classes} & {*spec.attributes}:
            self.report.add(["attributes", name], f"{name} is the name of a class too")
        for name in {*spec.define} & {*spec.functions}:
            self.report.add(["functions", name], f"{name} is the name of a definition too")

    def _identifier(self, path: tuple[str | int, ...], name: str) -> None:
        if not IDENTIFIER.match(name) or len(name) > MAX_NAME or name in _RESERVED:
            self.report.add(
                path, f"{name[:MAX_NAME]!r} is not a name: letters, digits and _ only, and no reserved word"
            )

    def _values(self, kind: str, values: list[str]) -> tuple[str, ...]:
        return read_values(values, ("attributes", kind), self.report)

    def _class(self, name: str) -> ObjectClass:
        spec = self.spec.classes[name]
        path = ("classes", name)
        sections = {"static": spec.static, "state": spec.state}
        for section, attributes in sections.items():
            if len(attributes) > MAX_DECLARATIONS:
                self.report.add([*path, section], f"at most {MAX_DECLARATIONS} entries")
            for attribute in attributes:
                self._identifier((*path, section, attribute), attribute)
        for attribute in {*spec.static} & {*spec.state}:
            self.report.add([*path, "state", attribute], f"{attribute} is a static attribute too")
        if len(spec.words) > MAX_SYNONYMS:
            self.report.add([*path, "words"], f"at most {MAX_SYNONYMS} entries")
        for index, word in enumerate(spec.words[:MAX_SYNONYMS]):
            if fault := name_fault(word):
                self.report.add([*path, "words", index], fault)
        read = {
            section: {a: self._kinds(kinds, (*path, section, a), none=True) for a, kinds in attributes.items()}
            for section, attributes in sections.items()
        }
        return ObjectClass(name, read["static"], read["state"], tuple(spec.words))

    def _kinds(self, text: str, path: tuple[str | int, ...], *, none: bool) -> tuple[str, ...]:
        kinds = tuple(dict.fromkeys(part.strip() for part in text.split("|")))
        if len(kinds) > MAX_DECLARATIONS:
            self.report.add(path, f"at most {MAX_DECLARATIONS} kinds")
            return kinds[:1]
        for kind in kinds:
            if kind not in self.kinds and not (none and kind == NONE):
                self.report.add(path, f"no class or attribute is called {kind[:MAX_NAME]!r}{hint(kind, self.kinds)}")
        return kinds

    def _parameter(self, name: str) -> Parameter:
        spec = self.spec.parameters[name]
        read = Parameter(
            spec.default,
            -inf if spec.minimum is None else spec.minimum,
            inf if spec.maximum is None else spec.maximum,
        )
        if not read.minimum <= read.default <= read.maximum:
            self.report.add(["parameters", name, "default"], "the default is outside minimum and maximum")
        return read

    def _constants(self) -> None:
        for name, kind in self.spec.constants.items():
            if fault := name_fault(name):
                self.report.add(["constants", name], fault)
            if kind not in self.spec.classes:
                self.report.add(
                    ["constants", name],
                    f"no class is called {kind[:MAX_NAME]!r}{hint(kind, self.spec.classes)}",
                )

    def _definitions(self) -> Iterable[tuple[str, str, DefinitionSpec]]:
        yield from (("define", name, body) for name, body in self.spec.define.items())
        yield from (("functions", name, body) for name, body in self.spec.functions.items())

    def _definition(self, path: tuple[str, str], spec: DefinitionSpec) -> Definition:
        return Definition(path[1], self._arguments(path, spec.arguments), self._parse((*path, "is"), spec.expression))

    def _arguments(self, path: tuple[str, str], texts: list[str]) -> tuple[Argument, ...]:
        if len(texts) > MAX_ARGUMENTS:
            self.report.add([*path, "arguments"], f"at most {MAX_ARGUMENTS} arguments")
            return ()
        read: list[Argument] = []
        for index, text in enumerate(texts):
            place = (*path, "arguments", index)
            name, colon, kinds = (part.strip() for part in text.partition(":"))
            if not colon:
                self.report.add(place, "write an argument as `name: kinds`, for example `x: box | toy`")
                continue
            self._identifier(place, name)
            if any(argument.name == name for argument in read):
                self.report.add(place, f"two arguments are called {name}")
            read.append(Argument(name, self._kinds(kinds, place, none=False)))
        return tuple(read)

    def _parse(self, path: tuple[str | int, ...], text: str) -> Expression:
        try:
            return parse_expression(text)
        except ExpressionError as error:
            self.report.add(path, str(error))
            return Truth(False)

    def _check_definitions(self, checker: Checker) -> None:
        for section, name, _ in self._definitions():
            try:
                typed = checker.definition(name)
            except BrokenDefinitionError:
                continue
            except ExpressionError as error:
                self.report.add([section, name, "is"], str(error))
                continue
            if section == "functions" and typed.type != BOOLEAN:
                self.report.add([section, name, "is"], f"must be true or false, not {describe(typed.type)}")

    def _function(self, name: str, spec: FunctionSpec, definition: Definition) -> Function:
        arguments = definition.arguments
        listed = ", ".join(f"{{{argument.name}}}" for argument in arguments)
        plain = f"{name}({listed})" if arguments else readable(name)
        says = spec.says if spec.says is not None else f"{plain} holds"
        denies = spec.denies if spec.denies is not None else denial(says)
        path = ("functions", name)
        self._pattern((*path, "says"), says, arguments)
        if spec.denies is not None:
            self._pattern((*path, "denies"), denies, arguments)
        if len(spec.display) > MAX_SYNONYMS:
            self.report.add([*path, "display"], f"at most {MAX_SYNONYMS} entries")
        for index, pattern in enumerate(spec.display[:MAX_SYNONYMS]):
            self._display((*path, "display", index), pattern, arguments)
        parameters = tuple(FunctionParameter(a.name, frozenset(a.kinds)) for a in arguments)
        return Function(name, parameters, says, denies, tuple(spec.display))

    def _pattern(self, path: tuple[str | int, ...], pattern: str, arguments: tuple[Argument, ...]) -> list[str]:
        if len(pattern) > MAX_TEXT or not pattern.isprintable():
            self.report.add(path, f"at most {MAX_TEXT} characters, no line breaks or control characters")
            return []
        names = [argument.name for argument in arguments]
        holes = _HOLE.findall(pattern)
        for hole in holes:
            if hole not in names:
                self.report.add(path, f"no argument is called {hole[:MAX_NAME]!r}{hint(hole, names)}")
        return holes

    def _display(self, path: tuple[str | int, ...], pattern: str, arguments: tuple[Argument, ...]) -> None:
        holes = self._pattern(path, pattern, arguments)
        if sorted(holes) != sorted(argument.name for argument in arguments):
            self.report.add(path, "a display pattern has each argument exactly once")
        elif any(not literal.strip("_ ") for literal in _HOLE.split(pattern)[2:-1:2]):
            self.report.add(path, "two arguments of a display pattern need a word between them")

    def _action(self, name: str, spec: ActionSpec, checker: Checker) -> Action:
        path = ("actions", name)
        arguments = self._arguments(path, spec.arguments)
        scope = scope_of(arguments)
        guard = self._typed((*path, "when"), spec.when, scope, checker)
        if len(spec.outcomes) > MAX_DECLARATIONS:
            self.report.add([*path, "outcomes"], f"at most {MAX_DECLARATIONS} outcomes")
        outcomes = [
            self._outcome((*path, "outcomes", index), outcome, scope, checker)
            for index, outcome in enumerate(spec.outcomes[:MAX_DECLARATIONS])
        ]
        cost = self._typed((*path, "cost"), spec.cost, {}, checker, expected=NUMBER)
        return Action(name, arguments, guard, cost, tuple(outcomes))

    def _outcome(
        self,
        path: tuple[str | int, ...],
        spec: OutcomeSpec,
        scope: dict[str, frozenset[str]],
        checker: Checker,
    ) -> Outcome:
        probability = self._typed((*path, "probability"), spec.probability, scope, checker, expected=NUMBER)
        if len(spec.set) > MAX_DECLARATIONS:
            self.report.add([*path, "set"], f"at most {MAX_DECLARATIONS} entries")
            return Outcome(probability, ())
        effects = [
            self._effect((*path, "set", target), target, text, scope, checker) for target, text in spec.set.items()
        ]
        return Outcome(probability, tuple(effect for effect in effects if effect))

    def _effect(
        self,
        path: tuple[str | int, ...],
        target: str,
        text: str,
        scope: dict[str, frozenset[str]],
        checker: Checker,
    ) -> Effect | None:
        owner, dot, attribute = (part.strip() for part in target.partition("."))
        constants = {name: frozenset({kind}) for name, kind in self.spec.constants.items()}
        owners = scope.get(owner, constants.get(owner))
        if not dot or owners is None:
            known = [*scope, *constants]
            self.report.add(
                path, f"set object.attribute, where the object is an argument or constant{hint(owner, known)}"
            )
            return None
        allowed: set[str] = set()
        for kind in sorted(owners):
            declared = self.spec.classes.get(kind)
            if declared is None or attribute not in declared.state:
                known = [*declared.state] if declared else []
                self.report.add(path, f"{kind} has no state attribute {attribute}{hint(attribute, known)}")
                return None
            allowed.update(part.strip() for part in declared.state[attribute].split("|"))
        value = self._parse(path, text)
        try:
            typed = checker.check(value, scope)
            if not typed.type & allowed:
                self.report.add(path, f"{target} may be {describe(frozenset(allowed))}, never {describe(typed.type)}")
        except BrokenDefinitionError:
            pass
        except ExpressionError as error:
            self.report.add(path, str(error))
        return Effect(owner, attribute, value, target)

    def _typed(
        self, path: tuple[str | int, ...], text: str, scope: dict[str, frozenset[str]], checker: Checker,
        *, expected: frozenset[str] = BOOLEAN,
    ) -> Expression:  # fmt: skip
        expression = self._parse(path, text)
        try:
            if expression != Truth(False):
                checker.check(expression, scope, expected)
        except BrokenDefinitionError:
            pass
        except ExpressionError as error:
            self.report.add(path, str(error))
        return expression


def _expressions(spec: DomainSpec) -> Iterable[str]:
    yield from (body.expression for body in (*spec.define.values(), *spec.functions.values()))
    yield from spec.constraints
    for action in spec.actions.values():
        yield action.when
        for outcome in action.outcomes:
            yield from (outcome.probability, *outcome.set.values())


def read_values(values: list[str], path: tuple[str | int, ...], report: Report) -> tuple[str, ...]:
    """Distinct well-formed value names; faults go to the report."""
    if len(values) > MAX_VALUES:
        report.add(path, f"at most {MAX_VALUES} values")
        return ()
    seen: set[str] = set()
    for index, value in enumerate(values):
        if fault := name_fault(value):
            report.add([*path, index], fault)
        elif value in seen:
            report.add([*path, index], f"{value} is listed twice")
        seen.add(value)
    return tuple(values)

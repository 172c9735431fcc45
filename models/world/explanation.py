"""Plain English for formulas, put together from the readings of the propositional functions.

The reading is compositional: every operator has one phrase, and what is not a single clause is put in
parentheses where it could be misread. A few common shapes read as people say them: `F (a & F b)` is
"eventually a, and then b".
"""

from __future__ import annotations

from dataclasses import dataclass

from models.logic.formula import (
    Atom,
    Binary,
    Constant,
    Formula,
    Nary,
    Op,
    Parameter,
    Term,
    Unary,
    conjunction,
)
from models.world.domain import Function
from models.world.environment import Environment
from models.world.errors import TypeMismatchError, UnknownObjectError, UnknownPropositionError
from models.world.resolution import resolve_atom


def explain(formula: Formula, environment: Environment | None = None) -> str:
    """What the formula asks for, in English. Atoms that the environment does not have are read as they are
    written.
    """
    return _Speaker(environment).say(formula)


@dataclass(frozen=True, slots=True)
class _Speaker:
    environment: Environment | None

    def say(self, formula: Formula) -> str:
        """The reading of a formula as one sentence without its full stop."""
        match formula:
            case Constant(value=value):
                return "anything is allowed" if value else "the impossible happens"
            case Atom():
                return self._atom(formula)
            case Unary(op=Op.NOT, operand=operand):
                return self._denial(operand)
            case Unary(op=Op.NEXT):
                return self._next(formula)
            case Unary(op=Op.FINALLY, operand=operand):
                return self._finally(operand)
            case Unary(operand=operand):
                return self._globally(operand)
            case Binary():
                return self._binary(formula)
            case Nary():
                return self._nary(formula)

    def _denial(self, operand: Formula) -> str:
        match operand:
            case Atom():
                return self._atom(operand, denied=True)
            case Constant(value=value):
                return self.say(Constant(not value))
            case Unary(op=Op.FINALLY, operand=inner):
                return self._never(inner)
            case _:
                return f"it is not so that {self._clause(operand, last=True)}"

    def _next(self, formula: Formula) -> str:
        steps = 0
        while isinstance(formula, Unary) and formula.op is Op.NEXT:
            formula, steps = formula.operand, steps + 1
        when = "in the next step" if steps == 1 else f"in {steps} steps"
        return f"{when} {self._clause(formula, last=True)}"

    def _finally(self, operand: Formula) -> str:
        match operand:
            case Unary(op=Op.GLOBALLY, operand=inner):
                return f"from some time on, always {self._clause(inner, last=True)}"
            case Unary(op=Op.FINALLY, operand=inner):
                return self._finally(inner)
        first, *later = _steps(operand)
        said, before = self._clause(first[1], last=not later), first[1]
        for link, now in later:
            said += f", {link} {self._while(now, before)}"
            before = now
        return f"eventually {said}"

    def _while(self, now: Formula, before: Formula) -> str:
        """A later step; what already held in the step before is said last: `b while a`."""
        parts = now.operands if isinstance(now, Nary) and now.op is Op.AND else (now,)
        earlier = before.operands if isinstance(before, Nary) and before.op is Op.AND else (before,)
        kept = [part for part in parts if part in earlier]
        new = [part for part in parts if part not in earlier]
        if not kept or not new:
            return self._clause(now)
        return f"{self._clause(conjunction(*new))} while {self._clause(conjunction(*kept))}"

    def _globally(self, operand: Formula) -> str:
        match operand:
            case Unary(op=Op.NOT, operand=inner):
                return self._never(inner)
            case Unary(op=Op.FINALLY, operand=inner):
                return f"again and again {self._clause(inner, last=True)}"
            case Unary(op=Op.GLOBALLY, operand=inner):
                return self._globally(inner)
            case Binary(op=Op.IMPLIES, left=left, right=right):
                return f"whenever {self._clause(left)}, {self._clause(right)}"
            case _:
                return f"always {self._clause(operand, last=True)}"

    def _never(self, formula: Formula) -> str:
        said = self._clause(formula, last=True)
        if isinstance(formula, Atom) and " is " in said:
            return said.replace(" is ", " is never ", 1)
        return f"never {said}"

    def _binary(self, formula: Binary) -> str:
        left, right = self._clause(formula.left), self._clause(formula.right)
        match formula.op:
            case Op.IMPLIES:
                return f"if {left}, then {right}"
            case Op.IFF:
                return f"{left} exactly when {right}"
            case Op.UNTIL:
                return f"{left} until {right}"
            case Op.WEAK_UNTIL:
                return f"{left} until {right}, or for ever"
            case Op.RELEASE:
                return f"{right} up to and including when {left}, or for ever"
            case _:
                return f"{right} up to and including when {left}, which must happen"

    def _nary(self, formula: Nary) -> str:
        said = [self._clause(operand) for operand in formula.operands]
        word = "and" if formula.op is Op.AND else "or"
        return f" {word} ".join(said)

    def _clause(self, formula: Formula, *, last: bool = False) -> str:
        """The reading as a part of a larger one: in parentheses unless it cannot be misread.

        `last` says that nothing of the larger reading follows.
        """
        said = self.say(formula)
        if last and isinstance(formula, Nary) and _is_pair(formula):
            return f"{'both' if formula.op is Op.AND else 'either'} {said}"
        return said if _is_clause(formula) else f"({said})"

    def _atom(self, atom: Atom, *, denied: bool = False) -> str:
        function = self._function(atom)
        if function is None:
            said = f"{atom.function.replace('_', ' ')}"
            listed = ", ".join(_spoken(term) for term in atom.arguments)
            plain = f"{said}({listed})" if atom.arguments else f"{said} holds"
            return (f"not {plain}" if atom.arguments else f"{said} does not hold") if denied else plain
        text = function.denies if denied else function.says
        resolved = self._resolved(atom)
        names = {p.name: _spoken(t) for p, t in zip(function.parameters, resolved.arguments, strict=True)}
        return _filled(text, names)

    def _function(self, atom: Atom) -> Function | None:
        if self.environment is None:
            return None
        found = self.environment.functions.get(self._resolved(atom).function)
        return found if found is not None and len(found.parameters) == len(self._resolved(atom).arguments) else None

    def _resolved(self, atom: Atom) -> Atom:
        if self.environment is None:
            return atom
        try:
            return resolve_atom(atom, self.environment.vocabulary)
        except (UnknownPropositionError, UnknownObjectError, TypeMismatchError):
            return atom


def _is_pair(formula: Nary) -> bool:
    return len(formula.operands) == 2 and all(map(_is_literal, formula.operands))


def _is_literal(formula: Formula) -> bool:
    inner = formula.operand if isinstance(formula, Unary) and formula.op is Op.NOT else formula
    return isinstance(inner, Atom | Constant)


def _is_clause(formula: Formula) -> bool:
    match formula:
        case Unary(op=Op.NOT):
            return _is_literal(formula)
        case Unary(op=Op.FINALLY | Op.GLOBALLY | Op.NEXT, operand=operand):
            return isinstance(operand, Atom) or (isinstance(operand, Unary) and _is_clause(operand))
        case _:
            return _is_literal(formula)


def _steps(operand: Formula) -> list[tuple[str, Formula]]:
    """The steps of `a & F (b & X F c)`, each after the words that lead to it."""
    steps: list[tuple[str, Formula]] = []
    link = ""
    while (found := _later(operand)) is not None:
        now, operand, next_link = found
        steps.append((link, now))
        link = next_link
    return [*steps, (link, operand)]


def _later(operand: Formula) -> tuple[Formula, Formula, str] | None:
    """`a & F b` -> (a, b, "and then"); `a & X F b` -> (a, b, "and after that"); anything else None."""
    if not (isinstance(operand, Nary) and operand.op is Op.AND):
        return None
    found = [part for part in operand.operands if _eventual(part) is not None]
    if len(found) != 1:
        return None
    now = conjunction(*(part for part in operand.operands if part is not found[0]))
    inner = _eventual(found[0])
    assert inner is not None
    return now, inner[0], inner[1]


def _eventual(formula: Formula) -> tuple[Formula, str] | None:
    match formula:
        case Unary(op=Op.FINALLY, operand=operand):
            return operand, "and then"
        case Unary(op=Op.NEXT, operand=Unary(op=Op.FINALLY, operand=operand)):
            return operand, "and after that"
        case _:
            return None


def _spoken(term: Term) -> str:
    return f"${term.position}" if isinstance(term, Parameter) else term.text.replace("_", " ")


def _filled(text: str, names: dict[str, str]) -> str:
    """The holes of a reading filled at once, so that a name with braces stays as it is."""
    pieces = text.split("{")
    filled = [pieces[0]]
    for piece in pieces[1:]:
        name, _, rest = piece.partition("}")
        filled.append(names[name] + rest)
    return "".join(filled)

"""Writing formulas: AST to text in each dialect, such that `parse` reads the same formula back.

Parentheses are few but never leave the reader to recall the precedence of `&` over `|` or of `U` over either: only
`->` and `<->` take a conjunction or disjunction bare.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from models.logic.dialect import Dialect
from models.logic.formula import Atom, Binary, Constant, Formula, Nary, Op, Parameter, Term, Unary, fold
from models.logic.names import to_latex, to_quotable


@dataclass(frozen=True, slots=True)
class _Style:
    """How one dialect spells operators, constants, names and parameters."""

    signs: dict[Op, str]
    true: str = "true"
    false: str = "false"
    name: Callable[[str], str] = to_quotable
    parameter: str = "$"
    gap: str = " "  # between a temporal operator and an operand without parentheses
    group_gap: str = " "  # ... with parentheses
    not_gap: str = ""


_INFIX = {op: op.value for op in Op}
_STYLES = {
    Dialect.INFIX: _Style(_INFIX),
    Dialect.PREFIX: _Style(_INFIX),
    Dialect.SPOT: _Style({**_INFIX, Op.FINALLY: "<>", Op.GLOBALLY: "[]", Op.AND: "&&", Op.OR: "||"}),
    Dialect.UNICODE: _Style(
        {
            **_INFIX,
            Op.NOT: "¬",
            Op.NEXT: "○",
            Op.FINALLY: "◇",
            Op.GLOBALLY: "□",
            Op.AND: "∧",
            Op.OR: "∨",
            Op.IMPLIES: "→",
            Op.IFF: "↔",
        },
        true="⊤",
        false="⊥",
    ),
    Dialect.LATEX: _Style(
        {
            **{op: rf"\mathcal{{{op}}}" for op in (Op.NEXT, Op.FINALLY, Op.GLOBALLY)},
            **{op: rf"\mathbin{{\mathcal{{{op}}}}}" for op in (Op.UNTIL, Op.RELEASE, Op.WEAK_UNTIL, Op.STRONG_RELEASE)},
            Op.NOT: r"\neg",
            Op.AND: r"\wedge",
            Op.OR: r"\vee",
            Op.IMPLIES: r"\rightarrow",
            Op.IFF: r"\leftrightarrow",
        },
        true=r"\top",
        false=r"\bot",
        name=to_latex,
        parameter=r"\$",
        gap=r"\,",
        group_gap="",
        not_gap=" ",
    ),
}


def to_text(formula: Formula, dialect: Dialect = Dialect.INFIX) -> str:
    """The formula in a dialect, on one line. `parse` reads it back, with the dialect named or recognised."""
    style = _STYLES[dialect]
    combine = _prefix if dialect is Dialect.PREFIX else _infix
    return fold(formula, lambda node, operands: combine(style, node, operands))


def atom_text(atom: Atom, dialect: Dialect = Dialect.INFIX) -> str:
    """An atom in a dialect: `in(ball, "H&M")`, or `a` where it has no arguments."""
    return _leaf(_STYLES[dialect], atom)


def _leaf(style: _Style, leaf: Atom | Constant) -> str:
    if isinstance(leaf, Constant):
        return style.true if leaf.value else style.false
    function = style.name(leaf.function)
    if not leaf.arguments:
        return function
    return f"{function}({', '.join(_term(style, term) for term in leaf.arguments)})"


def _term(style: _Style, term: Term) -> str:
    return f"{style.parameter}{term.position}" if isinstance(term, Parameter) else style.name(term.text)


def _prefix(style: _Style, node: Formula, operands: tuple[str, ...]) -> str:
    if isinstance(node, (Atom, Constant)):
        return _leaf(style, node)
    sign = style.signs[node.op]
    if isinstance(node, Nary):
        return f"{sign} " + f" {sign} ".join((*operands[:-2], operands[-2])) + f" {operands[-1]}"
    return " ".join((sign, *operands))


def _infix(style: _Style, node: Formula, operands: tuple[str, ...]) -> str:
    match node:
        case Unary(op=op, operand=operand):
            return style.signs[op] + _unary_operand(style, op, operand, operands[0])
        case Binary(op=op, left=left, right=right):
            sides = (_side(op, left, operands[0]), _side(op, right, operands[1]))
            return f" {style.signs[op]} ".join(sides)
        case Nary(op=op, operands=parts):
            return f" {style.signs[op]} ".join(map(_grouped, parts, operands))
        case _:
            return _leaf(style, node)


def _unary_operand(style: _Style, op: Op, operand: Formula, text: str) -> str:
    grouped = isinstance(operand, (Binary, Nary))
    if grouped:
        return ("" if op is Op.NOT else style.group_gap) + f"({text})"
    return (style.not_gap if op is Op.NOT else style.gap) + text


def _side(op: Op, operand: Formula, text: str) -> str:
    loose = op in (Op.IMPLIES, Op.IFF) and isinstance(operand, Nary)
    return text if loose else _grouped(operand, text)


def _grouped(operand: Formula, text: str) -> str:
    return f"({text})" if isinstance(operand, (Binary, Nary)) else text

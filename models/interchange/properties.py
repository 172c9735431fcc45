"""Formulas as properties in the language that PRISM and Storm share."""

from __future__ import annotations

from collections.abc import Mapping

from models.logic import Atom, Binary, Constant, Formula, Nary, Op, Unary, fold


def property_text(formula: Formula, labels: Mapping[Atom, str]) -> str:
    """`Pmax=? [ F "in_cylinder_box" ]`: what to ask of an exported model; `labels` as from `label_names`.

    Written with `! & | X F G U` only, since Storm reads no other operators; the text may be exponential in the
    nesting of `<->`, `W`, `R` and `M`.
    """

    def write(node: Formula, operands: tuple[str, ...]) -> str:
        match node:
            case Constant(value=value):
                return "true" if value else "false"
            case Atom():
                return f'"{labels[node]}"'
            case Unary(op=op):
                return f"(!{operands[0]})" if op is Op.NOT else f"({op.value} {operands[0]})"
            case Nary(op=op):
                return f"({f' {op.value} '.join(operands)})"
            case Binary(op=op):
                return _binary(op, *operands)

    text = fold(formula, write)
    return f"Pmax=? [ {text} ]"


def _binary(op: Op, left: str, right: str) -> str:
    match op:
        case Op.IMPLIES:
            return f"((!{left}) | {right})"
        case Op.IFF:
            return f"(({left} & {right}) | ((!{left}) & (!{right})))"
        case Op.WEAK_UNTIL:
            return f"(({left} U {right}) | (G {left}))"
        case Op.RELEASE:
            return f"(({right} U ({left} & {right})) | (G {right}))"
        case Op.STRONG_RELEASE:
            return f"({right} U ({left} & {right}))"
        case _:
            return f"({left} {op.value} {right})"

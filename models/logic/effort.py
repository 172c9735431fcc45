"""A rough, cheap guess at the work that translating a formula takes, so that the hopeless is refused at once."""

from __future__ import annotations

from models.logic.formula import Atom, Binary, Constant, Formula, Nary, Op, Unary, fold

_Pair = tuple[int, int]  # the guess for a formula, and for its negation
_CAP = 1 << 40  # beyond this, numbers only get longer


def obligations(formula: Formula) -> int:
    """About how many sets of obligations an automaton of the formula has to tell apart.

    Conjunctions multiply, since each part is at a stage of its own, and disjunctions add. What has to hold again and
    again (`G`, the left of `U`) counts twice. It is a guess and no bound: a formula that passes may still take long.
    """
    return fold(formula, _combine)[0]


def _combine(node: Formula, operands: tuple[_Pair, ...]) -> _Pair:
    if isinstance(node, (Atom, Constant)) or all(pair == (0, 0) for pair in operands):
        purely_boolean = isinstance(node, (Atom, Constant)) or node.op in _BOOLEAN
        if purely_boolean:
            return 0, 0
    positive, negative = _count(node, tuple((max(1, p), max(1, n)) for p, n in operands))
    return min(positive, _CAP), min(negative, _CAP)


_BOOLEAN = frozenset({Op.NOT, Op.AND, Op.OR, Op.IMPLIES, Op.IFF})


def _count(node: Formula, operands: tuple[_Pair, ...]) -> _Pair:
    match node:
        case Unary(op=op):
            return _count_unary(op, *operands[0])
        case Nary(op=op):
            product = _product([pair[op is Op.OR] for pair in operands])
            total = sum(pair[op is Op.AND] for pair in operands)
            return (product, total) if op is Op.AND else (total, product)
        case Binary(op=op):
            return _count_binary(op, *operands)
        case _:
            return 1, 1


def _count_unary(op: Op, positive: int, negative: int) -> _Pair:
    match op:
        case Op.NOT:
            return negative, positive
        case Op.NEXT:
            return 1 + positive, 1 + negative
        case Op.FINALLY:
            return 1 + positive, 2 * negative
        case _:
            return 2 * positive, 1 + negative


def _count_binary(op: Op, left: _Pair, right: _Pair) -> _Pair:
    if op is Op.IMPLIES:
        return left[1] + right[0], left[0] * right[1]
    if op is Op.IFF:
        return left[0] * right[0] + left[1] * right[1], left[0] * right[1] + left[1] * right[0]
    if op in (Op.UNTIL, Op.WEAK_UNTIL):
        return 2 * left[0] + right[0], 2 * right[1] + left[1]
    return 2 * right[0] + left[0], 2 * left[1] + right[1]


def _product(numbers: list[int]) -> int:
    product = 1
    for number in numbers:
        product = min(product * number, _CAP)
    return product

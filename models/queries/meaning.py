"""The LTL meaning of composed queries.

    then(A, B)      B once A is done: what A does last also starts B, so `F a` then `F b` is `F (a & F b)`
    and(A, B)       both, in any order
    or(A, B)        one of them at least
    avoid(A)        A never happens: `F a` becomes `G !a`
    until(A, B)     A has to be kept up until B is done, and B has to be done: `G !a` until `F b` is `!a U b`
    without(A, B)   when A is done, B is not so: `F a` without `F b` is `F (a & !b)`
    repeat(A)       A again and again: `G F a`

A formula is *done* where its last eventuality is met. As in the paper's templates `F` includes now, so b may hold
already when a does. Whether something is done is read off the form of the formula: `F`, `U`, `M`, and `&`, `|` and `X`
of such. What has to be kept up for ever (`G`, `W`, `R`) is never done and stays in force beside it. With A done where
both of its parts are,

    then(F a & F b, C)  is  F (a & C) & F (b & C),

which is exact for a C that, once possible at two times, is still possible at the later one: eventualities, and what
has to be kept up from some time on.

"Avoid" is said in four ways: `F p & G !q` is and(P, avoid(Q)), the standard here; `!q U p` is until(avoid(Q), P);
`F (p & !q)` is without(P, Q); and `G !q` is avoid(Q).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import reduce

from models.logic import Atom, Binary, Constant, Formula, Nary, Op, Unary, children, conjunction, disjunction, walk
from models.queries.contextual_query import Operator
from models.queries.errors import CompositionError

_LASTING = (Op.GLOBALLY, Op.WEAK_UNTIL, Op.RELEASE)
_EVENTUAL = (Op.UNTIL, Op.STRONG_RELEASE)
_DUALS = {Op.FINALLY: Op.GLOBALLY, Op.GLOBALLY: Op.FINALLY, Op.NEXT: Op.NEXT}


def compose(operator: Operator, operands: Sequence[Formula]) -> Formula:
    """The formula of a composition whose operands have these formulas.

    Raises:
        CompositionError: the operator has no meaning for such operands.
        FormulaTooLargeError: the formula is beyond the limits of `models.logic`.
    """
    match operator:
        case Operator.THEN:
            return reduce(lambda later, first: after(first, later), reversed(operands))
        case Operator.AND:
            return conjunction(*operands)
        case Operator.OR:
            return disjunction(*operands)
        case Operator.AVOID:
            return denied(operands[0])
        case Operator.UNTIL:
            return _until(*operands)
        case Operator.WITHOUT:
            return after(operands[0], denied(_condition(operands[1])))
        case Operator.REPEAT:
            return Unary(Op.GLOBALLY, operands[0])


def after(first: Formula, then: Formula) -> Formula:
    """`then` once `first` is done; raises CompositionError where it never is."""
    return _when_done(first, lambda last: conjunction(last, then))


def denied(formula: Formula) -> Formula:
    """The negation, with the negation moved inside `F`, `G`, `X`, `&` and `|`: `G !a` for `F a`."""
    match formula:
        case Constant(value=value):
            return Constant(not value)
        case Unary(op=Op.NOT, operand=operand):
            return operand
        case Unary(op=op, operand=operand):
            return Unary(_DUALS[op], denied(operand))
        case Nary(op=op, operands=operands) if not _is_condition(formula):
            join = disjunction if op is Op.AND else conjunction
            return join(*map(denied, operands))
        case _:
            return Unary(Op.NOT, formula)


def _until(kept: Formula, done: Formula) -> Formula:
    """`kept` without its `G`, until `done` is done."""
    inner = _kept_up(kept)
    if inner is None:
        raise CompositionError("what has to hold until then must be kept up, such as avoid(...); this is done at once")
    if not _is_condition(inner):
        raise CompositionError("what has to hold until then must be a condition of each moment, such as avoid(...)")
    return _held(inner, done)


def _kept_up(formula: Formula) -> Formula | None:
    """What a formula `G a`, or several together, asks of each moment; None for other formulas."""
    match formula:
        case Unary(op=Op.GLOBALLY, operand=operand):
            return operand
        case Nary(op=Op.AND, operands=operands):
            inner = [_kept_up(operand) for operand in operands]
            known = [one for one in inner if one is not None]
            return conjunction(*known) if len(known) == len(inner) else None
        case _:
            return None


def _held(kept: Formula, done: Formula) -> Formula:
    """`done`, with `kept` at every moment before it is."""
    match done:
        case Unary(op=Op.FINALLY, operand=operand):
            return Binary(Op.UNTIL, kept, _held(kept, operand))
        case Binary(op=Op.UNTIL, left=left, right=right):
            return Binary(Op.UNTIL, conjunction(kept, left), _held(kept, right))
        case Unary(op=Op.NEXT, operand=operand):
            return conjunction(kept, Unary(Op.NEXT, _held(kept, operand)))
        case Nary(op=op, operands=operands) if not _is_condition(done):
            join = conjunction if op is Op.AND else disjunction
            return join(*(one if _is_lasting(one) else _held(kept, one) for one in operands))
        case _ if _is_condition(done):
            return done
        case _:
            raise _never_done()


def _when_done(formula: Formula, finish: Callable[[Formula], Formula]) -> Formula:
    """The formula with `finish` put on what holds where it is done."""
    match formula:
        case Unary(op=Op.FINALLY | Op.NEXT, operand=operand):
            return Unary(formula.op, _when_done(operand, finish))
        case Binary(op=Op.UNTIL, left=left, right=right):
            return Binary(Op.UNTIL, left, _when_done(right, finish))
        case Nary(op=Op.OR, operands=operands) if not _is_condition(formula):
            return disjunction(*(_when_done(operand, finish) for operand in operands))
        case Nary(op=Op.AND, operands=operands) if not _is_condition(formula):
            return _all_done(operands, finish)
        case _ if _is_condition(formula):
            return finish(formula)
        case _:
            raise _never_done()


def _all_done(operands: Sequence[Formula], finish: Callable[[Formula], Formula]) -> Formula:
    """A conjunction: its eventualities are done in any order; if it has none, it is done where its conditions hold."""
    lasting = [one for one in operands if _is_lasting(one)]
    conditions = [one for one in operands if _is_condition(one)]
    eventual = [one for one in operands if not _is_lasting(one) and not _is_condition(one)]
    if eventual:
        return conjunction(*conditions, *(_when_done(one, finish) for one in eventual), *lasting)
    if conditions:
        return conjunction(finish(conjunction(*conditions)), *lasting)
    raise _never_done()


def _condition(formula: Formula) -> Formula:
    """What `F a` comes to: a. Raises CompositionError for what is no single condition."""
    match formula:
        case Unary(op=Op.FINALLY, operand=operand) if _is_condition(operand):
            return operand
        case Nary(op=op, operands=operands) if not _is_condition(formula):
            return (conjunction if op is Op.AND else disjunction)(*map(_condition, operands))
        case _ if _is_condition(formula):
            return formula
        case _:
            raise CompositionError("what should not be so then must be a single condition, such as being at a place")


def _is_condition(formula: Formula) -> bool:
    """Whether it speaks of one moment only."""
    temporal = {*_DUALS, *_LASTING, *_EVENTUAL}
    return all(isinstance(node, Atom | Constant) or node.op not in temporal for node in walk(formula))


def _is_lasting(formula: Formula) -> bool:
    """Whether it is never done: every way to satisfy it has something to keep up."""
    match formula:
        case Unary(op=Op.GLOBALLY) | Binary(op=Op.WEAK_UNTIL | Op.RELEASE):
            return True
        case Nary():
            return not _is_condition(formula) and all(
                _is_lasting(one) or (_is_condition(one) and formula.op is Op.AND) for one in children(formula)
            )
        case Unary(op=Op.NOT, operand=operand):
            return not _is_condition(operand)
        case _:
            return False


def _never_done() -> CompositionError:
    return CompositionError("this is never done, so nothing can come after it; `and` puts things beside each other")

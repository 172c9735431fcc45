"""What comes after what in a formula: the steps of `a & F (b & X F c)`, and strict orders."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Literal

from models.logic import Atom, Formula, Nary, Op, Unary
from models.logic.formula import Binary

Kind = Literal["first", "then", "only", "after", "next", "until"]


@dataclass(frozen=True, slots=True)
class Step:
    """What holds at one step, together, and how it follows the one before.

    `then`: at that time or later (`F`); `only`: likewise, and not before it; `after`: `count` times or more after it
    (`X F`); `next`: `count` times after it (`X`); `until`: later, with `guard` at every time until then (`U`).
    """

    parts: tuple[Formula, ...]
    kind: Kind = "first"
    count: int = 0
    guard: Formula | None = None

    @property
    def only_part(self) -> Formula | None:
        """What holds, if it is one thing."""
        return self.parts[0] if len(self.parts) == 1 else None


def steps_of(formula: Formula) -> list[Step]:
    """The steps of what stands behind an `F` or `U`; one if nothing comes later."""
    steps: list[Step] = []
    first = Step(())
    while (found := _split(formula)) is not None:
        now, following, formula = found
        steps.append(replace(first, parts=now))
        first = following
    later = isinstance(formula, Nary) and any(map(_following, formula.operands))
    parts = formula.operands if isinstance(formula, Nary) and formula.op is Op.AND and not later else (formula,)
    return [*steps, replace(first, parts=parts)]


def eventuality(formula: Formula) -> Formula | None:
    """The operand of an `F`, if it asks for a thing to be done once, not for what is kept up from some time on."""
    if not (isinstance(formula, Unary) and formula.op is Op.FINALLY):
        return None
    inner = formula.operand
    temporal = isinstance(inner, Unary) and inner.op is not Op.NEXT and not _is_literal(inner)
    return None if temporal else inner


def strictly_ordered(operands: Sequence[Formula]) -> dict[int, list[Step]]:
    """The steps of each conjunct `F a`, by its place, with what other conjuncts say of their order.

    `(!b U a) & F (a & F b)` and `(!b U a) & F b` both say: a, and only then b. The places of such `!b U a` have no
    steps: `[]`.
    """
    found = {
        place: steps_of(inner) for place, operand in enumerate(operands) if (inner := eventuality(operand)) is not None
    }
    before = _before(operands)
    if not before:
        return found
    used: dict[int, list[Step]] = {}
    for steps in found.values():
        _mark(steps, before, used)
        _put_before(steps, before, used)
    return found | used


def _mark(steps: list[Step], before: dict[Formula, tuple[int, Formula]], used: dict[int, list[Step]]) -> None:
    """Turn `then` into `only` where a conjunct says so."""
    for index in range(1, len(steps)):
        now = steps[index].only_part
        known = before.get(now) if now is not None and steps[index].kind == "then" else None
        if known is not None and known[0] not in used and steps[index - 1].only_part == known[1]:
            steps[index] = replace(steps[index], kind="only")
            used[known[0]] = []


def _put_before(steps: list[Step], before: dict[Formula, tuple[int, Formula]], used: dict[int, list[Step]]) -> None:
    """Begin with what has to come first by a conjunct `!b U a`."""
    while (first := steps[0].only_part) is not None and first in before and before[first][0] not in used:
        place, earlier = before[first]
        steps[0] = replace(steps[0], kind="only")
        steps.insert(0, Step((earlier,)))
        used[place] = []


def _before(operands: Sequence[Formula]) -> dict[Formula, tuple[int, Formula]]:
    """b -> (place, a) for the conjuncts `!b U a`; the first one for each b."""
    found: dict[Formula, tuple[int, Formula]] = {}
    for place, operand in enumerate(operands):
        if isinstance(operand, Binary) and operand.op is Op.UNTIL:
            late = complement(operand.left)
            steps = steps_of(operand.right)
            early = steps[0].only_part if len(steps) == 1 else None
            if late is not None and early is not None:
                found.setdefault(late, (place, early))
    return found


def complement(formula: Formula) -> Formula | None:
    """`a` for `!a`, `!a` for an atom; None for what else there is."""
    if isinstance(formula, Unary) and formula.op is Op.NOT:
        return formula.operand
    return Unary(Op.NOT, formula) if isinstance(formula, Atom) else None


def _split(formula: Formula) -> tuple[tuple[Formula, ...], Step, Formula] | None:
    """`a & F b` -> what holds now, how the next step follows, and what that is; None if not one thing comes later."""
    if not (isinstance(formula, Nary) and formula.op is Op.AND):
        return None
    later = [place for place, part in enumerate(formula.operands) if _following(part)]
    if len(later) != 1:
        return None
    now = tuple(part for place, part in enumerate(formula.operands) if place != later[0])
    found = _following(formula.operands[later[0]])
    assert found is not None
    return now, *found


def _following(formula: Formula) -> tuple[Step, Formula] | None:
    """How a later step follows, and what it is: `X F b` -> ("after", b)."""
    count = 0
    while isinstance(formula, Unary) and formula.op is Op.NEXT:
        formula, count = formula.operand, count + 1
    if isinstance(formula, Unary) and formula.op is Op.FINALLY:
        while isinstance(formula, Unary) and formula.op is Op.FINALLY:
            formula = formula.operand
        return Step((), "after" if count else "then", count), formula
    if count:
        return Step((), "next", count), formula
    if isinstance(formula, Binary) and formula.op is Op.UNTIL:
        return Step((), "until", 0, formula.left), formula.right
    return None


def _is_literal(formula: Unary) -> bool:
    return formula.op is Op.NOT and isinstance(formula.operand, Atom)

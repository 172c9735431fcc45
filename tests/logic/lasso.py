"""An evaluator of LTL on ultimately periodic words, written from the definitions and knowing nothing of automata."""

from __future__ import annotations

from collections.abc import Sequence

from models.logic import Atom, Constant, Formula, Op, children


def holds(formula: Formula, prefix: Sequence[frozenset[Atom]], loop: Sequence[frozenset[Atom]]) -> bool:
    """Whether the word prefix · loop^ω satisfies the formula."""
    return _values(formula, [*prefix, *loop], len(prefix))[0]


def _values(formula: Formula, word: list[frozenset[Atom]], back: int) -> list[bool]:
    """The formula's truth at each position of the lasso, whose last position is followed by position `back`."""
    positions = range(len(word))
    if isinstance(formula, Constant):
        return [formula.value] * len(word)
    if isinstance(formula, Atom):
        return [formula in letter for letter in word]
    parts = [_values(child, word, back) for child in children(formula)]
    after = [*range(1, len(word)), back]
    true = [True] * len(word)
    match formula.op:
        case Op.NOT:
            return [not value for value in parts[0]]
        case Op.AND:
            return [all(part[i] for part in parts) for i in positions]
        case Op.OR:
            return [any(part[i] for part in parts) for i in positions]
        case Op.IMPLIES:
            return [not parts[0][i] or parts[1][i] for i in positions]
        case Op.IFF:
            return [parts[0][i] == parts[1][i] for i in positions]
        case Op.NEXT:
            return [parts[0][after[i]] for i in positions]
        case Op.FINALLY:
            return _until(true, parts[0], after)
        case Op.GLOBALLY:
            return [not v for v in _until(true, [not value for value in parts[0]], after)]
        case Op.UNTIL:
            return _until(parts[0], parts[1], after)
        case Op.WEAK_UNTIL:  # until, or always
            until, breaks = _until(parts[0], parts[1], after), _until(true, [not v for v in parts[0]], after)
            return [until[i] or not breaks[i] for i in positions]
        case Op.STRONG_RELEASE:  # the right one holds up to and including a moment where both do
            return _until(parts[1], [parts[0][i] and parts[1][i] for i in positions], after)
        case _:  # RELEASE: the same, or the right one always
            both = _until(parts[1], [parts[0][i] and parts[1][i] for i in positions], after)
            breaks = _until(true, [not v for v in parts[1]], after)
            return [both[i] or not breaks[i] for i in positions]


def _until(left: list[bool], right: list[bool], after: list[int]) -> list[bool]:
    """Follow the lasso from each position until `right` holds, for as long as `left` does."""
    values = []
    for start in range(len(after)):
        i, result = start, False
        for _ in range(len(after) + 1):
            if right[i]:
                result = True
                break
            if not left[i]:
                break
            i = after[i]
        values.append(result)
    return values

"""Finding a simpler formula that says the same."""

from __future__ import annotations

from collections.abc import Iterator

from models.logic.formula import FALSE, TRUE, Atom, Constant, Formula, Nary, build, children, nary
from models.logic.spot import equivalent

_MOST_COMPARISONS = 400  # a comparison of small formulas takes well under a millisecond
_LARGEST = 60  # nodes of a formula that is worth comparing with what it shrinks to


def simplify(formula: Formula) -> Formula:
    """An equivalent formula from which every part is left out that may be, else `formula` itself.

    It finds that `F (a & F (a & b))` is `F (a & b)`. It rewrites nothing otherwise, so what it leaves out is what the
    formula says without demanding it. Formulas beyond a moderate size are returned as they are. Deterministic. Raises
    FormulaTooLargeError and SpotMissingError.
    """
    best = formula
    comparisons = 0
    smaller: Formula | None = best if best.size <= _LARGEST else None
    while smaller is not None:
        best, smaller = smaller, None
        for candidate in _smaller(best):
            comparisons += 1
            if comparisons > _MOST_COMPARISONS:
                return best
            if equivalent(candidate, best):
                smaller = candidate
                break
    return best


def _smaller(formula: Formula) -> Iterator[Formula]:
    """The formulas that differ from this one by one node being simpler, outermost first."""
    stack: list[tuple[Formula, tuple[tuple[Formula, int], ...]]] = [(formula, ())]
    while stack:
        node, path = stack.pop()
        for simpler in _simpler_nodes(node):
            yield _put_back(simpler, path)
        parts = children(node)
        stack.extend((part, (*path, (node, index))) for index, part in reversed(list(enumerate(parts))))


def _simpler_nodes(node: Formula) -> Iterator[Formula]:
    parts = children(node)
    if not isinstance(node, Constant):
        yield TRUE
        yield FALSE
    if isinstance(node, Nary) and len(parts) > 2:
        for index in range(len(parts)):
            yield nary(node.op, *parts[:index], *parts[index + 1 :])
    else:
        yield from parts


def _put_back(part: Formula, path: tuple[tuple[Formula, int], ...]) -> Formula:
    """The formula in which `part` stands where `path`, parents outermost first, leads."""
    for parent, index in reversed(path):
        if not isinstance(parent, (Atom, Constant)):
            parts = children(parent)
            part = build(parent.op, (*parts[:index], part, *parts[index + 1 :]))
    return part

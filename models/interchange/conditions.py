"""Conditions on the state of a grounded world, kept small while they are built.

A state is a digit for each variable. `Conditions` makes the nodes: equal conditions are one object, so that they are
compared by identity, and what is known where a condition is used (the variable is one of these digits) simplifies it.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, TypeAlias

from models.interchange.errors import ExportTooLargeError

MAX_PARTS = 2_000_000
"""Operands that are looked at while one world is translated."""


@dataclass(frozen=True, slots=True, eq=False)
class Fixed:
    """True or false in every state."""

    value: bool


@dataclass(frozen=True, slots=True, eq=False)
class Member:
    """The digit of a variable is one of the bits of `digits`."""

    position: int
    digits: int


@dataclass(frozen=True, slots=True, eq=False)
class Same:
    """Two variables have the same digit; only those of `common` occur in both."""

    left: int
    right: int
    common: int


@dataclass(frozen=True, slots=True, eq=False)
class Compared:
    """`left operator right` of two numbers (see models.interchange.values)."""

    operator: str
    left: Any
    right: Any


@dataclass(frozen=True, slots=True, eq=False)
class Not:
    """What a Same or Compared denies."""

    operand: Same | Compared


@dataclass(frozen=True, slots=True, eq=False)
class Joined:
    """All (`conjunctive`) or some of two or more operands, none of which is Joined alike."""

    conjunctive: bool
    operands: tuple[Condition, ...]


Condition: TypeAlias = Fixed | Member | Same | Compared | Not | Joined
TRUE = Fixed(True)
FALSE = Fixed(False)


class Conditions:
    """Makes conditions over variables with so many digits each. Raises ExportTooLargeError for too much work."""

    def __init__(self, radix: Sequence[int]) -> None:
        self.full = [(1 << count) - 1 for count in radix]
        self._known: dict[tuple[Any, ...], Condition] = {}
        self._left = MAX_PARTS

    def member(self, position: int, digits: int) -> Condition:
        """Whether the variable has one of the digits."""
        digits &= self.full[position]
        if digits in (0, self.full[position]):
            return TRUE if digits else FALSE
        return self._one(Member, position, digits)

    def same(self, left: int, right: int) -> Condition:
        """Whether two variables, whose digits mean the same, have the same digit."""
        left, right = sorted((left, right))
        return TRUE if left == right else self._one(Same, left, right, self.full[left] & self.full[right])

    def compared(self, operator: str, left: Any, right: Any) -> Condition:
        """A comparison of two numbers, not decided here."""
        return self._one(Compared, operator, left, right)

    def negate(self, condition: Condition) -> Condition:
        """The opposite; negation moves inwards."""
        self.spend(1)
        match condition:
            case Fixed(value=value):
                return FALSE if value else TRUE
            case Member(position=position, digits=digits):
                return self.member(position, ~digits)
            case Not(operand=operand):
                return operand
            case Joined(conjunctive=conjunctive, operands=operands):
                return self.join(not conjunctive, [self.negate(operand) for operand in operands])
            case _:
                return self._one(Not, condition)

    def join(self, conjunctive: bool, operands: Iterable[Condition]) -> Condition:
        """And, or: flat, each operand once, at most one Member for each variable, simplified by these."""
        flat = self._flat(conjunctive, operands)
        members, others = self._merged(conjunctive, flat)
        if members is None:
            return FALSE if conjunctive else TRUE
        known = members if conjunctive else {p: self.full[p] & ~digits for p, digits in members.items()}
        simpler = [self.restrict(other, known) for other in others] if members else others
        if any(new is not old for new, old in zip(simpler, others, strict=True)):
            return self.join(conjunctive, [*self._members(members), *simpler])
        return self._finish(conjunctive, flat, members)

    def conjoin(self, *operands: Condition) -> Condition:
        """All of them."""
        return self.join(True, operands)

    def disjoin(self, *operands: Condition) -> Condition:
        """Some of them."""
        return self.join(False, operands)

    def restrict(self, condition: Condition, known: Mapping[int, int]) -> Condition:
        """The condition where each variable at a position of `known` has one of these digits."""
        self.spend(1)
        match condition:
            case Member(position=position, digits=digits) if position in known:
                possible = known[position]
                return FALSE if not digits & possible else TRUE if not possible & ~digits else condition
            case Same(left=left, right=right, common=common):
                shared = common & known.get(left, common) & known.get(right, common)
                return condition if shared else FALSE
            case Not(operand=Same() as operand):
                return self.negate(self.restrict(operand, known))
            case Joined(conjunctive=conjunctive, operands=operands):
                inner = [self.restrict(operand, known) for operand in operands]
                changed = any(new is not old for new, old in zip(inner, operands, strict=True))
                return self.join(conjunctive, inner) if changed else condition
            case _:
                return condition

    def spend(self, parts: int) -> None:
        """Counts work. Raises ExportTooLargeError beyond the limit."""
        self._left -= parts
        if self._left < 0:
            raise ExportTooLargeError("the world is too large to be written in the PRISM language; export it as DRN")

    def _one(self, kind: Callable[..., Condition], *parts: Any) -> Condition:
        """The one node of these parts."""
        self.spend(1)
        key = (kind, *parts)
        if key not in self._known:
            self._known[key] = kind(*parts)
        return self._known[key]

    def _members(self, members: Mapping[int, int]) -> list[Condition]:
        return [self.member(position, digits) for position, digits in members.items()]

    def _flat(self, conjunctive: bool, operands: Iterable[Condition]) -> list[Condition]:
        flat: dict[Condition, None] = {}
        for operand in operands:
            inlined = isinstance(operand, Joined) and operand.conjunctive is conjunctive
            parts = operand.operands if isinstance(operand, Joined) and inlined else (operand,)
            self.spend(len(parts))
            flat.update(dict.fromkeys(parts))
        return list(flat)

    def _merged(self, conjunctive: bool, flat: Sequence[Condition]) -> tuple[dict[int, int] | None, list[Condition]]:
        """The digits left for each variable, and the other operands; None where an operand decides the whole."""
        members: dict[int, int] = {}
        others: list[Condition] = []
        present = set(flat)
        for operand in flat:
            if isinstance(operand, Fixed):
                if operand.value is not conjunctive:
                    return None, []
            elif isinstance(operand, Member):
                old = members.get(operand.position, self.full[operand.position] if conjunctive else 0)
                members[operand.position] = old & operand.digits if conjunctive else old | operand.digits
            elif self._opposite(operand) in present:
                return None, []
            else:
                others.append(operand)
        decided = [p for p, digits in members.items() if digits == (0 if conjunctive else self.full[p])]
        return (None, []) if decided else (members, others)

    def _opposite(self, operand: Condition) -> Condition | None:
        """The node that denies a comparison, if there is one."""
        return operand.operand if isinstance(operand, Not) else self._known.get((Not, operand))

    def _finish(self, conjunctive: bool, flat: Sequence[Condition], members: dict[int, int]) -> Condition:
        """The merged operands in the order in which they were given, without Members that a Same implies."""
        if conjunctive:
            for same in [operand for operand in flat if isinstance(operand, Same)]:
                for position in (same.left, same.right):
                    if position in members and not same.common & ~members[position]:
                        del members[position]
        kept: dict[Condition, None] = {}
        for operand in flat:
            if isinstance(operand, Member):
                if operand.position in members:
                    kept[self.member(operand.position, members[operand.position])] = None
            elif not isinstance(operand, Fixed):
                kept[operand] = None
        if len(kept) < 2:
            return next(iter(kept), TRUE if conjunctive else FALSE)
        return self._one(Joined, conjunctive, tuple(kept))

"""Conditions, entities and numbers as text of the PRISM language."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import assert_never

from models.interchange.conditions import Compared, Condition, Fixed, Joined, Member, Not, Same
from models.interchange.errors import ExportTooLargeError
from models.interchange.values import LEVELS, Arithmetic, Choice, Constant, Count, Entity, Known, Lookup, Number
from models.world.vocabulary import Symbol

MAX_CHARACTERS = 2**26
"""Characters of one exported text."""
_LISTED = 3  # so many digits in a row are written one by one, more as a range
_CHAINED = 64  # longer chains of & and | are bracketed into a tree, which no parser's stack minds


@dataclass(slots=True)
class Renderer:
    """Writes for variables of these identifiers, whose digits are written as `digits[position][digit]`."""

    variables: Sequence[str]
    digits: Sequence[Sequence[str]]
    _texts: dict[Condition, str] = field(default_factory=dict)
    _written: int = 0

    def condition(self, condition: Condition, *, operand: bool = False) -> str:
        """A condition; with brackets around & and | if it is an operand of something."""
        if condition not in self._texts:
            self._texts[condition] = self._condition(condition)
        text = self._texts[condition]
        self._written += len(text)
        if self._written > MAX_CHARACTERS:
            raise ExportTooLargeError(f"the PRISM text would have more than {MAX_CHARACTERS} characters")
        if operand and isinstance(condition, Joined):
            return f"({text})"
        return _bracketed(text) if operand and isinstance(condition, Member) else text

    def number(self, number: Number, level: int = 0) -> str:
        """A number, in brackets if it binds less tightly than `level`."""
        match number:
            case Constant(text=text, level=own):
                return text if own >= level else f"({text})"
            case Count(base=base, conditions=conditions):
                terms = [f"({self.condition(condition, operand=True)} ? 1 : 0)" for condition in conditions]
                total = " + ".join([*terms, str(base)] if base else terms)
                return f"({total})" if level > 1 and " + " in total else total
            case Arithmetic(operator=operator, left=left, right=right):
                own = LEVELS[operator]
                text = f"{self.number(left, own)} {operator} {self.number(right, own + 1)}"
                return text if own >= level else f"({text})"
            case Choice(condition=condition, then=then, otherwise=otherwise):
                test = self.condition(condition, operand=True)
                return f"({test} ? {self.number(then)} : {self.number(otherwise)})"
            case _:
                assert_never(number)

    def assignment(self, position: int, entity: Entity, values: Mapping[Symbol | None, int]) -> str | None:
        """The digit that the variable gets, as an expression; None where none of its values ever comes out.

        `values` is the digit of each value. What is no value of the variable cannot come out where the action is
        possible, so that anything may stand for it.
        """
        match entity:
            case Known(symbol=symbol):
                return self.digits[position][values[symbol]] if symbol in values else None
            case Lookup():
                return self._lookup(position, entity, values)
            case _:
                then = self.assignment(position, entity.then, values)
                otherwise = self.assignment(position, entity.otherwise, values)
                if then is None or otherwise is None or then == otherwise:
                    return otherwise if then is None else then
                return f"({self.condition(entity.condition, operand=True)} ? {then} : {otherwise})"

    def member(self, position: int, digits: int) -> str:
        """Whether a variable has one of the digits given as bits: a list, ranges, or what it has not."""
        name, count = self.variables[position], len(self.digits[position])
        absent = ((1 << count) - 1) & ~digits
        inside, outside = _runs(digits, count), _runs(absent, count)
        if len(outside) == 1 and outside[0][0] == outside[0][1] and count > 2:
            return f"{name} != {self.digits[position][outside[0][0]]}"
        if len(outside) < len(inside):
            return f"!({self.member(position, absent)})"
        parts = [part for run in inside for part in self._run(position, run)]
        return parts[0] if len(parts) == 1 else _chain([_bracketed(part) for part in parts], " | ")

    def _run(self, position: int, run: tuple[int, int]) -> list[str]:
        name, digits = self.variables[position], self.digits[position]
        first, last = run
        if last - first < _LISTED:
            return [f"{name} = {digits[digit]}" for digit in range(first, last + 1)]
        low, high = f"{name} >= {digits[first]}", f"{name} <= {digits[last]}"
        if first == 0:
            return [high]
        return [low] if last == len(digits) - 1 else [f"{low} & {high}"]

    def _condition(self, condition: Condition) -> str:
        match condition:
            case Fixed(value=value):
                return "true" if value else "false"
            case Member(position=position, digits=digits):
                return self.member(position, digits)
            case Same(left=left, right=right):
                return f"{self.variables[left]} = {self.variables[right]}"
            case Not(operand=Same(left=left, right=right)):
                return f"{self.variables[left]} != {self.variables[right]}"
            case Not(operand=operand):
                return f"!({self.condition(operand)})"
            case Compared(operator=operator, left=left, right=right):
                sign = "=" if operator == "==" else operator
                return f"{self.number(left, 1)} {sign} {self.number(right, 1)}"
            case Joined(conjunctive=conjunctive, operands=operands):
                parts = [self.condition(operand, operand=True) for operand in operands]
                return _chain(parts, " & " if conjunctive else " | ")
            case _:
                assert_never(condition)

    def _lookup(self, position: int, entity: Lookup, values: Mapping[Symbol | None, int]) -> str | None:
        targets = [values.get(symbol) for symbol in entity.symbols]
        if all(target is None for target in targets):
            return None
        count = len(self.digits[position])
        shifts = _groups([None if t is None else t - digit for digit, t in enumerate(targets)], count)
        if shifts and len(shifts) < len(_groups(targets)):
            name = self.variables[entity.position]
            ways = {shift: name if shift == 0 else f"{name} {'+-'[shift < 0]} {abs(shift)}" for shift in shifts}
            groups = shifts
        else:
            groups = _groups(targets)
            ways = {target: self.digits[position][target] for target in groups}
        return self._cases(entity.position, groups, ways)

    def _cases(self, position: int, groups: Mapping[int, int], ways: Mapping[int, str]) -> str:
        """Nested choices between a few groups of digits, or a search tree over many."""
        if len(groups) <= 4:
            *tested, (last, _) = sorted(groups.items(), key=lambda item: item[1].bit_count())
            text = ways[last]
            for key, digits in reversed(tested):
                text = f"({_bracketed(self.member(position, digits))} ? {ways[key]} : {text})"
            return text
        runs = sorted((run[0], key) for key, digits in groups.items() for run in _runs(digits, digits.bit_length()))
        return self._search(position, runs, ways)

    def _search(self, position: int, runs: Sequence[tuple[int, int]], ways: Mapping[int, str]) -> str:
        if len(runs) == 1:
            return ways[runs[0][1]]
        middle = len(runs) // 2
        below, above = self._search(position, runs[:middle], ways), self._search(position, runs[middle:], ways)
        return f"({self.variables[position]} < {self.digits[position][runs[middle][0]]} ? {below} : {above})"


def _groups(keys: Sequence[int | None], count: int | None = None) -> dict[int, int]:
    """The digits, as bits, of each key; a digit without a key goes with any other.

    With a count, keys are added to digits, and the sum is to stay below the count; nothing where that cannot be.
    """
    groups: dict[int, int] = {}
    for digit, key in enumerate(keys):
        if key is not None:
            groups[key] = groups.get(key, 0) | 1 << digit
    for digit in (digit for digit, key in enumerate(keys) if key is None):
        fitting = (key for key in groups if count is None or 0 <= digit + key < count)
        chosen = next(fitting, None)
        if chosen is None:
            return {}
        groups[chosen] |= 1 << digit
    return groups


def _runs(digits: int, count: int) -> list[tuple[int, int]]:
    """First and last digit of each run of neighbouring bits."""
    bits = bin(digits)[:1:-1][:count]
    return [(run.start(), run.end() - 1) for run in re.finditer("1+", bits)]


def _chain(parts: Sequence[str], sign: str) -> str:
    if len(parts) <= _CHAINED:
        return sign.join(parts)
    size = -(-len(parts) // _CHAINED)
    size = max(size, 2)
    return _chain([f"({_chain(parts[i : i + size], sign)})" for i in range(0, len(parts), size)], sign)


def _bracketed(text: str) -> str:
    """The text of a Member as an operand of something."""
    return f"({text})" if (" & " in text or " | " in text) and not text.startswith("!(") else text

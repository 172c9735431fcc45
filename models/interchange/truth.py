"""Conditions evaluated over all combinations of the few variables they read: what always holds need not be written."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import prod
from typing import Any, assert_never

import numpy as np
from numpy.typing import NDArray

from models.interchange.conditions import Compared, Condition, Fixed, Joined, Member, Not, Same
from models.interchange.values import COMPARISONS, OPERATIONS, Arithmetic, Choice, Constant, Count, Number

MAX_COMBINATIONS = 2**16
"""Combinations of digits over which a condition is evaluated to leave it out where it always holds."""
Digits = Mapping[int, NDArray[np.int64]]


def always(condition: Condition, radix: Sequence[int]) -> bool:
    """Whether the condition is known to hold in every state; False where that takes too long to find out."""
    positions = sorted(variables(condition))
    if prod(radix[position] for position in positions) > MAX_COMBINATIONS:
        return False
    axes = np.indices([radix[position] for position in positions], sparse=True, dtype=np.int64)
    with np.errstate(all="ignore"):
        return bool(np.all(truth(condition, dict(zip(positions, axes, strict=True)), {})))


def truth(condition: Condition, digits: Digits, memo: dict[Condition, NDArray[Any]]) -> NDArray[Any]:
    """Where the condition holds; an array that broadcasts against those of `digits`."""
    if condition not in memo:
        memo[condition] = np.asarray(_truth(condition, digits, memo))
    return memo[condition]


def _truth(condition: Condition, digits: Digits, memo: dict[Condition, NDArray[Any]]) -> Any:
    match condition:
        case Fixed(value=value):
            return value
        case Member(position=position, digits=allowed):
            table = np.array([allowed >> digit & 1 for digit in range(allowed.bit_length())], dtype=np.bool_)
            inside = digits[position] < len(table)
            return inside & table[np.where(inside, digits[position], 0)]
        case Same(left=left, right=right):
            return digits[left] == digits[right]
        case Not(operand=denied):
            return ~truth(denied, digits, memo)
        case Compared(operator=operator, left=left, right=right):
            return COMPARISONS[operator](_value(left, digits, memo), _value(right, digits, memo))
        case Joined(conjunctive=conjunctive, operands=operands):
            result = truth(operands[0], digits, memo)
            for operand in operands[1:]:
                other = truth(operand, digits, memo)
                result = result & other if conjunctive else result | other
            return result
        case _:
            assert_never(condition)


def _value(number: Number, digits: Digits, memo: dict[Condition, NDArray[Any]]) -> Any:
    match number:
        case Constant(value=value):
            return np.float64(value)
        case Count(base=base, conditions=conditions):
            return base + sum(truth(condition, digits, memo).astype(np.int64) for condition in conditions)
        case Arithmetic(operator=operator, left=left, right=right):
            return OPERATIONS[operator](_value(left, digits, memo), _value(right, digits, memo))
        case Choice(condition=condition, then=then, otherwise=otherwise):
            where = truth(condition, digits, memo)
            return np.where(where, _value(then, digits, memo), _value(otherwise, digits, memo))
        case _:
            assert_never(number)


def variables(condition: Condition) -> set[int]:
    """The positions of the variables that a condition reads."""
    found: set[int] = set()
    seen: set[int] = set()
    waiting: list[Condition | Number] = [condition]
    while waiting:
        node = waiting.pop()
        if id(node) in seen:
            continue
        seen.add(id(node))
        match node:
            case Member(position=position):
                found.add(position)
            case Same(left=left, right=right):
                found |= {left, right}
            case Not(operand=operand):
                waiting.append(operand)
            case Joined(operands=operands):
                waiting.extend(operands)
            case Compared(left=left_number, right=right_number) | Arithmetic(left=left_number, right=right_number):
                waiting += [left_number, right_number]
            case Count(conditions=conditions):
                waiting.extend(conditions)
            case Choice(condition=test, then=then, otherwise=otherwise):
                waiting += [test, then, otherwise]
            case _:
                pass
    return found

"""Compound names of atoms, `ball_in_small_bucket`, read through display patterns."""

from __future__ import annotations

import re
from collections.abc import Iterator

from models.logic.formula import Atom, Name
from models.world.domain import Function
from models.world.limits import MAX_NAME
from models.world.vocabulary import Symbol, Vocabulary

_HOLE = re.compile(r"\{([^{}]*)\}")
_MOST_READINGS = 8
_LONGEST = 8 * MAX_NAME


def readings(text: str, vocabulary: Vocabulary) -> tuple[Atom, ...]:
    """Every atom that some display pattern writes as `text`, each once; at most a few."""
    if len(text) > _LONGEST:
        return ()
    plain = _plain(text)
    found: dict[Atom, None] = {}
    for function in vocabulary.functions.values():
        for pattern in function.display:
            for atom in _matches(plain, pattern, function, vocabulary):
                found[atom] = None
                if len(found) == _MOST_READINGS:
                    return tuple(found)
    return tuple(found)


def _plain(text: str) -> str:
    return re.sub(r"[\s_]+", "_", text.strip()).casefold()


def _matches(text: str, pattern: str, function: Function, vocabulary: Vocabulary) -> Iterator[Atom]:
    parts = _HOLE.split(pattern)  # literal, hole, literal, hole, ..., literal
    parameters = {parameter.name: parameter for parameter in function.parameters}
    literals = [_plain_literal(literal) for literal in parts[::2]]
    options = [_spellings(vocabulary.symbols(*parameters[hole].kinds), vocabulary) for hole in parts[1::2]]
    dead: set[tuple[int, int]] = set()

    def walk(index: int, start: int) -> Iterator[tuple[Symbol, ...]]:
        if (index, start) in dead or not text.startswith(literals[index], start):
            return
        start += len(literals[index])
        if index == len(options):
            if start == len(text):
                yield ()
            return
        alive = False
        for spelling, symbol in options[index]:
            if text.startswith(spelling, start):
                for rest in walk(index + 1, start + len(spelling)):
                    alive = True
                    yield (symbol, *rest)
        if not alive:
            dead.add((index, start - len(literals[index])))

    for symbols in walk(0, 0):
        by_hole = dict(zip(parts[1::2], symbols, strict=True))
        yield Atom(function.name, tuple(Name(by_hole[name].name) for name in parameters))


def _plain_literal(literal: str) -> str:
    return re.sub(r"[\s_]+", "_", literal).casefold()


def _spellings(symbols: tuple[Symbol, ...], vocabulary: Vocabulary) -> list[tuple[str, Symbol]]:
    """Names before synonyms, so that a name's reading comes first."""
    names = [(_plain(symbol.name), symbol) for symbol in symbols]
    return names + [(_plain(other), symbol) for symbol in symbols for other in vocabulary.synonyms.get(symbol, ())]

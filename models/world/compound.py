"""Compound names of atoms, `ball_in_small_bucket`, read through display patterns."""

from __future__ import annotations

import re
from collections.abc import Iterator
from functools import lru_cache

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


def unknown_part(text: str, vocabulary: Vocabulary) -> tuple[str, Function] | None:
    """The part of a compound name that names nothing, where a pattern of one or two arguments fits otherwise."""
    if len(text) > _LONGEST:
        return None
    plain = _plain(text)
    for function in vocabulary.functions.values():
        kinds = {parameter.name: parameter.kinds for parameter in function.parameters}
        for pattern in function.display:
            literals, holes = _HOLE.split(pattern)[::2], _HOLE.split(pattern)[1::2]
            if not 1 <= len(holes) <= 2:
                continue
            match = re.fullmatch("(.+)".join(re.escape(_plain_literal(literal)) for literal in literals), plain)
            if match is None:
                continue
            spelled = [{name for name, _ in _spellings(vocabulary.symbols(*kinds[hole]), vocabulary)} for hole in holes]
            unknown = [part for part, known in zip(match.groups(), spelled, strict=True) if part not in known]
            if len(unknown) == 1:
                return unknown[0], function
    return None


@lru_cache(maxsize=32_768)
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
    return [(_plain(name), symbol) for symbol in symbols for name in vocabulary.names(symbol)]

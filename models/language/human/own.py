"""What the translator knew before it read any of the human commands: its own ways to send a robot to places.

The commands of this repository (`models/language/dataset/composition.yaml`) that only go to places, one after the
other, to any of them, never to others, and so on, are said of the things of a data set and put into its formulas. So a
template is known though no command of the training set has it; but only if it is a part of one that is there, or that
one itself: what else people may mean is not made up.
"""

from __future__ import annotations

import random
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from itertools import permutations

from models.language.composition.shapes import read_shape
from models.language.dataset.composition import Form, Pattern, leaves, patterns, slot_elements
from models.language.human.environment import Environment, Name, Sentence
from models.language.human.lifting import Lifted, arity, fill, lift_formula
from models.language.human.spelling import Spelled, read
from models.language.tokens import is_mark
from models.logic import Atom, Formula, Op, Parameter, Unary, build, equivalent
from models.queries import ContextualQuery, Query, compose

GOING = "navigate_one"
"""The task of a clause that goes to a place."""
FORMS = frozenset({"do", "doing", "done", "state", "it", "echo"})
"""Forms of clauses that go to a place."""
_HOLE = re.compile(r"\$\d+")
OPERATORS = {
    "finally": Op.FINALLY,
    "globally": Op.GLOBALLY,
    "always": Op.GLOBALLY,
    "not": Op.NOT,
    "and": Op.AND,
    "or": Op.OR,
    "until": Op.UNTIL,
}
TEMPORAL = frozenset({"finally", "until"})
"""Operators of which one is in what may be meant alone."""
_PLACE = None
"""Stands for a place within a clause."""


@dataclass(frozen=True, slots=True)
class Way:
    """A way to say a template: a pattern, and for each hole of the template the clause that goes there."""

    pattern: Pattern
    clauses: tuple[int, ...]


@dataclass(frozen=True, slots=True)
class OwnCommands:
    """The ways to say what may be meant, by template."""

    ways: Mapping[str, Sequence[Way]]
    environment: Environment

    @classmethod
    def of(cls, templates: Iterable[str], environment: Environment) -> OwnCommands:
        """Of the templates of a training set and their parts; nothing where its things are no places."""
        places = environment.places
        if places is None:
            return cls({}, environment)
        may_be = sorted({numbered(part) for template in templates for part in parts(template)})
        found = {template: _ways(template, places.means) for template in may_be}
        return cls({template: ways for template, ways in found.items() if ways}, environment)

    def draw(self, count: int, generator: random.Random) -> list[Lifted]:
        """So many commands, of each template about as many; none where nothing is known."""
        templates = sorted(self.ways)
        chosen = generator.choices(templates, k=count) if templates else []
        return [self._command(generator.choice(self.ways[template]), template, generator) for template in chosen]

    def _command(self, way: Way, template: str, generator: random.Random) -> Lifted:
        """A template, said in a way, of different places of any kinds."""
        places = self.environment.places
        assert places is not None
        called = {thing: names for kind in places.kinds for thing, names in self.environment.kinds[kind].items()}
        things = dict(zip(way.clauses, generator.sample(sorted(called), len(way.clauses)), strict=True))
        before, _, after = places.says.partition("{}")
        text: list[str] = []
        names: list[Name] = []
        for word, leaf in _spoken(way.pattern, generator):
            if word is not _PLACE:
                text.append(word)
                continue
            name = generator.choice(called[things[leaf]])
            text += [*(() if text[-1:] == ["no"] else ("the",)), *before.split()]
            names.append(Name(len(text), len(text) + len(name), things[leaf]))
            text += [*name, *after.split()]
        formula = fill(template, list(things.values()))
        return Lifted(Sentence(tuple(text), tuple(names)), *lift_formula(formula, list(things.values())))


def parts(template: str) -> Iterator[str]:
    """A template and its parts that bid to do something: also `finally ( $1 )` of `and ( finally ( $1 ) , ... )`."""
    spelled = read(template)
    for part in () if spelled is None else spelled.walk():
        if any(inner.head in TEMPORAL for inner in part.walk()):
            yield str(part)


def numbered(template: str) -> str:
    """The template with its holes numbered in the order in which they first stand there."""
    order = {hole: f"${number}" for number, hole in enumerate(dict.fromkeys(_HOLE.findall(template)), start=1)}
    return _HOLE.sub(lambda hole: order[hole[0]], template)


@cache
def _ways(template: str, means: str) -> tuple[Way, ...]:
    """The ways to say a template, or an equivalent one, of places where the robot is by the proposition `means`."""
    meant, holes = read_formula(template, means), range(1, arity(template) + 1)
    if meant is None:
        return ()
    ways: list[Way] = []
    for shape, found in patterns().items():
        query = read_shape(shape)
        if len({task for _, task in query.tasks}) != len(holes):
            continue
        said = [pattern for pattern in found if all(hole.form in FORMS for hole in pattern.holes)]
        order = next((order for order in permutations(holes) if equivalent(_meaning(query, order), meant)), None)
        ways += [Way(pattern, order) for pattern in said] if order else []
    return tuple(ways)


def read_formula(template: str, means: str) -> Formula | None:
    """A template in the spelling of the data sets as a formula of the places `$1`, `$2`, ...; None where it says more
    than where the robot is, by the proposition `means`.
    """
    spelled = read(template)
    return None if spelled is None else _formula(spelled, means)


def _formula(spelled: Spelled, means: str) -> Formula | None:
    if not spelled.operands:
        hole = _HOLE.search(spelled.head)
        return None if hole is None or spelled.head != means.format(hole[0]) else _at(int(hole[0][1:]))
    operands = [_formula(operand, means) for operand in spelled.operands]
    known = [operand for operand in operands if operand is not None]
    return build(OPERATORS[spelled.head], known) if len(known) == len(operands) and spelled.head in OPERATORS else None


def _meaning(shape: Query, order: Sequence[int]) -> Formula:
    """What a shape means (docs/http.md, "Composed queries") whose clauses go to places: `order` has for each of these
    the number of its clause.
    """
    if isinstance(shape, ContextualQuery):
        return Unary(Op.FINALLY, _at(order.index(int(shape.arguments[0])) + 1))
    return compose(shape.operator, [_meaning(operand, order) for operand in shape.operands])


def _at(position: int) -> Atom:
    return Atom("at", (Parameter(position),))


def _spoken(way: Pattern, generator: random.Random) -> Iterator[tuple[str | None, int]]:
    """The words of a way without marks, and the places of its clauses, each with the number of its clause."""
    heard: dict[int, str] = {}
    for element in way.elements:
        if isinstance(element, str):
            yield from () if is_mark(element) else ((element, 0),)
            continue
        if element.form != "echo":
            heard[element.leaf] = "{place}" if element.form == "it" else generator.choice(_clauses(element.form))
        for part in slot_elements(heard[element.leaf]):
            yield (part if isinstance(part, str) else _PLACE), element.leaf


@cache
def _clauses(form: Form) -> Sequence[str]:
    """The clauses of a form that go to a place."""
    return [leaf.forms[form] for leaf in leaves() if leaf.task == GOING and form in leaf.forms]

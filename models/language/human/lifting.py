"""Lifting: a formula as a template and the things that fill it, and a command with what names them.

The template is the task class of the contextual query, the phrases are its arguments. As in CQ-LTL (paper, § Approach),
a thing of the formula that no phrase of the command names stays a constant of the template.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass

from models.language.human.data import Command
from models.language.human.environment import Environment, Sentence, occurrences
from models.language.spans.items import Item

_HOLE = re.compile(r"\$(\d+)")


@dataclass(frozen=True, slots=True)
class Lifted:
    """A command, the template of its formula, and the things that fill `$1`, `$2`, ... of the template."""

    sentence: Sentence
    template: str
    things: tuple[str, ...]

    def item(self, sentence: Sentence) -> Item:
        """What a network is to learn of the sentence, which is the command's or the same with other names."""
        mentions = tuple(
            tuple((name.begin, name.end) for name in sentence.names if name.thing == thing) for thing in self.things
        )
        return Item(sentence.words, self.template, mentions)


def lift(command: Command, environment: Environment) -> Lifted:
    """Take the things that the text names out of the formula, in the formula's order."""
    sentence = environment.sentence(command.text)
    named = {name.thing for name in sentence.names}
    template, things = lift_formula(command.formula, [thing for thing in environment.kind_of if thing in named])
    return Lifted(sentence, template, things)


def lift_formula(formula: str, things: Sequence[str]) -> tuple[str, tuple[str, ...]]:
    """The formula with `$1`, `$2`, ... for these of its things, and the things by number.

    A thing is known by whole words of the formula. The same thing has the same number everywhere.
    """
    spoken = formula.split()
    found = occurrences(spoken, {tuple(thing.split()): thing for thing in things}) if things else []
    numbers = {thing: f"${number}" for number, thing in enumerate(dict.fromkeys(thing for *_, thing in found), start=1)}
    parts: list[str] = []
    place = 0
    for begin, end, thing in found:
        parts += [*spoken[place:begin], numbers[thing]]
        place = end
    return " ".join([*parts, *spoken[place:]]), tuple(numbers)


def fill(template: str, things: Sequence[str]) -> str:
    """The formula of a template and the things that fill it, all at once; the inverse of `lift_formula`."""
    return _HOLE.sub(lambda hole: things[int(hole[1]) - 1], template)


def arity(template: str) -> int:
    """How many things fill a template."""
    return max((int(number) for number in _HOLE.findall(template)), default=0)


def with_usual_constants(commands: Sequence[Lifted], environment: Environment) -> list[Lifted]:
    """The commands with one constant in each place of a template: the one that most of them have there.

    What a command does not name cannot be told from it ("go to the red room without changing floors"): all that can be
    learned is the most frequent.
    """
    counts = Counter(command.template for command in commands)
    usual: dict[str, str] = {}
    for template in sorted(counts, key=lambda template: (-counts[template], template)):
        usual.setdefault(_shape(template, environment), template)
    return [
        Lifted(command.sentence, usual[_shape(command.template, environment)], command.things) for command in commands
    ]


def _shape(template: str, environment: Environment) -> str:
    """The template with the kind of each constant for the constant."""
    spoken = template.split()
    kinds = environment.kind_of
    for begin, end, thing in reversed(occurrences(spoken, {tuple(thing.split()): thing for thing in kinds})):
        spoken[begin:end] = [f"<{kinds[thing]}>"]
    return " ".join(spoken)

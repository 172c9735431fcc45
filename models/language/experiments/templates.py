"""Templates for evaluation, derived by the CQ-LTL algorithm from translations that are right (paper, § Learning
Templated LTL via CQ-LTL)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from models.errors import CqltlError
from models.language.experiments.commands import CommandSet
from models.language.experiments.comparison import same_meaning
from models.language.experiments.measurement import Resolver
from models.logic import Formula
from models.queries import ContextualQuery, Template, learn
from models.queries import Example as Lesson


@dataclass(frozen=True, slots=True)
class Lessons:
    """What templates are learned from.

    Attributes:
        accurate: by task class, how many commands got the right query and an equivalent formula.
        templates: by task class, learned from the first of them that has distinct arguments and is not ambiguous.
    """

    accurate: Mapping[str, int]
    templates: Mapping[str, Template]


def jointly_accurate(
    commands: CommandSet, queries: Sequence[ContextualQuery | None], formulas: Sequence[Formula | None]
) -> Lessons:
    """Learn from the commands that two systems both translate rightly, one into queries, one into formulas.

    One example makes a template. A task class with no example that will do gets none.
    """
    resolver = Resolver(commands.environment)
    accurate: dict[str, int] = {}
    templates: dict[str, Template] = {}
    for example, expected, query, said in zip(commands.examples, commands.expected, queries, formulas, strict=True):
        formula = resolver.resolve(said)
        if query != example.query or formula is None or not same_meaning(formula, expected):
            continue
        accurate[example.task] = accurate.get(example.task, 0) + 1
        if example.task not in templates and example.distinct:
            template = _learn(Lesson(query, formula), commands)
            if template is not None:
                templates[example.task] = template
    return Lessons(accurate, templates)


def given(commands: CommandSet) -> Mapping[str, Template]:
    """Templates from one example of each task class, with the right query and formula."""
    return jointly_accurate(commands, [example.query for example in commands.examples], commands.expected).templates


def _learn(lesson: Lesson, commands: CommandSet) -> Template | None:
    try:
        return learn([lesson], commands.environment)
    except CqltlError:  # a homonym leaves more than one way to tie arguments to places: another example will do
        return None

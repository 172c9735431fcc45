"""How often a system is right on a set of commands, by task class, and why it is wrong where it is."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, field
from typing import Self

from models.errors import CqltlError
from models.language.dataset import Example
from models.language.experiments.answer import Answer, System
from models.language.experiments.causes import Cause, cause_of_formula, cause_of_query
from models.language.experiments.commands import CommandSet
from models.language.experiments.comparison import same_meaning, says, shape
from models.logic import Formula, to_text
from models.world import Environment, resolve

OVERALL = "overall"
"""What all task classes together are called."""
SHOWN = 3
"""Commands that are kept as examples of one cause in one task class."""


@dataclass(frozen=True, slots=True)
class Score:
    """Counts of right answers out of `total`.

    Attributes:
        query: exactly the right contextual query.
        ltl: a grounded formula that Spot says is equivalent to the right one.
        text: a grounded formula that is written exactly as the right one.
        structure: the right class of task, or for a system that speaks formulas only, the right operators.
    """

    total: int = 0
    query: int = 0
    ltl: int = 0
    text: int = 0
    structure: int = 0

    def __add__(self, other: Self) -> Score:
        return Score(
            self.total + other.total,
            self.query + other.query,
            self.ltl + other.ltl,
            self.text + other.text,
            self.structure + other.structure,
        )

    def rate(self, measure: str) -> float:
        """The part of the answers that are right by a measure, one of the fields; raises KeyError for another."""
        return float(asdict(self)[measure]) / self.total if self.total else 1.0


@dataclass(frozen=True, slots=True)
class Failure:
    """A command that was answered wrongly, and the answer as text."""

    text: str
    answer: str
    expected: str


@dataclass(slots=True)
class Failures:
    """The wrong answers of one cause: how many, and the first few commands, of different meaning."""

    count: int = 0
    examples: list[Failure] = field(default_factory=list)


@dataclass(frozen=True, slots=True)
class Measurement:
    """Scores by task class; failures by task class and cause; whether each formula is equivalent to the right one."""

    scores: Mapping[str, Score]
    failures: Mapping[str, Mapping[Cause, Failures]]
    right: tuple[bool, ...]

    @property
    def overall(self) -> Score:
        """All task classes together."""
        return sum(self.scores.values(), Score())

    @property
    def groups(self) -> dict[str, Score]:
        """The scores by task class, after that of all together."""
        return {OVERALL: self.overall, **self.scores}


def measure(system: System, commands: CommandSet) -> Measurement:
    """Ask the system every command of the set and count."""
    return judge(system.answer(commands.texts, commands.environment), commands, queries=system.speaks_queries)


def judge(answers: Sequence[Answer], commands: CommandSet, *, queries: bool) -> Measurement:
    """Count the right answers; `queries` says whether the system speaks contextual queries."""
    resolver = Resolver(commands.environment)
    scores: dict[str, Score] = {}
    failures: dict[str, dict[Cause, Failures]] = {}
    outcomes = []
    for answer, example, expected in zip(answers, commands.examples, commands.expected, strict=True):
        formula = resolver.resolve(answer.formula)
        right = formula is not None and same_meaning(formula, expected)
        outcomes.append(right)
        scores[example.task] = scores.get(example.task, Score()) + Score(
            total=1,
            query=says(answer.query, example),
            ltl=right,
            text=formula is not None and formula == expected,
            structure=_structure(answer, example, expected, queries=queries),
        )
        causes = failures.setdefault(example.task, {})
        if not right:
            cause = cause_of_query(answer, example) if queries else cause_of_formula(answer, expected)
            _note(causes.setdefault(cause, Failures()), answer, example, expected, queries=queries)
    return Measurement(scores, failures, tuple(outcomes))


@dataclass(slots=True)
class Resolver:
    """Formulas with the names of an environment, each looked up once."""

    environment: Environment
    _known: dict[Formula, Formula | None] = field(default_factory=dict)

    def resolve(self, formula: Formula | None) -> Formula | None:
        """The formula resolved, or None when the environment does not have what it names."""
        if formula is None:
            return None
        if formula not in self._known:
            try:
                self._known[formula] = resolve(formula, self.environment)
            except CqltlError:
                self._known[formula] = None
        return self._known[formula]


def _structure(answer: Answer, example: Example, expected: Formula, *, queries: bool) -> bool:
    if queries:
        return answer.query is not None and answer.query.task == example.task
    return answer.formula is not None and shape(answer.formula) == shape(expected)


def _note(failures: Failures, answer: Answer, example: Example, expected: Formula, *, queries: bool) -> None:
    """Count a failure, and keep it as an example if those kept are few and of other meaning."""
    failures.count += 1
    if len(failures.examples) == SHOWN:
        return
    said = answer.query if queries else answer.formula and to_text(answer.formula)
    wanted = str(example.query) if queries else to_text(expected)
    shown = Failure(example.text, "nothing" if said is None else str(said), wanted)
    if all(shown.expected != other.expected for other in failures.examples):
        failures.examples.append(shown)

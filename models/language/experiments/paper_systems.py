"""The paper's systems at one point of their training: what they said, and what it means once it is grounded."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from models.language.experiments.answer import Answer
from models.language.experiments.causes import NO_TEMPLATE
from models.language.experiments.commands import CommandSet
from models.language.experiments.naming import answer_by_name
from models.language.experiments.templates import Lessons, jointly_accurate
from models.language.experiments.transcript import Transcript
from models.logic import Formula
from models.queries import ContextualQuery, Template
from models.world import Environment

CQ, POS, LTL = "CQ-CopyNet", "CQ-CopyNet+POS", "LTL-CopyNet"
NAMES = (CQ, POS, LTL)
QUERY_NAMES = {CQ: CQ, POS: POS}
"""What the paper calls the systems that it asks for contextual queries."""
LTL_NAMES = {LTL: LTL, CQ: "CQ-LTL-CopyNet", POS: "CQ-LTL-CopyNet+POS"}
"""What it calls them when it asks for grounded LTL."""


@dataclass(frozen=True, slots=True, eq=False)
class QuerySystem:
    """CQ-LTL-CopyNet or CQ-LTL-CopyNet+POS: contextual queries by text, put into templates and grounded by name."""

    name: str
    said: Mapping[str, ContextualQuery | None]
    templates: Mapping[str, Template]

    @property
    def speaks_queries(self) -> bool:
        """See `System`."""
        return True

    def answer(self, texts: Sequence[str], environment: Environment) -> list[Answer]:
        """See `System`; raises KeyError for a text that was not asked."""
        queries = [self.said[text] for text in texts]
        grounded = {query: self._ground(query, environment) for query in dict.fromkeys(queries)}
        return [grounded[query] for query in queries]

    def _ground(self, query: ContextualQuery | None, environment: Environment) -> Answer:
        if query is None:
            return Answer()
        template = self.templates.get(query.task)
        if template is None:
            return Answer(query, refusal=NO_TEMPLATE)
        return answer_by_name(template, query, environment)


@dataclass(frozen=True, slots=True, eq=False)
class FormulaSystem:
    """LTL-CopyNet: formulas by text."""

    name: str
    said: Mapping[str, Formula | None]

    @property
    def speaks_queries(self) -> bool:
        """See `System`."""
        return False

    def answer(self, texts: Sequence[str], environment: Environment) -> list[Answer]:  # noqa: ARG002
        """See `System`; raises KeyError for a text that was not asked."""
        return [Answer(formula=self.said[text]) for text in texts]


@dataclass(frozen=True, slots=True, eq=False)
class PaperSystems:
    """The three systems, and by name of those that speak queries, what their templates were learned from."""

    queries: QuerySystem
    tagged: QuerySystem
    formulas: FormulaSystem
    lessons: Mapping[str, Lessons]

    @classmethod
    def of(cls, transcript: Transcript, seen: CommandSet, unseen: CommandSet) -> PaperSystems:
        """The systems of a transcript of S and U; templates are learned from S (paper, § Learning Templated LTL)."""
        texts, first = (*seen.texts, *unseen.texts), len(seen.examples)
        formulas = transcript.formulas
        lessons = {
            CQ: jointly_accurate(seen, transcript.queries[:first], formulas[:first]),
            POS: jointly_accurate(seen, transcript.tagged[:first], formulas[:first]),
        }
        return cls(
            QuerySystem(CQ, dict(zip(texts, transcript.queries, strict=True)), lessons[CQ].templates),
            QuerySystem(POS, dict(zip(texts, transcript.tagged, strict=True)), lessons[POS].templates),
            FormulaSystem(LTL, dict(zip(texts, formulas, strict=True))),
            lessons,
        )

    @property
    def systems(self) -> tuple[QuerySystem | FormulaSystem, ...]:
        """All three, in the order of `NAMES`."""
        return self.queries, self.tagged, self.formulas

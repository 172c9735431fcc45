"""What a system says of a command, and what a system is."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

from models.logic import Formula
from models.queries import ContextualQuery
from models.world import Environment


@dataclass(frozen=True, slots=True)
class Answer:
    """One answer: a contextual query, a grounded formula, or both; neither when the system has none.

    Attributes:
        refusal: the slug of what kept the query from becoming a formula; None when there is a formula or no query.
        confidence: the system's own probability of being right; 1 where it gives none.
    """

    query: ContextualQuery | None = None
    formula: Formula | None = None
    refusal: str | None = None
    confidence: float = 1.0


class System(Protocol):
    """What turns commands into answers, many at once."""

    @property
    def name(self) -> str:
        """How tables and figures call it."""

    @property
    def speaks_queries(self) -> bool:
        """Whether it gives contextual queries on the way to formulas."""

    def answer(self, texts: Sequence[str], environment: Environment) -> list[Answer]:
        """The answer to every text, in order; formulas are grounded in the environment.

        A formula need not be one that the environment has: that is a wrong answer, not an error.
        """

"""Explanations."""

from __future__ import annotations

from typing import Self

from pydantic import BaseModel, Field, model_validator

from models.logic import PropertyClass
from service.http.schemas.common import ContextualQueryTree, EnvironmentName, FormulaText, QueryText, Request, shown


class ExplainRequest(Request):
    """What to read back: exactly one of `ltl`, `contextual_query`, `query`."""

    model_config = shown({"ltl": "F (at(robot, kitchen) & F holding(sphere))", "environment": "toys"})

    ltl: FormulaText | None = None
    contextual_query: QueryText | None = None
    query: ContextualQueryTree | None = None
    environment: EnvironmentName | None = Field(
        None, description="Whose words for things and functions to use; without it, atoms are read as written."
    )

    @model_validator(mode="after")
    def _exactly_one(self) -> Self:
        names = ("ltl", "contextual_query", "query")
        if sum(getattr(self, name) is not None for name in names) != 1:
            raise ValueError(f"give exactly one of {', '.join(names)}")
        return self


class ExplanationPart(BaseModel):
    """A part of a query or formula, and what it says."""

    part: str | None = Field(description="JSON pointer of the part within the query; null for a part of a formula.")
    ltl: str
    explanation: str
    parts: list[ExplanationPart] = Field(
        description="Those of a composed query are its operands; those of a task or formula are what the outermost "
        "operator of two or more operands joins."
    )


class KindOut(BaseModel):
    """What kind of task a formula is."""

    name: PropertyClass = Field(
        description="Its class in the hierarchy of Manna and Pnueli; `never` and `always` are what cannot be done and "
        "what asks for nothing."
    )
    explanation: str = Field(description="The class in plain words.")


class ExplainResponse(BaseModel):
    """A formula or query in English."""

    contextual_query: ContextualQueryTree | None = Field(description="Null when a formula was sent.")
    ltl: str = Field(description="What is explained; without an environment, phrases stand in it as names.")
    explanation: str = Field(
        description="What it asks for, to be confirmed: tasks in the words that were taught for them, else `reading`."
    )
    reading: str = Field(description="What the formula says to the letter.")
    kind: KindOut | None = Field(description="Null where it could not be told; `warnings` then say why.")
    parts: list[ExplanationPart]
    warnings: list[str]

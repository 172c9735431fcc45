"""Translating, learning, grounding, and the learned templates."""

from __future__ import annotations

from typing import Literal, Self

from pydantic import BaseModel, Field, model_validator

from service.http.problems import ErrorPlace
from service.http.schemas.common import (
    BindingOut,
    Command,
    ContextualQueryTree,
    EnvironmentName,
    FormulaText,
    QueryText,
    Request,
    State,
    TranslatorName,
)

_STATE = (
    "How things stand, for phrases that go by it (`the toy in the box`); what is left out is as in the initial state."
)


class _InEnvironment(Request):
    """Needs an environment where a state is given."""

    environment: EnvironmentName | None = Field(None, description="Where to ground; without it `ltl` is null.")
    state: State | None = Field(None, description=_STATE)

    @model_validator(mode="after")
    def _state_of_what(self) -> Self:
        if self.state is not None and self.environment is None:
            raise ValueError("state is that of an environment: give environment too")
        return self


class TranslateRequest(_InEnvironment):
    """A command to translate."""

    text: Command
    translator: TranslatorName = "default"
    candidates: int = Field(1, ge=1, le=10, description="How many readings to return at most.")


class BatchRequest(_InEnvironment):
    """Commands to translate."""

    texts: list[Command] = Field(min_length=1, max_length=100)
    translator: TranslatorName = "default"
    candidates: int = Field(1, ge=1, le=10)


class CandidateOut(BaseModel):
    """One reading of a command."""

    contextual_query: ContextualQueryTree | None = Field(description="Null from `ltl-copynet`, which gives formulas.")
    ltl: str | None = Field(
        description="Grounded LTL; null without an environment, or when it cannot be grounded, see `issues`. "
        "From `ltl-copynet` without an environment: as the network wrote it."
    )
    confidence: float = Field(description="Probability of this reading, in the environment if one is named.")
    explanation: str | None = Field(description="The formula read back in English.")
    bindings: list[BindingOut]
    warnings: list[str] = Field(description="What to know of the task's template; see `GET /templates/{task}`.")
    issues: list[ErrorPlace] = Field(description="Why there is no `ltl`.")


class QuestionOut(BaseModel):
    """A question to ask back."""

    part: str = Field(description="JSON pointer of its task within the query; empty where it is not composed.")
    argument: int = Field(description="Position of the argument in doubt, from 1.")
    text: str
    choices: list[str]


class TranslateResponse(BaseModel):
    """What a command was understood as."""

    text: str
    outcome: Literal["translated", "ambiguous", "unknown"]
    contextual_query: ContextualQueryTree | None
    ltl: str | None
    confidence: float | None
    explanation: str | None
    bindings: list[BindingOut]
    candidates: list[CandidateOut]
    question: QuestionOut | None
    warnings: list[str]
    issues: list[ErrorPlace]


class BatchResponse(BaseModel):
    """Translations in the order of the texts."""

    items: list[TranslateResponse]


class PairIn(Request):
    """A contextual query with its grounded LTL."""

    contextual_query: QueryText
    ltl: FormulaText


class LearnRequest(PairIn):
    """One example of a task; `more` are further examples of the same task, whose possible mappings are intersected."""

    environment: EnvironmentName
    more: list[PairIn] = Field(default_factory=list, max_length=20)
    examples: list[Command] = Field(
        default_factory=list, max_length=50, description="Utterances of the first example's query."
    )
    replace: bool = Field(False, description="Put this template in the place of another one of the task.")


class ParameterOut(BaseModel):
    """One parameter of a template."""

    position: int = Field(description="From 1; `$1` in the template.")
    type: str = Field(description="The kinds it may have, for example `toy` or `box | toy`.")
    taught: str = Field(description="Those of the things it was taught with: they decide when a phrase fits several.")


class PairOut(BaseModel):
    """What a template was learned from."""

    contextual_query: str
    ltl: str
    environment: str


class TemplateOut(BaseModel):
    """A task class."""

    task: str
    arity: int
    parameters: list[ParameterOut]
    template: str = Field(description="Templated LTL.")
    lifted: str = Field(description="Lifted LTL of the first example.")
    pairs: list[PairOut]
    examples: list[str]
    revision: int
    warnings: list[str]


class TemplateList(BaseModel):
    """A page of templates."""

    items: list[TemplateOut]
    next: str | None = Field(description="Pass as `cursor` for the next page; null on the last.")


class GroundRequest(Request):
    """A contextual query to evaluate: as text, or in parts."""

    contextual_query: QueryText | None = None
    query: ContextualQueryTree | None = None
    environment: EnvironmentName
    state: State | None = Field(None, description=_STATE)

    @model_validator(mode="after")
    def _exactly_one(self) -> Self:
        if (self.contextual_query is None) == (self.query is None):
            raise ValueError("give exactly one of contextual_query, query")
        return self


class GroundResponse(BaseModel):
    """Grounded LTL."""

    contextual_query: ContextualQueryTree
    ltl: str
    explanation: str
    bindings: list[BindingOut]
    warnings: list[str] = Field(description="What to know of the task's template.")

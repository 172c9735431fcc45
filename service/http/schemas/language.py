"""Translating, learning, grounding, and the learned templates."""

from __future__ import annotations

from typing import Literal, Self

from pydantic import BaseModel, Field, model_validator

from models.queries import MAX_WORDS
from service.http.schemas.common import (
    Answers,
    BindingOut,
    Command,
    ContextualQueryTree,
    EnvironmentName,
    FormulaText,
    QueryText,
    QuestionOut,
    Request,
    State,
    TranslatorName,
    shown,
)
from service.http.schemas.problems import ErrorPlace

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
    answers: Answers = Field(default_factory=list, max_length=16)


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
    explanation: str | None = Field(
        description="What was understood, in English, to be confirmed: in the words that were taught, else as the "
        "formula reads."
    )
    bindings: list[BindingOut]
    warnings: list[str] = Field(description="What to know of the task's template; see `GET /templates/{task}`.")
    issues: list[ErrorPlace] = Field(description="Why there is no `ltl`.")


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
    nearest: list[str] = Field(description="Where no task fits: the known tasks that come nearest.")
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

    model_config = shown(
        {
            "contextual_query": "store(sphere, box)",
            "ltl": "F in(sphere, box)",
            "environment": "toys",
            "examples": ["store the sphere in the box"],
        }
    )

    environment: EnvironmentName
    more: list[PairIn] = Field(default_factory=list, max_length=20)
    examples: list[Command] = Field(
        default_factory=list,
        max_length=50,
        description="Utterances of the task. Arguments may be marked: `{1}` stands for the first argument of the first "
        "example, `{2: the old radio}` for the second in other words. Without marks they are found by the words of "
        "the examples' arguments, or by what they name in the environment.",
    )
    replace: bool = Field(False, description="Put this template in the place of another one of the task.")
    explanation: str | None = Field(
        None,
        max_length=MAX_WORDS,
        examples=["the {1} ends up in the {2}"],
        description="What the task is read back as, with a slot for each argument; by default as its formula reads.",
    )


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
    explanation: str = Field(
        description="What it is read back as, with slots such as `{1}`: the words that were taught, else `reading`."
    )
    reading: str = Field(description="Its formula in English; empty when it was learned before readings were kept.")
    lifted: str = Field(description="Lifted LTL of the first example.")
    pairs: list[PairOut]
    examples: list[str]
    revision: int
    warnings: list[str]


class ExampleOut(BaseModel):
    """An utterance that a task was taught with."""

    id: str
    text: str = Field(description="As it was given, with marks if it had any.")
    contextual_query: str = Field(description="What it says.")
    also_says: list[str] = Field(description="Other tasks that were taught with the same wording: a conflict.")


class ExampleList(BaseModel):
    """A page of examples."""

    items: list[ExampleOut]
    next: str | None = Field(description="Pass as `cursor` for the next page; null on the last.")


class TemplateList(BaseModel):
    """A page of templates."""

    items: list[TemplateOut]
    next: str | None = Field(description="Pass as `cursor` for the next page; null on the last.")


class GroundRequest(Request):
    """A contextual query to evaluate: as text, or in parts."""

    model_config = shown({"contextual_query": "ship(cylinder, box, bedroom)", "environment": "toys"})

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
    explanation: str = Field(description="What it asks for, in English; see `POST /explain` for the letter of it.")
    bindings: list[BindingOut]
    warnings: list[str] = Field(description="What to know of the task's template.")

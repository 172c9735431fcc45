"""What several requests and responses share."""

from __future__ import annotations

from typing import Annotated, Any, Literal, Self

from pydantic import BaseModel, ConfigDict, Field, model_validator

from service.questions import Question
from service.translators import TranslatorKey

MAX_COMMAND = 2_000
MAX_FORMULA = 65_536

Command = Annotated[str, Field(max_length=MAX_COMMAND, examples=["Pickup the sphere"])]
QueryText = Annotated[str, Field(max_length=4_096, examples=["ship(cylinder, box, bedroom)"])]
FormulaText = Annotated[str, Field(max_length=MAX_FORMULA, examples=["F (in(cylinder, box) & F at(box, bedroom))"])]
EnvironmentName = Annotated[str, Field(max_length=200, examples=["toys"])]
State = Annotated[
    dict[str, dict[str, str]],
    Field(description="Object to attribute to value; what is left out is as in the initial state."),
]
TranslatorName = Annotated[
    TranslatorKey,
    Field(description="`default`, which hears taught wordings first, or one of the paper's three systems."),
]


class Request(BaseModel):
    """A request body; unknown members are refused."""

    model_config = ConfigDict(extra="forbid", strict=True)


def shown(*examples: dict[str, Any]) -> ConfigDict:
    """The configuration of a request of which the documentation shows these."""
    return ConfigDict(json_schema_extra={"examples": list(examples)})


class ContextualQueryTree(BaseModel):
    """A contextual query in parts: a task with its arguments, or an operator with its operands.

    `then(A, B)`: B once A is done. `and`, `or`: all or one of them, in any order. `avoid(A)`: A never happens.
    `until(A, B)`: A is kept up until B is done. `without(A, B)`: B is not so when A is done.
    `repeat(A)`: again and again.
    """

    model_config = ConfigDict(extra="forbid", strict=True)

    text: str | None = Field(None, max_length=4_096, description="The text form. In requests it is not read.")
    operator: Literal["then", "and", "or", "avoid", "until", "without", "repeat"] | None = Field(
        None, description="Null for a single task."
    )
    task: str | None = Field(None, max_length=100, description="Null for a composition.")
    arguments: list[str] = Field(default_factory=list, max_length=16, description="Phrases: those of the task.")
    operands: list[ContextualQueryTree] = Field(default_factory=list, max_length=32, description="Of the operator.")

    @model_validator(mode="after")
    def _task_or_operator(self) -> Self:
        if (self.task is None) == (self.operator is None):
            raise ValueError("give exactly one of task, operator")
        if self.arguments and self.task is None:
            raise ValueError("arguments belong to a task")
        if self.operands and self.operator is None:
            raise ValueError("operands belong to an operator")
        return self


class ThingOut(BaseModel):
    """An object or attribute value that a phrase names."""

    name: str
    kind: str = Field(description="Its class or attribute type.")
    reason: str = Field(description="Why the phrase names it.")


class BindingOut(BaseModel):
    """What an argument grounded to."""

    part: str = Field(description="JSON pointer of the task within the query; empty where it is not composed.")
    argument: int = Field(description="Position of the argument in its task, from 1.")
    phrase: str
    quantifier: Literal["one", "any", "all"] = Field(
        description="`one`: the phrase names one thing. `any`: one of `things` is meant, whichever (`any red toy`). "
        "`all`: each of them is (`every box`)."
    )
    name: str = Field(description="The object or attribute value; the first of `things` where they are several.")
    kind: str = Field(description="Its class or attribute type.")
    reason: str = Field(description="Why the phrase names it.")
    things: list[ThingOut] = Field(description="All that is meant.")


class QuestionOut(BaseModel):
    """A question to ask back. It is answered by sending the request again with its choice in `answers`."""

    about: Literal["thing", "reading"] = Field(
        description="Which thing an argument names, or which of several queries was meant."
    )
    text: str
    choices: list[str] = Field(description="Names of things, or contextual queries.")
    says: list[str] = Field(description="What each of the choices is, in English.")
    part: str = Field(description="JSON pointer of the argument's task in the query; empty where it is not composed.")
    argument: int | None = Field(description="Position of the argument in doubt, from 1; null where a reading is.")

    @classmethod
    def of(cls, question: Question) -> Self:
        """The question of the use cases."""
        return cls(
            about=question.about,
            text=question.text,
            choices=list(question.choices),
            says=list(question.says),
            part=question.part,
            argument=question.argument,
        )


class AnswerIn(Request):
    """One of the `choices` of a question, with its `part` and `argument`; or that none of them is right."""

    choice: Annotated[str, Field(max_length=4_096)] | None = Field(
        description="One of the `choices`, or null: none of them is right, and the command fits no task."
    )
    part: str = Field("", max_length=200)
    argument: int | None = Field(None, ge=1, le=16)


Answers = Annotated[
    list[AnswerIn],
    Field(description="To the questions that this text led to, in the order in which they were asked."),
]


class Health(BaseModel):
    """The service answers."""

    status: Literal["ok"] = "ok"

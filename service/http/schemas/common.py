"""What several requests and responses share."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import BaseModel, ConfigDict, Field

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


class ContextualQueryOut(BaseModel):
    """A contextual query as text and in parts."""

    text: str
    task: str
    arguments: list[str]


class BindingOut(BaseModel):
    """What an argument grounded to."""

    argument: int = Field(description="Position of the argument, from 1.")
    phrase: str
    name: str = Field(description="The object or attribute value.")
    kind: str = Field(description="Its class or attribute type.")
    reason: str = Field(description="Why the phrase names it.")


class Health(BaseModel):
    """The service answers."""

    status: Literal["ok"] = "ok"

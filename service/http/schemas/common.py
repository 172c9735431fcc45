"""What several requests and responses share."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import BaseModel, ConfigDict, Field

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
    Literal["default", "cq-copynet"], Field(description="`default` is cq-copynet after the taught wordings.")
]


class Request(BaseModel):
    """A request body; unknown members are refused."""

    model_config = ConfigDict(extra="forbid", strict=True)


class ContextualQueryOut(BaseModel):
    """A contextual query as text and in parts."""

    text: str
    task: str
    arguments: list[str]


class Health(BaseModel):
    """The service answers."""

    status: Literal["ok"] = "ok"

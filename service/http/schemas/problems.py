"""Problems, and the places that they name."""

from __future__ import annotations

from pydantic import BaseModel, Field

from service.http.schemas.common import QuestionOut


class ErrorPlace(BaseModel):
    """One wrong place of the request."""

    pointer: str = Field(description="JSON pointer into the request body; empty for the whole.")
    detail: str = Field(description="What is wrong there.")


class Problem(BaseModel):
    """An RFC 9457 problem."""

    type: str = Field(description="Stable URI of the kind of problem: `urn:cqltl:problem:` and its slug.")
    title: str = Field(description="The kind of problem in words.")
    status: int = Field(description="The HTTP status.")
    detail: str = Field(description="What happened, in a sentence.")
    errors: list[ErrorPlace] = Field(default_factory=list, description="The wrong places, where they can be named.")
    line: int | None = Field(None, description="Line of a syntax error, from 1.")
    column: int | None = Field(None, description="Column of a syntax error, from 1.")
    caret: str | None = Field(None, description="The line of a syntax error with a caret under the column.")
    choices: list[str] | None = Field(None, description="What an ambiguous phrase or command could mean.")
    question: QuestionOut | None = Field(None, description="What an ambiguous command leaves open.")

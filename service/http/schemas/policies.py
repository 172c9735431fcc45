"""Policies and their steps."""

from __future__ import annotations

from typing import Literal

from pydantic import BaseModel, Field

from service.http.schemas.common import Request, State


class PolicyRow(BaseModel):
    """One policy of a list."""

    id: str
    environment: str
    ltl: str


class PolicyList(BaseModel):
    """A page of policies."""

    items: list[PolicyRow]
    next: str | None = Field(description="Pass as `cursor` for the next page; null on the last.")


class VariableOut(BaseModel):
    """One digit of a state index."""

    object: str
    attribute: str
    values: list[str]
    stride: int


class Start(BaseModel):
    """Where the plan began."""

    state: int = Field(description="State index.")
    memory: int


class PolicyOut(BaseModel):
    """A whole policy.

    State index = sum over variables of `stride` times the position of the state's value in `values`. The flat arrays
    have one entry for each memory and state, at `memory * states + state index`; memory is what the robot holds before
    the label of the state is read.
    """

    id: str
    environment: str
    formula: str
    atoms: list[str] = Field(description="Bit i of a letter of the automaton.")
    hoa: str = Field(description="The automaton, in the Hanoi omega-automata format.")
    accepted: list[int] = Field(description="By memory: 1 where the formula is satisfied, whatever happens next.")
    actions: list[str]
    variables: list[VariableOut]
    initial: Start
    states: int
    memories: int
    action: list[int] = Field(description="Index into `actions`; -1 nothing to do; -2 let one step pass.")
    next_memory: list[int] = Field(description="The memory to hold at the next state; -1 the state is not legal.")
    probability: list[float] = Field(description="Of satisfying the formula from there.")
    expected_steps: list[float] = Field(description="Until the outcome is decided; -1 unknown.")


class StepRequest(Request):
    """Where the robot is: the state it observes, and the memory that the last step returned (at first the plan's)."""

    state: State
    memory: int = Field(0, ge=0)


class StepResponse(BaseModel):
    """What to do next."""

    action: str | None = Field(
        description="Null when there is nothing left to do; while `running`, when no action is possible: observe again."
    )
    memory: int = Field(description="Send it with the next state.")
    probability: float = Field(description="Of satisfying the formula from here.")
    expected_steps: float | None = Field(description="Until the outcome is decided.")
    done: bool = Field(description="The formula is satisfied, whatever happens next.")
    status: Literal["running", "satisfied", "lost"] = Field(
        description="`lost`: the formula cannot be satisfied from here; stop and ask for another task."
    )

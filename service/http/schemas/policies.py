"""Policies: their steps, their simulation, the whole of one."""

from __future__ import annotations

from typing import Annotated, Literal, Self

from pydantic import BaseModel, Field, model_validator

from service.http.schemas.common import Request, State

MAX_WORK = 1_000_000_000
"""Most steps of all runs of a simulation together."""


class PolicyRow(BaseModel):
    """One policy of a list."""

    id: str
    environment: str
    ltl: str
    objective: str = Field(description="`max`, or `min`: then the policy does its best to falsify `ltl`.")


class PolicyList(BaseModel):
    """A page of policies."""

    items: list[PolicyRow]
    next: str | None = Field(description="Pass as `cursor` for the next page; null on the last.")


class VariableOut(BaseModel):
    """A state attribute."""

    object: str
    attribute: str
    values: list[str]
    stride: int = Field(description="0 where the variable does not matter.")
    harmless: list[int] = Field(description="Positions in `values` for which the policy was made.")


class Start(BaseModel):
    """Where the plan began."""

    state: int = Field(description="State index.")
    memory: int


class AutomatonOut(BaseModel):
    """How memory changes, by memory."""

    accepted: list[int] = Field(description="1 where the formula is satisfied, whatever happens next.")
    row: list[int] = Field(description="The row of the flat arrays; -1 where the outcome is decided.")
    successors: list[list[int]] = Field(description="By letter read: the memory after it.")


class PolicyOut(BaseModel):
    """A whole policy.

    Place = sum over variables of `stride` times the position of the state's value in `values`; where `indices` is not
    null, it is where that sum stands in `indices`. Where `stride` is 0 the variable does not matter as long as that
    position is in `harmless`, and otherwise the plan has to be made again, as it has if the sum is not in `indices`. In
    a state, the memory becomes `after = automaton.successors[memory][letter[place]]`. Where `automaton.row[after]` is
    -1 the outcome is decided: satisfied where `automaton.accepted[after]` is 1, else lost. Otherwise the flat arrays
    `action`, `probability` and `expected_steps` tell at `automaton.row[after] * places + place` what to do.
    """

    id: str
    environment: str
    ltl: str = Field(description="The formula that was asked for.")
    objective: str = Field(description="`max` or `min`.")
    formula: str = Field(description="The policy's formula: `ltl`, negated where the objective is `min`.")
    atoms: list[str] = Field(description="Bit i of a letter says whether the i-th holds.")
    hoa: str = Field(description="The automaton, in the Hanoi omega-automata format.")
    automaton: AutomatonOut
    actions: list[str]
    variables: list[VariableOut]
    initial: Start
    places: int
    memories: int
    indices: list[int] | None = Field(
        description="Ascending; the states that can be reached from where the plan began, where the world has too many "
        "to plan for all. Null: every sum of strides is a place."
    )
    letter: list[int] = Field(description="By place: what is read there; -1 the state is not legal.")
    action: list[int] = Field(
        description="Index into `actions`; -1 nothing to do, the formula cannot be satisfied; -2 let one step pass."
    )
    probability: list[float] = Field(description="Of satisfying the policy's formula from there.")
    expected_steps: list[float] = Field(
        description="Until the outcome is decided. 0 where something is to be done: the formula holds if the policy is "
        "followed for ever."
    )


class StepRequest(Request):
    """Where the robot is: the state it observes, and the memory that the last step returned (at first the plan's)."""

    state: State
    memory: int = Field(0, ge=0)


class StepResponse(BaseModel):
    """What to do next."""

    action: str | None = Field(
        description="Null when `satisfied` or `lost`; else, when no action is possible: let a step pass, observe again."
    )
    memory: int = Field(description="Send it with the next state.")
    probability: float = Field(description="Of satisfying the policy's formula from here.")
    expected_steps: float | None = Field(description="Until the status is another than `running`.")
    done: bool = Field(description="The policy's formula is satisfied, whatever happens next: `satisfied`.")
    status: Literal["running", "sustaining", "satisfied", "lost"] = Field(
        description="`sustaining`: the formula holds if the policy is followed for ever, so go on. `lost`: it cannot "
        "be satisfied from here; stop and ask for another task."
    )


class SimulateRequest(Request):
    """How to run a policy; `runs` times `max_steps` is at most 1,000,000,000."""

    runs: int = Field(1_000, ge=1, le=100_000)
    seed: int = Field(0, ge=0, le=2**63 - 1, description="Equal requests give equal answers.")
    max_steps: int = Field(1_000, ge=1, le=100_000, description="Where a run ends that is still undecided.")
    state: State | None = Field(
        None, description="Where every run begins; what is left out is as where the policy's plan began."
    )

    @model_validator(mode="after")
    def _bounded(self) -> Self:
        if self.runs * self.max_steps > MAX_WORK:
            raise ValueError(f"runs times max_steps is at most {MAX_WORK}")
        return self


Bar = Annotated[list[int], Field(min_length=2, max_length=2)]


class StepCounts(BaseModel):
    """How many steps the runs took."""

    histogram: list[Bar] = Field(description="A number of steps and how many runs took it, ascending.")


class SimulateResponse(BaseModel):
    """How the runs ended. Steps are counted until the outcome was decided, or the run cut off."""

    runs: int
    seed: int
    satisfied: int = Field(description="The policy's formula holds, or will if the policy goes on for ever.")
    lost: int = Field(description="It cannot hold any more.")
    undecided: int = Field(description="Cut off at `max_steps`.")
    success_rate: float = Field(description="The share of `satisfied`.")
    mean_steps: float
    steps: StepCounts


class RunRequest(Request):
    """Where one run of a policy begins, and how long it may be."""

    seed: int = Field(0, ge=0, le=2**63 - 1, description="Decides what happens by chance: equal requests, equal runs.")
    max_steps: int = Field(200, ge=1, le=1_000, description="Most actions.")
    state: State | None = Field(
        None, description="Where the run begins; what is left out is as where the policy's plan began."
    )
    memory: int | None = Field(
        None, ge=0, description="The memory to begin with: to go on from a step, its own. By default the plan's first."
    )


class RunStepOut(BaseModel):
    """A step of a run: what `POST /policies/{id}/step` says in that state with that memory."""

    state: State
    memory: int = Field(description="Before what is true in the state was read.")
    memory_after: int = Field(description="After that: the automaton's state.")
    action: str | None
    probability: float = Field(description="Of satisfying the policy's formula from here.")
    expected_steps: float | None = Field(description="Until the status is another than `running`.")
    status: Literal["running", "sustaining", "satisfied", "lost"]


class RunResponse(BaseModel):
    """One run, from its first state to where it is `satisfied` or `lost`, or cut off at `max_steps`."""

    seed: int
    status: Literal["running", "sustaining", "satisfied", "lost"] = Field(description="That of the last step.")
    steps: list[RunStepOut]

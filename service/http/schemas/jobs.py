"""Jobs."""

from __future__ import annotations

from typing import Literal

from pydantic import BaseModel, Field

from service.http.schemas.plans import PlanResponse
from service.http.schemas.problems import Problem

JobStateName = Literal["queued", "running", "succeeded", "failed", "cancelled"]


class JobProgress(BaseModel):
    """How far a plan is, about once a second."""

    stage: Literal["compile", "graph", "rounds", "probability", "steps", "evaluate"] | None = Field(
        None, description="Null before planning has begun."
    )
    sweep: int = Field(0, description="Sweeps of this stage so far.")
    states: int = Field(0, description="States that a sweep updates, or that were found so far.")
    lower: float | None = Field(
        None, description="Lower bound of what the stage computes: probability, or expected steps."
    )
    upper: float | None = Field(None, description="Upper bound; null while there is none.")
    elapsed_s: float | None = Field(None, description="Seconds since planning began.")
    remaining_s: float | None = Field(
        None,
        description="Seconds that the stage still needs if it goes on closing in on its end as it did; null before "
        "there is a rate, and in searches, which only know at their end how much they had to look at.",
    )


class JobTiming(BaseModel):
    """Seconds since 1970."""

    created_at: float
    ended_at: float | None


class JobRow(BaseModel):
    """One job of a list."""

    id: str
    state: JobStateName
    url: str
    environment: str
    ltl: str


class JobList(BaseModel):
    """A page of jobs."""

    items: list[JobRow]
    next: str | None = Field(description="Pass as `cursor` for the next page; null on the last.")


class JobOut(JobRow):
    """A plan that takes longer than its request waited. `succeeded`, `failed` and `cancelled` never change."""

    progress: JobProgress
    plan: PlanResponse | None = Field(description="Of a job that succeeded.")
    error: Problem | None = Field(description="Of a job that failed.")
    timing: JobTiming


class JobEvent(BaseModel):
    """What an event `progress` says."""

    state: JobStateName
    progress: JobProgress

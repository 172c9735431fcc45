"""Environments."""

from __future__ import annotations

from pydantic import BaseModel, Field

from models.world import EnvironmentSpec


class EnvironmentSummary(BaseModel):
    """One environment of a list."""

    name: str
    kind: str
    revision: int
    samples: list[str] = Field(description="Commands to try there.")


class EnvironmentOut(EnvironmentSummary):
    """A stored environment."""

    spec: EnvironmentSpec


class EnvironmentList(BaseModel):
    """A page of environments."""

    items: list[EnvironmentSummary]
    next: str | None = Field(description="Pass as `cursor` for the next page; null on the last.")

"""The tables. Migrations in `migrations/` create them; a test compares the two."""

from __future__ import annotations

from sqlalchemy import JSON, Boolean, Column, Float, Index, Integer, LargeBinary, MetaData, String, Table, Text

metadata = MetaData(
    naming_convention={"pk": "pk_%(table_name)s", "ix": "ix_%(table_name)s_%(column_0_name)s"},
)

environments = Table(
    "environments",
    metadata,
    Column("name", String(200), primary_key=True),
    Column("kind", String(20), nullable=False),
    Column("data", JSON, nullable=False),
    Column("revision", Integer, nullable=False),
)

templates = Table(
    "templates",
    metadata,
    Column("task", String(200), primary_key=True),
    Column("template", Text, nullable=False),
    Column("lifted", Text, nullable=False),
    Column("kinds", JSON, nullable=False),  # one sorted list of kinds per argument
    Column("taught", JSON, nullable=False),  # likewise, of the things it was learned with; [] when not known
    Column("pairs", JSON, nullable=False),  # what it was learned from
    Column("warnings", JSON, nullable=False),
    Column("revision", Integer, nullable=False),
    Column("reading", Text, nullable=False),  # the formula in English, with slots; empty when not known
    Column("explanation", Text, nullable=False),  # the words that were taught for it, likewise
)

examples = Table(
    "examples",
    metadata,
    Column("task", String(200), primary_key=True),
    Column("id", String(16), primary_key=True),
    Column("number", Integer, nullable=False),  # the order in which the task's were taught
    Column("text", Text, nullable=False),
    Column("contextual_query", Text, nullable=False),
    Column("reading", LargeBinary),  # models.language.matching; null when it was not read yet
)

policies = Table(
    "policies",
    metadata,
    Column("id", String(64), primary_key=True),
    Column("environment", String(200), nullable=False),
    Column("ltl", Text, nullable=False),
    Column("objective", String(3), nullable=False),  # max or min
    Column("world", Text, nullable=False),  # the environment in which it was planned, as JSON
    Column("data", LargeBinary, nullable=False),  # models.planning.to_bytes
)

jobs = Table(
    "jobs",
    metadata,
    Column("id", String(32), primary_key=True),  # begins with the time, so the order of ids is that of acceptance
    Column("state", String(10), nullable=False),  # queued, running, succeeded, failed, cancelled
    Column("accepted", Boolean, nullable=False),  # a client was told of it; else it is somebody's wait
    Column("queue", String(20), nullable=False),
    Column("environment", String(200), nullable=False),
    Column("ltl", Text, nullable=False),
    Column("work", Text, nullable=False),  # what to plan, as JSON
    Column("told", Text, nullable=False),  # what of the answer is known beforehand, as JSON
    Column("progress", Text),  # JSON
    Column("answer", Text),  # JSON; with a state of succeeded
    Column("policy_id", String(64)),
    Column("error", Text),  # the refusal, as JSON; with a state of failed
    Column("attempts", Integer, nullable=False),  # times that a process took it up
    Column("owner", String(64)),  # the process that runs it, or has it wait for one of its own
    Column("lease_until", Float),  # when it may be taken from its owner; times are seconds since 1970
    Column("created_at", Float, nullable=False),
    Column("deadline", Float, nullable=False),
    Column("ended_at", Float),
    Index("ix_jobs_state", "state"),
)

kept_answers = Table(
    "kept_answers",
    metadata,
    Column("operation", String(40), primary_key=True),
    Column("key", String(255), primary_key=True),  # the Idempotency-Key
    Column("digest", String(64), nullable=False),  # of the request
    Column("job_id", String(32)),  # the job that is the answer, or the answer itself:
    Column("status", Integer),
    Column("location", Text),
    Column("body", Text),
    Column("created_at", Float, nullable=False),
)

facts = Table(
    "facts",
    metadata,
    Column("name", String(100), primary_key=True),
    Column("value", Text, nullable=False),
)
"""Single facts about the store, such as which built-in data it was seeded with."""

"""Jobs, and the answers kept under idempotency keys; on PostgreSQL also the queue, as Procrastinate 3.10 has it.

A later Procrastinate whose tables differ needs a revision of its own, with the SQL that it comes with for that.
"""

from __future__ import annotations

from importlib.resources import files

import sqlalchemy as sa
from alembic import op

revision = "0006"
down_revision = "0005"

DROP_QUEUE = """
DO $$
DECLARE
    found record;
BEGIN
    FOR found IN SELECT tablename FROM pg_tables
        WHERE schemaname = current_schema() AND tablename LIKE 'procrastinate\\_%' LOOP
        EXECUTE format('DROP TABLE %I CASCADE', found.tablename);
    END LOOP;
    FOR found IN SELECT p.oid::regprocedure AS name FROM pg_proc p JOIN pg_namespace n ON n.oid = p.pronamespace
        WHERE n.nspname = current_schema() AND p.proname LIKE 'procrastinate\\_%' LOOP
        EXECUTE format('DROP FUNCTION %s CASCADE', found.name);
    END LOOP;
    FOR found IN SELECT t.typname FROM pg_type t JOIN pg_namespace n ON n.oid = t.typnamespace
        LEFT JOIN pg_class c ON c.oid = t.typrelid
        WHERE n.nspname = current_schema() AND t.typname LIKE 'procrastinate\\_%'
        AND (t.typtype = 'e' OR c.relkind = 'c') LOOP
        EXECUTE format('DROP TYPE %I CASCADE', found.typname);
    END LOOP;
END
$$
"""


def upgrade() -> None:
    """Create the tables."""
    op.create_table(
        "jobs",
        sa.Column("id", sa.String(32), nullable=False),
        sa.Column("state", sa.String(10), nullable=False),
        sa.Column("accepted", sa.Boolean, nullable=False),
        sa.Column("queue", sa.String(20), nullable=False),
        sa.Column("environment", sa.String(200), nullable=False),
        sa.Column("ltl", sa.Text, nullable=False),
        sa.Column("work", sa.Text, nullable=False),
        sa.Column("told", sa.Text, nullable=False),
        sa.Column("progress", sa.Text),
        sa.Column("answer", sa.Text),
        sa.Column("policy_id", sa.String(64)),
        sa.Column("error", sa.Text),
        sa.Column("attempts", sa.Integer, nullable=False),
        sa.Column("owner", sa.String(64)),
        sa.Column("lease_until", sa.Float),
        sa.Column("created_at", sa.Float, nullable=False),
        sa.Column("deadline", sa.Float, nullable=False),
        sa.Column("ended_at", sa.Float),
        sa.PrimaryKeyConstraint("id", name="pk_jobs"),
    )
    op.create_index("ix_jobs_state", "jobs", ["state"])
    op.create_table(
        "kept_answers",
        sa.Column("operation", sa.String(40), nullable=False),
        sa.Column("key", sa.String(255), nullable=False),
        sa.Column("digest", sa.String(64), nullable=False),
        sa.Column("job_id", sa.String(32)),
        sa.Column("status", sa.Integer),
        sa.Column("location", sa.Text),
        sa.Column("body", sa.Text),
        sa.Column("created_at", sa.Float, nullable=False),
        sa.PrimaryKeyConstraint("operation", "key", name="pk_kept_answers"),
    )
    if op.get_bind().dialect.name == "postgresql":
        _run((files("migrations") / "procrastinate-3.10.sql").read_text(encoding="utf-8"))


def downgrade() -> None:
    """Drop the tables."""
    if op.get_bind().dialect.name == "postgresql":
        _run(DROP_QUEUE)
    op.drop_table("kept_answers")
    op.drop_index("ix_jobs_state", "jobs")
    op.drop_table("jobs")


def _run(script: str) -> None:
    """Several statements at once, with % and : as they stand."""
    connection = op.get_bind().connection.driver_connection
    assert connection is not None
    connection.execute(script)

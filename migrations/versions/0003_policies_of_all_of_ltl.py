"""Policies with the world and the objective that they were planned for.

The policies that are there are in a form that is not read any more, and nothing says in which world they were planned:
they are deleted, and come back by planning again.
"""

from __future__ import annotations

import sqlalchemy as sa
from alembic import op

revision = "0003"
down_revision = "0002"


def upgrade() -> None:
    """Replace the table."""
    _replace(
        sa.Column("objective", sa.String(3), nullable=False),
        sa.Column("world", sa.Text, nullable=False),
    )


def downgrade() -> None:
    """Put the former table in its place, likewise empty."""
    _replace()


def _replace(*further: sa.Column[str]) -> None:
    op.drop_table("policies")
    op.create_table(
        "policies",
        sa.Column("id", sa.String(64), nullable=False),
        sa.Column("environment", sa.String(200), nullable=False),
        sa.Column("ltl", sa.Text, nullable=False),
        *further,
        sa.Column("data", sa.LargeBinary, nullable=False),
        sa.PrimaryKeyConstraint("id", name="pk_policies"),
    )

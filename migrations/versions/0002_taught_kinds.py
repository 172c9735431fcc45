"""The kinds of the things that a template was learned with."""

from __future__ import annotations

import sqlalchemy as sa
from alembic import op

revision = "0002"
down_revision = "0001"


def upgrade() -> None:
    """Add the column; nothing is known of the templates that are there."""
    with op.batch_alter_table("templates") as table:
        table.add_column(sa.Column("taught", sa.JSON, nullable=False, server_default="[]"))


def downgrade() -> None:
    """Drop the column."""
    with op.batch_alter_table("templates") as table:
        table.drop_column("taught")

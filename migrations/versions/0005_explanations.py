"""How templates read in English, and the words that were taught for them."""

from __future__ import annotations

import sqlalchemy as sa
from alembic import op

revision = "0005"
down_revision = "0004"


def upgrade() -> None:
    """Add the columns; templates that are there have no reading until they are taught again."""
    with op.batch_alter_table("templates") as table:
        for name in ("reading", "explanation"):
            table.add_column(sa.Column(name, sa.Text, nullable=False, server_default=""))


def downgrade() -> None:
    """Drop the columns."""
    with op.batch_alter_table("templates") as table:
        for name in ("explanation", "reading"):
            table.drop_column(name)

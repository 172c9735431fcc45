"""Taught utterances in a table of their own."""

from __future__ import annotations

import hashlib
from typing import Any

import sqlalchemy as sa
from alembic import op

revision = "0004"
down_revision = "0003"

_templates = sa.table("templates", sa.column("task", sa.String), sa.column("examples", sa.JSON))
_examples = sa.table(
    "examples",
    *(sa.column(name) for name in ("task", "id", "text", "contextual_query")),
    sa.column("number", sa.Integer),
)


def upgrade() -> None:
    """Make the table of what the templates hold."""
    table = op.create_table(
        "examples",
        sa.Column("task", sa.String(200), nullable=False),
        sa.Column("id", sa.String(16), nullable=False),
        sa.Column("number", sa.Integer, nullable=False),
        sa.Column("text", sa.Text, nullable=False),
        sa.Column("contextual_query", sa.Text, nullable=False),
        sa.Column("reading", sa.LargeBinary, nullable=True),
        sa.PrimaryKeyConstraint("task", "id", name="pk_examples"),
    )
    rows = list(_rows(op.get_bind()))
    if rows:
        op.bulk_insert(table, rows)
    with op.batch_alter_table("templates") as templates:
        templates.drop_column("examples")


def downgrade() -> None:
    """Put the utterances back into the templates."""
    with op.batch_alter_table("templates") as templates:
        templates.add_column(sa.Column("examples", sa.JSON, nullable=False, server_default="[]"))
    held: dict[str, list[dict[str, str]]] = {}
    for row in op.get_bind().execute(sa.select(_examples).order_by(_examples.c.task, _examples.c.number)):
        held.setdefault(row.task, []).append({"text": row.text, "contextual_query": row.contextual_query})
    for task, group in held.items():
        op.execute(_templates.update().where(_templates.c.task == task).values(examples=group))
    op.drop_table("examples")


def _rows(connection: sa.Connection) -> list[dict[str, Any]]:
    rows = []
    for task, held in connection.execute(sa.select(_templates.c.task, _templates.c.examples)).all():
        known: set[str] = set()
        for number, example in enumerate(held):
            said = f"{example['contextual_query']}\0{example['text']}"
            key = hashlib.sha256(said.encode()).hexdigest()[:16]
            if key not in known:
                known.add(key)
                rows.append({"task": task, "id": key, "number": number, "reading": None, **example})
    return rows

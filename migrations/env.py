"""Runs the revisions: on the URL that the caller passes, or on the service's own for the `alembic` command."""

from __future__ import annotations

from alembic import context

from service.settings import Settings
from service.store.dialect import lock_writers
from service.store.engine import WRITE, open_engine
from service.store.tables import metadata


def run() -> None:
    """Apply the revisions in one transaction that holds the write lock, so two starting servers do not collide."""
    engine = open_engine(context.config.attributes.get("url") or Settings().url)
    with engine.connect() as connection:
        connection.execution_options(**{WRITE: True})
        context.configure(connection=connection, target_metadata=metadata, transactional_ddl=True)
        with context.begin_transaction():
            lock_writers(connection)
            context.run_migrations()
    engine.dispose()


run()

"""Brings a database to the newest revision of `migrations/`."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from importlib.resources import as_file, files

from alembic import command
from alembic.config import Config
from alembic.script import ScriptDirectory
from alembic.util import CommandError
from sqlalchemy.exc import DBAPIError

from service.store.soundness import UnusableStoreError, check_store, first_line, shown


def migrate(url: str) -> None:
    """Create or upgrade the tables of the database at `url`; raises `UnusableStoreError`, and then changes nothing."""
    with _config() as config:
        check_store(url, _revisions(config))
        config.attributes["url"] = url
        try:
            command.upgrade(config, "head")
        except (DBAPIError, OSError, CommandError) as error:
            raise UnusableStoreError(f"{shown(url)}: {first_line(error)}") from error


def revisions() -> list[str]:
    """All revisions of this version, the newest first."""
    with _config() as config:
        return _revisions(config)


def _revisions(config: Config) -> list[str]:
    return [found.revision for found in ScriptDirectory.from_config(config).walk_revisions()]


@contextmanager
def _config() -> Iterator[Config]:
    with as_file(files("migrations")) as folder:
        config = Config()
        config.set_main_option("script_location", str(folder).replace("%", "%%"))
        yield config

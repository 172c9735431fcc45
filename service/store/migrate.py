"""Brings a database to the newest revision of `migrations/`."""

from __future__ import annotations

from importlib.resources import as_file, files

from alembic import command
from alembic.config import Config


def migrate(url: str) -> None:
    """Create or upgrade the tables of the database at `url`."""
    with as_file(files("migrations")) as folder:
        config = Config()
        config.set_main_option("script_location", str(folder).replace("%", "%%"))
        config.attributes["url"] = url
        command.upgrade(config, "head")

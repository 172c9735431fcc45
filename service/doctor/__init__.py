"""`cqltl doctor`: what is wrong with an installation, a store, or the settings."""

from __future__ import annotations

from collections.abc import Iterator

from service.doctor.findings import Finding
from service.settings import Settings

__all__ = ["Finding", "examine"]


def examine(settings: Settings) -> Iterator[Finding]:
    """Everything that is found, as it is found; it takes some seconds."""
    from service.doctor.database import examine_database
    from service.doctor.installation import examine_installation
    from service.doctor.sense import examine_settings

    yield from examine_settings(settings)
    yield from examine_database(settings)
    yield from examine_installation(settings)

"""Collects everything wrong with a piece of data, by place."""

from __future__ import annotations

from collections.abc import Iterable

from models.errors import Place
from models.world.errors import WorldError

_SHOWN = 50
Path = tuple[str | int, ...]


def pointer(path: Path) -> str:
    """The JSON pointer (RFC 6901) of a path of keys and indices."""
    return "".join("/" + str(part).replace("~", "~0").replace("/", "~1") for part in path)


class Report:
    """The faults found so far. Checks add to it and go on; `close` raises when there are any."""

    def __init__(self, root: Path = ()) -> None:
        self.root = root
        self.places: list[Place] = []

    def add(self, path: Iterable[str | int], detail: str) -> None:
        """One fault at a path relative to the root."""
        if len(self.places) < _SHOWN:
            self.places.append(Place(pointer((*self.root, *path)), detail))

    def close(self, what: str) -> None:
        """Raises WorldError about `what` when a fault was added."""
        if not self.places:
            return
        first = self.places[0]
        more = f" (and {len(self.places) - 1} more)" if len(self.places) > 1 else ""
        where = f" at {first.pointer}" if first.pointer else ""
        raise WorldError(f"{what} is not valid{where}: {first.detail}{more}", places=self.places)

"""Collects everything wrong with a piece of data, by place."""

from __future__ import annotations

from collections.abc import Iterable

from models.errors import CqltlError, Place
from models.world.errors import WorldError
from models.world.names import clipped, encodable

MAX_FAULTS = 50
Path = tuple[str | int, ...]


def pointer(path: Path) -> str:
    """The JSON pointer (RFC 6901) of a path of keys and indices."""
    return encodable("".join("/" + str(part).replace("~", "~0").replace("/", "~1") for part in path))


class Report:
    """The faults found so far. Checks add to it and go on; `close` raises when there are any."""

    def __init__(
        self, root: Path = (), *, what: str = "the environment", refusal: type[CqltlError] = WorldError
    ) -> None:
        self.root = root
        self.what = what
        self.refusal = refusal
        self.places: list[Place] = []

    def add(self, path: Iterable[str | int], detail: str) -> None:
        """One fault at a path relative to the root. After many faults it raises: more would not help anyone."""
        self.places.append(Place(pointer((*self.root, *path)), clipped(detail)))
        if len(self.places) == MAX_FAULTS:
            self.close()

    def close(self) -> None:
        """Raises the refusal when a fault was added."""
        if not self.places:
            return
        first = self.places[0]
        more = f" (and {len(self.places) - 1} more)" if len(self.places) > 1 else ""
        where = f" at {clipped(first.pointer)}" if first.pointer else ""
        raise self.refusal(f"{self.what} is not valid{where}: {first.detail}{more}", places=self.places)

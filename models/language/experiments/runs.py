"""Trained runs on disk, so that an evaluation can be taken up again and be repeated without training."""

from __future__ import annotations

import gzip
import json
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any


@dataclass(frozen=True, slots=True)
class Runs:
    """A folder of runs; each is a JSON object, compressed, with the settings that it was made with."""

    folder: Path

    def read(self, name: str, settings: Mapping[str, Any]) -> dict[str, Any] | None:
        """The run of a name, or None when it is not there or was made with other settings."""
        place = self._place(name)
        if not place.exists():
            return None
        data: dict[str, Any] = json.loads(gzip.decompress(place.read_bytes()))
        return data["run"] if data["settings"] == json.loads(json.dumps(settings)) else None

    def write(self, name: str, settings: Mapping[str, Any], run: Mapping[str, Any]) -> None:
        """Keep a run, in place of one of the same name; a run that is cut off while it is written leaves the old."""
        self.folder.mkdir(parents=True, exist_ok=True)
        text = json.dumps({"settings": settings, "run": run}, ensure_ascii=False, separators=(",", ":"))
        partial = self._place(name).with_suffix(".part")
        partial.write_bytes(gzip.compress(text.encode(), mtime=0))
        partial.replace(self._place(name))

    def _place(self, name: str) -> Path:
        return self.folder / f"{name}.json.gz"

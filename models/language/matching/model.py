"""A trained matching network on disk: `matching.safetensors` holds the tensors, `matching.json` what it takes to use
them.
"""

from __future__ import annotations

import hashlib
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from importlib.resources import files
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from pydantic import BaseModel, ConfigDict, Field

from models.language.matching.config import MatchConfig
from models.language.matching.heads import Heads
from models.language.model_files import read_tensors, reading, write_model
from models.language.runtime import Tensors

NAME = "matching"


@dataclass(frozen=True, slots=True, eq=False)
class MatchModel:
    """A network with what makes probabilities of nearness.

    Attributes:
        upper: MiniLM's upper layers as they were fitted, named as MiniLM's.
        steepness: of the logarithm of the odds that a task is meant, in the points of nearness.
        threshold: nearness at which a task alone on the shelf is as likely to be meant as not.
        sharpness: how much the nearest of the examples and cards of a task counts more than the others; see
            `models.language.matching.nearness.KnownCommands.nearness`.
        role_temperature: what the nearness of roles is divided by.
        training: how it was made, for the record.
        key: eight bytes that tell models apart, of one that was read from a file.
    """

    heads: Heads
    upper: Tensors
    steepness: float
    threshold: float
    sharpness: float
    role_temperature: float
    training: Mapping[str, str | int | float]
    key: bytes = b""

    def points(self, near: NDArray[np.float32]) -> NDArray[np.float64]:
        """The logarithms of the odds that tasks are meant rather than none, by nearness to what is known of them."""
        return self.steepness * (near.astype(np.float64) - self.threshold)


class _Data(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True)


class _NetworkData(_Data):
    vector: int = Field(ge=2, le=4096)
    role: int = Field(ge=1, le=4096)
    dropout: float = Field(ge=0, lt=1)


class _ModelData(_Data):
    steepness: float = Field(gt=0)
    threshold: float
    sharpness: float = Field(gt=0, le=50)  # beyond 88 its powers are too large for single precision
    role_temperature: float = Field(gt=0)
    training: dict[str, str | int | float]
    network: _NetworkData


def save_model(model: MatchModel, folder: Path) -> None:
    """Write both files, replacing what is there; the same model gives the same bytes. Layers are in half precision."""
    data = _ModelData(
        network=_NetworkData(**asdict(model.heads.config)),
        steepness=model.steepness,
        threshold=model.threshold,
        sharpness=model.sharpness,
        role_temperature=model.role_temperature,
        training=dict(model.training),
    )
    write_model({**model.heads.tensors, **model.upper}, data, folder, NAME, halved=model.upper)


def load_model(folder: Path | None = None) -> MatchModel:
    """Read a model; without a folder, the one that is shipped.

    Raises:
        WeightsError: a file is missing or damaged, or the two do not fit together.
    """
    place = files("models.language") / "weights" if folder is None else folder
    with reading(NAME):
        data = _ModelData.model_validate_json((place / f"{NAME}.json").read_text(encoding="utf-8"))
        config = MatchConfig(**data.network.model_dump())
        file = (place / f"{NAME}.safetensors").read_bytes()
        upper, shapes = config.upper_shapes(), config.shapes()
        tensors = read_tensors(file, shapes | upper, halved=upper)
        heads = Heads(config, {name: tensors[name] for name in shapes})
        made = (heads, {name: tensors[name] for name in upper})
    constants = (data.steepness, data.threshold, data.sharpness, data.role_temperature)
    return MatchModel(*made, *constants, data.training, hashlib.sha256(file).digest()[:8])

"""A trained default translator on disk: `NAME.safetensors` holds the tensors, `NAME.json` what it takes to use them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass
from importlib.resources import files
from pathlib import Path

from pydantic import BaseModel, ConfigDict, Field

from models.language.model_files import read_tensors, reading, write_model
from models.language.runtime import Tensors
from models.language.spans.config import SpanConfig

DEFAULT_NAME = "cq-spans"
"""The model that is shipped."""


@dataclass(frozen=True, slots=True, eq=False)
class SpanModel:
    """What was learned, with what makes it a translator.

    Attributes:
        tensors: of the shapes `SpanConfig.shapes`.
        temperature: what its scores are divided by, so that its probabilities are those of being right.
        training: how it was made, for the record: seed, epochs, hyper-parameters.
    """

    config: SpanConfig
    tensors: Tensors
    temperature: float
    training: Mapping[str, str | int | float]


class _Data(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True)


class _NetworkData(_Data):
    words: tuple[str, ...]
    tasks: tuple[tuple[str, int], ...] = Field(min_length=1)
    vector: int = Field(ge=1, le=4096)
    embedding: int = Field(ge=1, le=4096)
    projection: int = Field(ge=1, le=4096)
    encoder: int = Field(ge=1, le=4096)
    layers: int = Field(ge=1, le=8)
    dropout: float = Field(ge=0, lt=1)


class _ModelData(_Data):
    temperature: float = Field(gt=0)
    training: dict[str, str | int | float]
    network: _NetworkData


def save_model(model: SpanModel, folder: Path, *, name: str = DEFAULT_NAME) -> None:
    """Write both files, replacing what is there; the same model gives the same bytes."""
    data = _ModelData(
        network=_NetworkData(**asdict(model.config)),
        temperature=model.temperature,
        training=dict(model.training),
    )
    write_model(model.tensors, data, folder, name)


def load_model(folder: Path | None = None, *, name: str = DEFAULT_NAME) -> SpanModel:
    """Read a model, ready to translate; without a folder, from those that are shipped.

    Raises:
        WeightsError: a file is missing or damaged, or the two do not fit together.
    """
    place = files("models.language") / "weights" if folder is None else folder
    with reading(name):
        data = _ModelData.model_validate_json((place / f"{name}.json").read_text(encoding="utf-8"))
        config = SpanConfig(**data.network.model_dump())
        tensors = read_tensors((place / f"{name}.safetensors").read_bytes(), config.shapes())
    return SpanModel(config, tensors, data.temperature, data.training)

"""A trained model on disk: `NAME.safetensors` holds the tensors, `NAME.json` what is needed to read and use them."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from importlib.resources import files
from pathlib import Path

import torch
from pydantic import BaseModel, ConfigDict, Field, ValidationError
from safetensors import SafetensorError
from safetensors.torch import load as load_tensors
from safetensors.torch import save as save_tensors

from models.language.copynet import CopyNet, NetworkConfig
from models.language.errors import WeightsError
from models.language.vocabulary import Vocabulary

DEFAULT_NAME = "cq-copynet"
"""The model that is shipped: trained on T of both domains together."""


@dataclass(frozen=True, slots=True, eq=False)
class Model:
    """A network with what makes it a translator.

    Attributes:
        arities: number of arguments of each task class it was trained on.
        min_confidence: below this a reading is not given.
        training: how it was made, for the record: seed, epochs, hyper-parameters.
    """

    network: CopyNet
    vocabulary: Vocabulary
    arities: Mapping[str, int]
    min_confidence: float
    training: Mapping[str, str | int | float]


class _Data(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True)


class _NetworkData(_Data):
    embedding: int = Field(ge=1, le=4096)
    encoder: int = Field(ge=1, le=4096)
    decoder: int = Field(ge=1, le=4096)
    dropout: float = Field(ge=0, lt=1)


class _ModelData(_Data):
    network: _NetworkData
    arities: dict[str, int] = Field(min_length=1)
    min_confidence: float = Field(ge=0, le=1)
    training: dict[str, str | int | float]
    outputs: int = Field(ge=2)
    words: list[str]


def save_model(model: Model, folder: Path, *, name: str = DEFAULT_NAME) -> None:
    """Write both files, replacing what is there; the same model gives the same bytes."""
    network = asdict(model.network.config)
    sizes = {key: network[key] for key in _NetworkData.model_fields}
    data = _ModelData(
        network=_NetworkData(**sizes),
        arities=dict(model.arities),
        min_confidence=model.min_confidence,
        training=dict(model.training),
        outputs=model.vocabulary.outputs,
        words=list(model.vocabulary.words),
    )
    tensors = {key: tensor.contiguous() for key, tensor in sorted(model.network.state_dict().items())}
    folder.mkdir(parents=True, exist_ok=True)
    (folder / f"{name}.safetensors").write_bytes(save_tensors(tensors))
    text = json.dumps(data.model_dump(), indent=1, ensure_ascii=False)
    (folder / f"{name}.json").write_text(text + "\n", encoding="utf-8")


def load_model(folder: Path | None = None, *, name: str = DEFAULT_NAME) -> Model:
    """Read a model, ready to translate; without a folder, from those that are shipped.

    Raises:
        WeightsError: a file is missing or damaged, or the two do not fit together.
    """
    place = files("models.language") / "weights" if folder is None else folder
    try:
        data = _ModelData.model_validate_json((place / f"{name}.json").read_text(encoding="utf-8"))
        vocabulary = Vocabulary(tuple(data.words), data.outputs)
        with torch.device("meta"):  # no values to begin with, so torch's generator stays as it is
            network = build_network(vocabulary, **data.network.model_dump())
        tensors = load_tensors((place / f"{name}.safetensors").read_bytes())
        network.load_state_dict(tensors, assign=True)
    except OSError as error:
        raise WeightsError(f"the model {name} cannot be read: {error.strerror} ({error.filename})") from None
    except ValidationError as error:
        raise WeightsError(f"{name}.json is not the description of a model: {error.errors()[0]['msg']}") from None
    except (ValueError, RuntimeError, SafetensorError) as error:
        raise WeightsError(f"the files of the model {name} are damaged or do not fit together: {error}") from None
    return Model(network.eval(), vocabulary, data.arities, data.min_confidence, data.training)


def build_network(
    vocabulary: Vocabulary, *, embedding: int = 64, encoder: int = 96, decoder: int = 128, dropout: float = 0.2
) -> CopyNet:
    """A network of the given sizes for a vocabulary, with random weights from torch's generator."""
    config = NetworkConfig(
        words=len(vocabulary),
        outputs=vocabulary.outputs,
        unknown=vocabulary.unknown,
        embedding=embedding,
        encoder=encoder,
        decoder=decoder,
        dropout=dropout,
    )
    return CopyNet(config)

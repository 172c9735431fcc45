"""A trained network on disk: `NAME.safetensors` holds the tensors, `NAME.json` what is needed to read and use them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass
from enum import StrEnum
from importlib.resources import files
from pathlib import Path

import torch
from pydantic import BaseModel, ConfigDict, Field
from safetensors.torch import load as load_tensors

from models.language.copynet.network import CopyNet, NetworkConfig
from models.language.copynet.vocabulary import Vocabulary
from models.language.dataset import Domain
from models.language.model_files import reading, write_model


class System(StrEnum):
    """What a network answers with: contextual queries, or grounded LTL."""

    CQ = "cq-copynet"
    LTL = "ltl-copynet"


@dataclass(frozen=True, slots=True, eq=False)
class Model:
    """A network with what makes it a translator.

    Attributes:
        domain: whose commands it was fitted to, and whose tasks and propositions it speaks of.
        training: how it was made, for the record: seed and hyper-parameters.
    """

    network: CopyNet
    vocabulary: Vocabulary
    system: System
    domain: Domain
    training: Mapping[str, str | int | float]

    @property
    def name(self) -> str:
        """The name of its files: that of the system and that of the domain."""
        return model_name(self.system, self.domain)


class _Data(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True)


class _NetworkData(_Data):
    embedding: int = Field(ge=1, le=4096)
    encoder: int = Field(ge=1, le=4096)
    decoder: int = Field(ge=1, le=4096)
    dropout: float = Field(ge=0, lt=1)


class _ModelData(_Data):
    system: System
    domain: Domain
    network: _NetworkData
    training: dict[str, str | int | float]
    outputs: int = Field(ge=1)
    words: list[str]


def model_name(system: System, domain: Domain) -> str:
    """What the files of a network are called: `cq-copynet-navigation`."""
    return f"{system}-{domain}"


def save_model(model: Model, folder: Path) -> None:
    """Write both files, replacing what is there; the same model gives the same bytes."""
    network = asdict(model.network.config)
    data = _ModelData(
        system=model.system,
        domain=model.domain,
        network=_NetworkData(**{key: network[key] for key in _NetworkData.model_fields}),
        training=dict(model.training),
        outputs=model.vocabulary.outputs,
        words=list(model.vocabulary.words),
    )
    tensors = {key: tensor.numpy() for key, tensor in model.network.state_dict().items()}
    write_model(tensors, data, folder, model.name)


def load_model(system: System | str, domain: Domain | str, folder: Path | None = None) -> Model:
    """Read a network, ready to translate; without a folder, from those that are shipped.

    Raises:
        WeightsError: a file is missing or damaged, the two do not fit together, or they are another network's.
    """
    system, domain = System(system), Domain(domain)
    name = model_name(system, domain)
    place = files("models.language") / "weights" if folder is None else folder
    with reading(name):
        data = _ModelData.model_validate_json((place / f"{name}.json").read_text(encoding="utf-8"))
        if (data.system, data.domain) != (system, domain):
            raise ValueError(f"it describes {model_name(data.system, data.domain)}")
        vocabulary = Vocabulary(tuple(data.words), data.outputs)
        with torch.device("meta"):  # no values to begin with, so torch's generator stays as it is
            network = build_network(vocabulary, **data.network.model_dump())
        tensors = load_tensors((place / f"{name}.safetensors").read_bytes())
        network.load_state_dict(tensors, assign=True)
    return Model(network.eval(), vocabulary, system, domain, data.training)


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

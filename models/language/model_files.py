"""A trained model on disk: `NAME.safetensors` holds the tensors, `NAME.json` what is needed to read and use them."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path

from pydantic import BaseModel, ValidationError
from safetensors import SafetensorError
from safetensors.torch import save as save_tensors
from torch import Tensor, nn

from models.language.errors import WeightsError


def write_model(network: nn.Module | Mapping[str, Tensor], description: BaseModel, folder: Path, name: str) -> None:
    """Write both files, replacing what is there; the same model gives the same bytes."""
    held = network.state_dict() if isinstance(network, nn.Module) else network
    tensors = {key: tensor.contiguous() for key, tensor in sorted(held.items())}
    folder.mkdir(parents=True, exist_ok=True)
    (folder / f"{name}.safetensors").write_bytes(save_tensors(tensors))
    text = json.dumps(description.model_dump(mode="json"), indent=1, ensure_ascii=False)
    (folder / f"{name}.json").write_text(text + "\n", encoding="utf-8")


@contextmanager
def reading(name: str) -> Iterator[None]:
    """Turn whatever goes wrong while a model's files are read inside into `WeightsError`."""
    try:
        yield
    except OSError as error:
        raise WeightsError(f"the model {name} cannot be read: {error.strerror} ({error.filename})") from None
    except ValidationError as error:
        raise WeightsError(f"{name}.json is not the description of a model: {error.errors()[0]['msg']}") from None
    except (ValueError, RuntimeError, SafetensorError) as error:
        raise WeightsError(f"the files of the model {name} are damaged or do not fit together: {error}") from None

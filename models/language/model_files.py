"""A trained model on disk: `NAME.safetensors` holds the tensors, `NAME.json` what is needed to read and use them."""

from __future__ import annotations

import json
from collections.abc import Collection, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np
from pydantic import BaseModel, ValidationError
from safetensors import SafetensorError
from safetensors.numpy import load as load_tensors
from safetensors.numpy import save as save_tensors

from models.language.errors import WeightsError
from models.language.runtime import Tensors


def write_model(
    tensors: Tensors, description: BaseModel, folder: Path, name: str, *, halved: Collection[str] = ()
) -> None:
    """Write both files, replacing what is there, the tensors `halved` in half precision; the same model gives the same
    bytes.
    """
    folder.mkdir(parents=True, exist_ok=True)
    kept = {key: tensor.astype(_kind(key in halved)) for key, tensor in sorted(tensors.items())}
    data = save_tensors({key: np.ascontiguousarray(tensor) for key, tensor in kept.items()})
    (folder / f"{name}.safetensors").write_bytes(data)
    text = json.dumps(description.model_dump(mode="json"), indent=1, ensure_ascii=False)
    (folder / f"{name}.json").write_text(text + "\n", encoding="utf-8")


def read_tensors(data: bytes, shapes: Mapping[str, tuple[int, ...]], *, halved: Collection[str] = ()) -> Tensors:
    """The tensors of a file, in single precision; raises ValueError unless they are those, of these shapes, and those
    that are `halved` in half precision.
    """
    tensors: Tensors = load_tensors(data)
    for name in sorted({*tensors, *shapes}):
        found = tensors[name].shape if name in tensors else "missing"
        if found != shapes.get(name):
            raise ValueError(f"{name} is {found}, and should be {shapes.get(name, 'missing')}")
        wanted = _kind(name in halved)
        if tensors[name].dtype != wanted:
            raise ValueError(f"{name} holds {tensors[name].dtype}, and should hold {wanted}")
    return {name: tensor.astype(np.float32, copy=False) for name, tensor in tensors.items()}


def _kind(half: bool) -> np.dtype[Any]:
    return np.dtype(np.float16 if half else np.float32)


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

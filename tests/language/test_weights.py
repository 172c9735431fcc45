"""Models on disk: what is written is read back, and what is damaged is refused."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
import torch

from models.language import CopyNetTranslator, WeightsError
from models.language.vocabulary import END, NO_TASK, Vocabulary
from models.language.weights import DEFAULT_NAME, Model, build_network, load_model, save_model


@pytest.fixture
def model() -> Model:
    vocabulary = Vocabulary.build([["take", "the", "ball"]], [["pickup", "(", "ball", ")", END], [NO_TASK, END]])
    torch.manual_seed(0)
    network = build_network(vocabulary, embedding=4, encoder=3, decoder=5)
    return Model(network, vocabulary, {"pickup": 1}, 0.25, {"seed": 0, "domains": "manipulation"})


def test_read_back(model: Model, tmp_path: Path) -> None:
    save_model(model, tmp_path / "new", name="m")
    before = torch.get_rng_state()
    read = load_model(tmp_path / "new", name="m")
    assert torch.equal(torch.get_rng_state(), before)
    assert (read.vocabulary, read.arities, read.min_confidence) == (model.vocabulary, {"pickup": 1}, 0.25)
    assert read.training == model.training
    assert read.network.config == model.network.config
    assert not read.network.training
    tensors = read.network.state_dict()
    assert tensors.keys() == model.network.state_dict().keys()
    assert all(torch.equal(tensors[key], tensor) for key, tensor in model.network.state_dict().items())


def test_same_bytes(model: Model, tmp_path: Path) -> None:
    for folder in (tmp_path / "a", tmp_path / "b"):
        save_model(model, folder)
    for suffix in ("safetensors", "json"):
        first, second = ((tmp_path / part / f"{DEFAULT_NAME}.{suffix}").read_bytes() for part in "ab")
        assert first == second


def test_missing(tmp_path: Path) -> None:
    with pytest.raises(WeightsError, match="cannot be read") as caught:
        CopyNetTranslator.load(tmp_path)
    assert caught.value.slug == "invalid-weights"


@pytest.mark.parametrize(
    ("key", "value"),
    [
        ("outputs", 2),
        ("words", ["a", "b"]),
        ("words", "abc"),
        ("network", {"embedding": 4, "encoder": 3, "decoder": 6, "dropout": 0.0}),
        ("network", {"embedding": 10**9, "encoder": 3, "decoder": 6, "dropout": 0.0}),
        ("arities", {}),
        ("min_confidence", 2.0),
        ("more", 1),
    ],
)
def test_wrong_description(model: Model, tmp_path: Path, key: str, value: object) -> None:
    save_model(model, tmp_path)
    path = tmp_path / f"{DEFAULT_NAME}.json"
    path.write_text(json.dumps({**json.loads(path.read_text()), key: value}))
    with pytest.raises(WeightsError):
        load_model(tmp_path)


@pytest.mark.parametrize("content", [b"", b"{}", b"\x00" * 100, b"\xff" * 64])
@pytest.mark.parametrize("suffix", ["json", "safetensors"])
def test_damaged(model: Model, tmp_path: Path, suffix: str, content: bytes) -> None:
    save_model(model, tmp_path)
    (tmp_path / f"{DEFAULT_NAME}.{suffix}").write_bytes(content)
    with pytest.raises(WeightsError):
        load_model(tmp_path)


def test_cut_short(model: Model, tmp_path: Path) -> None:
    save_model(model, tmp_path)
    path = tmp_path / f"{DEFAULT_NAME}.safetensors"
    path.write_bytes(path.read_bytes()[:-8])
    with pytest.raises(WeightsError, match="damaged"):
        load_model(tmp_path)


def test_the_shipped_files_are_small() -> None:
    folder = Path(load_model.__code__.co_filename).parent / "weights"
    files = [path for path in folder.iterdir() if path.suffix in {".json", ".safetensors"}]
    assert {f"{DEFAULT_NAME}.json", f"{DEFAULT_NAME}.safetensors", f"{DEFAULT_NAME}-curve.json"} <= {
        path.name for path in files
    }
    assert sum(path.stat().st_size for path in files) < 10_000_000

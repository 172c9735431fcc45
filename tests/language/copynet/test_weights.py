"""Networks on disk: what is written is read back, and what is damaged is refused."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
import torch

from models.language import WeightsError
from models.language.copynet.vocabulary import END, Vocabulary
from models.language.copynet.weights import Model, System, build_network, load_model, model_name, save_model
from models.language.dataset import Domain

NAME = "cq-copynet-manipulation"


@pytest.fixture
def model() -> Model:
    vocabulary = Vocabulary.build([["take", "the", "ball"]], [["pickup", "(", "ball", ")", END]], copied={"ball"})
    torch.manual_seed(0)
    network = build_network(vocabulary, embedding=4, encoder=3, decoder=5)
    return Model(network, vocabulary, System.CQ, Domain.MANIPULATION, {"seed": 0, "hide": 0.5})


def _load(folder: Path) -> Model:
    return load_model("cq-copynet", "manipulation", folder)


def test_read_back(model: Model, tmp_path: Path) -> None:
    save_model(model, tmp_path / "new")
    before = torch.get_rng_state()
    read = _load(tmp_path / "new")
    assert torch.equal(torch.get_rng_state(), before)
    assert (read.vocabulary, read.system, read.domain) == (model.vocabulary, model.system, model.domain)
    assert read.training == model.training
    assert read.network.config == model.network.config
    assert not read.network.training
    tensors = read.network.state_dict()
    assert tensors.keys() == model.network.state_dict().keys()
    assert all(torch.equal(tensors[key], tensor) for key, tensor in model.network.state_dict().items())


def test_names(model: Model) -> None:
    assert model.name == NAME
    assert model_name(System.LTL, Domain.NAVIGATION) == "ltl-copynet-navigation"


def test_same_bytes(model: Model, tmp_path: Path) -> None:
    for folder in (tmp_path / "a", tmp_path / "b"):
        save_model(model, folder)
    for suffix in ("safetensors", "json"):
        first, second = ((tmp_path / part / f"{NAME}.{suffix}").read_bytes() for part in "ab")
        assert first == second


def test_missing(tmp_path: Path) -> None:
    with pytest.raises(WeightsError, match="cannot be read") as caught:
        _load(tmp_path)
    assert caught.value.slug == "invalid-weights"


@pytest.mark.parametrize(
    ("key", "value"),
    [
        ("outputs", 2),
        ("words", ["a", "b"]),
        ("words", "abc"),
        ("network", {"embedding": 4, "encoder": 3, "decoder": 6, "dropout": 0.0}),
        ("network", {"embedding": 10**9, "encoder": 3, "decoder": 6, "dropout": 0.0}),
        ("system", "ltl-copynet"),
        ("domain", "navigation"),
        ("domain", "cooking"),
        ("more", 1),
    ],
)
def test_wrong_description(model: Model, tmp_path: Path, key: str, value: object) -> None:
    save_model(model, tmp_path)
    path = tmp_path / f"{NAME}.json"
    path.write_text(json.dumps({**json.loads(path.read_text()), key: value}))
    with pytest.raises(WeightsError):
        _load(tmp_path)


@pytest.mark.parametrize("content", [b"", b"{}", b"\x00" * 100, b"\xff" * 64])
@pytest.mark.parametrize("suffix", ["json", "safetensors"])
def test_damaged(model: Model, tmp_path: Path, suffix: str, content: bytes) -> None:
    save_model(model, tmp_path)
    (tmp_path / f"{NAME}.{suffix}").write_bytes(content)
    with pytest.raises(WeightsError):
        _load(tmp_path)


def test_cut_short(model: Model, tmp_path: Path) -> None:
    save_model(model, tmp_path)
    path = tmp_path / f"{NAME}.safetensors"
    path.write_bytes(path.read_bytes()[:-8])
    with pytest.raises(WeightsError, match="damaged"):
        _load(tmp_path)


@pytest.mark.parametrize("domain", list(Domain))
@pytest.mark.parametrize("system", list(System))
def test_the_shipped_networks(system: System, domain: Domain) -> None:
    """They are of the first seed, and generate no name that can be copied."""
    model = load_model(system, domain)
    assert model.training["seed"] == 0
    assert not model.training["generate"]
    generated = set(model.vocabulary.words[: model.vocabulary.outputs])
    assert not generated & {"ball", "box", "red", "bakery", "coffee"}
    assert ("holding_ball" in generated) == (model.name == "ltl-copynet-manipulation")
    assert ("F" in generated) == (system is System.LTL)

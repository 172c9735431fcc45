"""Train everything that ships, or one part of it.

    python -m models.language.train                  the default translator, and the paper's systems on both domains
    python -m models.language.train default --seed 1 --output FOLDER [--no-lexicon]
    python -m models.language.train paper --domain navigation --hide 0.25 --output FOLDER

Writes, into the output folder, for each model `NAME.safetensors` (the tensors) and `NAME.json` (vocabulary, sizes,
hyper-parameters), and the training curves. One thread; the same seed gives the same weights on the same kind of
machine. `python -m models.language.evaluate` measures what was made.
"""

from __future__ import annotations

import argparse
import json
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import torch

from models.language import copynet
from models.language.dataset import Domain
from models.language.spans import DEFAULT_NAME, save_model
from models.language.spans import training as spans

SHIPPED = Path(__file__).parent / "weights"


def main(arguments: Sequence[str] | None = None) -> None:
    """Read the command line and train."""
    options = _read_options(arguments)
    torch.set_num_threads(1)  # the networks are small: a second thread makes every step slower
    if options.what in ("default", "all"):
        train_default(_span_settings(options), seed=options.seed, folder=options.output)
    if options.what in ("paper", "all"):
        domains = tuple(Domain) if options.domain == "both" else (Domain(options.domain),)
        settings = _copynet_settings(options)
        copynet.train_paper(domains, settings, seed=options.seed, folder=options.output, log=print)


def train_default(settings: spans.Settings, *, seed: int, folder: Path) -> None:
    """Train the default translator and write it with its curve."""
    curve: list[spans.Epoch] = []

    def log(epoch: spans.Epoch) -> None:
        curve.append(epoch)
        print("default", " ".join(f"{key} {value}" for key, value in epoch.items()))

    model = spans.train(settings, seed=seed, log=log)
    save_model(model, folder)
    record = {"training": dict(model.training), "epochs": curve}
    (folder / f"{DEFAULT_NAME}-curve.json").write_text(json.dumps(record, indent=1) + "\n", encoding="utf-8")
    print(f"default: temperature {model.temperature:.3f}")


def _span_settings(options: argparse.Namespace) -> spans.Settings:
    given = {"lexicon": not options.no_lexicon}
    return spans.Settings(**given) if options.epochs is None else spans.Settings(**given, epochs=options.epochs)


def _copynet_settings(options: argparse.Namespace) -> copynet.Settings:
    usual = copynet.Settings()
    chosen = {name: getattr(options, name) for name in ("epochs", "hide") if getattr(options, name) is not None}
    return replace(usual, **chosen, generate=options.generate)


def _read_options(arguments: Sequence[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(description="Train the translators.")
    parser.add_argument("what", nargs="?", choices=["all", "default", "paper"], default="all")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--epochs", type=int, help="instead of the usual number of each")
    parser.add_argument("--output", type=Path, default=SHIPPED, help="folder to write to")
    parser.add_argument("--no-lexicon", action="store_true", help="default: without word vectors, to see their worth")
    parser.add_argument("--domain", choices=[*Domain, "both"], default="both", help="paper: which T to train on")
    parser.add_argument("--hide", type=float, help="paper: part of the words that are shown as unknown words")
    parser.add_argument("--generate", action="store_true", help="paper: let arguments be generated, not only copied")
    return parser.parse_args(arguments)


if __name__ == "__main__":
    main()

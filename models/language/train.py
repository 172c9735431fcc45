"""Train everything that ships, or one part of it.

    python -m models.language.train                  the default translator's networks, and the paper's systems
    python -m models.language.train default --seed 1 --output FOLDER
    python -m models.language.train composition                          two networks
    python -m models.language.train composition --member 1 --device cuda   one of them, on a GPU
    python -m models.language.train matching
    python -m models.language.train paper --domain navigation --hide 0.25 --output FOLDER
    python -m models.language.train --quick --output FOLDER              a few texts once, to see that it works

Writes, into the output folder, for each model `NAME.safetensors` (the tensors) and `NAME.json` (vocabulary, sizes,
hyper-parameters), and the training curves. Several networks are trained side by side, in as many processes as there are
processors, each with one thread; the same seed gives the same weights on the same kind of machine. Networks that are
trained on another device differ from those of the CPU as those of another seed do.
`python -m models.language.evaluate` measures what was made.
"""

from __future__ import annotations

import argparse
import json
import multiprocessing
import os
import random
from collections.abc import Callable, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import replace
from functools import partial
from pathlib import Path

import torch

from models.language import copynet
from models.language.composition import NAMES
from models.language.composition.lessons import SETTINGS, CompositionLessons
from models.language.composition.marks import MarkedReader
from models.language.dataset import Domain, no_task
from models.language.dataset.tasks import task_classes
from models.language.encoder import Encoder, WordReader, encoder
from models.language.encoder.minilm import tensors
from models.language.encoder.torch_layers import on
from models.language.matching import training as matching
from models.language.matching.batches import Course
from models.language.matching.calibration import calibrated
from models.language.matching.lessons import lesson, paper_classes, without_task
from models.language.matching.model import save_model as save_model_of_matching
from models.language.spans import DEFAULT_NAME, save_model
from models.language.spans import training as spans
from models.language.spans.lessons import Lessons
from models.language.tokens import words

REFUSED = 2_000
"""Texts without a task that the matching network is shown."""
HELD_OUT = 12
"""Every so many-th task class is not fitted to: the matching network is calibrated on these."""
QUICK_SHARE, QUICK_STEPS, QUICK_EVERY = 0.01, 10, 8
"""Of a quick run: part of the texts of its one epoch, steps of the matching network, and every which task class it is
shown.
"""
SHIPPED = Path(__file__).parent / "weights"


def main(arguments: Sequence[str] | None = None) -> None:
    """Read the command line and train."""
    options = _read_options(arguments)
    parts = _parts(options)
    if options.jobs < 2 or len(parts) == 1:
        for part in parts:
            _on_one_thread(part)
        return
    context = multiprocessing.get_context("spawn")  # a forked process would share torch's threads
    with ProcessPoolExecutor(options.jobs, context, max_tasks_per_child=1) as pool:
        for trained in [pool.submit(_on_one_thread, part) for part in parts]:
            trained.result()


def _on_one_thread(part: Callable[[], object]) -> None:
    """Train a part; the networks are small: a second thread makes every step slower."""
    torch.set_num_threads(1)
    part()


def _parts(options: argparse.Namespace) -> Sequence[Callable[[], object]]:
    """What is asked for, network by network; those that take longest come first."""
    asked = {"composition", "default", "matching", "paper"} if options.what == "all" else {options.what}
    common = {"seed": options.seed, "folder": options.output}
    parts: list[Callable[[], object]] = []
    if "composition" in asked:
        composition = partial(train_composition, _chosen(SETTINGS, options), device=options.device, **common)
        members = range(len(NAMES)) if options.member is None else (options.member,)
        parts += [partial(composition, member=member) for member in members]
    if "default" in asked:
        parts.append(partial(train_default, _chosen(spans.Settings(), options), device=options.device, **common))
    if "paper" in asked:
        domains = tuple(Domain) if options.domain == "both" else (Domain(options.domain),)
        settings = _copynet_settings(options)
        parts += [partial(copynet.train_paper, (domain,), settings, log=print, **common) for domain in domains]
    if "matching" in asked:
        every = QUICK_EVERY if options.quick else 1
        parts.append(partial(train_matching, _matching_settings(options), every=every, **common))
    return parts


def train_default(settings: spans.Settings, *, seed: int, folder: Path, device: str = "cpu") -> None:
    """Train the default translator's network of single tasks, and write it with its curve."""
    lessons, words = Lessons.load(seed=seed), _encoder(device)
    _train(lessons, settings, seed=seed, folder=folder, name=DEFAULT_NAME, words=words, device=device)


def train_composition(settings: spans.Settings, *, member: int, seed: int, folder: Path, device: str = "cpu") -> None:
    """Train one of the networks that find the clauses of a command, and write it with its curve; each member has a seed
    of its own, counted from `seed`.
    """
    own, words = seed + member, MarkedReader.load(_encoder(device))
    lessons = CompositionLessons.load(seed=own)
    _train(lessons, settings, seed=own, folder=folder, name=NAMES[member], words=words, device=device)


def train_matching(settings: matching.Settings, *, every: int = 1, seed: int, folder: Path) -> None:
    """Train the network that compares commands with what was taught, on every so many-th task class, and write it with
    its curve.
    """
    generator = random.Random(seed)
    classes = [*task_classes(), *paper_classes(generator)][::every]
    lessons = [lesson(task, generator) for task in classes]
    held_out = [entry for number, entry in enumerate(lessons) if number % HELD_OUT == HELD_OUT - 1]
    fitted = [entry for entry in lessons if entry not in held_out]
    texts = no_task(seed=seed)
    refused, unseen = (
        [without_task(text) for text in generator.sample(sorted(part), min(REFUSED, len(part))) if words(text)]
        for part in (texts.training, texts.held_out)
    )
    course = Course.of(lessons, [*refused, *unseen], encoder())
    course = replace(course, lessons=fitted, refused=refused)
    curve: list[dict[str, float]] = []

    def log(step: dict[str, float]) -> None:
        curve.append(step)
        print("matching", " ".join(f"{key} {value}" for key, value in step.items()), flush=True)

    network = matching.fit(course, tensors(), settings, seed=seed, log=log)
    model = calibrated(network, course, held_out, unseen, seed=seed)
    made = matching.record(settings, seed)
    save_model_of_matching(replace(model, training=made), folder)
    (folder / "matching-curve.json").write_text(json.dumps({"training": made, "steps": curve}, indent=1) + "\n")
    print(f"matching: steepness {model.steepness}, threshold {model.threshold}, sharpness {model.sharpness}")


def _train(
    course: spans.Course,
    settings: spans.Settings,
    *,
    seed: int,
    folder: Path,
    name: str,
    words: WordReader,
    device: str,
) -> None:
    curve: list[spans.Epoch] = []

    def log(epoch: spans.Epoch) -> None:
        curve.append(epoch)
        print(name, " ".join(f"{key} {value}" for key, value in epoch.items()), flush=True)

    model = spans.train(course, settings, seed=seed, log=log, words=words, device=device)
    save_model(model, folder, name=name)
    record = {"training": dict(model.training), "epochs": curve}
    (folder / f"{name}-curve.json").write_text(json.dumps(record, indent=1) + "\n", encoding="utf-8")
    print(f"{name}: temperature {model.temperature:.3f}")


def _encoder(device: str) -> Encoder:
    """The encoder that is installed, on a device."""
    return encoder() if device == "cpu" else Encoder.load(build=on(device))


def _chosen(usual: spans.Settings, options: argparse.Namespace) -> spans.Settings:
    epochs = usual.epochs if options.epochs is None else options.epochs
    return replace(usual, epochs=epochs, share=options.share)


def _matching_settings(options: argparse.Namespace) -> matching.Settings:
    return replace(matching.Settings(), steps=QUICK_STEPS) if options.quick else matching.Settings()


def _copynet_settings(options: argparse.Namespace) -> copynet.Settings:
    usual = copynet.Settings()
    chosen = {name: getattr(options, name) for name in ("epochs", "hide") if getattr(options, name) is not None}
    return replace(usual, **chosen, generate=options.generate)


def _read_options(arguments: Sequence[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(description="Train the translators.")
    parser.add_argument(
        "what", nargs="?", choices=["all", "default", "composition", "matching", "paper"], default="all"
    )
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--epochs", type=int, help="instead of the usual number of each")
    parser.add_argument("--share", type=float, default=1.0, help="default, composition: part of the texts of an epoch")
    parser.add_argument("--member", type=int, choices=range(len(NAMES)), help="composition: one of the networks only")
    parser.add_argument("--device", default="cpu", help="default, composition: where to train, such as cuda")
    parser.add_argument("--jobs", type=int, default=os.cpu_count() or 1, help="networks that are trained side by side")
    parser.add_argument("--output", type=Path, default=SHIPPED, help="folder to write to")
    parser.add_argument("--domain", choices=[*Domain, "both"], default="both", help="paper: which T to train on")
    parser.add_argument("--hide", type=float, help="paper: part of the words that are shown as unknown words")
    parser.add_argument("--generate", action="store_true", help="paper: let arguments be generated, not only copied")
    parser.add_argument("--quick", action="store_true", help="a tiny run to see that everything works")
    options = parser.parse_args(arguments)
    if options.quick:
        options.epochs, options.share = 1 if options.epochs is None else options.epochs, min(options.share, QUICK_SHARE)
    return options


if __name__ == "__main__":
    main()

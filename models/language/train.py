"""Train CQ-CopyNet and write its weights.

    python -m models.language.train                              the model that is shipped, on T of both domains
    python -m models.language.train --domain manipulation --output /somewhere --epochs 40 --seed 1

Writes, into the output folder, `NAME.safetensors` (the tensors), `NAME.json` (vocabulary, sizes, hyper-parameters) and
`NAME-curve.json` (losses and accuracies by epoch, and the final table), and prints the accuracy on S and U by task
class. One thread, a few minutes. The same seed gives the same weights on the same kind of machine.
"""

from __future__ import annotations

import argparse
import copy
import json
import random
import time
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path

import torch

from models.language import accuracy
from models.language.accuracy import Tally
from models.language.copynet import CopyNet, loss
from models.language.dataset import Domain, by_task, generate, no_task, split
from models.language.errors import TrainingError
from models.language.evaluate import measure
from models.language.items import Item, at_least, batches, command, hidden_words, refusal, to_batch, vocabulary_of
from models.language.threshold import best_threshold
from models.language.translator import CopyNetTranslator
from models.language.vocabulary import Vocabulary
from models.language.weights import DEFAULT_NAME, Model, build_network, save_model


@dataclass(frozen=True, slots=True)
class Settings:
    """The hyper-parameters of a run."""

    seed: int = 0
    epochs: int = 40  # the best is about the 16th; the rest shows that it was, and the best is kept
    batch: int = 32  # small: T is small, and more steps per epoch reach the same loss in less time
    learning_rate: float = 2e-3  # Adam; falls to zero along a cosine, so that the last epochs settle
    clip: float = 2.0  # gradient norm; the recurrent steps spike early on
    embedding: int = 64  # a few hundred words need no more
    encoder: int = 96  # in each direction
    decoder: int = 128
    dropout: float = 0.2  # on embeddings
    hide: float = 0.5  # arguments shown as unknown words, to be copied: T has none of its own, and with 0 almost
    # nothing of U is right (manipulation 0.7 %, navigation 0 %; with 0.5 all of it)
    least: int = 150  # commands of a task class per epoch; T has 23 of navigate_one and 458 of navigate_three
    hide_refusals: float = 0.1  # words of texts that no task fits, so that a strange word alone does not mean a task


def main(arguments: Sequence[str] | None = None) -> None:
    """Read the command line, train, measure, write."""
    options = _read_options(arguments)
    domains = tuple(Domain) if options.domain == "both" else (Domain(options.domain),)
    settings = Settings(seed=options.seed, epochs=options.epochs, hide=options.hide)
    torch.set_num_threads(1)
    model, curve = train(domains, settings, log=True)
    table = measure(model, domains)
    save_model(model, options.output, name=options.name)
    record = {"settings": asdict(settings), "domains": domains, "epochs": curve, "accuracy": _as_rates(table)}
    (options.output / f"{options.name}-curve.json").write_text(json.dumps(record, indent=1) + "\n", encoding="utf-8")
    print(f"\nmin_confidence {model.min_confidence:.4f}; exact contextual queries, beam search, by task class:")
    for row, tally in table.items():
        print(f"  {row:32} {tally}")


def train(domains: Sequence[Domain], settings: Settings, *, log: bool = False) -> tuple[Model, list[dict[str, float]]]:
    """Fit a network to T of the domains; returns the model of the epoch with the least validation loss, and the curve.

    Nothing here looks at U. The validation loss is the mean of three: the commands as they are; texts that no task
    fits; and, when training hides arguments, the commands with all of them hidden, which stands for words never seen.
    """
    if settings.epochs < 1:
        raise TrainingError("a run has at least one epoch")
    torch.manual_seed(settings.seed)
    generator = random.Random(settings.seed)

    # data: 90 % of T, and the texts that no task fits
    splits = [split(domain, seed=settings.seed) for domain in domains]
    refused = no_task(seed=settings.seed)
    classes = [group for part in splits for group in by_task(part.training).values()]
    training = [command(example) for group in classes for example in at_least(settings.least, group)]
    training += [refusal(text) for text in refused.training]
    validation = [command(example) for part in splits for example in part.validation]
    held_out = [refusal(text) for text in refused.held_out]
    vocabulary = vocabulary_of(training)

    # model
    network = build_network(
        vocabulary,
        embedding=settings.embedding,
        encoder=settings.encoder,
        decoder=settings.decoder,
        dropout=settings.dropout,
    )
    optimizer = torch.optim.Adam(network.parameters(), lr=settings.learning_rate)
    schedule = torch.optim.lr_scheduler.CosineAnnealingLR(optimizer, settings.epochs)

    # loop
    curve: list[dict[str, float]] = []
    best_loss, best_weights = float("inf"), copy.deepcopy(network.state_dict())
    started = time.perf_counter()
    for epoch in range(1, settings.epochs + 1):
        training_loss = _one_epoch(network, vocabulary, training, optimizer, settings, generator)
        schedule.step()
        known, known_right = accuracy.greedy(network, vocabulary, validation)
        hidden, hidden_right = accuracy.greedy(network, vocabulary, validation, hide=True)
        refused_loss, refused_right = accuracy.greedy(network, vocabulary, held_out)
        judged = [known, refused_loss, *([hidden] if settings.hide > 0 else [])]
        if sum(judged) / len(judged) < best_loss:
            best_loss, best_weights = sum(judged) / len(judged), copy.deepcopy(network.state_dict())
        curve.append(
            {
                "epoch": epoch,
                "training_loss": round(training_loss, 5),
                "validation_loss": round(known, 5),
                "validation_accuracy": round(known_right, 4),
                "hidden_loss": round(hidden, 5),
                "hidden_accuracy": round(hidden_right, 4),
                "refusal_loss": round(refused_loss, 5),
                "refusal_accuracy": round(refused_right, 4),
            }
        )
        if log:
            print(
                " ".join(f"{key} {value}" for key, value in curve[-1].items()),
                f"({time.perf_counter() - started:.0f} s)",
            )
    network.load_state_dict(best_weights)

    # the least confidence at which a reading is given, from the same validation data
    arities = {
        task: len(group[0].query.arguments) for d in domains for task, group in by_task(generate(d).seen).items()
    }
    translator = CopyNetTranslator(network.eval(), vocabulary, arities, 0.0)
    threshold = best_threshold(translator, validation, [item.text for item in held_out], hide=settings.hide > 0)
    record: dict[str, str | int | float] = {"domains": " ".join(domains), **asdict(settings)}
    return Model(network, vocabulary, arities, threshold, record), curve


def _one_epoch(
    network: CopyNet,
    vocabulary: Vocabulary,
    items: Sequence[Item],
    optimizer: torch.optim.Optimizer,
    settings: Settings,
    generator: random.Random,
) -> float:
    """One pass over the items in random order; returns the mean loss."""
    network.train()
    total = 0.0
    for chunk in batches(items, settings.batch, generator):
        rates = [settings.hide_refusals if item.is_refusal else settings.hide for item in chunk]
        hidden = [hidden_words(item, rate, generator) for item, rate in zip(chunk, rates, strict=True)]
        source, target = to_batch(chunk, hidden, vocabulary)
        value = loss(network(source, target), source, target)
        optimizer.zero_grad()
        value.backward()  # type: ignore[no-untyped-call]
        torch.nn.utils.clip_grad_norm_(network.parameters(), settings.clip)
        optimizer.step()
        total += value.item() * len(chunk)
    return total / len(items)


def _as_rates(table: Mapping[str, Tally]) -> dict[str, float]:
    return {row: round(tally.rate, 4) for row, tally in table.items()}


def _read_options(arguments: Sequence[str] | None) -> argparse.Namespace:
    usual = Settings()
    parser = argparse.ArgumentParser(description="Train CQ-CopyNet.")
    parser.add_argument("--domain", choices=[*Domain, "both"], default="both", help="which T to train on")
    parser.add_argument("--epochs", type=int, default=usual.epochs)
    parser.add_argument("--seed", type=int, default=usual.seed)
    parser.add_argument("--hide", type=float, default=usual.hide, help="part of the arguments shown as unknown words")
    parser.add_argument("--output", type=Path, default=Path(__file__).parent / "weights", help="folder to write to")
    parser.add_argument("--name", default=DEFAULT_NAME, help="name of the files")
    return parser.parse_args(arguments)


if __name__ == "__main__":
    main()

"""Joint training of CQ-CopyNet and LTL-CopyNet, one pair for each domain (paper, § Training Pipelines).

The paper names the network and the data and gives no hyper-parameters; these are ours. What decides whether a network
copies names that it never saw is how it treats those it did see, so that is a setting of its own:

* `generate`: may the names in T be generated, or only be copied from the command? A network that may generate them
  learns to, and says a name of T in the place of a new one.
* `hide`: the part of the words of a command that are shown as the unknown word, drawn anew in every epoch, as
  sequence-to-sequence toolkits do with rare words. T has no unknown words of its own, and a network that never saw one
  does not know what to do with it.
"""

from __future__ import annotations

import json
import random
from collections.abc import Callable, Collection, Sequence
from dataclasses import asdict, dataclass, replace
from pathlib import Path

import torch
from torch import Tensor
from torch.optim.lr_scheduler import CosineAnnealingLR

from models.language.copynet.items import Item, batches, copied_words, hidden_words, to_batch
from models.language.copynet.network import loss
from models.language.copynet.vocabulary import Vocabulary
from models.language.copynet.weights import Model, System, build_network, save_model
from models.language.dataset import Domain, Split, split
from models.language.errors import TrainingError


@dataclass(frozen=True, slots=True)
class Settings:
    """The hyper-parameters of a run, the same for both networks and both domains."""

    epochs: int = 40  # accuracy on S no longer moves after the 30th
    batch: int = 64
    learning_rate: float = 5e-3  # Adam; falls to zero along a cosine. At 2e-3 LTL-CopyNet needs three times the epochs:
    # it chooses between some 280 propositions, most of which T has a few times
    clip: float = 2.0  # gradient norm of each network; the recurrent steps spike early on
    embedding: int = 64
    encoder: int = 64  # in each direction
    decoder: int = 96
    dropout: float = 0.2  # on embeddings
    hide: float = 0.02  # part of the words shown as unknown words. With 0, less than half of U manipulation is right
    # and none of ship; from 0.02 to 0.2 nearly all of it is. Words are hidden one by one, so names of two stay hard
    generate: bool = False  # whether words that can be copied can be generated too


@dataclass(frozen=True, slots=True)
class Epoch:
    """Mean losses of both networks in one pass over T, and on the tenth of T that is held back, with nothing hidden."""

    number: int
    cq_training: float
    ltl_training: float
    cq_validation: float
    ltl_validation: float

    def __str__(self) -> str:
        return (
            f"epoch {self.number:3}  CQ-CopyNet {self.cq_training:.4f}, validation {self.cq_validation:.4f}"
            f"  LTL-CopyNet {self.ltl_training:.4f}, validation {self.ltl_validation:.4f}"
        )


@dataclass(frozen=True, slots=True)
class Record:
    """How a pair of networks was made."""

    domain: Domain
    seed: int
    settings: Settings
    epochs: tuple[Epoch, ...]


@dataclass(frozen=True, slots=True, eq=False)
class Models:
    """The two networks of a domain that were fitted together."""

    cq: Model
    ltl: Model
    record: Record


Callback = Callable[[int, Models], None]
"""Called after every epoch, counted from 1, with the networks as they are then: later epochs change them."""


def train(
    domain: Domain | str,
    settings: Settings,
    *,
    seed: int,
    on_epoch: Callback | None = None,
    data: Split | None = None,
) -> Models:
    """Fit both networks of a domain to T: every step reads the same commands with the same words hidden.

    The loss is the sum of theirs, and they share no weights. Nothing here looks at U, and the networks are those of the
    last epoch: the validation loss is for the record. The same seed draws the same T and gives the same weights, on the
    same kind of machine with the same number of threads. `data` replaces T.

    Raises:
        TrainingError: there is no epoch.
    """
    if settings.epochs < 1:
        raise TrainingError("a run has at least one epoch")
    domain = Domain(domain)
    part = data or split(domain, seed=seed)
    training, validation = ([Item.of(example) for example in group] for group in (part.training, part.validation))
    generator = random.Random(seed)
    with torch.random.fork_rng(devices=[]):  # the caller's random numbers stay as they are
        torch.manual_seed(seed)
        pair = [_start(system, domain, [*training, *validation], settings, seed) for system in (System.CQ, System.LTL)]
        models = Models(pair[0], pair[1], Record(domain, seed, settings, ()))
        weights = [parameter for model in pair for parameter in model.network.parameters()]
        optimizer = torch.optim.Adam(weights, lr=settings.learning_rate)
        schedule = CosineAnnealingLR(optimizer, settings.epochs)
        for number in range(1, settings.epochs + 1):
            fitted = _one_epoch(pair, training, optimizer, settings, generator)
            schedule.step()
            epoch = Epoch(number, *fitted, *(_mean_loss(model, validation) for model in pair))
            models = replace(models, record=replace(models.record, epochs=(*models.record.epochs, epoch)))
            if on_epoch:
                on_epoch(number, models)
    return models


def train_paper(
    domains: Sequence[Domain],
    settings: Settings,
    *,
    seed: int,
    folder: Path,
    log: Callable[[str], None] | None = None,
) -> tuple[Models, ...]:
    """Train the networks of each domain and write them into a folder, with the curve of each domain beside them.

    `log` gets a line for every epoch.
    """

    def tell(_number: int, models: Models) -> None:
        if log:
            log(f"{models.record.domain:12} {models.record.epochs[-1]}")

    trained = tuple(train(domain, settings, seed=seed, on_epoch=tell) for domain in domains)
    for models in trained:
        save(models, folder)
    return trained


def save(models: Models, folder: Path) -> None:
    """Write both networks, and `copynet-DOMAIN-curve.json`: settings, seed, losses by epoch."""
    save_model(models.cq, folder)
    save_model(models.ltl, folder)
    text = json.dumps(asdict(models.record), indent=1)
    (folder / f"copynet-{models.record.domain}-curve.json").write_text(text + "\n", encoding="utf-8")


def _start(system: System, domain: Domain, items: Sequence[Item], settings: Settings, seed: int) -> Model:
    """A network with random weights, and the vocabulary of T: validation must be able to say its answers."""
    copied = () if settings.generate else copied_words(items, system)
    vocabulary = Vocabulary.build((item.text for item in items), (item.answer(system) for item in items), copied=copied)
    network = build_network(
        vocabulary,
        embedding=settings.embedding,
        encoder=settings.encoder,
        decoder=settings.decoder,
        dropout=settings.dropout,
    )
    return Model(network, vocabulary, system, domain, {"seed": seed, **asdict(settings)})


def _one_epoch(
    pair: Sequence[Model],
    items: Sequence[Item],
    optimizer: torch.optim.Optimizer,
    settings: Settings,
    generator: random.Random,
) -> list[float]:
    """One pass over the items in random order; returns the mean loss of each network."""
    totals = [0.0 for _ in pair]
    for model in pair:
        model.network.train()
    for chunk in batches(items, settings.batch, generator):
        hidden = [hidden_words(item.text, settings.hide, generator) for item in chunk]
        losses = [_loss(model, chunk, hidden) for model in pair]
        optimizer.zero_grad()
        torch.stack(losses).sum().backward()  # type: ignore[no-untyped-call]
        for index, model in enumerate(pair):
            torch.nn.utils.clip_grad_norm_(model.network.parameters(), settings.clip)
            totals[index] += losses[index].item() * len(chunk)
        optimizer.step()
    for model in pair:
        model.network.eval()
    return [total / len(items) for total in totals]


@torch.inference_mode()
def _mean_loss(model: Model, items: Sequence[Item]) -> float:
    """The loss of a network that is not being fitted, on items as they are."""
    return _loss(model, items, [()] * len(items)).item()


def _loss(model: Model, items: Sequence[Item], hidden: Sequence[Collection[str]]) -> Tensor:
    texts, answers = [item.text for item in items], [item.answer(model.system) for item in items]
    source, target = to_batch(texts, answers, hidden, model.vocabulary)
    return loss(model.network(source, target), source, target)

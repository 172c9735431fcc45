"""Fit the matching network."""

from __future__ import annotations

import math
import random
from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass
from functools import partial

import torch
from torch import Tensor
from torch.nn import functional

from models.language.matching.batches import Course
from models.language.matching.config import MatchConfig
from models.language.matching.lessons import Lesson, Said
from models.language.matching.network import MatchNet
from models.language.runtime import Tensors
from models.language.spans.crf import log_partition, score

TEMPERATURE = 0.05
"""Temperature of the comparison: similarities are divided by it."""
ROLE_TEMPERATURE = 0.1
WORLDS = 3
"""Worlds that half of the steps draw their tasks from, so that those which lie close together are told apart."""


@dataclass(frozen=True, slots=True)
class Settings:
    """The hyper-parameters of a run."""

    steps: int = 600
    tasks: int = 32  # compared in a step
    refused: int = 48  # texts in a step that ask for nothing
    learning_rate: float = 1e-3  # of AdamW
    layer_learning_rate: float = 1e-4  # of MiniLM's layers
    decay: float = 1e-2
    clip: float = 1.0
    dropout: float = 0.3


def fit(
    course: Course, upper: Tensors, settings: Settings, *, seed: int, log: Callable[[dict[str, float]], None] | None
) -> MatchNet:
    """A network fitted to a course, beginning with MiniLM's tensors `upper`; the same seed gives the same one on the
    same kind of machine.
    """
    generator = random.Random(seed)
    with torch.random.fork_rng(devices=[]):
        torch.manual_seed(seed)
        size = 2 * next(iter(course.lower.values())).states.shape[1]
        network = MatchNet(MatchConfig(vector=size, dropout=settings.dropout), upper).train()
        heads = [tensor for name, tensor in network.named_parameters() if not name.startswith("layers.")]
        groups = [
            {"params": heads, "lr": settings.learning_rate},
            {"params": list(network.layers.parameters()), "lr": settings.layer_learning_rate},
        ]
        optimizer = torch.optim.AdamW(groups, weight_decay=settings.decay)
        schedule = torch.optim.lr_scheduler.LambdaLR(optimizer, partial(_share_of_rate, settings.steps))
        for step in range(1, settings.steps + 1):
            losses = _losses(network, course, settings, generator)
            optimizer.zero_grad()
            sum(losses.values(), torch.zeros(())).backward()  # type: ignore[no-untyped-call]
            torch.nn.utils.clip_grad_norm_(network.parameters(), settings.clip)
            optimizer.step()
            schedule.step()
            if log is not None and step % 50 == 0:
                log({"step": step, **{name: round(float(loss.detach()), 4) for name, loss in losses.items()}})
    return network.eval()


def _share_of_rate(steps: int, step: int) -> float:
    """Of the learning rate: it rises for the first tenth of the steps, and falls to zero along a cosine."""
    return min(1.0, 10 * (step + 1) / steps) * (1 + math.cos(math.pi * step / steps)) / 2


def _losses(network: MatchNet, course: Course, settings: Settings, generator: random.Random) -> dict[str, Tensor]:
    drawn = _draw(course.lessons, settings.tasks, generator)
    texts = [text for group in drawn for text in group]
    owners = torch.tensor([number for number, group in enumerate(drawn) for _ in group])
    refused = generator.choices(course.refused, k=settings.refused)
    batch = course.batch([*texts, *refused])
    vectors = network.read(batch.states, batch.here, batch.pooling)
    asked = network.asked(vectors, batch.free)  # [N + refused, H]
    return {
        "commands": _contrast(asked[: len(texts)] @ asked.T, owners),
        "tags": 0.3 * _tagging(network, *(part[: len(texts)] for part in (vectors, batch.tags, batch.lengths))),
        "roles": 0.3 * _role_loss(network, drawn, vectors),
    }


def _draw(lessons: Sequence[Lesson], count: int, generator: random.Random) -> list[list[Said]]:
    """Three texts of each of some tasks, of different wordings, one of which may be the card."""
    pool = list(lessons)
    if generator.random() < 0.5:
        worlds = set(generator.sample(sorted({lesson.world for lesson in pool}), WORLDS))
        pool = [lesson for lesson in pool if lesson.world in worlds]
    groups = []
    for lesson in generator.sample(pool, min(count, len(pool))):
        kinds = generator.sample(lesson.wordings, 3)
        if generator.random() < 0.6:
            kinds[2] = lesson.cards
        groups.append([generator.choice(kind) for kind in kinds])
    return groups


def _contrast(near: Tensor, owners: Tensor) -> Tensor:
    """Each command is nearer to those of its task than to all others (Khosla et al., NeurIPS 2020, L_out), and to what
    asks for nothing: `near` [N, N + refused].
    """
    near = near / TEMPERATURE
    count = len(owners)
    itself = torch.eye(count, dtype=torch.bool)
    same = (owners[:, None] == owners[None, :]) & ~itself
    others = near.masked_fill(functional.pad(same | itself, (0, near.shape[1] - count)), -1e4)
    against = torch.logaddexp(near[:, :count], others.logsumexp(dim=1, keepdim=True))  # [N, N]
    return -((near[:, :count] - against) * same).sum(dim=1).div(same.sum(dim=1)).mean()


def _tagging(network: MatchNet, vectors: Tensor, tags: Tensor, lengths: Tensor) -> Tensor:
    emissions, count = network.tags(vectors), len(lengths)
    moves = (network.transition + network.allowed).expand(count, -1, -1)
    start = network.allowed_start.expand(count, -1)
    said = score(emissions, moves, start, lengths, tags)
    return (log_partition(emissions, moves, start, lengths) - said).mean()


def _role_loss(network: MatchNet, drawn: Sequence[Sequence[Said]], vectors: Tensor) -> Tensor:
    """Each mention is nearest to that of the same argument in another wording. `vectors` [B, S, D] are of all texts."""
    losses, row = [], 0
    for group in drawn:
        if len(group[0].mentions) > 1:
            one, other = (network.roles(vectors[row + place], group[place].mentions) for place in (0, 1))
            near = one @ other.T / ROLE_TEMPERATURE
            right = torch.arange(len(near))
            losses.append(functional.cross_entropy(near, right) + functional.cross_entropy(near.T, right))
        row += len(group)
    return torch.stack(losses).mean() if losses else torch.zeros(())


def record(settings: Settings, seed: int) -> dict[str, str | int | float]:
    """How a network was made."""
    return {"seed": seed, **asdict(settings)}

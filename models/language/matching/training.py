"""Fit the matching network."""

from __future__ import annotations

import random
from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass

import numpy as np
import torch
from torch import Tensor
from torch.nn import functional

from models.language.encoder import Encoder
from models.language.matching.config import BEGIN, ON, OUTSIDE, MatchConfig
from models.language.matching.lessons import Lesson, Said, texts_of
from models.language.matching.network import MatchNet
from models.language.spans.crf import log_partition, score

TEMPERATURE = 0.07
"""Temperature of the comparison: similarities are divided by it."""
ROLE_TEMPERATURE = 0.1
WORLDS = 3
"""Worlds that half of the steps draw their tasks from, so that those which lie close together are told apart."""


@dataclass(frozen=True, slots=True)
class Settings:
    """The hyper-parameters of a run."""

    steps: int = 300
    tasks: int = 32  # compared in a step
    refused: int = 16  # texts in a step that ask for nothing
    learning_rate: float = 1e-3  # AdamW; falls to zero along a cosine
    decay: float = 1e-2
    clip: float = 1.0
    dropout: float = 0.3


@dataclass(frozen=True, slots=True, eq=False)
class Course:
    """Lessons and texts that ask for nothing, with the vectors [S, D] of all of them, in half precision."""

    lessons: Sequence[Lesson]
    refused: Sequence[Said]
    read: dict[tuple[str, ...], Tensor]

    @classmethod
    def of(cls, lessons: Sequence[Lesson], refused: Sequence[Said], encoder: Encoder) -> Course:
        """Read every text once."""
        said = sorted({text.words for text in [*texts_of(lessons), *refused]}, key=len)
        read: dict[tuple[str, ...], Tensor] = {}
        for start in range(0, len(said), 64):
            part = said[start : start + 64]
            vectors = torch.from_numpy(encoder.read_deeply(part).astype(np.float16))
            read.update((text, found[: len(text)].clone()) for text, found in zip(part, vectors, strict=True))
        return cls(lessons, refused, read)


def fit(course: Course, settings: Settings, *, seed: int, log: Callable[[dict[str, float]], None] | None) -> MatchNet:
    """A network fitted to a course; the same seed gives the same one on the same kind of machine."""
    generator = random.Random(seed)
    with torch.random.fork_rng(devices=[]):
        torch.manual_seed(seed)
        size = next(iter(course.read.values())).shape[1]
        network = MatchNet(MatchConfig(vector=size, dropout=settings.dropout)).train()
        network.centre(torch.cat([course.read[text.words] for text in texts_of(course.lessons)]).float())
        optimizer = torch.optim.AdamW(network.parameters(), settings.learning_rate, weight_decay=settings.decay)
        schedule = torch.optim.lr_scheduler.CosineAnnealingLR(optimizer, settings.steps)
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


def _losses(network: MatchNet, course: Course, settings: Settings, generator: random.Random) -> dict[str, Tensor]:
    drawn = _draw(course.lessons, settings.tasks, generator)
    texts = [text for group in drawn for text in group]
    owners = torch.tensor([number for number, group in enumerate(drawn) for _ in group])
    refused = generator.choices(course.refused, k=settings.refused)
    vectors, free, tags, lengths = batch([*texts, *refused], course)
    near = network.commands(vectors).nearness(free)
    return {
        "commands": _contrast(near[: len(texts)], owners),
        "tags": 0.3 * _tagging(network, *(part[: len(texts)] for part in (vectors, tags, lengths))),
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


def batch(texts: Sequence[Said], course: Course) -> tuple[Tensor, Tensor, Tensor, Tensor]:
    """The vectors [B, S, D], free words [B, S], tags [B, S] and lengths [B] of texts."""
    read = [course.read[text.words].float() for text in texts]
    vectors = torch.nn.utils.rnn.pad_sequence(read, batch_first=True)
    free = torch.zeros(vectors.shape[:2])
    tags = torch.full(vectors.shape[:2], OUTSIDE)
    for row, text in enumerate(texts):
        free[row, : len(text.words)] = 1.0
        for begin, end in text.every:
            free[row, begin:end] = 0.0
            tags[row, begin], tags[row, begin + 1 : end] = BEGIN, ON
        if not free[row].any():
            free[row, : len(text.words)] = 1.0
    return vectors, free, tags, torch.tensor([len(text.words) for text in texts])


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

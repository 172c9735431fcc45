"""Training the paper's networks and writing down what they say on the way."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import asdict, dataclass
from typing import Any

from models.language.copynet import Model, Models, answers, formulas, load_model, pos_answers, train
from models.language.copynet.weights import System
from models.language.dataset import Domain, Split, split
from models.language.errors import WeightsError
from models.language.experiments.commands import CommandSet, paper_sets
from models.language.experiments.runs import Runs
from models.language.experiments.settings import Done, Settings
from models.language.experiments.transcript import Transcript


@dataclass(frozen=True, slots=True, eq=False)
class PaperRun:
    """One training of both networks of a domain.

    Attributes:
        points: what they said at each epoch that is measured.
        final: what the networks say that the training ended with; for the seed that ships, those that are shipped.
        record: how the training went.
    """

    points: Mapping[int, Transcript]
    final: Transcript
    record: Mapping[str, Any]


def thinned_sets(domain: Domain, settings: Settings) -> tuple[CommandSet, CommandSet]:
    """S and U of a domain, as much of them as is asked."""
    seen, unseen = paper_sets(domain)
    return seen.thinned(settings.most), unseen.thinned(settings.most)


def paper_run(domain: Domain, seed: int, settings: Settings, runs: Runs, done: Done) -> PaperRun:
    """The run of a domain and seed: from the folder if it is there, or else trained and kept.

    `done` is told of every epoch, whether it had to be trained or not.
    """
    name = f"paper-{domain}-{seed}"
    data = runs.read(name, made_with(settings))
    if data is None:
        data = _trained(domain, seed, settings, lambda: done(f"train {name}"))
        runs.write(name, made_with(settings), data)
    else:
        for _ in range(settings.copynet.epochs):
            done(f"read {name}")
    points = {int(epoch): Transcript.from_json(entry) for epoch, entry in data["points"].items()}
    shipped = _shipped(domain, seed, settings)
    final = _transcribe(shipped, domain, settings) if shipped else Transcript.from_json(data["final"])
    return PaperRun(points, final, data["record"])


def made_with(settings: Settings) -> dict[str, Any]:
    """What of the settings decides a run, as it is kept with it."""
    return {**asdict(settings.copynet), "measured": settings.epochs, "taught": settings.taught, "most": settings.most}


def _trained(domain: Domain, seed: int, settings: Settings, done: Callable[[], None]) -> dict[str, Any]:
    points: dict[int, Any] = {}

    def on_epoch(epoch: int, models: Models) -> None:
        if epoch in settings.epochs:
            points[epoch] = _transcribe((models.cq, models.ltl), domain, settings).as_json()
        done()

    whole = split(domain, seed=seed)
    data = Split(whole.training[: settings.taught], whole.validation[: settings.taught])
    models = train(domain, settings.copynet, seed=seed, on_epoch=on_epoch, data=data)
    final = _transcribe((models.cq, models.ltl), domain, settings).as_json()
    return {"points": points, "final": final, "record": asdict(models.record)}


def _transcribe(models: tuple[Model, Model], domain: Domain, settings: Settings) -> Transcript:
    queries, spoken = models
    texts = [text for commands in thinned_sets(domain, settings) for text in commands.texts]
    return Transcript(
        tuple(answers(queries, texts)), tuple(pos_answers(queries, texts)), tuple(formulas(spoken, texts))
    )


def _shipped(domain: Domain, seed: int, settings: Settings) -> tuple[Model, Model] | None:
    """The networks that are shipped, if they were made with this seed and these settings."""
    try:
        models = load_model(System.CQ, domain), load_model(System.LTL, domain)
    except WeightsError:
        return None
    record = {"seed": seed, **asdict(settings.copynet)}
    as_asked = all(record.items() <= dict(model.training).items() for model in models)
    return models if as_asked and settings.taught is None else None

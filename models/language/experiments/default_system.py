"""The translator that the service uses by default, as a system to be measured."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict, dataclass, field
from pathlib import Path

from models.language.composition import ComposedTranslator
from models.language.dataset import Domain
from models.language.errors import WeightsError
from models.language.experiments.answer import Answer
from models.language.experiments.causes import NO_TEMPLATE
from models.language.experiments.commands import paper_sets
from models.language.experiments.templates import given
from models.language.reading import rank
from models.language.scene import Scene
from models.language.spans import (
    DEFAULT_NAME,
    SpanModel,
    SpanTranslator,
    load_model,
    save_model,
)
from models.language.spans.lessons import Lessons
from models.language.spans.training import Settings, train
from models.language.translation import BEAM_WIDTH, Translation, Translator
from models.queries import ContextualQuery, Query, Template
from models.world import Environment

NAME = "default"


@dataclass(frozen=True, slots=True, eq=False)
class DefaultSystem:
    """A translator, templates from one example of each task class, and readings ranked in the environment.

    Attributes:
        ranked: whether the environment decides between readings. Without, the translator's best one is grounded.
    """

    translator: Translator
    templates: Mapping[str, Template]
    ranked: bool = True
    _heard: dict[str, tuple[Translation, ...]] = field(default_factory=dict)

    @classmethod
    def of(cls, translator: Translator) -> DefaultSystem:
        """The system of a translator, with templates for the task classes of both domains."""
        templates = [given(paper_sets(domain)[0]) for domain in Domain]
        return cls(translator, {task: template for group in templates for task, template in group.items()})

    @property
    def name(self) -> str:
        """See `System`."""
        return NAME

    @property
    def speaks_queries(self) -> bool:
        """See `System`."""
        return True

    def unranked(self) -> DefaultSystem:
        """The same system, blind to the environment when it chooses a reading."""
        return DefaultSystem(self.translator, self.templates, False, self._heard)

    def readings(self, text: str) -> tuple[Translation, ...]:
        """What the translator reads in a text, as it is when no environment is known."""
        if text not in self._heard:
            self._heard[text] = self.translator.translate(text, candidates=BEAM_WIDTH)
        return self._heard[text]

    def answer(self, texts: Sequence[str], environment: Environment) -> list[Answer]:
        """See `System`."""
        return [self._answer(text, environment) for text in texts]

    def _answer(self, text: str, environment: Environment) -> Answer:
        translations = self.readings(text)
        if not self.ranked:
            translations = translations[:1]
        if not translations:
            return Answer()
        readings = rank(translations, Scene(text, environment, self.templates.get))
        if not readings:
            return Answer(_task(translations[0].query), refusal=NO_TEMPLATE, confidence=translations[0].confidence)
        best = readings[0]
        formula = None if best.grounded is None else best.grounded.formula
        refusal = None if best.refusal is None else best.refusal.slug
        return Answer(_task(best.query), formula, refusal, best.confidence)


def _task(query: Query) -> ContextualQuery | None:
    """A query of one task; the paper's commands say no other."""
    return query if isinstance(query, ContextualQuery) else None


def trained_system(seed: int, settings: Settings, runs: Path, done: Callable[[str], None]) -> DefaultSystem:
    """The system of a seed: what ships if it was made with this seed and these settings, else a run of the folder.

    A run that is not there is trained and kept. `done` is told of every epoch, whether it had to be trained or not.
    """
    record = {"seed": seed, **asdict(settings)}
    name = f"default-{seed}"
    model = _made_so(None, DEFAULT_NAME, record) or _made_so(runs, name, record)
    if model is None:
        model = train(Lessons.load(seed=seed), settings, seed=seed, log=lambda _: done(f"train {name}"))
        save_model(model, runs, name=name)
    else:
        for _ in range(settings.epochs):
            done(f"read {name}")
    return DefaultSystem.of(ComposedTranslator.load(SpanTranslator.of(model)))


def _made_so(folder: Path | None, name: str, record: Mapping[str, object]) -> SpanModel | None:
    """The model of a name, if it is there and was made as the record says."""
    try:
        model = load_model(folder, name=name)
    except WeightsError:
        return None
    return model if record.items() <= dict(model.training).items() else None

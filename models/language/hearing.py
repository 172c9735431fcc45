"""What a text may say to someone who was taught: wordings as they were taught, what means the same, and the networks.

Three sources give readings of a command. A wording that was taught is certain. A text that is near to the examples or
the card of a taught task says it with a probability. The translator's networks know the tasks that they were trained
on. The last two weigh against each other: each is believed as far as the other is in doubt.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass, replace

from models.language.composition import ComposedTranslator
from models.language.formal import is_formal
from models.language.matching import Matcher, Shelf
from models.language.reading import AMBIGUOUS, GROUNDED, SENSELESS, Reading, rank, read
from models.language.teaching import TaughtTranslator
from models.language.tokens import words
from models.language.translation import BEAM_WIDTH, NEGATIONS, Translation, Translator, weighed
from models.language.trimming import trimmed
from models.queries import Composition, ContextualQuery, Template
from models.world import Environment, mentions

MATCHED = 12
"""Readings by nearness that are looked at: the environment may make sense of a later one only."""
HEARD = 0.5
"""Probability of any taught task from which one is heard."""
HEARD_OF_THINGS = 0.03
"""The same for a text that names things of the environment: that is hardly said to a robot there for nothing."""
NEGATED = NEGATIONS | {"no"}
"""Words with which a text may forbid the task that it is near to."""
COMPOSED = 0.4
"""Confidence from which a text that means nothing as one task is taken for several."""
DOUBTED = 0.3
"""What is left of the probability of a composition around one taught task."""
AROUND = 0.5
"""Probability of the compositions around a task from which it is not taken for the whole."""


@dataclass(frozen=True, slots=True, eq=False)
class Lessons:
    """What was taught: the wordings of examples, and the shelf of tasks with the matcher that compares with them.

    `functions` are the propositional functions that the template of a task needs. `own` are the tasks that the networks
    know: they are on the shelf to be told apart from others, and are left to the networks.
    """

    wordings: TaughtTranslator
    shelf: Shelf
    matcher: Matcher
    functions: Mapping[str, frozenset[str]]
    own: frozenset[str] = frozenset()

    def within(self, environment: Environment | None) -> Situated:
        """What understands clauses said in the environment."""
        return Situated(self, environment)

    @property
    def nothing_new(self) -> bool:
        """Whether the networks know all tasks, so that there is nothing to compare with."""
        return all(task.task in self.own for task in self.shelf.tasks)

    def doubted(self, heard: Translation, near: Sequence[Translation]) -> Translation:
        """A composition around one taught task is rather a task in other words: "no lamp should be left on". Not if the
        whole text is nearest to that one: then it says something of it, "don't put it in the box".
        """
        tasks = [task.task for _, task in heard.query.tasks]
        if isinstance(heard.query, ContextualQuery) or len(tasks) > 1 or tasks[0] in self.own:
            return heard
        if near and tasks == [task.task for _, task in near[0].query.tasks]:
            return heard
        return replace(heard, confidence=DOUBTED * heard.confidence)

    def _taught(self, found: Sequence[Translation], *, least: float = HEARD) -> tuple[Translation, ...]:
        """Without the tasks that the networks know; nothing where all together are not probable."""
        if sum(translation.confidence for translation in found) <= least:
            return ()
        return tuple(t for t in found if self.own.isdisjoint(task.task for _, task in t.query.tasks))

    def near(self, text: str, *, candidates: int, environment: Environment | None = None) -> tuple[Translation, ...]:
        """What means the same as a task that was taught and that makes sense in the environment."""
        return self.near_all([text], candidates=candidates, environment=environment)[0]

    def near_all(
        self, texts: Sequence[str], *, candidates: int, environment: Environment | None = None
    ) -> list[tuple[Translation, ...]]:
        """As `near`, for several texts at once, which is faster than one after the other."""
        if self.nothing_new:
            return [()] * len(texts)
        there = None if environment is None else frozenset(environment.functions)

        def fits(task: str) -> bool:
            return there is None or self.functions[task] <= there

        def named(said: tuple[str, ...]) -> Sequence[tuple[int, int]]:
            return () if environment is None else mentions(said, environment)

        found = self.matcher.match_all(texts, self.shelf, candidates=candidates, fits=fits, named=named)
        return [
            self._taught(near, least=HEARD_OF_THINGS if any(named(words(text))) else HEARD)
            for text, near in zip(texts, found, strict=True)
        ]

    def nearest(self, text: str, *, count: int, environment: Environment | None = None) -> tuple[str, ...]:
        """The tasks that are nearest to a text, of those that make sense there; raises TextTooLongError."""
        found = self.matcher.nearest(text, self.shelf, count=len(self.shelf.tasks))
        there = None if environment is None else frozenset(environment.functions)
        fitting = [task for task, _ in found if there is None or self.functions[task] <= there]
        return tuple(fitting[:count])


@dataclass(frozen=True, slots=True, eq=False)
class Situated:
    """Lessons that are heard in an environment."""

    lessons: Lessons
    environment: Environment | None

    def translate_all(self, texts: Sequence[str], *, candidates: int = 1) -> list[tuple[Translation, ...]]:
        """The readings of each text as it was taught, or else of what means the same; see `Translator`."""
        found = {text: self.lessons.wordings.translate(text, candidates=candidates) for text in texts}
        rest = [text for text, exact in found.items() if not exact]
        near = self.lessons.near_all(rest, candidates=candidates, environment=self.environment)
        found.update(zip(rest, near, strict=True))
        return [found[text] for text in texts]


@dataclass(frozen=True, slots=True, eq=False)
class Hearing:
    """A translator, with lessons if it hears any, and the templates of all tasks."""

    translator: Translator
    lessons: Lessons | None
    template_of: Callable[[str], Template | None]

    def readings(self, text: str, environment: Environment | None, *, candidates: int) -> tuple[Reading, ...]:
        """Up to `candidates` readings of a command, best first; none when no task fits, or where it is a formula.

        In an environment, what makes sense there comes first. Taught readings that make no sense give way to readings
        that do: "go to the sphere", taught for picking up, does not keep "go to the kitchen" from being understood.

        Raises:
            TextTooLongError: the text is beyond the limits of a command.
        """
        if is_formal(text):
            return ()
        wanted = candidates if environment is None else max(candidates, BEAM_WIDTH)
        translator, lessons = self.translator, self.lessons
        if lessons is None:
            return self._ranked(text, translator.translate(text, candidates=wanted), environment)[:candidates]
        if isinstance(translator, ComposedTranslator):
            translator = translator.knowing(lessons.within(None), nearby=lessons.within(environment))
        exact = lessons.wordings.translate(text, candidates=BEAM_WIDTH)
        heard = translator.translate(text, candidates=wanted)
        if not exact:
            near = lessons.near(text, candidates=MATCHED, environment=environment)
            if (
                near
                and not heard
                and isinstance(translator, ComposedTranslator)
                and not NEGATED.isdisjoint(words(text))
            ):
                heard = translator.several(text, candidates=wanted, asked=True)
            near, heard = (
                tuple(parted(translation, heard, lessons.own) for translation in near),
                tuple(lessons.doubted(translation, near) for translation in heard),
            )
            heard = weighed(near, heard)
        ranked = self._ranked(text, heard, environment)
        if isinstance(translator, ComposedTranslator) and environment is not None and _senseless(ranked):
            ranked = self._otherwise(text, heard, environment, translator, wanted) or ranked
        taught = read(text, exact, template_of=self.template_of, environment=environment)
        return merged(taught, ranked)[:candidates]

    def _otherwise(
        self,
        text: str,
        heard: Sequence[Translation],
        environment: Environment,
        translator: ComposedTranslator,
        candidates: int,
    ) -> tuple[Reading, ...]:
        """What a text that means nothing there may say: several commands, if likely, else what was heard without words
        around the names, else several commands all the same; none where that means nothing either.
        """
        composed = self._ranked(text, translator.several(text, candidates=candidates), environment)
        sensible = not _senseless(composed)
        if sensible and composed[0].confidence >= COMPOSED:
            return composed
        shorter = self._ranked(text, trimmed(heard, environment, translator.saying), environment)
        return shorter if not _senseless(shorter) else composed if sensible else ()

    def _ranked(
        self, text: str, translations: Sequence[Translation], environment: Environment | None
    ) -> tuple[Reading, ...]:
        return rank(text, translations, template_of=self.template_of, environment=environment)


def _senseless(readings: Sequence[Reading]) -> bool:
    """Whether a text that is understood, if at all, means nothing in the environment."""
    return all(reading.weight <= SENSELESS for reading in readings)


def parted(near: Translation, heard: Sequence[Translation], own: Collection[str] = ()) -> Translation:
    """A task that is probably a clause of what was heard is hardly all that the text says, the less where it is
    forbidden; nor is one of the same things as a clause that is the networks' `own`.
    """
    said = {task.task for _, task in near.query.tasks}
    things = {task.arguments for _, task in near.query.tasks}
    around = sum(
        translation.confidence
        for translation in heard
        if isinstance(translation.query, Composition)
        and any(t.task in said or (t.task in own and t.arguments in things) for _, t in translation.query.tasks)
    )
    return replace(near, confidence=DOUBTED * near.confidence) if around >= AROUND else near


def merged(taught: Sequence[Reading], learned: Sequence[Reading]) -> tuple[Reading, ...]:
    """The taught readings that make sense, then the others; just the learned ones where only those do.

    A taught reading that takes a word for misspelt makes less sense than a learned one that takes all as said.
    """
    best = learned[0].weight if learned else SENSELESS
    least = AMBIGUOUS if best == GROUNDED else SENSELESS
    fitting = [reading for reading in taught if reading.weight >= least and reading.weight > SENSELESS]
    if not fitting and best > SENSELESS:
        return tuple(learned)
    first = _shared(fitting or taught)
    known = {reading.query for reading in first}
    rest = [replace(r, confidence=0.0) if first else r for r in learned if r.query not in known]
    return (*first, *rest)


def _shared(readings: Sequence[Reading]) -> list[Reading]:
    """The readings with confidences that add up to 1; those of no confidence share it when nothing else is left."""
    total = sum(reading.confidence for reading in readings)
    return [replace(r, confidence=r.confidence / total if total else 1 / len(readings)) for r in readings]

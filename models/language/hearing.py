"""What a text may say to someone who was taught: wordings as they were taught, what means the same, and the networks.

Three sources give readings of a command. A wording that was taught is certain. A text that is near to the examples or
the card of a taught task says it with a probability. The translator's networks know the tasks that they were trained
on. The last two weigh against each other: each is believed as far as the other is in doubt.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace

from models.language.composition import ComposedTranslator
from models.language.contraries import contrary
from models.language.coordination import Joined, joined
from models.language.corrections import corrected
from models.language.formal import is_formal
from models.language.matching import Matcher, Shelf
from models.language.reading import SENSELESS, Reading, rank, read
from models.language.restating import Restated, restated
from models.language.scene import Scene
from models.language.teaching import INTERROGATIVES, TaughtTranslator
from models.language.teaching.sources import mistakes_source, moves_back
from models.language.tokens import is_mark, marked_words, words
from models.language.translation import BEAM_WIDTH, NEGATIONS, Translation, Translator, weighed
from models.language.trimming import trimmed
from models.language.weighing import doubted, forbidden_too, merged, parted
from models.language.whereabouts import Located, located
from models.queries import Template
from models.world import Environment, UnknownObjectError, mentions, speaks_of_others

MATCHED = 12
"""Readings by nearness that are looked at: the environment may make sense of a later one only."""
WIDER = 16
"""Readings of the networks that are looked at where the likeliest mean nothing in the environment: with several tasks,
each said of a place or of a thing, the one that makes sense may be far down.
"""
CERTAIN = 0.98
"""Confidence of a reading of the networks from which it is not compared with what was taught."""
HEARD = 0.5
"""Probability of any taught task from which one is heard."""
HEARD_OF_THINGS = 0.03
"""The same for a text that names things of the environment: that is hardly said to a robot there for nothing."""
HEARD_OF_WHAT_CANNOT_BE = 0.98
"""The same for a text that is only near to it, where the things that it names cannot have that done to them: it rather
says something that nobody taught.
"""
CONTRARY = 0.1
"""How much less probable a task is that the text says the contrary of: "unlock the cup", near to locking it."""
NEGATED = NEGATIONS | {"no"}
"""Words with which a text may forbid the task that it is near to."""
FORBIDDEN = 0.5
"""Probability that a text forbids something, from which it may forbid what it is near to."""
FORBIDDEN_IN_PART = 0.9
"""Probability that it forbids a part of what it says, from which it is near to nothing."""
ASKING = INTERROGATIVES | {"is", "are", "was", "were", "does", "did", "has"}
"""Words with which questions begin."""
QUESTION = 0.5
"""Probability that a text asks for nothing from which it is a question, if it begins like one."""
COMPOSED = 0.4
"""Confidence from which a text that means nothing as one task is taken for several."""

SHARED = 0.5
"""Confidence from which a reading that does the same to all names that are joined is not doubted."""
MOST_TEXTS, LONGEST = 12, 40
"""Most texts that are read besides a command, to understand it; and most words of a command for which any is."""


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

        spoken = [words(text) for text in texts]
        named = {said: () if environment is None else mentions(said, environment) for said in spoken}
        found = self.matcher.match_all(texts, self.shelf, candidates=candidates, fits=fits, named=named.__getitem__)
        return [
            self._taught(self._heeded(said, near), least=HEARD_OF_THINGS if named[said] else HEARD)
            for said, near in zip(spoken, found, strict=True)
        ]

    def _heeded(self, said: Sequence[str], near: Sequence[Translation]) -> tuple[Translation, ...]:
        """What moves no thing to where the text says that it is, and none to what the text moves to it; what the text
        says the contrary of last.
        """
        sources, moves, own = self.wordings.sources, self.wordings.moves, self.wordings.own_words
        kept = []
        for translation in near:
            tasks = [task for _, task in translation.query.tasks]
            if any(mistakes_source(said, task, sources) or moves_back(said, task, moves) for task in tasks):
                continue
            against = any(contrary(said, task, own.get(task.task, ())) for task in tasks)
            kept.append(replace(translation, confidence=CONTRARY * translation.confidence) if against else translation)
        return tuple(sorted(kept, key=lambda translation: -translation.confidence))

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
        return () if is_formal(text) else self._heard(text, environment, candidates, [MOST_TEXTS])

    def _heard(
        self, text: str, environment: Environment | None, candidates: int, left: list[int]
    ) -> tuple[Reading, ...]:
        """As `readings`; `left` is how many other texts may be read for it."""
        found = self._as_said(text, environment, candidates=candidates)
        if environment is None or self.lessons is None or len(words(text)) > LONGEST:
            return found
        return self._otherwise_said(text, environment, found, candidates, left)

    def _otherwise_said(
        self, text: str, environment: Environment, found: tuple[Reading, ...], candidates: int, left: list[int]
    ) -> tuple[Reading, ...]:
        """The readings of a text, before them what it says in other words, of each of the names that are joined in it,
        or of a thing without where it is, where none of them is as sure.
        """
        assert self.lessons is not None
        best = found[0] if found and not _senseless(found[:1]) else None
        taught = bool(self.lessons.wordings.translate(text, candidates=1))
        ways: list[Restated | Located | Joined] = [
            *(way for way in restated(text) if not (taught and way.mistaken)),
            *located(text, environment),
            *joined(text, environment),
        ]
        for way in ways:
            mistaken = isinstance(way, Restated) and way.mistaken
            if best is not None and best.confidence >= SHARED and not way.tears(best.query):
                continue
            left[0] -= len(way.texts)
            if left[0] < 0:
                break
            parts = [self._heard(part, environment, 1, left)[:1] for part in way.texts]
            query = None if any(map(_senseless, parts)) else way.put_together([part[0].query for part in parts])
            confidence = min((part[0].confidence for part in parts if part), default=0.0)
            if query is None or (best is not None and confidence <= best.confidence and not mistaken):
                continue
            right = corrected(text, [Translation(query, confidence)])
            first = read(right, Scene(text, environment, self.template_of))
            if not first or (found and _senseless(first)):
                continue
            if mistaken:
                return first[:candidates]
            rest = [replace(r, confidence=(1.0 - confidence) * r.confidence) for r in found if r.query != query]
            return (*first, *rest)[:candidates]
        return found

    def _as_said(self, text: str, environment: Environment | None, *, candidates: int) -> tuple[Reading, ...]:
        """As `readings`, of all the words together."""
        wanted = candidates if environment is None else max(candidates, BEAM_WIDTH)
        translator, lessons = self.translator, self.lessons
        scene = Scene(text, environment, self.template_of)
        if lessons is None:
            return _ranked(translator.translate(text, candidates=wanted), scene)[:candidates]
        if isinstance(translator, ComposedTranslator):
            translator = translator.knowing(lessons.within(None), nearby=lessons.within(environment))
        exact = lessons.wordings.translate(text, candidates=BEAM_WIDTH)
        heard = translator.translate(text, candidates=wanted if environment is None else WIDER)
        taught = read(exact, scene)
        sensible = bool(exact) and (environment is None or not _misheard(taught, environment))
        said: Sequence[Translation] = heard[:wanted]
        ranked = _ranked(said, scene)
        near: tuple[Translation, ...] = ()
        if not sensible and not _certain(ranked):
            if not self._is_question(text):
                near = lessons.near(text, candidates=MATCHED, environment=environment)
            near, heard = self._told_apart(scene, near, heard, translator)
            said = weighed(near, heard[:wanted])
            ranked = _ranked(said, scene)
        if len(heard) > wanted and _senseless(ranked):
            said = weighed(near, heard)
            ranked = _ranked(said, scene)
        if isinstance(translator, ComposedTranslator) and environment is not None and _senseless(ranked):
            ranked = self._otherwise(scene, said, translator, wanted) or ranked
        if not heard and not exact and environment is not None and _senseless(ranked):
            least = HEARD if _of_what_is_unknown(ranked) else HEARD_OF_WHAT_CANNOT_BE
            ranked = ranked if sum(reading.confidence for reading in ranked) > least else ()
        return merged(taught, ranked)[:candidates]

    def _is_question(self, text: str) -> bool:
        """Whether a text asks what is so: it begins as questions do, nothing follows the question, and the networks
        hear no command in it.
        """
        said, translator = marked_words(text), self.translator
        if not said or said[0].removesuffix("'s") not in ASKING or not isinstance(translator, ComposedTranslator):
            return False
        if any(is_mark(word) for word in said[:-1]):
            return False
        return translator.refuses(text) >= QUESTION

    def _told_apart(
        self, scene: Scene, near: Sequence[Translation], heard: Sequence[Translation], translator: Translator
    ) -> tuple[tuple[Translation, ...], tuple[Translation, ...]]:
        """What a text is near to, and what the networks heard, each as likely as the other leaves it."""
        assert self.lessons is not None
        own, text = self.lessons.own, scene.text
        composed = translator if isinstance(translator, ComposedTranslator) else None
        if not near or composed is None:
            return tuple(near), tuple(doubted(said, near, own) for said in heard)
        negated = not NEGATED.isdisjoint(words(text))
        if negated and not heard:
            heard = composed.several(text, candidates=BEAM_WIDTH, asked=True)
        if negated and composed.forbids_in_part(text) >= FORBIDDEN_IN_PART:
            return (), tuple(heard)
        sensible = _ranked(heard, scene)
        if _senseless(sensible) and any(self.lessons.wordings.translate(part) for part in composed.parts(text)):
            return (), tuple(heard) if sum(said.confidence for said in heard) > HEARD else ()
        likely = [Translation(reading.query, reading.confidence) for reading in sensible]
        told = tuple(parted(said, likely, own) for said in near)
        if negated and told == tuple(near) and composed.forbids(text) >= FORBIDDEN:
            told = forbidden_too(told)
        return told, tuple(doubted(said, near, own) for said in heard)

    def _otherwise(
        self, scene: Scene, heard: Sequence[Translation], translator: ComposedTranslator, candidates: int
    ) -> tuple[Reading, ...]:
        """What a text that means nothing there may say: several commands, if likely, else what was heard without words
        around the names, else several commands all the same; none where that means nothing either.
        """
        assert scene.environment is not None
        composed = _ranked(translator.several(scene.text, candidates=candidates), scene)
        sensible = not _senseless(composed)
        if sensible and composed[0].confidence >= COMPOSED:
            return composed
        shorter = _ranked(trimmed(heard, scene.environment, translator.saying), scene)
        return shorter if not _senseless(shorter) else composed if sensible else ()


def _ranked(translations: Iterable[Translation], scene: Scene) -> tuple[Reading, ...]:
    """As `rank`, of what is put right first."""
    return rank(corrected(scene.text, translations), scene)


def _misheard(taught: Sequence[Reading], environment: Environment) -> bool:
    """Whether no wording that was taught makes sense with what stands in its places, for a word that is no name there:
    "put the cup down in the bedroom". Of a thing that is only somewhere else, there is none to be heard.
    """
    phrases = [phrase for reading in taught for _, task in reading.query.tasks for phrase in task.arguments]
    return _senseless(taught) and not any(speaks_of_others(phrase, environment) for phrase in phrases)


def _of_what_is_unknown(readings: Sequence[Reading]) -> bool:
    """Whether the best reading means nothing because a word of it is no name in the environment."""
    return bool(readings) and isinstance(readings[0].refusal, UnknownObjectError)


def _certain(readings: Sequence[Reading]) -> bool:
    """Whether a reading is so sure, and makes sense, that nothing that was taught would be believed more."""
    return bool(readings) and readings[0].weight > SENSELESS and readings[0].confidence >= CERTAIN


def _senseless(readings: Sequence[Reading]) -> bool:
    """Whether a text that is understood, if at all, means nothing in the environment."""
    return all(reading.weight <= SENSELESS for reading in readings)

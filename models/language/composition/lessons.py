"""The texts that teach how commands are put together, drawn anew in each epoch.

A text's *task* is the shape of its composition, such as `then(1, or(2, 3))`, and its arguments are the clauses. One
command alone has the shape `SINGLE`, whatever it asks for. Names of things are drawn from the same lists as for the
default translator's task classes, so nothing but the way clauses are joined can be learned by heart.
"""

from __future__ import annotations

import random
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from itertools import chain
from typing import Literal, Self

from models.language.composition.labels import BARE, Told
from models.language.composition.shapes import ONE_CLAUSE, SINGLE, read_shape
from models.language.dataset import frames, no_task
from models.language.dataset.asides import asides, drawn, remark
from models.language.dataset.composition import Form, Hole, Leaf, Pattern, leaves, patterns, slot_elements
from models.language.dataset.nesting import nested, nestings
from models.language.spans.items import Item
from models.language.spans.lessons import CLAUSE_SLOTS, DETERMINERS, REFERRED, Lessons, misspelled
from models.language.spans.names import names
from models.language.spans.tags import Span
from models.language.spans.training import Settings
from models.language.tokens import is_punctuation, marked_words

SETTINGS = Settings(epochs=24, batch=40, embedding=32, encoder=192, dropout=0.2, hide_frame=0.35)
"""How the network is fitted."""
EACH, ALONE, NONE = 100, 1700, 1000
"""Texts of a composition on average, of one command alone, and of no command, in an epoch."""
FOLLOWING = 16
"""Texts of a composition that has no patterns of its own."""
RENAMED = 0.4
"""Part of the names in texts of no command that are replaced: no name alone tells that nothing is asked for."""
NESTED, FEW = 0.08, 10
"""Part of the texts of other compositions that are patterns within patterns, at least; half of those of which there are
so few patterns.
"""
PLAIN, PLAINEST = 0.2, 6
"""Part of the texts that are said in one of the first ways of a list, and how many those are: people say it plainly
more often than in any other of hundreds of ways.
"""
UNMARKED = 0.25
"""Part of the texts without any mark of punctuation."""
LOST = 0.15
"""Marks that are left out of the other texts."""
_REPEATED = ("object", "place", "container")
PLACE_KINDS = ("location", "first")
"""Rooms, and landmarks of a city."""
FRAMED, MISSPELLED, HASTY, PRONOUN = 0.35, 0.18, 0.07, 0.35
"""Parts of the texts with something polite around them, with typing mistakes, with several, and pronouns for what was
named before.
"""
REASON, ASIDE, PURPOSE = 0.07, 0.08, 0.06
"""Parts of the texts with a reason in front, and behind; of the clauses with something said beside them; and of the
places that are visited for something.
"""
REMARKS = 150
"""Reasons without a command in an epoch."""


@dataclass(frozen=True, slots=True)
class CompositionLessons:
    """What texts are drawn from; see `models.language.spans.training.Course`."""

    single: Lessons
    refused: Sequence[Item]
    held_out: Sequence[Item]

    @classmethod
    def load(cls, *, seed: int) -> Self:
        """With the commands of one task that are drawn with a seed; U and the held-out lists are never drawn."""
        texts = no_task(seed=seed, joined=False, remarks=False)  # else short commands look like remarks
        refused, held_out = (
            [Item(spoken) for text in part if (spoken := marked_words(text))]
            for part in (texts.training, texts.held_out)
        )
        return cls(Lessons.load(seed=seed), refused, held_out)

    @property
    def tasks(self) -> tuple[tuple[str, int], ...]:
        """The shapes with their numbers of clauses."""
        composed = (shape for shape in _times() if shape != SINGLE)
        return ((SINGLE, 1), *((shape, len({task for _, task in read_shape(shape).tasks})) for shape in composed))

    @property
    def words(self) -> tuple[str, ...]:
        """The words and marks that join clauses, and those of the clauses beside their names."""
        joining = (element for group in patterns().values() for pattern in group for element in pattern.elements)
        clauses = (element for leaf in leaves() for text in leaf.forms.values() for element in slot_elements(text))
        framing = (word for kind in _framing() for frame in kind for word in marked_words(frame))
        beside = (word for aside in asides("training").asides for word in marked_words(aside))
        return tuple(sorted({word for word in chain(joining, clauses, framing, beside) if isinstance(word, str)}))

    def epoch(self, generator: random.Random) -> list[Item]:
        """Texts for one pass."""
        items = [self.composed(shape, generator) for shape, count in _times().items() for _ in range(count)]
        items += [self.alone(generator) for _ in range(ALONE)]
        items += [self._renamed(item, generator) for item in generator.choices(self.refused, k=NONE)]
        items += [Item(tuple(remark(lambda slot: self._phrase(slot, generator), generator))) for _ in range(REMARKS)]
        return [self._mistyped(item, generator) for item in items]

    def checks(self, generator: random.Random) -> list[Item]:
        """What the network is judged by: further texts of the same kind, and texts without a command."""
        items = [self.composed(shape, generator) for shape in _times() for _ in range(6)]
        return [*items, *(self.alone(generator) for _ in range(200)), *self.held_out]

    def alone(self, generator: random.Random) -> Item:
        """One command: of the paper's classes, or any clause."""
        if generator.random() < 0.5:
            item = self.single.command(generator.choice(ONE_CLAUSE), generator)
            before, after = item.frame
            alone = Item(item.text, SINGLE, (((before, len(item.text) - after),),), item.frame)
            return self._reasoned(alone, generator)
        leaf = generator.choice(leaves())
        text = self._said(leaf, "do" if generator.random() < 0.9 else "state", generator, Told.drawn(generator))
        item = Item(tuple(text), SINGLE, (((0, len(text)),),))
        return self._reasoned(self._framed(item, "do", generator), generator)

    def composed(self, shape: str, generator: random.Random) -> Item:
        """A text of a shape."""
        own = patterns().get(shape, ())
        rather_nested = shape in nestings() and generator.random() < max(NESTED, FEW / (FEW + len(own)))
        pattern = nested(shape, generator) if rather_nested else _way(own, generator)
        chosen = _leaves(pattern, generator)
        keeps = 0.0 if generator.random() < UNMARKED else 1.0 - LOST
        text: list[str] = []
        mentions: list[tuple[Span, ...]] = [()] * len({hole.leaf for hole in pattern.holes})
        told = Told.drawn(generator)
        heard: dict[int, list[str]] = {}
        for element in pattern.elements:
            if isinstance(element, str):
                if not is_punctuation(element) or generator.random() < keeps:
                    text.append(element)
                continue
            if element.form == "echo":
                text += heard[element.leaf]
                continue
            said = self._said(chosen[element.leaf], element.form, generator, told)
            if text and text[-1] == "no" and said[0] in DETERMINERS:
                said = said[1:]
            mentions[element.leaf - 1] += ((len(text), len(text) + len(said)),)
            text += said
            heard.setdefault(element.leaf, said)
            text += self._beside(element, chosen[element.leaf], keeps, generator)
        item = Item(tuple(text), shape, tuple(mentions))
        first = pattern.elements[0]
        framed = self._framed(item, first.form if isinstance(first, Hole) else "it", generator)
        return self._reasoned(framed, generator)

    def _said(self, leaf: Leaf, form: Form, generator: random.Random, told: Told) -> list[str]:
        """The words of a clause; what was named before may be a pronoun."""
        if form == "it":
            slot = leaf.target or leaf.slots[-1]
            told.named.add(slot)
            return self._phrase(slot, generator, told)
        text = leaf.forms.get(form) or leaf.pieces.get(form) or leaf.do
        said: list[str] = []
        previous = ""
        for element in slot_elements(text):
            if isinstance(element, str):
                said.append(element)
                continue
            (slot,) = element
            may_be_pronoun = previous != "color" and (form, slot) != ("subject", "place")
            if may_be_pronoun and slot in told.named and slot in _REPEATED and generator.random() < PRONOUN:
                there = slot == "place" and said and said[-1] in ("to", "at", "in")
                if there:
                    said.pop()
                said.append("there" if slot == "place" else "it")
            else:
                said += self._phrase(slot, generator, told, bare=previous == "color")
            told.named.add(slot)
            previous = slot
        return said

    def _mistyped(self, item: Item, generator: random.Random) -> Item:
        """The same, some with a typing mistake, and few with several."""
        chance = generator.random()
        for _ in range(0 if chance > MISSPELLED else 3 if chance < HASTY else 1):
            item = misspelled(item, generator)
        return item

    def _beside(self, hole: Hole, leaf: Leaf, keeps: float, generator: random.Random) -> list[str]:
        """What may be said after a clause and is no part of it: what for, or something to be nice."""
        said: list[str] = []
        text = leaf.forms.get(hole.form, "")
        at_a_place = text.endswith("{place}") or (hole.form == "it" and leaf.target == "place")
        if at_a_place and leaf.task == "navigate_one" and generator.random() < PURPOSE:
            said += self._drawn(asides("training").purposes, generator)
        if generator.random() < ASIDE:
            commas = [[","] if generator.random() < keeps else [] for _ in range(2)]
            said += [*commas[0], *self._drawn(asides("training").asides, generator), *commas[1]]
        return said

    def _reasoned(self, item: Item, generator: random.Random) -> Item:
        """The same with what leads to it in front, and with a reason or remark behind."""
        found = asides("training")
        before = self._drawn(found.reasons_before, generator) if generator.random() < REASON else []
        after: list[str] = []
        if generator.random() < REASON:
            after = [
                generator.choice([",", ".", "-", ""]),
                *self._drawn(found.reasons_after, generator),
            ]
        return item.within(before, [word for word in after if word])

    def _drawn(self, phrases: Sequence[str], generator: random.Random) -> list[str]:
        return drawn(phrases, lambda slot: self._phrase(slot, generator), generator)

    def _renamed(self, item: Item, generator: random.Random) -> Item:
        """A text of no command, with other names for some of what it names."""
        text: list[str] = []
        for word in item.text:
            kinds = _kinds().get(word)
            if kinds and generator.random() < RENAMED:
                text += self.single.names.draw(generator.choice(kinds), generator)
            else:
                text.append(word)
        return Item(tuple(text))

    def _phrase(
        self, slot: str, generator: random.Random, told: Told | None = None, *, bare: bool = False
    ) -> list[str]:
        kind = generator.choice(PLACE_KINDS) if slot == "place" else CLAUSE_SLOTS[slot]
        name, article = self.single.names.draw(kind, generator), not bare
        if told is not None and told.labels(slot, generator):
            name, article = told.labelled(name[-1], slot, generator), article and generator.random() > BARE
        elif article and slot != "color" and generator.random() < REFERRED:
            name, article = self.single.refer(name, kind, False, generator)
        determiner = generator.choice(DETERMINERS) if article else ""
        return [*([determiner] if determiner else []), *name]

    def _framed(self, item: Item, form: Form, generator: random.Random) -> Item:
        if generator.random() > FRAMED:
            return item
        calls, requests, closings = _framing()
        frame = generator.choice(generator.choice([calls, closings, requests if form == "do" else calls]))
        before, _, after = frame.partition("{}")
        return item.within(marked_words(before), marked_words(after))


def _way(own: Sequence[Pattern], generator: random.Random) -> Pattern:
    """One of the patterns of a shape, listed from the plain ones on."""
    return generator.choice(own[:PLAINEST] if generator.random() < PLAIN else own)


def _leaves(pattern: Pattern, generator: random.Random) -> Mapping[int, Leaf]:
    """A clause for each hole that has the form; all are about one kind of thing where only its name is said."""
    kind: Literal["place", "object"] = "place" if generator.random() < 0.65 else "object"
    bare = any(hole.form == "it" for hole in pattern.holes)
    chosen: dict[int, Leaf] = {}
    for hole in pattern.holes:
        if hole.leaf in chosen:
            continue  # its second piece
        fitting: Sequence[Leaf] = _said_as(hole.form)
        if bare or generator.random() < 0.5:
            fitting = [leaf for leaf in fitting if leaf.target == kind] or fitting
        chosen[hole.leaf] = generator.choice(fitting)
    return chosen


@cache
def _said_as(form: Form) -> Sequence[Leaf]:
    """The clauses that have a form."""
    return [leaf for leaf in leaves() if form == "it" or form in leaf.forms or form in leaf.pieces]


@cache
def _kinds() -> Mapping[str, Sequence[str]]:
    """The kinds of things that a word names by itself."""
    found: dict[str, list[str]] = {}
    for kind in (*PLACE_KINDS, "object", "container"):
        for phrase in names().seen[kind]:
            if len(phrase) == 1:
                found.setdefault(phrase[0], []).append(kind)
    return found


@cache
def _times() -> Mapping[str, int]:
    """How often each shape is drawn in an epoch: more often those that people have more ways to say, for want of a
    better measure of how common they are. Equal shares would take a rare shape for as likely as a common one.
    """
    ways = {shape: len(group) ** 0.5 for shape, group in patterns().items()}
    mean = sum(ways.values()) / len(ways)
    own = {shape: round(EACH * way / mean) for shape, way in ways.items()}
    return own | {shape: FOLLOWING for shape in nestings() if shape not in own}


def _framing() -> tuple[Sequence[str], Sequence[str], Sequence[str]]:
    """Calls, requests and closings with one place for a command."""
    found = frames("training")
    return tuple([f for f in kind if f.count("{}") == 1] for kind in (found.calls, found.requests, found.closings))  # type: ignore[return-value]

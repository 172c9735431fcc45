"""The texts of an epoch, drawn anew each time: commands of T and their like, and texts that no task fits.

Half of the commands are those of T (paper, Table I), half say the same in other words. Of both, most name other things
than T does, some are framed ("robot, please ..."), and some have a slip of the pen. So nothing but the wordings can be
learned by heart. U and the held-out parts of the lists are never drawn.
"""

from __future__ import annotations

import random
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

from spacy.lang.en.stop_words import STOP_WORDS

from models.language.dataset import (
    Domain,
    Example,
    by_task,
    fill,
    framed,
    frames,
    misspell,
    no_task,
    paraphrases,
    read_corpus,
    redetermined,
    split,
)
from models.language.dataset.composition import Leaf, leaves, slot_elements
from models.language.spans.items import Item
from models.language.spans.names import Names, Phrase, names
from models.language.spans.references import PLACES, refer
from models.language.spans.tags import Span
from models.language.tokens import words
from models.language.translation import NEGATIONS

COMMANDS, REFUSALS = 500, 2600
"""Texts of each task class and of none in an epoch; T has 23 of navigate_one and 458 of navigate_three."""
OTHER_JOBS = 400
"""Clauses in an epoch that are none of the task classes: "mop the floor"."""
CLAUSES = 0.35
"""Part of the commands of some classes that are clauses in any grammatical form."""
CLAUSE_SLOTS = {
    "place": "location",
    "object": "object",
    "object2": "object",
    "container": "container",
    "color": "color",
}
NAMED = 0.2
"""Part of the clauses about going that only name the place."""
PRONOUN = 0.1
PRONOUNS = {"place": ("there", "there", "it"), "object": ("it", "it", "it", "them", "one")}
DETERMINERS = ("the",) * 12 + ("my", "a", "that", "", "", "")
"""What stands before a name in a clause."""
REFERRED = 0.12
"""Part of the drawn names that are put into a phrase: "any red toy", "the cup in the kitchen"."""
RENAMED = 0.7
"""Part of T's commands that are drawn with other things in them."""
FRAMED = 0.4
"""Part of the commands drawn in a polite frame."""
REDETERMINED = 0.15
"""Part of the commands that say "my", "that", "a" or nothing for "the"."""
MISSPELLED = 0.15
"""Part of the texts with one slip, two of three in the name of a thing."""


@dataclass(frozen=True, slots=True)
class Lessons:
    """What texts are drawn from.

    Attributes:
        training: T's commands for fitting, by task class.
        validation: T's commands that are only looked at.
        refused, held_out: texts that no task fits, for fitting and for looking at.
        classes: the task classes with their argument slots, in order.
        words: see `spoken_words`.
    """

    training: Mapping[str, Sequence[Example]]
    validation: Sequence[Example]
    refused: Sequence[Item]
    held_out: Sequence[Item]
    classes: Mapping[str, tuple[Domain, tuple[str, ...]]]
    names: Names
    words: tuple[str, ...] = ()

    @classmethod
    def load(cls, *, seed: int) -> Lessons:
        """T as it is drawn with a seed, of both domains."""
        splits = [split(domain, seed=seed) for domain in Domain]
        refused = no_task(seed=seed)
        lessons = cls(
            training=by_task(example for part in splits for example in part.training),
            validation=[example for part in splits for example in part.validation],
            refused=[Item(spoken) for text in refused.training if (spoken := words(text)) and not _names_only(spoken)],
            held_out=[Item(spoken) for text in refused.held_out if (spoken := words(text))],
            classes={task.name: (domain, task.arguments) for domain in Domain for task in read_corpus(domain).tasks},
            names=names(),
        )
        spoken = spoken_words(lessons)
        content = [word for word in spoken if word not in STOP_WORDS and word not in NEGATIONS]
        return replace(lessons, names=replace(lessons.names, spoken=content), words=spoken)

    @property
    def tasks(self) -> tuple[tuple[str, int], ...]:
        """The task classes with their numbers of arguments."""
        return tuple((task, len(slots)) for task, (_, slots) in self.classes.items())

    def epoch(self, generator: random.Random) -> list[Item]:
        """Texts for one pass: COMMANDS of each task class, and REFUSALS that no task fits."""
        items = [self.command(task, generator) for task in self.classes for _ in range(COMMANDS)]
        items += generator.choices(self.refused, k=REFUSALS)
        items += [self.other_job(generator) for _ in range(OTHER_JOBS)]
        return [misspelled(item, generator) if generator.random() < MISSPELLED else item for item in items]

    def command(self, task: str, generator: random.Random) -> Item:
        """A command of a task class."""
        known = _clauses(task)
        if known and generator.random() < CLAUSES:
            if task == "navigate_one" and generator.random() < NAMED:
                return self._named(generator)
            return self._clause(generator.choice(known), task, generator)
        if generator.random() < 0.5:
            example = generator.choice(self.training[task])
            rename = generator.random() < RENAMED
        else:
            example, rename = self._paraphrase(task, generator), True
        if generator.random() < REDETERMINED:
            example = redetermined(example, generator, part="training")
        item = Item.command(example)
        if generator.random() < FRAMED:
            item = Item.command(framed(example, generator, part="training")).around(item)
        return self.renamed(item, generator) if rename else item

    def renamed(self, item: Item, generator: random.Random) -> Item:
        """The same command of other things."""
        assert item.task is not None
        apart = not any(end == begin for _, end in item.mentions[-1] for begin, _ in item.mentions[0])
        slots = self.classes[item.task][1]
        phrases = [self.names.draw(slot, generator, apart=apart) for slot in slots]
        if "color" in slots or generator.random() > REFERRED:
            return item.renamed(phrases)
        place = generator.randrange(len(slots))
        phrases[place], article = self.refer(phrases[place], slots[place], len(slots) > 1, generator)
        return item.renamed(phrases, alone=frozenset() if article else frozenset({place}))

    def refer(self, name: Phrase, slot: str, more: bool, generator: random.Random) -> tuple[Phrase, bool]:
        """A phrase that refers to what has a name by more than it, and whether a determiner may stand in front.

        Where `more` is said than one thing, where it is might be where it is to go.
        """
        kind = "place" if slot in PLACES else "target" if more else "thing"
        return refer(name, kind, self.names, generator)

    def other_job(self, generator: random.Random) -> Item:
        """A clause that is none of the task classes."""
        return self._clause(generator.choice(_clauses(None)), None, generator)

    def _clause(self, leaf: Leaf, task: str | None, generator: random.Random) -> Item:
        """A clause in one of its forms, as it stands within a longer command: "been to the zoo" """
        text: list[str] = []
        mentions: dict[str, Span] = {}
        form = generator.choice(list(leaf.forms.values())) if generator.random() < 0.6 else leaf.do
        previous = ""
        for element in slot_elements(form):
            if isinstance(element, str):
                text.append(element)
                continue
            (slot,) = element
            pronoun = PRONOUNS.get(slot)
            if pronoun is not None and task != "pickup_colored" and generator.random() < PRONOUN:
                if slot == "place" and text and text[-1] in ("to", "at", "in"):
                    text.pop()
                mentions[slot] = (len(text), len(text) + 1)
                text.append(generator.choice(pronoun))
                continue
            kind = generator.choice(["object", "container"]) if task == "move_to" else CLAUSE_SLOTS[slot]
            name, article = self.names.draw(kind, generator), previous != "color"
            if slot != "color" and "color" not in leaf.slots and generator.random() < REFERRED:
                name, article = self.refer(name, kind, len(leaf.slots) > 1, generator)
            if article:
                text += [word for word in (generator.choice(DETERMINERS),) if word]
            mentions[slot] = (len(text), len(text) + len(name))
            text += name
            previous = slot
        if task is None:
            return Item(tuple(text))
        order = ("object", "color") if task == "pickup_colored" else leaf.slots
        item = Item(tuple(text), task, tuple((mentions[slot],) for slot in order))
        if form == leaf.do and generator.random() < FRAMED:
            before, _, after = generator.choice(frames("training").requests).partition("{}")
            item = item.within(words(before), words(after))
        return item

    def _named(self, generator: random.Random) -> Item:
        """A place alone, to be gone to: "the bakery, please"."""
        name = self.names.draw("location", generator)
        before = generator.choice([(), (), ("the",), ("the",), ("to", "the"), ("off", "to", "the")])
        if generator.random() < REFERRED:
            name, article = self.refer(name, "location", False, generator)
            before = before if article else before[:-1]
        after = generator.choice([(), (), (), ("please",), ("now",), ("quick",)])
        text = (*before, *name, *after)
        return Item(text, "navigate_one", (((len(before), len(before) + len(name)),),))

    def checks(self, generator: random.Random) -> list[Item]:
        """What a network is judged by between epochs: commands that it was not fitted to, as they are, of other things,
        and with a slip; and texts that no task fits.
        """
        commands = [Item.command(example) for example in self.validation]
        renamed = [self.renamed(item, generator) for item in commands]
        return [*commands, *renamed, *(misspelled(item, generator) for item in renamed), *self.held_out]

    def _paraphrase(self, task: str, generator: random.Random) -> Example:
        """A wording beyond those of T, filled with whatever; its arguments are renamed later."""
        domain, slots = self.classes[task]
        wording = generator.choice(paraphrases(domain, "training")[task])
        return fill(domain, task, wording, {slot: f"thing{number}" for number, slot in enumerate(slots)})


def _names_only(spoken: Sequence[str]) -> bool:
    """Whether a text is no more than a name: "the museum", which may be where to go."""
    return len(spoken) <= 4 and spoken[0] in ("the", "a", "an", "my", "to")


def _clauses(task: str | None) -> list[Leaf]:
    """The clauses that say a task class; what says `navigate_one` of a place says `move_to` of a thing."""
    return [leaf for leaf in leaves() if leaf.task == ("navigate_one" if task == "move_to" else task)]


def misspelled(item: Item, generator: random.Random) -> Item:
    """The item with one slip in a word of three letters or more, if it has one."""
    places = [place for place, word in enumerate(item.text) if len(word) >= 3]
    named = [place for place in places if place in item.mentioned]
    if named and generator.random() < 2 / 3:
        places = named
    if not places:
        return item
    place = generator.choice(places)
    return item.respelled(place, misspell(item.text[place], generator))


def spoken_words(lessons: Lessons) -> tuple[str, ...]:
    """The words that say what to do and not with what, sorted: every word of a wording or frame beside its names, and
    what is said more than once in texts that no task fits, but for names of things.
    """
    generator = random.Random(0)
    commands = [Item.command(example) for group in lessons.training.values() for example in group]
    for task, (domain, slots) in lessons.classes.items():
        for wording in paraphrases(domain, "training")[task]:
            example = fill(domain, task, wording, dict.fromkeys(slots, "thing"))
            commands += [Item.command(framed(example, generator, part="training")) for _ in range(20)]
    kept = {word for item in commands for place, word in enumerate(item.text) if place not in item.mentioned}
    counts = Counter(word for item in lessons.refused for word in item.text)
    said = {word for word, count in counts.items() if count > 1}
    return tuple(sorted(kept | (said - lessons.names.words)))

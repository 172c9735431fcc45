"""The same commands said otherwise, to see what an answer depends on."""

from __future__ import annotations

import random
from collections.abc import Iterator
from dataclasses import replace
from functools import partial

from models.language.dataset import (
    Domain,
    Example,
    Half,
    Part,
    fill,
    framed,
    paraphrases,
    read_corpus,
    redetermined,
    with_typo,
)
from models.language.experiments.commands import CommandSet

TYPO = "one typo"
CASE = "case and punctuation"
FRAMES = "polite frames"
DETERMINERS = "other determiners"
PARAPHRASES = "paraphrases"
WAYS = (TYPO, CASE, FRAMES, DETERMINERS, PARAPHRASES)
"""The ways in which S and U are said again."""

_MARKS = ("", ".", "!", "?", "...", " .", "?!")


def variants(commands: CommandSet, *, seed: int) -> Iterator[CommandSet]:
    """The set said with a typo in an argument, in other case and punctuation, in held-out frames and determiners."""
    for name, change in _CHANGES.items():
        generator = random.Random(f"{name}/{commands.name}/{commands.domain}/{seed}")
        yield commands.changed(name, partial(change, generator=generator))


def shouted(example: Example, generator: random.Random) -> Example:
    """The example in random upper and lower case, with other punctuation at its end and between its words."""
    text = example.text
    cased = generator.choice((text.upper(), text.lower(), text.title(), _mixed(text, generator)))
    bare = cased.rstrip(" .!?")
    if generator.random() < 0.5:
        bare = bare.replace(",", generator.choice(["", ";", " ,", " -"]))
    return replace(example, text=bare + generator.choice(_MARKS))


def paraphrased(commands: CommandSet, part: Part, *, seed: int, most: int) -> CommandSet:
    """Held-out wordings of the domain's task classes, with phrases of a vocabulary: `most` commands of each."""
    generator = random.Random(f"{PARAPHRASES}/{part}/{commands.domain}/{seed}")
    examples = list(_paraphrases(commands.domain, part, generator, most))
    return CommandSet.of(commands.name, examples, commands.environment, said=PARAPHRASES)


def _paraphrases(domain: Domain, part: Part, generator: random.Random, most: int) -> Iterator[Example]:
    corpus = read_corpus(domain)
    for task, wordings in paraphrases(domain, Half.HELD_OUT).items():
        slots = corpus.task(task).arguments
        for number in range(most):
            phrases = {slot: generator.choice(corpus.vocabulary[part][slot]) for slot in slots}
            yield fill(domain, task, wordings[number % len(wordings)], phrases)


def _framed(example: Example, generator: random.Random) -> Example:
    return framed(example, generator, part=Half.HELD_OUT)


def _redetermined(example: Example, generator: random.Random) -> Example:
    return redetermined(example, generator, part=Half.HELD_OUT)


def _mixed(text: str, generator: random.Random) -> str:
    return "".join(generator.choice((letter.upper(), letter.lower())) for letter in text)


_CHANGES = {TYPO: with_typo, CASE: shouted, FRAMES: _framed, DETERMINERS: _redetermined}

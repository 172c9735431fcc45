"""Commands said otherwise: what changes, and what does not."""

from __future__ import annotations

import random

import pytest

from models.language.dataset import Domain, Half, Part, paraphrases
from models.language.experiments.commands import paper_sets
from models.language.experiments.variants import CASE, PARAPHRASES, TYPO, WAYS, paraphrased, shouted, variants
from models.language.tokens import words

SEEN, UNSEEN = (commands.thinned(30) for commands in paper_sets(Domain.MANIPULATION))


def test_every_way_keeps_the_meaning() -> None:
    found = {commands.said: commands for commands in variants(UNSEEN, seed=0)}
    assert (*found, PARAPHRASES) == WAYS
    for commands in found.values():
        assert commands.name == "U"
        assert commands.expected == UNSEEN.expected
        assert [e.query for e in commands.examples] == [e.query for e in UNSEEN.examples]
        differ = sum(one != other for one, other in zip(commands.texts, UNSEEN.texts, strict=True))
        assert differ > 0.9 * len(UNSEEN.texts)


def test_the_same_seed_says_the_same() -> None:
    def texts(seed: int) -> list[tuple[str, ...]]:
        return [commands.texts for commands in variants(UNSEEN, seed=seed)]

    assert texts(0) == texts(0)
    assert all(one != other for one, other in zip(texts(0), texts(1), strict=True))


def test_case_and_punctuation_leave_the_words() -> None:
    commands = next(c for c in variants(SEEN, seed=0) if c.said == CASE)
    assert [words(text) for text in commands.texts] == [words(text) for text in SEEN.texts]
    assert len({text[-1] for text in commands.texts} & set(".!?")) == 3
    assert any(text.isupper() for text in commands.texts)


def test_a_typo_changes_one_word() -> None:
    commands = next(c for c in variants(SEEN, seed=0) if c.said == TYPO)
    for before, after in zip(SEEN.texts, commands.texts, strict=True):
        pairs = list(zip(words(before), words(after), strict=True))
        assert sum(one != other for one, other in pairs) == 1


def test_shouting_is_of_many_kinds() -> None:
    example = next(e for e in SEEN.examples if "," in e.text)
    texts = {shouted(example, random.Random(seed)).text for seed in range(60)}
    assert len(texts) > 20
    assert {words(text) for text in texts} == {words(example.text)}


@pytest.mark.parametrize("part", Part)
def test_paraphrases_are_held_out_wordings_of_the_vocabulary(part: Part) -> None:
    commands = paraphrased(SEEN if part is Part.SEEN else UNSEEN, part, seed=0, most=12)
    held_out = paraphrases(Domain.MANIPULATION, Half.HELD_OUT)
    assert len(commands.examples) == 12 * len(held_out)
    assert (commands.said, commands.name) == (PARAPHRASES, "S" if part is Part.SEEN else "U")
    for task, wordings in held_out.items():
        begun = {wording.split("{")[0] for wording in wordings}
        texts = [example.text for example in commands.examples if example.task == task]
        assert all(any(text.startswith(start) for start in begun) for text in texts)
        assert len(texts) == 12

"""Typing mistakes, against a distance computed independently."""

from __future__ import annotations

import random
from functools import cache

import pytest
from hypothesis import given
from hypothesis import strategies as st

from models.language import VocabularyError
from models.language.dataset import Domain, Example, fill, generate, misspell, with_typo
from models.language.dataset.typos import NEIGHBOURS
from models.language.tokens import words

EXAMPLES = [e for d in Domain for e in (*generate(d).seen[::89], *generate(d).unseen[::29])]


def _distance(left: str, right: str) -> int:
    """Damerau-Levenshtein (optimal string alignment), by its recursive definition."""

    @cache
    def between(i: int, j: int) -> int:
        if not i or not j:
            return i + j
        costs = [between(i - 1, j) + 1, between(i, j - 1) + 1, between(i - 1, j - 1) + (left[i - 1] != right[j - 1])]
        if i > 1 and j > 1 and left[i - 2 : i] == right[j - 2 : j][::-1]:
            costs.append(between(i - 2, j - 2) + 1)
        return min(costs)

    return between(len(left), len(right))


@given(st.from_regex(r"[a-z][a-z'-]{2,11}", fullmatch=True), st.randoms(use_true_random=False))
def test_one_mistake(word: str, generator: random.Random) -> None:
    wrong = misspell(word, generator)
    assert wrong[0] == word[0]
    if sum(letter.isalpha() for letter in word) >= 3:
        assert _distance(word, wrong) == 1
        assert [c for c in wrong if not c.isalpha()] == [c for c in word if not c.isalpha()]
    else:
        assert wrong == word


def test_every_kind_of_mistake() -> None:
    generator = random.Random(0)
    seen = {misspell("Mug", generator) for _ in range(2000)}
    assert {"mg", "mu", "mgu", "muug", "mjug", "mig", "mub"} <= seen
    assert "mpg" not in seen  # p is not beside u


@pytest.mark.parametrize("word", ["", "a", "of", "42", "100", "3-d", "né", "éééé"])
def test_left_as_it_is(word: str) -> None:
    assert all(misspell(word, random.Random(seed)) == word for seed in range(20))


def test_keys() -> None:
    assert len(NEIGHBOURS) == 26
    assert all(key not in beside and set(beside) <= set(NEIGHBOURS) for key, beside in NEIGHBOURS.items())
    assert all(key in NEIGHBOURS[other] for key, beside in NEIGHBOURS.items() for other in beside)


@given(st.sampled_from(EXAMPLES), st.randoms(use_true_random=False))
def test_one_word_of_one_mention(example: Example, generator: random.Random) -> None:
    other = with_typo(example, generator)
    assert (other.query, other.mentions, other.grounding) == (example.query, example.mentions, example.grounding)
    before, after = words(example.text), words(other.text)
    [place] = [index for index, pair in enumerate(zip(before, after, strict=True)) if pair[0] != pair[1]]
    assert any(start <= place < end for spans in example.mentions for start, end in spans)
    assert _distance(before[place], after[place]) == 1


def test_any_argument_and_word_may_be_misspelt() -> None:
    chosen = {"object": "ox of wood", "container": "box", "location": "big front porch"}
    example = fill("manipulation", "ship", "Put the {object} in the {container}, {container} in the {location}", chosen)
    generator = random.Random(0)
    changed = set()
    for _ in range(500):
        pairs = zip(words(example.text), words(with_typo(example, generator).text), strict=True)
        changed |= {index for index, (before, after) in enumerate(pairs) if before != after}
    assert changed == {4, 7, 8, 11, 12, 13}


def test_nothing_to_misspell() -> None:
    example = fill("manipulation", "move_to", "Approach the {object}", {"object": "ox"})
    with pytest.raises(VocabularyError, match="ox"):
        with_typo(example, random.Random(0))

"""The open words: enough of them, none of the datasets, and nothing that both parts share."""

from __future__ import annotations

import pytest

from models.language.dataset import Domain, Half, OpenWords, Part, open_words, read_corpus
from models.language.tokens import words

PARTS = {half: open_words(half) for half in Half}
LISTS = ("objects", "colors", "containers", "places")


def _content(names: tuple[str, ...]) -> set[str]:
    return {word for name in names for word in name.replace("-", " ").split()} - {"of"}


def _all(part: OpenWords) -> set[str]:
    return {word for key in LISTS for word in _content(getattr(part, key))}


@pytest.mark.parametrize(("key", "least"), [("objects", 1500), ("containers", 100), ("places", 500), ("colors", 150)])
def test_sizes(key: str, least: int) -> None:
    counts = {half: len(getattr(part, key)) for half, part in PARTS.items()}
    assert sum(counts.values()) >= least
    assert 0.55 <= counts[Half.TRAINING] / sum(counts.values()) <= 0.65


def test_many_names_have_several_words() -> None:
    objects = [name for part in PARTS.values() for name in part.objects]
    assert sum(" " in name for name in objects) >= len(objects) / 3


def test_the_parts_share_no_word() -> None:
    assert not _all(PARTS[Half.TRAINING]) & _all(PARTS[Half.HELD_OUT])


def test_colors_share_no_word_with_things() -> None:
    for part in PARTS.values():
        colors = _content(part.colors)
        assert not colors & {word for key in LISTS if key != "colors" for word in _content(getattr(part, key))}


def test_no_word_of_the_datasets() -> None:
    corpora = [read_corpus(domain) for domain in Domain]
    phrases = [w.phrase for c in corpora for part in Part for entries in c.vocabulary[part].values() for w in entries]
    wordings = [
        wording.replace("{", " x").replace("}", " ") for c in corpora for t in c.tasks for wording in t.wordings
    ]
    spoken = {word for text in (*phrases, *wordings) for word in words(text)}
    for part in PARTS.values():
        assert not spoken & _all(part)


def test_names() -> None:
    for part in PARTS.values():
        entries = [name for key in LISTS for name in getattr(part, key)]
        assert all(" ".join(words(name)) == name for name in entries)
        assert all(len(name.split()) <= 4 for name in entries)
        symbols = [name.replace("-", " ") for name in entries]
        assert len(set(symbols)) == len(symbols)
        assert all(list(getattr(part, key)) == sorted(getattr(part, key)) for key in LISTS)


def test_words_that_people_know() -> None:
    training, held_out = PARTS[Half.TRAINING], PARTS[Half.HELD_OUT]
    objects, places = {*training.objects, *held_out.objects}, {*training.places, *held_out.places}
    assert {"umbrella", "screwdriver", "alarm clock", "wedding cake", "bowl of soup"} <= objects
    assert {"garage", "factory", "waterfall", "parking lot", "log cabin"} <= places
    assert "jar" in {*training.containers, *held_out.containers}
    assert {"teal", "beige"} <= set(training.colors)
    assert {"cyan", "khaki"} <= set(held_out.colors)


def test_parts_by_name() -> None:
    assert open_words("training") is PARTS[Half.TRAINING]
    with pytest.raises(ValueError, match="unseen"):
        open_words("unseen")

"""The reader of the datasets' data files, and what the built-in files hold."""

from __future__ import annotations

from typing import Any

import pytest
import yaml

from models.language import VocabularyError
from models.language.dataset import Domain, Part, parse_corpus, read_corpus


def _data() -> dict[str, Any]:
    return {
        "domain": "manipulation",
        "training": 2,
        "vocabulary": {
            "seen": {"object": ["ball", {"phrase": "bag", "symbol": "bag_toy"}, "teddy bear"], "color": ["red"]},
            "unseen": {"object": ["mug"], "color": ["black"]},
        },
        "tasks": {
            "paint": {
                "arguments": ["object", "color"],
                "ltl": "F c({object}, {color})",
                "wordings": ["{color} {object}"],
            }
        },
    }


def _parse(data: object) -> str:
    """The places of the refusal."""
    with pytest.raises(VocabularyError) as caught:
        parse_corpus(yaml.safe_dump(data))
    assert caught.value.slug == "invalid-vocabulary"
    return " ".join(place.pointer for place in caught.value.places)


def test_read() -> None:
    corpus = parse_corpus(yaml.safe_dump(_data()))
    words = corpus.vocabulary[Part.SEEN]["object"]
    assert [(word.phrase, word.symbol) for word in words] == [
        ("ball", "ball"),
        ("bag", "bag_toy"),
        ("teddy bear", "teddy_bear"),
    ]
    assert corpus.tasks[0].arguments == ("object", "color")
    assert corpus.domain is Domain.MANIPULATION


@pytest.mark.parametrize(
    ("path", "value", "pointer"),
    [
        (["domain"], "cooking", ""),
        (["training"], 0, "/training"),
        (["training"], "many", "/training"),
        (["extra"], 1, "/extra"),
        (["vocabulary", "seen", "object"], ["ball", "ball"], "/vocabulary/seen/object"),
        (["vocabulary", "seen", "object"], ["Ball"], "/vocabulary/seen/object/0"),
        (["vocabulary", "seen", "object"], ["ball!"], "/vocabulary/seen/object/0"),
        (["vocabulary", "seen", "object"], [], "/vocabulary/seen/object"),
        (["vocabulary", "unseen", "object"], ["ball"], "/vocabulary/unseen"),
        (["vocabulary", "unseen", "object"], ["polar bear"], "/vocabulary/unseen"),  # a word of teddy bear
        (["vocabulary", "unseen", "color"], ["teddy"], "/vocabulary/unseen"),  # in another list
        (["vocabulary", "other"], {}, ""),
        (["tasks", "paint", "arguments"], [], "/tasks/paint/arguments"),
        (["tasks", "paint", "arguments"], ["object", "size"], "/tasks/paint/arguments"),
        (["tasks", "paint", "wordings"], ["the {color} one"], "/tasks/paint/wordings/0"),
        (["tasks", "paint", "wordings"], ["{color} {object} {size}"], "/tasks/paint/wordings/0"),
        (["tasks", "paint", "wordings"], ["{color {object}"], "/tasks/paint/wordings/0"),
        (["tasks", "paint", "ltl"], "F c({object})", "/tasks/paint/ltl"),
        (["tasks"], {}, "/tasks"),
    ],
)
def test_refused(path: list[str], value: object, pointer: str) -> None:
    data = _data()
    place = data
    for key in path[:-1]:
        place = place[key]
    place[path[-1]] = value
    assert pointer in _parse(data).split() or (pointer == "" and _parse(data) == "")


@pytest.mark.parametrize("text", ["", "[1, 2]", "a: [", "just words", "domain: manipulation"])
def test_not_a_data_file(text: str) -> None:
    with pytest.raises(VocabularyError):
        parse_corpus(text)


def _phrases(part: Part) -> set[str]:
    lists = [read_corpus(domain).vocabulary[part] for domain in Domain]
    return {word.phrase for slots in lists for entries in slots.values() for word in entries}


def test_the_two_domains_together_keep_the_unseen_words_unseen() -> None:
    seen, unseen = ({word for phrase in _phrases(part) for word in phrase.split()} for part in (Part.SEEN, Part.UNSEEN))
    wordings = {
        word.lower() for d in Domain for task in read_corpus(d).tasks for w in task.wordings for word in w.split()
    }
    assert not seen & unseen
    assert not wordings & unseen


def test_what_the_seen_vocabulary_must_hold() -> None:
    assert {"cylinder", "sphere", "box", "bedroom"} <= _phrases(Part.SEEN)
    seen = read_corpus(Domain.MANIPULATION).vocabulary[Part.SEEN]
    phrases = {slot: {word.phrase for word in entries} for slot, entries in seen.items()}
    assert "orange" in phrases["object"] & phrases["color"]
    assert "bag" in phrases["object"] & phrases["container"]
    homonyms = [word for a, b in (("object", "color"), ("object", "container")) for word in phrases[a] & phrases[b]]
    assert homonyms == ["orange", "bag"]

"""Further wordings: enough of each class, none of S, none said of two classes; and a reader that refuses the wrong."""

from __future__ import annotations

from collections import Counter

import pytest
import yaml

from models.language import VocabularyError
from models.language.dataset import Domain, Half, Part, fill, paraphrases, read_corpus
from models.language.dataset.paraphrases import parse_paraphrases
from models.language.tokens import words
from models.language.translation import NEGATIONS

ALL = [(domain, task.name) for domain in Domain for task in read_corpus(domain).tasks]


def _spoken(domain: Domain, task: str, wording: str) -> tuple[str, ...]:
    """The words of a wording, with the same sign for any argument of a class that has one."""
    arguments = read_corpus(domain).task(task).arguments
    signs = {slot: "x" if len(arguments) == 1 else f"x-{slot}" for slot in arguments}
    return words(fill(domain, task, wording, signs).text)


def _both(domain: Domain, task: str) -> tuple[str, ...]:
    return tuple(wording for part in Half for wording in paraphrases(domain, part)[task])


@pytest.mark.parametrize(("domain", "task"), ALL)
def test_sizes(domain: Domain, task: str) -> None:
    held_out, training = (len(paraphrases(domain, part)[task]) for part in (Half.HELD_OUT, Half.TRAINING))
    assert training >= 30
    assert held_out == (training + held_out) // 5


def test_no_wording_is_said_twice() -> None:
    """In no other class, not in the other part, and not in S."""
    said = Counter(
        _spoken(domain, task, wording)
        for domain, task in ALL
        for wording in (*_both(domain, task), *read_corpus(domain).task(task).wordings)
    )
    assert [" ".join(spoken) for spoken, count in said.items() if count > 1] == []


def test_words() -> None:
    """No word of the vocabularies, which would be taken for an argument, and no negation."""
    lists = [entries for d in Domain for p in Part for entries in read_corpus(d).vocabulary[p].values()]
    vocabulary = {word for entries in lists for entry in entries for word in words(entry.phrase)}
    said = {word for domain, task in ALL for w in _both(domain, task) for word in _spoken(domain, task, w)}
    assert not said & (vocabulary | NEGATIONS)


def test_parts_by_name() -> None:
    assert paraphrases("navigation", "held_out") is paraphrases(Domain.NAVIGATION, Half.HELD_OUT)
    with pytest.raises(ValueError, match="seen"):
        paraphrases("navigation", "seen")


def _data() -> dict[str, dict[str, list[str]]]:
    return {str(domain): {t.name: list(t.wordings) for t in read_corpus(domain).tasks} for domain in Domain}


def test_read() -> None:
    assert parse_paraphrases(yaml.safe_dump(_data()))[Domain.NAVIGATION]["navigate_one"][0] == "Go to the {first}"


@pytest.mark.parametrize(
    ("path", "value", "pointer"),
    [
        (["manipulation", "pickup"], ["Lift the {color} {object}"], "/manipulation/pickup/0"),
        (["manipulation", "pickup_colored"], ["Lift it", "Lift the {object}"], "/manipulation/pickup_colored/0"),
        (["manipulation", "paint"], ["Paint the {object}"], "/manipulation"),
        (["navigation"], {}, "/navigation"),
        (["cooking"], {}, "/cooking/[key]"),
        (["navigation", "navigate_one"], "Go to the {first}", "/navigation/navigate_one"),
    ],
)
def test_refused(path: list[str], value: object, pointer: str) -> None:
    data: dict[str, object] = dict(_data())
    place = data
    for key in path[:-1]:
        place = place[key]  # type: ignore[assignment]
    place[path[-1]] = value
    with pytest.raises(VocabularyError) as caught:
        parse_paraphrases(yaml.safe_dump(data))
    assert caught.value.places[0].pointer == pointer


def test_a_domain_is_missing() -> None:
    with pytest.raises(VocabularyError, match="manipulation is missing"):
        parse_paraphrases(yaml.safe_dump({"navigation": _data()["navigation"]}))

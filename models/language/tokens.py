"""Text to words: the tokeniser that training and translation share.

Case is folded to lower case and punctuation is dropped, so neither changes a translation. A hyphen, an apostrophe, a
dot or an ampersand inside a word stays: `yo-yo`, `o'hare`, `h&m`. A slash between words parts them: `kitchen/hall`.
"""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache

from models.errors import Place
from models.language.errors import TextTooLongError

MAX_CHARACTERS = 2_000
"""Longest text of a command, in characters."""
MAX_WORDS = 200
"""Longest text of a command, in words; the longest of the published human commands has about 75."""

_RUN = re.compile(r"""[^\s,;:!?"“”„«»()\[\]{}<>…—–¡¿]+""")
_BETWEEN = re.compile(r"(?<=[^\W\d_]{3})[/|+](?=[^\W\d_]{3})")
"""A sign between two words that are written as one: `kitchen/hall`; not `w/o`."""
_MARK = re.compile(r"[,;:.!?]|<-+>|↔|[-=]*>+|→|[+&]|[/|]")
_PUNCTUATION = re.compile(r"[,;:.!?]")
_SIGNS = {"↔": "<->", "→": "->", "&": "+", "|": "/"}
_DROPPED = frozenset({"Cc", "Cf", "Cs", "Co", "Cn", "Zl", "Zp"})


@dataclass(frozen=True, slots=True)
class Token:
    """One word: its folded text, and where it stands, `text[start:end]` of the original."""

    text: str
    start: int
    end: int


def tokenize(text: str) -> tuple[Token, ...]:
    """The words of a text, left to right.

    Raises:
        TextTooLongError: more than `MAX_CHARACTERS` characters or `MAX_WORDS` words.
    """
    check_length(text)
    tokens = tuple(token for run in _RUN.finditer(_parted(visible(text))) if (token := _token(run)) is not None)
    if len(tokens) > MAX_WORDS:
        raise _too_long(f"a command has at most {MAX_WORDS} words, not {len(tokens)}")
    return tokens


def words(text: str) -> tuple[str, ...]:
    """The folded words of a text; raises as `tokenize` does."""
    return tuple(token.text for token in tokenize(text))


def marked_words(text: str) -> tuple[str, ...]:
    """The folded words of a text and between them the marks `, ; : . ! ?` and the signs that stand for words: `->`
    (arrows), `<->`, `+` (`&` too) and `/` (`|` too). Raises as `tokenize` does.
    """
    tokens = tokenize(text)
    inside = {place for token in tokens for place in range(token.start, token.end)}
    marks = [Token(_sign(m[0]), m.start(), m.end()) for m in _MARK.finditer(text) if m.start() not in inside]
    return tuple(token.text for token in sorted([*tokens, *marks], key=lambda token: token.start))


def is_mark(word: str) -> bool:
    """Whether it is one of the marks of `marked_words`."""
    return _MARK.fullmatch(word) is not None


def is_punctuation(word: str) -> bool:
    """Whether it is a mark that says nothing by itself: none of the signs that stand for words."""
    return _PUNCTUATION.fullmatch(word) is not None


def find(phrase: Sequence[str], text: Sequence[str]) -> int | None:
    """Where the words of a phrase first stand together among the words of a text; None when they do not."""
    if not phrase:
        return None
    starts = range(len(text) - len(phrase) + 1)
    return next((start for start in starts if tuple(text[start : start + len(phrase)]) == tuple(phrase)), None)


def check_length(text: str) -> None:
    """Raises `TextTooLongError` when the text has more than `MAX_CHARACTERS` characters."""
    if len(text) > MAX_CHARACTERS:
        raise _too_long(f"a command has at most {MAX_CHARACTERS} characters, not {len(text)}")


def visible(text: str) -> str:
    """The text with control, format, private and surrogate characters blanked, each by one space."""
    if text.isprintable():
        return text
    return "".join(" " if unicodedata.category(character) in _DROPPED else character for character in text)


def _parted(text: str) -> str:
    """The text with signs between words blanked; addresses such as `example.com/index` are left as they are."""
    if not _BETWEEN.search(text):
        return text
    return _RUN.sub(lambda run: run[0] if "." in run[0][:-1] else _BETWEEN.sub(" ", run[0]), text)


def _sign(mark: str) -> str:
    """The mark, spelled in one way."""
    return "<->" if mark.startswith("<") else "->" if mark.endswith(">") else _SIGNS.get(mark, mark)


def _token(run: re.Match[str]) -> Token | None:
    text, before, after = _folded(run.group())
    start, end = run.span()
    return Token(text, start + before, end - after) if text else None


@lru_cache(maxsize=4096)
def _folded(raw: str) -> tuple[str, int, int]:
    """A word without the punctuation around it, and how many characters of that are before and after it."""
    start, end = 0, len(raw)
    while start < end and _is_punctuation(raw[start]):
        start += 1
    while start < end and _is_punctuation(raw[end - 1]):
        end -= 1
    return unicodedata.normalize("NFC", raw[start:end]).lower(), start, len(raw) - end


def _is_punctuation(character: str) -> bool:
    return unicodedata.category(character).startswith("P") or character in "`´^~=+|$<>→↔"


def _too_long(detail: str) -> TextTooLongError:
    return TextTooLongError(detail, places=[Place("", detail)])

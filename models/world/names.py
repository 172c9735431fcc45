"""Names as people write them: normal forms, near misses, quoting."""

from __future__ import annotations

import json
import re
import unicodedata
from collections.abc import Iterable
from difflib import SequenceMatcher
from functools import lru_cache
from itertools import islice

IDENTIFIER = re.compile(r"[A-Za-z_][A-Za-z0-9_]*\Z")
_WORD = re.compile(r"[^\W_]+")
_SPELLINGS = {"colour": "color", "colours": "colors", "coloured": "colored", "grey": "gray"}
_PLURALS = """
shelves:shelf bookshelves:bookshelf knives:knife loaves:loaf halves:half scarves:scarf leaves:leaf wolves:wolf
thieves:thief calves:calf wives:wife buses:bus gases:gas lenses:lens shoes:shoe toes:toe canoes:canoe hoes:hoe
cookies:cookie movies:movie brownies:brownie smoothies:smoothie pies:pie ties:tie headaches:headache
people:person men:man women:woman children:child mice:mouse feet:foot teeth:tooth geese:goose
lens:lens gas:gas series:series scissors:scissors
"""
_IRREGULAR = dict(pair.split(":") for pair in _PLURALS.split())
"""Singulars that the rules get wrong."""
_MOST_COMPARED = 16
NONE = "none"
"""The value of an attribute that has no value; no object or attribute value may have this name."""


@lru_cache(maxsize=32_768)
def words(text: str) -> tuple[str, ...]:
    """The words of a name or phrase: no case, punctuation, underscores or British spellings.

    `"H&M (2nd floor)"` -> `("h", "m", "2nd", "floor")`; `"the_Child's toy"` -> `("the", "childs", "toy")`.
    """
    if not text.isascii():  # for what is ASCII, this changes nothing
        text = unicodedata.normalize("NFKC", text).casefold().replace("\N{RIGHT SINGLE QUOTATION MARK}", "")
    found = _WORD.findall(text.lower().replace("'", ""))
    return tuple(found if _SPELLINGS.keys().isdisjoint(found) else (_SPELLINGS.get(word, word) for word in found))


def clipped(text: str) -> str:
    """The text, shortened if it is very long: what is wrong may hold a whole document."""
    return encodable(text if len(text) <= 400 else f"{text[:400]}...")


def encodable(text: str) -> str:
    """The text with lone surrogates, which JSON strings may hold and UTF-8 cannot, written out."""
    return text.encode("utf-8", "backslashreplace").decode("utf-8")


def singular(word: str) -> str:
    """A simple singular: `boxes` -> `box`, `berries` -> `berry`, `cubes` -> `cube`, `shelves` -> `shelf`; `glass`
    stays.
    """
    if word in _IRREGULAR:
        return _IRREGULAR[word]
    if len(word) > 4 and word.endswith("ies"):
        return word[:-3] + "y"
    if len(word) > 4 and word.endswith(("xes", "ches", "shes", "sses", "zzes", "oes")):
        return word[:-2]
    if len(word) > 3 and word.endswith("s") and not word.endswith(("ss", "us", "is")):
        return word[:-1]
    return word


def closest(text: str, others: Iterable[str], *, cutoff: float) -> list[tuple[float, int]]:
    """How alike each of `others` is to the text (`SequenceMatcher.ratio`, of at least `cutoff`) and its index, closest
    first, earlier first among equals. Of very many that could be close only the most promising are compared.
    """
    matcher = SequenceMatcher(autojunk=False, b=text)  # analyses b once
    promising: list[tuple[float, int, str]] = []
    for index, other in enumerate(others):
        matcher.set_seq1(other)
        if matcher.real_quick_ratio() >= cutoff and (bound := matcher.quick_ratio()) >= cutoff:
            promising.append((-bound, index, other))
    found: list[tuple[float, int]] = []
    for _, index, other in sorted(promising)[:_MOST_COMPARED]:
        matcher.set_seq1(other)
        if (ratio := matcher.ratio()) >= cutoff:
            found.append((ratio, index))
    return sorted(found, key=lambda each: (-each[0], each[1]))


def hint(name: str, known: Iterable[str]) -> str:
    """` (did you mean ...?)` for the closest known name, else the known names when they are few, else
    nothing.
    """
    names = list(dict.fromkeys(islice(known, 1_000)))
    close = closest(name[:100].casefold(), (other.casefold() for other in names), cutoff=0.6)
    if close:
        return f" (did you mean {names[close[0][1]]}?)"
    if 0 < len(names) <= 8:
        return f" (known: {', '.join(names)})"
    return ""


def quoted(name: str) -> str:
    """The name, in double quotes unless it is an identifier."""
    return name if IDENTIFIER.match(name) else json.dumps(name, ensure_ascii=False)


def application(name: str, arguments: Iterable[str]) -> str:
    """`pick(cylinder)`, `north`, `drive("H&M (2nd floor)")`: unambiguous, whatever the names hold."""
    listed = ", ".join(quoted(argument) for argument in arguments)
    return f"{name}({listed})" if listed else name


def listing(items: Iterable[str], word: str = "or") -> str:
    """`a`, `a or b`, `a, b or c`."""
    names = list(items)
    return names[0] if len(names) == 1 else f"{', '.join(names[:-1])} {word} {names[-1]}" if names else "nothing"

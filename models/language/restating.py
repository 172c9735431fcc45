"""Ways to say in other words, which the networks know, what they do not know, or mistake.

"Under no circumstances" is "never". "Hands off the cup" they take for picking it up, and what is said last and to be
done first ("...; before that, ...", "... on the way back from the zoo") for the order in which it is said.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field

from models.queries import Query

_NEVER = re.compile(
    r"\b(?:under no circumstances?|on no account|in no case|by no means|at no (?:time|point)"
    r"|(?:don['’]t|dont|do not)(?: you)? ever)\b",
    re.IGNORECASE,
)
_END = r"(?:,? please)?[ .!]*$"
_MODAL = r"(?:should|must|may|shall|can|is to|are to|has to|have to)"
_NAME = r"[\w'-]+(?: [\w'-]+){0,4}?"
_MISTAKEN = tuple(
    (re.compile(pattern, re.IGNORECASE), words)
    for pattern, words in (
        (r"\b(?:keep (?:your |those |the )?)?hands off (?:of )?(?=the |my |that |this |those )", "never pick up "),
        (r"\blast,? but (?:certainly |definitely )?not least,?", "finally"),
        (
            rf"^(?P<do>.+?),? on (?:the|your) way (?:back |home )+from (?P<off>[^,.;!?]+?){_END}",
            r"go to \g<off>, then \g<do>",
        ),
        (r"^on (?:the|your) way (?:back |home )+from (?P<off>[^,.;!?]+), (?P<do>.+)", r"go to \g<off>, then \g<do>"),
        (rf"^(?P<do>[^,.;!?]+?) on (?:the|your) way to (?P<to>[^,.;!?]+?){_END}", r"\g<do>, then go to \g<to>"),
        (r"^on (?:the|your) way to (?P<to>[^,.;!?]+), (?P<do>[^,.;!?]+)", r"\g<do>, then go to \g<to>"),
        (
            r"^(?:(?:last of all|finally|lastly),? )?(?P<last>.+?)[;,.] (?:but |and )?"
            rf"before (?:that|this|you do(?: so| that)?),? (?P<do>[^,.;!?]+?){_END}",
            r"\g<do>, then \g<last>",
        ),
        (
            rf"^(?P<do>(?:[\w']+ ){{0,6}}?(?:to|visit|see|reach)) (?P<one>{_NAME}) and (?P<two>{_NAME}),? "
            rf"(?:but |and |with )?(?P=two) first{_END}",
            r"\g<do> \g<two>, then \g<do> \g<one>",
        ),
        (
            rf"^neither (?P<one>{_NAME}) nor (?P<two>{_NAME}) {_MODAL} (?:ever )?be (?:on|running){_END}",
            r"never switch on \g<one> and never switch on \g<two>",
        ),
        (
            rf"^(?P<one>{_NAME}) {_MODAL} (?:never|not)(?: ever)? be (?:on|running){_END}",
            r"never switch on \g<one>",
        ),
        (rf"^(?:no,? )?not (?P<one>the {_NAME}), (?P<two>the {_NAME}){_END}", r"not \g<one> but \g<two>"),
    )
)
"""What is mistaken with much confidence, and how it is said instead."""
_FIRST = re.compile(r"^\s*1[.)]\s+")
_NEXT = re.compile(r"(?<=\w) \d{1,2}[.)]\s+")
"""The number of a step behind the last word of the one before it."""
_APART = re.compile(r"[^\w ]\s*\d{1,2}[.)]\s")
"""The number of a step that begins a line, or a sentence, where the networks know it."""


@dataclass(frozen=True, slots=True)
class Restated:
    """A command in other words, with the same meaning."""

    text: str
    mistaken: bool = field(default=False, kw_only=True)
    """Whether what is heard of the words as they are said is not what they mean."""

    @property
    def texts(self) -> tuple[str, ...]:
        """The one text."""
        return (self.text,)

    def tears(self, _query: Query, /) -> bool:
        """Whether it takes the place of what is sure of the words as they are said."""
        return self.mistaken

    def put_together(self, queries: Sequence[Query]) -> Query | None:
        """The query of the text."""
        (query,) = queries
        return query


def restated(text: str) -> Iterator[Restated]:
    """The command in words that the networks know better, if it has others."""
    if _NEVER.search(text):
        yield Restated(_NEVER.sub("never", text))
    if _FIRST.match(text) and _NEXT.search(text) and not _APART.search(text):
        yield Restated(_NEXT.sub(", then ", _FIRST.sub("", text)), mistaken=True)
    plain = " ".join(text.split())  # patterns would take long over runs of spaces
    for pattern, words in _MISTAKEN:
        if pattern.search(plain):
            yield Restated(pattern.sub(words, plain), mistaken=True)

"""Readings put right that say the contrary of a command, or more than it says.

The networks know no task of staying somewhere, or of keeping something as it is; they take "stay in the kitchen" for
staying out of it, and "keep the oven off" for never switching it off. Nor do they know that "turn it off again" asks
for it once, that whoever visits "all rooms except the hall" may come through the hall, and that "instead of the hall"
leaves no choice.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from dataclasses import replace

from models.language.tokens import words
from models.language.translation import Translation
from models.queries import Composition, ContextualQuery, Operator, Query
from models.world import Quantifier, quantified

_NOT = r"(?<!not )(?<!cannot )(?<!can't )(?<!don't )(?<!dont )(?<!never )"
STAYING = _NOT + r"(?:stay|remain|wait|linger) (?:put )?(?:in|at|within|inside|on|by|near|with)"
LEAVING = (
    r"(?:don't|dont|do not|never|not|without) (?:ever )?(?:let [\w' ]{1,40} )?(?:leave|leaving|exit|exiting|get out of)"
)
_ARTICLE = r"(?: (?:the|a|an|my|your|this|that))?"
_EXCEPT = r"(?:except(?: for)?|but(?: not)?|excluding|apart from|other than|besides|save for)"
_KEEPING = r"(?:keep|keeping|leave|leaving)"
_KEPT = r"(?P<how>on|off|open|closed|shut|locked|running)"
_AGAIN = re.compile(r"\bagain\b")
_REPEATING = re.compile(
    r"\b(?:again and again|over|keep|keeps|always|forever|for ever|repeat\w*|continu\w*|every|each|loop|patrol\w*"
    r"|back and forth|constantly|regularly|alternat\w*|between|endless\w*|never stop|nonstop|non-stop|times?)\b"
)


def corrected(text: str, translations: Iterable[Translation]) -> tuple[Translation, ...]:
    """The translations of a text that do not say its contrary; nothing endlessly that it says once more, and what it
    makes an exception of in the phrase that it is an exception to.

    Raises:
        TextTooLongError: the text is beyond the limits of a command.
    """
    said = " ".join(words(text))
    once = _AGAIN.search(said) is not None and _REPEATING.search(said) is None
    found: dict[Query, float] = {}
    for translation in translations:
        if not any(_is_contrary(said, task) for task in _avoided(translation.query)):
            query = _done_once(translation.query) if once else translation.query
            query = _with_exceptions(said, _without_rejected(said, query))
            found[query] = found.get(query, 0.0) + translation.confidence
    return tuple(Translation(query, min(1.0, confidence)) for query, confidence in found.items())


def _avoided(query: Query) -> Iterator[ContextualQuery]:
    """The tasks that are forbidden as they stand."""
    if isinstance(query, ContextualQuery):
        return
    for operand in query.operands:
        if query.operator is Operator.AVOID and isinstance(operand, ContextualQuery):
            yield operand
        yield from _avoided(operand)


def _is_contrary(said: str, forbidden: ContextualQuery) -> bool:
    """Whether a text asks to stay where a query forbids to be, or to keep what it forbids to change."""
    for argument in forbidden.arguments:
        name = f"{_ARTICLE} {re.escape(argument)}"
        if re.search(rf"\b{STAYING}{name}\b", said) or re.search(
            rf"\b{LEAVING}{name}\b(?! (?:in|on|at|by|to)\b)", said
        ):
            return True
        if (
            kept := re.search(rf"(?P<not>\b(?:never|not|don't|dont) (?:ever )?)?\b{_KEEPING}{name} {_KEPT}\b", said)
        ) is None:
            continue
        same = kept["how"] in forbidden.task.split("_")
        if same == (kept["not"] is None):
            return True
    return False


def _done_once(query: Query) -> Query:
    if isinstance(query, ContextualQuery):
        return query
    if query.operator is Operator.REPEAT:
        return _done_once(query.operands[0])
    return Composition(query.operator, tuple(map(_done_once, query.operands)))


def _without_rejected(said: str, query: Query) -> Query:
    """The query without what it gives a choice of and the text rejects: "go to the lounge instead of the hall"."""
    if isinstance(query, ContextualQuery) or query.operator is not Operator.OR:
        return query
    kept = [
        o
        for o in query.operands
        if not (isinstance(o, ContextualQuery) and any(_rejects(said, a) for a in o.arguments))
    ]
    return kept[0] if len(kept) == 1 else query


def _rejects(said: str, name: str) -> bool:
    return re.search(rf"\b(?:instead of|rather than){_ARTICLE} {re.escape(name)}\b", said) is not None


def _with_exceptions(said: str, query: Query) -> Query:
    """The query with what it forbids as an exception to a phrase for several things, where the text says so."""
    if isinstance(query, ContextualQuery) or query.operator is not Operator.AND or len(query.operands) != 2:
        return query
    wanted, avoided = query.operands
    (forbidden,) = (
        avoided.operands if isinstance(avoided, Composition) and avoided.operator is Operator.AVOID else (None,)
    )
    if not isinstance(wanted, ContextualQuery) or not isinstance(forbidden, ContextualQuery):
        return query
    for place, phrase in enumerate(wanted.arguments):
        for name in forbidden.arguments:
            found = re.search(rf"\b{re.escape(phrase)} (?P<but>{_EXCEPT}{_ARTICLE} {re.escape(name)})\b", said)
            if found and quantified(phrase).quantifier is not Quantifier.ONE:
                arguments = (*wanted.arguments[:place], f"{phrase} {found['but']}", *wanted.arguments[place + 1 :])
                return replace(wanted, arguments=arguments)
    return query

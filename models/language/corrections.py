"""Readings put right that say the contrary of a command, or more than it says.

The networks know no task of staying somewhere, or of keeping something as it is; they take "stay in the kitchen" for
staying out of it, and "keep the oven off" for never switching it off. Nor do they know that "turn it off again" asks
for it once, that whoever visits "all rooms except the hall" may come through the hall, that "instead of the hall"
leaves no choice, and that what need not be done is not forbidden.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from dataclasses import replace
from itertools import chain

from models.language.exceptions import speaks_for_exception, with_exceptions
from models.language.tokens import words
from models.language.translation import Translation
from models.queries import Composition, ContextualQuery, Operator, Query

_NOT = r"(?<!not )(?<!cannot )(?<!can't )(?<!don't )(?<!dont )(?<!never )"
STAYING = _NOT + r"(?:stay|remain|wait|linger) (?:put )?(?:in|at|within|inside|on|by|near|with)"
LEAVING = (
    r"(?:don't|dont|do not|never|not|without) (?:ever )?(?:let [\w' ]{1,40} )?(?:leave|leaving|exit|exiting|get out of)"
)
EXCUSED = (
    r"(?:(?:don't|dont|do not|doesn't|does not) (?:have|need) to|need ?n[o']t|no need to|not (?:needed|necessary) to)"
)
"""Words that leave it to the robot whether to do something."""
ARTICLE = r"(?: (?:the|a|an|my|your|this|that))?"
_AWAY = r"(?:stay|staying|keep|keeping|steer) (?:away from|clear of|off|out of)"
_KEEPING = r"(?P<not>\b(?:never|not|don't|dont) (?:ever )?)?\b(?:keep|keeping|leave|leaving)"
_KEPT = r"(?:switched |turned )?(?P<how>on|off|running)(?= (?:until|while|when|and|then|for)\b|$)"
_ORDERED = re.compile(r"\bin (?:that|this|the given|exactly that|exactly this) (?:order|sequence)\b")
_UNORDERED = re.compile(
    r"\b(?:any|no particular|no special|whatever|whichever|either) order\b"
    r"|\border (?:(?:doesn't|does not|dosnt|doesnt) matter|is (?:not important|unimportant|up to you))\b"
)
_ORDERING = re.compile(r"\b(?:then|after\w*|before\w*|first|finally|once|last\w*|when)\b")
_AGAIN = re.compile(r"\b(?:again|once more|one more time|at least once|round trip|and back$)")
_RETURNING = r"(?:back (?:to|at|in)|return(?:ing)? to)"
_ORDER = r"(?:please )?(?:put|pick|take|bring|go|get|fetch|move|switch|turn|visit)"
_NEGATION = r"(?:not|no|never|don't|dont|without|avoid|nor|neither|keep|stay)"
_REJECTED_LAST = re.compile(
    rf"{_ORDER}(?: (?!{_NEGATION}\b)[\w'-]+)+ not (?:the|a|an|my|in|into|to|on|at)\b(?! {_NEGATION}\b).*"
)
"""An order, and at its end what it is not about: "put the cup in the basket, not the towel"."""
_REPEATING = re.compile(
    r"\b(?:again and again|over|keep|keeps|always|forever|for ever|repeat\w*|continu\w*|every|each|loop|patrol\w*"
    r"|back and forth|constantly|regularly|alternat\w*|between|endless\w*|never stop|nonstop|non-stop|times)\b"
)


def corrected(text: str, translations: Iterable[Translation]) -> tuple[Translation, ...]:
    """The translations of a text that do not say its contrary; nothing endlessly that it says once more, in the order
    that it asks for or in none, and what it makes an exception of in the phrase that it is an exception to.

    Raises:
        TextTooLongError: the text is beyond the limits of a command.
    """
    said = " ".join(words(text))
    found: dict[Query, float] = {}
    for translation in translations:
        query = with_exceptions(said, _put_right(said, translation.query))
        if not _is_contrary(said, query):
            found[query] = found.get(query, 0.0) + translation.confidence
    return tuple(Translation(query, min(1.0, confidence)) for query, confidence in found.items())


def _put_right(said: str, query: Query) -> Query:
    if isinstance(query, ContextualQuery):
        return query
    if _AGAIN.search(said) and not _REPEATING.search(said):
        query = _done_once(query)
    if (
        isinstance(query, Composition)
        and query.operator is Operator.AND
        and (_ORDERED.search(said) or _returns(said, query.operands[-1]))
    ):
        query = replace(query, operator=Operator.THEN) if not any(_forbidden(query)) else query
    query = _not_done_to(said, query)
    if _UNORDERED.search(said) and not _ORDERING.search(said):
        query = _in_any_order(query)
    return _without_rejected(said, query)


def _in_any_order(query: Query) -> Query:
    """The query without the order of what is to be done, at its root or beside what is forbidden there."""
    if isinstance(query, ContextualQuery):
        return query
    if query.operator is Operator.THEN:
        return replace(query, operator=Operator.AND)
    if query.operator is not Operator.AND:
        return query
    parts = (_in_any_order(operand) for operand in query.operands)
    flat = [p.operands if isinstance(p, Composition) and p.operator is Operator.AND else (p,) for p in parts]
    return replace(query, operands=tuple(chain.from_iterable(flat)))


def _is_contrary(said: str, query: Query) -> bool:
    """Whether a query says the contrary of a text in one of its parts."""
    forbidden = {id(task) for task in _forbidden(query)}
    if _turns_round(said, query) or (
        isinstance(query, Composition) and query.operator is Operator.AVOID and _REJECTED_LAST.fullmatch(said)
    ):
        return True
    if forbidden and re.search(rf"\b{EXCUSED}\b", said) and isinstance(query, Composition):
        return query.operator is Operator.AVOID
    return any(
        speaks_for_exception(said, task, query)
        or (id(task) in forbidden and _forbids_staying(said, task))
        or _changes_kept(said, task, forbids=id(task) in forbidden)
        for _, task in query.tasks
    )


def _not_done_to(said: str, query: Query) -> Query:
    """The query with what a text says at its end not to do it to, in place of not going there: "pick up the cup, not
    the towel".
    """
    match query:
        case Composition(
            Operator.AND,
            (ContextualQuery() as done, Composition(Operator.AVOID, (ContextualQuery("move_to", (name,)),)) as avoided),
        ) if done.arguments and re.search(rf" not{ARTICLE} {re.escape(name)}(?: please)?$", said):
            other = replace(done, arguments=(name, *done.arguments[1:]))
            return replace(query, operands=(done, replace(avoided, operands=(other,))))
    return query


def _returns(said: str, last: Query) -> bool:
    """Whether a query that ends with going somewhere is of a text that says to come back to there."""
    if not isinstance(last, ContextualQuery) or len(last.arguments) != 1:
        return False
    return re.search(rf"\b{_RETURNING}{ARTICLE} {re.escape(last.arguments[0])}\b", said) is not None


def _turns_round(said: str, query: Query) -> bool:
    """Whether a query does first what "before", at the beginning of a text, says to come later."""
    if not said.startswith("before ") or not isinstance(query, Composition) or query.operator is not Operator.THEN:
        return False
    first, then = (
        [said.find(phrase) for _, task in operand.tasks for phrase in task.arguments]
        for operand in (query.operands[0], query.operands[-1])
    )
    return bool(first and then) and min(first) >= 0 and max(first) < min(then)


def _forbidden(query: Query) -> Iterator[ContextualQuery]:
    """The tasks that are forbidden as they stand."""
    if isinstance(query, ContextualQuery):
        return
    for operand in query.operands:
        if query.operator is Operator.AVOID and isinstance(operand, ContextualQuery):
            yield operand
        yield from _forbidden(operand)


def _forbids_staying(said: str, forbidden: ContextualQuery) -> bool:
    """Whether a text asks to stay where a query forbids to be, or only to stay away from what it forbids to change."""
    changes = not {"on", "off"}.isdisjoint(forbidden.task.split("_"))
    for argument in forbidden.arguments:
        name = f"{ARTICLE} {re.escape(argument)}"
        staying = rf"\b(?:{STAYING}{name}|{LEAVING}{name}(?! (?:in|on|off|at|by|to|running)\b))\b"
        if re.search(staying, said) or (changes and re.search(rf"\b{_AWAY}{name}\b", said)):
            return True
    return False


def _changes_kept(said: str, task: ContextualQuery, *, forbids: bool) -> bool:
    """Whether a task changes what a text asks to keep as it is, or a query forbids a task that would not change it."""
    parts = set(task.task.split("_"))
    if parts.isdisjoint({"on", "off"}):
        return False
    for argument in task.arguments:
        kept = re.search(rf"{_KEEPING}{ARTICLE} {re.escape(argument)} {_KEPT}", said)
        if kept is not None:
            wanted = "off" if kept["how"] == "off" else "on"
            same = wanted in parts
            if forbids is (same == (kept["not"] is None)) and (forbids or kept["not"] is None):
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
    kept = [operand for operand in query.operands if not _rejects(said, operand)]
    return kept[0] if len(kept) == 1 else query


def _rejects(said: str, query: Query) -> bool:
    names = query.arguments if isinstance(query, ContextualQuery) else ()
    return any(re.search(rf"\b(?:instead of|rather than){ARTICLE} {re.escape(name)}\b", said) for name in names)

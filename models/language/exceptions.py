"""Exceptions: who is to visit "all rooms except the hall" is not told to keep out of the hall.

The networks read an exception as something forbidden besides, or as what is meant. Where a query forbids what the text
only excepts, the exception goes into the phrase that it is one to, which `models.world.ground` reads.
"""

from __future__ import annotations

import re
from dataclasses import replace

from models.queries import Composition, ContextualQuery, Operator, Query
from models.world import Quantifier, quantified
from models.world.quantifiers import EXCEPTING

_EXCEPT = rf"(?:{'|'.join(map(re.escape, EXCEPTING))})"
_ARTICLE = r"(?:the |a |an |my |your |this |that )?"
_SEVERAL = r"(?:everything|anything|everywhere|anywhere|everyone|anyone|all|every|each|any)"
_EXCEPTED = re.compile(rf"\b{_SEVERAL}(?: [\w'-]+){{0,6}}? {_EXCEPT} {_ARTICLE}(?P<word>[\w'-]+)")
_WHOLE = {"all": "any", "all of": "any of", "every": "any", "each": "any", "everything": "anything", "both": "either"}
"""How phrases for all things begin, and how when one is not to do something with any of them."""


def with_exceptions(said: str, query: Query) -> Query:
    """The query with what it forbids as exceptions to a phrase for several things, where the folded text says so."""
    return _of_any(_excepting(said, query))


def _excepting(said: str, query: Query) -> Query:
    if isinstance(query, ContextualQuery) or query.operator is not Operator.AND:
        return query
    wanted, *rest = query.operands
    task = _carried(wanted)
    names = [] if task is None else [name for operand in rest for name in _forbidden_names(operand, task)]
    if task is None or len(names) != len(rest):
        return query
    listed = "|".join(sorted(map(re.escape, names), key=len, reverse=True))
    for place, phrase in enumerate(task.arguments):
        excepted = rf"{_EXCEPT} (?:(?:{_ARTICLE}(?:{listed})|and|or|nor|for)\b ?){{1,{4 * len(names)}}}"
        found = re.search(rf"\b{re.escape(phrase)} (?P<but>{excepted})", said)
        if (
            found
            and quantified(phrase).quantifier is not Quantifier.ONE
            and all(name in found["but"] for name in names)
        ):
            but = re.sub(r"(?: (?:and|or|nor|for))+$", "", found["but"].strip())
            arguments = (*task.arguments[:place], f"{phrase} {but}", *task.arguments[place + 1 :])
            return _replaced(wanted, replace(task, arguments=arguments))
    return query


def speaks_for_exception(said: str, task: ContextualQuery, query: Query) -> bool:
    """Whether a task is to be done with just what the text makes an exception of: "bring everything but the ball"."""
    excepted = _EXCEPTED.search(said)
    if excepted is None or any(_has_exception(phrase) for _, each in query.tasks for phrase in each.arguments):
        return False
    return any(excepted["word"] in argument.split() for argument in task.arguments)


def _has_exception(phrase: str) -> bool:
    return re.search(rf"\b{_EXCEPT}\b", phrase) is not None


def _of_any(query: Query) -> Query:
    """Of what is forbidden of all things, none is allowed: who is to avoid "every room" shall enter none."""
    if isinstance(query, ContextualQuery):
        return query
    if query.operator is Operator.AVOID and isinstance(query.operands[0], ContextualQuery):
        (task,) = query.operands
        assert isinstance(task, ContextualQuery)
        return replace(query, operands=(replace(task, arguments=tuple(map(_any, task.arguments))),))
    return replace(query, operands=tuple(map(_of_any, query.operands)))


def _any(phrase: str) -> str:
    for whole, part in sorted(_WHOLE.items(), key=lambda item: -len(item[0])):
        if phrase == whole or phrase.startswith(f"{whole} "):
            return part + phrase[len(whole) :]
    return phrase


def _forbidden_names(query: Query, wanted: ContextualQuery) -> list[str]:
    """The arguments of a task that is forbidden, but for those of the one that is wanted; none of any other query."""
    if isinstance(query, ContextualQuery) or query.operator is not Operator.AVOID:
        return []
    (task,) = query.operands
    return (
        [name for name in task.arguments if name not in wanted.arguments] if isinstance(task, ContextualQuery) else []
    )


def _carried(query: Query) -> ContextualQuery | None:
    """The task that is to be done, again and again, or never."""
    if isinstance(query, Composition) and query.operator in (Operator.REPEAT, Operator.AVOID):
        return _carried(query.operands[0])
    return query if isinstance(query, ContextualQuery) else None


def _replaced(query: Query, task: ContextualQuery) -> Query:
    return (
        task if isinstance(query, ContextualQuery) else replace(query, operands=(_replaced(query.operands[0], task),))
    )

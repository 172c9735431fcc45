"""What commands say and queries cannot: how often, how long, at what time, and under which condition; to stay, to keep
things as they are, to come back to wherever the robot was; and how much.

"Visit the museum twice", "stay there", "be there by noon", "close the door when it rains": a translator that hears
the rest must not pass over it. Politeness is no condition: "if it is no trouble".
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from models.language.corrections import EXCUSED, LEAVING, STAYING
from models.language.tokens import is_mark, marked_words, words
from models.queries import Composition, Operator, Query

_NUMBER = r"(?:two|three|four|five|six|seven|eight|nine|ten|twelve|twenty|thirty|several|a few|a couple of|\d+)"
_UNIT = r"(?:seconds?|minutes?|hours?|days?|weeks?)"
_ABOUT = r"(?:exactly |about |around |roughly |another |at least |at most |up to )?"
_THE = r"(?:the|a|an|my|your|this|that|these|those|it|them)"
_OFTEN = re.compile(
    rf"\b(?:twice|thrice|{_NUMBER} (?:more )?times|(?:for|in|within|after) {_ABOUT}{_NUMBER} {_UNIT})\b"
)
"""How often, and how long."""
_KEPT = re.compile(
    rf"\b(?:(?:stay|remain|wait) (?:there|here)|{STAYING} (?:{_THE} )?[\w-]+"
    rf"|{LEAVING}(?! (?:[\w-]+ ){{1,4}}(?:in|on|at|by|to|with)\b) (?:{_THE} )?[\w-]+"
    rf"|keep(?:ing)? (?!an eye){_THE} (?:[\w-]+ ){{0,3}}(?:on|off|open|closed|shut|running|in|at|inside|where)"
    rf"|leave {_THE} (?:[\w-]+ ){{0,3}}(?:running|(?:on|off)(?= (?:until|while|when|and|then|for)\b|$)))\b"
)
"""To stay somewhere, and to keep things as they are."""
_OTHERWISE = re.compile(
    rf"\b(?:turn(?:ing)? {_THE} (?:[\w-]+ ){{0,3}}(?:down|up)|(?:turn|set)(?:t?ing)? (?:[\w-]+ ){{1,4}}to {_NUMBER}"
    rf"|{_NUMBER} (?:degrees?|percent)|(?<!to )(?:check (?:up )?on|look after)|(?:re)?charge yourself"
    r"|no wait|wait no|scratch that|always (?:end|finish) (?:up )?(?:in|at|by|with)|and back$"
    r"|come (?:right |straight )?back(?! (?:to|with|for|from)\b)|(?:go|look|be|walk|drive) everywhere)\b"
)
"""How much; verbs that change nothing, or have no place; where to end, and what takes back what was said."""
_ON_YOU = re.compile(
    r"\bif you(?:'re|'ve)? "
    r"(?:are|were|have|had|go|come|get|visit|pass|hold|see|find|pick|enter|reach|been|in|at|near|holding)\b"
    r"(?! (?:(?:a|the|some|any|enough) )?(?:free|ready|done|able|not|moment|minute|time|chance|there)\b)[\w' -]*"
    r"|\bonly (?:after|if|when|once)\b"
)
"""Conditions on what the robot does, and when alone it may do something."""
_FORBIDDING = r"(?:don't|dont|do not|never|must not|mustn't|not)"
_TOGETHER = re.compile(
    rf"\b{_FORBIDDING} (?:[\w']+ ){{1,4}}both\b|\b{_FORBIDDING} (?:[\w']+ ){{0,8}}(?:at the same time|simultaneously)\b"
)
"""What is forbidden together only."""
_LATER = re.compile(
    rf"\b{_FORBIDDING} (?:[\w']+ ){{1,6}}after (?:the )?[\w-]+|\b(?:after|once) (?:[\w'-]+ ){{1,8}}?{_FORBIDDING}\b"
    rf"|\band then (?:{_FORBIDDING}|stay out|keep out|stay away)\b"
)
"""What is forbidden from then on."""
_UNTIL = re.compile(r"\b(?:until|till|before|unless)\b")
_OTHER_WAY = re.compile(r"\b(?:but|until|before|unless|instead)\b")
"""With one of these, what begins with "do not" may also say what to do."""
_ONLY_BY = re.compile(r"\bonly (?:via|through|by way of)\b")
_FORBIDS_FIRST = re.compile(
    r"(?:please )?(?:don't|dont|do not|never) (?:go|drive|walk|visit|enter|put|pick|take|bring|switch|turn)\b"
)
_WHILE = re.compile(r"\bwhile (?:the|my|your|a|an) (?:[\w-]+ ){1,3}(?:is|are) (?:on|off|running|in|at|inside|near)\b")
_EVERYTHING = re.compile(r"everything (?:must|should|shall|has|needs|ought|goes|belongs)\b")
_GOING = frozenset({"navigate_one", "move_to"})
"""Tasks that send the robot, which is not everything."""
_DISCOURAGED = re.compile(
    rf"\b(?:{EXCUSED}|(?:bad|terrible|poor|stupid) idea|(?:be|is|it's) (?:bad|dangerous|wrong|forbidden|unwise) to"
    r"|no (?:point|sense|use) in|(?:hate|dislike) (?:it if )?(?:you|for you)|never (?:told|said|asked)|what if"
    r"|wish (?:i|we|you) (?:had|were|could))\b"
)
"""Before what is not to be done, or need not be."""
_REPORT = re.compile(
    r"(?!(?:it|that|this|there|what|who|here) )(?:(?:the|my|your|a|an) )?(?:[\w'&-]+ ){1,4}"
    r"(?:is|are|was|were) (?:now |already |still )?"
    r"(?:on|off|in|at|inside|near)\b"
)
"""How things are."""
_MODAL = frozenset(
    {"should", "must", "shall", "ought", "need", "needs", "supposed", "please", "want", "like", "better"}
)
"""With one of these a text says how things shall be."""
_BOTH = re.compile(r"\b(?:off and (?:then )?on|on and (?:then )?off)\b")
_EXCEPTED = re.compile(rf"^(?:except for|except|apart from|other than|excluding) (?:{_THE} )?[\w-]+")
_DAY = r"(?:(?:mon|tues|wednes|thurs|fri|satur|sun)day|weekend)"
_MEAL = r"(?:breakfast|lunch|dinner|supper)"
_CLOCK = rf"(?:noon|midnight|dawn|dusk|sunrise|sunset|{_MEAL}|{_NUMBER}(?: \d\d)? ?(?:am|pm|o'?clock))"
_EACH = r"(?:every|each) (?:other |second )?(?:morning|afternoon|evening|night|minute|hour|day|week)"
_TIME = re.compile(
    rf"\b(?:(?:at|by|before|after|until|till|around) {_CLOCK}|tomorrow(?: morning| afternoon| evening| night)?"
    rf"|(?:on|every|each|next) {_DAY}|{_EACH})\b"
)
_REASONS = frozenset({"so", "because", "since", "as"})
"""Words that stand between a command and its reason, which may have a time of its own: "dinner is at noon, so ..."."""
_IF = frozenset({"if", "unless"})
_IS = frozenset({"is", "are", "was", "were", "isn't", "aren't", "has", "have", "hasn't", "gets", "becomes", "rains"})
_ALWAYS = (("whenever",), ("every", "time"), ("each", "time"))
"""What begins that may come true again and again; no query says what is to be done each time."""
_WHEN = (("when",), ("as", "soon", "as"), *_ALWAYS)
"""What begins conditions that may come true later."""
_OWN = frozenset(
    {"there", "you", "you're", "you've", "your", "that", "this", "these", "those", "all", "everything", "both"}
)
"""What a command says to do first is about: "when you are there", "when that is done"."""
_READY = frozenset({"done", "finished", "over", "ready", "complete", "possible", "convenient", "free", "able", "suits"})
"""How things are when something that was said to be done has been, or when it suits."""
_CHANCE = _READY | {"can", "like", "want", "wish", "please", "time", "chance", "moment", "minute"}
"""Likewise: "whenever you have a minute"."""
_ASKING = frozenset({"see", "ask", "check", "know", "wonder", "tell", "as"})
"""Words after which "if" states no condition: "to see if it is raining"."""
_LONGEST_SUBJECT = 4
_LONGEST_CONDITION = 8
_WHOEVER = frozenset({"you", "i", "we", "that", "this", "there", "what", "not", "anything", "nothing", "everything"})
"""What polite conditions, and those that only tell of a choice, are about: "if that is easier"."""
_POLITE = frozenset({"no", "not", "too", "possible", "ok", "okay", "fine", "all", "alright", "convenient", "easier"})
"""How things are, for it to be polite to say so: "if it is no trouble"."""
_ELSE = frozenset({"else", "otherwise", "instead", "or"})
"""Words with which a condition is a choice: "the zoo if it is open, else the park"."""


def unsayable(text: str, query: Query) -> str | None:
    """The first words of a command that say what no query does, such as how often, how long, at what time, or on which
    condition, unless they are in a name that the query speaks of; None without any.

    Raises:
        TextTooLongError: the text is beyond the limits of a command.
    """
    names = [f" {phrase} " for _, task in query.tasks for phrase in task.arguments]
    plain = " ".join(words(text))
    passed_over = (
        found[0] for pattern in (_OFTEN, _KEPT, _OTHERWISE, _ON_YOU, _TOGETHER) for found in pattern.finditer(plain)
    )
    chosen = isinstance(query, Composition) and query.operator is Operator.OR and not _ELSE.isdisjoint(words(text))
    marked = marked_words(text)
    found = (
        *passed_over,
        *_reports(marked, query),
        *_times(marked, query),
        *(() if chosen else _conditions(marked)),
        *_occasions(marked, query),
        *_ways(plain, query),
    )
    return next((said for said in found if not any(f" {said} " in name for name in names)), None)


def _ways(plain: str, query: Query) -> Iterator[str]:
    """Ways to forbid something, and a subject, that this query has none of, though others have."""
    operators = set(_operators(query))
    patterns = []
    if Operator.UNTIL in operators and not _UNTIL.search(plain):
        patterns.append(_LATER)
    if operators & {Operator.AVOID, Operator.UNTIL}:
        patterns.append(_ONLY_BY)
    if Operator.WITHOUT not in operators:
        patterns.append(_WHILE)
    for pattern in patterns:
        yield from (found[0] for found in pattern.finditer(plain))
    allows = operators and not operators & {Operator.AVOID, Operator.UNTIL, Operator.WITHOUT}
    if allows and (found := _FORBIDS_FIRST.match(plain)) and not _OTHER_WAY.search(plain):
        yield found[0]
    if _EVERYTHING.match(plain) and any(task.task in _GOING for _, task in query.tasks):
        yield "everything"


def _operators(query: Query) -> Iterator[Operator]:
    if isinstance(query, Composition):
        yield query.operator
        for operand in query.operands:
            yield from _operators(operand)


def _reports(said: tuple[str, ...], query: Query) -> Iterator[str]:
    """A text that only tells how things are ("the oven is on"), an exception at its beginning, and both of two tasks of
    which the query does one ("turn it off and on").
    """
    plain = " ".join(word for word in said if word not in (".", "!"))
    if _MODAL.isdisjoint(said) and not any(is_mark(word) for word in said[:-1]) and _REPORT.match(plain):
        yield plain
    if (excepted := _EXCEPTED.match(plain)) is not None:
        yield excepted[0]
    does = {part for _, task in query.tasks for part in task.task.split("_")}
    if (both := _BOTH.search(plain)) is not None and len(does & {"on", "off"}) == 1:
        yield both[0]


def _conditions(said: tuple[str, ...]) -> Iterator[str]:
    for at, word in enumerate(said):
        if word in _IF and (at == 0 or said[at - 1] not in _ASKING):
            clause = _clause(said, at + 1)
            if _is_condition([part for each in clause for part in each.replace("it's", "it is").split()]):
                yield " ".join((word, *clause))


def _times(said: tuple[str, ...], query: Query) -> Iterator[str]:
    """Times, and what speaks against doing it, that stand alone or in a clause that speaks of what the query does."""
    spoken = _spoken(query)
    clause: list[str] = []
    for word in (*said, "."):
        if word == ":":  # of a time
            continue
        if not is_mark(word) and word not in _REASONS:
            clause.append(word)
            continue
        for said_so in (_TIME, _DISCOURAGED):
            found = said_so.search(" ".join(clause))
            if found and (found[0].split() == clause or not spoken.isdisjoint(clause)):
                yield found[0]
        clause = []


def _spoken(query: Query) -> set[str]:
    """The words of the arguments of a query."""
    return {word for _, task in query.tasks for phrase in task.arguments for word in phrase.split()}


def _occasions(said: tuple[str, ...], query: Query) -> Iterator[str]:
    """Clauses that say when, by what neither the robot does nor the query speaks of: "when the bell rings"."""
    spoken = _spoken(query)
    for at in range(len(said)):
        for opening in _WHEN:
            if said[at : at + len(opening)] != opening:
                continue
            clause = _clause(said, at + len(opening))
            again = opening in _ALWAYS and _CHANCE.isdisjoint(clause)
            if clause and (again or (clause[0] not in _OWN and (_READY | spoken).isdisjoint(clause))):
                yield " ".join((*opening, *clause))


def _clause(said: tuple[str, ...], begin: int) -> tuple[str, ...]:
    """The words up to a mark, so many at most."""
    marks = (place for place in range(begin, len(said)) if is_mark(said[place]))
    return said[begin : min(next(marks, len(said)), begin + _LONGEST_CONDITION - 1)]


def _is_condition(clause: list[str]) -> bool:
    """Whether a clause says how something is, and not politely."""
    verb = next((place for place, word in enumerate(clause[: _LONGEST_SUBJECT + 1]) if word in _IS), 0)
    if verb == 0 or clause[0] in _WHOEVER:
        return False
    return clause[:verb] != ["it"] or clause[verb] == "rains" or (clause[verb + 1 :] or ["no"])[0] not in _POLITE

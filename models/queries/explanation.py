"""Queries in English: the words that were taught with their tasks, put together as the operators put tasks together.

What the words of a task say is up to who taught them; the reading of the formula (`models.world.explain`) is what is
asked for to the letter. A part of a query in which no task has words of its own is read as its formula.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from models.errors import Place
from models.logic import Formula, atoms
from models.queries.contextual_query import Composition, ContextualQuery, Operator, Query
from models.queries.errors import ExplanationError
from models.queries.evaluation import GroundedQuery, Path
from models.queries.template import Binding
from models.world import Environment, Quantifier
from models.world.explanation import Speaker
from models.world.names import listing
from models.world.phrases import Level, Said, cut, joined, joins, readable
from models.world.sequences import eventuality, steps_of
from models.world.wording import fill, needs_article, spoken_symbol, without_article

MAX_WORDS = 500
"""Most characters of the words for a task."""
_SLOT = re.compile(r"\{([^{}]*)\}")
_VERB = re.compile(r"(\{(\d+)\}) ([a-z]+s)\b")
"""The word behind a slot that may be a verb of one thing: "{1} is", "{1} ends up"."""
_PLURALS = {"is": "are", "was": "were", "has": "have", "does": "do", "goes": "go"}
_NO_VERBS = frozenset({"always", "sometimes", "as", "this", "its", "towards", "upwards", "perhaps"})


@dataclass(frozen=True, slots=True)
class QueryPart:
    """A part of a query, its path, its formula and what it says; `parts` are its operands."""

    query: Query
    path: Path
    formula: Formula
    explanation: str
    parts: tuple[QueryPart, ...]


def check_words(text: str, arity: int) -> str:
    """The words for a task of so many arguments, without a full stop: "the {1} ends up in the {2}".

    Raises:
        ExplanationError: a slot names no argument, an argument has no slot, or a brace belongs to no slot.
    """
    words = text.strip().removesuffix(".").rstrip()
    if not words or not words.isprintable() or len(words) > MAX_WORDS:
        raise _refused(f"an explanation has 1 to {MAX_WORDS} characters, on one line")
    for brace in re.finditer(r"[{}]", _SLOT.sub(lambda slot: "." * len(slot[0]), words)):
        raise _refused(f"character {brace.start() + 1}: a lone {brace[0]}; the place of an argument is written {{1}}")
    slots = [f"{{{position}}}" for position in range(1, arity + 1)]
    for slot in _SLOT.finditer(words):
        if slot[0] not in slots:
            known = f"the arguments are {' '.join(slots)}" if slots else "the task has no arguments"
            raise _refused(f"character {slot.start() + 1}: {slot[0][:20]} is no argument; {known}")
    missing = [slot for slot in slots if slot not in words]
    if missing:
        raise _refused(f"{' '.join(missing)} is missing: an explanation says every argument")
    return words


def _refused(detail: str) -> ExplanationError:
    return ExplanationError(detail, places=[Place("", detail)])


def explain_query(
    grounded: GroundedQuery, words: Mapping[str, str], environment: Environment | None = None
) -> QueryPart:
    """What a query asks for, with all its parts.

    Args:
        words: by task, with slots for its arguments: "the {1} ends up in the {2}". Tasks without are read as their
            formulas.
        environment: the one in which it was grounded. Without one, slots are filled with the phrases of the query.
    """
    return _Composer(grounded, words, environment).part(grounded.query)[0]


class _Composer:
    def __init__(self, grounded: GroundedQuery, words: Mapping[str, str], environment: Environment | None) -> None:
        self._formulas = dict(grounded.parts)
        found = dict.fromkeys(atom for formula in self._formulas.values() for atom in atoms(formula))
        self._speaker = Speaker(found, environment)
        bindings: dict[Path, list[Binding]] = {}
        for path, binding in grounded.bindings:
            bindings.setdefault(path, []).append(binding)
        self._own = {
            path: _filled(words[task.task], task, bindings.get(path, []), environment)
            for path, task in grounded.query.tasks
            if task.task in words
        }

    def part(self, query: Query, path: Path = ()) -> tuple[QueryPart, Said]:
        """What the part of the query at a path says."""
        operands = () if isinstance(query, ContextualQuery) else query.operands
        found = [self.part(operand, (*path, place)) for place, operand in enumerate(operands)]
        said = self._own.get(path)
        if said is None and any(own[: len(path)] == path for own in self._own):
            assert isinstance(query, Composition)
            said = self._composed(query.operator, path, [said for _, said in found])
        if said is None:
            said = self._speaker.say(self._formulas[path])
        return QueryPart(query, path, self._formulas[path], cut(said.text), tuple(part for part, _ in found)), said

    def _composed(self, operator: Operator, path: Path, said: Sequence[Said]) -> Said:
        match operator:
            case Operator.AND | Operator.OR:
                return joined(operator.value, said)
            case Operator.UNTIL:
                kept, done = (one.within(Level.PREFIX) for one in said)
                return Said(f"{done}, and until then {kept}", Level.PHRASE)
        things = [self._thing((*path, place), one).within(Level.PREFIX) for place, one in enumerate(said)]
        match operator:
            case Operator.THEN:
                later = [f"and then {thing}" for thing in things[1:]]
                return Said(", ".join([said[0].within(Level.PREFIX), *later]), Level.PHRASE)
            case Operator.WITHOUT:
                return Said(f"{said[0].within(Level.PREFIX)} while it is not so that {things[1]}", Level.PHRASE)
            case Operator.AVOID:
                return Said(f"it never happens that {things[0]}", Level.PREFIX)
            case _:
                return Said(f"again and again {things[0]}", Level.PREFIX)

    def _thing(self, path: Path, said: Said) -> Said:
        """What a part asks to be done, behind words that tell when: without the "eventually" of a formula."""
        inner = None if any(own[: len(path)] == path for own in self._own) else eventuality(self._formulas[path])
        return said if inner is None or len(steps_of(inner)) > 1 else self._speaker.say(inner)


def _filled(words: str, task: ContextualQuery, bindings: Sequence[Binding], environment: Environment | None) -> Said:
    names = {str(place): _as_said(phrase) for place, phrase in enumerate(task.arguments, start=1)}
    if environment is not None:
        names |= {str(binding.position): _bound(binding, environment) for binding in bindings}
    several = {str(found.position) for found in bindings if found.quantifier is Quantifier.ALL and found.candidates[1:]}
    agreed = _VERB.sub(lambda slot: f"{slot[1]} {_of_several(slot[3])}" if slot[2] in several else slot[0], words)
    return Said(fill(agreed, names), _level(words))


def _of_several(verb: str) -> str:
    """A verb of one thing, as it is said of several; other words stay as they are."""
    if verb in _PLURALS or verb in _NO_VERBS or verb.endswith("ss"):
        return _PLURALS.get(verb, verb)
    if verb.endswith("ies"):
        return f"{verb[:-3]}y"
    return verb[:-2] if verb.endswith(("shes", "ches", "sses", "xes")) else verb[:-1]


def _bound(binding: Binding, environment: Environment) -> tuple[str, bool]:
    """What an argument was bound to, and whether it takes an article; of several things the others have theirs."""
    vocabulary = environment.vocabulary
    names = []
    for candidate in binding.candidates:
        spoken = spoken_symbol(candidate.symbol, vocabulary)
        names.append((spoken, needs_article(candidate.symbol, spoken, vocabulary)))
    (first, article), *others = names
    said = [first, *(f"the {name}" if needed else name for name, needed in others)]
    return listing(said, "and" if binding.quantifier is Quantifier.ALL else "or"), article


def _as_said(phrase: str) -> tuple[str, bool]:
    """A phrase as it was said; its article goes where another one stands before it."""
    bare = without_article(phrase)
    return readable(bare), bare != phrase.strip()


def _level(words: str) -> Level:
    """Where words that were taught may stand."""
    plain = _SLOT.sub("", words)
    if not joins(plain):
        return Level.CLAUSE
    if re.search(r"[;()\"]", plain):
        return Level.LIST
    return Level.PHRASE if "," in plain else Level.PREFIX

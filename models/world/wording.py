"""Atoms in English, from the readings (`says`, `denies`) that a domain gives its propositional functions."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass

from models.logic import Atom, Name, Parameter, Term, atom_text
from models.world.domain import Function
from models.world.environment import Environment
from models.world.errors import TypeMismatchError, UnknownObjectError, UnknownPropositionError
from models.world.phrases import Level, Said, joins, readable
from models.world.resolution import bind, qualified_name, resolve_atom
from models.world.verbs import denial, with_adverbs
from models.world.vocabulary import Symbol, Vocabulary

_DETERMINERS = frozenset(
    {"the", "a", "an", "this", "that", "its", "his", "her", "their", "any", "every", "each", "some", "no"}
)
_NUMBERS = frozenset(["one", "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten"])
_COMMON_NOUN = re.compile(r"[^\W\d_A-Z]+(?:[ -][^\W\d_A-Z]+)*")
_APPLIED = re.compile(r"^\w+\(\{\w+\}(?:, \{\w+\})*\)")  # the default reading, as written
_HOLE = re.compile(r"\{(\w+)\}")


@dataclass(frozen=True, slots=True)
class AtomWording:
    """An atom read in four ways; `always` and `never` are readings of `G a` and `G !a`."""

    affirmed: Said
    denied: Said
    always: Said
    never: Said


def word_atoms(atoms: Iterable[Atom], environment: Environment | None) -> dict[Atom, AtomWording]:
    """The wording of each atom: as written without an environment, and where that does not know the atom. Where two
    different atoms are read alike, what is written follows in brackets.
    """
    worded = {atom: _worded(atom, environment) for atom in atoms}
    resolved: dict[str, set[Atom]] = {}
    for atom, wording in worded.items():
        resolved.setdefault(wording.affirmed.text, set()).add(_resolved(atom, environment))
    return {
        atom: wording if len(resolved[wording.affirmed.text]) == 1 else _marked(wording, atom_text(atom))
        for atom, wording in worded.items()
    }


def spoken_symbol(symbol: Symbol, vocabulary: Vocabulary, kinds: frozenset[str] | None = None) -> str:
    """What a symbol is called in a sentence, without an article: spaces for underscores; with its kind, or in quotes,
    where something else of the given kinds is called so too. Without kinds, an object is told from the other objects,
    and a value from the other values.
    """
    plain = readable(symbol.name)
    rivals = [
        other
        for other in vocabulary.loosely_named(symbol.name)
        if other != symbol
        and (vocabulary.is_object(other) is vocabulary.is_object(symbol) if kinds is None else other.kind in kinds)
        and readable(other.name) == plain
    ]
    if any(other.name == symbol.name for other in rivals):
        return f"{readable(symbol.kind)} {plain}"
    return f'"{symbol.name}"' if rivals else plain


def needs_article(symbol: Symbol, spoken: str, vocabulary: Vocabulary) -> bool:
    """Whether "the" belongs before the name: it is an object's, and looks like a common noun, not like a title."""
    first = spoken.partition(" ")[0]
    if not vocabulary.is_object(symbol) or first in _DETERMINERS | _NUMBERS:
        return False
    return _COMMON_NOUN.fullmatch(spoken) is not None


def fill(text: str, names: Mapping[str, tuple[str, bool]]) -> str:
    """The holes of a text filled at once, each with a name and whether "the" belongs before it; what stands before the
    hole may make it needless: "the {x}", "the toy {x}". Braces around anything else stay as they are.
    """

    def filled(hole: re.Match[str]) -> str:
        if hole[1] not in names:
            return hole[0]
        name, article = names[hole[1]]
        before = text[: hole.start()]
        bare = before != "" and not before.endswith(" ")
        determined = not _DETERMINERS.isdisjoint(before.lower().split()[-2:])
        return name if bare or determined or not article else f"the {name}"

    return _HOLE.sub(filled, text)


def without_article(phrase: str) -> str:
    """A phrase of a command without its leading "the" or "a"."""
    first, _, rest = phrase.strip().partition(" ")
    return rest.strip() if rest.strip() and first.lower() in ("the", "a", "an") else phrase.strip()


def _worded(atom: Atom, environment: Environment | None) -> AtomWording:
    found = _resolved(atom, environment)
    function = None if environment is None else environment.functions.get(found.function)
    if environment is None or function is None or len(function.parameters) != len(found.arguments):
        return _as_written(atom)
    try:
        symbols = bind(found, environment.vocabulary)
    except (UnknownPropositionError, UnknownObjectError, TypeMismatchError):
        return _as_written(atom)
    names = {
        parameter.name: _spoken(term, symbol, environment.vocabulary, parameter.kinds)
        for parameter, term, symbol in zip(function.parameters, found.arguments, symbols, strict=True)
    }
    return _of_function(function, lambda text: fill(text, names))


def _resolved(atom: Atom, environment: Environment | None) -> Atom:
    if environment is None:
        return atom
    try:
        return resolve_atom(atom, environment.vocabulary)
    except (UnknownPropositionError, UnknownObjectError, TypeMismatchError):
        return atom


def _spoken(term: Term, symbol: Symbol | None, vocabulary: Vocabulary, kinds: frozenset[str]) -> tuple[str, bool]:
    if isinstance(term, Parameter):
        return f"{{{term.position}}}", False
    assert isinstance(term, Name)
    assert symbol is not None
    if term.text == qualified_name(symbol):
        return f"{readable(symbol.kind)} {readable(symbol.name)}", vocabulary.is_object(symbol)
    spoken = spoken_symbol(symbol, vocabulary, kinds)
    return spoken, needs_article(symbol, spoken, vocabulary)


def _of_function(function: Function, filled: Callable[[str], str]) -> AtomWording:
    says, denies = function.says, function.denies
    if denies == denial(says) and (adverbs := with_adverbs(says)) is not None:
        always, never = map(filled, adverbs)
    else:
        always, never = f"it is always so that {filled(says)}", f"it never happens that {filled(says)}"
    if not joins(_HOLE.sub("", _APPLIED.sub("", says))):
        return _as_clause(filled(says), filled(denies), always, never)
    spoken = f"({filled(says)})"
    return _as_clause(spoken, f"({filled(denies)})", f"always {spoken}", f"never {spoken}")


def _as_clause(affirmed: str, denied: str, always: str, never: str) -> AtomWording:
    clause, prefix = Level.CLAUSE, Level.PREFIX
    return AtomWording(Said(affirmed, clause), Said(denied, clause), Said(always, prefix), Said(never, prefix))


def _as_written(atom: Atom) -> AtomWording:
    text = atom_text(atom)
    return _as_clause(f"{text} holds", f"{text} does not hold", f"{text} always holds", f"{text} never holds")


def _marked(wording: AtomWording, written: str) -> AtomWording:
    said = (wording.affirmed, wording.denied, wording.always, wording.never)
    return AtomWording(*(Said(f"{one.text} [{written}]", one.level) for one in said))

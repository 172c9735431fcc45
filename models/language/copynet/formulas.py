"""The output language of LTL-CopyNet: grounded LTL as words, with the atomic propositions of the paper.

Manipulation has one word for a whole proposition, written by the display patterns of the toys domain:
`F ( cylinder_in_box & F ( cylinder_in_box & box_at_bedroom ) )`. Such words stand in no command, so they can only be
generated. Navigation says the words of the place alone, which can be copied: `F ( coffee shop & F ( pharmacy ) )` is
`F (at(robot, coffee_shop) & F at(robot, pharmacy))`.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import cache, lru_cache
from itertools import groupby, product

from models.errors import CqltlError
from models.language.copynet.vocabulary import END
from models.language.dataset import Domain, Part, Word, grounding_environment, read_corpus
from models.logic import Atom, Formula, Name, Nary, Op, Unary, atoms, map_atoms, parse
from models.world import Function, load_environment

EVENTUALLY, AND, OPEN, CLOSE = "F", "&", "(", ")"
_MARKS = frozenset({EVENTUALLY, AND, OPEN, CLOSE, END})


def spell_formula(formula: Formula, domain: Domain) -> tuple[str, ...]:
    """A grounded formula of the datasets as output words, `END` last.

    Raises ValueError for an operator or an atom that no task class of the domain has.
    """
    return (*_spell(formula, domain), END)


def read_formula(spelled: Sequence[str], domain: Domain) -> Formula | None:
    """The formula that output words spell, or None when they are malformed.

    Its atoms are propositional functions of objects, as `models.world.resolve` takes them. A word of manipulation that
    is none of the compound propositions becomes a proposition of that name, which no environment has.
    """
    if not spelled or spelled[-1] != END:
        return None
    shape: list[str] = []
    said: list[Atom] = []
    for is_mark, run in groupby(spelled[:-1], _MARKS.__contains__):
        if is_mark:
            shape += run
            continue
        for atom in _read_propositions(list(run), domain):
            shape.append(f"p{len(said)}")
            said.append(atom)
    formula = _shape(tuple(shape))
    places = {Atom(f"p{index}"): atom for index, atom in enumerate(said)}
    return None if formula is None else map_atoms(formula, places.__getitem__)


def _read_propositions(spoken: Sequence[str], domain: Domain) -> list[Atom]:
    if domain is Domain.NAVIGATION:
        return [Atom("at", (Name("robot"), Name("_".join(spoken))))]
    known = _propositions(domain)
    return [known.get(word, Atom(word)) for word in spoken]


@lru_cache(maxsize=1_000)
def _shape(marks: tuple[str, ...]) -> Formula | None:
    """The formula over `p0`, `p1`, ...: there are few shapes, so they are parsed once."""
    try:
        formula = parse(" ".join(marks))
    except CqltlError:  # malformed, or larger than a formula may be
        return None
    return None if any(atom.arguments for atom in atoms(formula)) else formula  # `p0 ( p1 )`: no operator between


def _spell(formula: Formula, domain: Domain) -> Iterator[str]:
    match formula:
        case Unary(op=Op.FINALLY, operand=operand):
            yield from (EVENTUALLY, OPEN, *_spell(operand, domain), CLOSE)
        case Nary(op=Op.AND, operands=operands):
            for index, operand in enumerate(operands):
                yield from ((AND,) if index else ())
                yield from _spell(operand, domain)
        case Atom():
            yield from _proposition(formula, domain)
        case _:
            raise ValueError(f"no task of the datasets has {formula}")


def _proposition(atom: Atom, domain: Domain) -> Sequence[str]:
    names = [term.text for term in atom.arguments if isinstance(term, Name)]
    if domain is Domain.NAVIGATION:
        return names[-1].split("_")
    return [_compound(atom, domain)]


def _compound(atom: Atom, domain: Domain) -> str:
    """The atom as one word, by the first display pattern of its function."""
    function = _functions(domain)[atom.function]
    names = {
        parameter.name: term.text
        for parameter, term in zip(function.parameters, atom.arguments, strict=True)
        if isinstance(term, Name)
    }
    return function.display[0].format_map(names)


@cache
def _functions(domain: Domain) -> Mapping[str, Function]:
    return load_environment(grounding_environment(domain, Part.SEEN)).functions


@cache
def _propositions(domain: Domain) -> Mapping[str, Atom]:
    """Every atom that a task class has with some objects and values of the vocabularies, by its word."""
    corpus = read_corpus(domain)
    found = {}
    for task, part in product(corpus.tasks, Part):
        lifted = atoms(parse(task.ltl.format_map({slot: slot for slot in task.arguments})))
        for atom in lifted:
            for filled in _filled(atom, corpus.vocabulary[part]):
                found[_compound(filled, domain)] = filled
    return found


def _filled(atom: Atom, vocabulary: Mapping[str, Sequence[Word]]) -> Iterator[Atom]:
    """The atom with every choice of words in the places of its slots; other names stay."""
    names = [term.text for term in atom.arguments if isinstance(term, Name)]
    choices = [[word.symbol for word in vocabulary[name]] if name in vocabulary else [name] for name in names]
    for choice in product(*choices):
        yield Atom(atom.function, tuple(map(Name, choice)))

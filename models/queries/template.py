"""Templated LTL: lifted LTL tied to the argument positions of a contextual query, and its evaluation."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from functools import partial
from math import prod

from models.errors import Place
from models.logic import (
    Atom,
    Formula,
    FormulaTooLargeError,
    Name,
    Nary,
    Op,
    Parameter,
    Term,
    Unary,
    atoms,
    children,
    conjunction,
    disjunction,
    substitute,
)
from models.queries.contextual_query import ContextualQuery
from models.queries.errors import AmbiguousGroundingError, ArityMismatchError
from models.world import (
    Candidate,
    Environment,
    Grounding,
    PartOfSpeech,
    Quantifier,
    TypeMismatchError,
    UnknownObjectError,
    UnknownPropositionError,
    distinct_name,
    ground,
    resolve,
    speaks_of_others,
    suggest,
    with_article,
    with_values,
)

Kinds = frozenset[str]
"""Class names or attribute types an argument may have."""


@dataclass(frozen=True, slots=True)
class Template:
    """Templated LTL of one task class: `F (in($1, $2) & F (in($1, $2) & at($2, $3)))` for `ship`.

    `kinds[i]` are the kinds that argument `i + 1` may have, from the propositional functions it feeds. `taught[i]` are
    those of the things it was learned with, which decide when a phrase fits objects of several kinds: who taught
    `pickup(sphere)` with a toy means the toy by "the bag", and not the box of that name. Empty when not known.
    """

    task: str
    formula: Formula
    lifted: Formula
    kinds: tuple[Kinds, ...]
    taught: tuple[Kinds, ...] = ()

    @property
    def arity(self) -> int:
        """Number of arguments of the task."""
        return len(self.kinds)


MAX_COMBINATIONS = 64
"""Most ways to choose a thing for each argument that speaks of several ("any toy", "every box")."""


@dataclass(frozen=True, slots=True)
class Binding:
    """What one argument grounded to: 1-based position, phrase, and the thing or value with why; with the quantifiers
    `ANY` and `ALL` the things.
    """

    position: int
    phrase: str
    candidates: tuple[Candidate, ...]
    quantifier: Quantifier = Quantifier.ONE

    @property
    def candidate(self) -> Candidate:
        """The one thing, or the first of several."""
        return self.candidates[0]


@dataclass(frozen=True, slots=True)
class GroundedTask:
    """A contextual query evaluated: grounded LTL and the binding of every argument."""

    query: ContextualQuery
    formula: Formula
    bindings: tuple[Binding, ...]
    filled: Callable[[Sequence[Binding]], Formula] | None = field(default=None, compare=False, repr=False)
    """The formula for other bindings of the arguments; None where there is no environment to bind them in."""

    def rebound(self, bindings: tuple[Binding, ...]) -> GroundedTask:
        """The task with other bindings."""
        if self.filled is None or bindings == self.bindings:
            return self
        return replace(self, formula=self.filled(bindings), bindings=bindings)


def parameter_kinds(formula: Formula, environment: Environment, arity: int) -> tuple[Kinds, ...]:
    """For each position, the kinds that every propositional function it feeds accepts in this environment.

    Raises:
        UnknownPropositionError: the environment lacks a propositional function of the formula.
        TypeMismatchError: a parameter feeds functions that share no kind.
    """
    kinds: list[Kinds | None] = [None] * arity
    for atom in atoms(formula):
        positions = [(place, term) for place, term in enumerate(atom.arguments) if isinstance(term, Parameter)]
        if not positions:
            continue
        function = environment.functions.get(atom.function)
        if function is None or len(function.parameters) != len(atom.arguments):
            raise UnknownPropositionError(
                f"the template needs {atom.function} with {_count(atom.arguments)}, "
                f"which {environment.name} does not have"
            )
        for place, term in positions:
            accepted, index = function.parameters[place].kinds, term.position - 1
            before = kinds[index]
            kinds[index] = accepted if before is None else before & accepted
            if not kinds[index]:
                raise TypeMismatchError(f"${term.position} feeds propositional functions that share no kind")
    return tuple(frozenset() if found is None else found for found in kinds)


def evaluate(
    template: Template,
    query: ContextualQuery,
    environment: Environment,
    *,
    parts_of_speech: Sequence[PartOfSpeech | None] | None = None,
) -> GroundedTask:
    """Ground the query's arguments and put them into the template, all at once (paper, § Lifted LTL and Templated LTL).

    An argument that speaks of several things ("any red toy", "every box") makes the formula the disjunction, or the
    conjunction, of the formulas for each of them; of several such arguments the first is outermost.

    Args:
        parts_of_speech: per argument what a tagger said of it in its sentence, where that is known.

    Raises:
        ArityMismatchError: the query has more or fewer arguments than the template.
        UnknownObjectError: a phrase names nothing in the environment.
        TypeMismatchError: a phrase names only things that the place does not take.
        AmbiguousGroundingError: a phrase fits several things, and all others fit something.
        UnknownPropositionError: the environment lacks a propositional function of the template.
        FormulaTooLargeError: there are more than `MAX_COMBINATIONS` ways to choose from the things spoken of.
    """
    check_arity(template, query)
    kinds = parameter_kinds(template.formula, environment, template.arity)
    tags = parts_of_speech or [None] * template.arity
    bindings = []
    doubt: AmbiguousGroundingError | None = None
    for index, phrase in enumerate(query.arguments):
        taught = template.taught[index] if template.taught else frozenset()
        said = _describing(template, query, index, kinds, environment)
        try:
            found = _ground_argument(query, index, kinds[index], environment, tags[index], said, taught)
        except AmbiguousGroundingError as error:
            doubt = doubt or error  # no use in asking which, when another phrase names nothing
            continue
        bindings.append(Binding(index + 1, phrase, found.candidates, found.quantifier))
    if doubt is not None:
        raise doubt
    combinations = prod(len(binding.candidates) for binding in bindings)
    if combinations > MAX_COMBINATIONS:
        detail = f"{query} has {combinations} combinations of things in {environment.name}; at most {MAX_COMBINATIONS}"
        raise FormulaTooLargeError(detail)
    filled = partial(_filled, template.formula, environment)
    return GroundedTask(query, filled(bindings), tuple(bindings), filled)


def _filled(formula: Formula, environment: Environment, bindings: Sequence[Binding]) -> Formula:
    """The formula of a template with every parameter bound; the first quantifier is outermost."""

    def chosen(left: Sequence[Binding], terms: dict[Term, Term]) -> Formula:
        if not left:
            return resolve(formula, environment, terms)
        binding, *later = left
        names = (Name(distinct_name(candidate.symbol, environment)) for candidate in binding.candidates)
        formulas = [chosen(later, {**terms, Parameter(binding.position): name}) for name in names]
        return (conjunction if binding.quantifier is Quantifier.ALL else disjunction)(*formulas)

    return chosen(bindings, {})


def put_in(template: Template, query: ContextualQuery) -> GroundedTask:
    """The template with the phrases themselves as names, for where there is no environment to ground them in.

    Raises:
        ArityMismatchError: the query has more or fewer arguments than the template.
    """
    check_arity(template, query)
    terms: dict[Term, Term] = {
        Parameter(position): Name(phrase) for position, phrase in enumerate(query.arguments, start=1)
    }
    return GroundedTask(query, substitute(template.formula, terms), ())


def check_arity(template: Template, query: ContextualQuery) -> None:
    """Raises `ArityMismatchError` unless the query has as many arguments as the template."""
    if len(query.arguments) != template.arity:
        detail = f"{query.task} takes {template.arity} arguments, not {len(query.arguments)}"
        raise ArityMismatchError(detail, places=[Place("", detail)])


def nothing_called(phrase: str, environment: Environment, kinds: Kinds | None = None) -> str:
    """That a phrase names nothing, as a sentence, with what it may be a misspelling of."""
    verb = "fits" if speaks_of_others(phrase, environment) else "is called"
    sentence = f'nothing in {environment.name} {verb} "{phrase}"'
    near = suggest(phrase, environment, kinds=kinds)
    return f"{sentence} (did you mean {' or '.join(near)}?)" if near else sentence


@dataclass(frozen=True, slots=True)
class _Description:
    """An argument with the attribute values that the template says of it, and the types of these values."""

    phrase: str
    types: Kinds


def _describing(
    template: Template, query: ContextualQuery, index: int, kinds: Sequence[Kinds], environment: Environment
) -> _Description:
    """What the template says of an argument: "red toy" for `$1` of `colored($1, $2)` in `pickup_colored(toy, red)`;
    just the argument when it says nothing.
    """
    values_at = {place for place, accepted in enumerate(kinds) if place != index and _are_values(accepted, environment)}
    others = sorted(values_at & _beside(template.formula, index)) if values_at else []
    values = [query.arguments[position] for position in others]
    types = frozenset[str]().union(*(kinds[position] for position in others))
    return _Description(with_values(query.arguments[index], values) if values else query.arguments[index], types)


def _beside(formula: Formula, index: int) -> set[int]:
    """The places of the parameters that stand in an atom beside the one at a place, where the atom is demanded."""
    beside = (atom.arguments for atom in _demanded(formula) if Parameter(index + 1) in atom.arguments)
    return {term.position - 1 for terms in beside for term in terms if isinstance(term, Parameter)}


def _demanded(formula: Formula) -> Iterator[Atom]:
    """The atoms that hold at some time in every run that satisfies the formula, as far as its form shows it: those
    under `&`, `F`, `G` and `X` alone. What is negated or one of several choices describes nothing.
    """
    stack = [formula]
    while stack:
        node = stack.pop()
        if isinstance(node, Atom):
            yield node
        elif (isinstance(node, Unary) and node.op is not Op.NOT) or (isinstance(node, Nary) and node.op is Op.AND):
            stack.extend(children(node))


def _are_values(kinds: Kinds, environment: Environment) -> bool:
    return bool(kinds) and kinds.isdisjoint(environment.vocabulary.class_words)


def _undescribed(
    candidates: Sequence[Candidate], said: _Description, environment: Environment
) -> tuple[Candidate, ...]:
    """Those of which the environment does not say what they are like, so that a description contradicts nothing."""
    static = environment.vocabulary.static
    return tuple(c for c in candidates if said.types.isdisjoint(v.kind for v in static.get(c.symbol, {}).values()))


def _ground_argument(
    query: ContextualQuery,
    index: int,
    kinds: Kinds,
    environment: Environment,
    pos: PartOfSpeech | None,
    said: _Description,
    taught: Kinds,
) -> Grounding:
    phrase, pointer = query.arguments[index], f"/arguments/{index}"
    found = ground(phrase, environment, kinds=kinds, pos=pos)
    candidates = found.candidates
    if len(candidates) != 1 and said.phrase != phrase:
        phrase = said.phrase
        candidates = ground(phrase, environment, kinds=kinds).candidates or _undescribed(candidates, said, environment)
    if candidates and found.quantifier is not Quantifier.ONE:
        return replace(found, candidates=candidates)
    if len(candidates) > 1 and all(environment.vocabulary.is_object(c.symbol) for c in candidates):
        candidates = tuple(c for c in candidates if c.symbol.kind in taught) or candidates
    if len(candidates) == 1:
        return replace(found, candidates=candidates)
    if candidates:
        names = ", ".join(candidate.symbol.name for candidate in candidates)
        detail = f'"{phrase}" fits several in {environment.name}: {names}'
        raise AmbiguousGroundingError(
            detail, position=index + 1, phrase=phrase, candidates=candidates, places=[Place(pointer, detail)]
        )
    wanted = with_article(" or ".join(sorted(kinds)))
    elsewhere = ground(phrase, environment).candidates
    if elsewhere and elsewhere[0].misspelt is None:
        other = elsewhere[0].symbol
        detail = f"argument {index + 1} of {query.task} must be {wanted}; "
        detail += f'"{phrase}" is {other.name}, {with_article(other.kind)}'
        raise TypeMismatchError(detail, places=[Place(pointer, detail)])
    detail = f"{nothing_called(phrase, environment, kinds)}; argument {index + 1} of {query.task} is {wanted}"
    raise UnknownObjectError(detail, places=[Place(pointer, detail)])


def _count(arguments: Sequence[object]) -> str:
    return "1 argument" if len(arguments) == 1 else f"{len(arguments)} arguments"

"""Grounding as the paper does it: by name alone, with neither the type of a place nor the part of speech of a word."""

from __future__ import annotations

from models.errors import CqltlError
from models.language.experiments.answer import Answer
from models.logic import Name, Parameter, Term
from models.queries import AmbiguousGroundingError, ArityMismatchError, ContextualQuery, Template
from models.world import Environment, Symbol, UnknownObjectError, distinct_name, resolve

ATTRIBUTES = frozenset({"color"})
"""The attributes that tasks speak of. The toys domain has shapes too, one of them `cylinder`; so have the toys of the
paper, which still counts only `orange` and `bag` as homonyms."""


def answer_by_name(template: Template, query: ContextualQuery, environment: Environment) -> Answer:
    """The query put into its template (paper, § Lifted LTL and Templated LTL), each argument grounded by its name.

    A phrase that names two things of the environment, such as the homonyms `orange` and `bag`, is ambiguous, even where
    only one of them fits (paper, § Discussion).
    """
    if len(query.arguments) != template.arity:
        return Answer(query, refusal=ArityMismatchError.slug)
    terms: dict[Term, Term] = {}
    for position, phrase in enumerate(query.arguments, start=1):
        named = _named(phrase, environment)
        if len(named) != 1:
            return Answer(query, refusal=(AmbiguousGroundingError if named else UnknownObjectError).slug)
        terms[Parameter(position)] = Name(distinct_name(named[0], environment))
    try:
        return Answer(query, resolve(template.formula, environment, terms))
    except CqltlError as error:
        return Answer(query, refusal=error.slug)


def _named(phrase: str, environment: Environment) -> tuple[Symbol, ...]:
    vocabulary = environment.vocabulary
    found = vocabulary.loosely_named(phrase)
    return tuple(symbol for symbol in found if vocabulary.is_object(symbol) or symbol.kind in ATTRIBUTES)

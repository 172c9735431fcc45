"""Contextual queries, lifting and templates: the CQ-LTL algorithm of the paper.

contextual query + grounded LTL  ──learn──►  Template  ──evaluate(query, environment)──►  grounded LTL
                                                            several of them ──evaluate_query──►  grounded LTL
"""

from models.queries.contextual_query import (
    MAX_ARGUMENTS,
    MAX_NESTING,
    MAX_PARTS,
    MAX_QUERY_TEXT,
    OPERATORS,
    Composition,
    ContextualQuery,
    Operator,
    Query,
)
from models.queries.errors import (
    AmbiguousGroundingError,
    AmbiguousParameterMappingError,
    ArityMismatchError,
    CompositionError,
    ExplanationError,
    InconsistentExamplesError,
    QuerySyntaxError,
    UnusedParameterError,
)
from models.queries.evaluation import GroundedQuery, Path, evaluate_query, pointer_of
from models.queries.explanation import MAX_WORDS, QueryPart, check_words, explain_query
from models.queries.learning import Example, learn
from models.queries.lifting import LiftedFormula, lift, resolve_grounded
from models.queries.meaning import compose
from models.queries.query_text import parse_query, parse_task
from models.queries.review import review, review_composition
from models.queries.template import Binding, GroundedTask, Template, check_arity, evaluate, parameter_kinds, put_in

__all__ = [
    "MAX_ARGUMENTS",
    "MAX_NESTING",
    "MAX_PARTS",
    "MAX_QUERY_TEXT",
    "MAX_WORDS",
    "OPERATORS",
    "AmbiguousGroundingError",
    "AmbiguousParameterMappingError",
    "ArityMismatchError",
    "Binding",
    "Composition",
    "CompositionError",
    "ContextualQuery",
    "Example",
    "ExplanationError",
    "GroundedQuery",
    "GroundedTask",
    "InconsistentExamplesError",
    "LiftedFormula",
    "Operator",
    "Path",
    "Query",
    "QueryPart",
    "QuerySyntaxError",
    "Template",
    "UnusedParameterError",
    "check_arity",
    "check_words",
    "compose",
    "evaluate",
    "evaluate_query",
    "explain_query",
    "learn",
    "lift",
    "parameter_kinds",
    "parse_query",
    "parse_task",
    "pointer_of",
    "put_in",
    "resolve_grounded",
    "review",
    "review_composition",
]

"""Contextual queries, lifting and templates: the CQ-LTL algorithm of the paper.

contextual query + grounded LTL  ──learn──►  Template  ──evaluate(query, environment)──►  grounded LTL
"""

from models.queries.contextual_query import (
    MAX_ARGUMENTS,
    MAX_QUERY_TEXT,
    ContextualQuery,
    parse_query,
)
from models.queries.errors import (
    AmbiguousGroundingError,
    AmbiguousParameterMappingError,
    ArityMismatchError,
    InconsistentExamplesError,
    QuerySyntaxError,
    UnusedParameterError,
)
from models.queries.learning import Example, learn
from models.queries.lifting import LiftedFormula, lift, resolve_grounded
from models.queries.review import review
from models.queries.template import Binding, GroundedTask, Template, check_arity, evaluate, parameter_kinds

__all__ = [
    "MAX_ARGUMENTS",
    "MAX_QUERY_TEXT",
    "AmbiguousGroundingError",
    "AmbiguousParameterMappingError",
    "ArityMismatchError",
    "Binding",
    "ContextualQuery",
    "Example",
    "GroundedTask",
    "InconsistentExamplesError",
    "LiftedFormula",
    "QuerySyntaxError",
    "Template",
    "UnusedParameterError",
    "check_arity",
    "evaluate",
    "learn",
    "lift",
    "parameter_kinds",
    "parse_query",
    "resolve_grounded",
    "review",
]

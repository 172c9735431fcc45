"""Object-oriented worlds: the language, built-in domains, compiled dynamics, grounding of names and phrases."""

from models.world.builders import navigation_spec, toys_spec
from models.world.description import Candidate, with_article
from models.world.domain import Function, FunctionParameter
from models.world.environment import Environment, compile_world
from models.world.errors import (
    StateError,
    TypeMismatchError,
    UnknownObjectError,
    UnknownPropositionError,
    WorldError,
)
from models.world.explanation import explain
from models.world.explicit import ExplicitWorld
from models.world.factors import Factored, FactoredAction, Range
from models.world.grounding import Grounding, PartOfSpeech, ground, speaks_of_others
from models.world.idling import IdlingWorld
from models.world.library import builtin_environments
from models.world.loading import load_environment
from models.world.mentions import mentions
from models.world.oomdp import OomdpWorld
from models.world.outline import Part, outline
from models.world.projection import ProjectedWorld, Projection
from models.world.quantifiers import Quantifier, quantified, widened, with_values
from models.world.reachable import ReachableWorld, reachable_part
from models.world.relevance import relevant_part, relevant_parts
from models.world.resolution import atom_symbols, distinct_name, resolve
from models.world.specs import DomainSpec, EnvironmentSpec, ExplicitSpec, OomdpSpec
from models.world.suggestion import suggest
from models.world.transitions import STAY, Transitions
from models.world.vocabulary import Symbol
from models.world.world import Outcomes, State, Variable, World

__all__ = [
    "STAY",
    "Candidate",
    "DomainSpec",
    "Environment",
    "EnvironmentSpec",
    "ExplicitSpec",
    "ExplicitWorld",
    "Factored",
    "FactoredAction",
    "Function",
    "FunctionParameter",
    "Grounding",
    "IdlingWorld",
    "OomdpSpec",
    "OomdpWorld",
    "Outcomes",
    "Part",
    "PartOfSpeech",
    "ProjectedWorld",
    "Projection",
    "Quantifier",
    "Range",
    "ReachableWorld",
    "State",
    "StateError",
    "Symbol",
    "Transitions",
    "TypeMismatchError",
    "UnknownObjectError",
    "UnknownPropositionError",
    "Variable",
    "World",
    "WorldError",
    "atom_symbols",
    "builtin_environments",
    "compile_world",
    "distinct_name",
    "explain",
    "ground",
    "load_environment",
    "mentions",
    "navigation_spec",
    "outline",
    "quantified",
    "reachable_part",
    "relevant_part",
    "relevant_parts",
    "resolve",
    "speaks_of_others",
    "suggest",
    "toys_spec",
    "widened",
    "with_article",
    "with_values",
]

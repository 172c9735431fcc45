"""The shape of domains and environments as data; also the HTTP schema.

Only the shape is checked here (which keys, which plain types). What the names and expressions mean is checked
by `domain.read_domain` and `loading.load_environment`. YAML and JSON read `0.9` and `true` as a number and a truth
value; where an expression is expected they become its text.
"""

from __future__ import annotations

from math import isfinite
from typing import Annotated, Literal, Self

from pydantic import BaseModel, BeforeValidator, ConfigDict, Field, TypeAdapter, model_validator

from models.world.limits import MAX_EXPLICIT_STATES, MAX_SAMPLES, MAX_TEXT


class _Spec(BaseModel):
    model_config = ConfigDict(extra="forbid", strict=True, frozen=True, populate_by_name=True)


def _expression_text(value: object) -> str:
    """`0.9` -> `"0.9"`, `True` -> `"true"`; text stays."""
    if isinstance(value, str):
        return value
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, int) and abs(value) < _LARGEST_INTEGER:
        return str(value)
    if isinstance(value, float) and isfinite(value):
        return repr(value)
    raise ValueError("an expression is text, a finite number, true or false")


_LARGEST_INTEGER = 10**300  # as a float it is finite
_READ = "A number or truth value is read too."
Text = Annotated[str, BeforeValidator(_expression_text)]
"""The text of an expression; in the schema a string."""
_NAME = "Name of the environment: one segment of a URL path, so no `/`, and not `.` or `..`."
_State = Annotated[int, Field(ge=0, lt=MAX_EXPLICIT_STATES)]


class ParameterSpec(_Spec):
    """A number that an environment may set."""

    default: float = Field(allow_inf_nan=False, description="Value unless the environment gives another.")
    minimum: float | None = Field(None, allow_inf_nan=False, description="Least value allowed.")
    maximum: float | None = Field(None, allow_inf_nan=False, description="Greatest value allowed.")


class OrderSpec(_Spec):
    """What else is said of an attribute type whose values are listed from the least to the most."""

    less: list[str] = Field(
        default_factory=list, description="Further adjectives for the first value, such as `little`."
    )
    more: list[str] = Field(default_factory=list, description="Further adjectives for the last value, such as `big`.")


class ClassSpec(_Spec):
    """A class of objects and the attributes that its objects have."""

    static: dict[str, str] = Field(
        default_factory=dict,
        description="Attributes that never change: name to kinds, for example `cell | none`.",
    )
    state: dict[str, str] = Field(
        default_factory=dict,
        description="Attributes that actions change: name to kinds. Each is a state variable.",
    )
    words: list[str] = Field(default_factory=list, description="Nouns for any object of the class, besides its name.")


class DefinitionSpec(_Spec):
    """A named expression for use in other expressions."""

    arguments: list[str] = Field(default_factory=list, description="`name: kinds` each, for example `x: box | toy`.")
    expression: Text = Field(alias="is", description=f"The value: an expression. {_READ}")


class FunctionSpec(DefinitionSpec):
    """A propositional function: a Boolean expression that formulas may use."""

    says: str | None = Field(None, description="English reading with the arguments in braces: `{x} is at {c}`.")
    denies: str | None = Field(None, description="English reading of the negation; derived from `says` by default.")
    display: list[str] = Field(default_factory=list, description="Compound names of its atoms: `{x}_at_{c}`.")


class OutcomeSpec(_Spec):
    """One thing that may happen when an action is done."""

    probability: Text = Field("1", description="Numeric expression. A number is read too.")
    set: dict[str, Text] = Field(
        default_factory=dict,
        description=f"`object.attribute` to its new value; all expressions read the state before. {_READ}",
    )


class ActionSpec(_Spec):
    """An action of the robot."""

    arguments: list[str] = Field(default_factory=list, description="`name: kinds` each.")
    when: Text = Field("true", description=f"Boolean expression: where the action is possible. {_READ}")
    outcomes: list[OutcomeSpec] = Field(min_length=1, description="Their probabilities sum to 1 where it is possible.")
    cost: Text = Field("1", description="What it costs to do it: a positive number, of parameters only.")


class DomainSpec(_Spec):
    """A kind of world: classes, propositional functions, actions."""

    name: str = Field(description="Name of the domain.")
    parameters: dict[str, ParameterSpec] = Field(default_factory=dict, description="Numbers environments may set.")
    attributes: dict[str, list[str]] = Field(default_factory=dict, description="Attribute types and their values.")
    ordered: dict[str, OrderSpec] = Field(
        default_factory=dict,
        description="The attribute types whose values are listed from the least to the most: they can be compared "
        "in phrases (`the smaller box`).",
    )
    classes: dict[str, ClassSpec] = Field(description="Classes of objects.")
    constants: dict[str, str] = Field(
        default_factory=dict, description="Objects that every environment has: name to class."
    )
    define: dict[str, DefinitionSpec] = Field(default_factory=dict, description="Named expressions.")
    functions: dict[str, FunctionSpec] = Field(default_factory=dict, description="Propositional functions.")
    actions: dict[str, ActionSpec] = Field(default_factory=dict, description="Actions.")
    constraints: list[Text] = Field(
        default_factory=list, description=f"Boolean expressions true in every legal state. {_READ}"
    )


class ObjectSpec(_Spec):
    """An object."""

    class_: str = Field(alias="class", description="Its class.")
    synonyms: list[str] = Field(default_factory=list, description="Other names people use for it.")
    attributes: dict[str, str] = Field(default_factory=dict, description="Values of its static attributes.")


class GridSpec(_Spec):
    """Cells drawn as a map; sets their `north`, `south`, `east` and `west`."""

    class_: str = Field(alias="class", description="The class of the cells.")
    map: list[str] = Field(
        min_length=1,
        description="Rows from the north: `#` no cell, `.` a cell with a generated name, others as in `names`.",
    )
    names: dict[str, str] = Field(default_factory=dict, description="Character of the map to the cell's name.")
    walls: list[list[str]] = Field(default_factory=list, description="Pairs of neighbouring cells with a wall between.")


_Sample = Annotated[str, Field(min_length=1, max_length=MAX_TEXT)]


class LessonSpec(_Spec):
    """A task to teach in this world, for whoever tries it: what a `/learn` request needs."""

    text: _Sample = Field(description="An utterance of the task.")
    contextual_query: _Sample = Field(description="The query that it stands for.")
    ltl: _Sample = Field(description="What that means here: grounded LTL.")


class OomdpSpec(_Spec):
    """An environment of an object-oriented MDP domain: exactly one of `domain` and `domain_spec`."""

    kind: Literal["oomdp"] = Field(description="`oomdp`: objects, and actions on them.")
    name: str = Field(description=_NAME)
    domain: str | None = Field(None, description="Name of a built-in domain.")
    domain_spec: DomainSpec | None = Field(None, description="The domain, written out.")
    parameters: dict[str, Annotated[float, Field(allow_inf_nan=False)]] = Field(
        default_factory=dict, description="Values of the domain's parameters."
    )
    values: dict[str, list[str]] = Field(default_factory=dict, description="More values of attribute types.")
    grid: GridSpec | None = Field(None, description="Cells drawn as a map.")
    objects: dict[str, ObjectSpec] = Field(default_factory=dict, description="Objects by name.")
    state: dict[str, dict[str, str]] = Field(
        default_factory=dict, description="Initial state: object to state attribute to value."
    )
    samples: list[_Sample] = Field(
        default_factory=list,
        max_length=MAX_SAMPLES,
        description="Commands to try here, for people. Nothing reads them.",
    )
    lessons: list[LessonSpec] = Field(
        default_factory=list, max_length=MAX_SAMPLES, description="Tasks to teach here, for people. Nothing reads them."
    )

    @model_validator(mode="after")
    def _one_domain(self) -> Self:
        if (self.domain is None) == (self.domain_spec is None):
            raise ValueError("give exactly one of domain and domain_spec")
        return self


class TransitionSpec(_Spec):
    """What one action does in one state."""

    source: _State = Field(alias="from", description="State in which the action is possible.")
    action: str = Field(min_length=1, description="Name of the action.")
    cost: Annotated[float, Field(gt=0, allow_inf_nan=False)] = Field(1.0, description="What it costs to do it.")
    to: list[Annotated[list[Annotated[float, Field(allow_inf_nan=False)]], Field(min_length=2, max_length=2)]] = Field(
        min_length=1, description="Pairs of successor state and probability."
    )


class ExplicitSpec(_Spec):
    """A Markov decision process listed state by state."""

    kind: Literal["explicit"] = Field(description="`explicit`: states and transitions.")
    name: str = Field(description=_NAME)
    states: int = Field(ge=1, le=MAX_EXPLICIT_STATES, description="Number of states.")
    initial: _State = Field(0, description="Initial state.")
    labels: dict[str, list[_State]] = Field(
        default_factory=dict, description="Nullary proposition to the states in which it holds."
    )
    transitions: list[TransitionSpec] = Field(default_factory=list, description="Transitions; the rest do not exist.")


EnvironmentSpec = Annotated[OomdpSpec | ExplicitSpec, Field(discriminator="kind")]
"""An environment, told apart by `kind`."""

ENVIRONMENT: TypeAdapter[OomdpSpec | ExplicitSpec] = TypeAdapter(EnvironmentSpec)
DOMAIN = TypeAdapter(DomainSpec)

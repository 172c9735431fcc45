"""Shapes of requests and responses (docs/http.md)."""

from __future__ import annotations

from typing import Annotated, Literal, Self

from pydantic import BaseModel, ConfigDict, Field, model_validator

from models.world import EnvironmentSpec
from service.http.problems import ErrorPlace

MAX_COMMAND = 2_000
MAX_FORMULA = 65_536

Command = Annotated[str, Field(max_length=MAX_COMMAND, examples=["Pickup the sphere"])]
QueryText = Annotated[str, Field(max_length=4_096, examples=["ship(cylinder, box, bedroom)"])]
FormulaText = Annotated[str, Field(max_length=MAX_FORMULA, examples=["F (in(cylinder, box) & F at(box, bedroom))"])]
EnvironmentName = Annotated[str, Field(max_length=200, examples=["toys"])]
State = Annotated[
    dict[str, dict[str, str]],
    Field(description="Object to attribute to value; what is left out is as in the initial state."),
]
TranslatorName = Annotated[
    Literal["default", "cq-copynet"], Field(description="`default` is cq-copynet after the taught wordings.")
]


class Request(BaseModel):
    """A request body; unknown members are refused."""

    model_config = ConfigDict(extra="forbid")


class ContextualQueryOut(BaseModel):
    """A contextual query as text and in parts."""

    text: str
    task: str
    arguments: list[str]


class BindingOut(BaseModel):
    """What an argument grounded to."""

    argument: int = Field(description="Position of the argument, from 1.")
    phrase: str
    name: str = Field(description="The object or attribute value.")
    kind: str = Field(description="Its class or attribute type.")
    reason: str = Field(description="Why the phrase names it.")


class TranslateRequest(Request):
    """A command to translate."""

    text: Command
    environment: EnvironmentName | None = Field(None, description="Where to ground; without it `ltl` is null.")
    translator: TranslatorName = "default"
    candidates: int = Field(1, ge=1, le=10, description="How many readings to return at most.")


class BatchRequest(Request):
    """Commands to translate."""

    texts: list[Command] = Field(min_length=1, max_length=100)
    environment: EnvironmentName | None = None
    translator: TranslatorName = "default"
    candidates: int = Field(1, ge=1, le=10)


class CandidateOut(BaseModel):
    """One reading of a command."""

    contextual_query: ContextualQueryOut
    ltl: str | None = Field(description="Grounded LTL; null when it cannot be grounded, see `issues`.")
    confidence: float = Field(description="Probability that the translator gives this reading.")
    explanation: str | None = Field(description="The formula read back in English.")
    bindings: list[BindingOut]
    warnings: list[str] = Field(description="What to know of the task's template; see `GET /templates/{task}`.")
    issues: list[ErrorPlace] = Field(description="Why there is no `ltl`.")


class QuestionOut(BaseModel):
    """A question to ask back."""

    argument: int = Field(description="Position of the argument in doubt, from 1.")
    text: str
    choices: list[str]


class TranslateResponse(BaseModel):
    """What a command was understood as."""

    text: str
    outcome: Literal["translated", "ambiguous", "unknown"]
    contextual_query: ContextualQueryOut | None
    ltl: str | None
    confidence: float | None
    explanation: str | None
    bindings: list[BindingOut]
    candidates: list[CandidateOut]
    question: QuestionOut | None
    warnings: list[str]
    issues: list[ErrorPlace]


class BatchResponse(BaseModel):
    """Translations in the order of the texts."""

    items: list[TranslateResponse]


class PairIn(Request):
    """A contextual query with its grounded LTL."""

    contextual_query: QueryText
    ltl: FormulaText


class LearnRequest(PairIn):
    """One example of a task; `more` are further examples of the same task, whose possible mappings are intersected."""

    environment: EnvironmentName
    more: list[PairIn] = Field(default_factory=list, max_length=20)
    examples: list[Command] = Field(
        default_factory=list, max_length=50, description="Utterances of the first example's query."
    )
    replace: bool = Field(False, description="Put this template in the place of another one of the task.")


class ParameterOut(BaseModel):
    """One parameter of a template."""

    position: int = Field(description="From 1; `$1` in the template.")
    type: str = Field(description="The kinds it may have, for example `toy` or `box | toy`.")


class PairOut(BaseModel):
    """What a template was learned from."""

    contextual_query: str
    ltl: str
    environment: str


class TemplateOut(BaseModel):
    """A task class."""

    task: str
    arity: int
    parameters: list[ParameterOut]
    template: str = Field(description="Templated LTL.")
    lifted: str = Field(description="Lifted LTL of the first example.")
    pairs: list[PairOut]
    examples: list[str]
    revision: int
    warnings: list[str]


class TemplateList(BaseModel):
    """A page of templates."""

    items: list[TemplateOut]
    next: str | None = Field(description="Pass as `cursor` for the next page; null on the last.")


class GroundRequest(Request):
    """A contextual query to evaluate."""

    contextual_query: QueryText
    environment: EnvironmentName


class GroundResponse(BaseModel):
    """Grounded LTL."""

    contextual_query: ContextualQueryOut
    ltl: str
    explanation: str
    bindings: list[BindingOut]
    warnings: list[str] = Field(description="What to know of the task's template.")


class EnvironmentSummary(BaseModel):
    """One environment of a list."""

    name: str
    kind: str
    revision: int


class EnvironmentOut(EnvironmentSummary):
    """A stored environment."""

    spec: EnvironmentSpec


class EnvironmentList(BaseModel):
    """A page of environments."""

    items: list[EnvironmentSummary]
    next: str | None = Field(description="Pass as `cursor` for the next page; null on the last.")


class PlanOptions(Request):
    """Accuracy and limits."""

    epsilon: float = Field(1e-6, ge=1e-12, lt=1, description="Most that upper and lower probability may differ.")
    timeout_s: float = Field(30.0, gt=0, allow_inf_nan=False, description="Longest planning time, in seconds.")
    max_states: int = Field(50_000_000, ge=1, description="Most product states.")
    device: Literal["auto", "cpu", "cuda"] = "auto"


class PlanRequest(Request):
    """What to plan: exactly one of `text`, `contextual_query`, `ltl`, and one of `environment`, `environment_spec`."""

    text: Command | None = None
    contextual_query: QueryText | None = None
    ltl: FormulaText | None = None
    environment: EnvironmentName | None = None
    environment_spec: EnvironmentSpec | None = None
    state: State | None = None
    translator: TranslatorName = "default"
    options: PlanOptions = Field(default_factory=PlanOptions)

    @model_validator(mode="after")
    def _exactly_one(self) -> Self:
        for names in (("text", "contextual_query", "ltl"), ("environment", "environment_spec")):
            if sum(getattr(self, name) is not None for name in names) != 1:
                raise ValueError(f"give exactly one of {', '.join(names)}")
        return self


class PolicyRow(BaseModel):
    """One policy of a list."""

    id: str
    environment: str
    ltl: str


class PolicyList(BaseModel):
    """A page of policies."""

    items: list[PolicyRow]
    next: str | None = Field(description="Pass as `cursor` for the next page; null on the last.")


class Bounds(BaseModel):
    """An interval that holds the true value."""

    lower: float
    upper: float


class Situation(BaseModel):
    """A state, and the memory to send with it."""

    state: State
    memory: int


class TrajectoryStep(Situation):
    """One step of a run; the last has no action."""

    action: str | None


class PolicySummary(BaseModel):
    """Where the policy is."""

    id: str
    url: str
    memories: int = Field(description="Number of memory states.")
    states: int = Field(description="Number of state indices.")


class ModelSize(BaseModel):
    """How large the problem was."""

    states: int
    product_states: int
    automaton_states: int


class Timing(BaseModel):
    """Wall-clock seconds; the only part of a response that differs between equal requests."""

    total_s: float


class PlanResponse(BaseModel):
    """A plan."""

    id: str | None = Field(description="The policy's id; null without a policy.")
    outcome: Literal["solved", "unsatisfiable", "unreachable"]
    contextual_query: ContextualQueryOut | None
    ltl: str
    explanation: str
    warnings: list[str] = Field(description="What to know of the template that the formula came from.")
    environment: str
    probability: Bounds = Field(description="Maximal probability of satisfying the formula.")
    expected_steps: float | None = Field(description="Minimal expected steps until the outcome is decided.")
    initial: Situation
    trajectory: list[TrajectoryStep] = Field(
        description="Of the runs in which the policy satisfies the formula, the most probable one."
    )
    trajectory_probability: float | None = Field(description="Probability of exactly this run; null without one.")
    trajectory_complete: bool = Field(description="The run ends where the formula is satisfied; else it was cut short.")
    policy: PolicySummary | None
    model: ModelSize
    timing: Timing


class VariableOut(BaseModel):
    """One digit of a state index."""

    object: str
    attribute: str
    values: list[str]
    stride: int


class Start(BaseModel):
    """Where the plan began."""

    state: int = Field(description="State index.")
    memory: int


class PolicyOut(BaseModel):
    """A whole policy.

    State index = sum over variables of `stride` times the position of the state's value in `values`. The flat arrays
    have one entry for each memory and state, at `memory * states + state index`; memory is what the robot holds before
    the label of the state is read.
    """

    id: str
    environment: str
    formula: str
    atoms: list[str] = Field(description="Bit i of a letter of the automaton.")
    hoa: str = Field(description="The automaton, in the Hanoi omega-automata format.")
    accepted: list[int] = Field(description="By memory: 1 where the formula is satisfied, whatever happens next.")
    actions: list[str]
    variables: list[VariableOut]
    initial: Start
    states: int
    memories: int
    action: list[int] = Field(description="Index into `actions`; -1 nothing to do; -2 let one step pass.")
    next_memory: list[int] = Field(description="The memory to hold at the next state; -1 the state is not legal.")
    probability: list[float] = Field(description="Of satisfying the formula from there.")
    expected_steps: list[float] = Field(description="Until the outcome is decided; -1 unknown.")


class StepRequest(Request):
    """Where the robot is: the state it observes, and the memory that the last step returned (at first the plan's)."""

    state: State
    memory: int = Field(0, ge=0)


class StepResponse(BaseModel):
    """What to do next."""

    action: str | None = Field(
        description="Null when there is nothing left to do; while `running`, when no action is possible: observe again."
    )
    memory: int = Field(description="Send it with the next state.")
    probability: float = Field(description="Of satisfying the formula from here.")
    expected_steps: float | None = Field(description="Until the outcome is decided.")
    done: bool = Field(description="The formula is satisfied, whatever happens next.")
    status: Literal["running", "satisfied", "lost"] = Field(
        description="`lost`: the formula cannot be satisfied from here; stop and ask for another task."
    )


class Health(BaseModel):
    """The service answers."""

    status: Literal["ok"] = "ok"

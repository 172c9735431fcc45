"""Plans."""

from __future__ import annotations

from typing import Literal, Self

from pydantic import BaseModel, Field, model_validator

from models.world import EnvironmentSpec
from service.http.schemas.common import (
    Answers,
    BindingOut,
    Command,
    ContextualQueryTree,
    EnvironmentName,
    FormulaText,
    QueryText,
    Request,
    State,
    TranslatorName,
    shown,
)


class PlanOptions(Request):
    """Accuracy and limits."""

    objective: Literal["max", "min"] = Field(
        "max",
        description="`min`: the policy under which the formula is least probable. The goal is then its negation, and "
        "`outcome`, `expected_steps`, `round_steps`, `trajectory` and the policy are those of the goal.",
    )
    verify: bool = Field(
        False, description="Also evaluate the policy apart from planning; the time for it counts towards `timeout_s`."
    )
    epsilon: float = Field(1e-6, ge=1e-12, lt=1, description="Most that upper and lower probability may differ.")
    timeout_s: float = Field(
        30.0,
        gt=0,
        allow_inf_nan=False,
        description="Longest planning time, in seconds. Before it ends iteration stops, and the answer "
        "has the bounds that were reached; `out-of-time` is left for what has no answer by then.",
    )
    max_states: int = Field(50_000_000, ge=1, description="Most product states.")
    device: Literal["auto", "cpu", "cuda"] = "auto"
    relevance: bool = Field(True, description="Leave out of the world what the task cannot depend on.")


class PlanRequest(Request):
    """What to plan: exactly one of `text`, `contextual_query`, `query`, `ltl`, and one of `environment`,
    `environment_spec`.
    """

    model_config = shown(
        {"text": "Pickup the sphere", "environment": "toys-4x1-sphere"},
        {"contextual_query": "ship(cylinder, box, bedroom)", "environment": "toys-4x1-cylinder"},
        {"ltl": "F holding(sphere) & G !at(robot, bedroom)", "environment": "toys-4x1-sphere"},
    )

    text: Command | None = None
    contextual_query: QueryText | None = None
    query: ContextualQueryTree | None = None
    ltl: FormulaText | None = None
    environment: EnvironmentName | None = None
    environment_spec: EnvironmentSpec | None = None
    state: State | None = None
    translator: TranslatorName = "default"
    answers: Answers = Field(default_factory=list, max_length=16)
    options: PlanOptions = Field(default_factory=PlanOptions)

    @model_validator(mode="after")
    def _exactly_one(self) -> Self:
        for names in (("text", "contextual_query", "query", "ltl"), ("environment", "environment_spec")):
            if sum(getattr(self, name) is not None for name in names) != 1:
                raise ValueError(f"give exactly one of {', '.join(names)}")
        if self.answers and self.text is None:
            raise ValueError("answers belong to a text")
        return self


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


class RoundSteps(BaseModel):
    """An interval that holds the expected steps of a round."""

    lower: float
    upper: float | None = Field(description="Null where no bound was found.")


class VerifiedOut(BaseModel):
    """What the policy attains, worked out anew from nothing but the world, its arrays and the formula."""

    probability: float = Field(description="Of satisfying the formula.")
    expected_steps: float | None = Field(description="Until the outcome is decided; null if that may never be.")
    sound: bool = Field(description="Wherever the policy says that it only has to go on, its runs satisfy the goal.")
    states: int = Field(description="Product states that the policy may come to.")


class ModelSize(BaseModel):
    """How large the problem was."""

    states: int
    product_states: int
    automaton_states: int


class Timing(BaseModel):
    """Wall-clock seconds; the only part of a response that differs between equal requests."""

    total_s: float


class Obstacle(BaseModel):
    """What holds in every state that can be reached, and leaves no way to the goal."""

    ltl: str
    explanation: str


class PlanResponse(BaseModel):
    """A plan."""

    id: str | None = Field(description="The policy's id; null without a policy.")
    outcome: Literal["solved", "unsatisfiable", "unreachable"] = Field(
        description="`unsatisfiable`: no run at all satisfies the goal; `unreachable`: none of this world does. The "
        "goal is the formula, or its negation where the objective is `min`."
    )
    obstacles: list[Obstacle] = Field(
        description="Why the goal is unreachable, where that is known: each alone makes it so, or else all together do."
    )
    objective: Literal["max", "min"]
    confidence: float | None = Field(
        None, description="Probability that the command was meant so; null where a query or a formula was given."
    )
    contextual_query: ContextualQueryTree | None
    ltl: str
    explanation: str
    bindings: list[BindingOut] = Field(description="What the phrases of a command or query were taken for.")
    warnings: list[str] = Field(description="What to know of the template that the formula came from.")
    environment: str
    probability: Bounds = Field(description="Maximal, or minimal, probability of satisfying the formula.")
    expected_steps: float | None = Field(
        description="Minimal expected steps (or costs, where actions have costs) until the outcome is decided; "
        "a lower bound, see `expected_steps_upper`."
    )
    expected_steps_upper: float | None = Field(
        description="The minimal expected steps are no more than this; null where no bound was found in time."
    )
    round_steps: RoundSteps | None = Field(
        description="Expected steps of one round of what has to be done for ever; null where there is no such thing."
    )
    initial: Situation
    trajectory: list[TrajectoryStep] = Field(
        description="Of the runs in which the policy satisfies the goal, the most probable one."
    )
    trajectory_loop: int | None = Field(
        description="The position in `trajectory` that its last step repeats, from where it goes round; null where the "
        "run ends, or was cut short."
    )
    trajectory_probability: float | None = Field(
        description="Probability of exactly this run, up to where the outcome is decided; null without one."
    )
    trajectory_complete: bool = Field(
        description="The run comes to where the goal is satisfied, or will be by going on; else it was cut short."
    )
    policy: PolicySummary | None
    verified: VerifiedOut | None = Field(
        description="Null without `verify`, without a policy, and where its runs are too many or too long to evaluate."
    )
    model: ModelSize
    timing: Timing

"""Planning: the best policy for a formula in a world.

`plan` maximises (or minimises) the probability of satisfying a formula of LTL and, among the policies that do,
minimises the expected number of steps until the outcome is decided. Values come with bounds that hold; `check` works
a policy's claims out again.
"""

from models.planning.check import Check, check
from models.planning.errors import (
    DeviceUnavailableError,
    InvalidMemoryError,
    InvalidPolicyError,
    ModelTooLargeError,
    UncheckableError,
)
from models.planning.options import Options, Progress
from models.planning.planner import Plan, Sizes, plan
from models.planning.policy import INVALID, NOTHING, WAIT, Policy, Step
from models.planning.policy_data import from_bytes, to_bytes, to_json
from models.planning.running import RunStep, likeliest_run, run
from models.planning.simulation import Simulation, simulate
from models.planning.trajectory import Trajectory, TrajectoryStep

__all__ = [
    "INVALID",
    "NOTHING",
    "WAIT",
    "Check",
    "DeviceUnavailableError",
    "InvalidMemoryError",
    "InvalidPolicyError",
    "ModelTooLargeError",
    "Options",
    "Plan",
    "Policy",
    "Progress",
    "RunStep",
    "Simulation",
    "Sizes",
    "Step",
    "Trajectory",
    "TrajectoryStep",
    "UncheckableError",
    "check",
    "from_bytes",
    "likeliest_run",
    "plan",
    "run",
    "simulate",
    "to_bytes",
    "to_json",
]

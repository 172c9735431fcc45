"""Worker processes: planning, simulation and what Spot does run here, so that the server stays responsive and can kill
them.
"""

from service.worker.calls import Call, CallCancelled
from service.worker.drawing import DrawingJob, DrawnFormat, run_drawing
from service.worker.jobs import (
    Device,
    Objective,
    PlanAnswer,
    PlanJob,
    ReviewJob,
    Verified,
    run_classification,
    run_plan,
    run_review,
)
from service.worker.pool import Workers
from service.worker.progress import Progress
from service.worker.running import PictureJob, RunJob, RunMoment, run_picture, run_run
from service.worker.simulation import SimulationAnswer, SimulationJob, run_simulation

__all__ = [
    "Call",
    "CallCancelled",
    "Device",
    "DrawingJob",
    "DrawnFormat",
    "Objective",
    "PictureJob",
    "PlanAnswer",
    "PlanJob",
    "Progress",
    "ReviewJob",
    "RunJob",
    "RunMoment",
    "SimulationAnswer",
    "SimulationJob",
    "Verified",
    "Workers",
    "run_classification",
    "run_drawing",
    "run_picture",
    "run_plan",
    "run_review",
    "run_run",
    "run_simulation",
]

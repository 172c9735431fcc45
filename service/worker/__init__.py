"""Worker processes: planning and formula checks run here, so that the server stays responsive and can kill them."""

from service.worker.jobs import Device, PlanAnswer, PlanJob, ReviewJob, run_plan, run_review
from service.worker.pool import Workers

__all__ = ["Device", "PlanAnswer", "PlanJob", "ReviewJob", "Workers", "run_plan", "run_review"]

"""Jobs: plans that outlast the wait of their request, and who makes them."""

from service.jobs.commission import Commission, Planned, planned
from service.jobs.embedded import EmbeddedExecutor
from service.jobs.executor import OPERATION, Executor

__all__ = ["OPERATION", "Commission", "EmbeddedExecutor", "Executor", "Planned", "planned"]

"""A plan to be made, with what to say of it, and the plan once it is made."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from models.logic import to_text as formula_text
from service.places import at
from service.store import NewJob, StoredJob, StoredPolicy
from service.worker import Call, PlanAnswer, PlanJob
from service.worker.records import job_text, read_answer, read_job


@dataclass(frozen=True, slots=True)
class Commission:
    """What to plan in which environment, by name. `told` is what of the answer is known beforehand, as JSON; `source`
    points to the member of the request that says what to do.
    """

    work: PlanJob
    environment: str
    told: Mapping[str, Any]
    source: str

    def job(self, deadline_s: float) -> NewJob:
        """What a job keeps of it."""
        told = {"told": self.told, "source": self.source}
        return NewJob(
            queue="gpu" if self.work.device == "cuda" else "plan",
            environment=self.environment,
            ltl=formula_text(self.work.formula),
            work=job_text(self.work),
            told=json.dumps(told, ensure_ascii=False),
            deadline_s=deadline_s,
        )

    @classmethod
    def of(cls, job: StoredJob) -> Commission:
        """What was kept."""
        said = json.loads(job.told)
        return cls(read_job(job.work), job.environment, said["told"], said["source"])


@dataclass(frozen=True, slots=True)
class Planned:
    """A plan: what was known before of its answer, what was found, and the id of its policy if there is one."""

    told: Mapping[str, Any]
    answer: PlanAnswer
    policy_id: str | None


def planned(job: StoredJob) -> Planned:
    """The plan of a job that succeeded."""
    assert job.answer is not None
    return Planned(json.loads(job.told)["told"], read_answer(job.answer), job.policy_id)


async def answer_of(call: Call[PlanAnswer], commission: Commission) -> PlanAnswer:
    """Wait for the answer; refusals name the place in the request that they are about."""
    with (
        at("/state", only={"invalid-state"}),
        at("/options/max_states", only={"model-too-large"}),
        at("/options/device", only={"device-unavailable"}),
        at(commission.source, only={"formula-too-large"}),
    ):
        return await call.result()


def policy_of(commission: Commission, answer: PlanAnswer) -> StoredPolicy | None:
    """The policy under a digest of what it holds, so that the same plan in the same world has the same id."""
    if answer.policy is None:
        return None
    work, ltl = commission.work, formula_text(commission.work.formula)
    asked = json.dumps([work.environment, ltl, work.objective]).encode()
    digest = hashlib.sha256(asked + b"\0" + answer.policy).hexdigest()[:32]
    return StoredPolicy(digest, commission.environment, ltl, work.objective, work.environment, answer.policy)

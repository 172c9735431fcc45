"""`/jobs`: plans that outlast the wait of their request."""

from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator
from typing import Annotated

from anyio.to_thread import run_sync
from fastapi import APIRouter, Depends
from fastapi.sse import EventSourceResponse, ServerSentEvent

from service.http.dependencies import Cursor, Limit, ServicesDep, page_of, refusals
from service.http.plan_views import job_out, job_url, progress_out
from service.http.schemas import JobEvent, JobList, JobOut, JobRow
from service.services import Services
from service.store import StoredJob

router = APIRouter(prefix="/jobs", tags=["jobs"])

LOOK_S = 0.25
"""How often a stream looks whether its job has changed."""

RECONNECT_MS = 1_000
"""How soon a client whose stream broke off comes back."""


@router.get("", operation_id="listJobs", responses=refusals("validation"))
def get_jobs(services: ServicesDep, cursor: Cursor = "", limit: Limit = 50) -> JobList:
    """List the jobs in the order in which they were accepted."""
    with services.store.read() as transaction:
        found = transaction.jobs.page(after=cursor, limit=limit + 1)
    page, cursor_after = page_of(found, limit, lambda entry: entry.id)
    items = [
        JobRow(id=entry.id, state=entry.state, url=job_url(entry.id), environment=entry.environment, ltl=entry.ltl)
        for entry in page
    ]
    return JobList(items=items, next=cursor_after)


@router.get("/{job_id}", operation_id="getJob", responses=refusals("unknown-job"))
def get_job(job_id: str, services: ServicesDep) -> JobOut:
    """How far a job is, and its plan or problem once it has ended."""
    return job_out(_job(services, job_id))


@router.post("/{job_id}/cancel", operation_id="cancelJob", responses=refusals("unknown-job"))
async def post_cancel(job_id: str, services: ServicesDep) -> JobOut:
    """End a job. One that has ended stays as it is: `state` tells."""
    return job_out(await services.jobs.cancel(job_id))


async def _known_job(job_id: str, services: ServicesDep) -> StoredJob:
    """Before the stream begins: a refusal within it could not be told any more."""
    return await run_sync(_job, services, job_id)


@router.get(
    "/{job_id}/events",
    operation_id="getJobEvents",
    response_class=EventSourceResponse,
    responses=refusals("unknown-job"),
)
async def get_job_events(
    job: Annotated[StoredJob, Depends(_known_job)], services: ServicesDep
) -> AsyncIterator[ServerSentEvent]:
    """Server-sent events: `progress` (a `JobEvent`) whenever there is any, and `end` (a `JobOut`) once the job ends."""
    said: JobEvent | None = None
    while not job.ended:
        now = JobEvent(state=job.state, progress=progress_out(job.progress))
        if now != said:
            yield ServerSentEvent(event="progress", data=now, retry=None if said else RECONNECT_MS)
            said = now
        if services.closing.is_set():
            return  # the client comes back to whoever serves then
        await asyncio.sleep(LOOK_S)
        job = await run_sync(_job, services, job.id)
    yield ServerSentEvent(event="end", data=job_out(job))


def _job(services: Services, job_id: str) -> StoredJob:
    with services.store.read() as transaction:
        return transaction.jobs.get(job_id)

"""`/metrics`."""

from __future__ import annotations

from anyio import CapacityLimiter
from anyio.to_thread import run_sync
from fastapi import APIRouter, Response
from fastapi.responses import PlainTextResponse

from service.http.dependencies import ServicesDep

router = APIRouter(tags=["health"])

MEDIA_TYPE = "text/plain; version=0.0.4; charset=utf-8"
"""Prometheus's text format."""

_threads: list[CapacityLimiter] = []
"""Its own, made where a loop runs: the metrics are of most use when requests keep all others busy."""


@router.get("/metrics", operation_id="metrics", response_class=PlainTextResponse)
async def get_metrics(services: ServicesDep) -> Response:
    """What the service has done and is doing, in the text format of Prometheus."""
    if not _threads:
        _threads.append(CapacityLimiter(1))
    return Response(await run_sync(services.metrics.text, limiter=_threads[0]), media_type=MEDIA_TYPE)

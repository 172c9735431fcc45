"""`/livez` and `/readyz`."""

from __future__ import annotations

from fastapi import APIRouter

from service.http.dependencies import ServicesDep, refusals
from service.http.schemas import Health

router = APIRouter(tags=["health"])


@router.get("/livez", operation_id="livez")
async def get_livez() -> Health:
    """The process answers. Touches nothing else, so it stays fast under load."""
    return Health()


@router.get("/readyz", operation_id="readyz", responses=refusals("not-ready"))
def get_readyz(services: ServicesDep) -> Health:
    """The store answers and has its tables."""
    services.check()
    return Health()

"""`/templates`."""

from __future__ import annotations

from fastapi import APIRouter, Response

from service.http.dependencies import Cursor, Limit, ServicesDep, page_of, refusals
from service.http.schemas import TemplateList, TemplateOut
from service.http.views import template_out

router = APIRouter(prefix="/templates", tags=["templates"])


@router.get("", operation_id="listTemplates", responses=refusals("validation"))
def get_templates(services: ServicesDep, cursor: Cursor = "", limit: Limit = 50) -> TemplateList:
    """List the learned templates in order of task."""
    with services.store.read() as transaction:
        found = transaction.templates.page(after=cursor, limit=limit + 1)
    page, cursor_after = page_of(found, limit, lambda stored: stored.task)
    return TemplateList(items=[template_out(stored) for stored in page], next=cursor_after)


@router.get("/{task}", operation_id="getTemplate", responses=refusals("unknown-template"))
def get_template(task: str, services: ServicesDep) -> TemplateOut:
    """The template of a task."""
    with services.store.read() as transaction:
        return template_out(transaction.templates.get(task))


@router.delete(
    "/{task}",
    operation_id="deleteTemplate",
    status_code=204,
    response_class=Response,
    responses=refusals("unknown-template"),
)
def delete_template(task: str, services: ServicesDep) -> None:
    """Forget the template of a task."""
    with services.store.write() as transaction:
        transaction.templates.delete(task)

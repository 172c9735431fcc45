"""`/templates`."""

from __future__ import annotations

from fastapi import APIRouter, Response

from service.http.dependencies import Cursor, Limit, ServicesDep, page_of, refusals
from service.http.schemas import ExampleList, TemplateList, TemplateOut
from service.http.views import example_out, template_out

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


@router.get("/{task}/examples", operation_id="listExamples", responses=refusals("unknown-template", "validation"))
def get_examples(task: str, services: ServicesDep, cursor: Cursor = "", limit: Limit = 50) -> ExampleList:
    """List the utterances that a task was taught with, in order of their ids."""
    with services.store.read() as transaction:
        stored = transaction.templates.get(task)
    taught = services.known()
    rest = sorted((example for example in stored.examples if example.id > cursor), key=lambda example: example.id)
    page, cursor_after = page_of(rest[: limit + 1], limit, lambda example: example.id)
    return ExampleList(items=[example_out(example, taught) for example in page], next=cursor_after)


@router.delete(
    "/{task}/examples/{id}",
    operation_id="deleteExample",
    status_code=204,
    response_class=Response,
    responses=refusals("unknown-template", "unknown-example"),
)
def delete_example(task: str, id: str, services: ServicesDep) -> None:  # noqa: A002
    """Forget one utterance of a task; what it taught is not understood any more, in any process of the service."""
    with services.store.write() as transaction:
        transaction.templates.delete_example(task, id)

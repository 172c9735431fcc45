"""`/environments`."""

from __future__ import annotations

from typing import Annotated, Any

from anyio.to_thread import run_sync
from fastapi import APIRouter, Query, Response
from pydantic import TypeAdapter, ValidationError

from models.errors import Place
from models.world import EnvironmentSpec, State, StateError, WorldError, load_environment
from service.acting import world_image
from service.errors import EnvironmentExistsError
from service.http.dependencies import BODY, Cursor, Limit, ServicesDep, page_of, refusals
from service.http.idempotency import SLUGS, AnsweredMeanwhile, KeyHeader, keeping, kept_response, once_of
from service.http.schemas import EnvironmentList, EnvironmentOut, EnvironmentSummary
from service.http.views import environment_data, location
from service.places import at
from service.services import Services
from service.store import Once, StoredEnvironment

MAX_STATE = 8_000
"""Longest state in a query, in characters: percent-encoded, JSON of ASCII fits the longest head there is by default."""

router = APIRouter(prefix="/environments", tags=["environments"])

SVG = "image/svg+xml"
STATE = TypeAdapter(dict[str, dict[str, str]])


@router.get("", operation_id="listEnvironments", responses=refusals("validation"))
def get_environments(services: ServicesDep, cursor: Cursor = "", limit: Limit = 50) -> EnvironmentList:
    """List the stored environments in order of name."""
    with services.store.read() as transaction:
        found = transaction.environments.page(after=cursor, limit=limit + 1)
    page, cursor_after = page_of(found, limit, lambda stored: stored.name)
    items = [EnvironmentSummary(name=e.name, kind=e.kind, revision=e.revision, samples=_samples(e)) for e in page]
    return EnvironmentList(items=items, next=cursor_after)


@router.post(
    "",
    operation_id="createEnvironment",
    status_code=201,
    responses=refusals(*BODY, *SLUGS, "invalid-environment", "environment-exists", "insufficient-storage"),
)
async def post_environment(
    body: EnvironmentSpec, services: ServicesDep, response: Response, idempotency_key: KeyHeader = None
) -> EnvironmentOut:
    """Store a new environment."""
    once = once_of("environments", idempotency_key, body)
    if (before := await kept_response(services, once)) is not None:
        return before  # type: ignore[return-value]  # FastAPI passes responses on
    try:
        stored = await run_sync(_add, services, body, once)
    except (AnsweredMeanwhile, EnvironmentExistsError):
        meanwhile = await kept_response(services, once)
        if meanwhile is None:
            raise
        return meanwhile  # type: ignore[return-value]
    response.headers["Location"] = location("environments", stored.name)
    return _out(stored)


@router.get("/{name}", operation_id="getEnvironment", responses=refusals("unknown-environment"))
def get_environment(name: str, services: ServicesDep) -> EnvironmentOut:
    """A stored environment."""
    with services.store.read() as transaction:
        return _out(transaction.environments.get(name))


@router.get(
    "/{name}/image",
    operation_id="getEnvironmentImage",
    response_class=Response,
    responses={
        200: {"content": {SVG: {"schema": {"type": "string"}}}, "description": "A picture that needs nothing else."},
        **refusals("unknown-environment", "validation", "invalid-state", "drawing-too-large"),
    },
)
def get_environment_image(
    name: str,
    services: ServicesDep,
    state: Annotated[
        str | None,
        Query(
            max_length=MAX_STATE,
            description='A state as JSON, such as `{"robot": {"at": "kitchen"}}`; what is left out is as in the '
            "initial state.",
        ),
    ] = None,
) -> Response:
    """The world drawn as SVG: cells, walls, and what is where. Without a map it is listed."""
    found = services.environment(name).value
    return Response(world_image(found, None if state is None else _state_of(state)), media_type=SVG)


@router.put(
    "/{name}",
    operation_id="putEnvironment",
    responses={
        201: {"model": EnvironmentOut, "description": "Created."},
        **refusals(*BODY, "invalid-environment"),
    },
)
def put_environment(name: str, body: EnvironmentSpec, services: ServicesDep, response: Response) -> EnvironmentOut:
    """Store an environment, in place of the one of that name if there is one."""
    given, data = _checked(body)
    if given != name:
        detail = f'the body names the environment "{given}", the address "{name[:100]}"'
        raise WorldError(detail, places=[Place("/name", detail)])
    with services.store.write() as transaction:
        stored = transaction.environments.put(name, body.kind, data)
    response.status_code = 201 if stored.revision == 1 else 200
    return _out(stored)


@router.delete(
    "/{name}",
    operation_id="deleteEnvironment",
    status_code=204,
    response_class=Response,
    responses=refusals("unknown-environment"),
)
def delete_environment(name: str, services: ServicesDep) -> None:
    """Forget an environment. Policies planned in it stay usable."""
    with services.store.write() as transaction:
        transaction.environments.delete(name)


def _add(services: Services, body: EnvironmentSpec, once: Once | None) -> StoredEnvironment:
    name, data = _checked(body)
    keep = keeping(once, lambda stored: (201, location("environments", stored.name), _out(stored)))
    with services.store.write() as transaction:
        stored = transaction.environments.add(name, body.kind, data)
        keep(transaction, stored)
    return stored


def _checked(body: EnvironmentSpec) -> tuple[str, dict[str, Any]]:
    """The name and the data as stored; raises `WorldError` when they are not a world."""
    data = environment_data(body)
    load_environment(data)
    return body.name, data


def _state_of(text: str) -> State:
    try:
        return STATE.validate_json(text)
    except ValidationError as error:
        detail = f"the state is not JSON of the form object to attribute to value: {error.errors()[0]['msg']}"
        with at("/query/state"):
            raise StateError(detail) from None


def _out(stored: StoredEnvironment) -> EnvironmentOut:
    return EnvironmentOut.model_validate(
        {
            "name": stored.name,
            "kind": stored.kind,
            "revision": stored.revision,
            "samples": _samples(stored),
            "spec": stored.data,
        }
    )


def _samples(stored: StoredEnvironment) -> list[str]:
    return list(stored.data.get("samples", ()))

"""The header `Idempotency-Key`: a request that is sent again is done once, and answered the same."""

from __future__ import annotations

import hashlib
from collections.abc import Callable
from typing import Annotated, Any

from anyio.to_thread import run_sync
from fastapi import Header, Response
from pydantic import BaseModel

from service.services import Services
from service.store import KeptAnswer, Once, Transaction

KeyHeader = Annotated[
    str | None,
    Header(
        alias="Idempotency-Key",
        min_length=1,
        max_length=255,
        description="A name of your own for this request. Sent again with the same key, it is answered as before and "
        "nothing is done twice.",
    ),
]

SLUGS = ("idempotency-key-reused",)
"""What a route with such a header may refuse."""


class AnsweredMeanwhile(Exception):
    """The same request came twice at once, and the other one was faster."""


def once_of(operation: str, key: str | None, body: BaseModel) -> Once | None:
    """A request with a key; None without one."""
    if key is None:
        return None
    return Once(operation, key, hashlib.sha256(body.model_dump_json(by_alias=True).encode()).hexdigest())


async def kept_response(services: Services, once: Once | None) -> Response | None:
    """The answer to the same request before, if there was one; raises `KeyInUseError`."""
    return None if once is None else await run_sync(_kept, services, once)


def _kept(services: Services, once: Once) -> Response | None:
    with services.store.read() as transaction:
        kept = transaction.answers.find(once)
    if kept is None:
        return None
    headers = {} if kept.location is None else {"Location": kept.location}
    return Response(kept.body, status_code=kept.status or 200, headers=headers, media_type="application/json")


def keeping(once: Once | None, answer: Callable[..., tuple[int, str, BaseModel]]) -> Callable[..., None]:
    """What keeps an answer in the transaction of what was done; `answer` gives status, location and body from what the
    transaction stored. Raises `AnsweredMeanwhile`, and then nothing is done.
    """

    def keep(transaction: Transaction, *stored: Any) -> None:
        if once is not None:
            status, location, body = answer(*stored)
            kept = KeptAnswer(status=status, location=location, body=body.model_dump_json(by_alias=True))
            if not transaction.answers.keep(once, kept):
                raise AnsweredMeanwhile

    return keep

"""Answers kept under the idempotency keys of their requests."""

from __future__ import annotations

from dataclasses import asdict, dataclass

from sqlalchemy import Connection, delete, select

from service.errors import KeyInUseError
from service.store.dialect import epoch, insert_new
from service.store.tables import kept_answers


@dataclass(frozen=True, slots=True)
class Once:
    """A request that is to be done once: what it asks for, the client's key, and a digest of its body."""

    operation: str
    key: str
    digest: str


@dataclass(frozen=True, slots=True)
class KeptAnswer:
    """What a request was answered: by a job, or by a status, a location and a body."""

    job_id: str | None = None
    status: int | None = None
    location: str | None = None
    body: str | None = None


class AnswerRepository:
    """Kept answers, within one transaction."""

    def __init__(self, connection: Connection) -> None:
        self._connection = connection

    def find(self, once: Once) -> KeptAnswer | None:
        """The answer to the same request under the same key.

        Raises `KeyInUseError` where the key came with another request.
        """
        columns = kept_answers.c
        row = self._connection.execute(
            select(columns.digest, columns.job_id, columns.status, columns.location, columns.body).where(
                columns.operation == once.operation, columns.key == once.key
            )
        ).first()
        if row is None:
            return None
        if row.digest != once.digest:
            raise KeyInUseError(f'the Idempotency-Key "{once.key[:100]}" came with another request before')
        return KeptAnswer(row.job_id, row.status, row.location, row.body)

    def keep(self, once: Once, answer: KeptAnswer) -> bool:
        """Keep the answer; False where there is one already, of this or of another request."""
        values = asdict(once) | asdict(answer) | {"created_at": epoch()}
        return insert_new(self._connection, kept_answers, values)

    def purge(self, *, older_s: float) -> int:
        """Forget answers that are so old; how many."""
        return self._connection.execute(
            delete(kept_answers).where(kept_answers.c.created_at < epoch() - older_s)
        ).rowcount

"""Policies, as the bytes that `models.planning` writes."""

from __future__ import annotations

from dataclasses import asdict, dataclass

from sqlalchemy import Connection, delete, select

from service.errors import UnknownPolicyError
from service.store.dialect import insert_new
from service.store.tables import policies


@dataclass(frozen=True, slots=True)
class StoredPolicy:
    """One policy; its id is a digest of what it holds, so the same plan is stored once."""

    id: str
    environment: str
    ltl: str
    objective: str
    world: str  # the environment in which it was planned, as JSON text; the one of that name may be another by now
    data: bytes


@dataclass(frozen=True, slots=True)
class PolicyEntry:
    """What a list says of a policy."""

    id: str
    environment: str
    ltl: str
    objective: str


class PolicyRepository:
    """Policies by id, within one transaction."""

    def __init__(self, connection: Connection) -> None:
        self._connection = connection

    def get(self, policy_id: str) -> StoredPolicy:
        """The policy; raises `UnknownPolicyError`."""
        row = self._connection.execute(select(policies).where(policies.c.id == policy_id)).first()
        if row is None:
            raise UnknownPolicyError(f'no policy has the id "{policy_id[:100]}"')
        return StoredPolicy(**row._mapping)

    def page(self, *, after: str = "", limit: int) -> list[PolicyEntry]:
        """Up to `limit` policies in order of id without what is large, from the first id greater than `after`."""
        columns = (policies.c.id, policies.c.environment, policies.c.ltl, policies.c.objective)
        rows = self._connection.execute(
            select(*columns).where(policies.c.id > after).order_by(policies.c.id).limit(limit)
        )
        return [PolicyEntry(**row._mapping) for row in rows]

    def delete(self, policy_id: str) -> None:
        """Remove the policy; raises `UnknownPolicyError`."""
        self.get(policy_id)
        self._connection.execute(delete(policies).where(policies.c.id == policy_id))

    def add(self, policy: StoredPolicy) -> None:
        """Store the policy if it is not stored yet."""
        insert_new(self._connection, policies, asdict(policy))

"""What every process does with the jobs of all now and then."""

from __future__ import annotations

import json

from service.errors import OutOfTimeError
from service.refusals import refusal_data
from service.settings import Settings
from service.store import Store


def fail_overdue(store: Store) -> None:
    """End the jobs that nobody runs and whose deadline is over, so that every job ends."""
    with store.read() as transaction:
        found = transaction.jobs.overdue()
    if found:
        error = refusal_data(OutOfTimeError("the job's deadline came before its plan was made"))
        with store.write(exclusive=False) as transaction:
            for job_id in found:
                transaction.jobs.fail(job_id, json.dumps(error))


def forget(store: Store, settings: Settings) -> None:
    """Forget jobs and idempotency keys that have been kept as long as they are."""
    with store.write(exclusive=False) as transaction:
        transaction.answers.purge(older_s=settings.idempotency_s)
        kept_s = max(settings.job_retention_s, settings.idempotency_s)  # a key may ask for any
        transaction.jobs.purge(ended_s=kept_s, unaccepted_s=settings.idempotency_s)

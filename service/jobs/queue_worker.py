"""`cqltl worker`: takes jobs from the queue and runs them, on any machine that reaches the database."""

from __future__ import annotations

import asyncio
import contextlib
import logging
import signal
from collections.abc import Callable, Sequence

import procrastinate
import psycopg
from anyio.to_thread import run_sync
from procrastinate.exceptions import ConnectorException
from sqlalchemy.exc import SQLAlchemyError

from service.jobs.queue import SWEEP_S, TASK, conninfo, enqueue, sweep
from service.jobs.runner import JobRunner
from service.metrics import Metrics
from service.settings import Settings
from service.store import Store, StoredJob
from service.worker import Workers

POLL_S = 1.0
"""How often the queue is asked even if it has said nothing."""

RECONNECT_S = 0.5
"""Pause after the database could not be reached."""

_log = logging.getLogger("cqltl")


async def work(settings: Settings, queues: Sequence[str], ready: Callable[[], None]) -> None:
    """Run jobs of these queues until SIGTERM or SIGINT; then others get those that have not ended.

    `ready` is called once jobs can be taken. The tables have to be there. Raises `CannotStartError`.
    """
    metrics = Metrics()
    port, stop_metrics = settings.worker_metrics_port, None
    workers = Workers(
        planners=settings.workers, max_waiting=0, memory_bytes=settings.worker_memory_bytes, ended=metrics.called
    )
    metrics.watch_workers(workers)
    await run_sync(lambda: workers.start(warm=True))
    try:
        await run_sync(workers.loaded)
        stop_metrics = metrics.serve(settings.host, port) if port else None
    except BaseException:
        await run_sync(workers.stop)
        raise
    store = Store(settings.url)
    found = _QueueWorker(settings, store, workers)
    loop = asyncio.get_running_loop()
    task = asyncio.ensure_future(found.run(queues, ready))
    for number in (signal.SIGTERM, signal.SIGINT):
        loop.add_signal_handler(number, task.cancel)
    try:
        with contextlib.suppress(asyncio.CancelledError):
            await task
    finally:
        await found.stop()
        await run_sync(workers.stop)
        if stop_metrics is not None:
            await run_sync(stop_metrics)
        store.close()


class _QueueWorker:
    """Takes as many jobs at a time as there are processes to plan."""

    def __init__(self, settings: Settings, store: Store, workers: Workers) -> None:
        self._settings, self._store = settings, store
        self._runner = JobRunner(store, workers, lease_s=settings.job_lease_s)

    async def run(self, queues: Sequence[str], ready: Callable[[], None]) -> None:
        """Take jobs from the queues for ever; the database may go away meanwhile."""
        self._runner.start()
        keeper = asyncio.create_task(self._keep())
        try:
            while True:
                try:
                    await self._take(queues, ready)
                except (ConnectorException, psycopg.Error) as error:
                    _log.warning("the queue does not answer: %s", error)
                await asyncio.sleep(RECONNECT_S)
        finally:
            keeper.cancel()
            await asyncio.gather(keeper, return_exceptions=True)

    async def stop(self) -> None:
        """Kill what runs, and put it into the queue again."""
        await self._runner.stop()
        try:
            await run_sync(self._release)
        except SQLAlchemyError as error:
            _log.warning("jobs wait for their leases to end: %s", error)

    async def _take(self, queues: Sequence[str], ready: Callable[[], None]) -> None:
        """Take jobs as long as the connection to the database lasts."""
        lease_s = self._settings.job_lease_s
        application = procrastinate.App(connector=procrastinate.PsycopgConnector(conninfo=conninfo(self._settings.url)))
        application.task(name=TASK)(self._run)
        async with application.open_async():
            rescuer = asyncio.create_task(self._rescue(application))
            try:
                ready()
                await application.run_worker_async(
                    queues=list(queues),
                    concurrency=self._settings.workers,
                    fetch_job_polling_interval=POLL_S,
                    update_heartbeat_interval=lease_s / 4,
                    stalled_worker_timeout=lease_s,
                    shutdown_graceful_timeout=0.0,
                    delete_jobs="always",
                    install_signal_handlers=False,
                )
            finally:
                rescuer.cancel()
                await asyncio.gather(rescuer, return_exceptions=True)

    async def _run(self, job_id: str) -> None:
        """Run a job to its end, unless it has ended or somebody else runs it."""
        try:
            job = await self._runner.blocking(lambda: self._claim(job_id))
        except SQLAlchemyError as error:  # the sweep finds it, and puts it into the queue again
            _log.warning("job %s could not be claimed: %s", job_id, error)
            return
        if job is not None:
            self._runner.run(job)
            await self._runner.ended(job_id)

    def _claim(self, job_id: str) -> StoredJob | None:
        with self._store.write(exclusive=False) as transaction:
            found = transaction.jobs.claim(self._runner.owner, self._runner.lease_s, among=[job_id])
            return transaction.jobs.get(job_id) if found else None

    async def _rescue(self, application: procrastinate.App) -> None:
        """Have what a dead worker took from the queue, maybe without having claimed it, taken again."""
        while True:
            await asyncio.sleep(self._settings.job_lease_s)
            lapsed = 1.5 * self._settings.job_lease_s
            with contextlib.suppress(ConnectorException):
                for stalled in await application.job_manager.get_stalled_jobs(seconds_since_heartbeat=lapsed):
                    await application.job_manager.retry_job(stalled)

    async def _keep(self) -> None:
        while True:
            try:
                await self._runner.blocking(lambda: sweep(self._store))
            except SQLAlchemyError as error:
                _log.warning("the store does not answer: %s", error)
            except Exception:  # jobs of others must not wait for what is wrong with one
                _log.exception("jobs could not be looked after")
            await asyncio.sleep(SWEEP_S)

    def _release(self) -> None:
        with self._store.write(exclusive=False) as transaction:
            for job_id in transaction.jobs.release(self._runner.owner):
                enqueue(transaction, job_id, transaction.jobs.get(job_id).queue)

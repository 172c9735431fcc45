"""The composition root: the one place that makes the store, the workers and the translators, and the app over them."""

from __future__ import annotations

import asyncio
import threading
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from functools import partial
from importlib import import_module
from importlib.metadata import version
from typing import TypedDict

from anyio.to_thread import run_sync
from fastapi import FastAPI
from fastapi_offline import FastAPIOffline
from starlette.middleware.cors import CORSMiddleware
from starlette.middleware.gzip import GZipMiddleware

from models.language import part_of_speech
from models.world import load_environment, toys_spec
from service.errors import CannotStartError, WorkerDiedError
from service.http import (
    environments,
    explanations,
    health,
    jobs,
    language,
    monitoring,
    page,
    plans,
    policies,
    templates,
)
from service.http.edge import Edge
from service.http.gate import Gate, cors
from service.http.limits import BodyLimit
from service.http.openapi import openapi
from service.http.problems import install
from service.http.scopes import UNLIMITED, first_part
from service.http.shortcut import Shortcut
from service.jobs import EmbeddedExecutor, Executor
from service.keys import KeyRing
from service.metrics import Metrics
from service.rates import TokenBuckets
from service.seeds import seed
from service.services import Services
from service.settings import Settings
from service.store import Store
from service.store.engine import is_postgresql
from service.store.migrate import migrate
from service.translators import DEFAULT, Translators
from service.understanding import understand
from service.worker import Workers

REST_AFTER_S = 1.0
"""How long after the start is loaded what few requests need."""


class State(TypedDict):
    """What the lifespan hands to every request."""

    services: Services


def create_app(settings: Settings, *, warm: bool = True) -> FastAPI:
    """The app; its lifespan migrates the store, starts the workers and loads the translators.

    `warm` starts the worker processes at once, so that the first plan is as fast as the others, and takes up the jobs
    that other processes left; without it the app is for a single request of the process's own, and asks for no key.
    Raises `KeysError`.
    """
    app = FastAPIOffline(
        redoc_url=None,
        title="cqltl",
        summary="English robot commands to plans: contextual queries, templated LTL, policies.",
        version=version("cqltl"),
        license_info={"name": "GPL-3.0-or-later", "identifier": "GPL-3.0-or-later"},
        lifespan=partial(_lifespan, settings, warm),
        separate_input_output_schemas=False,
        telemetry={"auto_configure": True, "exclude": lambda scope: first_part(scope.get("path", "")) in UNLIMITED},
    )
    app.state.closing = threading.Event()
    app.state.cannot_start = None
    install(app)
    metrics = app.state.metrics = Metrics()
    app.add_middleware(Shortcut, most=settings.translation_cache_bytes)
    app.add_middleware(GZipMiddleware, minimum_size=1_000, compresslevel=5)
    app.add_middleware(BodyLimit, limit=settings.max_body_bytes, depth=settings.max_json_depth)
    app.add_middleware(
        Gate,
        keys=KeyRing(settings.api_keys_file) if warm and settings.api_keys_file else None,
        rates=TokenBuckets(settings.rate_limit, settings.rate_burst) if settings.rate_limit else None,
        most=settings.max_in_flight,
        metrics=metrics,
    )
    if settings.allowed_origins:
        app.add_middleware(CORSMiddleware, **cors(settings.allowed_origins))
    app.add_middleware(Edge, metrics=metrics)
    for module in (language, explanations, templates, environments, plans, jobs, policies, health, monitoring, page):
        app.include_router(module.router)
    app.router.routes.append(page.static())
    app.openapi = partial(openapi, app)  # type: ignore[method-assign]
    return app


@asynccontextmanager
async def _lifespan(settings: Settings, warm: bool, app: FastAPI) -> AsyncIterator[State]:
    metrics: Metrics = app.state.metrics
    workers = Workers(
        planners=settings.workers,
        max_waiting=settings.max_waiting,
        memory_bytes=settings.worker_memory_bytes,
        ended=metrics.called,
    )
    metrics.watch(
        "cqltl_requests_in_flight", "Requests that are being answered.", lambda: float(metrics.requests_in_flight)
    )
    metrics.watch(
        "cqltl_plans_running", "Planning processes of this service that are at work.", lambda: workers.running
    )
    translators = Translators.shipped()
    store: Store | None = None
    executor: Executor | None = None
    tasks = [asyncio.create_task(run_sync(partial(workers.start, warm=warm)))]  # they load in processes of their own
    try:
        await run_sync(migrate, settings.url)
        await run_sync(translators.queries, DEFAULT)
        await tasks[0]
        store = Store(settings.url, max_bytes=settings.max_store_bytes)
        executor = _executor(settings, store, workers, app.state.closing, queue=warm)
        services = Services(
            settings=settings,
            store=store,
            workers=workers,
            jobs=executor,
            translators=translators,
            metrics=metrics,
            closing=app.state.closing,
        )
        metrics.watch("cqltl_plans_waiting", "Plans that wait for a process.", executor.waiting)
        await _seed(services)
        await executor.start(take_up=warm)
        if warm:
            await run_sync(_warm, app, services)
            await run_sync(workers.loaded)
            tasks.append(asyncio.create_task(_load_the_rest()))
        yield {"services": services}
    except CannotStartError as error:
        app.state.cannot_start = error
        raise
    finally:
        for task in tasks[1:]:  # the workers have to be started before they can be stopped; the rest need not be loaded
            task.cancel()
        await asyncio.wait(tasks)
        if executor is not None:
            await executor.stop()
        await run_sync(workers.stop)
        if store is not None:
            store.close()


async def _seed(services: Services) -> None:
    try:
        await seed(services)
    except WorkerDiedError:
        await run_sync(services.workers.loaded)  # says why, if it is that none could be started
        raise


def _executor(settings: Settings, store: Store, workers: Workers, closing: threading.Event, *, queue: bool) -> Executor:
    """On PostgreSQL the workers plan that are there for it, unless the app is for a single request."""
    if not (queue and is_postgresql(settings.url)):
        return EmbeddedExecutor(store, workers, settings, closing)
    from service.jobs.queue import QueueExecutor

    return QueueExecutor(store, settings, closing)


def _warm(app: FastAPI, services: Services) -> None:
    """Do once what the first request would wait for: grammars are compiled, and FastAPI builds a route when it is first
    looked at, all of them in a tenth of a second.
    """
    for route in app.router.routes:
        route.matches({"type": "http", "method": "GET", "path": "/", "root_path": "", "headers": []})
    understand(
        services,
        services.known(),
        "pick up the sphere",
        load_environment(toys_spec()),
        translator=DEFAULT,
        candidates=1,
    )


async def _load_the_rest() -> None:
    """Load what few requests need and takes a second: parts of speech, and policies to act by. Not at once: what was
    started for a few requests only need not wait for it.
    """
    await asyncio.sleep(REST_AFTER_S)
    await run_sync(part_of_speech, "pick up the orange", "orange")
    await run_sync(import_module, "models.planning")

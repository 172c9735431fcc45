"""The composition root: the one place that makes the store, the workers and the translators, and the app over them."""

from __future__ import annotations

from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from functools import partial
from importlib.metadata import version
from typing import TypedDict

import torch
from anyio.to_thread import run_sync
from fastapi import FastAPI
from fastapi_offline import FastAPIOffline
from starlette.middleware.gzip import GZipMiddleware

from models.language import CopyNetTranslator
from service.http import environments, health, language, plans, policies, templates
from service.http.limits import BodyLimit
from service.http.openapi import openapi
from service.http.problems import install
from service.seeds import seed
from service.services import Services
from service.settings import Settings
from service.store import Store
from service.store.migrate import migrate
from service.worker import Workers


class State(TypedDict):
    """What the lifespan hands to every request."""

    services: Services


def create_app(settings: Settings, *, warm: bool = True) -> FastAPI:
    """The app; its lifespan migrates the store, starts the workers and loads the translators.

    `warm` starts the worker processes at once, so that the first plan is as fast as the others.
    """
    app = FastAPIOffline(
        redoc_url=None,
        title="cqltl",
        summary="English robot commands to plans: contextual queries, templated LTL, policies.",
        version=version("cqltl"),
        license_info={"name": "GPL-3.0-or-later", "identifier": "GPL-3.0-or-later"},
        lifespan=partial(_lifespan, settings, warm),
        separate_input_output_schemas=False,
    )
    install(app)
    app.add_middleware(GZipMiddleware, minimum_size=1_000, compresslevel=5)
    app.add_middleware(BodyLimit, limit=settings.max_body_bytes)
    for module in (language, templates, environments, plans, policies, health):
        app.include_router(module.router)
    app.openapi = partial(openapi, app)  # type: ignore[method-assign]
    return app


@asynccontextmanager
async def _lifespan(settings: Settings, warm: bool, _app: FastAPI) -> AsyncIterator[State]:
    torch.set_num_threads(1)  # the network is small: a second thread makes a translation slower
    workers = Workers(planners=settings.workers, max_waiting=settings.max_waiting)
    await run_sync(partial(workers.start, warm=warm))
    store = None
    try:
        await run_sync(migrate, settings.url)
        store = Store(settings.url)
        network = await run_sync(CopyNetTranslator.load)
        translators = {"default": network, "cq-copynet": network}
        services = Services(settings=settings, store=store, workers=workers, translators=translators)
        await seed(services)
        yield {"services": services}
    finally:
        await run_sync(workers.stop)
        if store is not None:
            store.close()

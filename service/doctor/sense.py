"""Settings that each are right and together make no sense."""

from __future__ import annotations

import os
import resource
from importlib.util import find_spec
from urllib.parse import urlsplit

from service.binding import SPARE_FILES, is_loopback
from service.doctor.findings import Findings, ok, warning, wrong
from service.keys import KeyRing, KeysError
from service.settings import Settings
from service.store.engine import is_postgresql


def examine_settings(settings: Settings) -> Findings:
    """Look at what the settings say of each other and of this machine; one `ok` where there is nothing to say."""
    found = [*_access(settings), *_times(settings), *_machine(settings), *_telemetry()]
    yield from found or [ok("settings", "they fit each other and this machine")]


def _access(settings: Settings) -> Findings:
    if settings.api_keys_file is not None:
        try:
            KeyRing(settings.api_keys_file)
        except KeysError as error:
            yield wrong("CQLTL_API_KEYS_FILE", str(error))
        if settings.allow_unauthenticated:
            yield warning("CQLTL_ALLOW_UNAUTHENTICATED", "does nothing where there are API keys")
    elif not is_loopback(settings.host):
        if settings.allow_unauthenticated:
            yield warning("CQLTL_ALLOW_UNAUTHENTICATED", f"whoever reaches {settings.host} may use the service")
        else:
            yield wrong("CQLTL_HOST", f"{settings.host} is refused without CQLTL_API_KEYS_FILE")
    for origin in filter(None, map(str.strip, settings.allowed_origins.split(","))):
        parts = urlsplit(origin)
        if origin != "*" and (not parts.scheme or not parts.netloc or parts.path):
            yield wrong("CQLTL_ALLOWED_ORIGINS", f"{origin} is no origin, such as https://robots.example:8443")


def _times(settings: Settings) -> Findings:
    if settings.wait_s > settings.max_wait_s:
        yield warning("CQLTL_WAIT_S", "is longer than CQLTL_MAX_WAIT_S, the longest wait that a request may prefer")
    if settings.plan_timeout_s > settings.job_deadline_s:
        yield warning("CQLTL_PLAN_TIMEOUT_S", "is longer than CQLTL_JOB_DEADLINE_S, which ends plans before")
    if settings.logic_timeout_s > settings.plan_timeout_s:
        yield warning("CQLTL_LOGIC_TIMEOUT_S", "is longer than CQLTL_PLAN_TIMEOUT_S")
    if max(settings.head_timeout_s, settings.body_timeout_s) > 60:
        yield warning("CQLTL_HEAD_TIMEOUT_S, CQLTL_BODY_TIMEOUT_S", "slow clients hold connections for minutes")


def _machine(settings: Settings) -> Findings:
    cores = os.cpu_count() or 1
    if settings.workers > cores:
        yield warning("CQLTL_WORKERS", f"{settings.workers} processes plan on {cores} cores")
    memory = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")
    if settings.worker_memory_bytes and settings.worker_memory_bytes < 2 * 2**30:
        yield wrong("CQLTL_WORKER_MEMORY_BYTES", "a worker process needs some 2 GiB of address space to begin with")
    if settings.worker_memory_bytes > 4 * memory:
        yield warning("CQLTL_WORKER_MEMORY_BYTES", f"is far more than the {memory} bytes of this machine")
    _, hard = resource.getrlimit(resource.RLIMIT_NOFILE)
    if hard != resource.RLIM_INFINITY and settings.max_connections + SPARE_FILES > hard:
        yield warning("CQLTL_MAX_CONNECTIONS", f"the system allows a process {hard} open files, connections included")
    if settings.max_in_flight > settings.max_connections:
        yield warning("CQLTL_MAX_IN_FLIGHT", "is more than CQLTL_MAX_CONNECTIONS, so it limits nothing")
    if settings.max_store_bytes and is_postgresql(settings.url):
        yield warning("CQLTL_MAX_STORE_BYTES", "limits SQLite only")


def _telemetry() -> Findings:
    wanted = any(name.startswith("OTEL_EXPORTER_OTLP") and name.endswith("ENDPOINT") for name in os.environ)
    try:
        there = find_spec("opentelemetry.exporter.otlp.proto.http") is not None
    except ModuleNotFoundError:
        there = False
    if wanted and not there:
        yield warning("OTEL_EXPORTER_OTLP_ENDPOINT", "nothing is exported: pip install 'cqltl[otel]'")

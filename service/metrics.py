"""What Prometheus is told. Each service has a registry of its own; docs/settings.md lists the metrics."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

from prometheus_client import (
    CollectorRegistry,
    Counter,
    Gauge,
    Histogram,
    PlatformCollector,
    ProcessCollector,
    disable_created_metrics,
    generate_latest,
    start_http_server,
)

from models.errors import CqltlError
from service.errors import CannotStartError
from service.worker import Call, CallCancelled, PlanAnswer, Workers, run_plan

disable_created_metrics()  # type: ignore[no-untyped-call]  # a time for each series, which nobody asked for

LATENCIES_S = (0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.25, 0.5, 1.0, 2.5, 5.0, 10.0, 30.0, 60.0)
SHARES = (0.1, 0.25, 0.5, 0.75, 0.9, 0.95, 0.99, 1.0)
STATES = tuple(10.0**power for power in range(1, 9))
SWEEPS = (1, 3, 10, 30, 100, 300, 1_000, 3_000, 10_000)


class Metrics:
    """Counts and times; any thread may add to them."""

    requests_in_flight = 0
    """How many the gate has let in and are not yet answered; of the event loop's thread alone."""

    def __init__(self) -> None:
        self._registry = found = CollectorRegistry()
        ProcessCollector(registry=found)
        PlatformCollector(registry=found)
        self._requests = Histogram(
            "cqltl_request_seconds",
            "Time to answer a request, in seconds.",
            ("method", "route", "status"),
            buckets=LATENCIES_S,
            registry=found,
        )
        self._translations = Counter(
            "cqltl_translations", "Commands that were translated.", ("translator", "outcome"), registry=found
        )
        self._confidence = Histogram(
            "cqltl_translation_confidence",
            "Confidence of the best reading of a command.",
            ("translator",),
            buckets=SHARES,
            registry=found,
        )
        self._plans = Counter("cqltl_plans", "Plans that ended, by outcome or problem.", ("outcome",), registry=found)
        self._plan_seconds = Histogram(
            "cqltl_plan_seconds", "Time to plan, in seconds.", buckets=LATENCIES_S, registry=found
        )
        self._plan_states = Histogram(
            "cqltl_plan_product_states", "States of the product of a plan.", buckets=STATES, registry=found
        )
        self._plan_sweeps = Histogram(
            "cqltl_plan_sweeps", "Sweeps of value iteration of a plan.", buckets=SWEEPS, registry=found
        )

    def answered(self, method: str, route: str, status: int, seconds: float) -> None:
        """A request was; `route` is its template, of which there are only so many."""
        self._requests.labels(method, route, str(status)).observe(seconds)

    def translated(self, translator: str, outcome: str, confidence: float | None) -> None:
        """A command was; without a reading there is no confidence."""
        self._translations.labels(translator, outcome).inc()
        if confidence is not None:
            self._confidence.labels(translator).observe(confidence)

    def called(self, call: Call[Any]) -> None:
        """A call of a worker process has ended."""
        if call.function is not run_plan:
            return
        outcome, answer = _outcome(call)
        self._plans.labels(outcome).inc()
        if answer is not None:
            self._plan_seconds.observe(call.seconds)
            self._plan_states.observe(answer.product_states)
            self._plan_sweeps.observe(answer.sweeps)

    def watch(self, name: str, meaning: str, value: Callable[[], float]) -> None:
        """Ask for a value whenever the metrics are read; NaN where it cannot be had."""

        def asked() -> float:
            try:
                return value()
            except Exception:  # the store does not answer; the other metrics are to be read all the more
                return math.nan

        Gauge(name, meaning, registry=self._registry).set_function(asked)

    def watch_workers(self, workers: Workers) -> None:
        """Say how many plan."""
        self.watch("cqltl_plans_running", "Planning processes at work.", lambda: workers.running)

    def serve(self, host: str, port: int) -> Callable[[], None]:
        """Answer Prometheus on a port of their own, in a thread; what ends that. Raises `CannotStartError`."""
        try:
            server, thread = start_http_server(port, addr=host, registry=self._registry)
        except OSError as error:
            raise CannotStartError(f"cannot listen on {host} port {port} ({error.strerror or error})") from error

        def stop() -> None:
            server.shutdown()
            server.server_close()
            thread.join()

        return stop

    def text(self) -> bytes:
        """Everything in Prometheus's text format."""
        return generate_latest(self._registry)


def _outcome(call: Call[Any]) -> tuple[str, PlanAnswer | None]:
    if call.future.cancelled():
        return "cancelled", None
    error = call.future.exception()
    if error is None:
        answer: PlanAnswer = call.future.result()
        return answer.outcome, answer
    if isinstance(error, CallCancelled):
        return "cancelled", None
    return (error.slug if isinstance(error, CqltlError) else "internal"), None

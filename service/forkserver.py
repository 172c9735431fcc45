"""The process that workers are forked from. It loads what they need once, so that each starts in milliseconds."""

from __future__ import annotations

import multiprocessing
from multiprocessing import forkserver
from multiprocessing.context import ForkServerContext

_PRELOADED = ["service.worker.preloaded"]


def context() -> ForkServerContext:
    """What makes processes by forking that process; the first to ask for one starts it."""
    found = multiprocessing.get_context("forkserver")
    found.set_forkserver_preload(_PRELOADED)
    return found


def launch() -> None:
    """Start that process now. It loads for a second or two, while this one goes on."""
    context()
    forkserver.ensure_running()

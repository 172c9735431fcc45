"""A child process that runs one call at a time, over a pipe of its own, so that its death concerns nobody else."""

from __future__ import annotations

import ctypes
import os
import pickle
import resource
import signal
import sys
import threading
import traceback
from collections.abc import Callable
from multiprocessing import forkserver
from multiprocessing.connection import Connection, wait
from multiprocessing.context import ForkServerContext
from pathlib import Path
from typing import Any

from models.errors import CqltlError
from service.errors import OutOfMemoryError, OutOfTimeError, WorkerDiedError
from service.worker import progress

PR_SET_PDEATHSIG = 1
"""Linux's prctl(2): the signal that a process gets when its parent ends."""

NVIDIA = Path("/proc/driver/nvidia")
"""There where a GPU is. CUDA reserves far more address space than it uses, and does not start where that is limited."""

_processes = threading.Lock()
"""Held by whoever starts a process or asks for its end: to start one asks for the ends of all others, and two threads
must not read the same one.
"""

_board: list[progress.Board] = []
"""In the child: the board that its parent reads."""


def board() -> progress.Board:
    """The board of this process; one that nobody reads where it is not a child."""
    return _board[0] if _board else [0.0] * progress.SIZE


class Child:
    """The parent's end. One thread uses it, but for `kill`."""

    def __init__(self, context: ForkServerContext, initializer: Callable[[], None], memory_bytes: int) -> None:
        self.board: progress.Board = context.RawArray("d", progress.SIZE)
        self._connection, theirs = context.Pipe()
        arguments = (theirs, initializer, memory_bytes, self.board)
        self._process = context.Process(target=_serve, args=arguments, name="cqltl-worker", daemon=True)
        try:
            with _processes:
                self._process.start()
        except BaseException:
            self._connection.close()
            raise
        finally:
            theirs.close()
        self._ready = self._killed = False

    @property
    def usable(self) -> bool:
        """It can be given a further call."""
        with _processes:
            return not self._killed and self._process.is_alive()

    def prepare(self) -> None:
        """Wait until everything is loaded; raises `WorkerDiedError`."""
        if not self._ready:
            self._receive(None)
            self._ready = True

    def call(self, function: Callable[[Any], Any], argument: Any, timeout_s: float) -> Any:
        """`function(argument)`, run there; raises what it raises.

        Raises:
            OutOfTimeError: it took longer; the process is killed.
            OutOfMemoryError: it needed more memory than the process may have; the process ends.
            WorkerDiedError: the process ended before it answered.
        """
        message = pickle.dumps((function, argument))
        progress.clear(self.board)
        try:
            self._connection.send_bytes(message)
        except OSError:
            raise self._died() from None
        succeeded, value = self._receive(timeout_s)
        if succeeded:
            return value
        if isinstance(value, OutOfMemoryError):
            self.kill()
        raise value

    def kill(self) -> None:
        """End it at once, whatever it does; any thread may."""
        self._killed = True
        self._process.kill()

    def close(self) -> None:
        """Kill it and free what it holds here."""
        self._process.kill()
        with _processes:
            self._process.join()
            self._process.close()
        self._connection.close()

    def _receive(self, timeout_s: float | None) -> Any:
        if not wait([self._connection, self._process.sentinel], timeout_s):
            self.kill()
            raise OutOfTimeError(f"stopped after {timeout_s:g} s without an answer")
        try:
            return self._connection.recv()  # also where the process ended right after it answered
        except (EOFError, OSError):
            raise self._died() from None

    def _died(self) -> WorkerDiedError:
        with _processes:
            self._process.join()
        return WorkerDiedError(f"the process that worked on this died (status {self._process.exitcode})")


def _serve(connection: Connection, initializer: Callable[[], None], memory_bytes: int, shared: progress.Board) -> None:
    """What the child does: answer calls until the parent is gone."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is for the parent
    _die_with_parent()
    _board[:] = [shared]
    initializer()
    if memory_bytes and not NVIDIA.exists():
        resource.setrlimit(resource.RLIMIT_AS, (memory_bytes, memory_bytes))
    try:
        connection.send(True)
        while True:
            function, argument = connection.recv()
            connection.send_bytes(pickle.dumps(_answer(function, argument)))
            del function, argument
    except (EOFError, OSError):
        return


def _answer(function: Callable[[Any], Any], argument: Any) -> tuple[bool, Any]:
    try:
        return True, function(argument)
    except MemoryError:
        limit, _ = resource.getrlimit(resource.RLIMIT_AS)
        within = "" if limit == resource.RLIM_INFINITY else f" ({limit} bytes)"
        return False, OutOfMemoryError(f"this needs more memory than a worker process may have{within}")
    except CqltlError as error:
        return False, error
    except Exception as error:
        return False, _portable(error)


def _portable(error: Exception) -> Exception:
    """An exception that pickles, with where it was raised."""
    try:
        pickle.loads(pickle.dumps(error))
    except Exception:
        error = RuntimeError(f"{type(error).__name__}: {error}")
    error.add_note(traceback.format_exc())
    return error


def _die_with_parent() -> None:
    """Not to plan on for nobody when the service is killed: its fork server ends with it, and this process with that.

    The fork server ends when the last copy of a pipe is closed, of which each of its children inherits one.
    """
    inherited = getattr(getattr(forkserver, "_forkserver", None), "_forkserver_alive_fd", None)
    if sys.platform == "linux" and inherited is not None:
        ctypes.CDLL(None).prctl(PR_SET_PDEATHSIG, signal.SIGKILL)
        os.close(inherited)

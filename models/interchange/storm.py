"""stormpy, imported only where it is needed, and its complaints as refusals.

Storm is a C++ library: it writes its complaints to the terminal as well, which is silenced while it works here.
"""

from __future__ import annotations

import re
import signal
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from models.interchange.errors import PrismModelError, PrismSyntaxError, StormMissingError
from models.source import locate

_PLACE = re.compile(r"Parsing error at (\d+):(\d+):\s*(.*?)(?:, here:|\n|\Z)", re.DOTALL)
_PREFIX = re.compile(r"\A(?:\w+Exception: )+")
_UNSAID = "std::exception"  # of an unknown variable in an assignment, for one
_TAB = 4
_GRACE_S = 3  # how long Storm may take to stop after its time is over, before the process is ended


def storm() -> Any:
    """The module. Raises StormMissingError."""
    try:
        import stormpy
    except ImportError as error:
        raise StormMissingError(
            "reading PRISM models needs Storm: pip install 'cqltl[prism]', or stormpy as in https://www.stormchecker.org"
        ) from error
    if not hasattr(stormpy, "parse_prism_program"):
        raise StormMissingError("the module `stormpy` found here is not Storm's, or older than 2.0")
    return stormpy


@contextmanager
def silent(stormpy: Any) -> Iterator[None]:
    """Storm without its log on the terminal."""
    level = stormpy.developer.get_log_level()
    stormpy.developer.set_log_level(stormpy.developer.LogLevel.OFF)
    try:
        yield
    finally:
        stormpy.developer.set_log_level(level)


@contextmanager
def bounded(stormpy: Any, timeout_s: int | None) -> Iterator[None]:
    """Storm stops after so many seconds. In the main thread only: the alarm is a signal."""
    if timeout_s is None:
        yield
        return
    handlers = {number: signal.getsignal(number) for number in (signal.SIGALRM, signal.SIGINT, signal.SIGTERM)}
    stormpy.developer.install_signal_handler(_GRACE_S)
    stormpy.developer.set_timeout_alarm(timeout_s)
    try:
        yield
    finally:
        stormpy.developer.reset_timeout_alarm()
        for number, handler in handlers.items():
            signal.signal(number, signal.SIG_DFL if handler is None else handler)  # None: not set from Python


def syntax_error(error: Exception, text: str) -> PrismSyntaxError:
    """What Storm's parser says of a text, with the place if it names one."""
    found = _PLACE.search(str(error))
    if found is None:
        unsaid = "it cannot be read; perhaps an update sets a variable that does not exist"
        return PrismSyntaxError(unsaid if str(error) == _UNSAID else sentence(error))
    wanted = " ".join(found[3].split()).rstrip(",.") or "it cannot be read"
    at = locate(text, _offset(text, int(found[1]), int(found[2])))
    return PrismSyntaxError(
        f"line {at.line}, column {at.column}: {wanted}", line=at.line, column=at.column, caret=at.caret
    )


def _offset(text: str, line: int, column: int) -> int:
    """Where in the text Storm means: it goes on to the next multiple of four columns at a tab, and may point at the
    space before a word.
    """
    lines = text.split("\n")
    start, shown = sum(len(before) + 1 for before in lines[: line - 1]), 1
    content = lines[line - 1] if line <= len(lines) else ""
    index = 0
    while index < len(content) and shown < column:
        shown += _TAB - (shown - 1) % _TAB if content[index] == "\t" else 1
        index += 1
    while index < len(content) - 1 and content[index].isspace():
        index += 1
    return min(start + index, len(text))


def model_error(error: Exception, timeout_s: int | None) -> PrismModelError:
    """What Storm says while it builds a model."""
    if "Abort" in str(error):
        return PrismModelError(f"building the model takes longer than {timeout_s} s")
    return PrismModelError(f"Storm cannot build the model: {sentence(error)}")


def sentence(error: Exception) -> str:
    """Storm's message without the names of its exceptions."""
    return " ".join(_PREFIX.sub("", str(error)).split()).rstrip(".") or type(error).__name__

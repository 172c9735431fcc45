"""The log: lines for people, or JSON for machines, each with the request and the job that it is about."""

from __future__ import annotations

import json
import logging
import sys
from contextvars import ContextVar
from datetime import UTC, datetime
from typing import Any, Literal

LogFormat = Literal["text", "json"]
LogLevel = Literal["debug", "info", "warning", "error"]

REQUEST_ID: ContextVar[str | None] = ContextVar("request_id", default=None)
"""The request that is being answered."""
JOB_ID: ContextVar[str | None] = ContextVar("job_id", default=None)
"""The job that is being run, or that a request was answered with."""


def configure(form: LogFormat, level: LogLevel) -> None:
    """Write the log of this process to standard error, in place of what wrote it before."""
    handler = logging.StreamHandler(sys.stderr)
    handler.setFormatter(JsonFormatter() if form == "json" else TextFormatter())
    root = logging.getLogger()
    root.handlers[:] = [handler]
    root.setLevel(logging.WARNING)  # of libraries, only what matters
    logging.getLogger("cqltl").setLevel(level.upper())


class JsonFormatter(logging.Formatter):
    """A JSON object in a line. What is passed as `extra={"fields": {...}}` are members of it."""

    def format(self, record: logging.LogRecord) -> str:
        """The line."""
        values: dict[str, Any] = {
            "time": _time(record, "milliseconds"),
            "level": record.levelname.lower(),
            "logger": record.name,
            "message": record.getMessage(),
            **_ids(),
            **getattr(record, "fields", {}),
        }
        if record.exc_info:
            values["exception"] = self.formatException(record.exc_info)
        return json.dumps(values, ensure_ascii=False, default=str)


class TextFormatter(logging.Formatter):
    """Time, level, what happened, and what it is about."""

    def format(self, record: logging.LogRecord) -> str:
        """The line, and the lines of an exception."""
        about = "".join(f" {name}={value}" for name, value in _ids().items())
        message = record.getMessage().replace("\n", "\\n") if not record.exc_info else record.getMessage()
        line = f"{_time(record, 'seconds')} {record.levelname.lower()} {record.name}: {message}{about}"
        return f"{line}\n{self.formatException(record.exc_info)}" if record.exc_info else line


def _time(record: logging.LogRecord, precision: str) -> str:
    return datetime.fromtimestamp(record.created, UTC).isoformat(timespec=precision)


def _ids() -> dict[str, str]:
    found = {"request_id": REQUEST_ID.get(), "job_id": JOB_ID.get()}
    return {name: value for name, value in found.items() if value is not None}

"""Settings from the environment, prefix `CQLTL_`. docs/settings.md lists each one; a test compares the two."""

from __future__ import annotations

from functools import cached_property
from pathlib import Path

from pydantic import Field, SecretStr, field_validator
from pydantic_settings import BaseSettings, SettingsConfigDict
from sqlalchemy.engine import make_url
from sqlalchemy.exc import ArgumentError

from service.logs import LogFormat, LogLevel


class Settings(BaseSettings):
    """Everything a deployment can set."""

    model_config = SettingsConfigDict(env_prefix="CQLTL_", env_ignore_empty=True, frozen=True, extra="ignore")

    data_dir: Path = Field(Path("data"), description="Folder of the default SQLite file; made when missing.")
    database_url: str = Field("", description="SQLAlchemy URL of the store; empty is cqltl.sqlite3 in data_dir.")
    host: str = Field("127.0.0.1", description="Address that `cqltl serve` binds.")
    port: int = Field(8000, ge=0, le=65535, description="Port that `cqltl serve` binds.")
    workers: int = Field(2, ge=1, le=256, description="Processes that plan; one plan at a time each.")
    max_waiting: int = Field(32, ge=0, description="Requests that may wait for a process before 503.")
    max_body_bytes: int = Field(1_048_576, ge=1, description="Largest request body, in bytes.")
    max_json_depth: int = Field(64, ge=8, le=500, description="Deepest nesting of arrays and objects in a body.")
    max_head_bytes: int = Field(16_384, ge=1_024, description="Longest request line with its headers, in bytes.")
    max_connections: int = Field(1_000, ge=1, description="Connections at a time before 503, but for /livez.")
    max_in_flight: int = Field(500, ge=1, description="Requests being answered at a time before 503.")
    head_timeout_s: float = Field(5.0, gt=0, description="Longest time for a request's head to arrive, in seconds.")
    body_timeout_s: float = Field(8.0, gt=0, description="Longest time for a request's body to arrive, in seconds.")
    keep_alive_s: int = Field(5, ge=1, description="How long a connection may be idle between requests.")
    write_timeout_s: float = Field(30.0, gt=0, description="How long a client may leave an answer unread, in seconds.")
    rate_limit: float = Field(0.0, ge=0, description="Requests per second that one client may send; 0 sets no limit.")
    rate_burst: int = Field(20, ge=1, description="Requests that one client may send at once, above the rate.")
    api_keys_file: Path | None = Field(None, description="File of API keys; without it requests need none.")
    api_key: SecretStr = Field(SecretStr(""), description="API key that the command line sends to `--server`.")
    allow_unauthenticated: bool = Field(False, description="Listen beyond loopback although no API key is asked for.")
    allowed_origins: str = Field("", description="Web origins that may read answers (CORS), separated by commas.")
    trusted_proxies: str = Field("", description="Addresses whose X-Forwarded-For is believed, separated by commas.")
    plan_timeout_s: float = Field(30.0, gt=0, description="Longest time to plan or simulate, in seconds.")
    wait_s: float = Field(5.0, ge=0, description="Seconds that `/plan` waits unless the request prefers otherwise.")
    max_wait_s: float = Field(60.0, ge=0, description="Longest wait that a request may prefer, in seconds.")
    job_deadline_s: float = Field(3600.0, gt=0, description="Longest time from a job's acceptance to its end.")
    job_lease_s: float = Field(10.0, ge=1, description="Seconds after which a job of a dead process is taken up.")
    job_retention_s: float = Field(604_800.0, ge=0, description="How long jobs that ended are kept, in seconds.")
    idempotency_s: float = Field(86_400.0, ge=0, description="How long Idempotency-Keys are remembered, in seconds.")
    worker_memory_bytes: int = Field(
        17_179_869_184, ge=0, description="Address space of one worker process, in bytes; 0 sets no limit."
    )
    max_store_bytes: int = Field(0, ge=0, description="Largest size of the SQLite file, in bytes; 0 sets no limit.")
    translation_cache_bytes: int = Field(
        67_108_864, ge=0, description="Most bytes of translations kept to be given again; 0 keeps none."
    )
    policy_cache_bytes: int = Field(
        536_870_912, ge=0, description="Most bytes of policies kept at hand for their steps, beside the store."
    )
    logic_timeout_s: float = Field(5.0, gt=0, description="Longest time to check a formula, in seconds.")
    log_format: LogFormat = Field("text", description="`text` for people, `json` for a line of JSON each.")
    log_level: LogLevel = Field("warning", description="The least that is logged; `info` has a line for each request.")
    worker_metrics_port: int = Field(
        0, ge=0, le=65535, description="Port of `cqltl worker` for metrics, which it tells without a key; 0 opens none."
    )
    max_states: int = Field(50_000_000, ge=1, description="Most product states a request may ask for.")

    @field_validator("database_url")
    @classmethod
    def _known_database(cls, value: str) -> str:
        try:
            kind = make_url(value).get_backend_name() if value else "sqlite"
        except ArgumentError as error:
            raise ValueError("is no SQLAlchemy URL, such as postgresql+psycopg://user:password@host/name") from error
        if kind not in ("sqlite", "postgresql"):
            raise ValueError(f"is of {kind}; the store is in SQLite or PostgreSQL")
        return value

    @cached_property
    def url(self) -> str:
        """The store's SQLAlchemy URL, with the default filled in."""
        return self.database_url or f"sqlite:///{self.data_dir.absolute() / 'cqltl.sqlite3'}"

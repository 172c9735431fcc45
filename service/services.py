"""What the use cases work with; made once, by the composition root."""

from __future__ import annotations

import json
import threading
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, fields
from functools import lru_cache
from threading import Lock
from typing import TYPE_CHECKING, Any, Self, TypeVar

import numpy as np
from anyio import CapacityLimiter
from anyio.to_thread import run_sync
from sqlalchemy.exc import SQLAlchemyError

from models.language.hearing import Lessons
from models.world import Environment, load_environment
from service.cache import ByteCache
from service.errors import NotReadyError
from service.freshness import Freshness
from service.jobs import Executor
from service.metrics import Metrics
from service.settings import Settings
from service.store import Store, StoredExample, StoredPolicy, Versions
from service.taught import KnownCache, Taught, TaughtCache, read_example
from service.translators import Translators
from service.worker import Workers

if TYPE_CHECKING:  # planning loads SciPy, which a server needs only when a robot acts
    from models.planning import Policy

T = TypeVar("T")

TRANSLATING = 1
"""Threads that translate."""
ENVIRONMENTS = 64
"""Environments that are held."""


@dataclass(frozen=True, slots=True)
class LoadedEnvironment:
    """An environment, and its data as JSON text, which is what a worker process is sent."""

    text: str
    value: Environment

    @classmethod
    def read(cls, data: Mapping[str, Any]) -> Self:
        """Check the data of an environment; raises `WorldError`."""
        return cls(json.dumps(data), load_environment(data))


class Services:
    """The store, the worker processes, what makes plans, and the translators, with small caches of what was read from
    the store. `closing` is set when the server stops.
    """

    def __init__(
        self,
        *,
        settings: Settings,
        store: Store,
        workers: Workers,
        jobs: Executor,
        translators: Translators,
        metrics: Metrics | None = None,
        closing: threading.Event | None = None,
    ) -> None:
        self.settings = settings
        self.store = store
        self.workers = workers
        self.jobs = jobs
        self.closing = closing or threading.Event()
        self.translators = translators
        self.metrics = metrics or Metrics()
        self._taught = TaughtCache()
        self._utterances = KnownCache()
        self._noted = False  # whether what the store has of utterances was taken over
        self._reading = Lock()
        self._networks = CapacityLimiter(TRANSLATING)
        self.freshness = Freshness(store)
        self._policies: ByteCache[str, tuple[StoredPolicy, Policy]] = ByteCache(settings.policy_cache_bytes)
        self._parsed = lru_cache(maxsize=ENVIRONMENTS)(_parse_environment)
        self._worlds: dict[str, tuple[int, LoadedEnvironment]] = {}  # by name, as of a version

    def environment(self, name: str, versions: Versions | None = None) -> LoadedEnvironment:
        """The stored environment of that name, not older than versions that were read; raises
        `UnknownEnvironmentError`.
        """
        held = self._worlds.get(name)
        if held is not None and versions is not None and held[0] == versions.worlds:
            return held[1]
        with self.store.read() as transaction:
            found = self._parsed(transaction.environments.text(name))
        if versions is not None:
            if len(self._worlds) >= ENVIRONMENTS:
                self._worlds = {}
            self._worlds[name] = (versions.worlds, found)
        return found

    def parsed(self, text: str) -> LoadedEnvironment:
        """An environment of its data as JSON text."""
        return self._parsed(text)

    def known(self) -> Taught:
        """The templates and the examples of now."""
        return self.now()[1]

    def now(self) -> tuple[Versions, Taught]:
        """The versions of now, with the templates and the examples."""
        versions = self.store.versions()
        held = self._taught.held(versions.lessons)
        if held is not None:
            return versions, held
        with self.store.read() as transaction:
            versions = transaction.versions()
            return versions, self._taught.of(transaction, versions.lessons)

    def lessons(self, taught: Taught) -> Lessons:
        """What the default translator hears besides its networks."""
        matcher = self.translators.matcher
        with self._reading:
            if not self._noted:
                with self.store.read() as transaction:
                    readings = transaction.templates.examples.readings()
                self._utterances.note(readings, taught.stored.values(), matcher)
                self._noted = True
            return taught.lessons(matcher, self._utterances, own=self.translators.own)

    def note_examples(self, examples: Sequence[StoredExample]) -> None:
        """Keep what the matcher reads in new examples, so that no process has to read them again."""
        matcher = self.translators.matcher
        known = self._utterances.of([read_example(example) for example in examples], matcher)
        with self.store.write() as transaction:
            notes = [(e.id, matcher.to_bytes(read)) for e, read in zip(examples, known, strict=True)]
            transaction.templates.examples.note(notes)

    def policy(self, policy_id: str) -> tuple[StoredPolicy, Policy]:
        """The stored policy and its value; raises `UnknownPolicyError`. Policies never change, so they are kept."""
        found = self._policies.get(policy_id)
        if found is None:
            found = self._read_policy(policy_id)
            self._policies.put(policy_id, found, _size(*found))
        return found

    def policy_at_hand(self, policy_id: str) -> Policy | None:
        """The policy if the store need not be asked for it."""
        found = self._policies.get(policy_id)
        return None if found is None else found[1]

    async def in_turn(self, function: Callable[[], T]) -> T:
        """What `function` gives, which asks the networks: one after the other, first come, first served, in a thread.

        More threads at a time are no faster, since most of a translation holds the interpreter's lock; all would be
        late instead of some.
        """
        return await run_sync(function, limiter=self._networks)

    def forget_policy(self, policy_id: str) -> None:
        """Delete a policy; other processes may answer from their cache for a while."""
        with self.store.write() as transaction:
            transaction.policies.delete(policy_id)
        self._policies.forget(policy_id)

    def check(self) -> None:
        """Raise `NotReadyError` when the store does not answer."""
        try:
            self.store.ping()
        except SQLAlchemyError as error:
            raise NotReadyError(f"the store does not answer ({type(error).__name__})") from error

    def _read_policy(self, policy_id: str) -> tuple[StoredPolicy, Policy]:
        from models.planning import from_bytes

        with self.store.read() as transaction:
            stored = transaction.policies.get(policy_id)
        return stored, from_bytes(stored.data)


def _size(stored: StoredPolicy, policy: Policy) -> int:
    """Bytes that a policy takes."""
    arrays = [value for each in fields(policy) if isinstance(value := getattr(policy, each.name), np.ndarray)]
    return len(stored.data) + len(stored.world) + sum(array.nbytes for array in arrays)


def _parse_environment(text: str) -> LoadedEnvironment:
    return LoadedEnvironment(text, load_environment(json.loads(text)))

"""The HTTP part of the node: a command becomes a policy, observed states become actions. Needs nothing but Python."""

from __future__ import annotations

import json
import time
import urllib.error
import urllib.request
from dataclasses import dataclass
from typing import Any

State = dict[str, dict[str, str]]


class ServiceError(Exception):
    """The service refused, or does not answer; `kind` is the slug of the problem, or `unreachable`."""

    def __init__(self, kind: str, detail: str) -> None:
        super().__init__(f"{kind}: {detail}")
        self.kind = kind


@dataclass(frozen=True)
class Step:
    """What to do: `action` is None where the robot is to let a step pass, or to stop."""

    status: str  # running, sustaining, satisfied, lost
    action: str | None


class Follower:
    """Holds one policy and its memory. Calls block: use it from one thread, not from ROS callbacks that must return."""

    def __init__(self, server: str, environment: str, timeout_s: float = 70.0) -> None:
        self._server, self._environment, self._timeout_s = server.rstrip("/"), environment, timeout_s
        self._policy: str | None = None
        self._memory = 0
        self._command = ""

    def take(self, command: str, state: State | None = None) -> str:
        """Plan for a command from a state; what it was taken for, in English."""
        self._policy = None
        body: dict[str, Any] = {"text": command, "environment": self._environment}
        if state is not None:
            body["state"] = state
        answer = self._ask("/plan", body)
        while "state" in answer:  # a job: the plan takes longer than the request waited
            if answer["error"] is not None:
                raise ServiceError(_kind(answer["error"]), answer["error"]["detail"])
            if answer["plan"] is not None:
                answer = answer["plan"]
                break
            if answer["state"] == "cancelled":
                raise ServiceError("cancelled", "somebody cancelled the plan")
            time.sleep(0.5)
            answer = self._ask(answer["url"])
        if answer["policy"] is None:
            raise ServiceError(answer["outcome"], "no run satisfies the command")
        self._policy, self._memory, self._command = answer["policy"]["url"], answer["initial"]["memory"], command
        return str(answer["explanation"])

    @property
    def busy(self) -> bool:
        """There is a command that is not done yet."""
        return self._policy is not None

    def step(self, state: State) -> Step:
        """What to do in the state observed; plans again where the robot was moved out of the plan's reach."""
        if self._policy is None:
            raise ServiceError("idle", "there is no command")
        try:
            answer = self._ask(f"{self._policy}/step", {"state": state, "memory": self._memory})
        except ServiceError as error:
            if error.kind != "invalid-state":
                raise
            self.take(self._command, state)
            answer = self._ask(f"{self._policy}/step", {"state": state, "memory": self._memory})
        self._memory = answer["memory"]
        if answer["status"] in ("satisfied", "lost"):
            self._policy = None
        return Step(answer["status"], answer["action"])

    def _ask(self, path: str, body: dict[str, Any] | None = None) -> dict[str, Any]:
        data = None if body is None else json.dumps(body).encode()
        request = urllib.request.Request(self._server + path, data, {"Content-Type": "application/json"})
        try:
            with urllib.request.urlopen(request, timeout=self._timeout_s) as response:
                found: dict[str, Any] = json.load(response)
                return found
        except urllib.error.HTTPError as error:
            with error:
                problem = json.load(error)
            raise ServiceError(_kind(problem), problem["detail"]) from None
        except OSError as error:
            raise ServiceError("unreachable", str(error)) from error


def _kind(problem: dict[str, Any]) -> str:
    return str(problem["type"]).rpartition(":")[2]

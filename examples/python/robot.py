"""A robot's control loop over HTTP: command in, actions out, until the task is done. Needs httpx.

    python robot.py ["Put the cylinder in the box, then put the box in the bedroom"] [--server http://127.0.0.1:8000]

In place of a robot there is `Simulated`, in the four rooms of the environment toys-4x1-cylinder. Write a class with its
two methods for yours: `observe` gives every attribute that changes, `act` does an action and returns when it is over.
"""

import argparse
import time
import uuid
from typing import Any, Protocol, Self

import httpx

State = dict[str, dict[str, str]]
Json = dict[str, Any]


class Refused(Exception):
    """The service refused a request; `problem` is what it said (docs/http.md lists the kinds)."""

    def __init__(self, problem: Json) -> None:
        super().__init__(problem["detail"])
        self.problem = problem
        self.kind = problem["type"].removeprefix("urn:cqltl:problem:")


class Robot(Protocol):
    def observe(self) -> State: ...

    def act(self, action: str | None) -> None: ...


class Service:
    """The few requests that a control loop needs, sent again where that is safe."""

    def __init__(self, server: str, tries: int = 5) -> None:
        self._http = httpx.Client(base_url=server, timeout=70)  # a plan may be waited for that long
        self._tries = tries

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self._http.close()

    def plan(self, command: str, environment: str, state: State | None = None) -> Json:
        """The plan for a command, from a state or the initial one, however long it takes."""
        body = {"text": command, "environment": environment} | ({"state": state} if state else {})
        # Under the same key the same request is answered with the same plan or job, so it can be repeated.
        answer = self._send("POST", "/plan", json=body, headers={"Idempotency-Key": str(uuid.uuid4())})
        while answer.status_code == 202 or answer.json().get("state") in ("queued", "running"):
            time.sleep(float(answer.headers.get("retry-after", 1)))
            answer = self._send("GET", answer.json()["url"])
        job_or_plan: Json = answer.json()
        if job_or_plan.get("error"):
            raise Refused(job_or_plan["error"])
        return job_or_plan.get("plan") or job_or_plan

    def step(self, policy: str, state: State, memory: int) -> Json:
        """What to do in this state; nothing is stored, so it can be asked again."""
        found: Json = self._send("POST", f"{policy}/step", json={"state": state, "memory": memory}).json()
        return found

    def _send(self, method: str, path: str, **more: Any) -> httpx.Response:
        """Try again what reached no service, or came when it was too busy."""
        for attempt in range(self._tries):
            last = attempt == self._tries - 1
            try:
                response = self._http.request(method, path, **more)
            except httpx.TransportError:
                if last:
                    raise
                time.sleep(2**attempt / 10)
                continue
            if response.status_code in (429, 503) and not last:
                time.sleep(float(response.headers.get("retry-after", 1)))
            elif response.is_success:
                return response
            else:
                raise Refused(response.json())
        raise AssertionError("the last try returns or raises")


def carry_out(service: Service, robot: Robot, command: str, environment: str) -> str:
    """Have the robot do it: `satisfied`, or `lost` when it cannot be done any more."""
    plan = service.plan(command, environment, robot.observe())
    if plan["policy"] is None:
        return "lost"
    print(f"{plan['explanation']}: probability {plan['probability']['lower']:.3f}, {plan['expected_steps']:.1f} steps")
    memory = plan["initial"]["memory"]
    while True:
        state = robot.observe()
        try:
            step = service.step(plan["policy"]["url"], state, memory)
        except Refused as refused:
            if refused.kind != "invalid-state":
                raise
            # The robot was moved to where the plan does not reach: make one for there. It begins the task anew.
            plan = service.plan(command, environment, state)
            if plan["policy"] is None:
                return "lost"
            memory = plan["initial"]["memory"]
            continue
        memory = step["memory"]
        if step["status"] in ("satisfied", "lost"):
            return str(step["status"])
        print(f"{state['robot']['at']}: {step['action'] or 'wait'}")
        robot.act(step["action"])


class Simulated:
    """A gripper in a row of rooms, with a box and a toy; it does what it is told at once, and never fails."""

    ROOMS = ("kitchen", "living_room", "bedroom", "bathroom")

    def __init__(self) -> None:
        self._robot, self._things = "kitchen", {"box": "living_room", "cylinder": "bathroom"}

    def observe(self) -> State:
        return {"robot": {"at": self._robot}, **{name: {"in": place} for name, place in self._things.items()}}

    def act(self, action: str | None) -> None:
        verb, _, rest = (action or "").removesuffix(")").partition("(")
        names = rest.split(", ")
        if verb in ("east", "west"):
            position = self.ROOMS.index(self._robot) + (1 if verb == "east" else -1)
            self._robot = self.ROOMS[min(max(position, 0), len(self.ROOMS) - 1)]
        elif verb in ("pick", "take"):
            self._things[names[0]] = "robot"
        elif verb == "drop":
            self._things[names[0]] = self._robot
        elif verb == "put":
            self._things[names[0]] = names[1]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("command", nargs="?", default="Put the cylinder in the box, then put the box in the bedroom")
    parser.add_argument("--server", default="http://127.0.0.1:8000")
    options = parser.parse_args()
    with Service(options.server) as service:
        print(carry_out(service, Simulated(), options.command, "toys-4x1-cylinder"))


if __name__ == "__main__":
    main()

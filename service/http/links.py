"""OpenAPI links: which requests go on from an answer, and with what of it."""

from __future__ import annotations

from typing import Any

_BODY = "$response.body#"
_POLICY = {"policy_id": f"{_BODY}/policy/id"}
_OBSERVED = f"{_BODY}/initial"
_JOB = {"job_id": f"{_BODY}/id"}
_ENVIRONMENT = {"name": f"{_BODY}/name"}
_TASK = {"task": f"{_BODY}/task"}

_LINKS: dict[tuple[str, str], list[tuple[str, dict[str, str], str | None]]] = {
    ("plan", "200"): [
        ("stepPolicy", _POLICY, _OBSERVED),
        ("getPolicy", _POLICY, None),
        ("simulatePolicy", _POLICY, None),
        ("getPolicyAutomaton", _POLICY, None),
        ("deletePolicy", _POLICY, None),
    ],
    ("plan", "202"): [("getJob", _JOB, None), ("getJobEvents", _JOB, None), ("cancelJob", _JOB, None)],
    ("createEnvironment", "201"): [
        ("getEnvironment", _ENVIRONMENT, None),
        ("deleteEnvironment", _ENVIRONMENT, None),
    ],
    ("learn", "201"): [("getTemplate", _TASK, None), ("listExamples", _TASK, None), ("deleteTemplate", _TASK, None)],
}
"""Operation and status of an answer to the operations that go on from it, their parameters, and their body."""


def document_links(document: dict[str, Any]) -> None:
    """Add them to the document."""
    for path in document["paths"].values():
        for operation in path.values():
            for status, response in operation["responses"].items():
                links = _LINKS.get((operation["operationId"], status))
                if links:
                    response["links"] = {name: _link(name, parameters, body) for name, parameters, body in links}


def _link(operation: str, parameters: dict[str, str], body: str | None) -> dict[str, Any]:
    said: dict[str, Any] = {"operationId": operation, "parameters": dict(parameters)}
    return said if body is None else {**said, "requestBody": body}

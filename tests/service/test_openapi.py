"""openapi.yaml is what the app serves, valid, and documents errors as they are sent."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import httpx
import pytest
import yaml
from openapi_spec_validator import validate

from service.http.problems import STATUS

ROOT = Path(__file__).parents[2]


@pytest.fixture(scope="module")
def document(client: httpx.Client) -> dict[str, Any]:
    found: dict[str, Any] = client.get("/openapi.json").json()
    return found


def test_the_file_is_what_the_app_serves(document: dict[str, Any]) -> None:
    assert yaml.safe_load((ROOT / "openapi.yaml").read_text(encoding="utf-8")) == document


def test_the_documentation_page_needs_no_other_machine(client: httpx.Client) -> None:
    page = client.get("/docs").text
    sources = re.findall(r'(?:src|href)="([^"]*)"', page)
    assert len(sources) >= 3
    for source in sources:
        assert source.startswith("/")
        assert client.get(source).status_code == 200


def test_it_is_a_valid_document(document: dict[str, Any]) -> None:
    validate(document)


def test_every_error_is_a_problem(document: dict[str, Any]) -> None:
    for path in document["paths"].values():
        for operation in path.values():
            assert operation["operationId"]
            for status, response in operation["responses"].items():
                if status == "default" or status >= "400":
                    assert list(response["content"]) == ["application/problem+json"]


def test_no_union_lacks_a_discriminator(document: dict[str, Any]) -> None:
    def check(schema: Any) -> None:
        if isinstance(schema, list):
            for item in schema:
                check(item)
        elif isinstance(schema, dict):
            for key in ("oneOf", "anyOf"):
                members = [m for m in schema.get(key, []) if m != {"type": "null"}]
                assert len(members) < 2 or "discriminator" in schema, schema
            for value in schema.values():
                check(value)

    check(document)


def test_every_status_that_slugs_have_is_documented_somewhere(document: dict[str, Any]) -> None:
    documented = {
        status
        for path in document["paths"].values()
        for operation in path.values()
        for status in operation["responses"]
    }
    assert {
        str(status) for slug, status in STATUS.items() if slug not in ("internal", "method-not-allowed")
    } <= documented


def test_the_file_has_no_aliases() -> None:
    """YAML libraries expand a few, and openapi-generator's refuses more."""
    events = list(yaml.parse((ROOT / "openapi.yaml").read_text(encoding="utf-8")))
    assert not [event for event in events if isinstance(event, yaml.AliasEvent)]


def test_every_union_and_state_has_a_name(document: dict[str, Any]) -> None:
    """Generators make a type of each schema, with the name of the component or, where it has none, an odd one."""
    components = document["components"]["schemas"]
    unions = [name for name, schema in components.items() if "oneOf" in schema]
    assert unions == ["EnvironmentSpec"]
    text = str({**document, "components": {name: s for name, s in components.items() if name not in unions}})
    assert "'oneOf'" not in text
    for request in ("PlanRequest", "TranslateRequest", "GroundRequest", "StepRequest"):
        state = components[request]["properties"]["state"]
        assert "#/components/schemas/State" in str(state), request


def test_links_go_on_to_what_is_there(document: dict[str, Any]) -> None:
    """Their operations take the parameters, all that are in the path; their answers and bodies have the members."""
    operations = {
        operation["operationId"]: operation for path in document["paths"].values() for operation in path.values()
    }
    links = [
        (operation, response, link)
        for operation in operations.values()
        for response in operation["responses"].values()
        for link in response.get("links", {}).values()
    ]
    assert len(links) >= 10
    for _, response, link in links:
        target = operations[link["operationId"]]
        needed = {parameter["name"] for parameter in target["parameters"] if parameter["in"] == "path"}
        assert set(link["parameters"]) == needed
        answer = response["content"]["application/json"]["schema"]
        for expression in link["parameters"].values():
            assert said_by(document, answer, expression)
        if "requestBody" in link:
            sent = resolved(document, said_by(document, answer, link["requestBody"]))
            body = resolved(document, target["requestBody"]["content"]["application/json"]["schema"])
            assert set(body["required"]) <= set(sent["properties"]) <= set(body["properties"])


def said_by(document: dict[str, Any], schema: dict[str, Any], expression: str) -> dict[str, Any]:
    """The schema of what an expression takes from an answer."""
    for member in expression.removeprefix("$response.body#/").split("/"):
        schema = resolved(document, schema)["properties"][member]
    return schema


def resolved(document: dict[str, Any], schema: dict[str, Any]) -> dict[str, Any]:
    """What a reference refers to, and what is not null of something that may be null."""
    schema = next((part for part in schema.get("anyOf", []) if part != {"type": "null"}), schema)
    found: dict[str, Any] = document["components"]["schemas"][schema["$ref"].rpartition("/")[2]]
    return found


def test_the_requests_that_are_shown_are_answered(client: httpx.Client, document: dict[str, Any]) -> None:
    shown = 0
    for path, operations in document["paths"].items():
        for operation in operations.values():
            content = operation.get("requestBody", {}).get("content", {}).get("application/json", {})
            name = content.get("schema", {}).get("$ref", "").rpartition("/")[2]
            for body in document["components"]["schemas"].get(name, {}).get("examples", []):
                response = client.post(path, json=body, headers={"Prefer": "wait=60"} if path == "/plan" else {})
                assert response.is_success, (path, body, response.text)
                shown += 1
    assert shown >= 6


def test_whoever_needs_a_key_can_read_so(document: dict[str, Any]) -> None:
    assert document["components"]["securitySchemes"]["ApiKey"]["scheme"] == "bearer"
    plan, live = document["paths"]["/plan"]["post"], document["paths"]["/livez"]["get"]
    assert plan["security"] == [{}, {"ApiKey": ["plan"]}]  # none where the service has no keys
    assert {"401", "403", "408", "429", "503"} <= set(plan["responses"])
    assert "security" not in live
    assert not {"401", "403", "408", "429"} & set(live["responses"])


def test_whoever_is_to_ask_again_is_told_when(document: dict[str, Any]) -> None:
    for path, item in document["paths"].items():
        for method, operation in item.items():
            for status in {"429", "503"} & operation["responses"].keys():
                assert "Retry-After" in operation["responses"][status]["headers"], (method, path, status)

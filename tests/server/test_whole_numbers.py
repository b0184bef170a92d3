"""Whole numbers of requests have bounds: what no machine word takes is refused, not a failure."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from typing import Any

import pytest
from fake_plc import FakePlc
from fastapi import FastAPI
from fastapi.testclient import TestClient

from tappet.server import openapi
from tappet.server.app import create_app
from tappet.server.settings import ServerSettings

DOCUMENT = openapi.document(create_app(ServerSettings(), FakePlc().connect))
SCHEMAS = DOCUMENT["components"]["schemas"]
LARGE = [1 << 31, 1 << 53, 1 << 63, 1 << 64, -1, -(1 << 63) - 1, 10**400]
WORD = 1 << 63
Path = tuple[str | int, ...]


def integers(node: Any, path: Path = (), seen: frozenset[str] = frozenset()) -> Iterator[tuple[Path, Any]]:
    """The whole numbers in a schema, each with its way from the top; references are followed once."""
    if isinstance(node, list):
        for item in node:
            yield from integers(item, path, seen)
    if not isinstance(node, dict):
        return
    name = node.get("$ref", "").rpartition("/")[2]
    if name and name not in seen:
        yield from integers(SCHEMAS[name], path, seen | {name})
    if node.get("type") == "integer" and "enum" not in node and "const" not in node:
        yield path, node
    for key, value in node.items():
        if key == "properties":
            for field, schema in value.items():
                yield from integers(schema, (*path, field), seen)
        elif key in ("items", "prefixItems"):
            yield from integers(value, (*path, 0), seen)
        elif key not in ("default", "description", "examples"):
            yield from integers(value, path, seen)


def bounded(schema: dict[str, Any]) -> bool:
    """Whether a machine word takes all of its numbers."""
    low = schema.get("minimum", schema.get("exclusiveMinimum"))
    high = schema.get("maximum", schema.get("exclusiveMaximum"))
    return low is not None and high is not None and low >= -WORD and high <= WORD


def operations() -> Iterator[tuple[str, str, dict[str, Any]]]:
    """Method, path and description of each operation."""
    for path, methods in DOCUMENT["paths"].items():
        for method, operation in methods.items():
            yield method, path, operation


def sent() -> Iterator[tuple[str, Path, dict[str, Any]]]:
    """Each whole number that a client may send."""
    for method, path, operation in operations():
        for parameter in operation.get("parameters", ()):
            for at, schema in integers(parameter["schema"]):
                yield f"{method} {path}", (parameter["name"], *at), schema
        for at, schema in integers(operation.get("requestBody", {})):
            yield f"{method} {path}", at, schema
    for name in ("OnlineClientMessage", "EventClientMessage"):
        for at, schema in integers(SCHEMAS[name]):
            yield name, at, schema
    for shape in SCHEMAS["ObjectDetail"]["anyOf"]:
        data = SCHEMAS[shape["$ref"].rpartition("/")[2]]["properties"]["data"]
        for at, schema in integers(data):
            yield shape["$ref"], at, schema


def test_every_whole_number_of_a_request_has_bounds() -> None:
    found = list(sent())
    assert len(found) > 20
    assert [(where, at) for where, at, schema in found if not bounded(schema)] == []


def body_with(at: Path, value: object) -> Any:
    """The smallest body that has the number at its place."""
    if not at:
        return value
    first, *rest = at
    inner = body_with(tuple(rest), value)
    return [inner] if isinstance(first, int) else {first: inner}


def requests() -> Iterator[tuple[str, str, str, Path]]:
    """Method, path, place (`path`, `query` or `body`) and name of each whole number of REST."""
    for method, path, operation in operations():
        for parameter in operation.get("parameters", ()):
            textual = parameter["in"] == "path" and parameter["name"] in ("revision", "cycle", "number")
            if textual or any(True for _ in integers(parameter["schema"])):
                yield method, path, parameter["in"], (parameter["name"],)
        for at, _ in integers(operation.get("requestBody", {})):
            yield method, path, "body", at


@pytest.mark.parametrize(
    "value", LARGE, ids=lambda value: f"{value:.3g}" if abs(value) < 1 << 70 else "10e400"
)
def test_no_number_makes_the_server_fail(
    app: FastAPI, admin: TestClient, runtime_id: str, value: int
) -> None:
    project = admin.post("/api/v1/projects", json={"name": "Press"}).json()["id"]
    tree = admin.get(f"/api/v1/projects/{project}/objects").json()
    known = {"project_id": project, "runtime_id": runtime_id, "object_id": tree[0]["id"]}
    asked = 0
    for method, path, place, at in requests():
        names = known | ({str(at[0]): str(value)} if place == "path" else {})
        url = re.sub(r"\{(\w+)\}", lambda match, names=names: names.get(match[1], "x"), path)
        options: dict[str, Any] = {}
        if place == "query":
            options["params"] = {str(at[0]): str(value)}
        elif place == "body":
            options["content"] = json.dumps(body_with(at, value))
            options["headers"] = {"Content-Type": "application/json"}
        answer = admin.request(method, url, **options)
        assert answer.status_code < 500, (method, url, at, answer.text)
        asked += 1
    assert asked > 15


@pytest.mark.parametrize("value", LARGE)
def test_values_of_variables_are_refused_by_their_type(
    admin: TestClient, runtime_id: str, value: int
) -> None:
    url = f"/api/v1/runtimes/{runtime_id}/values/write"
    for name in ("nLevel", "sName", "tDelay", "bStart", "eMode"):
        body = json.dumps({"values": [{"expression": f"PLC_PRG.{name}", "value": value}]})
        answer = admin.post(url, content=body, headers={"Content-Type": "application/json"})
        fits = value == -1 and name == "eMode"  # an INT below
        assert answer.status_code == (200 if fits else 422) or name == "tDelay", (name, answer.text)
        assert answer.status_code < 500


@pytest.mark.parametrize("digits", [400, 4000, 5000, 100_000])
def test_numbers_of_any_length_are_no_failure_where_any_json_may_be(admin: TestClient, digits: int) -> None:
    url = "/api/v1/me/settings/layout"
    headers = {"Content-Type": "application/json"}
    stored = admin.put(url, content="[" + "9" * digits + "]", headers=headers)
    assert stored.status_code < 500, stored.text
    assert admin.get(url).status_code == 200

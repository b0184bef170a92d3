"""The document the client is generated from."""

from __future__ import annotations

from pathlib import Path

import pytest
from fake_plc import FakePlc
from fastapi import FastAPI
from fastapi.testclient import TestClient

from tappet.server import openapi, print_openapi
from tappet.server.app import create_app
from tappet.server.settings import ServerSettings

KEPT = Path(__file__).parents[2] / "frontend" / "src" / "api" / "openapi.json"


def test_kept_document_is_current() -> None:
    if not KEPT.parent.exists():
        pytest.skip("no front end in this checkout")
    text = print_openapi.text(create_app(ServerSettings(), FakePlc().connect))
    assert KEPT.read_text(encoding="utf-8") == text, "run: make generate"


def test_references_resolve_and_operations_are_described() -> None:
    document = openapi.document(create_app(ServerSettings(), FakePlc().connect))
    schemas = document["components"]["schemas"]

    def references(node: object) -> list[str]:
        if isinstance(node, dict):
            own = [v for k, v in node.items() if k == "$ref" and isinstance(v, str)]
            return own + [r for v in node.values() for r in references(v)]
        if isinstance(node, list):
            return [r for v in node for r in references(v)]
        return []

    missing = {r for r in references(document) if r.rpartition("/")[2] not in schemas}
    assert missing == set()
    for path, operations in document["paths"].items():
        for method, operation in operations.items():
            assert operation.get("description"), f"{method} {path} has no description"
    for shape in ("Subscribed", "StateChanged", "ForcesChanged", "ObjectChanged", "Presence", "PouObject"):
        assert shape in schemas


def test_objects_are_answered_as_the_document_says(app: FastAPI, admin: TestClient) -> None:
    schemas = openapi.document(app)["components"]["schemas"]
    shapes = [schemas[shape["$ref"].rpartition("/")[2]] for shape in schemas["ObjectDetail"]["anyOf"]]
    by_kind = {shape["properties"]["kind"].get("const"): shape for shape in shapes}
    project = f"/api/v1/projects/{admin.post('/api/v1/projects', json={'name': 'Press'}).json()['id']}"
    objects = admin.get(f"{project}/objects").json()
    assert len(objects) > 5
    for item in objects:
        detail = admin.get(f"{project}/objects/{item['id']}").json()
        shape = by_kind[item["kind"]]
        data = schemas[shape["properties"]["data"]["$ref"].rpartition("/")[2]]
        for held, described in ((detail, shape), (detail["data"], data)):
            assert set(described.get("required", ())) <= set(held) <= set(described["properties"])

"""The document the client is generated from."""

from __future__ import annotations

from pathlib import Path

import pytest
from fake_plc import FakePlc

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

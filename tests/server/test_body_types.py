"""Bodies are taken by the types of the API document: nothing is read as a number or a truth that is none."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from typing import Any

from fastapi import FastAPI
from fastapi.testclient import TestClient
from test_whole_numbers import SCHEMAS, Path, body_with, operations

WRONG = {"integer": [True, "1", 1.5], "boolean": [0, 1, "true", "no"], "number": [True, "1.5"]}
"""By type: what is close to it."""


def scalars(node: Any, path: Path = (), seen: frozenset[str] = frozenset()) -> Iterator[tuple[Path, str]]:
    """Numbers and truths of a body, each with its way from the top; not those where anything may be."""
    if not isinstance(node, dict):
        return
    if "$ref" in node:
        name = node["$ref"].rpartition("/")[2]
        if name not in seen:
            yield from scalars(SCHEMAS[name], path, seen | {name})
    if node.get("type") in WRONG:
        yield path, node["type"]
    options = [one for one in node.get("anyOf", ()) if one.get("type") != "null"]
    if len(options) == 1:
        yield from scalars(options[0], path, seen)
    for field, schema in node.get("properties", {}).items():
        yield from scalars(schema, (*path, field), seen)
    if "items" in node:
        yield from scalars(node["items"], (*path, 0), seen)


def test_what_is_nearly_a_number_or_a_truth_is_refused(
    app: FastAPI, admin: TestClient, runtime_id: str
) -> None:
    known = {"project_id": admin.post("/api/v1/projects", json={"name": "Press"}).json()["id"]}
    known |= {"runtime_id": runtime_id, "id": "1", "frame": "0"}
    tree = admin.get(f"/api/v1/projects/{known['project_id']}/objects").json()
    known |= {"object_id": tree[0]["id"]}
    asked, taken = 0, []
    for method, path, operation in operations():
        for media, content in operation.get("requestBody", {}).get("content", {}).items():
            if media != "application/json":
                continue
            for at, kind in scalars(content["schema"]):
                for wrong in WRONG[kind]:
                    url = re.sub(r"\{(\w+)\}", lambda match: known.get(match[1], "x"), path)
                    headers = {"Content-Type": "application/json"}
                    sent = json.dumps(body_with(at, wrong))
                    answer = admin.request(method, url, content=sent, headers=headers)
                    asked += 1
                    named = {error["location"] for error in answer.json().get("errors", ())}
                    if answer.status_code != 422 or ".".join(("body", *map(str, at))) not in named:
                        taken.append((method, path, at, wrong, answer.status_code, sorted(named)))
    assert asked > 30
    assert taken == []

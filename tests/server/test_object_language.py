"""Objects in IL over REST: chosen when they are added, kept in the archive, served to the compiler."""

from __future__ import annotations

import io

from fastapi.testclient import TestClient

from tappet.project.folder import read_zip
from tappet.project.sources import application_sources

API = "/api/v1"


def test_language_is_chosen_kept_and_compiled(admin: TestClient) -> None:
    project = f"{API}/projects/{admin.post(f'{API}/projects', json={'name': 'Rows'}).json()['id']}"
    tree = admin.get(f"{project}/objects").json()
    application = next(item["id"] for item in tree if item["kind"] == "application")
    rules = {rule["kind"]: rule["languages"] for rule in admin.get(f"{API}/placement").json()}
    assert rules["pou"] == rules["action"] == ["ST", "IL"]
    assert rules["gvl"] == []
    order = {"parent_id": application, "kind": "pou", "name": "Rows", "language": "IL"}
    made = admin.post(f"{project}/objects", json=order)
    assert made.status_code == 201, made.text
    item = made.json()
    assert item["data"]["language"] == "IL"
    body = {**item["data"], "implementation": "LD 1\nST n"}
    saved = admin.put(
        f"{project}/objects/{item['id']}", json={"base_revision": item["revision"], "data": body}
    )
    assert saved.status_code == 200, saved.text
    stored = read_zip(io.BytesIO(admin.get(f"{project}/export").content))
    texts = {t.uri: t for t in application_sources(stored, stored.applications()[0].id)}
    assert [body.language for body in texts["Rows"].bodies] == ["IL"]
    assert "LD 1" in texts["Rows"].text
    refused = admin.post(f"{project}/objects", json={**order, "name": "Drawn", "language": "CFC"})
    assert refused.status_code == 422
    assert "possible: ST, IL" in refused.text

"""The documentation over REST."""

from __future__ import annotations

import io

import pytest
from fastapi.testclient import TestClient
from pypdf import PdfReader

from tappet.documentation import typesetting

API = "/api/v1"


def test_a_project_and_parts_of_it_are_printed(admin: TestClient, as_role: dict[str, TestClient]) -> None:
    project = admin.post(f"{API}/projects", json={"name": "Press <b>"}).json()["id"]
    at = f"{API}/projects/{project}/documentation"
    viewer = as_role["viewer"]
    page = viewer.get(at, params={"format": "html"})
    assert page.status_code == 200, page.text
    assert page.headers["content-type"].startswith("text/html")
    assert "attachment" in page.headers["content-disposition"]
    assert "Press &lt;b&gt;" in page.text
    printed = viewer.get(at)
    assert printed.headers["content-type"] == "application/pdf"
    text = "".join(one.extract_text() for one in PdfReader(io.BytesIO(printed.content)).pages)
    assert "PLC_PRG" in text
    objects = viewer.get(f"{API}/projects/{project}/objects").json()
    tasks = next(item["id"] for item in objects if item["kind"] == "task_configuration")
    part = viewer.get(at, params={"format": "html", "object": tasks}).text
    assert "MainTask" in part
    assert "Library Manager" not in part
    task = next(item["id"] for item in objects if item["kind"] == "task")
    rest = viewer.get(at, params={"format": "html", "object": tasks, "without": task}).text
    assert "Task Configuration" in rest
    assert "MainTask" not in rest
    assert viewer.get(at, params={"object": "0" * 32}).status_code == 404
    assert viewer.get(at, params={"without": "0" * 32}).status_code == 404
    assert viewer.get(at, params={"format": "doc"}).status_code == 422


def test_a_pdf_that_needs_too_much_is_a_problem(admin: TestClient, monkeypatch: pytest.MonkeyPatch) -> None:
    project = admin.post(f"{API}/projects", json={"name": "Press"}).json()["id"]
    at = f"{API}/projects/{project}/documentation"
    monkeypatch.setattr(typesetting, "SECONDS", 0)
    answer = admin.get(at)
    assert (answer.status_code, answer.json()["type"]) == (413, "urn:tappet:problem:document-too-large")
    assert "needs more than 0 s to be made. Choose HTML" in answer.json()["detail"]
    assert admin.get(at, params={"format": "html"}).status_code == 200

"""The documentation over REST."""

from __future__ import annotations

import base64
import io

import pytest
from fastapi.testclient import TestClient
from PIL import Image
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


def test_the_page_setup_holds_unless_a_request_says_otherwise(
    admin: TestClient, as_role: dict[str, TestClient]
) -> None:
    project = admin.post(f"{API}/projects", json={"name": "Press"}).json()["id"]
    at = f"{API}/projects/{project}/documentation"
    objects = f"{API}/projects/{project}/objects"
    made = admin.post(objects, json={"parent_id": None, "kind": "page_setup"}).json()
    assert (made["name"], made["data"]["paper"]) == ("Page Setup", "a4")
    data = {"paper": "a3", "orientation": "landscape", "title_page": False, "footer": {"left": "own"}}
    saved = admin.put(f"{objects}/{made['id']}", json={"base_revision": made["revision"], "data": data})
    assert saved.status_code == 200, saved.text

    def first(**params: object) -> tuple[int, int, str]:
        answer = as_role["viewer"].get(at, params=params)
        assert answer.status_code == 200, answer.text
        page = PdfReader(io.BytesIO(answer.content)).pages[0]
        return round(page.mediabox.width), round(page.mediabox.height), page.extract_text()

    width, height, text = first()
    assert (width, height) == (1191, 842)
    assert "own" in text
    assert "Printed" not in text
    width, height, text = first(
        paper="us-letter", orientation="portrait", title_page=True, author="Ann", footer="by {author}"
    )
    assert (width, height) == (612, 792)
    assert "by Ann" in text
    refused = as_role["viewer"].get(at, params={"footer": "{nobody}"})
    assert refused.status_code == 422
    assert "'{nobody}' is no placeholder; placeholders are {project}, {object}" in refused.json()["detail"]
    assert as_role["viewer"].get(at, params={"paper": "a2"}).status_code == 422
    wide = {"paper": "a3", "margins": {"left": 80, "right": 80}}
    now = admin.put(f"{objects}/{made['id']}", json={"base_revision": saved.json()["revision"], "data": wide})
    assert now.status_code == 200
    refused = as_role["viewer"].get(at, params={"paper": "a5"})
    assert (refused.status_code, refused.json()["type"]) == (422, "urn:tappet:problem:invalid-data")
    assert "This cannot be printed: data: the margins left and right leave 0 mm of 148 mm" in refused.text


def test_a_page_setup_is_checked_compared_and_taken_back(admin: TestClient) -> None:
    project = admin.post(f"{API}/projects", json={"name": "Press"}).json()["id"]
    objects = f"{API}/projects/{project}/objects"
    made = admin.post(objects, json={"parent_id": None, "kind": "page_setup"}).json()
    assert admin.post(objects, json={"parent_id": None, "kind": "page_setup"}).status_code == 422
    svg = base64.b64encode(b"<svg onload='alert(1)'/>").decode()
    one = f"{objects}/{made['id']}"
    refused = admin.put(one, json={"base_revision": made["revision"], "data": {"logo": svg}})
    assert refused.status_code == 422
    assert "logo: the picture is neither PNG nor JPEG but SVG" in refused.json()["detail"]
    saved = admin.put(one, json={"base_revision": made["revision"], "data": {"orientation": "landscape"}})
    revision = admin.get(f"{API}/projects/{project}").json()["revision"]
    done = admin.post(f"{API}/projects/{project}/revisions/{revision}/undo")
    assert done.status_code == 200, done.text
    assert admin.get(one).json()["data"]["orientation"] == "portrait"
    assert saved.json()["data"]["orientation"] == "landscape"


def test_searching_leaves_the_bytes_of_a_logo_out(admin: TestClient) -> None:
    project = admin.post(f"{API}/projects", json={"name": "Press"}).json()["id"]
    objects = f"{API}/projects/{project}/objects"
    file = io.BytesIO()
    Image.new("RGB", (8, 8)).save(file, "PNG")
    logo = base64.b64encode(file.getvalue()).decode()
    data = {"logo": logo, "company": f"{logo[:12]} Ltd"}
    made = admin.post(objects, json={"parent_id": None, "kind": "page_setup", "data": data})
    assert made.status_code == 201, made.text
    found = admin.post(f"{API}/projects/{project}/search", json={"text": logo[:12]})
    assert found.status_code == 200, found.text
    assert [(item["name"], item["total"]) for item in found.json()["objects"]] == [("Page Setup", 1)]
    assert '"after":" Ltd"' in found.text

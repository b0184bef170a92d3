"""The built front end, its cache headers, and the page that describes the interface."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest
from fake_plc import FakePlc
from fastapi import FastAPI
from fastapi.testclient import TestClient
from server_clients import bare, serving

from tappet.server.app import create_app
from tappet.server.settings import ServerSettings


@pytest.fixture
def app(settings: ServerSettings, tmp_path: Path):
    folder = tmp_path / "dist"
    (folder / "assets").mkdir(parents=True)
    (folder / "index.html").write_text("<!doctype html><title>Tappet</title>")
    (folder / "assets" / "index-a1b2.js").write_text("export {}")
    (tmp_path / "secret.txt").write_text("secret")
    app = create_app(replace(settings, static_dir=folder), FakePlc().connect)
    with serving(app):
        yield app


def test_page_is_asked_for_again_and_assets_are_kept(app: FastAPI) -> None:
    client = bare(app)
    for path in ("/", "/project/1/editor/2"):
        page = client.get(path)
        assert "<title>Tappet" in page.text, path
        assert page.headers["cache-control"] == "no-cache"
        assert "script-src 'self'" in page.headers["content-security-policy"]
    asset = client.get("/assets/index-a1b2.js")
    assert "immutable" in asset.headers["cache-control"]
    assert asset.headers["content-type"].startswith("text/javascript")
    assert (asset.headers["content-encoding"], asset.text) == ("gzip", "export {}")
    plain = client.get("/assets/index-a1b2.js", headers={"Accept-Encoding": "identity"})
    assert "content-encoding" not in plain.headers
    assert plain.text == "export {}"


@pytest.mark.parametrize(
    "path", ["/assets/gone.js", "/api/v1/nothing", "/api/nothing", "/api", "/favicon.png", "/..%2fsecret.txt"]
)
def test_what_is_not_there_is_a_problem(app: FastAPI, path: str) -> None:
    answer = bare(app).get(path)
    assert answer.status_code == 404
    assert answer.headers["content-type"] == "application/problem+json"
    assert "secret" not in answer.text.replace("secret.txt", "")


def test_without_a_front_end_the_page_says_how_to_build_it(settings: ServerSettings, tmp_path: Path) -> None:
    app = create_app(replace(settings, static_dir=tmp_path / "none"), FakePlc().connect)
    with serving(app) as client:
        assert "npm run build" in client.get("/").text


def test_docs_describe_every_operation(app: FastAPI, admin: TestClient) -> None:
    page = admin.get("/api/docs").text
    assert "/api/v1/runtimes/{runtime_id}/values/write" in page
    assert "<script" not in page
    document = admin.get("/api/v1/openapi.json").json()
    assert document["openapi"].startswith("3.1")
    assert page.count("<td><code>role</code></td><td>admin</td>") > 3
    assert bare(app).get("/api/docs").status_code == 401

"""The heap of an application over REST: stored, refused, built, and what login says of a changed one."""

from __future__ import annotations

from typing import Any

import pytest
from fake_plc import FakePlc
from fastapi.testclient import TestClient

from tappet.codegen.package import CodePackage

PROJECTS = "/api/v1/projects"


@pytest.fixture
def urls(admin: TestClient) -> tuple[str, str]:
    """Of the object and of the resource of an application."""
    project = admin.post(PROJECTS, json={"name": "Heap"}).json()["id"]
    objects = f"{PROJECTS}/{project}/objects"
    found = next(item["id"] for item in admin.get(objects).json() if item["kind"] == "application")
    return f"{objects}/{found}", f"{PROJECTS}/{project}/applications/{found}"


def save(client: TestClient, url: str, heap: dict[str, Any]) -> Any:
    body = {"base_revision": client.get(url).json()["revision"], "data": {"heap": heap}}
    return client.put(url, json=body)


def test_settings_are_kept_and_are_part_of_the_build(admin: TestClient, urls: tuple[str, str]) -> None:
    item, application = urls
    assert "heap" not in admin.get(item).json()["data"]
    usual = admin.post(f"{application}/build").json()["code_id"]
    assert save(admin, item, {"limit_kib": 128, "poison": True}).status_code == 200
    assert admin.get(item).json()["data"]["heap"] == {"limit_kib": 128, "poison": True}
    assert admin.post(f"{application}/build").json()["code_id"] != usual
    assert save(admin, item, {"limit_kib": 65536, "poison": False}).status_code == 200
    assert admin.post(f"{application}/build").json()["code_id"] == usual


@pytest.mark.parametrize(
    ("heap", "says"),
    [
        ({"limit_kib": -1}, "greater than or equal to 0"),
        ({"limit_kib": 1 << 20 | 1}, "less than or equal to 1048576"),
        ({"limit_kib": 1.5}, "integer"),
        ({"limit_kib": "64"}, "integer"),
        ({"limit_kib": 64, "poison": 1}, "boolean"),
        ({"limit": 64}, "limit"),
    ],
)
def test_what_is_no_setting_is_refused(
    admin: TestClient, urls: tuple[str, str], heap: dict[str, Any], says: str
) -> None:
    refused = save(admin, urls[0], heap)
    assert refused.status_code == 422
    assert says in refused.text
    assert "heap" in refused.text
    assert "heap" not in admin.get(urls[0]).json()["data"]


def test_another_limit_is_a_download_and_login_says_so(
    admin: TestClient, urls: tuple[str, str], runtime_id: str, plc: FakePlc
) -> None:
    item, application = urls
    download = {"runtime_id": runtime_id, "mode": "download", "start": True}
    assert save(admin, item, {"limit_kib": 128}).status_code == 200
    assert admin.post(f"{application}/download", json=download).status_code == 200
    assert CodePackage.from_bytes(plc.downloads[-1][0]).facts.heap_limit == 128 << 10

    save(admin, item, {"limit_kib": 128, "poison": True})
    found = admin.post(f"{application}/login", json={"runtime_id": runtime_id}).json()
    assert found["relation"] == "online_change"
    save(admin, item, {"limit_kib": 256})
    found = admin.post(f"{application}/login", json={"runtime_id": runtime_id}).json()
    assert found["relation"] == "download"
    assert "128 KiB to 256 KiB" in found["reasons"][0]

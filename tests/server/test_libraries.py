"""The library catalogue."""

from __future__ import annotations

from fastapi.testclient import TestClient

URL = "/api/v1/libraries"


def test_list_and_items(admin: TestClient) -> None:
    names = [library["name"] for library in admin.get(URL).json()]
    assert "Standard" in names
    library = admin.get(f"{URL}/standard").json()
    ton = next(item for item in library["items"] if item["name"] == "TON")
    assert ton["kind"] == "function_block"
    assert [(pin["name"], pin["type"]) for pin in ton["inputs"]] == [("IN", "BOOL"), ("PT", "TIME")]


def test_sources_are_open(admin: TestClient) -> None:
    assert "FUNCTION_BLOCK TON" in admin.get(f"{URL}/Standard/sources/ton").json()["text"]
    assert admin.get(f"{URL}/Standard/sources/..%2F..%2Fsecret").status_code == 404


def test_unknown_library_names_the_installed_ones(admin: TestClient) -> None:
    answer = admin.get(f"{URL}/Standart")
    assert answer.status_code == 404
    assert "Standard" in answer.json()["detail"]

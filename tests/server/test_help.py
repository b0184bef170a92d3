"""The help over REST."""

from __future__ import annotations

from typing import Any

import pytest
from fastapi.testclient import TestClient

from tappet.lang.diagnostics import TABLE
from tappet.lang.reference import topics

HELP = "/api/v1/help"


def page(client: TestClient, path: str, language: str = "en") -> dict[str, Any]:
    answer = client.get(f"{HELP}/{path}", params={"language": language})
    assert answer.status_code == 200, answer.text
    found: dict[str, Any] = answer.json()
    return found


def test_the_list_has_every_word_message_and_item(admin: TestClient) -> None:
    entries = admin.get(HELP).json()
    named = {(entry["kind"], entry["name"]): entry for entry in entries}
    assert {name for kind, name in named if kind == "message"} == set(TABLE)
    assert {name for kind, name in named if kind == "word"} == set(topics())
    assert named["library", "TON"]["library"] == "Standard"
    chinese = admin.get(HELP, params={"language": "zh"}).json()
    assert [entry["name"] for entry in chinese] == [entry["name"] for entry in entries]
    assert all(not entry["summary"].isascii() for entry in chinese if entry["kind"] in ("word", "view"))


@pytest.mark.parametrize("word", ["IF", "elsif", "END_IF", "%3C%3D", "%2F", "LREAL"])
def test_words_are_found_in_any_case_and_by_their_end(admin: TestClient, word: str) -> None:
    assert page(admin, f"words/{word}")["sections"][1]["code"]


def test_a_message_has_its_samples(admin: TestClient) -> None:
    found = page(admin, "messages/w1101")
    assert found["title"] == "W1101: no effect"
    assert [section["heading"] for section in found["sections"]] == [
        None, "What to do", "Why", "Accepted", "Reported",
    ]  # fmt: skip
    chinese = page(admin, "messages/W1101", "zh")
    assert not chinese["sections"][0]["text"].isascii()
    assert chinese["sections"][1]["heading"] == "处理方法"


def test_every_message_and_word_has_a_page(admin: TestClient) -> None:
    for code in TABLE:
        assert page(admin, f"messages/{code}")["name"] == code


def test_what_is_not_there(admin: TestClient) -> None:
    for path in ("words/FOO", "messages/E9999", "views/nothing"):
        answer = admin.get(f"{HELP}/{path}")
        assert (answer.status_code, answer.json()["type"]) == (404, "urn:tappet:problem:not-found")

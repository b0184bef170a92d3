"""What the server says in Chinese to those who ask for it, and in English to all others."""

from __future__ import annotations

import re

import pytest
from fake_plc import FakePlc
from fastapi import FastAPI
from fastapi.testclient import TestClient
from httpx import Response
from server_clients import PASSWORD, SOCKETS, browser, script
from tests.project.archives import archive

from tappet.runtime.logbook import LogEntry

API = "/api/v1"
ZH = {"Accept-Language": "zh-CN,zh;q=0.9,en;q=0.8"}
FILES = {
    "files": (
        "Cut.zip",
        archive(("Line.plcproj", b""), ("Cut.st", b"FUNCTION_BLOCK FB_Pump\nVAR\nEND_VAR\n")),
    )
}


def detail(answer: Response, status: int) -> str:
    """What a Chinese client reads of a refusal."""
    assert answer.status_code == status, answer.text
    assert answer.headers["content-language"] == "zh"
    problem = answer.json()
    assert problem["type"].isascii()
    assert re.search("[一-鿿]", problem["title"]), problem
    return problem["detail"]


def test_refusals_in_chinese(admin: TestClient) -> None:
    missing = f"{API}/projects/{'0' * 32}"
    assert detail(admin.get(missing, headers=ZH), 404) == f"没有 ID 为 {'0' * 32} 的工程"
    assert detail(admin.get(f"{API}/runtimes/Presse 1", headers=ZH), 404) == "没有运行时“Presse 1”。"
    admin.post(f"{API}/projects", json={"name": "工程 'A'; 1"})
    again = admin.post(f"{API}/projects", json={"name": "工程 'A'; 1"}, headers=ZH)
    assert detail(again, 409) == "名为“工程 'A'; 1”的工程已存在"
    wrong = admin.post(f"{API}/projects", json={"name": 7}, headers=ZH)
    assert detail(wrong, 422) == "body.name：应为文本"
    assert wrong.json()["errors"] == [{"location": "body.name", "message": "应为文本"}]
    assert detail(admin.get(f"{API}/nothing", headers=ZH), 404) == f"未找到：{API}/nothing"


def test_names_that_cannot_be_in_chinese(admin: TestClient) -> None:
    project = admin.post(f"{API}/projects", json={"name": "Press"}).json()["id"]
    objects = f"{API}/projects/{project}/objects"
    application = next(item for item in admin.get(objects).json() if item["kind"] == "application")
    body = {"kind": "gvl", "name": "2nd", "parent_id": application["id"]}
    said = detail(admin.post(objects, json=body, headers=ZH), 422)
    assert said == "“2nd”不是有效的标识符。请使用字母、数字和下划线，且不以数字开头"
    said = detail(admin.post(objects, json=body | {"kind": "task", "name": "T"}, headers=ZH), 422)
    assert said == "任务不能放在应用程序“Application”之下；它应在任务配置之下"


def test_a_refused_login_in_chinese(app: FastAPI, admin: TestClient) -> None:
    body = {"username": "admin", "password": "wrong" + PASSWORD}
    said = detail(browser(app).post(f"{API}/auth/login", json=body, headers=ZH), 401)
    assert said == "用户名或密码错误。"


def test_a_role_that_is_too_low_in_chinese(app: FastAPI, tokens: dict[str, str]) -> None:
    client = script(app, tokens["viewer"])
    said = detail(client.post(f"{API}/projects", json={"name": "Press"}, headers=ZH), 403)
    assert re.fullmatch("此操作需要“engineer”角色；“.+”的角色是“viewer”。", said), said


def test_english_is_said_to_all_others_and_is_what_is_kept(app: FastAPI, admin: TestClient) -> None:
    url = f"{API}/runtimes/x"
    for headers in ({}, {"Accept-Language": "en"}, {"Accept-Language": "de-DE"}):
        answer = admin.get(url, headers=headers)
        assert answer.json()["detail"] == "There is no runtime 'x'."
        assert answer.headers["content-language"] == "en"
    admin.post(f"{API}/runtimes", json={"name": "a", "url": "ws://a:1", "token": "t"})
    refused = admin.post(f"{API}/runtimes", json={"name": "a", "url": "ws://a:1", "token": "t"}, headers=ZH)
    assert detail(refused, 409) == "已有运行时“a”。"
    results = [row.get("detail") or row.get("result") or "" for row in admin.get(f"{API}/audit").json()]
    assert not any(re.search("[一-鿿]", str(result)) for result in results)


def test_an_import_report_in_chinese(admin: TestClient) -> None:
    english = admin.post(f"{API}/projects/preview-files", files=FILES).json()["report"]["entries"]
    answer = admin.post(f"{API}/projects/preview-files", files=FILES, headers=ZH)
    chinese = answer.json()["report"]["entries"]
    assert [entry["outcome"] for entry in chinese] == [entry["outcome"] for entry in english]
    assert [entry["source"] for entry in chinese] == [entry["source"] for entry in english]
    said = {entry["text"] for entry in chinese if entry["text"]}
    assert said
    assert not any(re.search("[a-z]{3,} [a-z]{3,}", text) for text in said), said


def test_values_that_are_wrong_in_chinese(as_role: dict[str, TestClient], runtime_id: str) -> None:
    body = {"values": [{"expression": "PLC_PRG.nothing", "value": 1}]}
    url = f"{API}/runtimes/{runtime_id}/values/write"
    said = detail(as_role["operator"].post(url, json=body, headers=ZH), 422)
    assert said.startswith("PLC_PRG.nothing：“PLC_PRG")
    assert said.endswith("没有写入任何值。")
    read = as_role["viewer"].post(
        f"{API}/runtimes/{runtime_id}/values/read", json={"expressions": ["nothing"]}, headers=ZH
    )
    error = read.json()["values"][0]["error"]
    assert error.startswith("“nothing”不是应用程序的程序、变量列表或全局变量。")


def test_the_online_channel_says_what_it_has_said_again_in_chinese(
    admin: TestClient, runtime_id: str
) -> None:
    with admin.websocket_connect(f"{SOCKETS}{API}/online?runtime={runtime_id}") as socket:
        for op in ("state", "forces"):
            assert socket.receive_json()["op"] == op
        socket.send_json({"op": "subscribe", "id": 1, "expressions": ["nothing"]})
        assert socket.receive_json()["items"][0]["error"].startswith("'nothing' is no program")
        socket.send_json({"op": "speak", "language": "zh"})
        assert socket.receive_json()["op"] == "state"
        again = socket.receive_json()
        assert again["op"] == "subscribed"
        assert again["items"][0]["error"].startswith("“nothing”不是应用程序的程序")


def test_the_log_of_the_runtime_in_chinese(
    admin: TestClient, runtime_id: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    text = "ended by an exception: task Main: array index 12 outside 0..9 in PLC_PRG.Fill, line 7"
    monkeypatch.setattr(FakePlc, "since", lambda *_: [LogEntry(1, 0, "exception", "application", text)])
    url = f"{API}/runtimes/{runtime_id}/log"
    (english,), (chinese,) = admin.get(url).json(), admin.get(url, headers=ZH).json()
    assert english["message"] == text
    said = "因异常结束：任务 Main：PLC_PRG.Fill 第 7 行，数组下标 12 超出 0..9"
    assert chinese == english | {"message": said}

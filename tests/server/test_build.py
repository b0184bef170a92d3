"""Build, login and download of stored projects, with the real compiler."""

from __future__ import annotations

from dataclasses import dataclass

import pytest
from fake_plc import FakePlc
from fastapi.testclient import TestClient

from tappet.codegen.package import CodePackage
from tappet.project.model import ProjectObject
from tappet.runtime.errors import PlcError
from tappet.runtime.exception_report import ExceptionReport
from tappet.server.services import Services


@dataclass
class Stored:
    """A project in the store, edited as the editors do."""

    services: Services
    id: str
    application_id: str

    @property
    def url(self) -> str:
        return f"/api/v1/projects/{self.id}/applications/{self.application_id}"

    def find(self, name: str) -> ProjectObject:
        return next(o for o in self.services.store.load(self.id).objects.values() if o.name == name)

    def edit(self, declaration: str, implementation: str, name: str = "PLC_PRG") -> None:
        item = self.find(name)
        data = {"declaration": declaration, "implementation": implementation}
        self.services.store.save(self.id, item.id, item.revision, data, "ann")


@pytest.fixture
def project(admin: TestClient, services: Services) -> Stored:
    info = services.store.create_project("Filler", "ann")
    application = services.store.load(info.id).applications()[0]
    stored = Stored(services, info.id, application.id)
    stored.edit("PROGRAM PLC_PRG\nVAR\n  n : INT := 5;\nEND_VAR", "n := n + 1;")
    return stored


def _build(admin: TestClient, project: Stored, language: str = "en") -> dict:
    answer = admin.post(f"{project.url}/build", params={"language": language})
    assert answer.status_code == 200, answer.text
    return answer.json()


def test_messages_come_in_the_language_that_is_asked_for(admin: TestClient, project: Stored) -> None:
    project.edit("PROGRAM PLC_PRG\nVAR\n  n : INT;\nEND_VAR", "n := nowhere;")
    for language, message in (("en", "Identifier 'nowhere' not defined"), ("zh", "标识符“nowhere”未定义")):
        (error,) = [d for d in _build(admin, project, language)["diagnostics"] if d["severity"] == "error"]
        assert (error["message"], error["line"]) == (message, 1)


def test_a_good_project_gives_a_package(admin: TestClient, project: Stored) -> None:
    report = _build(admin, project)
    assert report["ok"], report["diagnostics"]
    assert report["code_id"]
    assert report["data_id"]
    assert report["code_size"] > 0
    assert report["data_size"] > 0
    assert _build(admin, project)["code_id"] == report["code_id"]


def test_diagnostics_name_object_part_line_and_column(admin: TestClient, project: Stored) -> None:
    project.edit("PROGRAM PLC_PRG\nVAR\n  n : INT;\n  m : NoType;\nEND_VAR", "n := 1;\n\nn := Spd + 1;")
    report = _build(admin, project)
    assert not report["ok"]
    assert report["code_id"] is None
    errors = {(d["part"], d["line"]): d for d in report["diagnostics"] if d["severity"] == "error"}
    unknown = errors["implementation", 3]
    assert unknown["object_id"] == project.find("PLC_PRG").id
    assert unknown["object_path"].endswith("/PLC_PRG")
    assert "Spd" in unknown["message"]
    assert (unknown["column"], unknown["end_line"], unknown["end_column"]) == (6, 3, 9)
    assert ("declaration", 4) in errors


def test_unknown_application_is_a_problem(admin: TestClient, project: Stored) -> None:
    wrong = f"/api/v1/projects/{project.id}/applications/{project.find('PLC_PRG').id}/build"
    assert admin.post(wrong).status_code == 404
    assert admin.post("/api/v1/projects/none/applications/none/build").status_code == 404


def test_operators_do_not_build(as_role: dict[str, TestClient], project: Stored) -> None:
    assert as_role["operator"].post(f"{project.url}/build").status_code == 403
    assert as_role["engineer"].post(f"{project.url}/build").status_code == 200
    assert as_role["engineer"].delete(f"{project.url}/build").status_code == 404


def _login(admin: TestClient, project: Stored, runtime_id: str) -> dict:
    answer = admin.post(f"{project.url}/login", json={"runtime_id": runtime_id})
    assert answer.status_code == 200, answer.text
    return answer.json()


def _download(
    admin: TestClient, project: Stored, runtime_id: str, mode: str = "download", start: bool = True
):
    body = {"runtime_id": runtime_id, "mode": mode, "start": start}
    return admin.post(f"{project.url}/download", json=body)


def test_relations_from_foreign_to_online_change(
    admin: TestClient, project: Stored, runtime_id: str, plc: FakePlc
) -> None:
    plc.application = "Pump"
    plc.notify("application")
    admin.post(f"/api/v1/runtimes/{runtime_id}/stop")
    foreign = _login(admin, project, runtime_id)
    assert foreign["relation"] == "foreign"
    assert "Pump" in foreign["reasons"][0]
    plc.application = "Application"
    admin.post(f"/api/v1/runtimes/{runtime_id}/stop")
    assert _login(admin, project, runtime_id)["relation"] == "download"
    admin.post(f"/api/v1/runtimes/{runtime_id}/reset", json={"kind": "origin"})
    assert _login(admin, project, runtime_id)["relation"] == "empty"

    done = _download(admin, project, runtime_id)
    assert done.status_code == 200, done.text
    assert done.json()["state"] == "run"
    assert _login(admin, project, runtime_id) == {
        "relation": "same",
        "reasons": [],
        "changes": [],
        "changes_omitted": 0,
        "persistent": [],
        "retain_layout_changes": False,
        "reserve": None,
        "loaded_project": None,
    }

    project.edit("PROGRAM PLC_PRG\nVAR\n  n : INT := 5;\nEND_VAR", "n := n + 2;")
    code = _login(admin, project, runtime_id)
    assert code["relation"] == "online_change"
    assert "code" in code["reasons"][0]
    project.edit("PROGRAM PLC_PRG\nVAR\n  n : INT := 5;\n  m : DINT;\nEND_VAR", "n := n + 2;")
    data = _login(admin, project, runtime_id)
    assert data["relation"] == "online_change"
    assert (data["reserve"]["used"], data["reserve"]["reserved"]) == (0, 1 << 20)
    assert "PLC_PRG" in data["reasons"][0]
    assert [(v["path"], v["effect"], v["reason"], v["type"]) for v in data["changes"]] == [
        ("PLC_PRG.n", "moved", "place", "INT"),
        ("PLC_PRG.m", "initialised", "new", "DINT"),
    ]

    changed = _download(admin, project, runtime_id, "online_change")
    assert changed.status_code == 200, changed.text
    package = CodePackage.from_bytes(plc.downloads[-1][0])
    assert plc.downloads[-1][1] == "online_change"
    assert package.online_change is not None
    assert package.online_change.base_code_id == done.json()["code_id"]
    assert _login(admin, project, runtime_id)["relation"] == "same"

    project.edit("PROGRAM PLC_PRG\nVAR\nEND_VAR", "this is no program;")
    broken = _login(admin, project, runtime_id)
    assert broken["relation"] == "download"
    assert "errors" in broken["reasons"][0]
    refused = _download(admin, project, runtime_id)
    assert refused.status_code == 422
    assert refused.json()["diagnostics"][0]["part"] == "implementation"


def test_login_names_the_project_that_the_runtime_holds(
    admin: TestClient, project: Stored, services: Services, runtime_id: str, plc: FakePlc
) -> None:
    assert _download(admin, project, runtime_id).status_code == 200
    info = services.store.create_project("Capper", "ann")
    other = Stored(services, info.id, services.store.load(info.id).applications()[0].id)
    found = _login(admin, other, runtime_id)
    assert (found["relation"], found["loaded_project"]) == ("foreign", "Filler")
    services.store.delete_project(project.id, "ann")
    gone = _login(admin, other, runtime_id)
    assert (gone["relation"], gone["loaded_project"]) == ("foreign", None)


def test_downloads_are_audited(admin: TestClient, project: Stored, runtime_id: str) -> None:
    code_id = _download(admin, project, runtime_id, start=False).json()["code_id"]
    entry = admin.get("/api/v1/audit").json()[0]
    assert (entry["action"], entry["old_value"], entry["new_value"]) == ("download", "code1", code_id)
    assert (entry["project_id"], entry["runtime_id"]) == (project.id, runtime_id)


def test_a_download_that_does_not_start_says_why_and_where(
    admin: TestClient, project: Stored, runtime_id: str, plc: FakePlc, monkeypatch: pytest.MonkeyPatch
) -> None:
    def start() -> None:
        plc.state = "exception"
        plc.report = ExceptionReport(
            1, "DivisionByZero", "division by zero", "MainTask", "PLC_PRG", "PLC_PRG.st", 7, 1, 1
        )
        raise PlcError("the application is in the state exception")

    monkeypatch.setattr(plc, "start", start)
    answer = _download(admin, project, runtime_id)
    problem = answer.json()
    assert (answer.status_code, problem["type"]) == (409, "urn:tappet:problem:start-failed")
    assert "task MainTask: division by zero in PLC_PRG, line 7" in problem["detail"]
    assert {k: problem["exception"][k] for k in ("pou", "line")} == {"pou": "PLC_PRG", "line": 7}
    start_entry, download_entry = admin.get("/api/v1/audit").json()[:2]
    assert (start_entry["action"], start_entry["result"]) == ("start", "refused")
    assert "division by zero in PLC_PRG, line 7" in start_entry["reason"]
    assert (download_entry["action"], download_entry["result"]) == ("download", "ok")


def test_online_change_needs_a_known_base(
    admin: TestClient, project: Stored, runtime_id: str, plc: FakePlc
) -> None:
    answer = _download(admin, project, runtime_id, "online_change")
    assert answer.status_code == 409
    assert answer.json()["type"] == "urn:tappet:problem:no-online-change"
    assert plc.downloads == []


def test_login_to_a_lost_runtime_says_so(
    admin: TestClient, project: Stored, runtime_id: str, plc: FakePlc
) -> None:
    plc.lose()
    answer = admin.post(f"{project.url}/login", json={"runtime_id": runtime_id})
    assert answer.status_code in (200, 503)
    for _ in range(100):
        answer = admin.post(f"{project.url}/login", json={"runtime_id": runtime_id})
        if answer.status_code == 503:
            break
    assert answer.json()["type"] == "urn:tappet:problem:runtime-not-connected"


def test_values_of_a_downloaded_program(admin: TestClient, project: Stored, runtime_id: str) -> None:
    _download(admin, project, runtime_id)
    url = f"/api/v1/runtimes/{runtime_id}/values/read"
    values = admin.post(url, json={"expressions": ["PLC_PRG.n"]}).json()["values"]
    assert values[0]["literal"] == "5"


def test_after_clean_only_a_download_brings_the_application_in(
    admin: TestClient, project: Stored, runtime_id: str
) -> None:
    _download(admin, project, runtime_id)
    assert _login(admin, project, runtime_id)["relation"] == "same"
    assert admin.post(f"{project.url}/clean").status_code == 204
    assert _login(admin, project, runtime_id)["relation"] == "download"
    _download(admin, project, runtime_id)
    assert _login(admin, project, runtime_id)["relation"] == "same"
    assert admin.post(f"/api/v1/projects/{project.id}/clean").status_code == 204
    assert _login(admin, project, runtime_id)["relation"] == "download"
    cleaned = admin.get("/api/v1/audit", params={"action": "clean"}).json()
    assert [entry["subject"] for entry in cleaned] == ["Filler", "Application"]
    unknown = admin.post(f"/api/v1/projects/{project.id}/applications/{'0' * 32}/clean")
    assert unknown.status_code == 404


def test_a_rebuild_gives_what_a_build_gives(admin: TestClient, project: Stored) -> None:
    built = _build(admin, project)
    rebuilt = admin.post(f"{project.url}/rebuild").json()
    assert rebuilt | {"seconds": 0} == built | {"seconds": 0}


def test_the_boot_application_is_a_file_for_the_runtime(
    admin: TestClient, project: Stored, runtime_id: str, plc: FakePlc
) -> None:
    answer = admin.get(f"{project.url}/boot-application")
    assert answer.status_code == 200
    assert "boot.tappet" in answer.headers["content-disposition"]
    package = CodePackage.from_bytes(answer.content)
    assert package.code_id == _build(admin, project)["code_id"]
    # A runtime that was started with the file is known at the login.
    plc.application, plc.code_id, plc.data_id = "Application", package.code_id, package.data_id
    admin.post(f"/api/v1/runtimes/{runtime_id}/stop")
    assert _login(admin, project, runtime_id)["relation"] == "same"
    project.edit("PROGRAM PLC_PRG\nVAR\nEND_VAR", "nowhere := 1;")
    refused = admin.get(f"{project.url}/boot-application")
    assert (refused.status_code, refused.json()["type"]) == (422, "urn:tappet:problem:build-errors")
    assert refused.json()["diagnostics"]


def test_the_loaded_application_becomes_the_boot_application(
    admin: TestClient, runtime_id: str, plc: FakePlc
) -> None:
    answer = admin.post(f"/api/v1/runtimes/{runtime_id}/boot-application")
    assert (answer.status_code, plc.boots) == (200, 1)
    assert admin.get("/api/v1/audit").json()[0]["action"] == "boot-application"

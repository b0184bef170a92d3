"""CNC info, generated code and preprocessing blocks over REST (CNC-20, CNC-21, CNCS-08, CNCS-09)."""

from __future__ import annotations

from typing import Any

import pytest
from fastapi.testclient import TestClient

from tappet.project.cnc.program import CncProgramData

PROJECTS = "/api/v1/projects"


@pytest.fixture
def place(admin: TestClient) -> tuple[str, str, str]:
    """URL of the project, id of a CNC program, id of the CNC settings."""
    project = admin.post(PROJECTS, json={"name": "Router"}).json()["id"]
    url = f"{PROJECTS}/{project}"
    objects = admin.get(f"{url}/objects").json()
    application = next(one["id"] for one in objects if one["kind"] == "application")
    made = admin.post(f"{url}/objects", json={"kind": "cnc", "parent_id": application, "name": "Part"})
    assert made.status_code == 201, made.text
    objects = admin.get(f"{url}/objects").json()
    program, settings = (
        next(one["id"] for one in objects if one["kind"] == kind) for kind in ("cnc", "cnc_settings")
    )
    return url, program, settings


def order(program: str, text: str, **data: Any) -> dict[str, Any]:
    model = CncProgramData.model_validate({"implementation": text, **data})
    return {"object_id": program, "program": model.model_dump(mode="json")}


def test_the_info_of_the_first_example(admin: TestClient, place: tuple[str, str, str]) -> None:
    """cnc EX-01: one line, one object, length 100, 11.0 s."""
    url, program, _ = place
    answer = admin.post(f"{url}/cnc/info", json=order(program, "N0 G1 X100 F10 E10 E-10"))
    assert answer.status_code == 200, answer.text
    info = answer.json()
    assert (info["name"], info["lines"], info["errors"], info["preprocessed"]) == ("Part", 1, 0, None)
    assert info["library"].count(".") == 3
    assert info["path"] == {"objects": 1, "length": 100.0, "duration": pytest.approx(11.0), "fault": None}


def test_preprocessing_and_faults_are_told(admin: TestClient, place: tuple[str, str, str]) -> None:
    url, program, settings = place
    stored = admin.get(f"{url}/objects/{settings}").json()
    data = {
        **stored["data"],
        "preprocessing": [
            {"block": "SMC_ScaleQueue3D", "parameters": [{"name": "dScaleFactor", "value": "2"}]}
        ],
    }
    saved = admin.put(f"{url}/objects/{settings}", json={"data": data, "base_revision": stored["revision"]})
    assert saved.status_code == 200, saved.text
    info = admin.post(f"{url}/cnc/info", json=order(program, "N0 G1 X100 F10 E10 E-10")).json()
    assert info["path"]["length"] == 100.0
    assert info["preprocessed"]["length"] == 200.0
    faulty = admin.post(f"{url}/cnc/info", json=order(program, "G1 X1 F10\nG77")).json()
    assert (faulty["errors"], faulty["path"]["objects"], faulty["path"]["duration"]) == (1, 1, None)
    assert (faulty["path"]["fault"]["line"], faulty["path"]["fault"]["column"]) == (1, 0)


def test_generated_code_is_that_of_the_mode(admin: TestClient, place: tuple[str, str, str]) -> None:
    """CNC-21: declaration and initialisation; none of a program with errors."""
    url, program, _ = place
    words = admin.post(f"{url}/cnc/code", json=order(program, "G1 X10.5 F10")).json()["text"]
    assert "Part : SM3_CNC.SMC_CNC_REF := (nElements := 8, pgc := ADR(Part_A)" in words
    assert "(byLetter := 88, fValue := 10.5, diValue := 10) (* X *)" in words
    queue = admin.post(
        f"{url}/cnc/code", json=order(program, "G1 X10.5 F10", compile_mode="out_queue")
    ).json()["text"]
    assert "Part_A : ARRAY[0..0] OF SM3_CNC.SMC_GEOINFO" in queue
    assert "piDestPos.dX := 10.5" in queue
    assert "bEndOfList := TRUE, byGenerator := 255" in queue
    refused = admin.post(f"{url}/cnc/code", json=order(program, "G1 X10.5 F10\nG77"))
    assert refused.status_code == 422
    assert "G77 is no command" in refused.json()["detail"]


def test_the_blocks_are_those_of_the_library(admin: TestClient, place: tuple[str, str, str]) -> None:
    blocks = {one["name"]: one for one in admin.get(f"{place[0]}/cnc/blocks").json()["blocks"]}
    tool = {one["name"]: one for one in blocks["SMC_ToolCorr"]["parameters"]}
    assert list(tool) == ["dToolRadius", "eMode"]
    assert (tool["eMode"]["initial"], tool["eMode"]["values"]) == (
        "TC_RAMP_IN",
        ["TC_BLIND_POS", "TC_RAMP_IN"],
    )

"""The cam editor's questions over REST."""

from __future__ import annotations

import os
import signal
import subprocess
from typing import Any

import pytest
from fastapi.testclient import TestClient

from tappet.project.cams.table import CamTable

PROJECTS = "/api/v1/projects"
DEFAULT = CamTable().model_dump(mode="json")


@pytest.fixture
def cams(admin: TestClient) -> str:
    """URL of the cams of a project."""
    project = admin.post(PROJECTS, json={"name": "Press"}).json()["id"]
    return f"{PROJECTS}/{project}/cams"


def _ask(client: TestClient, url: str, /, **body: Any) -> Any:
    answer = client.post(url, json=body)
    assert answer.status_code == 200, answer.text
    return answer.json()


def test_curves_of_the_default_cam(admin: TestClient, cams: str) -> None:
    """cam EX-01, over REST."""
    drawn = _ask(admin, f"{cams}/curves", cam=DEFAULT, samples=30, at=[60, 120])
    first, second, third = drawn["segments"]
    assert [len(one["x"]) for one in (first, second, third)] == [10, 10, 10]
    assert (first["x"][0], first["x"][-1], first["y"][-1]) == (0, 120, 120)
    assert first["velocity"] == pytest.approx(1.512)
    assert first["acceleration"] == pytest.approx(0.0328352829)
    assert (first["j"][-1], second["j"][0]) == (pytest.approx(1 / 600), 0)
    assert drawn["at"][0] == {"x": 60, "y": 41.25, "v": 1.4375, "a": 0.0125, "j": pytest.approx(-1 / 960)}
    assert drawn["findings"] == []
    short = _ask(admin, f"{cams}/curves", cam=DEFAULT)
    assert sum(len(one["x"]) for one in short["segments"]) == 999
    assert short["at"] == []


def test_findings_are_said_in_the_language_of_the_reader(admin: TestClient, cams: str) -> None:
    jump = {**DEFAULT, "segments": [{"law": "line"}, {}, {}], "periodic": True, "slave_period": 100}
    drawn = _ask(admin, f"{cams}/curves", cam=jump, samples=2)
    found = [(one["severity"], one["x"], one["text"]) for one in drawn["findings"]]
    assert (
        "warning",
        360,
        "The cam is periodic, and the velocity jumps from 0 at its end to 1 at its start",
    ) in found
    assert [severity for severity, *_ in found].count("error") == 1
    chinese = admin.post(f"{cams}/curves", json={"cam": jump}, headers={"Accept-Language": "zh"}).json()[
        "findings"
    ]
    assert [one["x"] for one in chinese] == [one["x"] for one in drawn["findings"]]
    assert any("速度从终点的 0 跳变到起点的 1" in one["text"] for one in chinese)


@pytest.mark.parametrize(
    ("change", "where", "words"),
    [
        ({"samples": 1}, "body.samples", "greater than or equal to 2"),
        ({"samples": 20_001}, "body.samples", "20000"),
        ({"samples": 2.5}, "body.samples", "integer"),
        ({"at": [0.0] * 1001}, "body.at", "1000"),
        ({"at": ["x"]}, "body.at.0", "number"),
        ({"cam": {**DEFAULT, "segments": []}}, "body.cam", "3 segments"),
        ({"cam": {**DEFAULT, "points": [{"x": 1, "y": 0}, {"x": 1, "y": 0}]}}, "body.cam", "points.1.x"),
        ({"cam": {**DEFAULT, "table_size": True}}, "body.cam.table_size", "integer"),
        ({"colour": "red"}, "body.colour", "Extra inputs"),
    ],
)
def test_wrong_questions_say_where(
    admin: TestClient, cams: str, change: dict[str, Any], where: str, words: str
) -> None:
    answer = admin.post(f"{cams}/curves", json={"cam": DEFAULT, **change})
    assert answer.status_code == 422
    (error,) = answer.json()["errors"]
    assert (error["location"], words in error["message"]) == (where, True), error


def test_cams_of_no_project(admin: TestClient) -> None:
    assert admin.post(f"{PROJECTS}/none/cams/curves", json={"cam": DEFAULT}).status_code == 404


def test_a_process_that_dies_is_started_anew(admin: TestClient, cams: str) -> None:
    before = _ask(admin, f"{cams}/curves", cam=DEFAULT, samples=9)
    children = subprocess.run(
        ["pgrep", "-f", "-P", str(os.getpid()), "cams.worker"], capture_output=True, text=True
    )
    for child in children.stdout.split():
        os.kill(int(child), signal.SIGKILL)
    assert children.stdout
    answers = [admin.post(f"{cams}/curves", json={"cam": DEFAULT, "samples": 9}) for _ in range(2)]
    assert answers[1].json() == before
    assert answers[0].status_code in (200, 500)


def test_texts_go_out_and_come_in(admin: TestClient, cams: str) -> None:
    """cam EX-08, and back."""
    order = {"cam": DEFAULT, "format": "ascii", "count": 4, "points_only": False}
    text = _ask(admin, f"{cams}/text", **order)["text"]
    assert text == "0 0\n120 120\n240 240\n360 360\n"
    for form in ("csv", "cam"):
        text = _ask(admin, f"{cams}/text", **{**order, "format": form, "points_only": True})["text"]
        back = _ask(
            admin,
            f"{cams}/from-text",
            cam={**DEFAULT, "points": [{"x": 0, "y": 1}, {"x": 9, "y": 1}], "segments": [{}], "tracks": []},
            text=text,
        )
        assert (back["cam"]["points"], back["removed_tappets"]) == (DEFAULT["points"], 0)
        assert len(back["cam"]["tracks"]) == (1 if form == "cam" else 0)
    short = _ask(admin, f"{cams}/from-text", cam=DEFAULT, text="0 0\n100 100\n")
    assert (len(short["cam"]["points"]), short["removed_tappets"]) == (2, 1)


def test_wrong_texts_name_the_line(admin: TestClient, cams: str) -> None:
    body = {"cam": DEFAULT, "text": "0 0\n5 x\n"}
    answer = admin.post(f"{cams}/from-text", json=body)
    assert (answer.status_code, answer.json()["type"]) == (422, "urn:tappet:problem:cam-text")
    assert (answer.json()["line"], answer.json()["detail"]) == (2, "Line 2 of the text: 'x' is no number.")
    chinese = admin.post(f"{cams}/from-text", json=body, headers={"Accept-Language": "zh"}).json()
    assert chinese["detail"] == "文本第 2 行：“x”不是数字。"


def test_a_cam_file_has_no_sines(admin: TestClient, cams: str) -> None:
    sine = {**DEFAULT, "segments": [{"law": "sine"}, {}, {}]}
    answer = admin.post(f"{cams}/text", json={"cam": sine, "format": "cam"})
    assert (answer.status_code, answer.json()["type"]) == (422, "urn:tappet:problem:no-cam-file")


def test_the_generated_code_is_shown_of_good_cams_alone(admin: TestClient, cams: str) -> None:
    text = _ask(admin, f"{cams}/code", name="Feeder", cam=DEFAULT)["text"]
    assert "Feeder : MC_CAM_REF := (byType:=3, nElements:=4" in text
    sine = {**DEFAULT, "segments": [{"law": "sine"}, {}, {}]}
    answer = admin.post(f"{cams}/code", json={"name": "Feeder", "cam": sine})
    assert (answer.status_code, answer.json()["type"]) == (422, "urn:tappet:problem:faulty-cam")
    assert "is of the type Sine" in answer.json()["detail"]
    assert admin.post(f"{cams}/code", json={"name": "two words", "cam": DEFAULT}).status_code == 422


def test_a_cam_is_optimised(admin: TestClient, cams: str) -> None:
    found = _ask(admin, f"{cams}/optimise", cam=DEFAULT, points=[1, 2], goal="jerk")
    assert found["before"] == pytest.approx(0.0025)
    assert found["after"] < 0.5 * found["before"]
    drawn = _ask(admin, f"{cams}/curves", cam=found["cam"])
    assert max(one["jerk"] for one in drawn["segments"]) == pytest.approx(found["after"], rel=1e-3)
    assert [point["x"] for point in found["cam"]["points"]] == [0, 120, 240, 360]
    kept = _ask(admin, f"{cams}/optimise", cam=DEFAULT, points=[1], goal="jerk", keep_positions=True)
    assert kept["cam"]["points"][1]["y"] == 120


@pytest.mark.parametrize(
    ("points", "law", "words"),
    [
        ([0], "poly5", "The start and the end of a cam stay where they are."),
        ([3], "poly5", "The start and the end of a cam stay where they are."),
        ([99], "poly5", "The start and the end of a cam stay where they are."),
        ([1], "line", "Point 2 has a segment of the type Line beside it"),
    ],
)
def test_points_that_cannot_be_moved_are_told(
    admin: TestClient, cams: str, points: list[int], law: str, words: str
) -> None:
    cam = {**DEFAULT, "segments": [{"law": law}, {}, {}]}
    answer = admin.post(f"{cams}/optimise", json={"cam": cam, "points": points, "goal": "velocity"})
    assert answer.status_code == 422
    assert answer.json()["type"].endswith("cam-optimisation")
    assert words in answer.json()["detail"]

"""`tappet replay`, and recordings as tests of `tappet test`."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import msgspec
import pytest
from failing_press import BUG, MENDED, recording_of, with_text
from tests.cli.invoke import invoke

from tappet.project import edit, folder
from tappet.project.model import Project
from tappet.project.new_project import new_project
from tappet.runtime.flight_recording import read_recording
from tappet.runtime.replay_process import ReplayResult
from tappet.runtime.unit_tests.recordings import RecordedTest, outcome_of


@pytest.fixture(scope="module")
def failing() -> Project:
    """A project with a bug, and the recording of what the bug did in the field."""
    project = with_text(new_project("Press"), BUG)
    text = recording_of(project)
    application = project.applications()[0].id
    project, added = edit.add_object(project, application, "flight_recording", "Stop of Monday")
    return edit.change_data(project, added.id, added.data.model_dump() | {"recording": text})


@pytest.fixture
def press(failing: Project, tmp_path: Path) -> Path:
    folder.save(failing, tmp_path / "press")
    return tmp_path / "press"


def test_the_fault_comes_again(press: Path) -> None:
    done = invoke("replay", press / "Stop of Monday", "--print", "PLC_PRG.pieces")
    assert (done.code, done.errors) == (0, "")
    assert "division by zero in PLC_PRG, line 1, cycle 21" in done.output
    assert "all variables are as recorded" in done.output
    assert "PLC_PRG.pieces = 400" in done.output
    (file,) = press.rglob("*.flight")
    alone = invoke("replay", file, "--until-fault", "--format", "json")
    report = json.loads(alone.output)
    assert (alone.code, report["ok"], report["same_fault"], report["fault"]["cycle"]) == (0, True, True, 21)


def test_it_is_replayed_on_the_program_of_today(failing: Project, press: Path, tmp_path: Path) -> None:
    still = invoke("replay", press / "stop of monday", "--on", press)
    assert still.code == 1
    assert "division by zero in PLC_PRG" in still.output
    folder.save(with_text(failing, MENDED), tmp_path / "mended")
    good = invoke(
        "replay", press / "Stop of Monday", "--on", tmp_path / "mended", "--print", "PLC_PRG.pieces"
    )
    assert good.code == 0, good
    assert "replayed: no exception" in good.output
    assert "PLC_PRG.pieces = 400" in good.output


def test_a_recording_is_a_test_of_the_project(failing: Project, press: Path, tmp_path: Path) -> None:
    failed = invoke("test", press)
    assert failed.code == 1
    assert "Flight recordings" in failed.output
    assert "FAILED  Stop of Monday" in failed.output
    assert "cycle 21: division by zero" in failed.output
    folder.save(with_text(failing, MENDED), tmp_path / "mended")
    junit = tmp_path / "report.xml"
    passed = invoke("test", tmp_path / "mended", "--junit", junit)
    assert passed.code == 0, passed
    assert "ok      Stop of Monday" in passed.output
    assert 'tests="1" failures="0"' in junit.read_text()
    assert invoke("test", press, "--filter", "monday*never").code == 1


def _expecting(project: Project, expects: str) -> Project:
    item = next(item for item in project.walk() if item.kind == "flight_recording")
    return edit.change_data(project, item.id, item.data.model_dump() | {"expects": expects})


def test_a_recording_can_ask_for_its_fault(failing: Project, tmp_path: Path) -> None:
    folder.save(_expecting(failing, "same_fault"), tmp_path / "press")
    passed = invoke("test", tmp_path / "press")
    assert (passed.code, "ok      Stop of Monday" in passed.output) == (0, True), passed
    folder.save(_expecting(with_text(failing, MENDED), "same_fault"), tmp_path / "mended")
    junit = tmp_path / "report.xml"
    failed = invoke("test", tmp_path / "mended", "--junit", junit)
    assert failed.code == 1
    assert "the recorded fault of cycle 21 did not come again: division by zero" in failed.output
    assert '<failure type="error" message="the recorded fault of' in junit.read_text()
    assert "first that differs" not in failed.output, "up to the fault all variables are as recorded"
    # a program that makes 30 pieces a cycle in the place of 20, from the first replayed one on
    more = MENDED.replace("100 / recipe", "150 / recipe")
    folder.save(_expecting(with_text(failing, more), "same_fault"), tmp_path / "more")
    assert (
        "cycle 2 is the first that differs: PLC_PRG.pieces was 40, is 50"
        in invoke("test", tmp_path / "more").output
    )
    # and one that fails before: 20 pieces of the first cycle and 16 x 30 are 500
    earlier = more + " recipe := recipe / (500 - pieces) * 0 + 5;"
    folder.save(_expecting(with_text(failing, earlier), "same_fault"), tmp_path / "earlier")
    other = invoke("test", tmp_path / "earlier")
    assert other.code == 1
    said = "another fault than the recorded one of cycle 21 came: cycle 17: division by zero"
    assert said in other.output, other.output


@pytest.mark.parametrize(
    ("changed", "virtual", "tasks", "good"),
    [
        ({}, True, 1, True),
        ({"line": 9}, True, 1, True),
        ({"cycle": 22}, True, 2, False),
        ({"cycle": 22}, False, 1, False),
        ({"cycle": 22}, False, 2, False),
        ({"pou": "Other"}, True, 1, False),
        ({"task": "Other"}, False, 2, False),
        ({"name": "ARRAY_BOUNDS"}, True, 1, False),
    ],
)
def test_which_fault_is_the_same_one(
    failing: Project, changed: dict[str, Any], virtual: bool, tasks: int, good: bool
) -> None:
    item = next(item for item in failing.walk() if item.kind == "flight_recording")
    recording = read_recording(item.data.model_dump()["recording"])
    recorded = recording.exception
    assert recorded is not None
    recording = msgspec.structs.replace(recording, virtual=virtual, tasks=recording.tasks[:1] * tasks)
    result = ReplayResult(recorded=recorded, fault=replace(recorded, **changed))
    outcome = outcome_of(RecordedTest("Monday", "", same_fault=True), recording, result)
    assert outcome.outcome == ("passed" if good else "failed")


def test_one_that_is_no_test_is_left_out(failing: Project, tmp_path: Path) -> None:
    item = next(item for item in failing.walk() if item.kind == "flight_recording")
    project = edit.change_data(failing, item.id, item.data.model_dump() | {"tested": False})
    folder.save(project, tmp_path / "press")
    done = invoke("test", tmp_path / "press")
    assert done.code == 1
    assert "no block extends FB_TestSuite" in done.errors


def test_what_cannot_be_replayed_says_why(press: Path, tmp_path: Path) -> None:
    (file,) = press.rglob("*.flight")
    damaged = tmp_path / "damaged.flight"
    damaged.write_text(file.read_text()[:-40])
    for arguments, says in (
        ((damaged,), "damaged"),
        ((tmp_path / "none.flight",), "neither a file nor an object"),
        ((press / "Tuesday",), "there is Stop of Monday"),
        ((file, "--until", "-1"), "--until"),
    ):
        refused = invoke("replay", *arguments)
        assert refused.code == 2, refused
        assert says in refused.errors
    unknown = invoke("replay", file, "--print", "PLC_PRG.nope")
    assert unknown.code == 1
    assert "nope" in unknown.errors


def test_the_folder_holds_the_file_as_it_is(failing: Project, press: Path) -> None:
    (file,) = press.rglob("*.flight")
    item = next(item for item in failing.walk() if item.kind == "flight_recording")
    assert file.read_text() == item.data.model_dump()["recording"]
    assert folder.load(press).objects[item.id].data == item.data

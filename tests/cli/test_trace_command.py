"""`tappet trace`: a trace object of a project, recorded to a file."""

from __future__ import annotations

import csv
import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tappet.cli import main
from tappet.project import folder
from tappet.project.edit import add_object, change_data
from tappet.project.motion_project import motion_project
from tappet.project.trace import TraceData, axis_channels
from tappet.traces.formats import TraceReader


def _project(tmp_path: Path, **record: Any) -> Path:
    """The moving axis of the new motion project, traced every 4 ms."""
    project = motion_project("Moving")
    (application,) = project.applications()
    project, trace = add_object(project, application.id, "trace", "Device")
    channels = [channel.model_dump() for channel in axis_channels("Drive")]
    data = TraceData.model_validate(
        {"records": [{"name": "Drive", "buffer": 500, "channels": channels, **record}]}
    )
    project = change_data(project, trace.id, data.model_dump())
    folder.save(project, tmp_path / "Moving")
    return tmp_path / "Moving" / "Device"


def _columns(path: Path) -> dict[str, np.ndarray]:
    with path.open(encoding="utf-8", newline="") as file:
        head, *rows = csv.reader(file)
    return {name: np.array([float(row[n]) for row in rows]) for n, name in enumerate(head)}


def test_a_device_trace_for_a_time(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Virtual time: 3 s of 4 ms are 750 samples; the velocity is the derivative of the position."""
    path = _project(tmp_path)
    assert (
        main(["trace", str(path), "--time", "3s", "--to", str(tmp_path / "a.csv"), "--format", "json"]) == 0
    )
    shown = json.loads(capsys.readouterr().out)
    assert shown["records"] == [{"record": "Drive", "samples": 750, "lost": 0, "state": "recording"}]
    found = _columns(tmp_path / "a.csv")
    assert np.diff(found["time_ns"]).tolist() == [4e6] * 749
    slope = np.diff(found["Drive.fSetPosition"]) / 0.004
    assert slope == pytest.approx(found["Drive.fSetVelocity"][1:], abs=2.0)
    assert found["Drive.fSetVelocity"].max() == pytest.approx(90)


def test_until_the_trigger_has_come(tmp_path: Path) -> None:
    trigger = {"variable": "Drive.fSetPosition", "edge": "positive", "level": "100", "position": 50}
    path = _project(tmp_path, trigger=trigger)
    assert main(["trace", str(path), "--to", str(tmp_path / "a.trace")]) == 0
    with (tmp_path / "a.trace").open("rb") as file:
        reader = TraceReader(file)
        (batch,) = reader.batches(0)
    assert len(batch) <= 500
    position = batch.values[0]
    event = int(np.searchsorted(batch.time, reader.head.records[0].trigger_ns))
    assert position[event - 1] < 100 <= position[event]
    assert len(batch) - 1 - event == 250


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["--to", "a.csv"], "has no trigger"),
        (["--to", "a.xls", "--time", "1s"], "ends with .csv, .parquet or .trace"),
        (["--to", "a.csv", "--time", "1s", "--record", "Nix"], "there is no record 'Nix'"),
    ],
)
def test_usage(tmp_path: Path, capsys: pytest.CaptureFixture[str], arguments: list[str], said: str) -> None:
    assert main(["trace", str(_project(tmp_path)), *arguments]) == 2
    assert said in capsys.readouterr().err


@pytest.mark.parametrize("form", ["csv", "parquet"])
def test_a_formula_without_values_is_refused_before_anything_is_recorded(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], form: str
) -> None:
    channels = [
        {"variable": "Drive.fSetPosition", "name": "pos"},
        {"formula": "pos *", "name": "half"},
        {"formula": "pos - speed", "name": "lost"},
    ]
    path, file = _project(tmp_path, channels=channels), tmp_path / f"a.{form}"
    assert main(["trace", str(path), "--time", "1s", "--to", str(file)]) == 2
    said = capsys.readouterr().err
    assert "record 'Drive', formula 'half': something is missing at the end (at 6)" in said
    assert (
        "record 'Drive', formula 'lost': no recorded variable is called 'speed' (at 7); there are: pos"
        in said
    )
    assert not file.exists()


def test_a_trace_file_holds_formulas_as_they_are_written(tmp_path: Path) -> None:
    channels = [{"variable": "Drive.fSetPosition"}, {"formula": "pos *"}]
    path, file = _project(tmp_path, channels=channels), tmp_path / "a.trace"
    assert main(["trace", str(path), "--time", "1s", "--to", str(file)]) == 0
    with file.open("rb") as opened:
        settings = TraceReader(opened).head.settings
    assert settings["records"][0]["channels"][1]["formula"] == "pos *"


def test_a_trace_that_is_not_there(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = _project(tmp_path).with_name("Other")
    assert main(["trace", str(path), "--time", "1s", "--to", "a.csv"]) == 2
    assert "the project has Device" in capsys.readouterr().err

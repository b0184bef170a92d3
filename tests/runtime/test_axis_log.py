"""SMC_AxisDiagnosticLog: the file holds what the axis had in each cycle (motion_semantics DIA-07)."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache
from pathlib import Path

import pytest
from library_programs import MS, compiled

from tappet.codegen.package import CodePackage
from tappet.iec.task import Task
from tappet.runtime.local import LocalRuntime

TASKS = (
    Task("Bus", interval_ns=2 * MS, priority=1, programs=("PLC_PRG",)),
    Task("Slow", interval_ns=50 * MS, priority=9, programs=("Slow",)),
)
PROGRAM = """PROGRAM PLC_PRG
VAR
    Drive   : AXIS_REF_VIRTUAL_SM3 := (fTaskCycle := 0.002);
    fbPower : MC_Power;
    fbMove  : MC_MoveAbsolute;
    fbLog   : SMC_AxisDiagnosticLog;
    xLog, xClose, xMove : BOOL;
    sName   : STRING := 'axis.txt';
    xWrites : BOOL := TRUE;
END_VAR
Drive.BeginCycle();
fbPower(Axis := Drive, Enable := TRUE, bRegulatorOn := TRUE, bDriveStart := TRUE);
fbMove(Axis := Drive, Execute := xMove, Position := -3.0, Velocity := 10.0, Acceleration := 50.0,
    Deceleration := 50.0);
Drive.EndCycle();
fbLog(Axis := Drive, bExecute := xLog, bCloseFile := xClose, sFileName := sName,
    bSetPosition := TRUE, bActPosition := TRUE, bSetVelocity := TRUE, bSetAcceleration := TRUE);
END_PROGRAM

PROGRAM Slow
IF PLC_PRG.xWrites THEN
    PLC_PRG.fbLog.WriteToFile();
END_IF
END_PROGRAM
"""
VALUES = ("fSetPosition", "fActPosition", "fSetVelocity", "fSetAcceleration")


@cache
def package() -> CodePackage:
    return compiled(PROGRAM, "SM3_Basic", tasks=TASKS)


@pytest.fixture
def runtime(tmp_path: Path) -> Iterator[LocalRuntime]:
    with LocalRuntime(package(), folder=tmp_path) as found:
        found.run(cycles=20)
        yield found


def outputs(runtime: LocalRuntime) -> list[str]:
    names = ("Done", "Busy", "Error", "ErrorID", "bRecording")
    return [runtime.literal(f"PLC_PRG.fbLog.{name}") for name in names]


def rows(folder: Path, name: str = "axis.txt") -> list[list[float]]:
    (path,) = folder.rglob(name)
    text = path.read_bytes().decode("ascii")
    assert text.endswith("\r\n")
    return [[float(value) for value in line.split("\t")] for line in text[:-2].split("\r\n")]


def test_the_file_has_the_values_of_each_cycle(runtime: LocalRuntime, tmp_path: Path) -> None:
    trace = runtime.trace([f"PLC_PRG.Drive.{name}" for name in VALUES], task="Bus")
    runtime.write("PLC_PRG.xLog", True)
    runtime.write("PLC_PRG.xMove", True)
    runtime.run(cycles=300)
    assert outputs(runtime) == ["FALSE", "TRUE", "FALSE", "SMC_NO_ERROR", "TRUE"]
    runtime.write("PLC_PRG.xClose", True)
    runtime.run(cycles=200)
    assert outputs(runtime) == ["TRUE", "FALSE", "FALSE", "SMC_NO_ERROR", "FALSE"]
    found = rows(tmp_path)
    recorded = [[float(str(value)) for value in sample.values.values()] for sample in trace.samples]
    assert len(found) == 300
    assert min(row[0] for row in found) == pytest.approx(-3.0)
    start = next(n for n, row in enumerate(recorded) if row[2] != 0.0) - next(
        n for n, row in enumerate(found) if row[2] != 0.0
    )
    for row, expected in zip(found, recorded[start:], strict=False):
        assert row == pytest.approx(expected, rel=1e-11, abs=1e-30)
    runtime.write("PLC_PRG.xLog", False)
    runtime.run(cycles=2)
    assert outputs(runtime)[0] == "FALSE"


def test_a_second_file_begins_anew(runtime: LocalRuntime, tmp_path: Path) -> None:
    for name, cycles in (("one.txt", 40), ("two.txt", 70)):
        runtime.write("PLC_PRG.sName", name)
        runtime.write("PLC_PRG.xClose", False)
        runtime.write("PLC_PRG.xLog", True)
        runtime.run(cycles=cycles)
        runtime.write("PLC_PRG.xClose", True)
        runtime.run(cycles=300)
        assert outputs(runtime)[0] == "TRUE"
        runtime.write("PLC_PRG.xLog", False)
        runtime.run(cycles=2)
        assert len(rows(tmp_path, name)) == cycles


def test_records_that_nobody_writes_run_over(runtime: LocalRuntime, tmp_path: Path) -> None:
    runtime.write("PLC_PRG.xWrites", False)
    runtime.write("PLC_PRG.xLog", True)
    runtime.write("PLC_PRG.xMove", True)
    runtime.run(cycles=1000)
    assert outputs(runtime) == ["FALSE", "FALSE", "TRUE", "SMC_ADL_BUFFER_OVERRUN", "FALSE"]
    runtime.write("PLC_PRG.xLog", False)
    runtime.run(cycles=2)
    runtime.write("PLC_PRG.xLog", True)
    runtime.run(cycles=2)
    assert outputs(runtime)[3] == "SMC_ADL_BUFFER_OVERRUN", "the file of the first log is not closed yet"
    runtime.write("PLC_PRG.xLog", False)
    runtime.write("PLC_PRG.xWrites", True)
    runtime.run(cycles=200)
    assert 4000 < len(next(tmp_path.rglob("axis.txt")).read_bytes()) < 5120
    runtime.write("PLC_PRG.xLog", True)
    runtime.run(cycles=20)
    assert outputs(runtime)[4] == "TRUE"


@pytest.mark.parametrize("name", ["../axis.txt", "no such folder/axis.txt"])
def test_a_file_that_cannot_be_opened_is_an_error(runtime: LocalRuntime, name: str) -> None:
    runtime.write("PLC_PRG.sName", name)
    runtime.write("PLC_PRG.xLog", True)
    runtime.run(cycles=200)
    assert outputs(runtime) == ["FALSE", "FALSE", "TRUE", "SMC_ADL_FILE_CANNOT_BE_OPENED", "FALSE"]

"""The rows of the timing tables for blocks that work on files; others: test_execute_timing."""

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
    Task("Slow", interval_ns=4 * MS, priority=9, programs=("Slow",)),
)
PROGRAM = """PROGRAM PLC_PRG
VAR
    Drive  : AXIS_REF_VIRTUAL_SM3 := (fTaskCycle := 0.002);
    Points : ARRAY[0..1] OF SMC_CAMXYVA := [(), (dX := 360.0, dY := 360.0)];
    Cam    : MC_CAM_REF := (byType := 3, nElements := 2, xEnd := 360.0, pce := ADR(Points));
    SMC_WriteCAM1         : SMC_WriteCAM;
    SMC_ReadCAM1          : SMC_ReadCAM;
    SMC_AxisDiagnosticLog1 : SMC_AxisDiagnosticLog := (bSetPosition := TRUE);
    diCalls : DINT;
END_VAR
Drive.BeginCycle();
SMC_WriteCAM1(CAM := Cam);
SMC_ReadCAM1();
SMC_AxisDiagnosticLog1(Axis := Drive);
Drive.EndCycle();
diCalls := diCalls + 1;
END_PROGRAM

PROGRAM Slow
PLC_PRG.SMC_AxisDiagnosticLog1.WriteToFile();
END_PROGRAM
"""
FILES = {"SMC_WriteCAM": "written.cam", "SMC_ReadCAM": "given.cam", "SMC_AxisDiagnosticLog": "axis.txt"}
GIVEN = "CAM 1\nTYPE 3\nRANGE 0 360\nNAME Feeder\nELEMENTS 2\n0 0 0 0\n360 360 0 0\nTAPPETS 0\nEND\n"
OUTPUTS = ("Done", "Busy", "Error")


@cache
def package() -> CodePackage:
    return compiled(PROGRAM, "SM3_Basic", tasks=TASKS)


@pytest.fixture
def runtime(tmp_path: Path) -> Iterator[LocalRuntime]:
    (tmp_path / "files").mkdir()
    (tmp_path / "files" / "given.cam").write_text(GIVEN)
    with LocalRuntime(package(), folder=tmp_path) as found:
        found.run(cycles=10)
        yield found


def says(runtime: LocalRuntime, block: str) -> set[str]:
    prefix = "" if block == "SMC_AxisDiagnosticLog" else "b"
    return {name for name in OUTPUTS if runtime.read(f"PLC_PRG.{block}1.{prefix}{name}") is True}


def cycle(runtime: LocalRuntime) -> None:
    """One cycle of the bus task."""
    before = runtime.read("PLC_PRG.diCalls")
    while runtime.read("PLC_PRG.diCalls") == before:
        runtime.run(cycles=1)


def start(runtime: LocalRuntime, block: str, name: str) -> None:
    runtime.write(f"PLC_PRG.{block}1.sFileName", name)
    runtime.write(f"PLC_PRG.{block}1.bExecute", True)
    cycle(runtime)
    assert says(runtime, block) == {"Busy"}


def end(runtime: LocalRuntime, block: str) -> set[str]:
    """What a block says when it is not busy any more."""
    if block == "SMC_AxisDiagnosticLog":
        runtime.write(f"PLC_PRG.{block}1.bCloseFile", True)
    for _ in range(1000):
        told = says(runtime, block)
        if told != {"Busy"}:
            return told
        cycle(runtime)
    raise AssertionError("it never came")


@pytest.mark.parametrize("released", [False, True])
@pytest.mark.parametrize("fails", [False, True])
@pytest.mark.parametrize("block", FILES)
def test_a_file_block_from_its_edge_to_its_end(
    runtime: LocalRuntime, block: str, fails: bool, released: bool
) -> None:
    """EXE-05 to EXE-08, EXE-10: Busy, then Done or Error as long as bExecute, in one cycle at least."""
    assert says(runtime, block) == set()
    start(runtime, block, "no such folder/x" if fails else FILES[block])
    if released:
        runtime.write(f"PLC_PRG.{block}1.bExecute", False)
        cycle(runtime)
    expected = {"Error" if fails else "Done"}
    assert end(runtime, block) == expected
    if not released:
        for _ in range(3):
            cycle(runtime)
            assert says(runtime, block) == expected
        runtime.write(f"PLC_PRG.{block}1.bExecute", False)
    cycle(runtime)
    assert says(runtime, block) == set()
    assert runtime.literal(f"PLC_PRG.{block}1.ErrorID") == "SMC_NO_ERROR"

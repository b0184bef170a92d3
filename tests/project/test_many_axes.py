"""A machine with as many axes as the AX-3000 has (ax3000 SYS-01), on virtual time."""

from __future__ import annotations

from dataclasses import replace

import pytest
from tests.project.axis_projects import with_axes

from tappet.cli.inputs import project_applications
from tappet.codegen.build import build_application
from tappet.project import edit
from tappet.runtime.local import LocalRuntime

AXES = [f"Axis{number}" for number in range(1, 33)]
CYCLES = 150_000
"""Ten minutes of a task of 4 ms."""
DECLARATION = """PROGRAM PLC_PRG
VAR
    afbPower : ARRAY[1..32] OF MC_Power;
    fbMaster : MC_MoveVelocity;
    afbMove  : ARRAY[2..16] OF MC_MoveVelocity;
    afbSelect : ARRAY[17..32] OF MC_CamTableSelect;
    afbCam   : ARRAY[17..32] OF MC_CamIn;
    aPoints  : ARRAY[0..2] OF SMC_CAMXYVA := [(), (dX := 180.0, dY := 90.0), (dX := 360.0)];
    stCam    : MC_CAM_REF := (byType := 3, nElements := 3, xEnd := 360.0, pce := ADR(aPoints));
    ulCycles : ULINT;
END_VAR"""


def _body() -> str:
    lines = ["ulCycles := ulCycles + 1;"]
    lines += [
        f"afbPower[{number}](Axis := {name}, Enable := TRUE, bRegulatorOn := TRUE, bDriveStart := TRUE);"
        for number, name in enumerate(AXES, 1)
    ]
    ramp = "Acceleration := 100.0, Deceleration := 100.0"
    lines.append(f"fbMaster(Axis := Axis1, Execute := afbPower[1].Status, Velocity := 90.0, {ramp});")
    for number in range(2, 17):
        lines.append(
            f"afbMove[{number}](Axis := Axis{number}, Execute := afbPower[{number}].Status, "
            f"Velocity := {10.0 * number}, {ramp});"
        )
    for number in range(17, 33):
        lines.append(
            f"afbSelect[{number}](Master := Axis1, Slave := Axis{number}, CamTable := stCam, "
            "Execute := TRUE);"
        )
        lines.append(
            f"afbCam[{number}](Master := Axis1, Slave := Axis{number}, "
            f"CamTableID := afbSelect[{number}].CamTableID, Execute := afbPower[{number}].Status);"
        )
    return "\n".join(lines)


def test_thirty_two_axes_move_for_ten_minutes() -> None:
    """SYS-01: a master, 15 axes at a velocity and 16 slaves of a cam; no cycle is lost, no way either."""
    project = with_axes(*AXES)
    (program,) = project.find_kind("pou")
    project = edit.change_data(project, program.id, {"declaration": DECLARATION, "implementation": _body()})
    (task,) = project.find_kind("task")
    project = edit.change_data(project, task.id, {**task.data.model_dump(), "interval": "T#4ms"})
    (one,) = project_applications(project)
    result = build_application(one.sources, one.tasks, options=replace(one.options, level=1))
    assert [str(d) for d in result.diagnostics if d.severity == "error"] == []
    assert result.package is not None
    with LocalRuntime(result.package) as plc:
        plc.start()
        plc.run(CYCLES)
        assert plc.read("PLC_PRG.ulCycles") == CYCLES
        master = plc.read("Axis1.fSetPosition")
        assert 0.0 <= master < 360.0
        for number in range(2, 17):
            assert plc.read(f"Axis{number}.fSetVelocity") == pytest.approx(10.0 * number)
        there = min(master, 360.0 - master) / 180.0
        expected = 90.0 * there**3 * (10.0 - 15.0 * there + 6.0 * there**2)
        for number in range(17, 33):
            assert plc.read(f"PLC_PRG.afbCam[{number}].InSync") is True
            assert plc.read(f"Axis{number}.fSetPosition") == pytest.approx(expected, abs=1e-6)

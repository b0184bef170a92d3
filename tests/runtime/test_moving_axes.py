"""Axes of a project in a soft PLC on virtual time (motion_semantics INF-04, INF-08; devices.md AXIS-04)."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

import pytest
from tests.project.axis_projects import BODY, moving, with_axes

from tappet.cli.inputs import project_applications
from tappet.codegen.build import build_application
from tappet.codegen.package import CodePackage
from tappet.project import edit
from tappet.project.model import Project
from tappet.runtime.local import LocalRuntime

CYCLE = 0.02
VELOCITY, ACCELERATION = 10.0, 100.0


def package(project: Project, previous: CodePackage | None = None) -> CodePackage:
    (one,) = project_applications(project)
    options = replace(one.options, level=1, once=False)
    result = build_application(one.sources, one.tasks, options=options, previous=previous)
    assert [str(d) for d in result.diagnostics if d.severity == "error"] == []
    assert result.package is not None
    return result.package


def positions(runtime: LocalRuntime, cycles: int) -> list[float]:
    found = []
    for _ in range(cycles):
        runtime.run(cycles=1)
        found.append(float(runtime.literal("Drive.fSetPosition")))
    return found


def no_step(places: list[float]) -> bool:
    """Velocity and acceleration stay within those of the command."""
    speeds = [(b - a) / CYCLE for a, b in pairwise(places)]
    rises = [abs(b - a) / CYCLE for a, b in pairwise(speeds)]
    return max(map(abs, speeds)) <= VELOCITY * (1 + 1e-9) and max(rises) <= ACCELERATION * (1 + 1e-6)


def test_an_axis_moves_by_three_lines_without_a_call_of_its_own() -> None:
    with LocalRuntime(package(moving(with_axes("Drive")))) as runtime:
        places = positions(runtime, 300)
        assert no_step([0.0, *places])
        assert places[-1] == pytest.approx(50.0)
        assert runtime.literal("IoConfig_Globals.Drive.nAxisState") == "standstill"
        assert runtime.read("Drive.fTaskCycle") == CYCLE


def changed(project: Project, how: str) -> Project:
    """A line of ST is changed; or an axis is added before the one that moves; or its editor is used."""
    if how == "line":
        return moving(project, BODY + "\nfbMove.Jerk := 0.0;")
    pool = project.find_kind("axis_pool")[0]
    if how == "axis":
        return edit.add_object(project, pool.id, "axis", "Another")[0]
    axis = project.find_kind("axis")[0]
    return edit.change_data(project, axis.id, {"modulo": 720.0})


@pytest.mark.parametrize("how", ["line", "axis", "editor"])
def test_an_axis_goes_on_over_an_online_change_without_a_step(how: str) -> None:
    project = moving(with_axes("Drive"))
    with LocalRuntime(package(project)) as runtime:
        places = [0.0, *positions(runtime, 60)]
        assert 0.0 < places[-1] < 50.0
        runtime.plc.download(package(changed(project, how), runtime.package).to_bytes(), "online_change")
        places += positions(runtime, 240)
        assert no_step(places)
        assert runtime.literal("PLC_PRG.fbMove.Done") == "TRUE"
        assert places[-1] == pytest.approx(50.0)
        assert runtime.literal("Drive.bError") == "FALSE"


def test_after_a_download_axes_have_no_power() -> None:
    project = moving(with_axes("Drive"))
    with LocalRuntime(package(project)) as runtime:
        positions(runtime, 60)
        runtime.plc.download(package(moving(project, "")).to_bytes())
        runtime.start()
        positions(runtime, 3)
        assert runtime.literal("Drive.nAxisState") == "power_off"
        assert runtime.literal("Drive.bRegulatorOn") == "FALSE"

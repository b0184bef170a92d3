"""The motion project runs as it is made."""

from __future__ import annotations

import pytest
from tests.runtime.test_moving_axes import package

from tappet.project.motion_project import motion_project
from tappet.project.placement import check_project
from tappet.runtime.local import LocalRuntime


def test_its_axis_moves_to_and_fro() -> None:
    project = motion_project("machine")
    check_project(project)
    with LocalRuntime(package(project)) as runtime:
        places = []
        for _ in range(100):
            runtime.run(time_ns=100_000_000)
            places.append(float(runtime.literal("Drive.fSetPosition")))
            assert runtime.literal("Drive.bError") == "FALSE"
        assert max(places) == pytest.approx(270.0, abs=1.0)
        assert min(places[40:]) == pytest.approx(0.0, abs=1.0)
        assert runtime.read("Drive.fTaskCycle") == 0.004

"""The flying shear cuts to length while the web moves."""

from __future__ import annotations

import numpy as np
import pytest
from tests.projects.example_machines import PROJECTS, machine, number, run

from tappet.project.folder.disk import load
from tappet.project.trace import TraceData
from tappet.runtime.trace_compiler import compile_trace, trace_tasks
from tappet.traces.samples import frame_dtype


def test_pieces_have_their_length_to_the_micrometre() -> None:
    with machine("flying_shear", 61.0) as shear:
        assert number(shear, "GVL_Shear.udiPieces") == pytest.approx(60.0 * 300.0 / 600.0, abs=1)
        assert number(shear, "GVL_Shear.lrWorst") < 1e-3
        assert shear.read("Shear.bError") is False


def test_another_length_and_speed_hold_from_the_next_piece_on() -> None:
    with machine("flying_shear", 10.0) as shear:
        shear.write("GVL_Shear.lrLength", 517.25)
        shear.write("GVL_Shear.lrSpeed", 250.0)
        run(shear, 10.0)
        assert number(shear, "GVL_Shear.lrLastLength") == pytest.approx(517.25, abs=1e-3)
        pieces = number(shear, "GVL_Shear.udiPieces")
        run(shear, 30.0)
        made = number(shear, "GVL_Shear.udiPieces") - pieces
        assert made == pytest.approx(30.0 * 250.0 / 517.25, abs=1)
        assert number(shear, "GVL_Shear.lrWorst") < 1e-3


def test_the_blade_moves_with_the_web_while_it_is_down() -> None:
    with machine("flying_shear", 5.0) as shear:
        seen = 0
        for _ in range(1000):
            run(shear, 0.004)
            if number(shear, "GVL_Plant.lrBlade") < 90.0 and shear.read("GVL_Shear.xBlade") is True:
                seen += 1
                assert number(shear, "Shear.fSetVelocity") == pytest.approx(300.0, abs=1e-6)
        assert seen > 10


@pytest.mark.parametrize("seconds", [8.0, 8.3, 8.7, 9.1, 9.5])
def test_a_web_that_stops_loses_no_piece(seconds: float) -> None:
    with machine("flying_shear", seconds) as shear:
        shear.write("GVL_Shear.xRun", False)
        run(shear, 5.0)
        assert number(shear, "Web.fSetVelocity") == 0.0
        pieces = number(shear, "GVL_Shear.udiPieces")
        shear.write("GVL_Shear.xRun", True)
        run(shear, 20.0)
        assert number(shear, "GVL_Shear.udiPieces") == pytest.approx(pieces + 10.0, abs=1)
        assert number(shear, "GVL_Shear.lrWorst") < 1e-3
        assert shear.read("Shear.bError") is False


def test_the_trace_of_the_project_shows_a_cut() -> None:
    """Shear and web have one velocity from the moment at which the blade goes down until it is up again."""
    project = load(PROJECTS / "flying_shear")
    (trace,) = project.find_kind("trace")
    settings = trace.data_as(TraceData)
    with machine("flying_shear", 5.0) as shear:
        package = shear.package
        tasks = trace_tasks(package.tasks)
        spec = compile_trace(trace.name, settings, package.symbols, tasks, package.code_id, "")
        shear.plc.download_trace(spec, True)
        run(shear, 10.0)
        (record,) = shear.plc.traces()[0].records
        assert record.state == "done"
        frames = shear.plc.take_trace(trace.name, 0, record.first, record.samples)
        found = np.frombuffer(frames.data, frame_dtype(record.sources, record.frame_size))
        assert record.trigger_sample is not None
        at = record.trigger_sample - record.first
        assert 0 < at <= settings.records[0].buffer * 0.4
        assert not found["3"][at - 1]
        assert found["3"][at]
        cutting = np.flatnonzero(found["3"])
        assert found["1"][cutting] == pytest.approx(found["0"][cutting], abs=1e-6)
        assert found["1"][0] < found["0"][0] - 10.0, "before, the shear stands or comes back"

"""Cams of applications that run, read back and written (CAM-94)."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from copy import deepcopy
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tests.motion.random_cams import cams
from tests.project.cam_projects import package, reading, with_cams

from tappet.project.cams.cam_file import read_file, written_file
from tappet.project.cams.checks import POLYNOMIAL_LAWS
from tappet.project.cams.laws import value_at
from tappet.project.cams.running import RunningCam, RunningCamError, read_back, to_write
from tappet.project.cams.table import LAWS, CamTable, CompileFormat
from tappet.project.cams.texts import CamTextError
from tappet.project.cams.variables import BY_TYPE, is_table, variables_of
from tappet.runtime.local import LocalRuntime

DEFAULT = CamTable()
OTHER = CamTable.model_validate(
    {"points": [{"x": -5, "y": 1}, {"x": 5, "y": 2}], "segments": [{}], "tracks": []}
)
TAPPET = {"ctt": 0, "cta": 0, "dwDelay": 0, "dwDuration": 0, "iGroupID": 0, "x": 0.0}
FORMATS = tuple(BY_TYPE)
SIX = [{"x": x, "y": x} for x in range(6)]
quick = settings(max_examples=100, deadline=None)


def running(cam: CamTable, room: int | None = None, tappet_room: int | None = None) -> RunningCam:
    """An application that was compiled with a cam."""
    values = variables_of(cam)
    facts = {"byInterpolationQuality": 1, **values.cam, "byType": BY_TYPE[cam.compile_format]}
    return RunningCam(
        cam.compile_format,
        cam.table_size if is_table(cam) else room or len(values.elements),
        len(values.tappets) if tappet_room is None else tappet_room,
        facts,
        [dict(row) for row in values.elements],
        [{**TAPPET, **row} for row in values.tappets],
    )


def _formatted(cam: CamTable, format: CompileFormat) -> CamTable:
    return cam.model_copy(update={"compile_format": format, "table_size": 128})


@pytest.mark.parametrize("format", FORMATS)
def test_an_application_that_has_the_cam_gives_it_back_itself(format: CompileFormat) -> None:
    """Also one whose format does not hold the laws of the editor."""
    compiled = _formatted(DEFAULT, format)
    assert read_back("Cam", running(compiled), DEFAULT) is DEFAULT


def _bends(cam: CamTable) -> bool:
    """Between two polynomials that neither the velocity nor the acceleration of one point serves."""
    values = variables_of(cam)
    try:
        read_file(written_file("Cam", cam), OTHER)
    except CamTextError:
        return len(values.elements) > len(cam.points)
    return False


@quick
@given(cam=cams(laws=LAWS), format=st.sampled_from(FORMATS))
def test_the_curve_of_the_application_comes_back(cam: CamTable, format: CompileFormat) -> None:
    if format == "polynomial":
        laws = [one.law if one.law in POLYNOMIAL_LAWS else "poly5" for one in cam.segments]
        cam = cam.model_copy(
            update={
                "segments": tuple(
                    one.model_copy(update={"law": law}) for one, law in zip(cam.segments, laws, strict=True)
                )
            }
        )
    compiled = _formatted(cam, format)
    if format == "polynomial" and _bends(cam):
        with pytest.raises(RunningCamError, match="jumps at X"):
            read_back("Cam", running(compiled), OTHER)
        return
    found = read_back("Cam", running(compiled), OTHER)
    assert found.domain == cam.domain
    first, last = cam.domain
    places = np.linspace(first, last, 128) if format == "one_dimensional" else np.linspace(first, last, 57)
    if format == "two_dimensional":
        places = np.array([point.x for point in found.points])
    size = max(abs(value_at(cam, x).y) for x in places)
    for x in places:
        assert value_at(found, x).y == pytest.approx(value_at(cam, x).y, abs=1e-7 * size + 1e-12), x


@quick
@given(cam=cams(laws=LAWS), format=st.sampled_from(("segments", "one_dimensional", "two_dimensional")))
def test_what_is_written_is_what_a_download_would_bring(cam: CamTable, format: CompileFormat) -> None:
    compiled = _formatted(DEFAULT, format)
    values = to_write("Cam", running(compiled, room=50), cam)
    assert values == variables_of(_formatted(cam, format))


def test_tappets_come_back_with_the_curve() -> None:
    found = read_back("Cam", running(DEFAULT), OTHER)
    assert found.tracks == (DEFAULT.tracks[0],)
    assert found.points == DEFAULT.points


def test_lines_of_the_editor_stay_lines() -> None:
    """A polynomial of fifth degree that is a line is told apart by the segment of the editor alone."""
    lines = CamTable.model_validate(
        {
            "points": [{"x": 0, "y": 0, "v": 1}, {"x": 10, "y": 10, "v": 1}, {"x": 20, "y": 20, "v": 1}],
            "segments": [{"law": "line"}, {}],
            "tracks": [],
        }
    )
    now = deepcopy(running(lines))
    now.elements[2]["dV"] = 0.5
    found = read_back("Cam", now, lines)
    assert [one.law for one in found.segments] == ["line", "poly5"]
    assert [one.v for one in found.points] == [1, 1, 0.5]
    assert [one.law for one in read_back("Cam", now, OTHER).segments] == ["poly5", "poly5"]


@pytest.mark.parametrize("quality", [1, 3])
def test_a_table_has_the_curve_of_the_library(quality: int) -> None:
    """Between its points, against SMC_CAMEvaluate in a runtime."""
    data = {"compile_format": "one_dimensional", "table_size": 128, "cubic": quality == 3, "tracks": []}
    project = reading(with_cams(Cam=data))
    with LocalRuntime(package(project)) as plc:
        plc.start()
        facts = plc.read("IoConfig_Cam.Cam")
        table = plc.read("IoConfig_Cam.Cam_A")
        found = read_back("Cam", RunningCam("one_dimensional", 128, 0, facts, [table], []), OTHER)
        for x in np.linspace(0, 360, 77):
            plc.write("PLC_PRG.fX", float(x))
            plc.run(2)
            assert value_at(found, x).y == pytest.approx(plc.read("PLC_PRG.stValues.dY"), abs=1e-9)
            assert value_at(found, x).v == pytest.approx(plc.read("PLC_PRG.stValues.dV"), abs=1e-6)


def _element(name: str, value: Any, number: int = 1) -> Callable[[RunningCam], None]:
    return lambda cam: cam.elements[number].__setitem__(name, value)


def _member(name: str, value: Any) -> Callable[[RunningCam], None]:
    def change(cam: RunningCam) -> None:
        facts = cam.cam
        assert isinstance(facts, dict)
        facts[name] = value

    return change


@pytest.mark.parametrize(
    ("format", "change", "text"),
    [
        ("polynomial", _element("dV", math.nan), "Element 2 of 'Cam' in the application: dV is nan;"),
        ("polynomial", _element("dX", -1.0), "-1 does not lie behind 0"),
        ("polynomial", _element("dY", math.inf, 3), "Element 4 of 'Cam' in the application: dY"),
        ("polynomial", _member("nElements", 5), "nElements is 5, but the elements that were compiled are 4"),
        ("polynomial", _member("byType", 0), "byType is 0"),
        ("polynomial", _member("xEnd", 100.0), "the elements do not go from xStart = 0 to xEnd = 100"),
        ("segments", _element("eType", 9), "eType is 9; laws have numbers from 0 to 7"),
        ("segments", _element("dLambda", 1.0), "dLambda is 1; it lies between 0 and 1"),
        ("segments", _element("dX0", 119.0), "X = 119, Y = 120, and the one before ends at X = 120"),
        ("segments", _element("dV0", 2.0), "the velocity jumps from 1 to 2; a point of the"),
        ("segments", _element("dX1", 0.0), "0 does not lie behind 120"),
        ("one_dimensional", _element("fTableSlaveMax", 2.0, 0), "the size or the ranges of the table"),
    ],
)  # fmt: skip
def test_what_the_program_has_broken_is_named(
    format: CompileFormat, change: Callable[[RunningCam], None], text: str
) -> None:
    now = running(_formatted(DEFAULT, format))
    change(now)
    with pytest.raises(RunningCamError) as error:
        read_back("Cam", now, DEFAULT)
    assert text in str(error.value)


def test_a_law_that_needs_no_velocity_leaves_it_to_its_neighbour() -> None:
    data = {**DEFAULT.model_dump(), "segments": [{"law": "line"}, {}, {}], "compile_format": "segments"}
    now = running(CamTable.model_validate(data))
    _element("dV1", 7.0, 0)(now)
    assert read_back("Cam", now, OTHER).points[1].v == 1


@pytest.mark.parametrize(
    ("changes", "text"),
    [
        ({"points": SIX, "segments": [{}] * 5}, "room for 4 elements of 'Cam'"),
        ({"segments": [{"law": "sine"}, {}, {}]}, "is of the type Sine"),
        ({"tracks": [{"id": 1, "tappets": [{"x": 1}] * 3}]}, "room for 4 tappets of 'Cam'"),
    ],
)  # fmt: skip
def test_there_is_only_the_room_that_was_compiled(changes: Mapping[str, Any], text: str) -> None:
    wanted = CamTable.model_validate({**DEFAULT.model_dump(), "tracks": [], **changes})
    with pytest.raises(RunningCamError) as error:
        to_write("Cam", running(DEFAULT), wanted)
    assert text in str(error.value)

"""Cams in the tree and what the compiler gets of them (cam.md CAM-10 to CAM-13, CAM-70 to CAM-75, CAM-90 to
CAM-95)."""

from __future__ import annotations

import math
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from tests.project.cam_projects import build, cam, changed, package, reading, with_cams

from tappet.project import edit
from tappet.project.cams.checks import findings
from tappet.project.cams.code import generated_code
from tappet.project.cams.elements import by_bend, equidistant, xyva_points
from tappet.project.cams.laws import value_at
from tappet.project.cams.table import CamPoint, CamSegment, CamTable
from tappet.project.errors import InvalidDataError
from tappet.project.folder.codec import decode, encode
from tappet.project.sources import application_sources
from tappet.runtime.local import LocalRuntime

BENDS = {
    "points": [
        {"x": 0, "y": 0, "v": 100 / 140},
        {"x": 140, "y": 100, "v": 100 / 140},
        {"x": 280, "y": 180, "v": -0.5},
        {"x": 360, "y": 140, "v": -0.5},
    ],
    "segments": [{"law": "line"}, {"law": "poly5"}, {"law": "line"}],
}
EVERY_LAW = {
    "points": [
        {"x": 10 * n, "y": y, "v": 0.5 - n / 10, "a": 0.01 * n, "j": 0.001}
        for n, y in enumerate((0, 5, 30, 20, 60, 10, 40, -30, 0))
    ],
    "segments": [
        {"law": law, "inflection": 0.4}
        for law in ("line", "poly3", "poly5", "poly7", "sine", "inclined_sine", "modified_sine", "harmonic")
    ],
    "tracks": [],
    "checks": {"velocity": False, "acceleration": False, "jerk": False},
}


def table(**data: Any) -> CamTable:
    return CamTable.model_validate({"tracks": [], **data})


def test_a_new_cam_is_the_one_of_the_specification() -> None:
    """CAM-12, CAM-13."""
    new = cam(with_cams(Cam=None))
    assert [(p.x, p.y, p.v, p.a) for p in new.points] == [
        (0, 0, 0, 0),
        (120, 120, 1, 0),
        (240, 240, 1, 0),
        (360, 360, 0, 0),
    ]
    assert [segment.law for segment in new.segments] == ["poly5"] * 3
    assert [(track.id, [one.x for one in track.tappets]) for track in new.tracks] == [(1, [90, 270]), (2, [])]
    assert {(one.positive, one.negative) for one in new.tracks[0].tappets} == {("on", "off")}
    assert findings(new) == []


def test_the_code_of_the_new_cam() -> None:
    """cam EX-09: points, and two entries for a tappet that switches on and off, one where both are equal."""
    text = generated_code("Cam", table())
    expected = """VAR_GLOBAL
        Cam_A : ARRAY[0..3] OF SMC_CAMXYVA := [ (dX:=0,dY:=0,dV:=0,dA:=0), (dX:=120,dY:=120,dV:=1,dA:=0),
            (dX:=240,dY:=240,dV:=1,dA:=0), (dX:=360,dY:=360,dV:=0,dA:=0)];
        Cam : MC_CAM_REF := (byType:=3, nElements:=4, xStart:=0, xEnd:=360, nTappets:=0, strCAMName:='Cam',
            pce:=ADR(Cam_A));
        END_VAR"""
    assert text.split() == expected.split()
    track = {
        "id": 1,
        "tappets": [
            {"x": 90},
            {"x": 180, "positive": "invert", "negative": "invert"},
            {"x": 200, "positive": "none", "negative": "none"},
        ],
    }
    text = generated_code("Cam", table(tracks=[track]))
    assert "(ctt:=TAPPET_pos,cta:=TAPPETACTION_on,iGroupID:=1,x:=90)" in text
    assert "(ctt:=TAPPET_neg,cta:=TAPPETACTION_off,iGroupID:=1,x:=90)" in text
    assert "(ctt:=TAPPET_all,cta:=TAPPETACTION_inv,iGroupID:=1,x:=180)" in text
    assert "nTappets:=3" in text
    assert "pt:=ADR(Cam_T)" in text


def test_a_line_bends_where_a_point_stands_twice() -> None:
    """cam EX-02: four points are enough where the derivatives of the lines are those of the polynomial."""
    assert [(p.x, p.v) for p in xyva_points(table(**BENDS))] == [
        (0, pytest.approx(100 / 140)),
        (140, pytest.approx(100 / 140)),
        (280, -0.5),
        (360, -0.5),
    ]
    lines = table(
        points=[{"x": 0, "y": 0}, {"x": 10, "y": 10}, {"x": 20, "y": -10}],
        segments=[{"law": "line"}, {"law": "line"}],
    )
    assert [(p.x, p.v) for p in xyva_points(lines)] == [(0, 1), (10, 1), (10, -2), (20, -2)]


@pytest.mark.parametrize(
    ("data", "count"),
    [
        ({}, 4),
        (BENDS, 4),
        ({**EVERY_LAW, "compile_format": "segments"}, 8),
        ({"compile_format": "one_dimensional"}, 256),
        ({"compile_format": "two_dimensional", "table_size": 128}, 128),
        ({**EVERY_LAW, "compile_format": "two_dimensional", "cubic": True}, 256),
    ],
)
def test_what_is_compiled_is_the_cam(data: dict[str, Any], count: int) -> None:
    """The running application evaluates the cam as the twin of its laws says, or its table between points."""
    project = reading(with_cams(Cam=data or None))
    given = cam(project)
    with LocalRuntime(package(project)) as runtime:
        assert runtime.read("Cam.nElements") == count
        assert runtime.literal("Cam.strCAMName") == "'Cam'"
        first, last = given.domain
        worst = 0.0
        for number in range(41):
            x = first + (last - first) * number / 40
            runtime.write("PLC_PRG.fX", x)
            runtime.run(cycles=1)
            worst = max(worst, abs(float(runtime.literal("PLC_PRG.stValues.dY")) - value_at(given, x).y))
        size = max(abs(point.y) for point in given.points)
        assert worst <= size * (1e-12 if "dimensional" not in given.compile_format else 1e-3)


def test_every_table_of_a_cam_has_its_ends_and_rises() -> None:
    for data in ({}, BENDS, EVERY_LAW):
        given = table(**data)
        for count in (2, 3, 9, 128):
            for points in (equidistant(given, count), by_bend(given, count)):
                assert len(points) == count
                assert (points[0][0], points[-1][0]) == given.domain
                assert all(a[0] < b[0] for a, b in pairwise(points))
                assert all(y == value_at(given, x).y for x, y in points)


def test_positions_of_a_table_lie_where_the_curve_bends() -> None:
    """Linear interpolation between pairs misses the cam by less than between equal distances."""
    given = table(
        points=[
            {"x": 0, "y": 0},
            {"x": 300, "y": 300, "v": 1},
            {"x": 330, "y": 0, "v": 1},
            {"x": 360, "y": 30},
        ],
        segments=[{"law": "poly5"}] * 3,
    )

    def miss(points: list[tuple[float, float]]) -> float:
        at = np.linspace(0, 360, 20_001)
        exact = [value_at(given, x).y for x in at]
        return float(np.abs(np.interp(at, *zip(*points, strict=True)) - exact).max())

    assert miss(by_bend(given, 64)) < 0.5 * miss(equidistant(given, 64))


def test_the_list_has_a_pointer_to_each_cam() -> None:
    """CAM-91."""
    more = "FOR nElement := 0 TO 2 DO asNames[nElement] := _SMC_CAM_LIST[nElement]^.strCAMName; END_FOR"
    project = reading(
        with_cams(First=None, Second=None, Third=None), "First", more, "asNames: ARRAY[0..2] OF STRING;"
    )
    with LocalRuntime(package(project)) as runtime:
        runtime.run(cycles=1)
        names = [runtime.literal(f"PLC_PRG.asNames[{n}]") for n in range(3)]
    assert names == ["'First'", "'Second'", "'Third'"]


def test_without_its_library_a_cam_is_an_error_at_the_cam() -> None:
    """CAM-92."""
    project = with_cams(library=False, Cam=None)
    found = [d for d in build(project).diagnostics if d.severity == "error"]
    assert any(d.code == "E0202" and "MC_CAM_REF" in d.message for d in found)
    (application,) = project.applications()
    sources = {source.uri: source for source in application_sources(project, application.id)}
    (item,) = project.find_kind("cam")
    assert {sources[d.uri].map.place(d.span).object_id for d in found} == {item.id}


def test_programs_change_and_assign_cams() -> None:
    """CAM-93 to CAM-95."""
    more = "Cam_A[1].dY := 60.0;\nIF FALSE THEN Cam.nElements := 3; END_IF\nstUsed := Cam;"
    project = reading(with_cams(Cam=None, Other=None), "stUsed", more, "stUsed : MC_CAM_REF;")
    with LocalRuntime(package(project)) as runtime:
        runtime.write("PLC_PRG.fX", 120.0)
        runtime.run(cycles=1)
        assert runtime.literal("PLC_PRG.stValues.dY") == "60.0"


def test_a_renamed_cam_is_used_under_its_new_name() -> None:
    project = reading(with_cams(Cam=None), "IoConfig_Cam.Cam", "Cam_A[0].dY := Cam.xStart;")
    (item,) = project.find_kind("cam")
    project = edit.rename_object(project, item.id, "Feeder")
    (program,) = project.find_kind("pou")
    body = program.data.model_dump()["implementation"]
    assert "Feeder_A[0].dY := Feeder.xStart;" in body
    assert ".Feeder, fX" in body


def test_an_online_change_takes_over_the_cam_that_was_edited() -> None:
    """And leaves alone what the program has changed in another one."""
    project = reading(with_cams(Cam=None, Other=None), more="IF fX < 0.0 THEN Other_A[1].dY := 7.0; END_IF")
    first = package(project)
    with LocalRuntime(first) as runtime:

        def at(x: float) -> float:
            runtime.write("PLC_PRG.fX", x)
            runtime.run(cycles=1)
            return float(runtime.literal("PLC_PRG.stValues.dY"))

        assert at(-1.0) == 0.0
        assert at(60.0) == 41.25
        points = [p.model_dump() for p in cam(project).points]
        points.insert(1, {"x": 60, "y": 10})
        project = changed(project, points=points, segments=[{}] * 4)
        runtime.plc.download(package(project, first).to_bytes(), "online_change")
        assert at(60.0) == 10.0
        assert at(360.0) == 360.0
        assert runtime.literal("Other_A[1].dY") == "7.0"
        points[1]["y"] = 20
        second = runtime.package
        project = changed(project, points=points)
        runtime.plc.download(package(project, second).to_bytes(), "online_change")
        assert at(60.0) == 20.0
        assert runtime.literal("Other_A[1].dY") == "7.0"


def facts(given: CamTable) -> list[tuple[str, str, float]]:
    return [(one.kind, one.derivative, one.x) for one in findings(given)]


def test_what_is_not_continuous_is_found() -> None:
    """CAM-03, CAM-47, CAM-74."""
    points = [{"x": 0, "y": 0}, {"x": 10, "y": 10}, {"x": 20, "y": 5}]
    lines = table(points=points, segments=[{"law": "line"}] * 2)
    assert facts(lines) == [("jump", "velocity", 10)]
    assert (
        facts(lines.model_copy(update={"checks": lines.checks.model_copy(update={"velocity": False})})) == []
    )
    cubic = table(points=points, segments=[{"law": "poly3"}] * 2)
    assert facts(cubic) == [("jump", "acceleration", 10)]
    checked = table(checks={"jerk": True})
    assert facts(checked) == [("jump", "jerk", 120), ("jump", "jerk", 240)]
    assert "The jerk jumps from 0.001666667 to 0 at X = 120" in findings(checked)[0].text


def test_what_is_not_periodic_is_found() -> None:
    """CAM-04, cam EX-07: 720 is 0 and two periods, 100 is not; velocities at both ends are the same."""
    ends = ({"x": 0, "y": 0, "v": 0.5}, {"x": 360, "y": 720, "v": 0.5})
    given = {"segments": [{}], "periodic": True}
    assert facts(table(points=ends, **given)) == []
    assert facts(table(points=(ends[0], {**ends[1], "y": 100}), **given)) == [("end", "position", 360)]
    assert facts(table(points=(ends[0], {**ends[1], "v": 0.0}), **given)) == [("period", "velocity", 360)]
    assert facts(table(points=(ends[0], {**ends[1], "y": 720 + 1e-9}), **given)) == []


def test_a_law_that_the_compile_format_does_not_have_is_an_error() -> None:
    """CAM-45."""
    given = table(segments=[{"law": "sine"}, {}, {}], checks={"velocity": False, "acceleration": False})
    assert facts(given) == [("law", "position", 0)]
    for form in ("segments", "one_dimensional", "two_dimensional"):
        assert facts(given.model_copy(update={"compile_format": form})) == []


def test_a_build_says_what_is_found_at_the_place() -> None:
    """CAM-74: with the cam, the position, and codes of their own."""
    points = [{"x": 0, "y": 0}, {"x": 10, "y": 10}, {"x": 20, "y": 5}]
    project = with_cams(
        Bent={"points": points, "segments": [{"law": "line"}] * 2, "tracks": []},
        Wave={"segments": [{"law": "sine"}, {}, {}], "tracks": [], "checks": {"velocity": False}},
    )
    (application,) = project.applications()
    sources = {source.uri: source for source in application_sources(project, application.id)}
    found = {}
    for one in build(project).diagnostics:
        if one.severity != "info":
            place = sources[one.uri].map.place(one.span)
            found[project.get(place.object_id).name, one.code, place.element] = one.message
    assert found == {
        ("Bent", "W1225", "10.0"): "Bent: The velocity jumps from 1 to -0.5 at X = 10",
        ("Wave", "E0452", "0.0"): (
            "Wave: The segment behind X = 0 is of the type Sine, which the compile format of polynomials "
            "does not have; choose the format of segments"
        ),
        ("Wave", "W1225", "120.0"): "Wave: The acceleration jumps from -0.04112335 to 0 at X = 120",
    }


@pytest.mark.parametrize(
    ("data", "place"),
    [
        ({"points": [{"x": 0, "y": 0}]}, "points"),
        (
            {"points": [{"x": 0, "y": 0}, {"x": 0, "y": 1}], "segments": [{}]},
            "points.1.x: 0 does not lie behind 0",
        ),
        ({"points": [{"x": 0, "y": 0}, {"x": -1, "y": 1}], "segments": [{}]}, "points.1.x: -1 does not"),
        ({"points": [{"x": 0, "y": 0}, {"x": math.nan, "y": 1}], "segments": [{}]}, "points.1.x"),
        ({"points": [{"x": 0, "y": 0}, {"x": 1, "y": 1e300}], "segments": [{}]}, "points.1.y"),
        ({"points": [{"x": 0, "y": "much"}, {"x": 1, "y": 1}], "segments": [{}]}, "points.0.y"),
        ({"points": [{"x": 0, "y": 0, "w": 1}, {"x": 1, "y": 1}], "segments": [{}]}, "points.0.w"),
        ({"segments": [{}]}, "segments: 4 points have 3 segments between them, not 1"),
        ({"segments": [{"law": "spline"}, {}, {}]}, "segments.0.law"),
        ({"segments": [{"inflection": 1}, {}, {}]}, "segments.0.inflection"),
        ({"tracks": [{"id": 1}, {"id": 1}]}, "tracks.1.id: two tracks have the id 1"),
        ({"tracks": [{"id": 0}]}, "tracks.0.id"),
        (
            {"tracks": [{"id": 1, "tappets": [{"x": 361}]}]},
            "tracks.0.tappets.0.x: 361 lies outside the range",
        ),
        ({"tracks": [{"id": 1, "tappets": [{"x": 1, "positive": "toggle"}]}]}, "tracks.0.tappets.0.positive"),
        ({"slave_start": 5, "slave_end": 5}, "slave_end"),
        ({"slave_period": 0}, "slave_period"),
        ({"compile_format": "spline"}, "compile_format"),
        ({"table_size": 1}, "table_size"),
    ],
)
def test_damaged_data_are_refused_with_their_place(data: dict[str, Any], place: str) -> None:
    with pytest.raises(InvalidDataError, match=place):
        with_cams(Cam={"tracks": [], **data})


def test_in_a_folder_a_point_is_a_line() -> None:
    project = with_cams(Cam=None)
    files = encode(project)
    (path,) = (path for path in files if path.endswith("Cam.cam.json"))
    lines = files[path].decode().splitlines()
    assert '    {"a": 0.0, "j": 0.0, "v": 1.0, "x": 120.0, "y": 120.0},' in lines
    assert '        {"negative": "off", "positive": "on", "x": 90.0},' in lines
    again = decode(files).project
    assert cam(again) == cam(project)
    assert encode(again) == files


def test_a_finer_cam_compiles_into_a_type_of_the_user() -> None:
    """CAM-75: other counts than 128 and 256 need a type that the project declares."""
    project = with_cams(Cam={"compile_format": "one_dimensional", "table_size": 12})
    assert "E0202" in {d.code for d in build(project).diagnostics}
    (application,) = project.applications()
    limits = "\n".join(
        f"    f{unit}{axis}{end} : LREAL;"
        for unit in ("Editor", "Table")
        for axis in ("Master", "Slave")
        for end in ("Min", "Max")
    )
    name = "SMC_CAMTable_LREAL_12_1"
    members = f"    Table : ARRAY[0..11] OF LREAL;\n{limits}"
    text = f"TYPE {name} :\nSTRUCT\n{members}\nEND_STRUCT\nEND_TYPE"
    project, _ = edit.add_object(project, application.id, "dut", name, data={"declaration": text})
    package(reading(project))


def test_an_excluded_cam_is_not_compiled() -> None:
    project = with_cams(Cam=None, Other=None)
    project = edit.exclude_object(project, project.find_kind("cam")[0].id, True)
    (application,) = project.applications()
    text = "\n".join(source.text for source in application_sources(project, application.id))
    assert "ADR(Cam)" not in text
    assert "[ADR(Other)]" in text


def test_the_twin_has_the_values_at_the_ends_of_a_segment() -> None:
    for law in ("poly5", "poly7", "harmonic"):
        left = CamPoint(x=1, y=2, v=0.5, a=-0.25, j=0.125)
        right = CamPoint(x=3, y=1, v=-0.5, a=0.75, j=0.5)
        given = CamTable(points=(left, right), segments=(CamSegment(law=law),), tracks=())
        for point in (left, right):
            found = value_at(given, point.x)
            assert found[:3] == pytest.approx((point.y, point.v, point.a))

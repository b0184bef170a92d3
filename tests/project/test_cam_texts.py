"""Cams as ASCII tables, CSV and cam files (cam.md section 9).

What is written comes back, foreign texts are refused by their line.
"""

from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tests.motion.random_cams import cams

from tappet.motion.cam_import import imported_cam
from tappet.project.cams.cam_file import NoCamFileError, written_file
from tappet.project.cams.elements import xyva_points
from tappet.project.cams.laws import value_at
from tappet.project.cams.point_lists import written_points
from tappet.project.cams.table import CamPoint, CamSegment, CamTable, CamTappet, CamTrack
from tappet.project.cams.texts import CamTextError

DEFAULT = CamTable()
OTHER = CamTable(points=(CamPoint(x=-1e6, y=0), CamPoint(x=1e6, y=5)), segments=(CamSegment(),), tracks=())
quick = settings(max_examples=100, deadline=None)


def test_ascii_table_of_the_default_cam() -> None:
    """cam EX-08."""
    four = written_points(DEFAULT, "ascii", 4, points_only=False)
    assert four == "0 0\n120 120\n240 240\n360 360\n"
    assert written_points(DEFAULT, "ascii", 99, points_only=True) == four
    seven = [
        [float(word) for word in line.split()]
        for line in written_points(DEFAULT, "ascii", 7, points_only=False).splitlines()
    ]
    assert seven == [[0, 0], [60, 41.25], [120, 120], [180, 180], [240, 240], [300, 318.75], [360, 360]]


@quick
@given(cam=cams())
def test_csv_comes_back_to_the_last_bit(cam: CamTable) -> None:
    text = written_points(cam, "csv", 2, points_only=True)
    back = imported_cam(text, OTHER).cam
    assert (back.points, back.segments) == (cam.points, cam.segments)


@quick
@given(cam=cams(), count=st.integers(2, 40), separator=st.sampled_from(";\t"), comma=st.booleans())
def test_what_spreadsheets_make_of_it_comes_back(
    cam: CamTable, count: int, separator: str, comma: bool
) -> None:
    """Semicolons, decimal commas, quoted headings, other ends of lines, a byte order mark."""
    text = written_points(cam, "csv", count, points_only=False)
    foreign = text.replace(",", separator)
    if comma:
        foreign = foreign.replace(".", ",")
    foreign = foreign.replace("x" + separator, f'"X"{separator}', 1).replace("\n", "\r\n")
    assert imported_cam("\ufeff" + foreign, OTHER).cam == imported_cam(text, OTHER).cam


@quick
@given(cam=cams(), count=st.integers(2, 40))
def test_ascii_tables_come_back(cam: CamTable, count: int) -> None:
    """Positions to the last bit; velocity and acceleration are those of one smooth curve through them."""
    text = written_points(cam, "ascii", count, points_only=False)
    back = imported_cam(text, OTHER).cam
    assert written_points(back, "ascii", 2, points_only=True) == text
    assert {segment.law for segment in back.segments} == {"poly5"}


@quick
@given(
    powers=st.lists(st.floats(-3, 3), min_size=4, max_size=4),
    x=st.lists(st.integers(-50, 50), min_size=4, max_size=12, unique=True),
)
def test_points_of_a_cubic_give_the_cubic(powers: list[float], x: list[int]) -> None:
    def y(at: float, order: int = 0) -> float:
        a, b, c, d = powers
        s = at / 50
        by_order = (a + b * s + c * s**2 + d * s**3, (b + 2 * c * s + 3 * d * s**2) / 50)
        return (*by_order, (2 * c + 6 * d * s) / 2500)[order]

    text = "\n".join(f"{at}\t{y(at)!r}" for at in sorted(x))
    for point in imported_cam(text, OTHER).cam.points:
        assert point.v == pytest.approx(y(point.x, 1), abs=1e-9)
        assert point.a == pytest.approx(y(point.x, 2), abs=1e-9)


def test_a_periodic_cam_stays_smooth_over_its_end() -> None:
    periodic = DEFAULT.model_copy(update={"periodic": True, "slave_period": 90.0})
    found = imported_cam("0 0\n90 100\n200 180\n270 250\n360 360\n", periodic).cam
    first, last = found.points[0], found.points[-1]
    assert (last.v, last.a) == pytest.approx((first.v, first.a), rel=1e-12)
    assert (first.y, last.y, found.periodic) == (0, 360, True)
    open_end = imported_cam("0 0\n90 100\n200 180\n270 250\n360 361\n", periodic).cam
    assert open_end.points[0].v != pytest.approx(open_end.points[-1].v)


def test_two_pairs_are_a_straight_cam() -> None:
    found = imported_cam("# from the old machine\n\n  0 10 \n 100   60\n", DEFAULT)
    assert [(p.x, p.y, p.v, p.a) for p in found.cam.points] == [(0, 10, 0.5, 0), (100, 60, 0.5, 0)]
    assert found.removed_tappets == 1
    assert [track.id for track in found.cam.tracks] == [1, 2]
    assert [tappet.x for track in found.cam.tracks for tappet in track.tappets] == [90]


def test_velocities_without_accelerations_make_cubics() -> None:
    found = imported_cam("X;Y;V\n0;0;0\n1;1;0,5\n2;1;0", DEFAULT).cam
    assert [segment.law for segment in found.segments] == ["poly3", "poly3"]
    assert found.points[1].v == 0.5


POLYNOMIALS = ("line", "poly3", "poly5")


def _same_curve(one: CamTable, other: CamTable) -> None:
    assert one.domain == other.domain
    first, last = one.domain
    for number in range(101):
        x = first + (last - first) * number / 100
        found, wanted = value_at(one, x), value_at(other, x)
        assert found.y == pytest.approx(wanted.y, abs=1e-9)
        assert found.v == pytest.approx(wanted.v, abs=1e-7)


def _bends(cam: CamTable) -> list[tuple[float, ...]]:
    """The points of a curve; two at one place that differ by rounding alone are one."""
    found: list[tuple[float, ...]] = []
    for p in xyva_points(cam):
        point = (p.x, p.y, p.v, p.a)
        if not found or found[-1] != pytest.approx(point, rel=1e-12, abs=1e-12):
            found.append(point)
    return found


@quick
@given(cam=cams(laws=POLYNOMIALS))
def test_cam_files_come_back(cam: CamTable) -> None:
    """The same curve; bends at lines and cubics are there again."""
    text = written_file("Feeder", cam)
    back = imported_cam(text, OTHER).cam
    _same_curve(back, cam)
    again, wanted = _bends(back), _bends(cam)
    assert len(again) == len(wanted)
    for one, other in zip(again, wanted, strict=True):
        assert one == pytest.approx(other, rel=1e-8, abs=1e-8)


ACTIONS = st.sampled_from(("none", "on", "off", "invert"))
TAPPETS = st.builds(CamTappet, x=st.integers(0, 360).map(float), positive=ACTIONS, negative=ACTIONS)


@quick
@given(first=st.lists(TAPPETS, max_size=5), second=st.lists(TAPPETS, max_size=5))
def test_tappets_of_cam_files_come_back(first: list[CamTappet], second: list[CamTappet]) -> None:
    """Those that do something, each direction in its order; a track without any is gone."""

    def passes(cam: CamTable, direction: str) -> list[tuple[int, float, str]]:
        return [
            (track.id, one.x, getattr(one, direction))
            for track in cam.tracks
            for one in track.tappets
            if getattr(one, direction) != "none"
        ]

    tracks = (CamTrack(id=3, tappets=tuple(first)), CamTrack(id=17, tappets=tuple(second)))
    cam = DEFAULT.model_copy(update={"tracks": tracks})
    back = imported_cam(written_file("Cam", cam), OTHER).cam
    for direction in ("positive", "negative"):
        assert passes(back, direction) == passes(cam, direction)
    assert all(track.tappets for track in back.tracks)


def test_the_default_cam_as_a_file() -> None:
    """As docs/cam-files.md has it."""
    text = written_file("Feeder", DEFAULT)
    assert text == (
        "CAM 1\nTYPE 3\nRANGE 0 360\nNAME Feeder\n"
        "ELEMENTS 4\n0 0 0 0\n120 120 1 0\n240 240 1 0\n360 360 0 0\n"
        "TAPPETS 4\n1 90 0 0 0 0\n1 90 2 1 0 0\n1 270 0 0 0 0\n1 270 2 1 0 0\nEND\n"
    )
    back = imported_cam(text, OTHER).cam
    assert back.points == DEFAULT.points
    assert back.tracks == DEFAULT.tracks[:1]


def test_polynomials_of_a_cam_file() -> None:
    """(x - 10)^2 up to 12, then from there with the same velocity."""
    text = (
        "CAM 1\nTYPE 0\nRANGE 10 14\nNAME P\nELEMENTS 2\n10 0 0 1 0 0 0\n12 4 4 1 0 0 0\nTAPPETS 0\nEND\n\n"
    )
    found = imported_cam(text, OTHER).cam
    assert [(p.x, p.y, p.v, p.a) for p in found.points] == [(10, 0, 0, 2), (12, 4, 4, 2), (14, 16, 8, 2)]


def test_a_cam_file_has_no_sines() -> None:
    cam = DEFAULT.model_copy(update={"segments": (CamSegment(), CamSegment(law="sine"), CamSegment())})
    with pytest.raises(NoCamFileError, match="behind X = 120 is of the type Sine"):
        written_file("Cam", cam)


HEAD = "CAM 1\nTYPE 3\nRANGE 0 2\nNAME N\n"


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "Line 1 of the text: there are no numbers"),
        ("0 0", "Line 1 of the text: a cam has at least two pairs"),
        ("x,y\n", "Line 1 of the text: a cam has at least two pairs"),
        ("0 0\n1 1\n1 2", "Line 3 of the text: 1 does not lie behind 1"),
        ("0 0\n\n2 1\n1 2", "Line 4 of the text: 1 does not lie behind 2"),
        ("0 0\n1 one", "Line 2 of the text: 'one' is no number"),
        ("0 0\n1 inf", "'inf' is no number"),
        ("0 0\n1 1_0", "'1_0' is no number"),
        ("0 0\n1 \N{ARABIC-INDIC DIGIT ONE}", "is no number"),
        ("0 0\n1 1e13", "Line 2 of the text: 1e13 is too large"),
        ("0 0\n1 1 1", "Line 2 of the text: 2 columns are expected, not 3"),
        ("0", "Line 1 of the text: 1 columns without a heading"),
        ("x,z\n0,0\n1,1", "Line 1 of the text: 'z' is no column"),
        ("x,x,y\n0,0,0\n", "'x' is no column"),
        ("x,v\n0,0\n1,1", "the columns x and y are missing"),
        ("x,y,law\n0,0,spline\n1,1,", "Line 2 of the text: 'spline' is no law"),
        ("x,y,law,inflection\n0,0,modified_sine,1\n1,1", "between 0 and 1"),
        ("0 0\n0.000001 1e12\n", "Line 1 of the text: the curve is too steep at X = 0"),
        ("CAM 2\n", "Line 1 of the text: version 2 is not known"),
        ("CAM 1\nTYPE 1\n", "Line 2 of the text: the type 1 is not read"),
        ("CAM 1\nTYPE x\n", "Line 2 of the text: 'x' is no whole number"),
        ("CAM 1\nTYPE 3\nRANGE 5 5", "Line 3 of the text: the end of the range"),
        ("CAM 1\nTYPE 3\nRANGE 5", "Line 3 of the text: 2 words are expected behind RANGE, not 1"),
        (HEAD + "POINTS 2", "Line 5 of the text: ELEMENTS is expected, not 'POINTS 2'"),
        (HEAD + "ELEMENTS 99999", "Line 5 of the text: ELEMENTS is at most 20000"),
        (HEAD + "ELEMENTS 2\n0 0 0 0", "Line 7 of the text: the file ends too early"),
        (HEAD + "ELEMENTS 1\n0 0 0 0\nTAPPETS 0\nEND", "a cam has at least two points"),
        (HEAD + "ELEMENTS 2\n0 0 0\n2 0 0 0", "Line 6 of the text: 4 numbers are expected, not 3"),
        (HEAD + "ELEMENTS 2\n0 0 0 0\n1 0 0 0\nTAPPETS 0\nEND", "the elements go from 0 to 1"),
        (HEAD + "ELEMENTS 2\n0 0 0 0\n0 1 0 0\nTAPPETS 0\nEND", "Line 7 of the text: the position jumps"),
        (HEAD + "ELEMENTS 2\n0 0 0 0\n-1 1 0 0\nTAPPETS 0\nEND", "Line 7 of the text: -1 does not lie"),
        (
            HEAD + "ELEMENTS 4\n0 0 0 0\n1 3 1 7\n1 3 5 0\n2 9 1 0\nTAPPETS 0\nEND",
            "Line 8 of the text: the velocity jumps at X = 1",
        ),
        (
            HEAD + "ELEMENTS 4\n0 0 0 0\n1 3 1 7\n1 3 1 0\n2 9 1 0\nTAPPETS 0\nEND",
            "Line 8 of the text: the acceleration jumps at X = 1",
        ),
        (
            HEAD + "ELEMENTS 2\n0 0 0 0\n2 0 0 0\nTAPPETS 1\n1 3 0 0 0 0\nEND",
            "Line 9 of the text: the tappet",
        ),
        (HEAD + "ELEMENTS 2\n0 0 0 0\n2 0 0 0\nTAPPETS 1\n1 1 0 3 0 9\nEND", "without times"),
        (HEAD + "ELEMENTS 2\n0 0 0 0\n2 0 0 0\nTAPPETS 1\n1 1 5 0 0 0\nEND", "direction"),
        (HEAD + "ELEMENTS 2\n0 0 0 0\n2 0 0 0\nTAPPETS 1\n.5 1 0 0 0 0\nEND", "a track is a whole number"),
        (HEAD + "ELEMENTS 2\n0 0 0 0\n2 0 0 0\nTAPPETS 0", "Line 9 of the text: the file ends too early"),
    ],
)
def test_foreign_texts_are_refused_by_their_line(text: str, message: str) -> None:
    with pytest.raises(CamTextError) as refusal:
        imported_cam(text, DEFAULT)
    assert message in str(refusal.value)


@quick
@given(text=st.text(max_size=60) | st.text("0123456789.,;eE+- \t\nCAMTYPE", max_size=80))
def test_no_text_does_harm(text: str) -> None:
    try:
        found = imported_cam(text, DEFAULT).cam
    except CamTextError:
        return
    CamTable.model_validate(found.model_dump())


@quick
@given(cam=cams(laws=POLYNOMIALS), data=st.data())
def test_damaged_cam_files_are_refused_or_read(cam: CamTable, data: st.DataObject) -> None:
    text = written_file("Cam", cam)
    at = data.draw(st.integers(0, len(text) - 1))
    damaged = text[:at] + data.draw(st.sampled_from(("", "9", "-", "\n", " ", "x"))) + text[at + 1 :]
    lines = range(1, damaged.count("\n") + 3)
    try:
        found = imported_cam(damaged, DEFAULT).cam
    except CamTextError as error:
        if error.line not in lines:
            pytest.fail(str(error))
        return
    CamTable.model_validate(found.model_dump())


def test_at_most_so_many_points() -> None:
    text = "".join(f"{n} 0\n" for n in range(10_001))
    with pytest.raises(CamTextError, match="Line 10001 of the text: a cam has at most 10000 points"):
        imported_cam(text, DEFAULT)

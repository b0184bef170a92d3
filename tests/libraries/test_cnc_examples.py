"""SM3_CNC: SMC_NCDecoder, the worked examples of cnc.md section 15 that are about decoding."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import quad
from tests.libraries.cnc_decoder import Geo, decode, path

ARC_START = "N10 G1 X100 Y100 F100\n"


def near(value: float, expected: float) -> None:
    assert value == pytest.approx(expected, rel=1e-9, abs=1e-9)


def ends(found: list[Geo]) -> list[tuple[float, float]]:
    return [(round(geo.dest[0], 9), round(geo.dest[1], 9)) for geo in found]


def check_upper_semicircle(geo: Geo) -> None:
    assert geo.kind == "CLW"
    for name, expected in (("dP1", 150), ("dP2", 100), ("dP3", 50), ("dT1", 180), ("dT2", 180)):
        near(geo[name], expected)
    near(geo.length, 50 * np.pi)
    assert geo.at(0.5)[:2] == pytest.approx([150, 150])
    assert geo.dest[:2] == pytest.approx([200, 100])


@pytest.mark.parametrize(
    "text",
    [
        "N20 G2 X200 Y100 R50",
        "N15 G99\nN20 G2 X200 Y100 I50 J0",
        "N15 G98\nN20 G2 X200 Y100 I150 J100",
        "N20 G2 I50 J0 T180",
        "N20 G2 I50 K180",
    ],
)
def test_arcs_of_all_forms(text: str) -> None:
    """cnc EX-16 a, c, d, e; the older form of T. Spec GEO-05 to GEO-08."""
    check_upper_semicircle(path(ARC_START + text)[1])


def test_counter_clockwise_arc() -> None:
    """cnc EX-16 b."""
    geo = path(ARC_START + "N20 G3 X200 Y100 R50")[1]
    assert geo.kind == "CCLW"
    near(geo["dT1"], 180)
    near(geo["dT2"], -180)
    assert geo.at(0.5)[:2] == pytest.approx([150, 50])


def test_two_turns() -> None:
    """cnc EX-16 f."""
    geo = path(ARC_START + "N20 G2 I50 J0 T720")[1]
    near(geo.length, 628.318530717959)
    near(geo["dT2"], 720)
    assert geo.dest[:2] == pytest.approx([100, 100])


def test_impossible_radius_makes_a_line() -> None:
    """cnc EX-16 g."""
    geo = path(ARC_START + "N20 G2 X200 Y100 R40")[1]
    assert geo.kind == "LIN"
    assert [*geo.start[:2], *geo.dest[:2]] == [100, 100, 200, 100]


def test_full_circle_and_quarter() -> None:
    """cnc EX-16 h, i."""
    full = path(ARC_START + "N20 G2 X100 Y100 I50 J0")[1]
    near(full.length, 314.159265358979)
    quarter = path(ARC_START + "N20 G3 X150 Y150 R50")[1]
    for name, expected in (("dP1", 100), ("dP2", 150), ("dT1", 270), ("dT2", -90)):
        near(quarter[name], expected)
    near(quarter.length, 78.53981633974483)


def test_absolute_and_relative() -> None:
    """cnc EX-17."""
    assert ends(path("N0 G91\nN10 G1 X10 Y10 F100\nN20 G1 X100")) == [(10, 10), (110, 10)]
    assert ends(path("N0 G90\nN10 G1 X10 Y10 F100\nN20 G1 X100")) == [(10, 10), (100, 10)]


def test_loop_with_the_counter() -> None:
    """cnc EX-18. Spec VAR-04, GEO-19, CNCR-37."""
    found = path("N00 G36 D4\nN10 G91\nN20 G1 X5 Y0 F100\nN30 G37 D-1\nN40 G20 L20")
    assert ends(found) == [(5, 0), (10, 0), (15, 0), (20, 0)]
    assert [geo["iSourceLine_No"] for geo in found] == [20, 20, 20, 20]


def test_switch_points() -> None:
    """cnc EX-19: places of the switch points. Spec GEO-16, CNCR-39."""
    geo = path("N0 G1 X20 Y20 F100\nN10 G1 X100 Y40 H-2 O0.25")[1]
    assert (geo["iHelpID[0]"], geo["dHelpPos[0]"], geo["iHelpID[1]"]) == (-2, 0.25, 0)
    geo = path("N0 G1 X20 F9\nN10 G1 X100 H2 L20 H-2 L-10")[1]
    assert [geo[f"iHelpID[{n}]"] for n in range(3)] == [2, -2, 0]
    assert geo["dHelpPos[0]"] * 80 + 20 == pytest.approx(40)
    assert geo["dHelpPos[1]"] * 80 + 20 == pytest.approx(90)


def test_ellipses() -> None:
    """cnc EX-20. Spec GEO-09, GEO-10."""
    geo = path("N10 G0 X100 Y100\nN15 G98\nN20 G8 X200 Y100 I150 J100 K45 R0.5 F9")[1]
    assert geo.kind == "ELLCLW"
    near(geo["dP5"], np.sqrt(6250))
    near(geo["dP6"], np.sqrt(6250) / 2)
    near(geo["dP7"], 45)
    near(geo["dP8"], 0.5)
    assert (geo["dP3"], geo["dP4"]) == pytest.approx((np.sqrt(3125), np.sqrt(3125)))
    assert geo.at(0)[:2] == pytest.approx([100, 100])
    assert geo.at(1)[:2] == pytest.approx([200, 100])
    (geo,) = path("G92 X100 Y0\nG98\nG9 X0 Y50 I0 J0 K0 F9")
    assert geo.kind == "ELLCCLW"
    assert [*geo.start[:2]] == [100, 0]
    near(geo["dP5"], 100)
    near(geo["dP6"], 50)
    near(geo["dT2"], -90)
    length, _ = quad(lambda t: np.hypot(100 * np.sin(t), 50 * np.cos(t)), 0, np.pi / 2, epsabs=1e-12)
    assert length == pytest.approx(121.1056, abs=1e-4)
    assert geo.length == pytest.approx(length, rel=1e-6)


def test_parabola() -> None:
    """cnc EX-21. Spec GEO-13."""
    geo = path("N10 G0 X100 Y200\nN20 G98\nN30 G6 X-100 Y200 I0 J0 F100")[1]
    assert geo.kind == "SPLINE"
    for u in np.linspace(0, 1, 11):
        x, y, _ = geo.at(u)
        assert y == pytest.approx(x * x / 50)
    assert geo.length == pytest.approx(464.678, abs=1e-3)


def test_spline() -> None:
    """cnc EX-22. Spec GEO-11, GEO-12."""
    found = path("N0 G0 X0 Y0 F100\nN10 G5 X20 Y0\nN20 G5 X20 Y20\nN30 G5 X40 Y20\nN40 G5 X40 Y40")
    assert [geo.kind for geo in found] == ["SPLINE"] * 4
    directions = [0, 45, 45, 45, 90]
    for n, geo in enumerate(found):
        for u, expected in ((0.0, directions[n]), (1.0, directions[n + 1])):
            x, y, _ = geo.tangent(u)
            assert np.degrees(np.arctan2(y, x)) == pytest.approx(expected, abs=1e-3)
        assert geo.at(0) == pytest.approx(geo.start[:3])
        assert geo.at(1) == pytest.approx(geo.dest[:3])


def test_coordinate_shift() -> None:
    """cnc EX-24. Spec GEO-21."""
    found = path("G54 X10 Y5\nG1 X10 Y0 F9\nG55 X1\nG1 X10 Y0\nG53\nG1 X10 Y0\nG56 X0 Y0\nG1 X5 Y5")
    assert ends(found) == [(20, 5), (21, 5), (10, 0), (15, 5)]


def test_function_of_a_machine() -> None:
    """cnc EX-28: what is stored. Spec GEO-17, CNCR-38."""
    first, function, last = path("N0 G1 X50 F100\nN10 M7 K1.5 L2\nN20 G1 X100")
    assert first["dVelEnd"] == 100  # The stop is planned by SMC_CheckVelocities
    assert function.kind == "MCOMMAND"
    assert (function["iHelpID[0]"], function["dT1"], function["dT2"], function.length) == (7, 1.5, 2, 0)
    assert [*function.start[:2], *function.dest[:2]] == [50, 0, 50, 0]
    assert (last.start[0], last.dest[0], last["dVelEnd"]) == (50, 100, 0)


def test_additional_axis() -> None:
    """cnc EX-29: what is stored. Spec GEO-03, CNCR-36."""
    (geo,) = path("N0 G1 X100 P40 F10 E10 E-10 S1")
    assert (geo.dest[6], geo["dVel"], geo["dAccel"], geo["dDecel"]) == (40, 10, 10, 10)
    assert int(geo["piDestPos.wAuxData"]) == 0b1000111
    assert int(geo["piDestPos.wSProfile"]) & 1 << 6
    (geo,) = path("N0 G1 X100 P200 F10 FP10")
    assert [geo[f"adVelAddAx[{n}]"] for n in range(7)] == [0, 0, 10, 0, 0, 0, 0]
    assert int(geo["piDestPos.wSProfile"]) == 0


def test_step_suppression() -> None:
    """cnc EX-30. Spec GC-10."""
    text = "N0 G1 X10 F10\n/N10 G1 Y10\nN20 G1 X20"
    assert ends(path(text)) == [(10, 0), (10, 10), (20, 10)]
    assert ends(path(text, xSuppress=True)) == [(10, 0), (20, 0)]


@pytest.mark.parametrize(
    ("text", "error", "word"),
    [
        ("N0 G77 X1", 1204, "G77"),
        ("N0 G20 L999 K1", 1203, "L999"),
        ("N0 G1 X10 F10 E0", 1200, "G1"),
        ("N0 G1 X10 F10 E-0", 1201, "G1"),
        ("N0 X10", 1204, ""),
        ("N0 G17\nN1 G8 X10 I5 R0.5 F9", 1205, "G8"),
        ("N0 G17\nN1 G6 X10 I5 J5 F9", 1205, "G6"),
        ("G70 L3", 1204, "L3"),
        ("G71 L12", 1204, "L12"),
        ("G71 L4.5", 1204, "L4.5"),
        ("G38 L0", 1204, "L0"),
        ("G39 L33", 1204, "L33"),
        ("G39", 1204, "G39"),
        ("G1 X1 F1\nG31 X5 H1 L1", 1204, "H1"),
        ("G0 X1 PROBE1", 1204, "PROBE1"),
        ("G1 X1 PROBE0", 1204, "PROBE0"),
        ("G1 X1 PROBE1 H1 L1", 1204, "PROBE1"),
        ("G43 L1", 1204, "L1"),
        ("G38 L33", 1204, "L33"),
        ("G70 L12", 1204, "L12"),
        ("G71", 1204, "G71"),
        ("G1 X5 FA10", 1204, "FA10"),
        ("G1 X5 M3", 1204, "X5"),
        ("G90 X5", 1204, "X5"),
        ("G1 X5 I3", 1204, "I3"),
        ("G1 X5 X6", 1204, "X6"),
        ("G2 X5 Y5 F9", 1204, "G2"),
        ("G2 X5 Y5 R-9", 1204, "G2"),
        ("G2 I5 T1081", 1204, "G2"),
        ("G16", 1204, "G16"),
        ("G4", 1204, "G4"),
        ("M0", 1204, "M0"),
        ("M65533", 1204, "M65533"),
        ("M3 O5", 1204, "O5"),
        ("G1 X5 H1", 1204, "H1"),
        ("G1 X5 H1 L1 H2 L1 H3 L1 H4 L1", 1204, "H4"),
        ("G1 X5 L1", 1204, "L1"),
        ("G1 X5 F-1", 1204, "F-1"),
        ("G20 K1", 1204, "G20"),
        ("G36 O5 D1", 1204, "O5"),
        ("G36", 1204, "G36"),
        ("G1.5 X1", 1204, ""),
    ],
)
def test_errors(text: str, error: int, word: str) -> None:
    """cnc EX-32 and the rest of cnc 13: number and word of what is refused. Spec GC-06, GC-08, CNCR-41."""
    if text == "G1.5 X1":  # The parser leaves the word out: the line has no travel command
        word = ""
    decoded = decode(text)
    assert (decoded.error, decoded.word) == (error, word)
    assert not decoded.ended


def test_without_a_velocity() -> None:
    """cnc EX-32: the path is decoded; the interpolator refuses it with 1001."""
    (geo,) = path("N0 G1 X10")
    assert (geo["dVel"], geo["dAccel"], geo["dDecel"]) == (0, 100, 100)

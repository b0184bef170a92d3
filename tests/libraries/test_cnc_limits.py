"""SM3_CNC: limits of velocity and range, moved paths, refused inputs. Spec cnc_runtime 5.1, 5.6."""

from __future__ import annotations

import math

import numpy as np
import pytest
from tests.libraries.cnc_chain import (
    CORNERS_OFF,
    SMOOTH,
    Block,
    length_of,
    polyline,
    switches,
    through,
)
from tests.libraries.cnc_paths import Geo, arc, line, path, position
from tests.libraries.st_program import run


@pytest.mark.parametrize(
    ("objects", "vel_end"),
    [
        ([line(position(0, 0), position(10, 0)), arc((10, 25), 25, 270, -90)], 50),
        ([arc((0, 25), 25, 270, -90), line(position(25, 25), position(25, 60))], 50),
        ([arc((0, 0), 25, 180, 180), arc((50, 0), 25, 180, -180)], 35.355339),
        ([arc((0, 0), 25, 270, -90), arc((-25, 0), 50, 0, -90)], 70.710678),
    ],
)
def test_velocities_at_arcs(objects: list[Geo], vel_end: float) -> None:
    """cnc_runtime EX-16. Spec CNCR-100."""
    for geo in objects:
        geo.members |= {"dVel": 1000.0, "dVelEnd": 1000.0}
    limited = through(objects, Block("SMC_LimitCircularVelocity", "dMaxAccJump := 100"))
    assert limited.objects[0].member("dVelEnd") == pytest.approx(vel_end, abs=1e-6)
    assert limited.byte == 11
    free = through(objects, Block("SMC_LimitCircularVelocity"))
    assert [geo.member("dVelEnd") for geo in free.objects] == [1000, 1000]


def test_the_velocity_on_an_arc() -> None:
    """cnc_runtime EX-16: also on the only object of a path."""
    objects = [arc((0, 25), 25, 270, -90, dVel=1000, dVelEnd=1000)]
    found = through(objects, Block("SMC_LimitCircularVelocity", "dMaxAcc := 400")).objects
    assert found[0].member("dVel") == pytest.approx(100)


def test_limits_of_the_program() -> None:
    """cnc_runtime EX-16, cnc EX-29. Spec CNCR-101, GEO-22; in an S shape 1.875 times as fast."""
    objects = [line(position(0, 0), position(100, 0), dVel=50, dVelEnd=50) for _ in range(2)]
    for geo in objects:
        geo.end[6] = 50
        geo.members |= {"adVelAddAx[2]": 10.0, "adAccAddAx[2]": 20.0, "adDecAddAx[2]": 30.0}
    objects[1].members["piStartPos.wSProfile"] = 64
    linear, s_shaped = through(objects, Block("SMC_ExtendedVelocityChecks")).objects
    assert [linear.member(name) for name in ("dVel", "dAccel", "dDecel")] == [20, 40, 60]
    assert s_shaped.member("dVel") == pytest.approx(20 / 1.875)
    assert [s_shaped.member(name) for name in ("dAccel", "dDecel")] == [100, 100]


def test_limits_of_the_inputs() -> None:
    """cnc_runtime EX-16. Spec CNCR-102: in 3D mode Z belongs to the path."""
    flat = line(position(0, 0, 0), position(100, 0, 20, dA3=50), dVel=100, dVelEnd=100)
    space = line(position(0, 0, 0), position(100, 0, 75), dVel=100, dVelEnd=100)
    space.space = True
    block = Block(
        "SMC_LimitAddAxisDynamics", "wAddAxis := 16#104, dMaxVel := 10, dMaxAcc := 10, dMaxDec := 5"
    )
    found = through([flat, space], block).objects
    assert [found[0].member(name) for name in ("dVel", "dAccel", "dDecel")] == [20, 20, 10]
    assert [found[1].member(name) for name in ("dVel", "dAccel", "dDecel")] == [100, 100, 100]


def test_turned_shifted_and_stretched() -> None:
    """Spec CNCR-50, CNCR-51, CNCR-53: examples of the blocks."""
    objects = [line(position(0, 0, 0), position(10, 0, 0)), arc((5, 0), 5, 180, 180)]
    turned = through(objects, Block("SMC_RotateQueue2D", "dPhi := 90"))
    assert turned.byte == 30
    np.testing.assert_allclose(turned.objects[0].end[:2], (0, 10), atol=1e-12)
    found = [turned.objects[1].member(name) for name in ("dP1", "dP2", "dT1")]
    np.testing.assert_allclose(found, (0, 5, 270), atol=1e-12)
    shifted = through(objects, Block("SMC_TranslateQueue3D", "vec := vec"), vec=(1, 2, 3))
    assert shifted.byte == 32
    assert tuple(shifted.objects[0].start[:3]) + tuple(shifted.objects[0].end[:3]) == (1, 2, 3, 11, 2, 3)
    stretched = through(objects, Block("SMC_ScaleQueue3D", "dScaleFactor := 2"))
    assert stretched.byte == 31
    assert [stretched.objects[1].member(name) for name in ("dP1", "dP3")] == [10, 10]
    assert length_of(stretched.objects[1]) == pytest.approx(31.415927, abs=1e-6)


BAD_INPUTS = [
    ("SMC_ScaleQueue3D", "dScaleFactor := 0"),
    ("SMC_ScaleQueue3D", "dScaleFactor := -1"),
    ("SMC_ScaleQueue3D", "dScaleFactor := SQRT(-1.0)"),
    ("SMC_RotateQueue2D", "dPhi := SQRT(-1.0)"),
    ("SMC_TranslateQueue3D", "vec := vec"),
    ("SMC_SmoothPath", "dEdgeDistance := SQRT(-1.0)"),
    ("SMC_SmoothPath", "dEdgeDistance := -1"),
    ("SMC_RoundPath", "dRadius := SQRT(-1.0)"),
    ("SMC_ToolCorr", "dToolRadius := SQRT(-1.0)"),
    ("SMC_LimitCircularVelocity", "dMaxAcc := SQRT(-1.0)"),
    ("SMC_ObjectSplitter", "dMaxLength := SQRT(-1.0)"),
]


@pytest.mark.parametrize(("name", "inputs"), BAD_INPUTS)
def test_inputs_that_are_none_are_refused(name: str, inputs: str) -> None:
    """Spec CNCR-53: an error and no output."""
    result = through(polyline((0, 0), (10, 0), (10, 10)), Block(name, inputs), vec=(math.nan, 0, 0))
    assert result.error == 10021
    assert result.objects == []


@pytest.mark.parametrize("piece", [(30.0, 20.0), (30.0, 20.0, 130.0), (0.0, 40.0, 15.0, -140.0)])
def test_dynamics_of_the_axes_of_the_path(piece: tuple[float, ...]) -> None:
    """SMC_LimitDynamics: X and Y keep their limits at every place, also on ramps."""
    geo = path([piece], dVel=1000.0, dVelEnd=1000.0, dAccel=10000.0, dDecel=10000.0)[0]
    block = Block("SMC_LimitDynamics", "wAxis := 3, dMaxVel := 12, dMaxAcc := 50, dMaxDec := 40")
    found = through([geo], block).objects[0]
    velocity, speed_up, brake = (found.member(name) for name in ("dVel", "dAccel", "dDecel"))
    largest = {"v": 0.0, "a": 0.0, "d": 0.0}
    h = 1e-4
    for u in np.linspace(0, 1, 721):
        slope = geo.slope(u)
        speed = np.linalg.norm(slope)
        tangent = slope[:2] / speed
        after, before = geo.slope(u + h), geo.slope(u - h)
        bend = (after / np.linalg.norm(after) - before / np.linalg.norm(before))[:2] / (2 * h * speed)
        largest["v"] = max(largest["v"], float(np.abs(velocity * tangent).max()))
        for name, value in (("a", speed_up), ("d", brake)):
            for sign in (1, -1):
                total = np.abs(sign * value * tangent + velocity**2 * bend).max()
                largest[name] = max(largest[name], float(total))
    assert largest["v"] <= 12 * (1 + 1e-9)
    assert largest["a"] <= 50 * (1 + 1e-5)
    assert largest["d"] <= 40 * (1 + 1e-5)
    assert largest["d"] > 20, "no more than what the limits ask for"


@pytest.mark.parametrize(
    ("degrees", "expected"), [(90, 10 / math.sqrt(2)), (60, 10.0), (180, 5.0), (4, 100.0)]
)
def test_the_velocity_at_a_corner(degrees: float, expected: float) -> None:
    """SMC_ReduceVelEndAtCorner: the velocity jumps by 10 at most; 4 degrees are below its angle."""
    end = (10 + 10 * math.cos(math.radians(degrees)), 10 * math.sin(math.radians(degrees)))
    objects = polyline((0, 0), (10, 0), end)
    found = through(objects, Block("SMC_ReduceVelEndAtCorner", "dAngle := 5, dMaxVelJump := 10")).objects
    assert found[0].member("dVelEnd") == pytest.approx(expected)


def test_long_objects_are_split() -> None:
    """SMC_ObjectSplitter: three parts; a switch point lies on one of them, marks on one end each."""
    objects = polyline((0, 0), (20, 0), marks={0: SMOOTH | CORNERS_OFF})
    objects[0].members |= {"dHelpPos[0]": 0.5, "iHelpID[0]": 3}
    found = through(objects, Block("SMC_ObjectSplitter", "dMaxLength := 7")).objects
    assert [length_of(geo) for geo in found] == pytest.approx([20 / 3] * 3)
    assert [switches(geo) for geo in found] == [{}, {3: pytest.approx(0.5)}, {}]
    assert [geo.member("byInternMark") for geo in found] == [SMOOTH, 0, CORNERS_OFF]


LIMITS = """
PROGRAM Main
VAR
    a : ARRAY[0..2] OF SM3_CNC.SMC_GEOINFO;
    queue : SM3_CNC.SMC_OUTQUEUE;
    aBuffer : ARRAY[1..10] OF SM3_CNC.SMC_GEOINFO;
    check : SM3_CNC.SMC_CheckForLimits := (wAddAxis := 3);
    n : DINT;
    xBegun, xSame : BOOL;
END_VAR
IF NOT xBegun THEN
    queue.pbyBuffer := ADR(aBuffer);
    SM3_CNC.SMC_SetQueueCapacity(ADR(queue), SIZEOF(aBuffer));
    check.piMax.dX := 100;
    check.piMax.dY := 50;
    xBegun := TRUE;
END_IF
IF n <= 2 THEN
    SM3_CNC.SMC_CalcLengthGeo(ADR(a[n]));
    SM3_CNC.SMC_AppendObj(ADR(queue), ADR(a[n]));
    n := n + 1;
END_IF
check(bExecute := TRUE, poqDataIn := ADR(queue));
xSame := check.poqDataOut = ADR(queue) AND SM3_CNC.SMC_GetCount(ADR(queue)) = n;
END_PROGRAM
"""


@pytest.mark.parametrize(
    ("second", "positive", "negative"),
    [
        (arc((50, 50), 10, 180, 180), 2, 0),
        (arc((50, 50), 10, 180, -180), 0, 0),
        (arc((10, 40), 20, 90, -180), 2, 1),
        (line(position(40, 50), position(60, 50)), 0, 0),
        (line(position(40, 50), position(-1, 51)), 2, 1),
    ],
)
def test_the_box_of_a_path(second: Geo, positive: int, negative: int) -> None:
    """cnc_runtime EX-16. Spec CNCR-103, CNCR-26: the apex counts, a limit is inside, the path stays."""
    second.members["iSourceLine_No"] = 20.0
    objects = [line(position(0, 0), position(40, 50)), second, line(position(), position())]
    with run(LIMITS, cycles=0) as program:
        for n, geo in enumerate(objects):
            program.set("Main", **{f"a[{n}].{name}": value for name, value in geo.values().items()})
        for _ in range(4):
            program.cycle()
        found = [int(program.literal(f"Main.check.{pin}")) for pin in PINS]
        assert program.literal("Main.xSame") == "TRUE"
    out = positive | negative
    assert found == [out, 20 if out else 0, positive, negative]


PINS = ("wAxisOutOfLimits", "iSourceLine_No", "wLimitSwPositive", "wLimitSwNegative")


HANDSHAKE = [
    *("SMC_TranslateQueue3D", "SMC_RotateQueue2D", "SMC_ScaleQueue3D", "SMC_ToolCorr", "SMC_ToolRadiusCorr"),
    *("SMC_AvoidLoop", "SMC_SmoothPath", "SMC_RoundPath", "SMC_LimitCircularVelocity", "SMC_LimitDynamics"),
    *("SMC_ExtendedVelocityChecks", "SMC_LimitAddAxisDynamics", "SMC_ObjectSplitter"),
    *("SMC_ReduceVelEndAtCorner", "SMC_CheckForLimits"),
]


def test_what_is_no_queue_is_refused_and_no_queue_waited_for() -> None:
    """Spec CNCR-14, CNCR-25: every block, error 1501; with 0 it waits; without bExecute the error is gone."""
    blocks = "".join(f"    f{n} : SM3_CNC.{name};\n" for n, name in enumerate(HANDSHAKE))
    calls = ""
    for n, name in enumerate(HANDSHAKE):
        buffer = (
            ""
            if name == "SMC_CheckForLimits"
            else ", nSizeOutQueue := SIZEOF(aBuffer), pbyBufferOutQueue := ADR(aBuffer)"
        )
        calls += f"f{n}(bExecute := xExecute, poqDataIn := pIn{buffer}); a[{n}] := f{n}.wErrorID;\n"
    text = f"""
PROGRAM Main
VAR
{blocks}    aBuffer : ARRAY[1..6] OF SM3_CNC.SMC_GEOINFO;
    other : SM3_CNC.SMC_OUTQUEUE := (wOUTQUEUEStructID := 1);
    pIn : POINTER TO SM3_CNC.SMC_OUTQUEUE;
    xGiven, xExecute : BOOL;
    a : ARRAY[0..{len(HANDSHAKE) - 1}] OF INT;
END_VAR
pIn := 0;
IF xGiven THEN
    pIn := ADR(other);
END_IF
{calls}
END_PROGRAM
"""
    with run(text, cycles=0) as program:
        for given, execute, error in ((False, True, 0), (True, True, 1501), (True, False, 0)):
            program.set("Main", xGiven=given, xExecute=execute)
            program.cycle()
            assert program.numbers("Main.a") == [error] * len(HANDSHAKE)

"""SMC_CAMBounds and SMC_CAMBounds_Pos against the roots that numpy finds, and against sampling."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tests.libraries.cam_curves import XYVA, Numbers
from tests.libraries.st_program import Program, run

POINTS = 30
OUTPUTS = ("dMinPos", "dMaxPos", "dMinVel", "dMaxVel", "dMinAccDec", "dMaxAccDec")
PROGRAM = f"""
PROGRAM Main
VAR
    aPoints  : ARRAY[0..{POINTS - 1}] OF SM3_Basic.SMC_CAMXYVA;
    aElement : ARRAY[0..0] OF SM3_Basic.SMC_CAMElement := [(aC := [1, 2, 3, 0, 0, 0])];
    Cam      : SM3_Basic.MC_CAM_REF := (byType := 3, pce := ADR(aPoints));
    Powers   : SM3_Basic.MC_CAM_REF := (nElements := 1, xStart := 0, xEnd := 2, pce := ADR(aElement));
    All      : SM3_Basic.SMC_CAMBounds;
    Places   : SM3_Basic.SMC_CAMBounds_Pos;
    xPowers  : BOOL;
END_VAR
IF xPowers THEN
    All(CAM := Powers);
    Places(CAM := Powers);
ELSE
    All(CAM := Cam);
    Places(CAM := Cam);
END_IF
END_PROGRAM
"""


@pytest.fixture(scope="module")
def program() -> Iterator[Program]:
    with run(PROGRAM, cycles=1) as found:
        yield found


def _bounds(program: Program, block: str, points: Numbers, **inputs: float) -> tuple[Numbers, int]:
    """The outputs, and the calls that they took."""
    for index, point in enumerate(points):
        program.set(
            f"Main.aPoints[{index}]", **dict(zip(("dX", "dY", "dV", "dA"), map(float, point), strict=True))
        )
    program.set("Main.Cam", byType=XYVA, nElements=len(points), xStart=points[0, 0], xEnd=points[-1, 0])
    program.set(f"Main.{block}", bExecute=False)
    program.cycle()
    program.set(f"Main.{block}", bExecute=True, **inputs)
    program.cycle()
    calls = 1
    while program.literal(f"Main.{block}.bBusy") == "TRUE":
        program.cycle()
        calls += 1
    assert program.literal(f"Main.{block}.bDone") == "TRUE"
    return np.array([float(program.literal(f"Main.{block}.{name}")) for name in OUTPUTS]), calls


def test_a_straight_cam(program: Program) -> None:
    """The examples of both catalogs; ax3000 EX-AX-19."""
    line = np.array([(0, 0, 2, 0), (360, 720, 2, 0)], dtype=float)
    found, _ = _bounds(program, "All", line, dMasterVelMax=1.0, dMasterAccMax=0.0)
    np.testing.assert_allclose(found, (0, 720, -2, 2, 0, 0), atol=1e-12)
    found, _ = _bounds(program, "All", line, dMasterVelMax=100.0, dMasterAccMax=10.0)
    np.testing.assert_allclose(found, (0, 720, -200, 200, -20, 20), atol=1e-9)
    found, _ = _bounds(program, "Places", line)
    np.testing.assert_allclose(found, (0, 720, 0, 0, 0, 0), atol=1e-12)


@settings(max_examples=80, deadline=None)
@given(
    seed=st.integers(0, 2**32 - 1),
    count=st.integers(2, POINTS),
    master=st.sampled_from((1.0, -2.5, 0.3)),
    slave=st.sampled_from((1.0, -3.0, 0.1)),
)
def test_random_cams(program: Program, seed: int, count: int, master: float, slave: float) -> None:
    """Extremes where numpy's roots of the derivatives are, and no sample beyond them."""
    from scipy.interpolate import BPoly, PPoly

    random = np.random.default_rng(seed)
    points = random.uniform(-1, 1, (count, 4))
    points[:, 0] = np.cumsum(random.uniform(0.5, 2.0, count))
    fastest, steepest = random.uniform(0, 5, 2)
    inputs = {"dMasterVelMax": fastest, "dMasterAccMax": steepest}
    inputs |= {"dMasterScaling": master, "dSlaveScaling": slave}
    found, calls = _bounds(program, "All", points, **inputs)
    assert calls == 1 + (count - 1 + 7) // 8
    y = PPoly.from_bernstein_basis(BPoly.from_derivatives(points[:, 0], points[:, 1:]))
    v, a = abs(master) * fastest, abs(master) * steepest

    def extremes(*curves: PPoly) -> tuple[float, float]:
        values: list[float] = []
        for curve in curves:
            roots = curve.derivative().roots(extrapolate=False)
            at = np.concatenate([points[:, 0], roots[np.isfinite(roots)]])
            values += [*curve(at), *(curve(points[1:, 0] * (1 - 1e-15)))]
        return min(values), max(values)

    def scaled(curve: PPoly, factor: float) -> PPoly:
        return PPoly(curve.c * factor, curve.x)

    def summed(one: PPoly, other: PPoly) -> PPoly:
        rows = max(len(one.c), len(other.c))
        pad = [np.pad(p.c, ((rows - len(p.c), 0), (0, 0))) for p in (one, other)]
        return PPoly(pad[0] + pad[1], one.x)

    slope, bend = scaled(y.derivative(), slave), scaled(y.derivative(2), slave)
    signs = (scaled(slope, a), scaled(slope, -a))
    expected = [
        *extremes(scaled(y, slave)),
        *extremes(scaled(slope, v), scaled(slope, -v)),
        *extremes(*signs, *(summed(scaled(bend, v * v), sign) for sign in signs)),
    ]
    size = np.abs(expected).max() + 1.0
    np.testing.assert_allclose(found, expected, rtol=0, atol=1e-8 * size)
    places, _ = _bounds(program, "Places", points, dMasterScaling=master, dSlaveScaling=slave)
    np.testing.assert_allclose(places, [*found[:2], 0, 0, 0, 0], rtol=0, atol=1e-12 * size)


def test_polynomials(program: Program) -> None:
    """1 + 2 x + 3 x^2 from 0 to 2."""
    program.set("Main", xPowers=True)
    program.set("Main.All", bExecute=False)
    program.cycle()
    program.set(
        "Main.All", bExecute=True, dMasterVelMax=1.0, dMasterAccMax=0.0, dMasterScaling=1.0, dSlaveScaling=1.0
    )
    for _ in range(3):
        program.cycle()
    found = [float(program.literal(f"Main.All.{name}")) for name in OUTPUTS]
    program.set("Main", xPowers=False)
    np.testing.assert_allclose(found, (1, 17, -14, 14, 0, 6), atol=1e-12)


@pytest.mark.parametrize(
    ("members", "error"),
    [
        ({"byType": 1, "byVarType": 6}, "SMC_CB_NOT_IMPLEMENTED"),
        ({"byType": 2, "byVarType": 6}, "SMC_CB_NOT_IMPLEMENTED"),
        ({"wCamStructID": 0}, "SMC_NO_CAM_REF_TYPE"),
    ],
)
@pytest.mark.parametrize("block", ["All", "Places"])
def test_cams_without_bounds(program: Program, block: str, members: dict[str, float], error: str) -> None:
    """Spec motion_semantics CAM-15."""
    _bounds(program, block, np.array([(0, 0, 2, 0), (360, 720, 2, 0)], dtype=float))
    program.set(f"Main.{block}", bExecute=False)
    program.set("Main.Cam", **members)
    program.cycle()
    program.set(f"Main.{block}", bExecute=True)
    program.cycle()
    program.set("Main.Cam", wCamStructID=0xDC34)
    assert [program.literal(f"Main.{block}.{name}") for name in ("bDone", "bBusy", "bError", "nErrorID")] == [
        "FALSE",
        "FALSE",
        "TRUE",
        error,
    ]

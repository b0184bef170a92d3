"""Paths as the editor and the compiler get them, against the specification's examples and closed forms."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tappet.motion.path_blocks import path_blocks
from tappet.motion.path_program_text import RING, WINDOW
from tappet.motion.path_service import PathService, PathSettingsError
from tappet.project.cnc.program import CncProgramData
from tappet.project.cnc.settings import CncSettingsData

PLAIN = CncSettingsData()
LIN, SPLINE = 1, 5


@pytest.fixture(scope="module")
def service() -> Iterator[PathService]:
    found = PathService()
    yield found
    found.close()


def program(text: str, **data: Any) -> CncProgramData:
    return CncProgramData.model_validate({"implementation": text, **data})


def chain(*blocks: tuple[str, dict[str, str]], **data: Any) -> CncSettingsData:
    rows = [
        {"block": name, "parameters": [{"name": pin, "value": value} for pin, value in pins.items()]}
        for name, pins in blocks
    ]
    return CncSettingsData.model_validate({"preprocessing": rows, **data})


@pytest.mark.parametrize(
    ("text", "seconds"),
    [
        ("N0 G1 X100 F10 E10 E-10", 11.0),
        ("G1 X50 F10 E10 E-10\nG1 X100", 11.0),
        ("G1 X50 F10 E10 E-10\nG1 Y50", 12.0),
        ("G1 X50 F10 E10 E-10\nG1 X100 F20", 9.25),
        ("G1 X10 F100 E10 E-10", 2.0),
    ],
)
def test_durations_are_those_of_the_examples(service: PathService, text: str, seconds: float) -> None:
    """cnc EX-01, EX-23: the trapezoid in closed form, to a cycle for each stop."""
    motion = service.interpolated(program(text), PLAIN)
    assert motion.fault is None
    assert motion.duration_s == pytest.approx(seconds, abs=2 * motion.interval_s)
    finer = service.interpolated(program(text), chain(interpolation_time_us=1000))
    assert finer.duration_s == pytest.approx(seconds, abs=2e-3)


def test_the_first_example_says_what_the_dialog_shows(service: PathService) -> None:
    """CNC-20, cnc EX-01: one object of length 100, 11.0 s; the end is the program's."""
    data = program("N0 G1 X100 F10 E10 E-10")
    path = service.objects_of(data)
    assert (len(path.rows), path.length, path.fault) == (1, 100.0, None)
    motion = service.interpolated(data, PLAIN)
    assert motion.positions[-1].tolist() == [100.0, *[0.0] * 10]
    assert motion.duration_s == pytest.approx(11.0, abs=1e-9)


def test_preprocessing_runs_the_blocks_of_the_settings(service: PathService) -> None:
    """CNCS-03, cnc EX-12: corners at distance 2 become splines; the original path stays as it is."""
    text = "N0 G1 X10 Y0 F100\nN10 G51 D2\nN20 G1 X10 Y20\nN30 G1 X20 Y20\nN40 G1 X20 Y0\nN50 G50\nN60 G1 X30"
    data = program(text)
    assert service.objects_of(data).rows["iMoveType"].tolist() == [LIN] * 5
    smooth = service.preprocessed(data, chain(("SMC_SmoothPath", {})))
    assert smooth.rows["iMoveType"].tolist() == [LIN, LIN, SPLINE, LIN, SPLINE, LIN, LIN]
    ends = np.column_stack([smooth.rows["piDestPos.dX"], smooth.rows["piDestPos.dY"]])
    np.testing.assert_allclose(ends, [(10, 0), (10, 18), (12, 20), (18, 20), (20, 18), (20, 0), (30, 0)])
    assert (smooth.lines[0], smooth.lines[-1]) == (0, 6)
    assert (np.diff(smooth.lines) >= 0).all()


def test_parameters_and_the_order_of_blocks_count(service: PathService) -> None:
    """CNCS-06, CNCS-09: moved then scaled is elsewhere than scaled then moved."""
    data = program("G1 X10 F10")
    move = ("SMC_TranslateQueue3D", {"vec.dX": "5", "vec.dY": "1e1"})
    scale = ("SMC_ScaleQueue3D", {"dScaleFactor": "2"})
    first = service.preprocessed(data, chain(move, scale)).rows
    second = service.preprocessed(data, chain(scale, move)).rows
    assert (first["piDestPos.dX"][-1], first["piDestPos.dY"][-1]) == (30.0, 20.0)
    assert (second["piDestPos.dX"][-1], second["piDestPos.dY"][-1]) == (25.0, 10.0)


def test_a_chain_that_the_library_does_not_have_is_refused(service: PathService) -> None:
    with pytest.raises(PathSettingsError, match="SMC_Nothing"):
        service.preprocessed(program("G1 X1 F1"), chain(("SMC_Nothing", {})))
    with pytest.raises(PathSettingsError, match="dNothing"):
        service.preprocessed(program("G1 X1 F1"), chain(("SMC_ScaleQueue3D", {"dNothing": "1"})))


@pytest.mark.parametrize(
    ("text", "code", "line"),
    [
        ("G1 X1 F10\nN0 G77 X1", "SMC_DEC_INVALID_SYNTAX", 1),
        ("G1 X1 F10\nN0 G20 L999 K1", "SMC_DEC_JUMP_TO_UNKNOWN_LINE", None),
        ("(start)\n\nN0 G1 X10", "SMC_CV_ACC_DEC_VEL_NONPOSITIVE", 2),
        ("N0 G1 X10 F10 E0", "SMC_DEC_ACC_TOO_LITTLE", 0),
    ],
)
def test_faults_have_a_code_and_a_line(service: PathService, text: str, code: str, line: int | None) -> None:
    """cnc EX-32: what stops the blocks stops the path, at its line."""
    fault = service.objects_of(program(text)).fault
    assert fault is not None
    assert fault.code == code
    assert line is None or fault.line == line


def test_what_lies_before_a_fault_is_a_path(service: PathService) -> None:
    """CNC-37: the path is drawn up to the last correct element."""
    path = service.objects_of(program("G1 X10 F10\nG1 Y10\nG77"))
    assert path.rows["piDestPos.dY"].tolist() == [0.0, 10.0]
    assert path.fault is not None


def test_a_program_that_never_moves_does_not_hang(service: PathService) -> None:
    path = service.objects_of(program("N10 G36 D1\nN20 G20 L10"))
    assert path.fault is not None
    assert "for ever" in path.fault.message


def test_variables_have_their_offline_values(service: PathService) -> None:
    """CNC-17, cnc EX-18: a counter in a variable makes a loop of four lines."""
    text = "N0 G36 O$GVL.n$ D4\nN10 G91\nN20 G1 X$step$ F100\nN30 G37 O$GVL.n$ D-1\nN40 G20 L20 K$gvl.N$"
    path = service.objects_of(program(text, offline_values=[{"name": "STEP", "value": 5.0}]))
    assert path.fault is None
    assert path.rows["piDestPos.dX"].tolist() == [5.0, 10.0, 15.0, 20.0]
    assert path.lines.tolist() == [2, 2, 2, 2]


def test_suppressed_steps_and_the_start_position_count(service: PathService) -> None:
    """cnc EX-30, CNC-16."""
    text = "N0 G1 X10 F10\n/N10 G1 Y10\nN20 G1 X20"
    whole = service.objects_of(program(text, start={"x": 4.0})).rows
    assert whole["piStartPos.dX"][0] == 4.0
    assert whole["piDestPos.dY"].tolist() == [0.0, 10.0, 10.0]
    suppressed = service.objects_of(program(text, step_suppression=True)).rows
    assert suppressed["piDestPos.dY"].tolist() == [0.0, 0.0]


def test_stops_for_functions_and_synchronisation_do_not_stop_the_editor(service: PathService) -> None:
    """M functions are acknowledged at once, G4 takes its time, G75 is passed."""
    text = "N0 G1 X50 F100 E1000 E-1000\nN10 M7 K1.5\nN20 G75\nN30 G4 T2\nN40 G1 X100"
    motion = service.interpolated(program(text), PLAIN)
    assert motion.fault is None
    # two moves of 50 u at 100 u/s with 0.1 s of ramps each, and the dwell
    assert motion.duration_s == pytest.approx(2 * (0.5 + 0.1) + 2.0, abs=6 * motion.interval_s)
    assert motion.positions[-1][0] == 100.0
    assert len(service.objects_of(program(text)).rows) == 5


@settings(max_examples=20, deadline=None)
@given(
    points=st.lists(
        st.tuples(st.integers(-999, 999), st.integers(-999, 999)), min_size=1, max_size=60, unique=True
    )
)
def test_objects_go_through_the_points_of_the_text(
    service: PathService, points: list[tuple[int, int]]
) -> None:
    """Start, ends and lengths against the text, whatever it is."""
    ends = [point for point in points if point != (0, 0)]
    if points[0] == (0, 0) or (0, 0) in points:
        points = ends
    if not points:
        return
    rows = service.objects_of(program("\n".join(f"G1 X{x} Y{y} F10" for x, y in points))).rows
    np.testing.assert_array_equal(np.column_stack([rows["piDestPos.dX"], rows["piDestPos.dY"]]), points)
    steps = np.diff(np.array([(0, 0), *points]), axis=0)
    np.testing.assert_allclose(rows["dLength"], np.hypot(*steps.T), rtol=1e-14)


def test_a_program_longer_than_the_ring_comes_complete_and_in_order(service: PathService) -> None:
    """Words through the ring: more lines than it holds words, objects more than the window."""
    count = RING // 3 + 10 * WINDOW
    text = "\n".join(f"N{n} G1 X{n} Y{n % 7} F100" for n in range(1, count + 1))
    path = service.objects_of(program(text))
    assert path.fault is None
    np.testing.assert_array_equal(path.rows["piDestPos.dX"], np.arange(1, count + 1))
    np.testing.assert_array_equal(path.lines, np.arange(count))


def test_every_block_of_the_library_runs_in_a_chain() -> None:
    """CNCS-08: what the library offers can be chosen; those that the specification names are there."""
    named = (
        "SMC_AvoidLoop SMC_CheckVelocities SMC_ExtendedVelocityChecks SMC_LimitAddAxisDynamics"
        " SMC_LimitCircularVelocity SMC_RoundPath SMC_SmoothPath SMC_ToolCorr SMC_RotateQueue2D"
        " SMC_ScaleQueue3D SMC_TranslateQueue3D"
    )
    blocks = path_blocks()
    assert set(named.split()) <= set(blocks)
    assert not any(name.startswith("SMC_Interpolator") for name in blocks)
    wide = {"piMin.dX": "-1e6", "piMin.dY": "-1e6", "piMax.dX": "1e6", "piMax.dY": "1e6"}
    all_of_them = chain(*((name, wide if name == "SMC_CheckForLimits" else {}) for name in blocks))
    service = PathService()
    try:
        path = service.preprocessed(program("G1 X10 F10\nG1 Y10"), all_of_them)
    finally:
        service.close()
    assert path.fault is None
    ends = path.rows["piDestPos.dX"][-1], path.rows["piDestPos.dY"][-1]
    assert ends == pytest.approx((10.0, 10.0))

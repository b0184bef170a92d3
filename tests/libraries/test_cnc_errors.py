"""Errors and warnings of SMC_CheckVelocities and SMC_Interpolator, and absurd values."""

from __future__ import annotations

import itertools
import math
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tests.libraries.cnc_motion import MCOMMAND, WAIT, Object, motion, program_text

EDITOR = program_text(producer="queue.byGenerator := 255;")
"""The queue says that the editor planned it; nothing is checked."""
LINE = [Object(100.0)]


def planned(*path: Object) -> list[Object]:
    """The last object ends in standstill."""
    return [*path[:-1], Object(**{**path[-1].__dict__, "end": 0.0})]


def errors(
    path: list[Object], calls: int = 300, text: str = EDITOR, checks: bool = False, **inputs: Any
) -> list[int]:
    """What stood in wErrorID, in order."""
    with motion(path, text, **inputs) as running:
        running.program.set("Main", xChecks=checks)
        found = running.calls(calls)
        shown = found["aError"].astype(int)
        if running.program.literal("Main.ipo.bError") == "TRUE":
            assert running.program.literal("Main.ipo.bBusy") == "FALSE"
            assert (found["aWorking"][-1], found["aV"][-1], found["aDone"].max()) == (0, 0, 0)
    return [int(shown[0]), *(int(b) for a, b in itertools.pairwise(shown) if a != b)]


@pytest.mark.parametrize("member", ["dVel", "dAccel", "dDecel"])
@pytest.mark.parametrize("value", [0.0, -5.0, math.nan, math.inf])
def test_dynamics_that_are_none(member: str, value: float) -> None:
    """Spec 1001, 1008, 1100, CNCR-114, CNCR-131."""
    path = planned(Object(50.0), Object(50.0, members={member: value}))
    code = 1001 if member == "dVel" and value == 0 else 1008
    assert errors(path)[-1] == code
    with motion(path) as running:
        running.calls(10)
        assert running.program.literal("Main.check.bError") == "TRUE"
        assert running.program.literal("Main.check.wErrorID") == "SMC_CV_ACC_DEC_VEL_NONPOSITIVE"
        assert running.program.literal("Main.check.bBusy") == "FALSE"
        # What is before the object was planned and is run: it ends in standstill
        found = running.calls(300)
        assert (found["aS"][-1], found["aStatus"][-1], found["aError"][-1]) == (pytest.approx(50), WAIT, 1003)


def test_velocity_at_the_end() -> None:
    """Spec 1002, CNCR-128: seen before anything moves."""
    assert errors([Object(50.0), Object(50.0, end=10.0)], text=EDITOR) == [1002]


def test_the_queue_runs_dry_and_goes_on() -> None:
    """Spec 1003, CNCR-129: a warning for as long as the interpolator waits."""
    with motion([Object(0.1)] * 397) as path:
        path.program.set("Main", xCloses=False)
        found = path.calls(600)
        assert found["aS"][-1] == pytest.approx(39.7)
        assert (found["aStatus"][-1], found["aError"][-1], found["aWorking"][-1]) == (WAIT, 1003, 1)
        assert path.program.literal("Main.ipo.bError") == "FALSE"
        path.program.set("Main", xCloses=True)
        found = path.calls(1)
        assert (found["aDone"][0], found["aError"][0]) == (1, 0)


def test_velocity_at_a_stop() -> None:
    """Spec 1004: a queue that was planned wrongly."""
    path = planned(
        Object(50.0, end=40.0),
        Object(0.5, 40.0, end=20.0),
        Object(kind=MCOMMAND, members={"iHelpID[0]": 7}),
        Object(50.0),
    )
    assert errors(path)[-1] == 1004


def test_too_many_objects_in_a_cycle() -> None:
    """Spec 1005, CNCR-125."""
    text = program_text(
        declarations="many : ARRAY[1..1500] OF SM3_CNC.SMC_GEOINFO;",
        producer="""queue.pbyBuffer := ADR(many); queue.nCapacity := 1500; queue.byGenerator := 255;
    geo := aPath[0];
    WHILE NOT queue.bFull DO SM3_CNC.SMC_AppendObj(ADR(queue), ADR(geo)); END_WHILE""",
    )
    with motion([Object(0.0)], text) as path:
        path.program.set("Main", nPerCall=0, nObjects=1)
        assert path.calls(3)["aError"].tolist() == [1005] * 3


def test_no_check() -> None:
    """Spec 1006, CNCR-110: soon; a check in a slow task has time to come."""
    found = errors(LINE, calls=20, text=program_text())
    assert found == [0, 1006]


def test_a_check_in_a_slow_task() -> None:
    """Spec CNCR-116: no 1006."""
    with motion(LINE) as path:
        path.program.set("Main", nCheckEvery=5)
        found = path.calls(300)
        assert (found["aError"].max(), found["aDone"][-1]) == (0, 1)


@pytest.mark.parametrize("value", [-1.0, math.nan, math.inf])
def test_length_that_is_none(value: float) -> None:
    """Spec 1007."""
    assert errors(planned(Object(50.0, end=0.0), Object(50.0, members={"dLength": value})))[-1] == 1007


def test_no_cycle_time() -> None:
    """Spec 1009, CNCR-120, also in motion."""
    assert errors(LINE, calls=3, dwIpoTime=0) == [1009]
    with motion(LINE) as path:
        path.calls(50)
        path.set(dwIpoTime=0)
        found = path.calls(3)
        assert (set(found["aError"]), set(found["aV"]), set(found["aWorking"])) == ({1009}, {0}, {0})


def test_a_queue_too_small() -> None:
    """Spec 1080: short objects, more than have room."""
    with motion([Object(0.01)] * 400) as path:
        path.program.set("Main", nPerCall=1000)
        found = path.calls(300)
    assert 1080 in found["aError"]
    assert (found["aDone"][-1], found["aS"][-1]) == (1, pytest.approx(4.0))


def test_end_velocities_that_do_not_fit() -> None:
    """Spec 1081: 40 to 0 in 1 u takes 800 u/s2."""
    assert errors(planned(Object(100.0, end=40.0), Object(1.0, 40.0))) == [0, 1081, 0]


def test_wrong_tag() -> None:
    """Spec 1501, CNCR-14, at both blocks; also in motion."""
    for before in (0, 50):
        with motion(LINE) as path:
            path.calls(before)
            path.program.set("Main", xStarts=False)
            path.program.set("Main.queue", wOUTQUEUEStructID=1)
            assert path.calls(2)["aError"][-1] == 1501
            assert path.program.literal("Main.check.wErrorID") == "SMC_NO_OUTQUEUE_TYPE"


def test_no_queue_yet() -> None:
    """Spec CNCR-14: the blocks wait."""
    text = program_text().replace("poqDataIn := ADR(queue)", "poqDataIn := 0")
    with motion(LINE, text) as path:
        found = path.calls(50)
        assert (found["aError"].max(), found["aWorking"].max()) == (0, 0)
        assert (path.program.literal("Main.check.bBusy"), path.program.literal("Main.ipo.bBusy")) == (
            "TRUE",
            "TRUE",
        )


def test_an_error_stays_until_the_next_start() -> None:
    """Spec CNCR-25."""
    with motion(LINE, dwIpoTime=0) as path:
        path.calls(3)
        path.set(dwIpoTime=10000)
        assert set(path.calls(3)["aError"]) == {1009}
        path.program.set("Main", xExecutes=False)
        assert set(path.calls(3)["aError"]) == {0}
        path.program.set("Main", xExecutes=True)
        assert path.calls(260)["aDone"][-1] == 1


def test_abort() -> None:
    """Spec CNCR-130: the position stays, the queue is empty; another start takes another path."""
    with motion(LINE) as path:
        path.calls(100)
        path.set(bAbort=True)
        found = path.calls(5)
        assert found["aS"].tolist() == pytest.approx([37.5] * 5)
        assert (set(found["aV"]), set(found["aLeft"]), set(found["aWorking"]), set(found["aStatus"])) == (
            {0},
            {0},
            {0},
            {1},
        )
        path.set(bAbort=False)
        assert path.calls(20)["aWorking"].max() == 0
        path.program.set("Main", xExecutes=False)
        path.calls(1)
        path.program.set("Main", xExecutes=True, xStarts=True)
        assert path.calls(260)["aDone"][-1] == 1


def test_execute_false() -> None:
    """Spec CNCR-20, CNCR-154: outputs go, the switches begin anew with the next start."""
    switch = {"dHelpPos[0]": 0.1, "iHelpID[0]": 3}
    with motion([Object(100.0, members=switch)]) as path:
        assert path.calls(100)["aSwitches"][-1] == 4
        path.program.set("Main", xExecutes=False)
        found = path.calls(2)
        assert (found["aV"][-1], found["aWorking"][-1], found["aLine"][-1]) == (0, 0, -1)
        path.program.set("Main", xExecutes=True)
        found = path.calls(1)
        assert (found["aSwitches"][0], found["aLastSwitch"][0]) == (0, 0)


def test_the_restored_path_runs_again() -> None:
    """Spec CNCR-07."""
    text = program_text(
        producer="IF xAgain THEN xAgain := NOT SM3_CNC.SMC_RestoreQueue(TRUE, ADR(queue)); END_IF",
        declarations="xAgain : BOOL;",
    )
    with motion([Object(50.0), Object(50.0)], text) as path:
        assert path.calls(260)["aDone"][-1] == 1
        path.program.set("Main", xExecutes=False)
        path.calls(1)
        path.program.set("Main", xExecutes=True, xAgain=True)
        found = path.calls(260)
        assert int(np.argmax(found["aDone"])) + 1 == 250
        assert found["aS"][0] < 1


NUMBERS = st.sampled_from([math.nan, math.inf, -math.inf, 1e300, -1e300, 1e-300, 0.0, -1.0])
INPUTS = {
    **dict.fromkeys(("dOverride", "dQuickDeceleration", "dJerkMax", "dLastWayPos"), NUMBERS),
    "dwIpoTime": st.sampled_from([0, 1, 2**32 - 1]),
    "iVelMode": st.sampled_from([-1, 5, 32767]),
}
MEMBERS = (
    "dVel",
    "dVelEnd",
    "dAccel",
    "dDecel",
    "dLength",
    "dP1",
    "dT1",
    "dT2",
    "piDestPos.dX",
    "piStartPos.dY",
    "dHelpPos[0]",
)


@settings(max_examples=40, deadline=None)
@given(st.dictionaries(st.sampled_from(sorted(INPUTS)), st.none(), min_size=1), st.data(), st.booleans())
def test_absurd_inputs(names: dict[str, None], data: st.DataObject, stops: bool) -> None:
    """In motion: an error, or the path goes on; the position is one, never backwards or beyond the end."""
    values = {name: data.draw(INPUTS[name], label=name) for name in names}
    with motion([Object(50.0), Object(50.0)], iVelMode="SIGMOID") as path:
        path.calls(30)
        path.set(**values, bQuick_Stop=stops)
        found = path.calls(100)
    assert np.isfinite(found["aS"]).all()
    assert np.diff(found["aS"]).min() >= 0
    assert found["aS"].max() <= 100 + 1e-9
    assert set(found["aError"]) <= {0, 1003, 1009}


@settings(max_examples=60, deadline=None)
@given(
    st.dictionaries(st.sampled_from(MEMBERS), NUMBERS, min_size=1, max_size=3),
    st.sampled_from([1, 2, 3, 5, 7, 8, 9, 100, 101, 102, 110, 120, 0, -1, 999]),
    st.booleans(),
    st.sampled_from(["TRAPEZOID", "SIGMOID", "SIGMOID_LIMIT", "QUADRATIC", "QUADRATIC_SMOOTH"]),
)
def test_absurd_objects(members: dict[str, float], kind: int, checks: bool, mode: str) -> None:
    """An object of absurd numbers between two others: an error that is documented, or the path goes on."""
    text = program_text() if checks else EDITOR
    middle = Object(20.0, kind=kind, members={"iHelpID[0]": 3, "dP3": 10.0, **members})
    with motion(
        planned(Object(20.0, end=10.0), middle, Object(20.0)), text, iVelMode=mode, dJerkMax=1e3, bAcknM=True
    ) as path:
        path.program.set("Main", xChecks=checks)
        found = path.calls(1000)
    assert set(found["aError"]) <= {0, 1001, 1002, 1003, 1004, 1007, 1008, 1081}
    assert np.isfinite(found["aV"]).all()
    assert found["aV"].min() >= 0

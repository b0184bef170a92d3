"""Tappets of cams: SMC_GetTappetValue behind MC_CamIn, and SMC_CamRegister without a slave."""

from __future__ import annotations

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from tests.libraries.cam_pair import BOTH, INVERT, NEGATIVE, OFF, ON, POSITIVE, TIME, CamPair, cam_pair

ON_THERE_OFF_BACK = ((1, 90.0, POSITIVE, ON), (1, 90.0, NEGATIVE, OFF))
OFF_THERE_ON_BACK = ((1, 270.0, POSITIVE, OFF), (1, 270.0, NEGATIVE, ON))
TOGGLES = (2, 180.0, BOTH, INVERT)
FLAT = ((0, 0, 0, 0), (360, 0, 0, 0))
"""Spec cam CAM-06: a cam for switching only."""


def _bits(pair: CamPair) -> tuple[bool, bool]:
    return pair.true("Tappet1.bTappet"), pair.true("Tappet2.bTappet")


def _watched(pair: CamPair, **register: float | bool) -> None:
    """Group 1 and 2 by both blocks, that do not share a cam."""
    pair.set("Tappet1", iID=1)
    pair.set("Tappet2", iID=2)
    pair.select(1)
    pair.couple()
    if register:
        pair.set("Register", Enable=True, **register)
    pair.cycle()


def test_tappets_act_by_direction() -> None:
    """Spec cam EX-06; CAM-50 and CAM-53."""
    with cam_pair(FLAT) as pair:
        pair.put_tappets(1, *ON_THERE_OFF_BACK, *OFF_THERE_ON_BACK, TOGGLES)
        _watched(pair)
        for to, first in ((89.0, False), (91.0, True), (269.0, True), (271.0, False), (359.0, False)):
            pair.move(to)
            assert _bits(pair)[0] is first, to
        for to, first in ((271.0, False), (269.0, True), (91.0, True), (89.0, False), (1.0, False)):
            pair.move(to)
            assert _bits(pair)[0] is first, to
        assert not _bits(pair)[1]
        pair.move(361.0)
        assert _bits(pair)[1]
        pair.move(721.0)
        assert not _bits(pair)[1]


def test_a_tappet_switches_in_the_cycle_in_which_the_master_is_there() -> None:
    """And one that stands at the start of the cam does so in each cycle of it."""
    with cam_pair(FLAT) as pair:
        pair.put_tappets(1, (1, 90.0, POSITIVE, ON), (2, 0.0, BOTH, INVERT))
        _watched(pair)
        pair.run(100.0)
        pair.until(lambda: _bits(pair)[0])
        assert pair.master - 0.1 < 90.0 <= pair.master
        assert not _bits(pair)[1]
        for turn in (1, 2, 3):
            pair.until(lambda wanted=turn % 2 == 1: _bits(pair)[1] is wanted)
            assert pair.master - 0.1 < 360.0 * turn <= pair.master


def test_what_is_passed_on_the_way_there_is_passed_on_the_way_back() -> None:
    """A motion that ends on a tappet has passed it; leaving it backward passes it back."""
    with cam_pair(FLAT) as pair:
        pair.put_tappets(1, *ON_THERE_OFF_BACK)
        _watched(pair)
        pair.move(90.0)
        assert _bits(pair)[0]
        pair.move(89.0)
        assert not _bits(pair)[0]


def test_tappets_of_one_cycle_act_in_order() -> None:
    """Spec TAP-08: at a wrap too, in both directions."""
    with cam_pair(FLAT) as pair:
        pair.put_tappets(
            1, (1, 10.0, BOTH, OFF), (1, 350.0, BOTH, ON), (2, 350.0, BOTH, OFF), (2, 10.0, BOTH, ON)
        )
        _watched(pair)
        pair.move(300.0)
        pair.set("MasterAt", Velocity=1e5, Acceleration=1e8, Deceleration=1e8, Direction=1, Execute=True)
        pair.until(lambda: pair.master > 380.0)
        assert _bits(pair) == (False, True)
        pair.set("MasterAt", Execute=False)
        pair.cycle()
        pair.set("MasterAt", Direction=-1, Execute=True)
        pair.until(lambda: pair.number("Master.fSetVelocity") <= -1e5)
        pair.until(lambda: 300.0 < pair.master % 360.0 < 345.0)
        assert _bits(pair) == (True, False)


def test_hysteresis_needs_a_way_back() -> None:
    """Spec TAP-06."""
    with cam_pair(FLAT) as pair:
        pair.put_tappets(1, *ON_THERE_OFF_BACK, (2, 90.0, POSITIVE, INVERT))
        pair.set("CamIn1", TappetHysteresis=2.0)
        _watched(pair)
        pair.move(91.0)
        assert _bits(pair) == (True, True)
        for to in (89.5, 90.5, 89.1, 91.0):
            pair.move(to)
            assert _bits(pair) == (True, True)
        pair.move(87.5)
        assert _bits(pair) == (False, True)
        pair.move(89.9)
        assert _bits(pair) == (False, True)
        pair.move(90.0)
        assert _bits(pair) == (True, False)


def test_a_tappet_by_time() -> None:
    """Spec TAP-02: after a delay, for a duration."""
    with cam_pair(FLAT) as pair:
        pair.put_tappets(1, (1, 90.0, POSITIVE, TIME), (2, 90.0, POSITIVE, TIME))
        pair.set("aTappets1[0]", dwDelay=5000, dwDuration=20000)
        pair.set("aTappets1[1]", dwDelay=0, dwDuration=3000)
        _watched(pair)
        pair.run(100.0)
        pair.until(lambda: _bits(pair)[1])
        assert pair.master - 0.1 < 90.0 <= pair.master
        found = []
        for _ in range(30):
            found.append(_bits(pair))
            pair.cycle()
        assert [both[1] for both in found] == [True] * 3 + [False] * 27
        assert [both[0] for both in found] == [False] * 5 + [True] * 20 + [False] * 5


@pytest.mark.parametrize("resets", [True, False])
def test_the_initial_value(resets: bool) -> None:
    """Spec TAP-04."""
    with cam_pair(FLAT) as pair:
        pair.put_tappets(1, (1, 90.0, POSITIVE, OFF), (2, 90.0, POSITIVE, ON))
        pair.set("Tappet1", bInitValue=False)
        _watched(pair)
        assert _bits(pair) == (False, False)
        pair.set("Tappet2", bInitValue=False, bSetInitValueAtReset=resets)
        pair.move(100.0)
        assert _bits(pair) == (False, True)
        pair.set("CamIn1", Execute=False)
        pair.cycle()
        pair.couple()
        assert _bits(pair) == (False, not resets)


def test_the_register_has_a_bit_for_each_group() -> None:
    """Spec motion_semantics EX-24; TAP-05."""
    with cam_pair(FLAT, master_period=360.0) as pair:
        pair.put_tappets(1, (2, 90.0, POSITIVE, ON), (2, 180.0, POSITIVE, OFF), (512, 90.0, POSITIVE, INVERT))
        pair.set("Register", Enable=True)
        pair.cycle()
        assert pair.says("Register", "Busy", "Error", "EndOfProfile") == {"Busy"}
        pair.run(100.0)
        found = {}
        for _ in range(3600):
            pair.cycle()
            found[round(pair.master, 1)] = pair.true("aTracks[2]")
        assert all(
            on == (90.0 <= at < 180.0) for at, on in found.items() if abs(at - 90) > 0.2 < abs(at - 180)
        )
        assert pair.true("aTracks[512]")
        pair.run(-100.0)
        before = pair.true("aTracks[2]")
        pair.until(lambda: pair.master < 80.0 and pair.number("Master.fSetVelocity") < 0)
        assert pair.true("aTracks[2]") is before
        pair.set("Register", Enable=False)
        pair.cycle()
        assert not pair.true("aTracks[512]")
        assert pair.says("Register", "Busy", "Error") == set()


def test_the_register_says_where_the_cam_ends() -> None:
    with cam_pair(FLAT) as pair:
        pair.put_tappets(1, (1, 90.0, POSITIVE, ON))
        pair.set("Register", Enable=True, MasterScaling=2.0, MasterOffset=60.0)
        pair.run(100.0)
        ends = []
        for _ in range(4000):
            pair.cycle()
            if pair.true("Register.EndOfProfile"):
                ends.append(pair.master)
        assert ends == [pytest.approx(at, abs=0.1 + 1e-6) for at in (150.0, 330.0)]


@pytest.mark.parametrize(("time", "at"), [(0.0, 180.0), (0.02, 178.0), (-0.02, 182.0)])
def test_dead_time_compensation(time: float, at: float) -> None:
    """Spec motion_semantics EX-23 and ax3000 EX-AX-18; TAP-07."""
    with cam_pair(FLAT) as pair:
        pair.put_tappets(1, (1, 180.0, POSITIVE, ON))
        pair.set("Register", Enable=True, DeadTimeCompensation=time)
        pair.run(100.0)
        pair.until(lambda: pair.true("aTracks[1]"))
        assert pair.master - 0.1 - 1e-6 < at <= pair.master + 1e-6


@pytest.mark.parametrize(
    ("tappets", "error"),
    [
        ((), "SMC_CR_NO_TAPPETS_IN_CAM"),
        (((513, 90.0, POSITIVE, ON),), "SMC_CR_TOO_MANY_TAPPETS"),
        (((0, 90.0, POSITIVE, ON),), "SMC_CR_TOO_MANY_TAPPETS"),
    ],
)
def test_what_the_register_refuses(tappets: tuple[tuple[int, float, int, int], ...], error: str) -> None:
    """Spec TAP-09."""
    with cam_pair(FLAT) as pair:
        pair.put_tappets(1, *tappets)
        pair.set("Register", Enable=True)
        pair.cycle()
        assert pair.says("Register", "Busy", "Error") == {"Error"}
        assert pair.text("Register.ErrorID") == error
        assert pair.text("Master.fbeFBError[0].eErrorID") == error
        pair.set("Register", Enable=False)
        pair.cycle()
        assert pair.says("Register", "Busy", "Error") == set()


def test_a_cam_has_32_registers_at_most() -> None:
    """Spec TAP-09: a bit of the cam for each."""
    with cam_pair(FLAT) as pair:
        pair.put_tappets(1, (1, 90.0, POSITIVE, ON))
        pair.set("Cam1", dwTappetActiveBits=0xFFFFFFFF)
        pair.set("Register", Enable=True)
        pair.cycle()
        assert pair.text("Register.ErrorID") == "SMC_CR_MORE_THAN_32_ACCESSES"
        pair.set("Register", Enable=False)
        pair.set("Cam1", dwTappetActiveBits=0xFFFFFFF7)
        pair.cycle()
        pair.set("Register", Enable=True)
        pair.cycle()
        assert pair.number("Cam1.dwTappetActiveBits") == 0xFFFFFFFF
        pair.set("Register", Enable=False)
        pair.cycle()
        assert pair.number("Cam1.dwTappetActiveBits") == 0xFFFFFFF7


def test_no_cam_is_refused() -> None:
    with cam_pair(FLAT) as pair:
        pair.put_tappets(1, (1, 90.0, POSITIVE, ON))
        pair.set("Cam1", wCamStructID=1)
        pair.set("Register", Enable=True)
        pair.cycle()
        assert pair.text("Register.ErrorID") == "SMC_NO_CAM_REF_TYPE"


def test_too_many_tappets_in_a_cycle_are_told_and_the_slave_follows_on() -> None:
    """Spec TAP-09."""
    with cam_pair(FLAT) as pair:
        pair.put_tappets(1, *((1, 100.0 + n / 100, POSITIVE, INVERT) for n in range(40)))
        _watched(pair)
        pair.move(99.0)
        assert pair.text("Slave.fbeFBError[0].eErrorID") == "SMC_NO_ERROR"
        pair.set("MasterAt", Velocity=10_000.0, Acceleration=1e9, Deceleration=1e9, Direction=1, Execute=True)
        pair.cycle(2)
        assert pair.text("Slave.fbeFBError[0].eErrorID") == "SMC_CI_TOO_MANY_TAPPETS_PER_CYCLE"
        assert pair.says("CamIn1") == {"Busy", "Active", "InSync"}


MOVES = st.lists(st.floats(-900.0, 900.0).map(lambda at: round(at, 2)), min_size=1, max_size=8)
TAPPET = st.tuples(
    st.sampled_from((1, 2)),
    st.integers(0, 35).map(lambda at: at * 10.0 + 5.0),
    st.sampled_from((POSITIVE, BOTH, NEGATIVE)),
    st.sampled_from((ON, OFF, INVERT)),
)


@settings(max_examples=40, deadline=None)
@example(moves=[-5.0, 15.0], tappets=[(1, 15.0, POSITIVE, ON)])
@given(moves=MOVES, tappets=st.lists(TAPPET, min_size=1, max_size=10, unique_by=lambda tappet: tappet[:2]))
def test_random_moves_switch_as_a_plain_walk_does(
    moves: list[float], tappets: list[tuple[int, float, int, int]]
) -> None:
    """Against a list of all places of all tappets on an unrolled master; both blocks agree."""
    bits = {1: False, 2: False}
    with cam_pair(FLAT) as pair:
        pair.put_tappets(1, *tappets)
        _watched(pair, MasterOffset=0.0)
        at = 0.0
        for to in moves:
            places = [
                (x + 360.0 * turn, group, directions, action)
                for group, x, directions, action in tappets
                for turn in range(-4, 4)
            ]
            passed = sorted((p for p in places if min(at, to) < p[0] <= max(at, to)), key=lambda p: p[0])
            for _, group, directions, action in passed if to >= at else reversed(passed):
                if directions != (NEGATIVE if to >= at else POSITIVE):
                    bits[group] = {ON: True, OFF: False, INVERT: not bits[group]}[action]
            pair.move(to)
            at = to
            assert _bits(pair) == (bits[1], bits[2])
            assert (pair.true("aTracks[1]"), pair.true("aTracks[2]")) == (bits[1], bits[2])

"""From one cam to another: by a new command, and by CamTableID at the end of a cycle of the cam."""

from __future__ import annotations

from itertools import pairwise

import pytest
from tests.libraries.cam_pair import (
    CYCLE,
    DEFAULT,
    FIRST,
    RAMP_IN,
    RELATIVE,
    SECOND,
    CamPair,
    Point,
    cam_pair,
)

STEEP: tuple[Point, ...] = ((0, 0, 1, 0), (180, 180, 1, 0), (360, 360, 1, 0))
BEHIND: tuple[Point, ...] = ((1000, 0, 1, 0), (1180, 180, 1, 0), (1360, 360, 0, 0))
"""The second cam for other positions of the master."""


def _to_the_end(pair: CamPair, periodic: bool) -> list[float]:
    """The slave in each cycle of 2 of the master, until the second cam has taken over at 360."""
    pair.give(2, SECOND)
    pair.select(1, periodic=periodic, slave_absolute=False)
    pair.select(2, slave_absolute=False)
    pair.write("nCam2", 2)
    pair.set("CamIn2", MasterOffset=-360.0, StartMode=RELATIVE)
    pair.couple(StartMode=RELATIVE)
    pair.step(349.002)  # 0.002 less than 2 in the cycle in which the master starts
    pair.run(2000.0)
    places = []
    while pair.master < 361.5:
        places.append(pair.slave)
        pair.write("xSwitchesAtEnd", True)
        pair.cycle()
        assert len(places) < 100
    return places


def test_a_periodic_cam_leaves_its_place_before_the_next_one_begins() -> None:
    """Spec cam EX-14 and motion_semantics EX-20: the deviation is the first cam's first step, here 1."""
    with cam_pair(STEEP) as pair:
        places = _to_the_end(pair, periodic=True)
        step = places[-1] - places[-2]
        beyond = 360.0 - places[-2]
        assert step == pytest.approx(beyond + 2 * (2.0 - beyond), abs=1e-6)
    with cam_pair(FIRST) as pair:
        places = _to_the_end(pair, periodic=True)
        assert places[-2] == pytest.approx(359.0, abs=1e-9)
        assert places[-1] == pytest.approx(361.000183816, abs=1e-8)


def test_a_cam_that_is_not_periodic_hands_over_without_a_step() -> None:
    """Spec cam EX-15 and motion_semantics EX-20, cam CAM-120 to CAM-122."""
    with cam_pair(FIRST) as pair:
        places = _to_the_end(pair, periodic=False)
        assert [b - a for a, b in zip(places[-4:], places[-3:], strict=False)] == [
            pytest.approx(2.0, abs=1e-6)
        ] * 3
        assert places[-2:] == [pytest.approx(359.0, abs=1e-9), pytest.approx(361.0, abs=1e-9)]
        assert pair.says("CamIn2", "Busy", "Error") == {"Busy"}
        assert pair.says("CamIn1", "Busy", "CommandAborted") in ({"CommandAborted"}, set())
        pair.cycle(2)
        assert pair.says("CamIn2") == {"Busy", "Active", "InSync"}
        assert pair.state == "synchronized_motion"


@pytest.mark.parametrize(
    ("period", "offset", "first"), [(270.0, 0.0, 0.0), (270.0, 90.0, 90.0), (360.0, 0.0, 0.0)]
)
def test_an_absolute_start_fits_the_period_of_the_slave(period: float, offset: float, first: float) -> None:
    """Spec cam EX-16 and CAM-123."""
    with cam_pair(FIRST, master_period=360.0, slave_period=period) as pair:
        pair.give(2, SECOND)
        pair.select(1, periodic=False)
        pair.select(2)
        pair.couple()
        pair.step(360.0)
        assert pair.slave == pytest.approx(360.0 % period, abs=1e-9)
        pair.write("nCam2", 2)
        pair.start("CamIn2", SlaveOffset=offset)
        assert pair.slave == pytest.approx(first, abs=1e-9)


@pytest.mark.parametrize("second", [SECOND, BEHIND])
@pytest.mark.parametrize("periodic", [True, False])
def test_another_cam_takes_over_at_the_end_with_the_rest(periodic: bool, second: tuple[Point, ...]) -> None:
    """Spec ax3000 MC_CamIn: CamTableID is changed while the cam runs."""
    with cam_pair(FIRST) as pair:
        pair.give(2, second)
        pair.select(1, periodic=periodic, slave_absolute=False)
        pair.select(2, slave_absolute=False)
        pair.couple()
        pair.step(200.0)
        pair.write("nCam1", 2)
        pair.cycle(5)
        assert pair.slave == pytest.approx(200.0, abs=1e-9)
        pair.run(2000.0)
        before = pair.slave
        for _ in range(100):
            pair.cycle()
            assert pair.slave - before == pytest.approx(2.0, abs=1e-6)
            before = pair.slave
        assert pair.slave == pytest.approx(pair.master, abs=1e-6)
        pair.move(720.0 - 1e-6)
        assert pair.slave == pytest.approx(720.0, abs=1e-4)
        assert pair.says("CamIn1") == {"Busy", "Active", "InSync"}


def test_a_cam_that_has_ended_hands_over_what_lies_beyond() -> None:
    with cam_pair(FIRST) as pair:
        pair.give(2, SECOND)
        pair.select(1, periodic=False, slave_absolute=False)
        pair.select(2, periodic=False, slave_absolute=False)
        pair.couple()
        pair.step(380.0)
        assert pair.slave == 360.0
        pair.write("nCam1", 2)
        pair.cycle(2)
        assert pair.slave == pytest.approx(380.0, abs=1e-9)


@pytest.mark.parametrize(("periodic", "cycles"), [(False, 0), (True, 0), (True, 2)])
def test_with_ramp_in_the_slave_makes_up_for_what_lies_beyond(periodic: bool, cycles: int) -> None:
    """CAM-110: the master has gone on while the slave stood at the end of the first cam; a second one that is
    periodic leaves out its whole cycles."""
    with cam_pair(FIRST) as pair:
        pair.give(2, SECOND)
        pair.select(1, periodic=False, slave_absolute=False)
        pair.select(2, periodic=periodic, slave_absolute=False)
        pair.couple(StartMode=RAMP_IN, VelocityDiff=50.0, Acceleration=500.0, Deceleration=500.0)
        pair.step(380.0 + 360.0 * cycles)
        pair.cycle(10)
        pair.write("nCam1", 2)
        places = [pair.slave]
        for _ in range(1000):
            pair.cycle()
            places.append(pair.slave)
        assert places[0] == pytest.approx(360.0, abs=1e-9)
        assert places[-1] == pytest.approx(380.0, abs=1e-9)
        steps = [right - left for left, right in pairwise(places)]
        assert max(steps) == pytest.approx(50.0 * CYCLE, rel=1e-6)
        assert min(steps) >= -1e-9
        assert pair.says("CamIn1") == {"Busy", "Active", "InSync"}


def test_scaling_and_offset_change_where_a_cycle_ends() -> None:
    """Spec cam CAM-112."""
    with cam_pair() as pair:
        pair.select(1, slave_absolute=False)
        pair.couple()
        pair.step(100.0)
        here = pair.slave
        pair.set("CamIn1", SlaveScaling=0.5, MasterScaling=2.0)
        pair.cycle(3)
        assert pair.slave == here
        pair.step(260.0)
        assert pair.slave == pytest.approx(360.0, abs=1e-9)
        pair.step(30.0)
        assert pair.slave == pytest.approx(360.0 + 0.5 * 41.25, abs=1e-9)
        pair.step(150.0)
        assert pair.slave == pytest.approx(540.0, abs=1e-9)
        pair.set("CamIn1", MasterOffset=60.0)
        pair.step(180.0)
        assert pair.slave == pytest.approx(720.0 + 0.5 * 41.25, abs=1e-9)


def test_values_that_make_no_sense_do_not_take_effect() -> None:
    with cam_pair() as pair:
        pair.select(1)
        pair.couple()
        pair.set("CamIn1", SlaveScaling=float("nan"), MasterScaling=0.0, MasterOffset=1e300)
        pair.step(420.0)
        assert pair.slave == pytest.approx(41.25, abs=1e-9)


def test_a_restart_forgets_what_went_before() -> None:
    """Spec motion_semantics CAM-12, cam CAM-112."""
    with cam_pair() as pair:
        pair.select(1, slave_absolute=False, master_absolute=False)
        pair.couple(SlaveScaling=2.0)
        pair.step(120.0)
        assert pair.slave == pytest.approx(240.0, abs=1e-9)
        pair.set("CamIn1", Execute=False)
        pair.cycle()
        assert pair.says("CamIn1") == {"Busy", "Active", "InSync"}
        pair.couple(SlaveScaling=1.0)
        pair.step(60.0)
        assert pair.slave == pytest.approx(240.0 + 41.25, abs=1e-9)


def test_points_may_change_while_the_cam_runs() -> None:
    """Spec motion_semantics CAM-13, cam CAM-94."""
    with cam_pair() as pair:
        pair.select(1)
        pair.couple()
        pair.step(60.0)
        pair.give(1, [(x, 2 * y, 2 * v, a) for x, y, v, a in DEFAULT])
        pair.cycle()
        assert pair.slave == pytest.approx(82.5, abs=1e-9)
        pair.give(1, [(0, 0, 0, 0), (360, 360, 0, 0)])
        pair.cycle()
        assert pair.slave == pytest.approx(360 * (10 / 6**3 - 15 / 6**4 + 6 / 6**5), abs=1e-9)


def test_a_cam_for_each_object_on_a_belt() -> None:
    """Spec cam EX-11: distances vary; the offset takes up how far the belt is over."""
    with cam_pair() as pair:
        pair.select(1, periodic=False, master_absolute=False, slave_absolute=False)
        pair.run(500.0)
        for number, arrival in enumerate((200.0, 700.0, 1080.0)):
            pair.until(lambda arrival=arrival: pair.master >= arrival)
            pair.set("CamIn1", Execute=False)
            pair.cycle()
            over = pair.master + 500.0 * CYCLE - arrival
            pair.couple(MasterOffset=over)
            pair.until(lambda arrival=arrival: pair.master >= arrival + 60.0)
            expected = 360.0 * number + 41.25 + 1.4375 * (pair.master - arrival - 60.0)
            assert pair.slave == pytest.approx(expected, abs=5e-3)
            pair.until(lambda: pair.true("CamIn1.EndOfProfile"))
            assert pair.slave == pytest.approx(360.0 * (number + 1), abs=1e-9)
            assert pair.velocity == 0.0

"""MC_CamTableSelect, MC_CamIn, MC_CamOut, SMC_GetCamSlaveSetPosition: where a slave is, what they say."""

from __future__ import annotations

import pytest
from tests.libraries.cam_pair import (
    ABSOLUTE,
    CYCLE,
    HALF,
    RAMP,
    RAMP_IN,
    RAMP_IN_NEG,
    RAMP_IN_POS,
    RELATIVE,
    cam_pair,
)

LINE = ((0, 0, 1, 0), (360, 360, 1, 0))
NO_ACCURACY = 1e-9


def test_the_slave_is_where_the_cam_has_it_in_the_same_cycle() -> None:
    """Spec motion_semantics CAM-02 and CAM-05, ax3000 CAM-04."""
    with cam_pair() as pair:
        pair.select(1)
        pair.set("CamIn1", Execute=True)
        pair.cycle()
        assert pair.says("CamIn1") == {"Busy"}
        assert pair.state == "synchronized_motion"
        pair.cycle()
        assert pair.says("CamIn1") == {"Busy", "Active", "InSync"}
        for x, y in ((30, 7.8515625), (60, 41.25), (90, 85.4296875), (180, 180), (300, 318.75)):
            pair.step(x - pair.master)
            assert pair.slave == pytest.approx(y, abs=1e-9)
        assert pair.velocity == 0.0
        assert pair.text("Master.nAxisState") == "standstill"


def test_velocity_and_acceleration_follow_the_chain_rule() -> None:
    with cam_pair() as pair:
        pair.select(1)
        pair.couple(MasterScaling=0.5, SlaveScaling=2.0)
        pair.set("MasterAt", Velocity=200.0, Acceleration=40.0, Deceleration=40.0, Direction=1, Execute=True)
        pair.cycle(2000)
        before = pair.slave
        pair.cycle()
        velocity, acceleration = pair.velocity, pair.number("Slave.fSetAcceleration")
        here = pair.slave
        pair.cycle()
        assert velocity == pytest.approx((pair.slave - before) / (2 * CYCLE), rel=1e-5)
        assert acceleration == pytest.approx((pair.slave - 2 * here + before) / CYCLE**2, rel=1e-3)
        x = 0.5 * (pair.master - pair.number("Master.fSetVelocity") * CYCLE)
        assert acceleration == pytest.approx(
            2.0 * (_curvature(x) * (0.5 * pair.number("Master.fSetVelocity")) ** 2 + _slope(x) * 0.5 * 40.0),
            rel=1e-2,
        )


def _slope(x: float) -> float:
    """Of the default cam's first segment."""
    s = x / 120
    return 120 * (18 * s**2 - 32 * s**3 + 15 * s**4) / 120


def _curvature(x: float) -> float:
    s = x / 120
    return 120 * (36 * s - 96 * s**2 + 60 * s**3) / 120**2


def test_scaling_and_offset() -> None:
    """Spec cam EX-10; motion_semantics CAM-03, CAM-04."""
    with cam_pair() as pair:
        pair.select(1)
        pair.place(85.0, 0.0)
        inputs = {"MasterScaling": 2.0, "MasterOffset": 10.0, "SlaveScaling": 0.5, "SlaveOffset": 100.0}
        pair.set("StartPosition", Enable=True, **inputs)
        pair.couple(**inputs)
        assert pair.slave == pytest.approx(190.0, abs=1e-12)
        assert pair.number("StartPosition.fStartPosition") == pytest.approx(190.0, abs=1e-12)
    with cam_pair() as pair:
        pair.select(1)
        pair.place(60.0, 0.0)
        pair.couple()
        assert pair.slave == pytest.approx(41.25, abs=1e-12)
        pair.set("CamIn1", Execute=False)
        pair.cycle()
        pair.couple(SlaveScaling=2.0)
        assert pair.slave == pytest.approx(82.5, abs=1e-12)


@pytest.mark.parametrize(
    ("master_scaling", "slave_scaling", "period", "peak"),
    [(1, 2, 360, 360), (2, 1, 180, 180), (1, 0.5, 360, 90), (0.5, 1, 720, 180)],
)
def test_scalings_stretch_the_cam(
    master_scaling: float, slave_scaling: float, period: float, peak: float
) -> None:
    """Spec motion_semantics EX-22 and ax3000 EX-AX-14."""
    with cam_pair(HALF) as pair:
        pair.select(1)
        pair.couple(MasterScaling=float(master_scaling), SlaveScaling=float(slave_scaling))
        pair.run(200.0)
        highest, ends = 0.0, []
        for _ in range(round(period / 200.0 / CYCLE) + 10):
            highest = max(highest, pair.slave)
            if pair.true("CamIn1.EndOfProfile"):
                ends.append(pair.master)
            pair.cycle()
        assert highest == pytest.approx(peak, abs=1e-2)
        assert ends == [pytest.approx(period, abs=0.4)]


def test_offsets_move_the_cam() -> None:
    """Spec motion_semantics EX-22 and ax3000 EX-AX-14: the first end is at master 340."""
    with cam_pair(HALF) as pair:
        pair.select(1)
        pair.couple(MasterOffset=20.0, SlaveOffset=30.0)
        assert pair.slave == pytest.approx(32.0759, abs=1e-4)
        pair.run(100.0)
        pair.until(lambda: pair.true("CamIn1.EndOfProfile"))
        assert pair.master == pytest.approx(340.0, abs=0.1 + 1e-9)


def test_an_offset_begins_the_cam_where_the_master_is() -> None:
    """Spec motion_semantics EX-21 and ax3000 EX-AX-15."""
    with cam_pair() as pair:
        pair.select(1)
        pair.place(137.5, 0.0)
        pair.couple(MasterOffset=-pair.number("Master.fActPosition"))
        assert pair.slave == 0.0
        pair.step(60.0)
        assert pair.slave == pytest.approx(41.25, abs=1e-9)


def test_end_of_profile_carries_the_rest_over() -> None:
    """Spec motion_semantics EX-18, ax3000 EX-AX-11: X begins with what lies beyond the end."""
    with cam_pair(LINE) as pair:
        pair.select(1)
        pair.place(0.19, 0.0)
        pair.couple()
        pair.run(200.0)
        pair.until(lambda: abs(pair.master - 359.99) < 1e-4)
        assert "EndOfProfile" not in pair.says("CamIn1", "EndOfProfile")
        pair.cycle()
        assert pair.says("CamIn1", "EndOfProfile") == {"EndOfProfile"}
        assert pair.slave == pytest.approx(0.19, abs=1e-4)
        pair.cycle()
        assert pair.says("CamIn1", "EndOfProfile") == set()
        assert pair.says("CamIn1") == {"Busy", "Active", "InSync"}


def test_relative_cycles_add_up_and_absolute_ones_jump() -> None:
    """Spec cam EX-12."""
    with cam_pair() as pair:
        pair.select(1, slave_absolute=False)
        pair.couple()
        ends = []
        for target in (360.0, 420.0, 720.0):
            pair.run(400.0)
            for _ in range(round(abs(target - pair.master) / 0.4) - 1):
                pair.cycle()
                if pair.true("CamIn1.EndOfProfile"):
                    ends.append(pair.master)
            pair.move(target)
            expected = {360.0: 360.0, 420.0: 401.25, 720.0: 720.0}[target]
            assert pair.slave == pytest.approx(expected, abs=1e-9)
    with cam_pair() as pair:
        pair.select(1)
        pair.couple()
        pair.step(420.0)
        assert pair.slave == pytest.approx(41.25, abs=1e-9)
    with cam_pair(slave_period=360.0) as pair:
        pair.select(1)
        pair.couple()
        pair.run(100.0)
        before = pair.slave
        for _ in range(4200):
            pair.cycle()
            assert (pair.slave - before) % 360.0 < 0.2
            before = pair.slave


def test_backward_over_the_start_comes_back_to_the_same_places() -> None:
    with cam_pair() as pair:
        pair.select(1, slave_absolute=False)
        pair.couple()
        pair.step(60.0)
        pair.step(-120.0)
        assert pair.slave == pytest.approx(318.75 - 360.0, abs=1e-9)
        pair.step(60.0)
        assert pair.slave == pytest.approx(0.0, abs=1e-9)
        pair.step(1140.0)
        assert pair.slave == pytest.approx(1080.0 + 41.25, abs=1e-9)


def test_a_cam_that_is_not_periodic_holds_the_slave_at_its_end() -> None:
    """Spec cam EX-13 and ax3000 EX-AX-12; cam CAM-101."""
    with cam_pair() as pair:
        pair.select(1, periodic=False)
        pair.couple()
        pair.run(1000.0)
        pair.until(lambda: pair.true("CamIn1.EndOfProfile"))
        assert pair.master == pytest.approx(360.0, abs=1.0)
        pair.cycle(10)
        assert pair.slave == 360.0
        assert pair.velocity == 0.0
        assert pair.says("CamIn1", "EndOfProfile", "Busy") == {"EndOfProfile", "Busy"}
        pair.set("CamIn1", Execute=False)
        pair.cycle()
        assert pair.says("CamIn1", "EndOfProfile", "Busy") == {"Busy"}
        pair.move(300.0)
        assert pair.slave == pytest.approx(318.75, abs=1e-9)
        pair.set("MasterAt", Execute=False)
        pair.run(1000.0)
        pair.until(lambda: pair.true("CamIn1.EndOfProfile"))
        pair.cycle()
        assert not pair.true("CamIn1.EndOfProfile")


START_MODES = [
    (ABSOLUTE, False, True, 0.0),
    (ABSOLUTE, False, False, 20.0),
    (ABSOLUTE, True, True, 108.59625),
    (ABSOLUTE, True, False, 128.59625),
    (RELATIVE, False, True, 20.0),
    (RELATIVE, False, False, 20.0),
    (RELATIVE, True, True, 128.59625),
    (RELATIVE, True, False, 128.59625),
    *[
        (mode, a, b, 20.0)
        for mode in (RAMP_IN, RAMP_IN_POS, RAMP_IN_NEG)
        for a in (True, False)
        for b in (True, False)
    ],
]


@pytest.mark.parametrize(("mode", "master_absolute", "slave_absolute", "first"), START_MODES)
def test_start_modes(mode: int, master_absolute: bool, slave_absolute: bool, first: float) -> None:
    """Spec motion_semantics EX-19 and CAM-07, ax3000 EX-AX-13 and section 9: master at 100, slave at 20."""
    with cam_pair(HALF) as pair:
        pair.select(1, master_absolute=master_absolute, slave_absolute=slave_absolute)
        pair.place(100.0, 20.0)
        pair.couple(StartMode=mode, **RAMP)
        assert pair.slave == pytest.approx(first, abs=1e-4)
        start = 100.0 if master_absolute else 0.0
        base = 0.0 if slave_absolute and mode != RELATIVE else 20.0
        pair.until(lambda: pair.true("CamIn1.InSync"), 10_000)
        pair.step(180.0 - start)
        assert pair.slave == pytest.approx(base + 180.0, abs=1e-9)


@pytest.mark.parametrize(
    ("mode", "slave", "way"),
    [
        (RAMP_IN_POS, 20.0, 88.59625),
        (RAMP_IN_NEG, 20.0, 88.59625 - 360.0),
        (RAMP_IN, 20.0, 88.59625),
        (RAMP_IN_POS, 128.59625, 340.0),
        (RAMP_IN_NEG, 128.59625, -20.0),
        (RAMP_IN, 128.59625, -20.0),
        (RAMP_IN, 308.59625, 160.0),
    ],
)
def test_ramp_in_of_a_rotary_slave_takes_its_direction(mode: int, slave: float, way: float) -> None:
    """Spec ax3000 CST-08, cam CAM-111."""
    with cam_pair(HALF, slave_period=360.0) as pair:
        pair.select(1)
        pair.place(100.0, slave)
        pair.couple(StartMode=mode, **RAMP)
        gone, before = 0.0, slave
        for _ in pair.cycles_until("CamIn1.InSync"):
            step = (pair.slave - before + 180.0) % 360.0 - 180.0
            assert abs(step) <= RAMP["VelocityDiff"] * CYCLE + 1e-9
            gone, before = gone + step, pair.slave
        assert gone == pytest.approx(way, abs=1e-6)
        assert pair.slave == pytest.approx(108.59625, abs=1e-4)


def test_the_start_position_given_to_the_slave_avoids_a_step() -> None:
    """Spec ax3000 CAM-18: an absolute start begins where SMC_GetCamSlaveSetPosition says."""
    with cam_pair(HALF) as pair:
        pair.select(1)
        pair.place(100.0, 20.0)
        pair.set("StartPosition", Enable=True)
        pair.cycle()
        pair.start("SlaveSet", Position=pair.number("StartPosition.fStartPosition"))
        pair.cycle()
        before = pair.slave
        pair.couple()
        assert pair.slave == pytest.approx(before, abs=1e-12)
        assert pair.slave == pytest.approx(108.59625, abs=1e-5)


def test_a_relative_cycle_steps_where_the_cam_does_not_begin_at_zero() -> None:
    """Spec ax3000 CST-06 and CST-07, cam CAM-109: each cycle begins 10 behind the end of the one before."""
    with cam_pair(((0, 10, 0, 0), (360, 40, 0, 0))) as pair:
        pair.select(1, slave_absolute=False)
        pair.couple()
        assert pair.slave == pytest.approx(10.0)
        pair.run(100.0)
        before = pair.slave
        for _ in range(3601):
            before = pair.slave
            pair.cycle()
            if pair.true("CamIn1.EndOfProfile"):
                break
        assert before == pytest.approx(40.0, abs=1e-3)
        assert pair.slave - before == pytest.approx(10.0, abs=1e-3)


def test_ramp_in_takes_the_time_of_its_ramps() -> None:
    """Spec ax3000 EX-AX-16 and CST-05: 88.596 with 100 u/s and 500 u/s2, and InSync only then."""
    with cam_pair(HALF) as pair:
        pair.select(1)
        pair.place(100.0, 20.0)
        pair.couple(StartMode=RAMP_IN, VelocityDiff=100.0, Acceleration=500.0, Deceleration=500.0)
        gone = pair.until(lambda: pair.true("CamIn1.InSync"))
        assert gone * CYCLE == pytest.approx(0.2 + (88.59625 - 20.0) / 100.0 + 0.2, abs=3 * CYCLE)
        assert pair.slave == pytest.approx(108.59625, abs=1e-5)


def test_ramp_in_stays_within_its_limits_against_the_cam() -> None:
    """Spec cam CAM-110: a moving slave comes to a moving master."""
    with cam_pair(((0, 0, 1, 0), (3600, 3600, 1, 0))) as pair:
        pair.select(1)
        pair.place(0.0, 80.0)
        pair.run(100.0)
        pair.start("SlaveAt", Velocity=30.0, Acceleration=1e4, Deceleration=1e4, Direction=1)
        pair.cycle(50)
        pair.couple(StartMode=RAMP_IN, **RAMP)
        before = pair.slave, pair.velocity
        for _ in pair.cycles_until("CamIn1.InSync"):
            assert pair.slave - before[0] == pytest.approx(CYCLE * (pair.velocity + before[1]) / 2, abs=1e-3)
            assert abs(pair.velocity - before[1]) <= 400.0 * CYCLE + 1e-9
            assert -70.0 - 1e-9 <= pair.velocity - 100.0 <= 50.0 + 1e-9
            before = pair.slave, pair.velocity
        assert pair.slave == pytest.approx(pair.master, abs=1e-9)


def test_ramp_in_makes_up_for_steps_between_cycles() -> None:
    with cam_pair(((0, 0, 0, 0), (360, 90, 0, 0))) as pair:
        pair.select(1)
        pair.couple(StartMode=RAMP_IN, VelocityDiff=500.0, Acceleration=4000.0, Deceleration=4000.0)
        pair.run(200.0)
        pair.until(lambda: pair.true("CamIn1.EndOfProfile"))
        assert pair.slave == pytest.approx(90.0, abs=1e-2)
        assert not pair.true("CamIn1.InSync")
        before = pair.slave
        for _ in pair.cycles_until("CamIn1.InSync"):
            assert abs(pair.slave - before) < 0.6
            before = pair.slave


def test_the_slave_keeps_its_velocity_after_cam_out() -> None:
    """Spec motion_semantics CAM-11 and STA-09, ax3000 EX-AX-17."""
    with cam_pair() as pair:
        pair.select(1, master_absolute=False, slave_absolute=False)
        pair.couple()
        pair.run(100.0)
        pair.cycle(700)
        velocity = pair.velocity
        assert velocity > 100.0
        pair.start("CamOut1")
        assert pair.state == "continuous_motion"
        assert pair.velocity == pytest.approx(velocity, rel=1e-2)
        released = pair.velocity
        pair.cycle()
        assert pair.says("CamIn1") == {"CommandAborted"}
        assert pair.says("CamOut1", "Done", "Error") == {"Done"}
        pair.cycle(100)
        assert pair.velocity == released
        pair.start("SlaveStop", Deceleration=1000.0)
        assert pair.state == "stopping"
        pair.until(lambda: pair.true("SlaveStop.Done"))
        pair.set("SlaveStop", Execute=False)
        pair.cycle(2)
        assert pair.state == "standstill"


def test_cam_out_without_a_coupling_is_an_error() -> None:
    with cam_pair() as pair:
        pair.start("CamOut1")
        assert pair.says("CamOut1") == {"Error"}
        assert pair.text("CamOut1.ErrorID") == "SMC_AXIS_NOT_READY_FOR_MOTION"
        assert pair.state == "standstill"


def test_another_command_on_the_slave_ends_the_coupling() -> None:
    with cam_pair() as pair:
        pair.select(1)
        pair.couple()
        pair.run(100.0)
        pair.cycle(500)
        position, velocity = pair.slave, pair.velocity
        pair.start("SlaveTo", Position=500.0, Velocity=50.0, Acceleration=500.0, Deceleration=500.0)
        assert pair.slave == pytest.approx(position + velocity * CYCLE, abs=1e-2)
        assert pair.says("CamIn1") == {"CommandAborted"}
        pair.until(lambda: pair.true("SlaveTo.Done"))
        assert pair.slave == 500.0


def test_outputs_last_one_cycle_without_execute() -> None:
    with cam_pair() as pair:
        pair.select(1)
        pair.couple()
        pair.set("CamIn1", Execute=False)
        pair.cycle(3)
        assert pair.says("CamIn1") == {"Busy", "Active", "InSync"}
        pair.start("SlaveHalt", Deceleration=100.0)
        assert pair.says("CamIn1") == {"CommandAborted"}
        pair.cycle()
        assert pair.says("CamIn1") == set()


@pytest.mark.parametrize("master_period", [0.0, 360.0, 90.0])
def test_a_rotary_master_drives_a_cam_longer_or_shorter_than_its_turn(master_period: float) -> None:
    with cam_pair(master_period=master_period) as pair:
        pair.select(1, slave_absolute=False)
        pair.couple()
        for _ in range(8):
            pair.step(60.0)
        assert pair.slave == pytest.approx(360.0 + 120.0, abs=1e-9)


def test_a_long_run_does_not_drift() -> None:
    """The position in the cam is that of the master after a million cycles of 0.1."""
    with cam_pair(LINE, master_period=360.0, slave_period=360.0) as pair:
        pair.select(1)
        pair.couple()
        pair.run(100.0)
        pair.cycle(1_000_000)
        difference = (pair.slave - pair.master + 180.0) % 360.0 - 180.0
        assert difference == pytest.approx(0.0, abs=1e-9)


def test_the_start_position_needs_no_coupling() -> None:
    """Spec motion_semantics CAM-17; the example of the catalog with test cam A."""
    with cam_pair(HALF) as pair:
        pair.select(1, master_absolute=False, slave_absolute=False)
        pair.place(40.0, 10.0)
        pair.set("StartPosition", Enable=True, MasterOffset=100.0)
        pair.cycle()
        assert pair.number("StartPosition.fStartPosition") == pytest.approx(108.59625, abs=1e-4)
        assert pair.says("StartPosition", "Busy", "Error") == {"Busy"}
        assert pair.state == "standstill"
        pair.set("StartPosition", MasterOffset=400.0)
        pair.cycle()
        assert pair.text("StartPosition.ErrorID") == "SMC_CI_MASTER_OUT_OF_SCALE"
        pair.set("StartPosition", Enable=False)
        pair.cycle()
        assert pair.says("StartPosition", "Busy", "Error") == set()

"""When MC_CamIn begins: by MasterStartDistance, behind other commands, and by the phase of the master."""

from __future__ import annotations

import pytest
from tests.libraries.cam_pair import (
    CYCLE,
    DEFAULT,
    cam_pair,
)

LINE = ((0, 0, 1, 0), (360, 360, 1, 0))


def test_master_start_distance_brings_the_slave_in_by_a_place_of_the_cam() -> None:
    """PLCopen: the slave goes on as before until the master is so near, and is in synchronism there."""
    with cam_pair(DEFAULT) as pair:
        pair.select(1)
        pair.place(0.0, 30.0)
        pair.run(100.0)
        pair.start("CamIn1", MasterStartDistance=80.0, MasterSyncPosition=120.0)
        assert pair.says("CamIn1") == {"Busy"}
        pair.until(lambda: pair.state == "synchronized_motion")
        assert pair.master == pytest.approx(40.0, abs=0.1 + 1e-9)
        before = 30.0
        for _ in pair.cycles_until("CamIn1.InSync"):
            assert abs(pair.slave - before) < 0.5
            before = pair.slave
        assert pair.master == pytest.approx(120.0, abs=0.2)
        assert pair.slave == pytest.approx(pair.master, abs=1e-9)
        assert pair.velocity == pytest.approx(100.0, rel=1e-6)


def test_a_command_while_the_master_comes_near_aborts() -> None:
    with cam_pair() as pair:
        pair.select(1)
        pair.run(10.0)
        pair.start("CamIn1", MasterStartDistance=20.0, MasterSyncPosition=120.0)
        pair.start("SlaveTo", Position=5.0, Velocity=50.0, Acceleration=500.0, Deceleration=500.0)
        pair.cycle()
        assert pair.says("CamIn1") == {"CommandAborted"}
        pair.set("CamIn1", Execute=False)
        pair.cycle()
        assert pair.says("CamIn1") == set()
        pair.until(lambda: pair.true("SlaveTo.Done"))


def test_a_buffered_cam_begins_behind_the_move_before_it() -> None:
    with cam_pair() as pair:
        pair.select(1)
        pair.place(60.0, 0.0)
        pair.start("SlaveTo", Position=41.25, Velocity=50.0, Acceleration=500.0, Deceleration=500.0)
        pair.couple(BufferMode=1)
        pair.cycle(10)
        assert pair.says("CamIn1") == {"Busy"}
        assert pair.state == "discrete_motion"
        pair.until(lambda: pair.true("SlaveTo.Done"))
        pair.cycle(2)
        assert pair.says("CamIn1") == {"Busy", "Active", "InSync"}
        assert pair.slave == pytest.approx(41.25, abs=1e-9)


def test_a_buffered_command_begins_at_the_end_of_the_profile() -> None:
    """Spec SEQ-05."""
    with cam_pair() as pair:
        pair.select(1)
        pair.couple()
        pair.run(100.0)
        pair.until(lambda: pair.true("CamIn1.EndOfProfile"))
        pair.cycle(100)
        pair.start(
            "SlaveTo", Position=50.0, Velocity=50.0, Acceleration=500.0, Deceleration=500.0, BufferMode=1
        )
        pair.cycle(10)
        assert pair.says("SlaveTo", "Busy", "Active") == {"Busy"}
        pair.until(lambda: pair.true("CamIn1.EndOfProfile"))
        pair.cycle(2)
        assert pair.says("SlaveTo", "Busy", "Active") == {"Busy", "Active"}
        assert pair.says("CamIn1", "Busy", "Active") == set()


def test_a_phase_shifts_where_the_slave_sees_its_master() -> None:
    """Spec ax3000 CAM-22, motion_semantics GEA-09: position and velocity go on without a step."""
    with cam_pair(LINE, master_period=360.0, slave_period=360.0) as pair:
        pair.select(1)
        pair.couple()
        pair.run(100.0)
        pair.cycle(100)
        pair.start("Phasing", PhaseShift=10.0, Velocity=20.0, Acceleration=100.0, Deceleration=100.0)
        before = pair.slave
        for _ in pair.cycles_until("Phasing.Done"):
            assert 80.0 - 1e-6 <= pair.velocity <= 100.0 + 1e-6
            assert (pair.slave - before) % 360.0 == pytest.approx(pair.velocity * CYCLE, abs=1e-3)
            before = pair.slave
        pair.cycle()
        assert (pair.master - pair.slave) % 360.0 == pytest.approx(10.0, abs=1e-9)
        assert pair.says("CamIn1") == {"Busy", "Active", "InSync"}

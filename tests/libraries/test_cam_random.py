"""Random commands to a master and a slave with cams: the PLCopen machine holds, and the slave never steps."""

from __future__ import annotations

import math
from contextlib import ExitStack

import pytest
from hypothesis import HealthCheck, Phase, settings
from hypothesis import strategies as st
from hypothesis.stateful import RuleBasedStateMachine, initialize, invariant, rule
from tests.libraries.cam_pair import (
    CYCLE,
    RAMP_IN,
    RAMP_IN_NEG,
    RAMP_IN_POS,
    RELATIVE,
    CamPair,
    cam_pair,
)
from tests.libraries.one_axis import STATES

CAM_BLOCKS = ("CamIn1", "CamIn2")
MOVES = {
    "SlaveTo": ("Done", "Busy", "CommandAborted", "Error"),
    "SlaveAt": ("InVelocity", "Busy", "CommandAborted", "Error"),
    "SlaveHalt": ("Done", "Busy", "CommandAborted", "Error"),
    "SlaveStop": ("Done", "Busy", "Error"),
}
TURN = 36.0
FIRST = ((0, 0, 0, 0), (18, 18, 1, 0), (36, 36, 1, 0))
SECOND = ((0, 0, 1, 0), (18, 18, 1, 0), (36, 36, 0, 0))
"""Short ones, so that cycles of the cam end often."""
ABSURD = (0.0, -1.0, math.nan, math.inf, 1e300, -1e300)
ROUNDING = 0.1
"""What a step may lie beyond the velocities before and behind it, which change meanwhile [u]."""
speeds = st.floats(1.0, 200.0)
ramps = st.floats(50.0, 1000.0)


class CamMachine(RuleBasedStateMachine):
    """A rotary slave by cams that gain whole turns, or a linear one by relative cams."""

    def __init__(self) -> None:
        super().__init__()
        self._stack = ExitStack()
        self.pair: CamPair
        self.before = (0.0, 0.0)
        self.slave_period = 0.0

    @initialize(master=st.sampled_from((0.0, TURN, 25.0)), slave=st.sampled_from((0.0, TURN)))
    def begin(self, master: float, slave: float) -> None:
        self.pair = self._stack.enter_context(cam_pair(FIRST, master, slave))
        self.slave_period = slave
        self.pair.give(2, SECOND)
        self.pair.set("Slave", fSWMaxDeceleration=1000.0)
        for cam in (1, 2):
            self.pair.select(cam, master_absolute=False, slave_absolute=False)
        self.before = (self.pair.slave, self.pair.velocity)

    def teardown(self) -> None:
        self._stack.close()

    @rule(cam=st.sampled_from((1, 2)), periodic=st.booleans(), absolute=st.booleans())
    def select(self, cam: int, periodic: bool, absolute: bool) -> None:
        block = f"Select{cam}"
        self.pair.set(block, Execute=False)
        self.step()
        self.pair.set(block, Periodic=periodic, SlaveAbsolute=absolute and self.slave_period > 0.0)
        self.pair.set(block, Execute=True)
        self.step()

    @rule(
        block=st.sampled_from(CAM_BLOCKS),
        cam=st.sampled_from((1, 2)),
        mode=st.sampled_from((RELATIVE, RAMP_IN, RAMP_IN_POS, RAMP_IN_NEG)),
        scaling=st.sampled_from((1.0, -1.0, 0.5, 2.0)),
        distance=st.sampled_from((0.0, 0.0, 0.0, 3.0)),
        buffered=st.sampled_from((0, 0, 0, 1)),
        velocity=st.floats(-200.0, 200.0),
        cycles=st.sampled_from((1, 300, 1000)),
    )
    def couple(
        self,
        block: str,
        cam: int,
        mode: int,
        scaling: float,
        distance: float,
        buffered: int,
        velocity: float,
        cycles: int,
    ) -> None:
        self._give_cam(int(block[-1]), cam)
        if velocity > -50.0:
            self.run_master(velocity, 1000.0, 1)
        self._start(
            block,
            StartMode=mode,
            MasterScaling=scaling,
            MasterStartDistance=distance,
            MasterSyncPosition=18.0,
            BufferMode=buffered,
            VelocityDiff=100.0,
            Acceleration=500.0,
            Deceleration=500.0,
        )
        self.wait(cycles)

    @rule(
        block=st.sampled_from(CAM_BLOCKS),
        name=st.sampled_from(
            ("MasterScaling", "SlaveScaling", "MasterOffset", "VelocityDiff", "Acceleration")
        ),
        value=st.sampled_from(ABSURD),
    )
    def absurd(self, block: str, name: str, value: float) -> None:
        usual = {"MasterScaling": 1.0, "SlaveScaling": 1.0, "MasterOffset": 0.0}
        usual |= {"VelocityDiff": 100.0, "Acceleration": 500.0}
        if name != "MasterScaling" or not value < 0.0:
            self._start(block, StartMode=RAMP_IN, **{**usual, name: value})
        self.pair.set(block, **usual)

    @rule(cam=st.sampled_from((1, 2)), number=st.sampled_from((1, 2)))
    def another_cam_from_the_next_cycle_on(self, cam: int, number: int) -> None:
        """Behind the end of a cam the next one begins where the master is: without ramp_in by a step."""
        self._give_cam(number, cam)
        self.step()

    def _give_cam(self, number: int, cam: int) -> None:
        self.pair.write(f"nCam{number}", cam)
        ended = self.pair.true(f"CamIn{number}.EndOfProfile")
        if ended and self.pair.text(f"CamIn{number}.fbCoupling.stStart.eMode") == "relative":
            self.pair.cycle()
            self.before = (self.pair.slave, self.pair.velocity)

    @rule(velocity=st.floats(-200.0, 200.0), up=ramps, cycles=st.sampled_from((30, 300, 2000)))
    def run_master(self, velocity: float, up: float, cycles: int) -> None:
        direction = 1 if velocity >= 0.0 else -1
        speed = max(1.0, abs(velocity))
        self._start("MasterAt", Velocity=speed, Acceleration=up, Deceleration=up, Direction=direction)
        self.wait(cycles)

    @rule(distance=st.floats(-100.0, 100.0), speed=speeds, up=ramps, cycles=st.sampled_from((1, 300)))
    def move_master(self, distance: float, speed: float, up: float, cycles: int) -> None:
        self._start("MasterBy", Distance=distance, Velocity=speed, Acceleration=up, Deceleration=up)
        self.wait(cycles)

    @rule(by=st.floats(-300.0, 300.0))
    def set_master(self, by: float) -> None:
        self._start("MasterSet", Position=by, Mode=True)

    @rule(
        shift=st.floats(-20.0, 20.0), speed=st.floats(1.0, 50.0), up=ramps, cycles=st.sampled_from((1, 100))
    )
    def shift_phase(self, shift: float, speed: float, up: float, cycles: int) -> None:
        self._start("Phasing", PhaseShift=shift, Velocity=speed, Acceleration=up, Deceleration=up)
        self.wait(cycles)

    @rule(
        block=st.sampled_from(("SlaveTo", "SlaveAt", "SlaveHalt")),
        where=st.floats(-50.0, 50.0),
        speed=speeds,
        up=ramps,
        buffered=st.sampled_from((0, 0, 1)),
        cycles=st.sampled_from((1, 30, 300)),
    )
    def move_slave(
        self, block: str, where: float, speed: float, up: float, buffered: int, cycles: int
    ) -> None:
        inputs: dict[str, float] = {"Deceleration": up}
        if block != "SlaveHalt":
            inputs |= {"Velocity": speed, "Acceleration": up, "BufferMode": buffered}
        if block == "SlaveTo":
            inputs["Position"] = where
        self._start(block, **inputs)
        self.wait(cycles)

    @rule(by=st.floats(-30.0, 30.0), speed=st.floats(1.0, 50.0), up=ramps, cycles=st.sampled_from((1, 100)))
    def superimpose(self, by: float, speed: float, up: float, cycles: int) -> None:
        self._start("SlaveSuper", Distance=by, VelocityDiff=speed, Acceleration=up, Deceleration=up)
        self.wait(cycles)

    @rule(up=ramps, cycles=st.sampled_from((1, 50)))
    def halt_superimposed(self, up: float, cycles: int) -> None:
        self._start("SlaveHaltSuper", Deceleration=up)
        self.wait(cycles)

    @rule(factor=st.sampled_from((0.0, 0.3, 1.0)), cycles=st.sampled_from((1, 50)))
    def override(self, factor: float, cycles: int) -> None:
        self.pair.set("SlaveOverride", Enable=True, VelFactor=factor)
        self.wait(cycles)

    @rule(up=ramps, cycles=st.sampled_from((1, 50, 200)))
    def stop_slave(self, up: float, cycles: int) -> None:
        self._start("SlaveStop", Deceleration=up)
        self.wait(cycles)
        self.pair.set("SlaveStop", Execute=False)
        self.step()

    @rule(cycles=st.sampled_from((1, 50)))
    def cam_out(self, cycles: int) -> None:
        self._start("CamOut1")
        self.wait(cycles)

    @rule(block=st.sampled_from((*CAM_BLOCKS, *MOVES, "CamOut1")))
    def let_go(self, block: str) -> None:
        self.pair.set(block, Execute=False)
        self.step()

    @rule()
    def reset(self) -> None:
        self._start("SlaveReset")

    @rule(cycles=st.sampled_from((1, 7, 50, 400)))
    def wait(self, cycles: int) -> None:
        for _ in range(cycles):
            self.step()

    def _start(self, block: str, **inputs: float) -> None:
        self.pair.set(block, Execute=False)
        self.step()
        self.pair.set(block, **inputs, Execute=True)
        self.step()

    def step(self) -> None:
        """One cycle: the slave moves by no more than its velocity before or behind it."""
        position, velocity = self.before
        self.pair.cycle()
        self.before = (self.pair.slave, self.pair.velocity)
        way = self.before[0] - position
        if self.slave_period:
            way = (way + self.slave_period / 2) % self.slave_period - self.slave_period / 2
        assert abs(way) <= (abs(velocity) + abs(self.before[1])) * CYCLE + ROUNDING

    @invariant()
    def machine_holds(self) -> None:
        if not hasattr(self, "pair"):
            return
        assert self.pair.state in STATES
        cams = {block: self.pair.says(block) for block in CAM_BLOCKS}
        for told in cams.values():
            assert len(told & {"Busy", "CommandAborted", "Error"}) <= 1
            assert "Busy" in told or not told & {"InSync", "Active"}
            assert "Active" in told or "InSync" not in told
        moves = {block: self.pair.says(block, *outputs) for block, outputs in MOVES.items()}
        for told in moves.values():
            assert len(told & {"Done", "CommandAborted", "Error"}) <= 1
        active = [block for block, told in cams.items() if "Active" in told]
        assert len(active) <= 1
        if self.pair.state == "synchronized_motion":
            assert any(told & {"Busy", "Error"} for told in cams.values())
        elif self.pair.state in ("standstill", "power_off"):
            assert self.pair.velocity == 0.0
            assert not active


CamMachine.TestCase.settings = settings(
    max_examples=25,
    stateful_step_count=25,
    deadline=None,
    phases=[Phase.generate],
    suppress_health_check=list(HealthCheck),
)
TestRandomCams = CamMachine.TestCase


@pytest.mark.slow
class TestManyRandomCams(CamMachine.TestCase):  # type: ignore[name-defined,misc]
    settings = settings(CamMachine.TestCase.settings, max_examples=400, stateful_step_count=40)

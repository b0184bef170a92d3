"""Random commands to one axis, absurd values among them: the PLCopen machine holds, and nothing jumps."""

from __future__ import annotations

from contextlib import ExitStack
from typing import Any

import pytest
from hypothesis import HealthCheck, Phase, settings
from hypothesis import strategies as st
from hypothesis.stateful import RuleBasedStateMachine, initialize, invariant, rule
from tests.libraries.one_axis import CYCLE, STATES, OneAxis, one_axis

MOVES = ("Absolute", "Relative", "Additive", "Velocity", "Halt", "Stop")
BLOCKS = tuple(f"{name}{number}" for name in MOVES for number in (1, 2))
SUPERIMPOSED = ("Super1", "Super2")
MOTIONS = tuple(block for block in BLOCKS if not block.startswith("Stop"))
WITH_ACTIVE = tuple(block for block in BLOCKS if not block.startswith(("Halt", "Stop")))
FASTEST = 200.0
STEEPEST = 1000.0
"""Acceleration of a command; a superimposed motion comes besides."""
RAMP_TYPES = {"trapez": 0, "sin2": 1, "quadratic": 2, "quadratic_smooth": 3}

speeds = st.floats(1.0, FASTEST)
ramps = st.floats(50.0, STEEPEST)
ABSURD = (0.0, -1.0, float("nan"), float("inf"), 1e300, -1e300)


class AxisMachine(RuleBasedStateMachine):
    """One axis with two of each block."""

    def __init__(self) -> None:
        super().__init__()
        self._stack = ExitStack()
        self.axis: OneAxis
        self.before = (0.0, 0.0)
        self.period = 0.0

    @initialize(ramp=st.sampled_from(sorted(RAMP_TYPES)), rotary=st.booleans())
    def begin(self, ramp: str, rotary: bool) -> None:
        self.axis = self._stack.enter_context(one_axis())
        self.axis.set("Axis", eRampType=RAMP_TYPES[ramp], iMovementType=0 if rotary else 1)
        self.axis.set("Axis", fSWMaxDeceleration=STEEPEST)
        self.period = 360.0 if rotary else 0.0
        self.before = (self.axis.position, self.axis.velocity)

    def teardown(self) -> None:
        self._stack.close()

    @rule(
        block=st.sampled_from(MOTIONS),
        where=st.floats(-500.0, 500.0),
        speed=speeds,
        up=ramps,
        down=ramps,
        jerk=st.sampled_from((500.0, 5000.0)),
        mode=st.integers(0, 5),
        direction=st.sampled_from((-1, 0, 1, 2, 3)),
        cycles=st.sampled_from((1, 30, 300)),
    )
    def command(self, block: str, cycles: int, **values: Any) -> None:
        self._command(block, values)
        self.wait(cycles)

    @rule(
        block=st.sampled_from(BLOCKS),
        name=st.sampled_from(("where", "speed", "up", "down", "jerk")),
        value=st.sampled_from(ABSURD),
    )
    def absurd(self, block: str, name: str, value: float) -> None:
        values = {"where": 10.0, "speed": 50.0, "up": 100.0, "down": 100.0, "jerk": 1000.0}
        self._command(block, {**values, "mode": 0, "direction": 1, name: value})

    def _command(self, block: str, values: dict[str, Any]) -> None:
        inputs: dict[str, float] = {"Deceleration": values["down"], "Jerk": values["jerk"]}
        if not block.startswith(("Halt", "Stop")):
            inputs |= {
                "Velocity": values["speed"],
                "Acceleration": values["up"],
                "BufferMode": values["mode"],
            }
        if block.startswith("Absolute"):
            inputs["Position"] = values["where"]
        if block.startswith(("Relative", "Additive")):
            inputs["Distance"] = values["where"]
        if block.startswith(("Absolute", "Velocity")):
            inputs["Direction"] = values["direction"]
        self.axis.set(block, Execute=False)
        self.step()
        self.axis.set(block, **inputs, Execute=True)
        self.step()

    @rule(block=st.sampled_from(("Stop1", "Stop2")), down=ramps, cycles=st.sampled_from((1, 50, 400)))
    def stop(self, block: str, down: float, cycles: int) -> None:
        self._command(block, {"down": down, "jerk": 1000.0})
        self.wait(cycles)
        self.axis.set(block, Execute=False)
        self.step()

    @rule(
        block=st.sampled_from(SUPERIMPOSED),
        by=st.floats(-100.0, 100.0),
        speed=st.floats(1.0, 50.0),
        up=ramps,
        down=ramps,
        cycles=st.sampled_from((1, 30, 300)),
    )
    def superimpose(self, block: str, by: float, speed: float, up: float, down: float, cycles: int) -> None:
        self.axis.set(block, Execute=False)
        self.step()
        self.axis.set(block, Distance=by, VelocityDiff=speed, Acceleration=up, Deceleration=down, Jerk=5000.0)
        self.axis.set(block, Execute=True)
        self.step()
        self.wait(cycles)

    @rule(down=ramps, cycles=st.sampled_from((1, 100)))
    def halt_superimposed(self, down: float, cycles: int) -> None:
        self.axis.set("HaltSuper1", Execute=False)
        self.step()
        self.axis.set("HaltSuper1", Deceleration=down, Jerk=5000.0, Execute=True)
        self.step()
        self.wait(cycles)

    @rule(
        velocity=st.sampled_from((0.0, 0.2, 1.0)),
        ramp=st.sampled_from((0.3, 1.0)),
        jerk=st.sampled_from((0.5, 1.0)),
        cycles=st.sampled_from((1, 100)),
    )
    def override(self, velocity: float, ramp: float, jerk: float, cycles: int) -> None:
        self.axis.set("Override", Enable=True, VelFactor=velocity, AccFactor=ramp, JerkFactor=jerk)
        self.wait(cycles)

    @rule(block=st.sampled_from(MOTIONS))
    def let_go(self, block: str) -> None:
        self.axis.set(block, Execute=False)
        self.step()

    @rule(cycles=st.sampled_from((1, 7, 50, 400)))
    def wait(self, cycles: int) -> None:
        """No command is given meanwhile: one is aborted by one that waited for its turn, or by an error.

        A block that is called before the one of the new command sees a cycle later that it is aborted.
        """
        self.step()
        before = self._told()
        waits = any("Busy" in before[block] and "Active" not in before[block] for block in WITH_ACTIVE)
        for _ in range(cycles - 1):
            self.step()
        after = self._told()
        aborted = [block for block in after if "CommandAborted" in after[block] - before[block]]
        assert not aborted or waits or self.axis.state == "errorstop"

    def _told(self) -> dict[str, set[str]]:
        return {block: self.axis.outputs(block) for block in (*BLOCKS, *SUPERIMPOSED)}

    @rule(by=st.floats(-100.0, 100.0))
    def set_position(self, by: float) -> None:
        self.axis.set("SetPosition1", Execute=False)
        self.step()
        self.axis.set("SetPosition1", Execute=True, Mode=True, Position=by)
        self.step(shifted=self.axis.state != "errorstop", by=by)

    @rule()
    def reset(self) -> None:
        self.axis.set("Reset1", Execute=False)
        self.step()
        self.axis.set("Reset1", Execute=True)
        self.step()

    def step(self, shifted: bool = False, by: float = 0.0) -> None:
        """One cycle: position and velocity go on from what they were."""
        position, velocity = self.before
        self.axis.cycle()
        self.before = (self.axis.position, self.axis.velocity)
        way = self.before[0] - position - (by if shifted else 0.0)
        if self.period:
            way = (way + self.period / 2) % self.period - self.period / 2
        steepest = 2 * STEEPEST * CYCLE * 1.001
        assert abs(self.before[1] - velocity) <= steepest + 1e-9
        assert abs(way - (velocity + self.before[1]) / 2 * CYCLE) <= steepest * CYCLE + 1e-9

    @invariant()
    def machine_holds(self) -> None:
        if not hasattr(self, "axis"):
            return
        assert self.axis.state in STATES
        outputs: dict[str, set[str]] = {
            block: self.axis.outputs(block) for block in (*BLOCKS, *SUPERIMPOSED, "HaltSuper1")
        }
        for told in outputs.values():
            assert len(told & {"Done", "CommandAborted", "Error"}) <= 1
            assert not ("Busy" in told and told & {"CommandAborted", "Error"})
        if self.axis.state in ("discrete_motion", "continuous_motion"):
            assert any(told & {"Busy", "Error"} for told in outputs.values())
        if self.axis.state in ("standstill", "power_off"):
            assert self.axis.velocity == 0.0


AxisMachine.TestCase.settings = settings(
    max_examples=25,
    stateful_step_count=25,
    deadline=None,
    phases=[Phase.generate],
    suppress_health_check=list(HealthCheck),
)
TestRandomCommands = AxisMachine.TestCase


@pytest.mark.slow
class TestManyRandomCommands(AxisMachine.TestCase):  # type: ignore[name-defined,misc]
    settings = settings(AxisMachine.TestCase.settings, max_examples=400, stateful_step_count=40)

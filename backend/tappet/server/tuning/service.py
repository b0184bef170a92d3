"""Has the panel of an axis measure, and records each cycle of its bus task meanwhile."""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable, Callable
from contextlib import suppress
from dataclasses import dataclass

from tappet.codegen.symbol_map import SymbolError
from tappet.motion.axis_measurement import AxisFacts, AxisMeasurement, NoPositionLoopError, RefusedStepError
from tappet.motion.loops import Excitation
from tappet.runtime.client import RuntimeRefused
from tappet.runtime.operations.axis_panel import Action, KeepAxis, SteerAxis
from tappet.runtime.operations.values import Read
from tappet.runtime.recorder import Frame
from tappet.server.problems import Problem
from tappet.server.runtimes.links import RuntimeLink
from tappet.server.runtimes.plc_client import PlcClient, Recorder

BEGIN_S = 3.0
"""How long the bus task may take to begin."""
END_S = 60.0
"""How long the way back may take, behind the duration of the answer."""


@dataclass(frozen=True, slots=True)
class Measuring:
    """What was ordered."""

    holder: int
    excitation: Excitation
    height: float
    duration_s: float


class MeasuredAxis:
    """An axis of the application that is loaded in a runtime."""

    def __init__(self, link: RuntimeLink, axis: str) -> None:
        """Raises problems: 404 when there is no such axis, 409 when nothing closes a loop."""
        self.name = axis
        self._link = link
        self._code_id = link.code_id
        """Of the application whose places these are: in another one they are those of other variables."""
        try:
            self._measurement = AxisMeasurement(link.loaded_symbols(), axis)
        except SymbolError:
            text = f"The application in the runtime has no axis '{axis}'; load it with the axis first."
            raise Problem(404, "not-found", text) from None
        except NoPositionLoopError as error:
            raise Problem(409, "no-position-loop", f"{error}.") from error
        self.layout = self._measurement.layout

    async def facts(self) -> AxisFacts:
        """As they are now."""
        async with self._link.client() as client:
            read: list[bytes] = await client.call(Read(self._measurement.fact_places, self._code_id))
        return self._measurement.facts(read)

    async def measure(
        self, order: Measuring, facts: AxisFacts, begin: Callable[[], Awaitable[None]]
    ) -> list[Frame]:
        """The frames of the measurement; `begin` is called right before the axis moves.

        Raises 409 problems when it is refused or interrupted, and those of the runtime.
        """
        try:
            facts.check(order.height, order.excitation)
        except RefusedStepError as error:
            raise Problem(409, "measurement-refused", f"{error}.") from error
        async with self._link.client() as client:
            await self._check_control(client, order.holder)
            recorder = await client.record(
                self._measurement.recorded_places, facts.bus_task, 1, 0, code_id=self._code_id
            )
            try:
                await begin()
                action: Action = "measure_step" if order.excitation == "step" else "measure_move"
                await client.call(
                    SteerAxis(
                        self.name, order.holder, action, position=order.height, duration=order.duration_s
                    )
                )
                frames = await self._frames(recorder, order.duration_s)
            finally:
                with suppress(OSError, RuntimeRefused):
                    await recorder.close()
            await self._check_end(client, order.holder, began=bool(frames))
        return frames

    async def _frames(self, recorder: Recorder, duration_s: float) -> list[Frame]:
        """From the first cycle of the measurement to its last one; empty when it does not begin."""
        frames: list[Frame] = []
        try:
            async with asyncio.timeout(BEGIN_S) as patience:
                async for frame in recorder:
                    idle = self._measurement.phase(frame.data) == "Idle"
                    if idle and frames:
                        break
                    if not idle:
                        if not frames:
                            patience.reschedule(asyncio.get_running_loop().time() + duration_s + END_S)
                        frames.append(frame)
        except TimeoutError:
            if frames:
                text = "The axis does not come to the end of its measurement; stop it and look at its state."
                raise Problem(409, "measurement-interrupted", text) from None
        return frames

    async def _check_control(self, client: PlcClient, holder: int) -> None:
        status = await client.call(KeepAxis(self.name, holder))
        if status.state != "Control" or status.holder != holder:
            text = f"You have no control of the axis '{self.name}'; take control of it first."
            raise Problem(409, "no-control", text)

    async def _check_end(self, client: PlcClient, holder: int, *, began: bool) -> None:
        """Raises problems unless the measurement came to its end."""
        status = await client.call(KeepAxis(self.name, holder))
        read: list[bytes] = await client.call(Read(self._measurement.end_places, self._code_id))
        done, error = self._measurement.end(read)
        if done and began:
            return
        if status.state != "Control" or status.holder != holder:
            text = "Control of the axis was lost during the measurement; the axis was stopped."
        elif error != "SMC_NO_ERROR":
            text = (
                f"The measurement ended by the error {error} of the axis; the axis rests where it was then."
            )
        else:
            text = "The measurement was stopped; the axis rests where it was then."
        raise Problem(409, "measurement-interrupted", text, error=error)

"""The debugger of a soft PLC: what operations ask for, and what happens to it when the application changes.

Contract: breakpoints and settings belong to the runtime and outlive applications; halts and the instrumented
variant belong to the loaded one. Tasks run the variant while a breakpoint is enabled, a task is halted or a
pause is asked for, else the normal code. All methods may be called from any thread.
"""

from __future__ import annotations

import time
from typing import TYPE_CHECKING

from msgspec.structs import replace

from tappet.codegen.debug_code import DebugCode
from tappet.codegen.package import PackageError
from tappet.codegen.values import Value
from tappet.runtime.contexts import RUNNING, STOPPED
from tappet.runtime.debugger import frames, kept, log_points, stacks, stepping
from tappet.runtime.debugger.breakpoints import MOST, BreakpointTable, Wanted, check_order
from tappet.runtime.debugger.flow_control import FlowControl
from tappet.runtime.debugger.next_statement import next_statement
from tappet.runtime.debugger.places import code_spot
from tappet.runtime.debugger.shapes import (
    Breakpoint,
    BreakpointOrder,
    Command,
    DebugState,
    FlowSnapshot,
    Halt,
    Reason,
    Settings,
    Spot,
    Stack,
    Variable,
    Variables,
)
from tappet.runtime.debugger.variant import Variant
from tappet.runtime.errors import DebugError, UnknownBreakpointError
from tappet.runtime.link import LinkError

if TYPE_CHECKING:
    from tappet.runtime.plc_state import PlcState

_REASONS: dict[int, Reason] = {1: "breakpoint", 2: "step", 3: "pause", 4: "data", 5: "run_to"}


class Debugger:
    """One per soft PLC, which serialises the calls by its lock."""

    def __init__(self, plc: PlcState) -> None:
        self._plc = plc
        self._lock = plc.lock
        self._settings = Settings()
        self._wanted: dict[int, Wanted] = {}
        self._last_id = 0
        self._last_step = 0
        self._sequence = 0
        self._halts = 0
        self._kept_active = False
        self._flow = FlowControl()
        self._restore()

    def _restore(self) -> None:
        """What an earlier process has kept; the PLC has no application yet."""
        found = kept.load(self._plc.folder, self._plc.log)
        self._settings = found.settings
        for order in found.breakpoints:
            self._last_id += 1
            self._wanted[self._last_id] = Wanted(self._last_id, order)

    def _keep(self) -> None:
        orders = [wanted.order for wanted in self._shown()]
        kept.save(self._plc.folder, self._settings, orders, self._plc.log)

    # -- state ---------------------------------------------------------------------------------------

    @property
    def variant(self) -> Variant | None:
        """The instrumented variant of the loaded application, if there is one."""
        application = self._plc.application
        return application.variant if application is not None else None

    @property
    def sequence(self) -> int:
        """Grows with every change of the state."""
        return self._sequence

    def halted_tasks(self) -> tuple[str, ...]:
        """Names of the tasks that stand at a statement."""
        variant = self.variant
        if variant is None:
            return ()
        names = [task.name for task in variant.application.package.tasks]
        return tuple(names[i] for i in variant.halted())

    def state(self) -> DebugState:
        """Breakpoints, settings and halts as of now."""
        with self._lock:
            self.poll()
            variant = self.variant
            halts = [] if variant is None else [self._halt(variant, i) for i in variant.halted()]
            return DebugState(
                available=variant is not None,
                active=variant is not None and variant.active,
                sequence=self._sequence,
                settings=self._settings,
                halted=[halt for halt in halts if halt is not None],
                breakpoints=[w.shown(variant) for w in self._shown()],
            )

    def _shown(self) -> list[Wanted]:
        return [wanted for wanted in self._wanted.values() if wanted.kind == "halt"]

    def _halt(self, variant: Variant, task: int) -> Halt | None:
        debug = variant.tasks[task]
        stack = frames.stack_of_halted(variant, task)
        if not stack.activations:
            return None
        here = stack.activations[0]
        reason = _REASONS.get(debug["reason"], "pause")
        hit = self._wanted.get(debug["breakpoint"]) if reason in ("breakpoint", "data") else None
        message = None
        if hit is not None and hit.order.kind == "data":
            message = f"'{hit.order.expression}' has changed before this statement"
        return Halt(
            variant.application.package.tasks[task].name,
            variant.application.contexts.tasks[task]["cycle"],
            reason,
            code_spot(variant.application.package.source_maps, here.function, here.site),
            hit.id if hit is not None else None,
            frames.FrameValues(variant, stack, here).instance(),
            message,
        )

    def poll(self) -> None:
        """Look for halts that came from the tasks, and tell listeners. The service of the PLC calls this."""
        with self._lock:
            variant = self.variant
            halts = variant.context["halts"] if variant is not None else 0
            if self._flow.expired() and variant is not None:
                self._flow.place(variant)
                self._direct()
            if variant is not None:
                log_points.collect(variant, self._wanted, self._plc.log)
            idle = variant is not None and variant.active and not self._needs(variant)
            if halts == self._halts and not idle:
                return
            self._halts = halts
            if variant is not None and variant.any_halted:
                for wanted in [w for w in self._wanted.values() if w.kind == "run_to"]:
                    del self._wanted[wanted.id]
            self._changed()

    def _changed(self) -> None:
        self._sequence += 1
        self._direct()
        self._plc.announce("debug")

    # -- the instrumented variant --------------------------------------------------------------------

    def load(self, data: bytes) -> DebugState:
        """Link the variant of the loaded application. Raises PlcError when it is that of another one."""
        try:
            code = DebugCode.from_bytes(data)
        except PackageError as error:
            raise DebugError(f"the instrumented variant was refused: {error}") from error
        with self._lock:
            application = self._plc.loaded()
            if code.code_id != application.package.code_id:
                raise DebugError("the instrumented variant is that of another application")
            if application.variant is None:
                try:
                    variant = application.variant = Variant(application, code)
                except (LinkError, OSError) as error:
                    raise DebugError(f"the instrumented variant was refused: {error}") from error
                self._halts = 0
                for wanted in self._wanted.values():
                    wanted.place(variant)
                self._flow.place(variant)
                self._changed()
            return self.state()

    def dropped(self) -> None:
        """The application has become another one: nothing is placed any more."""
        self._halts = 0
        self._flow.dropped()
        for wanted in list(self._wanted.values()):
            wanted.sites, wanted.watched = [], None
            wanted.reason = "the instrumented variant of the application is not loaded"
            if wanted.kind == "run_to":
                del self._wanted[wanted.id]
        if self._sequence:  # somebody has debugged
            self._sequence += 1
            self._plc.announce("debug")

    def _needs(self, variant: Variant) -> bool:
        """Whether tasks have to run the variant."""
        asked = self._kept_active or bool(self._flow.objects) or variant.any_halted or variant.any_wanted
        return asked or any(w.active for w in self._wanted.values())

    def keep_active(self, wanted: bool) -> None:
        """Whether tasks run the variant although nothing is to halt."""
        with self._lock:
            self._kept_active = wanted
            self._changed()

    def _direct(self) -> None:
        """Let tasks know the breakpoints, and run the code that is needed."""
        variant = self.variant
        if variant is None:
            return
        application = variant.application
        table = BreakpointTable(variant, self._wanted.values())
        application.tasks.publish(variant.context.place("pTable"), table.address, table)
        variant.context["haltOthers"] = int(self._settings.other_tasks == "halt")
        variant.context["safeOutputs"] = int(self._settings.outputs == "safe")
        needed = self._needs(variant)
        variant.arm(table.sites, table.watches, self._flow.armed)
        if needed and not variant.active:
            variant.activate()
        elif not needed and variant.active:
            variant.deactivate()

    # -- breakpoints and settings --------------------------------------------------------------------

    def set_settings(self, settings: Settings) -> DebugState:
        """What happens around halted tasks from their next halt on."""
        with self._lock:
            self._settings = settings
            self._keep()
            self._changed()
            return self.state()

    def add(self, order: BreakpointOrder) -> Breakpoint:
        """A new breakpoint."""
        with self._lock:
            if len(self._wanted) >= MOST:
                raise DebugError(f"there are {MOST} breakpoints already; remove some")
            wanted = self._place(order, "halt")
            self._keep()
            self._changed()
            return wanted.shown(self.variant)

    def _place(self, order: BreakpointOrder, kind: str) -> Wanted:
        check_order(order)
        self._last_id += 1
        wanted = self._wanted[self._last_id] = Wanted(self._last_id, order, kind)
        variant = self.variant
        if variant is not None:
            wanted.place(variant)
        return wanted

    def change(self, number: int, order: BreakpointOrder) -> Breakpoint:
        """Replace a breakpoint; its hits count from 0."""
        with self._lock:
            self._find(number)
            wanted = self._wanted[number] = Wanted(number, order)
            variant = self.variant
            if variant is not None:
                wanted.place(variant)
            self._keep()
            self._changed()
            return wanted.shown(variant)

    def enable(self, enabled: bool) -> DebugState:
        """Enable or disable all breakpoints; their hits go on counting."""
        with self._lock:
            for wanted in self._shown():
                wanted.order = replace(wanted.order, enabled=enabled)
            self._keep()
            self._changed()
            return self.state()

    def remove(self, number: int | None) -> None:
        """Remove a breakpoint; all with None."""
        with self._lock:
            if number is None:
                self._wanted.clear()
            else:
                self._find(number)
                del self._wanted[number]
            self._keep()
            self._changed()

    def _find(self, number: int) -> Wanted:
        found = self._wanted.get(number)
        if found is None:
            raise UnknownBreakpointError(f"there is no breakpoint {number}")
        return found

    # -- control -------------------------------------------------------------------------------------

    def control(self, command: Command, task: str | None = None, spot: Spot | None = None) -> DebugState:
        """Halt, go on or step. Raises DebugError when that is not possible now."""
        if command in ("run_to", "next_statement") and spot is None:
            raise ValueError(f"{command} needs a place")
        stepped: int | None = None
        with self._lock:
            variant = self._need()
            if command == "pause":
                stepping.ask_to_pause(variant, task)
                self._changed()
            elif command == "continue":
                halted = variant.halted() if task is None else [stepping.halted_task(variant, task)]
                if not halted:
                    raise DebugError("no task is halted")
                self._go_on(variant, halted)
            elif command == "single_cycle":
                self._end_cycle(variant)
            else:
                stepped = stepping.halted_task(variant, task)
                self._step(variant, command, stepped, spot)
        if stepped is not None:
            self._await_halt(variant, stepped)
        return self.state()

    def _need(self) -> Variant:
        self._plc.loaded()
        variant = self.variant
        if variant is None:
            raise DebugError("the instrumented variant of the application is not loaded")
        return variant

    def _go_on(self, variant: Variant, tasks: list[int], mode: int = stepping.RUN) -> None:
        stepping.order(variant, tasks, mode)
        self._direct()
        stepping.resume(variant, tasks)

    def _end_cycle(self, variant: Variant) -> None:
        halted = variant.halted()
        if not halted:
            raise DebugError("no task is halted; a stopped application runs a single cycle")
        if variant.application.tasks.state == RUNNING:
            variant.application.tasks.set_state(STOPPED)
        self._go_on(variant, halted)
        self._plc.announce("state")

    def _step(self, variant: Variant, command: Command, task: int, spot: Spot | None) -> None:
        mode = stepping.RUN
        if command == "run_to":
            assert spot is not None
            wanted = self._place(BreakpointOrder(place=spot), "run_to")
            if wanted.reason is not None:
                del self._wanted[wanted.id]
                raise DebugError(wanted.reason)
        elif command == "step_into":
            mode = stepping.INTO
        elif command == "next_statement":
            assert spot is not None
            variant.tasks[task]["jump"] = 1 + next_statement(variant, task, spot)
            mode = stepping.INTO
        else:
            mode = stepping.FRAMES
            self._last_step = self._last_step % 0x7FFF_FFFF + 1
            stepping.mark_frames(variant, task, command, self._last_step)
        self._go_on(variant, [task], mode)

    def _await_halt(self, variant: Variant, task: int) -> None:
        end = time.monotonic() + stepping.STEP_PATIENCE_S
        while time.monotonic() < end:
            with self._lock:
                if self.variant is not variant or task in variant.halted():
                    return
            time.sleep(0.001)

    # -- flow control --------------------------------------------------------------------------------

    def set_flow(self, objects: list[str], holder: str = "") -> None:
        """Record which statements of these objects each cycle executes; of none with an empty list. A named
        holder keeps that by reading."""
        with self._lock:
            variant = self._need() if objects else self.variant
            self._flow.hold(holder, objects)
            if variant is not None:
                self._flow.place(variant)
            self._changed()

    def flow(self, object_id: str, holder: str = "") -> FlowSnapshot:
        """What a cycle has executed of an object under flow control."""
        with self._lock:
            return self._flow.snapshot(object_id, holder)

    # -- stacks --------------------------------------------------------------------------------------

    def stack(self, task: str) -> Stack:
        """The call stack of a halted task, or of one that a fault in instrumented code has ended."""
        with self._lock:
            return stacks.shown(self._need(), task)

    def variables(self, task: str, frame: int) -> Variables:
        """The variables of a level of a call stack."""
        with self._lock:
            return Variables(stacks.level(self._need(), task, frame).all())

    def write(self, task: str, frame: int, name: str, value: Value) -> Variable:
        """Write a local variable of a halted task. ValueError for a wrong name or value."""
        with self._lock:
            return stacks.level(self._need(), task, frame).write(name, value)

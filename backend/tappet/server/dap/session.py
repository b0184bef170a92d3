"""One debug session: the requests of an editor carried out on a debuggee, and what happens there as events.

Threads of the protocol are tasks. `stepBack` and `reverseContinue` go through the cycles of the flight
recorder: what is shown then are the values of a past cycle, and going on leads back to the present.
"""

from __future__ import annotations

import asyncio
import contextlib
from collections.abc import Awaitable, Callable
from functools import partial
from typing import Any

from tappet.server.dap import messages as m
from tappet.server.dap.breakpoints import Breakpoints
from tappet.server.dap.connection import Connection, Handler, Send
from tappet.server.dap.debuggee import ApplicationReplaced, Command, Debuggee, Halt, Refused, State
from tappet.server.dap.inspection import Inspection
from tappet.server.dap.view import View
from tappet.translation.language import language_of

Begin = Callable[[m.Launch | m.Attach, Callable[[str], Awaitable[None]]], Awaitable[Debuggee]]
"""Builds and loads; what it prints meanwhile goes to the second argument. Raises Refused."""

CAPABILITIES = {
    "supportsConfigurationDoneRequest": True,
    "supportsConditionalBreakpoints": True,
    "supportsHitConditionalBreakpoints": True,
    "supportsLogPoints": True,
    "supportsDataBreakpoints": True,
    "supportsStepBack": True,
    "supportsSetVariable": True,
    "supportsSetExpression": True,
    "supportsEvaluateForHovers": True,
    "supportsGotoTargetsRequest": True,
    "supportsExceptionInfoRequest": True,
    "supportsSingleThreadExecutionRequests": True,
    "supportTerminateDebuggee": True,
    "supportsTerminateRequest": True,
    "supportsDelayedStackTraceLoading": True,
    "supportsVariablePaging": True,
}
_LOG_POLL_S = 0.5
"""The log of a runtime has no events; all else has."""
_REASONS = {"breakpoint": "breakpoint", "step": "step", "pause": "pause", "data": "data breakpoint",
            "run_to": "step", "exception": "exception"}  # fmt: skip


class DebugSession:
    """A client and its debuggee. Made in the event loop that serves it."""

    def __init__(self, send: Send, begin: Begin) -> None:
        self._begin = begin
        self._connection = Connection(send)
        self._view = View()
        self._breakpoints = Breakpoints(self._view)
        self._handlers = self._own() | self._breakpoints.handlers() | Inspection(self._view).handlers()
        self._goto_places: list[tuple[str, int]] = []
        self._stop_on_entry = False
        self._values: dict[str, object] = {}
        self._shown: dict[str, tuple[int, Halt]] = {}
        self._changed = asyncio.Event()
        self._following: asyncio.Task[None] | None = None
        self._own_application = False
        self.ended = asyncio.Event()
        """The client has gone, or asked to end."""

    def _own(self) -> dict[str, Handler]:
        return {
            "initialize": self._initialize,
            "launch": self._launch,
            "attach": self._attach,
            "configurationDone": self._configuration_done,
            "disconnect": self._disconnect,
            "terminate": self._terminate,
            "threads": self._threads,
            "continue": self._continue,
            "next": partial(self._move, "step_over"),
            "stepIn": partial(self._move, "step_into"),
            "stepOut": partial(self._move, "step_out"),
            "pause": self._pause,
            "gotoTargets": self._goto_targets,
            "goto": self._goto,
            "stepBack": partial(self._go_back, 1),
            "reverseContinue": partial(self._go_back, None),
        }

    async def receive(self, text: str) -> None:
        """Carry one request out. Never raises for what it says."""
        try:
            done = await self._connection.serve(text, self._handlers)
        except ConnectionError as error:
            await self._gone(error)
            return
        if done is None:
            return
        if done.command in ("launch", "attach"):
            await self._connection.event("initialized", {})
        elif done.command == "disconnect":
            self.ended.set()

    async def close(self) -> None:
        """The client has gone."""
        if self._following is not None:
            self._following.cancel()
            with contextlib.suppress(asyncio.CancelledError):
                await self._following
            self._following = None
        debuggee, self._view.debuggee = self._view.debuggee, None
        if debuggee is not None:
            with contextlib.suppress(Refused, ConnectionError):
                await debuggee.close(terminate=self._own_application)

    # -- begin and end -----------------------------------------------------------------------------------

    async def _initialize(self, request: m.Request) -> Any:
        self._view.initialize = given = m.arguments_as(m.Initialize, request)
        self._connection.language = self._view.language = language_of(given.locale)
        return CAPABILITIES

    async def _launch(self, request: m.Request) -> None:
        wanted = m.arguments_as(m.Launch, request)
        self._own_application = True
        self._stop_on_entry = wanted.stop_on_entry and not wanted.no_debug
        self._values = dict(wanted.values)
        await self._begin_with(wanted)

    async def _attach(self, request: m.Request) -> None:
        await self._begin_with(m.arguments_as(m.Attach, request))

    async def _begin_with(self, wanted: m.Launch | m.Attach) -> None:
        if self._view.debuggee is not None:
            raise Refused("This session debugs an application already")
        self._view.debuggee = await self._begin(wanted, partial(self._connection.output, category="stderr"))
        self._view.debuggee.on_change(self._changed.set)

    async def _configuration_done(self, _request: m.Request) -> None:
        await self._view.need().start(self._values, halt=self._stop_on_entry)
        self._following = asyncio.create_task(self._follow(), name="debug events")

    async def _disconnect(self, request: m.Request) -> None:
        given = m.arguments_as(m.Disconnect, request)
        if given.terminate_debuggee is not None:
            self._own_application = given.terminate_debuggee
        await self.close()

    async def _terminate(self, _request: m.Request) -> None:
        if self._own_application:
            await self.close()
        await self._connection.event("terminated", {})

    async def _gone(self, error: ConnectionError) -> None:
        debuggee, self._view.debuggee = self._view.debuggee, None
        if debuggee is None:
            return
        replaced = isinstance(error, ApplicationReplaced)
        text = "The runtime runs another application now: attach again" if replaced else "The runtime is gone"
        await self._connection.output(text, "stderr")
        await self._connection.event("terminated", {})
        with contextlib.suppress(Refused, ConnectionError):
            await debuggee.close(terminate=False)

    # -- what happens ------------------------------------------------------------------------------------

    async def _follow(self) -> None:
        """Tell the client of every halt, exception and line of the log, until the session is closed."""
        changed = True
        while self._view.debuggee is not None:
            self._changed.clear()
            try:
                for severity, line in await self._view.debuggee.log_lines():
                    category = "stderr" if severity in ("error", "exception") else "console"
                    await self._connection.output(line, category)
                if changed:
                    await self._tell(await self._view.debuggee.state())
                    changed = False
            except ConnectionError as error:
                await self._gone(error)
                return
            except Refused as error:
                await self._connection.output(str(error), "stderr")
            with contextlib.suppress(TimeoutError):
                async with asyncio.timeout(_LOG_POLL_S):
                    changed = await self._changed.wait()

    async def _tell(self, state: State) -> None:
        """Events for what has changed since the last call."""
        if self._view.at is not None:
            return
        before = self._shown
        now = {halt.task: (state.sequence, halt) for halt in state.halts}
        stood = {task: halt for task, (_, halt) in before.items()}
        if {task: halt for task, (_, halt) in now.items()} == stood and (
            all(sequence == before[task][0] for task, (sequence, _) in now.items())
        ):
            return
        self._shown = now
        self._view.handles.clear()
        for task in before.keys() - now.keys():
            await self._connection.event(
                "continued", {"threadId": self._view.thread(task), "allThreadsContinued": not now}
            )
        for halt in state.halts:
            if before.get(halt.task) != now[halt.task]:
                await self._connection.event("stopped", self._stopped(halt, state))

    def _stopped(self, halt: Halt, state: State) -> dict[str, Any]:
        body: dict[str, Any] = {
            "reason": _REASONS[halt.reason],
            "threadId": self._view.thread(halt.task),
            "allThreadsStopped": state.all_stand or halt.reason == "exception",
        }
        number = self._breakpoints.number(halt.breakpoint)
        if number is not None:
            body["hitBreakpointIds"] = [number]
        if halt.message:
            body["text"] = body["description"] = self._view.say(halt.message)
        return body

    # -- running -----------------------------------------------------------------------------------------

    async def _threads(self, _request: m.Request) -> Any:
        return {"threads": [{"id": n, "name": name} for n, name in enumerate(self._view.need().tasks, 1)]}

    async def _move(self, command: Command, request: m.Request) -> None:
        given = m.arguments_as(m.OfThread, request)
        await self._control(command, self._view.task(given.thread_id))

    async def _continue(self, request: m.Request) -> Any:
        given = m.arguments_as(m.OfThread, request)
        task = self._view.task(given.thread_id)
        await self._control("continue", task if given.single_thread else None)
        return {"allThreadsContinued": not given.single_thread}

    async def _control(self, command: Command, task: str | None) -> None:
        if self._view.at is not None:
            await self._back_to_now()
            return
        await self._view.need().control(command, task)
        self._changed.set()

    async def _pause(self, request: m.Request) -> None:
        given = m.arguments_as(m.OfThread, request)
        await self._view.need().control("pause", self._view.task(given.thread_id))
        self._changed.set()

    async def _goto_targets(self, request: m.Request) -> Any:
        given = m.arguments_as(m.GotoTargets, request)
        if given.source.path is None:
            return {"targets": []}
        line = self._view.line_in(given.line)
        self._goto_places.append((given.source.path, line))
        return {
            "targets": [
                {"id": len(self._goto_places), "label": self._view.say(f"line {line}"), "line": given.line}
            ]
        }

    async def _goto(self, request: m.Request) -> None:
        given = m.arguments_as(m.Goto, request)
        if not 0 < given.target_id <= len(self._goto_places):
            raise Refused(f"There is no target {given.target_id}")
        self._view.refuse_past()
        task = self._view.task(given.thread_id)
        await self._view.need().set_next_statement(task, *self._goto_places[given.target_id - 1])
        self._shown.pop(task, None)
        self._changed.set()

    # -- the past ----------------------------------------------------------------------------------------

    async def _go_back(self, steps: int | None, request: m.Request) -> None:
        """So many recorded cycles back, or to the oldest one."""
        given = m.arguments_as(m.OfThread, request)
        self._view.task(given.thread_id)
        if self._view.at is None:
            past = list(await self._view.need().past())
            if not past:
                raise Refused("The flight recorder has kept no cycle")
            self._view.past, self._view.at = past, len(past)
        self._view.at = 0 if steps is None else max(0, self._view.at - steps)
        self._view.handles.clear()
        cycle, last = self._view.past[self._view.at], self._view.past[-1]
        before = (last.timestamp_ns - cycle.timestamp_ns) / 1e9
        text = f"cycle {cycle.number}, {before:.3f} s before the last one"
        body = {"reason": "step", "threadId": given.thread_id, "allThreadsStopped": True}
        await self._connection.event(
            "stopped", body | dict.fromkeys(("description", "text"), self._view.say(text))
        )

    async def _back_to_now(self) -> None:
        """From the past to the present, which stands as it stood, or runs."""
        self._view.at, self._view.past = None, []
        self._view.handles.clear()
        await self._view.need().live()
        self._shown = {}
        state = await self._view.need().state()
        if not state.halts:
            await self._connection.event("continued", {"threadId": 1, "allThreadsContinued": True})
        await self._tell(state)

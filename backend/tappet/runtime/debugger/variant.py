"""The instrumented variant, linked beside the normal code of an application, on the same image.

Contract: while it is active tasks begin every cycle in it; a task in the midst of a cycle stays in the code
that it is in. Its memory goes when no task can be in it any more. Cost when it is not active: none.
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Iterable
from typing import TYPE_CHECKING

from tappet.codegen.debug_code import SITES_PREFIX, DebugCode, DebugFunction, StatementSite
from tappet.runtime.executive.records import Block, Record
from tappet.runtime.expressions import ExpressionMemory
from tappet.runtime.posix import map_memory, write_memory

if TYPE_CHECKING:
    from tappet.runtime.application import LoadedApplication

KEPT_STACK = 256 << 10
"""Bytes of a task's stack that are kept after a fault."""
ALL_SITES = 0x80
AT_BREAKPOINT = 0x01
AT_FLOW = 0x02


class Variant:
    """One linked instrumented variant. Its owner serialises the calls."""

    def __init__(self, application: LoadedApplication, code: DebugCode) -> None:
        """Raises LinkError."""
        self.application = application
        self.code = code
        self.executive = application.executive
        self.active = False
        self.functions: list[DebugFunction] = []
        self.firsts: list[int] = []
        for first, function in code.numbered():
            self.functions.append(function)
            self.firsts.append(first)
        self.count = sum(len(f.sites) for f in self.functions)
        self.flags = map_memory(max(self.count, 1), low=True)
        symbols = {
            f"{SITES_PREFIX}{function.name}": self.flags.address + first
            for first, function in zip(self.firsts, self.functions, strict=True)
        }
        try:
            self.linked = application.link_objects(application.package, code.objects, symbols)
        except BaseException:
            self.flags.close()
            raise
        layouts = self.executive.layouts
        tasks = application.contexts.tasks
        self._memory = Block(layouts["DEBUG_CONTEXT"].size)
        self.context = Record(layouts["DEBUG_CONTEXT"], self._memory.address)
        self.context["pFlags"] = self.flags.address
        self.context["siteCount"] = self.count
        self._task_memory = Block(layouts["DEBUG_TASK"].size * max(len(tasks), 1))
        self.tasks = self._task_memory.array(layouts["DEBUG_TASK"], len(tasks))
        self.log = Block(layouts["DEBUG_LOG"].size)
        self.context["pLog"] = self.log.address
        self._kept = [Block(KEPT_STACK) for _ in tasks]
        self._expressions = [self._expression_memory(task) for task in tasks]
        for task, room in zip(self.tasks, self._kept, strict=True):
            task["pKept"], task["keptRoom"] = room.address, room.size
        for task, memory in zip(self.tasks, self._expressions, strict=True):
            task["pMemory"] = memory.address
        for context, task in zip(tasks, self.tasks, strict=True):
            self.executive.store(context.place("pDebug"), task.address)
        self.executive.store(application.contexts.application.place("pDebug"), self.context.address)

    def _expression_memory(self, task: Record) -> ExpressionMemory:
        """What conditions may look at: the image, what __NEW makes, and the stack of the task."""
        image, heap = self.application.image, self.application.heap
        ranges = [
            (image.address, image.size),
            (task["stackLow"], task["stackHigh"] - task["stackLow"]),
            *([heap.arena] if heap.opened else []),
        ]
        return ExpressionMemory(self.executive, (image.address, 0, 0), ranges)

    # -- code ----------------------------------------------------------------------------------------

    def activate(self) -> None:
        """From its next cycle on every task runs this code."""
        self._direct(active=True)

    def deactivate(self) -> None:
        """From its next cycle on every task runs the normal code."""
        self._direct(active=False)

    def _direct(self, *, active: bool) -> None:
        application = self.application
        code = self.linked if active else application.code
        for spec, task in zip(application.package.tasks, application.contexts.tasks, strict=True):
            self.executive.store(task.place("pCode"), code[spec.symbol])
        self.active = active

    # -- places --------------------------------------------------------------------------------------

    def site(self, number: int) -> tuple[DebugFunction, StatementSite]:
        """The function and the statement of a number."""
        at = bisect_right(self.firsts, number) - 1
        while not self.functions[at].sites:
            at -= 1
        return self.functions[at], self.functions[at].sites[number - self.firsts[at]]

    def function_at(self, sites: int) -> int | None:
        """Index of the function whose flags begin at an address."""
        number = sites - self.flags.address
        at = bisect_right(self.firsts, number) - 1
        while at > 0 and not self.functions[at].sites:
            at -= 1
        return at if at >= 0 and self.firsts[at] == number else None

    def sites_at(self, uri: str, line: int) -> list[int]:
        """Numbers of the statements where a breakpoint at a line of a text halts: those that begin there, or
        else the next ones of the same body. Several where one text makes several functions, and for the head
        of a loop, which each pass comes by."""
        found: dict[int, list[int]] = {}
        for first, function in zip(self.firsts, self.functions, strict=True):
            if function.uri.upper() != uri.upper() or not function.sites:
                continue
            at = _next_site(function.sites, line)
            if at is not None:
                site = function.sites[at]
                same = (n for n, s in enumerate(function.sites) if s.is_same_place(site))
                found.setdefault(site.line, []).extend(first + number for number in same)
        return min(found.items(), default=(0, []))[1]

    # -- tasks ---------------------------------------------------------------------------------------

    def halted(self) -> list[int]:
        """Tasks that stand at a statement."""
        return [i for i, task in enumerate(self.tasks) if task["halted"]]

    @property
    def any_halted(self) -> bool:
        """Whether a task stands at a statement."""
        return any(task["halted"] for task in self.tasks)

    def arm(self, sites: set[int], everywhere: bool, flow: Iterable[int] = ()) -> None:
        """Let the executive be called at these statements, or at all."""
        every = ALL_SITES if everywhere or self.any_wanted else 0
        flags = bytearray([every]) * self.count
        for number in sites:
            flags[number] |= AT_BREAKPOINT
        for number in flow:
            flags[number] |= AT_FLOW
        write_memory(self.flags.address, bytes(flags))
        if not every and self.any_wanted:  # a task that halts may ask the others meanwhile
            write_memory(self.flags.address, bytes([ALL_SITES | AT_BREAKPOINT]) * self.count)

    @property
    def any_wanted(self) -> bool:
        """Whether a task is to halt at a statement that is not known."""
        return any(task["pause"] or task["mode"] for task in self.tasks)

    def detach(self) -> None:
        """Tasks know of no debugger any more; one that is in this code runs through it."""
        contexts = self.application.contexts
        if contexts.application["pDebug"] == self.context.address:
            self.executive.store(contexts.application.place("pDebug"), 0)
            for task in contexts.tasks:
                self.executive.store(task.place("pDebug"), 0)

    def close(self) -> None:
        """Release it; no task is in its code, nor has it met the debugger in this cycle."""
        self.detach()
        self.linked.close()
        self.flags.close()


def _next_site(sites: tuple[StatementSite, ...], line: int) -> int | None:
    """Index of the statement that begins at a line or has it in its head, else of the first one behind it, in
    a body that shows the line; of the one around the line where none follows."""
    low, high = min(s.line for s in sites), max(s.end_line for s in sites)
    if line > high:
        return None
    possible = [(n, s) for n, s in enumerate(sites) if s.kind != "exit"]
    heads = [(s.line, -n) for n, s in possible if s.line <= line <= s.head[1]]
    if heads:
        return -max(heads)[1]
    later = [(s.line, n) for n, s in possible if s.line >= line]
    if later:
        return min(later)[1]
    around = [(s.line, n) for n, s in possible if low <= s.line <= line <= s.end_line]
    return max(around)[1] if around else None

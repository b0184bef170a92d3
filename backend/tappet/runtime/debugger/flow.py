"""Flow control: the statements of some objects that a cycle has executed, with the values after each."""

from __future__ import annotations

from array import array
from collections.abc import Collection
from dataclasses import dataclass

from msgspec.structs import replace

from tappet.codegen.expressions.places import ExpressionError
from tappet.runtime.debugger import conditions
from tappet.runtime.debugger.places import code_spot
from tappet.runtime.debugger.shapes import FlowSnapshot, FlowStatement, FlowValue
from tappet.runtime.debugger.variant import Variant
from tappet.runtime.executive.records import Block, Record
from tappet.runtime.expressions import NativeExpression
from tappet.runtime.posix import read_memory

MOST_STATEMENTS = 5000
"""Statements that are watched at once."""
_TRIES = 100


@dataclass(slots=True)
class _Slot:
    """A watched statement."""

    numbers: list[int]
    """Where it is passed: the head of a loop before each further pass, too."""
    owner: str
    """Its object."""
    named: list[tuple[str, NativeExpression]]
    """What it names."""


class Flow:
    """The watched statements of the loaded code, and a native table of them for each task."""

    def __init__(self, variant: Variant, objects: Collection[str]) -> None:
        self._variant = variant
        self._slots: list[_Slot] = []
        self.armed: list[int] = []
        """Statements, and ends of functions, where the executive has to be called."""
        maps = variant.application.package.source_maps
        for first, function in zip(variant.firsts, variant.functions, strict=True):
            known: dict[tuple[int, int], _Slot] = {}
            scope = conditions.FrameScope(variant, function)
            for number, site in enumerate(function.sites):
                spot = code_spot(maps, function, site)
                owner = spot.object_id or spot.uri
                if owner not in objects or len(self._slots) >= MOST_STATEMENTS:
                    continue
                self.armed.append(first + number)
                if site.kind == "exit":
                    continue
                place = site.line, site.column
                if place not in known:
                    named = [(name, self._compiled(name, scope)) for name in site.names]
                    values = [(name, found) for name, found in named if found is not None]
                    known[place] = _Slot([], owner, values)
                    self._slots.append(known[place])
                known[place].numbers.append(first + number)
        self._fill()
        self.tables = [_Table(self, variant, task) for task in range(len(variant.tasks))]
        """By task."""

    def _compiled(self, name: str, scope: conditions.FrameScope) -> NativeExpression | None:
        try:
            return conditions.value(self._variant, name, scope)
        except ExpressionError:
            return None  # an instance, a text, a property: it has no single number

    def _fill(self) -> None:
        count = max(len(self._slots), 1)
        self.count = len(self._slots)
        self.numbers = Block(4 * max(self._variant.count, 1))
        self.counts, self.pointers = Block(8 * count), Block(64 * count)
        numbers, counts = self.numbers.view().cast("i"), self.counts.view().cast("q")
        pointers = self.pointers.view().cast("Q")
        for at, slot in enumerate(self._slots):
            for number in slot.numbers:
                numbers[number] = at + 1
            counts[at] = len(slot.named)
            addresses = array("Q", [expression.address for _, expression in slot.named])
            pointers[at * 8 : at * 8 + len(slot.named)] = memoryview(addresses)

    def snapshot(self, owner: str) -> FlowSnapshot:
        """The statements of an object in the last complete cycle, or in the present one of a halted task. Of
        several tasks that execute it, those of the first."""
        cycle, found = 0, list[FlowStatement]()
        for table in self.tables:
            passed, data = table.read()
            found = self._statements(owner, data)
            cycle = cycle or passed
            if found:
                cycle = passed
                break
        return FlowSnapshot(owner, cycle, found)

    def _statements(self, owner: str, data: bytes) -> list[FlowStatement]:
        size = self._variant.executive.layouts["FLOW_RESULT"].size
        maps = self._variant.application.package.source_maps
        found = []
        for at, slot in enumerate(self._slots):
            count, valid, *results = memoryview(data[at * size : (at + 1) * size]).cast("q")
            function, site = self._variant.site(slot.numbers[0])
            if slot.owner != owner or not count:
                continue
            values = [
                FlowValue(name, conditions.literal(self._variant.code.types, expression.program, raw))
                for bit, ((name, expression), raw) in enumerate(zip(slot.named, results, strict=False))
                if valid >> bit & 1
            ]
            spot = code_spot(maps, function, replace(site, line=site.head[0], end_line=site.head[1]))
            found.append(FlowStatement(spot.line, spot.end_line, spot.element, spot.part, count, values))
        return found


class _Table:
    """FLOW_TABLE of one task."""

    def __init__(self, flow: Flow, variant: Variant, task: int) -> None:
        self._variant = variant
        self._task = task
        self._flow = flow  # whose memory it points to
        layouts = variant.executive.layouts
        result = layouts["FLOW_RESULT"].size * max(flow.count, 1)
        self._now, self._done, self._block = Block(result), Block(result), Block(layouts["FLOW_TABLE"].size)
        self.address = self._block.address
        table = self._record = Record(layouts["FLOW_TABLE"], self.address)
        table["slotCount"] = flow.count
        table["pSlots"], table["pCounts"] = flow.numbers.address, flow.counts.address
        table["pExpressions"] = flow.pointers.address
        table["pNow"], table["pDone"] = self._now.address, self._done.address

    def read(self) -> tuple[int, bytes]:
        """Cycle and results; cycle 0 while there is none yet."""
        table = self._record
        if self._variant.tasks[self._task]["halted"]:
            return table["cycle"], read_memory(self._now.address, self._now.size)
        load, cell = self._variant.executive.load, table.place("sequence")
        for _ in range(_TRIES):
            before = load(cell)
            cycle, data = table["doneCycle"], read_memory(self._done.address, self._done.size)
            if before % 2 == 0 and load(cell) == before:
                return cycle, data
        return 0, bytes(self._done.size)

"""Flow control: the statements of some objects that a cycle has executed, with the values after each."""

from __future__ import annotations

from array import array
from collections.abc import Collection

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


class Flow:
    """The native table of watched statements, and the memory that it consists of."""

    def __init__(self, variant: Variant, objects: Collection[str]) -> None:
        self._variant = variant
        self._layouts = variant.executive.layouts
        maps = variant.application.package.source_maps
        self.slots: list[tuple[int, str, list[tuple[str, NativeExpression]]]] = []
        """Number of the statement, its object, and what it names."""
        self.armed: list[int] = []
        """Statements, and ends of functions, where the executive has to be called."""
        for first, function in zip(variant.firsts, variant.functions, strict=True):
            scope = conditions.FrameScope(variant, function)
            for number, site in enumerate(function.sites):
                spot = code_spot(maps, function, site)
                owner = spot.object_id or spot.uri
                if owner not in objects or len(self.slots) >= MOST_STATEMENTS:
                    continue
                self.armed.append(first + number)
                if site.kind != "exit":
                    named = [(name, self._compiled(name, scope)) for name in site.names]
                    known = [(name, found) for name, found in named if found is not None]
                    self.slots.append((first + number, owner, known))
        self._make()

    def _compiled(self, name: str, scope: conditions.FrameScope) -> NativeExpression | None:
        try:
            return conditions.value(self._variant, name, scope)
        except ExpressionError:
            return None  # an instance, a text, a property: it has no single number

    def _make(self) -> None:
        count, result = max(len(self.slots), 1), self._layouts["FLOW_RESULT"].size
        self._numbers = Block(4 * max(self._variant.count, 1))
        self._counts, self._pointers = Block(8 * count), Block(64 * count)
        self._now, self._done = Block(result * count), Block(result * count)
        numbers, counts = self._numbers.view().cast("i"), self._counts.view().cast("q")
        pointers = self._pointers.view().cast("Q")
        for slot, (number, _, known) in enumerate(self.slots):
            numbers[number] = slot + 1
            counts[slot] = len(known)
            addresses = array("Q", [expression.address for _, expression in known])
            pointers[slot * 8 : slot * 8 + len(known)] = memoryview(addresses)
        self._table = Block(self._layouts["FLOW_TABLE"].size)
        self.table = Record(self._layouts["FLOW_TABLE"], self._table.address)
        self.table["slotCount"] = len(self.slots)
        self.table["pSlots"], self.table["pCounts"] = self._numbers.address, self._counts.address
        self.table["pExpressions"] = self._pointers.address
        self.table["pNow"], self.table["pDone"] = self._now.address, self._done.address

    def snapshot(self, owner: str) -> FlowSnapshot:
        """The statements of an object in the last complete cycle, or in the present one of a halted task."""
        cycle, data = self._read()
        layout = self._layouts["FLOW_RESULT"]
        maps = self._variant.application.package.source_maps
        found = []
        for slot, (number, object_id, known) in enumerate(self.slots):
            count, valid, *results = memoryview(data[slot * layout.size : (slot + 1) * layout.size]).cast("q")
            function, site = self._variant.site(number)
            if object_id != owner or not count or site.kind != "statement":
                continue
            values = [
                FlowValue(name, conditions.literal(self._variant.code.types, expression.program, raw))
                for bit, ((name, expression), raw) in enumerate(zip(known, results, strict=False))
                if valid >> bit & 1
            ]
            spot = code_spot(maps, function, site)
            found.append(FlowStatement(spot.line, spot.end_line, spot.element, spot.part, count, values))
        return FlowSnapshot(owner, cycle, found)

    def _read(self) -> tuple[int, bytes]:
        """Cycle and results; cycle 0 while there is none yet."""
        contexts = self._variant.application.contexts.tasks
        halted = {contexts[i].address for i in self._variant.halted()}
        if self.table["pTask"] in halted:
            return self.table["cycle"], read_memory(self._now.address, self._now.size)
        load, cell = self._variant.executive.load, self.table.place("sequence")
        for _ in range(_TRIES):
            before = load(cell)
            cycle, data = self.table["doneCycle"], read_memory(self._done.address, self._done.size)
            if before % 2 == 0 and load(cell) == before:
                return cycle, data
        return 0, bytes(self._done.size)

"""Breakpoints: where they halt in the loaded code, and the table of them that tasks read.

Orders outlive the code: after a download or an online change they are placed again, by object and line.
"""

from __future__ import annotations

from array import array
from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from tappet.codegen.expressions.places import ExpressionError
from tappet.codegen.symbol_map import SymbolError
from tappet.runtime.debugger.places import code_spot, line_of
from tappet.runtime.debugger.shapes import Breakpoint, BreakpointOrder, CodeSpot, Hits
from tappet.runtime.debugger.variant import Variant
from tappet.runtime.executive.records import Block, Record

if TYPE_CHECKING:
    from tappet.runtime.debugger.conditions import LogText
    from tappet.runtime.expressions import NativeExpression

MOST = 1000
"""Breakpoints of one runtime."""
MOST_WATCHED = 1024
"""Bytes of the variable of a data breakpoint: they are compared before each statement."""
_KINDS = {"halt": 0, "run_to": 1, "log": 2}
_RULES = {"always": 0, "equal": 1, "from": 2, "every": 3}


@dataclass(slots=True)
class Wanted:
    """A breakpoint: its order, and where it halts in the present code."""

    id: int
    order: BreakpointOrder
    kind: str = "halt"
    hits: Block = field(default_factory=lambda: Block(8))
    reason: str | None = "the instrumented variant of the application is not loaded"
    sites: list[int] = field(default_factory=list)
    watched: tuple[int, int] | None = None
    """Offset and size in the image."""
    instance: int = 0
    """Address of the only instance meant; 0: all."""
    task: int | None = None
    """Index of the only task meant."""
    condition: NativeExpression | None = None
    text: LogText | None = None

    @property
    def hit_count(self) -> int:
        """How often its conditions held."""
        return int.from_bytes(self.hits.view()[:8], "little")

    @property
    def active(self) -> bool:
        """Whether it may halt."""
        return self.order.enabled and self.reason is None

    def place(self, variant: Variant) -> None:
        """Find its statements, variable, instance and task in the loaded code."""
        self.sites, self.watched, self.instance, self.task = [], None, 0, None
        self.condition, self.text = None, None
        self.reason = self._find(variant)

    def _find(self, variant: Variant) -> str | None:
        application, order = variant.application, self.order
        symbols = application.package.symbols
        if order.task is not None:
            names = [task.name.upper() for task in application.package.tasks]
            if order.task.upper() not in names:
                return f"the application has no task '{order.task}'"
            self.task = names.index(order.task.upper())
        try:
            if order.instance is not None:
                found = symbols.resolve(order.instance)
                if found.type.kind != "fb":
                    return f"'{found.path}' is no instance of a function block"
                self.instance = application.image.address + found.offset
            if order.kind == "data":
                watched = symbols.resolve(order.expression or "")
                if watched.size > MOST_WATCHED:
                    return f"'{watched.path}' has {watched.size} bytes; at most {MOST_WATCHED} can be watched"
                self.watched = watched.offset, watched.size
                self._compile(variant)
                return None
        except (SymbolError, ExpressionError) as error:
            return str(error)
        if order.place is None:
            return "the breakpoint has no place"
        line = line_of(application.package.source_maps, order.place)
        if isinstance(line, str):
            return line
        self.sites = variant.sites_at(*line)
        if not self.sites:
            return "there is no statement at this place or behind it in the loaded code"
        try:
            self._compile(variant)
        except ExpressionError as error:
            return str(error)
        return None

    def _compile(self, variant: Variant) -> None:
        if self.order.condition or self.order.log:
            from tappet.runtime.debugger import conditions  # the parser, which few runtimes need

            scope = conditions.scope_at(variant, self.sites)
            if self.order.condition:
                self.condition = conditions.condition(variant, self.order.condition, scope)
            if self.order.log and self.watched is None:
                self.text = conditions.log_text(variant, self.order.log, scope)

    def shown(self, variant: Variant | None) -> Breakpoint:
        """As clients see it."""
        actual: CodeSpot | None = None
        if variant is not None and self.sites:
            actual = code_spot(variant.application.package.source_maps, *variant.site(self.sites[0]))
        reason = self.reason
        return Breakpoint(self.id, self.order, reason is None, reason, self.hit_count, actual)


def check_order(order: BreakpointOrder) -> None:
    """Raises ValueError for one that names nothing to halt at."""
    if order.kind == "line" and order.place is None:
        raise ValueError("a line breakpoint needs a place")
    if order.kind == "data" and not order.expression:
        raise ValueError("a data breakpoint needs the expression of a variable")


class BreakpointTable:
    """The native table of all breakpoints that may halt, and the memory that it consists of."""

    def __init__(self, variant: Variant, breakpoints: Iterable[Wanted]) -> None:
        layouts = variant.executive.layouts
        lines: list[Wanted] = []
        data: list[Wanted] = []
        for wanted in breakpoints:
            if wanted.active:
                (data if wanted.watched is not None else lines).append(wanted)
        self.sites = {number for wanted in lines for number in wanted.sites}
        self.watches = bool(data)
        entry, watch = layouts["BREAKPOINT"], layouts["DATA_BREAKPOINT"]
        pairs = [(number, wanted) for wanted in lines for number in wanted.sites]
        self._hits = [wanted.hits for wanted in (*lines, *data)]
        self._first = Block(4 * max(variant.count, 1))
        self._entries = Block(entry.size * max(len(pairs), 1))
        self._data = Block(watch.size * max(len(data), 1))
        self._kept: list[Block] = []
        self._texts = [(wanted.text, wanted.condition) for wanted in (*lines, *data)]
        first = self._first.view().cast("i")
        for position, (number, wanted) in enumerate(pairs):
            record = Record(entry, self._entries.address + position * entry.size)
            record["next"] = first[number]
            first[number] = position + 1
            self._fill(record, wanted, variant)
            record["kind"] = _KINDS["log" if wanted.text is not None else wanted.kind]
            if wanted.text is not None and wanted.text.expressions:
                listed = Block(8 * len(wanted.text.expressions))
                listed.view().cast("Q")[: len(wanted.text.expressions)] = array(
                    "Q", [e.address for e in wanted.text.expressions]
                )
                self._kept.append(listed)
                record["valueCount"], record["pValues"] = len(wanted.text.expressions), listed.address
            record["pInstance"] = wanted.instance
        for position, wanted in enumerate(data):
            record = Record(watch, self._data.address + position * watch.size)
            self._fill(record, wanted, variant)
            assert wanted.watched is not None
            offset, size = wanted.watched
            known = Block(size)
            known.view()[:size] = variant.application.image.read(offset, size)
            self._kept.append(known)
            record["pMemory"] = variant.application.image.address + offset
            record["pKnown"], record["size"] = known.address, size
        self._table = Block(layouts["BREAKPOINT_TABLE"].size)
        self.address = self._table.address
        table = Record(layouts["BREAKPOINT_TABLE"], self.address)
        table["pFirst"], table["pBreakpoints"] = self._first.address, self._entries.address
        table["dataCount"], table["pData"] = len(data), self._data.address

    def _fill(self, record: Record, wanted: Wanted, variant: Variant) -> None:
        hits: Hits = wanted.order.hits
        record["number"] = wanted.id
        record["hitRule"], record["hitCount"] = _RULES[hits.mode], hits.count
        record["pHits"] = wanted.hits.address
        record["pCondition"] = wanted.condition.address if wanted.condition is not None else 0
        tasks = variant.application.contexts.tasks
        record["pTask"] = tasks[wanted.task].address if wanted.task is not None else 0

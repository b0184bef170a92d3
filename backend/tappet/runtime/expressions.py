"""Expressions in native memory: what the executive evaluates, and the memory it may look at."""

from __future__ import annotations

import ctypes
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING

from tappet.codegen.expressions.program import ExpressionProgram, check_program, value_of
from tappet.runtime.executive.records import Block, Record

if TYPE_CHECKING:
    from tappet.runtime.application import LoadedApplication
    from tappet.runtime.executive.loader import Executive

MOST_RANGES = 8


class NativeExpression:
    """An EXPRESSION with its steps; ProgramError for steps that are none. Lives as long as the object."""

    def __init__(self, executive: Executive, program: ExpressionProgram, image_size: int) -> None:
        check_program(program, image_size)
        self.program = program
        head, step = executive.layouts["EXPRESSION"], executive.layouts["EXPRESSION_STEP"]
        self._block = Block(head.size + step.size * len(program.steps))
        self.address = self._block.address
        first = self.address + head.size
        record = Record(head, self.address)
        record["count"] = len(program.steps)
        record["pSteps"] = first
        for i, given in enumerate(program.steps):
            entry = Record(step, first + i * step.size)
            entry["op"], entry["kind"], entry["a"], entry["b"] = given.op, given.kind, given.a, given.b


class ExpressionMemory:
    """An EXPRESSION_MEMORY: bases of image, THIS and frame, and the (address, size) that pointers may lead
    to."""

    def __init__(self, executive: Executive, bases: Sequence[int], ranges: Iterable[tuple[int, int]]) -> None:
        layout = executive.layouts["EXPRESSION_MEMORY"]
        self._block = Block(layout.size)
        self.record = Record(layout, self._block.address)
        for i, base in enumerate(bases):
            ctypes.c_uint64.from_address(self.record.place("bases") + 8 * i).value = base
        found = list(ranges)
        assert len(found) <= MOST_RANGES
        place = executive.layouts["MEMORY_RANGE"]
        for i, (address, size) in enumerate(found):
            entry = Record(place, self.record.place("ranges") + i * place.size)
            entry["pMemory"], entry["size"] = address, size
        self.record["count"] = len(found)

    @property
    def address(self) -> int:
        """EXPRESSION_MEMORY."""
        return self.record.address


def memory_of(application: LoadedApplication) -> ExpressionMemory:
    """What expressions over the variables of an application may look at: its image and its heap."""
    image, heap = application.image, application.heap
    ranges = [(image.address, image.size)]
    if heap.opened:
        ranges.append(heap.arena)
    return ExpressionMemory(application.executive, (image.address, 0, 0), ranges)


def evaluate(
    executive: Executive, expression: NativeExpression, memory: ExpressionMemory
) -> bool | int | float | None:
    """The value now, outside a cycle; None where there is none."""
    result = ctypes.c_int64()
    call = ctypes.CFUNCTYPE(ctypes.c_int32, ctypes.c_uint64, ctypes.c_uint64, ctypes.c_uint64)
    function = call(executive.entries["tappet_evaluate"])
    valid = function(expression.address, memory.address, ctypes.addressof(result))
    return value_of(expression.program.kind, result.value) if valid else None

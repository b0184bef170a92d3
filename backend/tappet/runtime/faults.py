"""From a fault record to a report an engineer can read: POU, line, call stack and values (decision 8)."""

from __future__ import annotations

import struct
from dataclasses import dataclass, replace

from tappet.codegen.emit_text import PREFIX
from tappet.codegen.faults import Fault, fault_message
from tappet.runtime.exception_report import CallFrame
from tappet.runtime.executive.records import Record
from tappet.runtime.link import CodeSection, LinkedCode, ObjectSymbol, read_symbols

ABORTED = 100
"""FAULT_CODE.ABORTED: the runtime itself ended the cycle."""
NOT_TOLD = 1 << 63
"""Address of an access violation that the processor did not tell: one of more than 47 bits."""
_GENERATED = "tappet."
"""Functions the compiler adds: the list of a task's programs, initialisation."""


@dataclass(frozen=True, slots=True)
class RawFault:
    """A fault record, copied out of native memory."""

    code: int
    a: int
    b: int
    c: int
    address: int
    pc: int
    pc_is_return: bool
    stack_top: int
    cycle: int
    frames: tuple[int, ...]
    origin: int = 0
    """Return address of the __NEW that made the memory which is damaged; 0 when it is none."""

    @classmethod
    def read(cls, record: Record, memory: bytes) -> RawFault:
        """From a FAULT_RECORD; `memory` are the bytes of its member `frames`."""
        count = max(0, min(record["frameCount"], len(memory) // 8))
        return cls(
            record["code"], record["a"], record["b"], record["c"], record["address"], record["pc"],
            bool(record["pcIsReturn"]), record["stackTop"], record["cycle"],
            struct.unpack_from(f"<{count}Q", memory), record["origin"],
        )  # fmt: skip

    def at(self, pc: int, stack_top: int, frames: tuple[int, ...]) -> RawFault:
        """The same fault at other addresses."""
        return replace(self, pc=pc, stack_top=stack_top, frames=frames)


def fault_name(code: int) -> str:
    """Name of a fault code, for example DIV_ZERO."""
    try:
        return Fault(code).name
    except ValueError:
        return f"FAULT_{code}"


def describe(raw: RawFault) -> tuple[str, dict[str, str]]:
    """Message and the numbers that belong to it."""
    match raw.code:
        case Fault.ARRAY_BOUNDS:
            numbers = {"index": raw.a, "low": raw.b, "high": raw.c}
            return fault_message(raw.code, raw.a, raw.b, raw.c), {k: str(v) for k, v in numbers.items()}
        case Fault.ACCESS_VIOLATION if raw.address == NOT_TOLD:
            return "access to an address of more than 47 bits, where no memory can be", {}
        case Fault.ACCESS_VIOLATION:
            return fault_message(raw.code, raw.address), {"address": f"16#{raw.address:X}"}
        case Fault.NULL_REFERENCE:
            return fault_message(raw.code), {"address": f"16#{raw.address:X}"}
        case Fault.WATCHDOG:
            took, limit = f"{raw.a / 1e6:g} ms", f"{raw.b / 1e6:g} ms"
            return f"watchdog: the cycle took {took}, its limit is {limit}", {"time": took, "limit": limit}
        case Fault.INVALID_RELEASE | Fault.HEAP_DAMAGED:
            return fault_message(raw.code, raw.a, raw.b, raw.c), {"address": f"16#{raw.b:X}"}
        case Fault.USER:
            return fault_message(raw.code, raw.a, raw.b, raw.c), {"code": str(raw.a)}
    return fault_message(raw.code, raw.a, raw.b, raw.c), {}


class Locator:
    """Finds POU and line of program counters in linked code. Reads debug information only when asked."""

    def __init__(self, *codes: LinkedCode) -> None:
        self._codes = codes
        self._symbols: dict[tuple[int, int], list[ObjectSymbol]] = {}

    def call_stack(self, raw: RawFault) -> list[CallFrame]:
        """Frames of a fault, innermost first, without those of the runtime and the C library."""
        addresses = [raw.pc - 1 if raw.pc_is_return else raw.pc, *(f - 1 for f in raw.frames)]
        if not raw.pc_is_return and self._found(raw.pc) is None and raw.stack_top:
            addresses.insert(
                0, raw.stack_top - 1
            )  # a leaf of the C library: its caller is on top of the stack
        stack: list[CallFrame] = []
        for address in addresses:
            stack.extend(self.frames_at(address))
        return [frame for frame in stack if not frame.pou.startswith(_GENERATED)] or stack

    def frames_at(self, address: int) -> list[CallFrame]:
        """The function at `address`, after those the compiler merged into it; empty for foreign code."""
        place = self._found(address)
        if place is None:
            return []
        code, section = place
        function = self._function(code, section, address)
        from tappet.runtime.debug_lines import frames_at  # the reader of ELF files: needed after a fault only

        found = frames_at(code.objects[section.object_index], section, address, function)
        return [CallFrame(*frame) for frame in found]

    def _found(self, address: int) -> tuple[LinkedCode, CodeSection] | None:
        for code in self._codes:
            section = code.section_of(address)
            if section is not None:
                return code, section
        return None

    def _function(self, code: LinkedCode, section: CodeSection, address: int) -> str:
        key = id(code), section.object_index
        symbols = self._symbols.get(key)
        if symbols is None:
            symbols = self._symbols[key] = read_symbols(code.objects[section.object_index])[0]
        at = address - section.base
        for s in symbols:
            if s.function and s.section == section.section and s.value <= at < s.value + max(s.size, 1):
                return s.name.removeprefix(PREFIX)
        return "?"

"""From a fault record to a report an engineer can read: POU, line, call stack and values (decision 8)."""

from __future__ import annotations

import io
import struct
from collections.abc import Iterator
from dataclasses import asdict, dataclass, field
from typing import Any

from elftools.common.exceptions import ELFError
from elftools.construct import ConstructError
from elftools.dwarf.die import DIE
from elftools.elf.elffile import ELFFile

from tappet.codegen.emit_text import PREFIX
from tappet.codegen.faults import Fault, fault_message
from tappet.runtime.executive.records import Record
from tappet.runtime.link import CodeSection, LinkedCode, ObjectSymbol, read_symbols

ABORTED = 100
"""FAULT_CODE.ABORTED: the runtime itself ended the cycle."""
_UNREADABLE = (
    ELFError, ConstructError, struct.error, LookupError, ValueError, AttributeError, AssertionError,
)  # fmt: skip
"""What damaged or unusual debug information raises; the report then goes without lines."""
_GENERATED = "tappet."
"""Functions the compiler adds: the list of a task's programs, initialisation."""


@dataclass(frozen=True, slots=True)
class CallFrame:
    """One level of the call stack, the innermost first."""

    pou: str
    uri: str
    line: int
    """1-based line in the source text `uri`; 0 when unknown."""


@dataclass(frozen=True, slots=True)
class ExceptionReport:
    """Why an application is in the state exception."""

    code: int
    name: str
    message: str
    task: str
    pou: str
    uri: str
    line: int
    cycle: int
    timestamp_ns: int
    call_stack: tuple[CallFrame, ...] = ()
    values: dict[str, str] = field(default_factory=dict)
    """Numbers of the fault itself (index, low, high, address ...) and variables of the programs in the call
    stack.
    """

    def to_dict(self) -> dict[str, Any]:
        """Plain data for the wire."""
        return asdict(self)

    @classmethod
    def from_dict(cls, data: dict[str, Any]) -> ExceptionReport:
        """Inverse of `to_dict`."""
        rest = {k: v for k, v in data.items() if k != "call_stack"}
        return cls(**rest, call_stack=tuple(CallFrame(**f) for f in data["call_stack"]))


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

    @classmethod
    def read(cls, record: Record, memory: bytes) -> RawFault:
        """From a FAULT_RECORD; `memory` are the bytes of its member `frames`."""
        count = max(0, min(record["frameCount"], len(memory) // 8))
        return cls(
            record["code"], record["a"], record["b"], record["c"], record["address"], record["pc"],
            bool(record["pcIsReturn"]), record["stackTop"], record["cycle"],
            struct.unpack_from(f"<{count}Q", memory),
        )  # fmt: skip


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
        case Fault.ACCESS_VIOLATION:
            return fault_message(raw.code, raw.address), {"address": f"16#{raw.address:X}"}
        case Fault.NULL_REFERENCE:
            return fault_message(raw.code), {"address": f"16#{raw.address:X}"}
        case Fault.WATCHDOG:
            took, limit = f"{raw.a / 1e6:g} ms", f"{raw.b / 1e6:g} ms"
            return f"watchdog: the cycle took {took}, its limit is {limit}", {"time": took, "limit": limit}
        case Fault.USER:
            return fault_message(raw.code, raw.a, raw.b, raw.c), {"code": str(raw.a)}
    return fault_message(raw.code, raw.a, raw.b, raw.c), {}


class Locator:
    """Finds POU and line of program counters in linked code. Reads debug information only when asked."""

    def __init__(self, code: LinkedCode) -> None:
        self._code = code
        self._symbols: dict[int, list[ObjectSymbol]] = {}

    def call_stack(self, raw: RawFault) -> list[CallFrame]:
        """Frames of a fault, innermost first, without those of the runtime and the C library."""
        addresses = [raw.pc - 1 if raw.pc_is_return else raw.pc, *(f - 1 for f in raw.frames)]
        if not raw.pc_is_return and self._code.section_of(raw.pc) is None and raw.stack_top:
            addresses.insert(
                0, raw.stack_top - 1
            )  # a leaf of the C library: its caller is on top of the stack
        stack: list[CallFrame] = []
        for address in addresses:
            stack.extend(self.frames_at(address))
        return [frame for frame in stack if not frame.pou.startswith(_GENERATED)] or stack

    def frames_at(self, address: int) -> list[CallFrame]:
        """The function at `address`, after those the compiler merged into it; empty for foreign code."""
        section = self._code.section_of(address)
        if section is None:
            return []
        function = self._function(section, address)
        try:
            return self._debug_frames(section, address, function)
        except _UNREADABLE:
            return [CallFrame(function, "", 0)]

    def _function(self, section: CodeSection, address: int) -> str:
        symbols = self._symbols.get(section.object_index)
        if symbols is None:
            symbols = read_symbols(self._code.objects[section.object_index])[0]
            self._symbols[section.object_index] = symbols
        at = address - section.base
        for s in symbols:
            if s.function and s.section == section.section and s.value <= at < s.value + max(s.size, 1):
                return s.name.removeprefix(PREFIX)
        return "?"

    def _debug_frames(self, section: CodeSection, address: int, function: str) -> list[CallFrame]:
        placed = _place(self._code.objects[section.object_index], section)
        elf = ELFFile(io.BytesIO(placed))
        if not elf.has_dwarf_info():
            return [CallFrame(function, "", 0)]
        dwarf = elf.get_dwarf_info()
        for unit in dwarf.iter_CUs():
            lines = _Lines(dwarf.line_program_for_CU(unit))
            here = lines.at(address)
            if here is None:
                continue
            uri, line = here
            frames = []
            for die in reversed(_enclosing(unit.get_top_DIE(), address)):
                inlined = die.tag == "DW_TAG_inlined_subroutine"
                frames.append(CallFrame(_name(die) or function, uri, line))
                if inlined:
                    uri = lines.file(_number(die, "DW_AT_call_file")) or uri
                    line = _number(die, "DW_AT_call_line")
            return frames or [CallFrame(function, uri, line)]
        return [CallFrame(function, "", 0)]


def _place(data: bytes, section: CodeSection) -> bytes:
    """Copy of an object whose symbols of one section carry their address in memory.

    Relocating the debug information of this copy gives real addresses. Symbols of other code sections are
    moved out of the way, because in a relocatable object every section begins at 0.
    """
    placed = bytearray(data)
    table, entry, count = *struct.unpack_from("<Q", data, 0x28), *struct.unpack_from("<HH", data, 0x3A)
    for i in range(count):
        header = struct.unpack_from("<IIQQQQIIQQ", data, table + i * entry)
        if header[1] != 2:
            continue
        flags = [struct.unpack_from("<IIQ", data, table + k * entry)[2] for k in range(count)]
        for at in range(header[4], header[4] + header[5], 24):
            _, _, _, index, value, _ = struct.unpack_from("<IBBHQQ", data, at)
            if index == section.section:
                struct.pack_into("<Q", placed, at + 8, value + section.base)
            elif index < count and flags[index] & 4:
                struct.pack_into("<Q", placed, at + 8, 1 << 62)
    return bytes(placed)


class _Lines:
    """The line table of a compile unit."""

    def __init__(self, program: Any) -> None:
        self._program = program

    def at(self, address: int) -> tuple[str, int] | None:
        """File and line of an address; None when the unit does not cover it."""
        if self._program is None:
            return None
        before = None
        for entry in self._program.get_entries():
            state = entry.state
            if state is None:
                continue
            if before is not None and before.address <= address < state.address:
                return self.file(before.file), _code_line(before.line)
            before = None if state.end_sequence else state
        return None

    def file(self, number: int) -> str:
        """Name of a file of the table."""
        header = self._program.header
        index = number if header.version >= 5 else number - 1
        if not 0 <= index < len(header.file_entry):
            return ""
        name: bytes = header.file_entry[index].name
        return name.decode("utf-8", "replace")


def _code_line(line: int | None) -> int:
    return line or 0


def _enclosing(top: DIE, address: int) -> list[DIE]:
    """Subprogram and the inlined subroutines inside it that hold `address`, outermost first."""
    found: list[DIE] = []
    level = top
    while True:
        for child in _scopes(level):
            if _covers(child, address):
                if child.tag != "DW_TAG_lexical_block":
                    found.append(child)
                level = child
                break
        else:
            return found


def _scopes(die: DIE) -> Iterator[DIE]:
    for child in die.iter_children():
        if child.tag in ("DW_TAG_subprogram", "DW_TAG_inlined_subroutine", "DW_TAG_lexical_block"):
            yield child


def _covers(die: DIE, address: int) -> bool:
    if "DW_AT_low_pc" in die.attributes and "DW_AT_high_pc" in die.attributes:
        low = int(die.attributes["DW_AT_low_pc"].value)
        high = die.attributes["DW_AT_high_pc"]
        end = int(high.value) if high.form == "DW_FORM_addr" else low + int(high.value)
        return low <= address < end
    if "DW_AT_ranges" in die.attributes:
        lists = die.dwarfinfo.range_lists()
        base = die.cu.get_top_DIE().attributes.get("DW_AT_low_pc")
        start = int(base.value) if base is not None else 0
        entries: Any = lists.get_range_list_at_offset(die.attributes["DW_AT_ranges"].value) if lists else ()
        for entry in entries:
            if hasattr(entry, "base_address"):
                start = entry.base_address
            elif start + entry.begin_offset <= address < start + entry.end_offset:
                return True
    return False


def _name(die: DIE) -> str:
    while "DW_AT_abstract_origin" in die.attributes:
        die = die.get_DIE_from_attribute("DW_AT_abstract_origin")
    for attribute in ("DW_AT_linkage_name", "DW_AT_name"):
        if attribute in die.attributes:
            return bytes(die.attributes[attribute].value).decode("utf-8", "replace")
    return ""


def _number(die: DIE, attribute: str) -> int:
    return int(die.attributes[attribute].value) if attribute in die.attributes else 0

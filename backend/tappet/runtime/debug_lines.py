"""Functions, files and lines of addresses in compiled code, read from its debug information (DWARF)."""

from __future__ import annotations

import io
import struct
from collections.abc import Iterator
from typing import Any

from elftools.common.exceptions import ELFError
from elftools.construct import ConstructError
from elftools.dwarf.die import DIE
from elftools.elf.elffile import ELFFile

from tappet.runtime.link import CodeSection

Frame = tuple[str, str, int]
"""A level of the call stack: function, file and line from 1; no file and line 0 where they are unknown."""

_UNREADABLE = (
    ELFError, ConstructError, struct.error, LookupError, ValueError, AttributeError, AssertionError,
)  # fmt: skip
"""What damaged or unusual debug information raises; the report then goes without lines."""


def frames_at(data: bytes, section: CodeSection, address: int, function: str) -> list[Frame]:
    """The function at an address of a section of the object `data`, and what it is inlined in.

    The innermost one comes first.
    """
    try:
        return _debug_frames(data, section, address, function)
    except _UNREADABLE:
        return [(function, "", 0)]


def _debug_frames(data: bytes, section: CodeSection, address: int, function: str) -> list[Frame]:
    placed = _place(data, section)
    elf = ELFFile(io.BytesIO(placed))
    if not elf.has_dwarf_info():
        return [(function, "", 0)]
    dwarf = elf.get_dwarf_info()
    for unit in dwarf.iter_CUs():
        lines = _Lines(dwarf.line_program_for_CU(unit))
        here = lines.at(address)
        if here is None:
            continue
        uri, line = here
        frames: list[Frame] = []
        scopes = _enclosing(unit.get_top_DIE(), address)
        if not line and scopes:
            line = _line_beside(lines, unit.get_top_DIE(), scopes[-1], address)
        for die in reversed(scopes):
            inlined = die.tag == "DW_TAG_inlined_subroutine"
            frames.append((_name(die) or function, uri, line))
            if inlined:
                uri = lines.file(_number(die, "DW_AT_call_file")) or uri
                line = _number(die, "DW_AT_call_line")
        return frames or [(function, uri, line)]
    return [(function, "", 0)]


def _line_beside(lines: _Lines, top: DIE, scope: DIE, address: int) -> int:
    """Line beside an address that stands for several lines at once, in the same function: the compiler has
    merged what they have in common. The first line of the function when there is none.
    """
    rows = lines.rows()
    before = [row for row in rows if row[0] <= address]
    for at, line in (*reversed(before), *rows[len(before) :]):
        if line and _covers(scope, at) and _enclosing(top, at)[-1].offset == scope.offset:
            return line
    return _number(scope, "DW_AT_decl_line")


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

    def rows(self) -> list[tuple[int, int]]:
        """Addresses and lines of the table, by address."""
        states = (entry.state for entry in self._program.get_entries())
        return sorted((s.address, _code_line(s.line)) for s in states if s is not None and not s.end_sequence)

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

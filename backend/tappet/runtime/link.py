"""Links ELF objects into the process (ORC) and remembers where their functions came to lie."""

from __future__ import annotations

import itertools
import struct
import threading
from collections.abc import Iterable, Mapping
from dataclasses import dataclass

import llvmlite.binding as llvm

from tappet.codegen.compile_options import OptimiseOptions
from tappet.codegen.optimise import target_machine
from tappet.runtime.posix import symbol_address

_EXECUTABLE = 0x4
_SYMTAB = 2
_UNDEFINED = 0
_RESERVED = 0xFF00
_OF_THE_LINKER = {"", "_GLOBAL_OFFSET_TABLE_"}
_numbers = itertools.count(1)

_MEMORY = [
    "memcpy", "memmove", "memset", "memcmp", "bcmp", "memchr", "strlen", "strcmp", "strncmp", "strtod",
    "gcvt", "_setjmp",
]  # fmt: skip
_DOUBLE = [
    "sin", "cos", "tan", "asin", "acos", "atan", "atan2", "sinh", "cosh", "tanh", "exp", "exp2",
    "exp10", "expm1", "log", "log2", "log10", "log1p", "pow", "sqrt", "cbrt", "fmod", "fabs", "floor",
    "ceil", "round", "roundeven", "trunc", "rint", "nearbyint", "lround", "llround", "lrint", "llrint",
    "hypot", "copysign", "fmin", "fmax", "fma", "ldexp", "frexp", "modf", "sincos",
]  # fmt: skip
C_LIBRARY = frozenset(_MEMORY + _DOUBLE + [f"{name}f" for name in _DOUBLE])
"""Functions of the C and mathematics library that applications may use; all else is refused by name.

LLVM puts some of them in place of what the code calls: sincos for SIN and COS of one value, bcmp for memcmp.
"""


class LinkError(RuntimeError):
    """The package needs something this runtime does not offer, or is damaged."""


@dataclass(frozen=True, slots=True)
class ObjectSymbol:
    """A symbol of an ELF object."""

    name: str
    section: int
    value: int
    size: int
    function: bool
    exported: bool


@dataclass(frozen=True, slots=True)
class CodeSection:
    """An executable section of a linked object; `base` is where its first byte lies."""

    object_index: int
    section: int
    base: int
    size: int


def read_symbols(data: bytes) -> tuple[list[ObjectSymbol], dict[int, int]]:
    """Symbols of a relocatable ELF64 object, and its executable sections with their sizes.

    Raises LinkError when the bytes are no such object.
    """
    try:
        return _read_symbols(data)
    except (struct.error, IndexError, ValueError) as error:
        raise LinkError(f"damaged object code: {error}") from error


def _read_symbols(data: bytes) -> tuple[list[ObjectSymbol], dict[int, int]]:
    if data[:6] != b"\x7fELF\x02\x01":
        raise ValueError("not a little-endian ELF64 object")
    table, entry_size, count = (
        *struct.unpack_from("<Q", data, 0x28),
        *struct.unpack_from("<HH", data, 0x3A),
    )
    if entry_size < 64:
        raise ValueError("section header table")
    headers = [struct.unpack_from("<IIQQQQIIQQ", data, table + i * entry_size) for i in range(count)]
    code = {i: h[5] for i, h in enumerate(headers) if h[2] & _EXECUTABLE and h[1] == 1}
    symbols: list[ObjectSymbol] = []
    for _, kind, _, _, offset, size, linked, _, _, _ in headers:
        if kind != _SYMTAB:
            continue
        names = headers[linked]
        text = data[names[4] : names[4] + names[5]]
        for name, info, _, section, value, length in struct.iter_unpack(
            "<IBBHQQ", data[offset : offset + size]
        ):
            label = text[name : text.index(b"\0", name)].decode("utf-8", "replace")
            symbols.append(ObjectSymbol(label, section, value, length, info & 15 == 2, info >> 4 != 0))
    return symbols, code


class LinkedCode:
    """Objects in memory. The code stays as long as this object; `close` removes it."""

    def __init__(
        self,
        tracker: llvm.orcjit.ResourceTracker,
        objects: list[bytes],
        sections: list[CodeSection],
        imported: frozenset[str],
    ) -> None:
        self._tracker = tracker
        self.objects = objects
        self.sections = sections
        self.imported = imported
        """Names that came from outside the objects."""

    def __getitem__(self, symbol: str) -> int:
        return int(self._tracker[symbol])

    def close(self) -> None:
        """Unload; no thread may be inside the code any more."""
        self._tracker.close()

    def section_of(self, address: int) -> CodeSection | None:
        """The code section that holds an address."""
        for section in self.sections:
            if section.base <= address < section.base + section.size:
                return section
        return None


class Linker:
    """The one ORC instance of the process."""

    def __init__(self) -> None:
        self._machine = target_machine(OptimiseOptions())
        self._jit = llvm.create_lljit_compiler(self._machine, use_jit_link=True)
        self._lock = threading.Lock()

    def link(self, objects: list[bytes], exports: Iterable[str], imports: Mapping[str, int]) -> LinkedCode:
        """Link `objects`; symbols they do not define come from `imports` or the permitted C functions.

        Raises LinkError naming what is missing.
        """
        tables = [read_symbols(data) for data in objects]
        defined = {s.name for symbols, _ in tables for s in symbols if s.section != _UNDEFINED and s.exported}
        missing = [name for name in exports if name not in defined]
        if missing:
            raise LinkError(f"the object code does not define {', '.join(missing)}")
        builder = llvm.JITLibraryBuilder()
        for data in objects:
            builder.add_object_img(data)
        used = {s.name for symbols, _ in tables for s in symbols if s.section == _UNDEFINED}
        imported = frozenset(used - defined - _OF_THE_LINKER)
        for name in imported:
            builder.import_symbol(name, _address_of(name, imports))
        witnesses = _witnesses(tables)
        for name in {*exports, *(w.name for w in witnesses.values())}:
            builder.export_symbol(name)
        with self._lock:
            try:
                tracker = builder.link(self._jit, f"tappet{next(_numbers)}")
            except RuntimeError as error:
                raise LinkError(str(error)) from error
        sections = [
            CodeSection(index, section, int(tracker[w.name]) - w.value, tables[index][1][section])
            for (index, section), w in witnesses.items()
        ]
        return LinkedCode(tracker, objects, sections, imported)


def _address_of(name: str, imports: Mapping[str, int]) -> int:
    address = imports.get(name, 0)
    if not address and name in C_LIBRARY:
        address = symbol_address(name)
    if not address:
        raise LinkError(f"the application needs '{name}', which this runtime does not offer")
    return address


def _witnesses(
    tables: list[tuple[list[ObjectSymbol], dict[int, int]]],
) -> dict[tuple[int, int], ObjectSymbol]:
    """For each code section one exported function, whose address is that of the section."""
    found: dict[tuple[int, int], ObjectSymbol] = {}
    for index, (symbols, code) in enumerate(tables):
        for s in symbols:
            if s.function and s.exported and s.section in code and s.section < _RESERVED:
                found.setdefault((index, s.section), s)
    return found

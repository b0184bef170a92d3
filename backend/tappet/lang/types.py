"""The data types of IEC 61131-3 with the CODESYS extensions (spec LTYP-*).

Types are compared by identity for named types (struct, enum, FB ...) and by value for anonymous ones.
Sizes and offsets are fixed here once, because SIZEOF, the memory image, DWARF and the monitor must agree.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from enum import StrEnum
from itertools import product
from typing import TYPE_CHECKING

from tappet.iec.words import ELEMENTARY_TYPES, TYPE_SYNONYMS

if TYPE_CHECKING:
    from tappet.lang import ast


class Kind(StrEnum):
    """Family of an elementary type; it decides the operators that apply."""

    BOOL = "bool"
    BITS = "bits"  # BYTE WORD DWORD LWORD: unsigned value
    SIGNED = "signed"  # SINT INT DINT LINT
    UNSIGNED = "unsigned"  # USINT UINT UDINT ULINT
    REAL = "real"  # REAL LREAL
    TIME = "time"  # TIME (u32 ms), LTIME (u64 ns)
    DATE = "date"  # DATE, DT (u32 s), TOD (u32 ms), and their L-forms (u64 ns)


@dataclass(frozen=True, slots=True)
class Elementary:
    """BOOL, integers, bit strings, floats, times and dates."""

    name: str
    kind: Kind
    size: int  # bytes

    @property
    def align(self) -> int:
        """Natural alignment in bytes."""
        return self.size

    @property
    def is_integer(self) -> bool:
        """Whether this is one of the integer or bit-string types."""
        return self.kind in (Kind.BITS, Kind.SIGNED, Kind.UNSIGNED)

    @property
    def is_signed(self) -> bool:
        """Whether values carry a sign (SINT INT DINT LINT REAL LREAL)."""
        return self.kind in (Kind.SIGNED, Kind.REAL)

    def __str__(self) -> str:
        return self.name


ELEMENTARY: dict[str, Elementary] = {
    name: Elementary(name, Kind(row.family), row.size) for name, row in ELEMENTARY_TYPES.items()
}
"""Elementary types by upper-case name, with the short names as well."""
ELEMENTARY |= {synonym: ELEMENTARY[name] for synonym, name in TYPE_SYNONYMS.items()}

BOOL = ELEMENTARY["BOOL"]
BYTE, WORD, DWORD, LWORD = (ELEMENTARY[name] for name in ("BYTE", "WORD", "DWORD", "LWORD"))
SINT, INT, DINT, LINT = (ELEMENTARY[name] for name in ("SINT", "INT", "DINT", "LINT"))
USINT, UINT, UDINT, ULINT = (ELEMENTARY[name] for name in ("USINT", "UINT", "UDINT", "ULINT"))
REAL, LREAL = ELEMENTARY["REAL"], ELEMENTARY["LREAL"]
TIME, LTIME = ELEMENTARY["TIME"], ELEMENTARY["LTIME"]
DATE, TOD, DT = (ELEMENTARY[name] for name in ("DATE", "TOD", "DT"))
LDATE, LTOD, LDT = (ELEMENTARY[name] for name in ("LDATE", "LTOD", "LDT"))


@dataclass(frozen=True, slots=True)
class String:
    """STRING(n): n 8-bit characters and a terminating zero; WSTRING(n): n UTF-16 units and a zero."""

    length: int = 80
    wide: bool = False

    @property
    def size(self) -> int:
        """Bytes including the terminator."""
        return (self.length + 1) * (2 if self.wide else 1)

    @property
    def align(self) -> int:
        """1 for STRING, 2 for WSTRING."""
        return 2 if self.wide else 1

    def __str__(self) -> str:
        name = "WSTRING" if self.wide else "STRING"
        return name if self.length == 80 else f"{name}({self.length})"


@dataclass(frozen=True, slots=True)
class Array:
    """ARRAY with constant bounds; the last index runs fastest. `bounds` is empty for ARRAY[*]
    (`open_dims`)."""

    element: Type
    bounds: tuple[tuple[int, int], ...]
    open_dims: int = 0

    @property
    def count(self) -> int:
        """Number of elements over all dimensions."""
        n = 1
        for low, high in self.bounds:
            n *= high - low + 1
        return n

    def indices(self) -> Iterator[tuple[int, ...]]:
        """The indices of the elements in the order of storage."""
        return product(*(range(low, high + 1) for low, high in self.bounds))

    @property
    def size(self) -> int:
        """Bytes; elements follow each other at a stride of the element size."""
        return self.count * self.element.size

    @property
    def align(self) -> int:
        """Alignment of the element."""
        return self.element.align

    def __str__(self) -> str:
        if self.open_dims:
            return f"ARRAY [{', '.join('*' * self.open_dims)}] OF {self.element}"
        return f"ARRAY [{', '.join(f'{low}..{high}' for low, high in self.bounds)}] OF {self.element}"


@dataclass(frozen=True, slots=True)
class Pointer:
    """POINTER TO base (`^` reads and writes the target); base None is a pointer to anything."""

    base: Type | None
    size: int = 8
    align: int = 8
    ref_to: bool = False
    """REF_TO of IEC 61131-3: it has the address of a variable of its type, or NULL, and nothing else."""

    def __str__(self) -> str:
        return f"REF_TO {self.base}" if self.ref_to else f"POINTER TO {self.base or 'ANY'}"


@dataclass(frozen=True, slots=True)
class Reference:
    """REFERENCE TO base: an alias; used like the base itself, bound by REF=."""

    base: Type
    size: int = 8
    align: int = 8

    def __str__(self) -> str:
        return f"REFERENCE TO {self.base}"


@dataclass(eq=False, slots=True)
class Member:
    """A member of a structure, function block or program, with its place in the instance."""

    name: str
    type: Type
    offset: int = 0
    section: str = "VAR"
    """VAR, VAR_INPUT, VAR_OUTPUT, VAR_IN_OUT (stored as pointer), VAR_TEMP, VAR_STAT ..."""
    flags: frozenset[str] = frozenset()
    """Of CONSTANT, RETAIN, PERSISTENT."""
    decl: ast.VarDecl | None = None
    bit: int | None = None
    """Bit number inside the byte for BIT members, None otherwise."""


@dataclass(eq=False, slots=True)
class Struct:
    """STRUCT or UNION (all offsets 0). Compared by identity."""

    name: str
    members: dict[str, Member] = field(default_factory=dict)
    """By upper-case name, in order of declaration, members of the base structure first."""
    size: int = 0
    align: int = 1
    union: bool = False
    base: Struct | None = None
    decl: ast.TypeDecl | None = None
    unknown: set[str] = field(default_factory=set)
    """Upper-case names of members without a type, which a message has been about."""

    def __str__(self) -> str:
        return self.name


class _StoredAsBase:
    """A type whose values are stored as those of its base type."""

    __slots__ = ()
    base: Elementary

    @property
    def size(self) -> int:
        """Bytes of the base type."""
        return self.base.size

    @property
    def align(self) -> int:
        """Alignment of the base type."""
        return self.base.align


@dataclass(eq=False, slots=True)
class Enum(_StoredAsBase):
    """Enumeration with its base type and named values. Compared by identity."""

    name: str
    base: Elementary
    values: dict[str, int] = field(default_factory=dict)
    """By name as declared."""
    decl: ast.TypeDecl | None = None
    qualified_only: bool = False
    strict: bool = False
    """Attribute 'strict': no integers, no arithmetic."""
    default: int = 0
    """Value a variable starts with: the first one, unless the declaration says otherwise (LTYP-112)."""

    def __str__(self) -> str:
        return self.name


@dataclass(frozen=True, slots=True)
class Subrange(_StoredAsBase):
    """Integer type with bounds; they are checked at run time only through the CheckRange functions
    (LTYP-122)."""

    base: Elementary
    low: int
    high: int
    name: str | None = None

    def __str__(self) -> str:
        return self.name or f"{self.base} ({self.low}..{self.high})"


@dataclass(eq=False, slots=True)
class FunctionBlock:
    """The instance type of a FUNCTION_BLOCK or PROGRAM. Members hold everything an instance stores."""

    name: str
    members: dict[str, Member] = field(default_factory=dict)
    """By upper-case name; VAR_IN_OUT members are 8-byte pointers. Not stored and so not here: VAR_TEMP,
    VAR_STAT, VAR_EXTERNAL, and variables AT an address. `__VFTABLE` (see analysis) is the first one of blocks
    that take part in inheritance or have methods; `METHOD.NAME` holds VAR_INST of a method, and that of an
    accessor is `PROPERTY.GET.NAME`."""
    size: int = 0
    align: int = 1
    program: bool = False
    base: FunctionBlock | None = None
    pou: ast.Pou | None = None

    def __str__(self) -> str:
        return self.name


@dataclass(eq=False, slots=True)
class Interface:
    """INTERFACE: a variable of it holds a reference to an implementing instance."""

    name: str
    size: int = 8
    align: int = 8
    pou: ast.Interface | None = None

    def __str__(self) -> str:
        return self.name


Type = (
    Elementary | String | Array | Pointer | Reference | Struct | Enum | Subrange | FunctionBlock | Interface
)


def value_type(t: Type) -> Type:
    """`t` as it takes part in expressions: references, subranges and enums give the type below them."""
    while True:
        if isinstance(t, (Reference, Subrange, Enum)):
            t = t.base
        else:
            return t

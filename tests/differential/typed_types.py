"""Types and declarations of a random program, and the typing rules, written from the specification.

Rules (language_operators.md 1..5, LOPR-03): integers narrower than 32 bit are computed in DINT, operands of
different sign in the smallest signed type that holds both; the static type is that of the larger operand, of
equal size the signed one. A value is cut where it is stored or handed over, and by operators that depend on a
width (NOT, AND, shifts). Nothing here is shared with the compiler.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any


@dataclass(frozen=True)
class Scalar:
    """An elementary type."""

    name: str
    kind: str
    """bool, signed, unsigned, bits, real, time or date."""
    bits: int
    unit_ns: int = 0
    """Nanoseconds per count of a time or date."""

    @property
    def integer(self) -> bool:
        return self.kind in ("signed", "unsigned", "bits")

    @property
    def low(self) -> int:
        return -(1 << (self.bits - 1)) if self.kind == "signed" else 0

    @property
    def high(self) -> int:
        return (1 << (self.bits - 1)) - 1 if self.kind == "signed" else (1 << self.bits) - 1


BOOL = Scalar("BOOL", "bool", 1)
SINT, INT, DINT, LINT = (
    Scalar(n, "signed", b) for n, b in zip(("SINT", "INT", "DINT", "LINT"), (8, 16, 32, 64), strict=True)
)
USINT, UINT, UDINT, ULINT = (
    Scalar(n, "unsigned", b)
    for n, b in zip(("USINT", "UINT", "UDINT", "ULINT"), (8, 16, 32, 64), strict=True)
)
BYTE, WORD, DWORD, LWORD = (
    Scalar(n, "bits", b) for n, b in zip(("BYTE", "WORD", "DWORD", "LWORD"), (8, 16, 32, 64), strict=True)
)
REAL, LREAL = Scalar("REAL", "real", 32), Scalar("LREAL", "real", 64)
TIME, LTIME = Scalar("TIME", "time", 32, 1_000_000), Scalar("LTIME", "time", 64, 1)
DATE, DT = Scalar("DATE", "date", 32, 1_000_000_000), Scalar("DT", "date", 32, 1_000_000_000)
TOD, LDT = Scalar("TOD", "date", 32, 1_000_000), Scalar("LDT", "date", 64, 1)
LDATE, LTOD = Scalar("LDATE", "date", 64, 1), Scalar("LTOD", "date", 64, 1)
INTEGERS = (SINT, INT, DINT, LINT, USINT, UINT, UDINT, ULINT, BYTE, WORD, DWORD, LWORD)
REALS = (REAL, LREAL)
NUMBERS = INTEGERS + REALS


@dataclass(frozen=True)
class Text:
    """STRING(length), or WSTRING(length)."""

    length: int
    wide: bool = False

    @property
    def name(self) -> str:
        return f"{'WSTRING' if self.wide else 'STRING'}({self.length})"


@dataclass(frozen=True)
class Enum:
    """An enumeration; values as (name, number)."""

    name: str
    base: Scalar
    members: tuple[tuple[str, int], ...]


@dataclass(frozen=True)
class Subrange:
    """An integer type with limits."""

    base: Scalar
    low: int
    high: int
    checked: bool = False
    """Whether CheckRange functions limit what is stored."""

    @property
    def name(self) -> str:
        return f"{self.base.name} ({self.low}..{self.high})"


@dataclass(frozen=True)
class Array:
    """One or two dimensions."""

    element: Type
    bounds: tuple[tuple[int, int], ...]

    @property
    def name(self) -> str:
        limits = ", ".join(f"{low}..{high}" for low, high in self.bounds)
        return f"ARRAY [{limits}] OF {self.element.name}"


@dataclass(frozen=True)
class OpenArray:
    """ARRAY [*] of an in-out; bounds come from the argument."""

    element: Type
    dimensions: int

    @property
    def name(self) -> str:
        return f"ARRAY [{', '.join('*' * self.dimensions)}] OF {self.element.name}"


@dataclass(frozen=True)
class BitMember:
    """BIT: a BOOL of a structure that takes one bit and has no address."""

    base: Scalar = BOOL
    name: str = "BIT"


@dataclass(frozen=True)
class Struct:
    """A structure, or a UNION, whose members all lie at its beginning."""

    name: str
    members: tuple[tuple[str, Type], ...]
    pack: int | None = None
    """`pack_mode`."""
    union: bool = False
    base: Struct | None = None
    """What it extends; `members` begin with those of the base."""


@dataclass(frozen=True)
class Pointer:
    """POINTER TO, REFERENCE TO or REF_TO."""

    target: Type
    reference: bool = False
    ref_to: bool = False

    @property
    def name(self) -> str:
        if self.ref_to:
            return f"REF_TO {self.target.name}"
        return f"{'REFERENCE' if self.reference else 'POINTER'} TO {self.target.name}"


@dataclass(eq=False)
class Interface:
    """Heads of methods and properties."""

    name: str
    methods: list[Function]
    properties: list[Property] = field(default_factory=list)


@dataclass(eq=False)
class Block:
    """A function block with its methods."""

    name: str
    base: Block | None = None
    interfaces: list[Interface] = field(default_factory=list)
    inputs: list[Variable] = field(default_factory=list)
    outputs: list[Variable] = field(default_factory=list)
    locals: list[Variable] = field(default_factory=list)
    body: list[Any] = field(default_factory=list)
    methods: list[Function] = field(default_factory=list)
    properties: list[Property] = field(default_factory=list)
    statics: list[Variable] = field(default_factory=list)
    """VAR_STAT, shared by all instances."""
    dynamic: bool = False
    """Whether __NEW makes some."""
    init: Function | None = None
    """FB_Init; its inputs are what a declaration hands over."""

    @property
    def all_statics(self) -> list[Variable]:
        """Its own and the inherited ones."""
        return [*(self.base.all_statics if self.base else []), *self.statics]

    @property
    def maker(self) -> Function | None:
        """The FB_Init that takes arguments, its own or the inherited one."""
        return self.init or (self.base.maker if self.base else None)

    @property
    def members(self) -> list[Variable]:
        inherited = self.base.members if self.base else []
        return [*inherited, *self.inputs, *self.outputs, *self.locals]

    @property
    def all_inputs(self) -> list[Variable]:
        """Its own and the inherited ones."""
        return [*(self.base.all_inputs if self.base else []), *self.inputs]

    @property
    def all_methods(self) -> dict[str, Function]:
        """By name; what it overrides hides what it inherits."""
        inherited = self.base.all_methods if self.base else {}
        return {**inherited, **{m.name: m for m in self.methods}}

    @property
    def all_properties(self) -> dict[str, Property]:
        """As `all_methods`."""
        inherited = self.base.all_properties if self.base else {}
        return {**inherited, **{p.name: p for p in self.properties}}

    def is_a(self, other: Block) -> bool:
        """Whether an instance may stand where one of `other` is meant."""
        return self is other or (self.base is not None and self.base.is_a(other))


@dataclass(eq=False)
class Function:
    """A function, or a method of a block."""

    name: str
    result: Type
    inputs: list[Variable] = field(default_factory=list)
    in_outs: list[Variable] = field(default_factory=list)
    outputs: list[Variable] = field(default_factory=list)
    locals: list[Variable] = field(default_factory=list)
    statics: list[Variable] = field(default_factory=list)
    """VAR_STAT: kept from call to call."""
    kept: list[Variable] = field(default_factory=list)
    """VAR_INST of a method: kept in the instance."""
    body: list[Any] = field(default_factory=list)
    rank: int = 0
    """A method calls only methods of a lower rank, so that nothing is recursive; overriding keeps it."""


@dataclass(eq=False)
class Property:
    """A property of a block; `rank` as in `Function`."""

    name: str
    type: Type
    getter: Function
    setter: Function
    """Its input has the name of the property."""
    pure: bool
    """Get changes nothing, so that reading it may stand in an expression."""

    @property
    def rank(self) -> int:
        return self.getter.rank


Type = Scalar | Text | Enum | Subrange | Array | OpenArray | BitMember | Struct | Block | Pointer | Interface


@dataclass(frozen=True)
class Variable:
    """A variable; `initial` is a plain value or None for the default.

    Of an array a list of its first elements, of a structure a dict of some members.
    """

    name: str
    type: Type
    initial: Any = None
    arguments: tuple[Any, ...] | None = None
    """What FB_Init of a block gets."""
    constant: bool = False


@dataclass
class Program:
    """What one example builds."""

    types: list[Enum | Struct]
    functions: list[Function]
    blocks: list[Block]
    variables: list[Variable]
    body: list[Any]
    cycles: int = 1
    interfaces: list[Interface] = field(default_factory=list)
    globals: list[Variable] = field(default_factory=list)
    bits: list[tuple[str, int]] = field(default_factory=list)
    """Constants that name bits."""
    checks: bool = False
    """Whether the program brings check functions of its own."""


def derives(source: Type, target: Type) -> bool:
    """Whether a structure is another one, or extends it: it begins with its members."""
    while isinstance(source, Struct):
        if source == target:
            return True
        if source.base is None:
            return False
        source = source.base
    return False


def same_shape(source: Type, target: Type) -> bool:
    """Whether arrays have the same elements in the same order, whatever their bounds are."""
    if not isinstance(source, Array) or not isinstance(target, Array):
        return source == target
    lengths = [tuple(high - low for low, high in array.bounds) for array in (source, target)]
    return lengths[0] == lengths[1] and same_shape(source.element, target.element)


def base_of(type_: Type) -> Any:
    """Enumerations, subranges and bits count as their base type."""
    return type_.base if isinstance(type_, Enum | Subrange | BitMember) else type_

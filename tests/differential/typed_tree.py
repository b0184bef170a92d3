"""The tree of a random program and the typing rules of the language, written from the specification.

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
INTEGERS = (SINT, INT, DINT, LINT, USINT, UINT, UDINT, ULINT, BYTE, WORD, DWORD, LWORD)
REALS = (REAL, LREAL)
NUMBERS = INTEGERS + REALS


@dataclass(frozen=True)
class Text:
    """STRING(length)."""

    length: int

    @property
    def name(self) -> str:
        return f"STRING({self.length})"


@dataclass(frozen=True)
class Enum:
    """An enumeration; values as (name, number)."""

    name: str
    base: Scalar
    members: tuple[tuple[str, int], ...]


@dataclass(frozen=True)
class Subrange:
    """An integer type with limits, which nothing checks at run time."""

    base: Scalar
    low: int
    high: int

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
class Struct:
    """A structure."""

    name: str
    members: tuple[tuple[str, Type], ...]


@dataclass(eq=False)
class Block:
    """A function block with its methods."""

    name: str
    inputs: list[Variable] = field(default_factory=list)
    outputs: list[Variable] = field(default_factory=list)
    locals: list[Variable] = field(default_factory=list)
    body: list[Any] = field(default_factory=list)
    methods: list[Function] = field(default_factory=list)

    @property
    def members(self) -> list[Variable]:
        return [*self.inputs, *self.outputs, *self.locals]


@dataclass(eq=False)
class Function:
    """A function, or a method of a block."""

    name: str
    result: Type
    inputs: list[Variable] = field(default_factory=list)
    in_outs: list[Variable] = field(default_factory=list)
    locals: list[Variable] = field(default_factory=list)
    body: list[Any] = field(default_factory=list)


Type = Scalar | Text | Enum | Subrange | Array | Struct | Block


@dataclass(frozen=True)
class Variable:
    """A variable; `initial` is a plain value of a simple type or None for the default."""

    name: str
    type: Type
    initial: Any = None


@dataclass
class Program:
    """What one example builds."""

    types: list[Enum | Struct]
    functions: list[Function]
    blocks: list[Block]
    variables: list[Variable]
    body: list[Any]
    cycles: int = 1


# -- expressions ------------------------------------------------------------------------------------


@dataclass
class Expr:
    """Static type, machine type of the value, and whether only literals occur."""

    type: Type
    held: Any
    constant: bool


@dataclass
class Literal(Expr):
    value: Any
    untyped: bool = False


@dataclass
class Name(Expr):
    """A variable of the POU."""

    name: str


@dataclass
class Member(Expr):
    base: Expr
    name: str


@dataclass
class Index(Expr):
    base: Expr
    indices: list[Expr]


@dataclass
class Bit(Expr):
    base: Expr
    bit: int


@dataclass
class Unary(Expr):
    op: str
    operand: Expr


@dataclass
class Binary(Expr):
    """Arithmetic, bit operators, comparisons (computed in `computed`), AND_THEN and OR_ELSE."""

    op: str
    left: Expr
    right: Expr
    computed: Scalar


@dataclass
class Clock(Expr):
    """Arithmetic of times and dates whose operands have different types."""

    op: str
    left: Expr
    right: Expr


@dataclass
class Builtin(Expr):
    """SEL, MUX, MIN, MAX, LIMIT, shifts, conversions, string functions."""

    name: str
    args: list[Expr]
    taken: list[Any]
    """Type each argument is handed over as."""


# -- statements -------------------------------------------------------------------------------------


@dataclass
class Assign:
    target: Expr
    value: Expr


@dataclass
class If:
    branches: list[tuple[Expr, list[Any]]]
    otherwise: list[Any]


@dataclass
class Case:
    selector: Expr
    branches: list[tuple[list[tuple[int, int]], list[Any]]]
    otherwise: list[Any]


@dataclass
class For:
    counter: Name
    start: Expr
    stop: Expr
    step: int
    body: list[Any]


@dataclass
class While:
    """A loop that `guard`, a DINT of its own, ends after `limit` passes; `until` makes it a REPEAT."""

    condition: Expr
    guard: Name
    limit: int
    body: list[Any]
    until: bool


@dataclass
class Jump:
    """EXIT, CONTINUE or RETURN."""

    word: str


@dataclass
class CallFunction:
    target: Expr
    function: Function
    inputs: list[Expr]
    in_outs: list[Expr]
    instance: Expr | None = None
    """The block instance of a method."""


@dataclass
class CallBlock:
    instance: Expr
    inputs: list[tuple[str, Expr]]


# -- typing -----------------------------------------------------------------------------------------


def base_of(type_: Type) -> Any:
    """Enumerations and subranges count as their base type."""
    return type_.base if isinstance(type_, Enum | Subrange) else type_


def signed_of(bits: int) -> Scalar:
    return {32: DINT, 64: LINT}[bits]


def meet(left: Scalar, right: Scalar) -> tuple[Scalar, Scalar]:
    """Static type of the result of an arithmetic operator, and the type both operands are computed in."""
    if "real" in (left.kind, right.kind):
        reals = [x for x in (left, right) if x.kind == "real"]
        result = max(reals, key=lambda x: x.bits)
        return result, result
    signed_left, signed_right = left.kind == "signed", right.kind == "signed"
    if left.bits != right.bits:
        result = left if left.bits > right.bits else right
    elif signed_left or signed_right:
        result = left if signed_left else right
    else:
        result = right if left.kind == "bits" else left
    if result.bits < 32:
        return result, DINT
    if signed_left == signed_right:
        if signed_left:
            return result, signed_of(result.bits)
        return result, (UDINT if result.bits == 32 else ULINT)
    unsigned, signed = (right, left) if signed_left else (left, right)
    if unsigned.bits == 64:
        return result, result
    return result, signed_of(64 if unsigned.bits == 32 or signed.bits == 64 else 32)


def common(left: Scalar, right: Scalar) -> Scalar:
    """Type two values of SEL, MUX, MIN, MAX, LIMIT are handed over as."""
    if left == right:
        return left
    result, computed = meet(left, right)
    if (left.kind == "signed") != (right.kind == "signed") and result.kind != "real":
        return computed if computed.bits >= result.bits else result
    return result


def bit_type(left: Scalar, right: Scalar) -> Scalar:
    """AND, OR, XOR work in the wider type, of equal width the bit string."""
    if left.bits != right.bits:
        return left if left.bits > right.bits else right
    return left if left.kind == "bits" or right.kind != "bits" else right


def comparable(left: Scalar, right: Scalar) -> Scalar:
    """Type in which two values are compared: nothing is stored, so narrow values are not cut."""
    if left == right and not (left.integer and left.bits < 32):
        return left
    return meet(left, right)[1]


def assignable(source: Type, target: Type) -> bool:
    """Whether the language converts silently or with a warning."""
    if isinstance(source, Text) and isinstance(target, Text):
        return True
    if isinstance(target, Enum):
        return source is target
    a, b = base_of(source), base_of(target)
    if not isinstance(a, Scalar) or not isinstance(b, Scalar):
        return bool(source == target)
    if a == b:
        return True
    if a.integer and b.integer:
        return a.bits <= b.bits
    return b.kind == "real" and (a.integer or a.kind == "real")

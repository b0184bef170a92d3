"""The tree of a random program: expressions and statements over the types of `typed_types`."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

from typed_types import BOOL as BOOL
from typed_types import BYTE as BYTE
from typed_types import DATE as DATE
from typed_types import DINT as DINT
from typed_types import DT as DT
from typed_types import DWORD as DWORD
from typed_types import INT as INT
from typed_types import INTEGERS as INTEGERS
from typed_types import LDATE as LDATE
from typed_types import LDT as LDT
from typed_types import LINT as LINT
from typed_types import LREAL as LREAL
from typed_types import LTIME as LTIME
from typed_types import LTOD as LTOD
from typed_types import LWORD as LWORD
from typed_types import NUMBERS as NUMBERS
from typed_types import REAL as REAL
from typed_types import REALS as REALS
from typed_types import SINT as SINT
from typed_types import TIME as TIME
from typed_types import TOD as TOD
from typed_types import UDINT as UDINT
from typed_types import UINT as UINT
from typed_types import ULINT as ULINT
from typed_types import USINT as USINT
from typed_types import WORD as WORD
from typed_types import Array as Array
from typed_types import BitMember as BitMember
from typed_types import Block as Block
from typed_types import Enum as Enum
from typed_types import Function as Function
from typed_types import Interface as Interface
from typed_types import OpenArray as OpenArray
from typed_types import Pointer as Pointer
from typed_types import Program as Program
from typed_types import Property as Property
from typed_types import Scalar as Scalar
from typed_types import Struct as Struct
from typed_types import Subrange as Subrange
from typed_types import Text as Text
from typed_types import Type as Type
from typed_types import Variable as Variable
from typed_types import base_of as base_of
from typed_types import derives as derives
from typed_types import same_shape as same_shape

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
class Get(Expr):
    """A property: of an instance or interface, of THIS, or the one of the base (`fixed`) of SUPER."""

    base: Expr | None
    name: str
    via: str = ""
    fixed: Property | None = None


@dataclass
class Applied(Expr):
    """A call of a function or method inside an expression; operands are evaluated from left to right."""

    call: CallFunction


@dataclass
class Chained(Expr):
    """`(target := value)`."""

    target: Expr
    value: Expr


@dataclass
class Index(Expr):
    base: Expr
    indices: list[Expr]


@dataclass
class Deref(Expr):
    """What a pointer or a reference leads to."""

    base: Expr


@dataclass
class Bit(Expr):
    base: Expr
    bit: int
    constant_name: str = ""
    """A constant with this number."""


@dataclass
class Bound(Expr):
    """LOWER_BOUND or UPPER_BOUND of an open array; `dimension` counts from 0."""

    array: Name
    dimension: int
    upper: bool


@dataclass
class IsNull(Expr):
    """A pointer or REF_TO compared with NULL."""

    pointer: Name
    equal: bool


@dataclass
class SizeOf(Expr):
    """SIZEOF of a type."""

    of: Type


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
    """`:=`, or S= and R= on a BOOL; the target may be a property."""

    target: Expr
    value: Expr
    op: str = ":="


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
    """`counter` is a variable of its own that only the loop writes, or any place."""

    counter: Expr
    start: Expr
    stop: Expr
    step: int | Expr
    """A step in an expression is worked out in each pass and has the sign of its own type."""
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
    target: Expr | None
    """None inside an expression."""
    function: Function
    inputs: list[Expr]
    in_outs: list[Expr]
    instance: Expr | None = None
    """The block instance, or the interface, of a method."""
    via: str = ""
    """THIS or SUPER instead of an instance."""
    outputs: list[tuple[str, Expr]] = field(default_factory=list)
    """Outputs, and where they go after the call."""


@dataclass
class CallBlock:
    instance: Expr
    inputs: list[tuple[str, Expr]]
    outputs: list[tuple[str, Expr]] = field(default_factory=list)
    enable: Expr | None = None
    """EN: no call where it is FALSE."""
    success: Expr | None = None
    """Where ENO goes: the value of EN, also without a call."""


@dataclass
class CallBase:
    """SUPER^(): the body of the base, on the own instance."""

    block: Block


@dataclass
class Bind:
    """Makes a pointer, a reference or an interface lead to a place."""

    target: Name
    place: Expr


@dataclass
class Attempt:
    """`target ?= source`, what is done where it succeeds, and where `target` is NULL."""

    target: Name
    source: Expr
    """An instance, what a reference leads to, a REF_TO or an interface."""
    body: list[Any]
    otherwise: list[Any]


@dataclass
class Try:
    """__TRY; parts that are None are not there."""

    body: list[Any]
    code: Name | None
    """A DWORD that gets the number of the exception."""
    handler: list[Any] | None
    final: list[Any] | None


@dataclass
class New:
    """A variable made by __NEW, statements that use it, and __DELETE."""

    pointer: Name
    arguments: tuple[Any, ...]
    body: list[Any]

"""Expressions of the core IR: each has the type of its value."""

from __future__ import annotations

from dataclasses import dataclass, field

from tappet.core.ir.nodes import Expr, Stmt
from tappet.core.ir.places import Place


@dataclass(eq=False, slots=True)
class Const(Expr):
    """A number; BOOL as 0/1, PTR as 0 or an absolute address."""

    value: int | float


@dataclass(eq=False, slots=True)
class Load(Expr):
    """Value at a place."""

    place: Place
    align: int = 0
    """Known alignment; 0 means natural."""


@dataclass(eq=False, slots=True)
class Address(Expr):
    """Address of a place (type PTR)."""

    place: Place


@dataclass(eq=False, slots=True)
class Argument(Expr):
    """Value of parameter `number` of the current function (hidden ones first)."""

    number: int


@dataclass(eq=False, slots=True)
class FunctionAddress(Expr):
    """Address of a function (type PTR)."""

    name: str


@dataclass(eq=False, slots=True)
class Unary(Expr):
    """op: neg not abs; floats also sqrt floor ceil trunc round (half away)."""

    op: str
    operand: Expr


@dataclass(eq=False, slots=True)
class Binary(Expr):
    """op: add sub mul div rem and or xor shl shr rol ror min max, and offset (pointer plus bytes).

    Operands have the type of the result; the right operand of shifts and rotates is U32, that of offset I64.
    Integer div and rem: the divisor is not zero unless `checked`; the smallest number divided by -1 wraps.
    Shifts by the width or more give 0 (shl, unsigned shr) or the sign (signed shr); rotates count modulo
    the width.
    """

    op: str
    left: Expr
    right: Expr
    checked: bool = False
    exact: bool = False
    """The result does not leave the type; set by `ranges` and `loops`."""


@dataclass(eq=False, slots=True)
class Compare(Expr):
    """op: eq ne lt le gt ge on two operands of one type; the result is BOOL. `ne` is true for NaN."""

    op: str
    left: Expr
    right: Expr


@dataclass(eq=False, slots=True)
class Convert(Expr):
    """Conversion to `type` by value: integers are cut or extended by the sign of the source.

    Floats to integers: `mode` round (half away from zero) or trunc; outside the range they saturate, NaN
    is 0. BOOL gives 0 or 1. Integers to BOOL take bit 0; pointer and 64-bit integer convert as addresses.
    """

    operand: Expr
    mode: str = "round"


@dataclass(eq=False, slots=True)
class Reinterpret(Expr):
    """The same bits as another type of equal width (REAL as DWORD)."""

    operand: Expr


@dataclass(eq=False, slots=True)
class Select(Expr):
    """`then` if `condition` else `otherwise`; only the selected one is evaluated."""

    condition: Expr
    then: Expr
    otherwise: Expr


@dataclass(eq=False, slots=True)
class ShortCircuit(Expr):
    """op `and` / `or` on BOOL; the right operand is evaluated only when it decides."""

    op: str
    left: Expr
    right: Expr


@dataclass(eq=False, slots=True)
class Call(Expr):
    """Call of a function of this module or of an imported one; `type` is VOID for none."""

    function: str
    args: list[Expr]


@dataclass(eq=False, slots=True)
class CallPointer(Expr):
    """Call through an address with the C calling convention."""

    pointer: Expr
    args: list[Expr]


@dataclass(eq=False, slots=True)
class VirtualMethod:
    """What the virtual calls of one name on instances of one static type reach."""

    key: str
    """`virtual I_VALVE.STEP`: names it among the callees of a function."""
    slot: int = 0
    """Number of the method table."""
    targets: dict[int, str] = field(default_factory=dict)
    """Functions by type number of the instance: of the block types that have instances."""


@dataclass(eq=False, slots=True)
class CallVirtual(Expr):
    """Call of the method that the type number in the instance, the first argument, selects."""

    method: VirtualMethod
    args: list[Expr]


@dataclass(eq=False, slots=True)
class Intrinsic(Expr):
    """A machine-level operation.

    now_ns setjmp longjmp frame_address load_acquire store_release fetch_add compare_swap fence, the libm
    functions sin cos tan asin acos atan exp log log10 pow, strcompare wstrcompare (addresses; negative, 0,
    positive).
    """

    op: str
    args: list[Expr]


@dataclass(eq=False, slots=True)
class Sequence(Expr):
    """Statements, then a value."""

    statements: list[Stmt]
    value: Expr

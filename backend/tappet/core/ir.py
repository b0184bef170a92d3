"""The core IR: typed expressions over places in memory, structured statements, functions.

Everything implicit in the source is explicit here: conversions, bounds checks, hidden pointers, evaluation
order. Expressions and statements are trees; `Goto`/`Label` cover the few jumps of the languages. Nodes are
compared by identity and may be shared only when they are constants.

Scalars carry their signedness, so one `div` or `lt` serves all. Narrow integer arithmetic is done in 32 bits
by the lowering (LOPR-03); the IR itself never widens.
"""

from __future__ import annotations

from dataclasses import dataclass, field

# -- types ------------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Scalar:
    """Type of a value. BOOL is one bit as a value and one byte in memory (its bit 0 counts)."""

    name: str
    bits: int
    signed: bool = False
    floating: bool = False
    pointer: bool = False

    @property
    def size(self) -> int:
        """Bytes in memory."""
        return max(self.bits // 8, 1)

    @property
    def integer(self) -> bool:
        """Whether this is an integer type (BOOL is not)."""
        return not self.floating and not self.pointer and self.bits > 1


BOOL = Scalar("bool", 1)
I8, I16, I32, I64 = (Scalar(f"i{n}", n, signed=True) for n in (8, 16, 32, 64))
U8, U16, U32, U64 = (Scalar(f"u{n}", n) for n in (8, 16, 32, 64))
F32 = Scalar("f32", 32, signed=True, floating=True)
F64 = Scalar("f64", 64, signed=True, floating=True)
PTR = Scalar("ptr", 64, pointer=True)

SIGNED = {8: I8, 16: I16, 32: I32, 64: I64}
UNSIGNED = {8: U8, 16: U16, 32: U32, 64: U64}


# -- places -----------------------------------------------------------------------------------------


@dataclass(eq=False, slots=True)
class Local:
    """A variable of one function activation."""

    name: str
    size: int
    align: int
    type: Scalar | None = None
    """None for aggregates."""
    once: bool = False
    """A temporary that every reader finds as its one store left it."""


@dataclass(frozen=True, slots=True)
class Data:
    """Base of a place: a data object of the image (`tappet.data.PLC_PRG`) or a module constant."""

    symbol: str


@dataclass(frozen=True, slots=True)
class Self:
    """Base of a place: the function block instance the function works on; `type` is its upper-case name."""

    type: str


@dataclass(eq=False, slots=True)
class Indirect:
    """Base of a place: where a pointer value points to."""

    pointer: Expr
    align: int = 1
    own: bool = False
    """Memory that only this function reaches: the space for its result."""


Base = Data | Self | Local | Indirect


@dataclass(eq=False, slots=True)
class Subscript:
    """One dynamic index of a place: adds `(index - low) * stride` bytes."""

    index: Expr
    low: int
    high: int
    stride: int
    checked: bool = True
    """Whether an index outside low..high has to fault; cleared by `ranges` when it cannot happen."""


@dataclass(eq=False, slots=True)
class Place:
    """A memory location: base, constant byte offset and dynamic subscripts."""

    base: Base
    offset: int = 0
    subscripts: tuple[Subscript, ...] = ()
    root: int = -1
    """Offset of the outermost variable this is part of, inside base; -1 if unknown. Accesses with different
    roots on one base never overlap, because subscripts are checked."""


# -- expressions ------------------------------------------------------------------------------------


@dataclass(eq=False, slots=True)
class Expr:
    """Base of the expressions; `type` is the type of the value."""

    type: Scalar


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
    """Address of a place (type PTR). `element` is the size behind it that may be read, 0 if unknown."""

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


VOID = Scalar("void", 0)


# -- statements -------------------------------------------------------------------------------------


@dataclass(eq=False, slots=True)
class Stmt:
    """Base of the statements."""


@dataclass(eq=False, slots=True)
class Line(Stmt):
    """The following statements belong to this 1-based line of the function's source."""

    line: int
    column: int = 0


@dataclass(eq=False, slots=True)
class Store(Stmt):
    """Write a scalar."""

    place: Place
    value: Expr
    align: int = 0


@dataclass(eq=False, slots=True)
class Copy(Stmt):
    """Copy `size` bytes between places that are equal or do not overlap (`overlap`: they may)."""

    target: Place
    source: Place
    size: int
    align: int = 1
    overlap: bool = False


@dataclass(eq=False, slots=True)
class Fill(Stmt):
    """Set `size` bytes to `value`."""

    target: Place
    size: int
    value: int = 0
    align: int = 1


@dataclass(eq=False, slots=True)
class CopyBytes(Stmt):
    """Copy a computed number of bytes between two addresses that may overlap."""

    target: Expr
    source: Expr
    count: Expr


@dataclass(eq=False, slots=True)
class FillBytes(Stmt):
    """Set a computed number of bytes."""

    target: Expr
    value: Expr
    count: Expr


@dataclass(eq=False, slots=True)
class Evaluate(Stmt):
    """Evaluate for the effects."""

    value: Expr


@dataclass(eq=False, slots=True)
class If(Stmt):
    """Two-way branch."""

    condition: Expr
    then: list[Stmt]
    otherwise: list[Stmt]


@dataclass(eq=False, slots=True)
class SwitchCase:
    """Values low..high (inclusive) of each pair select the body."""

    ranges: list[tuple[int, int]]
    body: list[Stmt]


@dataclass(eq=False, slots=True)
class Switch(Stmt):
    """Multi-way branch on an integer; the first matching case wins, then `default`."""

    selector: Expr
    cases: list[SwitchCase]
    default: list[Stmt]


@dataclass(eq=False, slots=True)
class For(Stmt):
    """Counting loop: `counter := start`; while counter <= stop (>= if step < 0): body, counter += step.

    `stop` is evaluated before each pass. `step` is an expression when it is no constant. The counter wraps.
    """

    counter: Place
    type: Scalar
    start: Expr
    stop: Expr
    step: int | Expr
    body: list[Stmt]
    line: int = 0
    """Line of the head, for the code of check and increment."""
    fixed: bool = False
    """Nothing in the body writes the counter; set by `loops`."""


@dataclass(eq=False, slots=True)
class While(Stmt):
    """Loop checked before each pass."""

    condition: Expr
    body: list[Stmt]
    line: int = 0


@dataclass(eq=False, slots=True)
class Repeat(Stmt):
    """Loop left after a pass when `condition` holds."""

    body: list[Stmt]
    condition: Expr
    line: int = 0


@dataclass(eq=False, slots=True)
class Break(Stmt):
    """Leave the innermost loop."""


@dataclass(eq=False, slots=True)
class Continue(Stmt):
    """Next pass of the innermost loop."""


@dataclass(eq=False, slots=True)
class Return(Stmt):
    """Leave the function; the value of `Function.result_local` is returned."""


@dataclass(eq=False, slots=True)
class Label(Stmt):
    """Target of `Goto`."""

    name: str


@dataclass(eq=False, slots=True)
class Goto(Stmt):
    """Jump within the function."""

    name: str


@dataclass(eq=False, slots=True)
class FaultIf(Stmt):
    """Raise fault `code` with arguments when `condition` holds (expected never)."""

    condition: Expr
    code: int
    args: list[Expr]


@dataclass(eq=False, slots=True)
class CheckIndex(Stmt):
    """Raise ARRAY_BOUNDS when the index of a subscript is outside its bounds, without using it."""

    subscript: Subscript


@dataclass(eq=False, slots=True)
class Promoted(Stmt):
    """A loop during which scalar variables live in locals; `promote` makes these.

    `variables` holds (home, local, type, written). Written ones are stored back when the loop is left in any
    way, before a fault, and around every call that is not in `free`.
    """

    variables: list[tuple[Place, Local, Scalar, bool]]
    loop: Stmt
    free: frozenset[str] = frozenset()
    """Functions, and virtual methods, known to touch none of the variables."""


# -- functions and modules ----------------------------------------------------------------------------


@dataclass(eq=False, slots=True)
class Parameter:
    """A parameter as it is passed: scalars by value, everything else as PTR."""

    name: str
    type: Scalar
    readable: int = 0
    """Bytes that can be read at the pointer; 0 for unknown."""
    writable: bool = True
    """False: nothing is written through this pointer."""
    alone: bool = False
    """Nothing else the function can reach overlaps the target (results in fresh memory)."""
    align: int = 1


@dataclass(eq=False, slots=True)
class Function:
    """One body: POU, method, action, accessor, initialiser or task entry."""

    name: str
    """Linkage name: the qualified POU name, `PLC_PRG`, `FB_Motor.Start`, or an exported C symbol."""
    parameters: list[Parameter] = field(default_factory=list)
    result: Scalar = VOID
    result_local: Local | None = None
    locals: list[Local] = field(default_factory=list)
    body: list[Stmt] = field(default_factory=list)
    uri: str = ""
    line: int = 0
    exported: bool = False
    """Visible to the linker with the C calling convention."""
    returns_twice: bool = False
    """Calls setjmp."""
    inline: str = ""
    """"", "never" or "always"."""
    weight: int = 0
    """Rough size: statements and operands."""
    loops: bool = False
    """Whether the body contains a loop."""
    callees: set[str] | None = None
    """Functions it calls, and keys of virtual methods, once somebody has looked."""
    areas: dict[str, int] = field(default_factory=dict)
    """Bytes of the areas I, Q, M that the body reaches to."""
    assumed: dict[str, object] = field(default_factory=dict)
    """Effects of callees, virtual ones too, that register variables and inputs of this one rest on."""
    promoted_bases: set[str] = field(default_factory=set)
    """Data objects and block types whose exposure touches variables that this function keeps in registers."""
    subscripted: dict[Base, set[int]] = field(default_factory=dict)
    """Roots of places with subscripts, by base: what needs alias scopes."""
    input_copies: list[tuple[Copy, Local, int]] = field(default_factory=list)
    """Copies of aggregates passed by value, not yet looked at: the copy, into what, parameter number."""
    aliases: dict[Local, int] = field(default_factory=dict)
    """Locals that are what a pointer parameter points to: aggregates passed by value, not changed."""
    self_type: str = ""
    """Upper-case name of the function block type `parameters[0]` points to, if any."""
    cold: bool = False
    """Runs rarely (initialisers): optimise for size."""


@dataclass(eq=False, slots=True)
class External:
    """An imported C function."""

    name: str
    parameters: list[Scalar]
    result: Scalar = VOID
    noreturn: bool = False
    pure: bool = False
    """Reads and writes no memory."""


@dataclass(eq=False, slots=True)
class Constant:
    """Read-only bytes with a name (string literals, initial values)."""

    symbol: str
    data: bytes
    align: int = 1


@dataclass(eq=False, slots=True)
class DispatchTable:
    """Virtual methods of one function block type: function names by slot."""

    type_id: int
    methods: dict[int, str]


@dataclass(eq=False, slots=True)
class Module:
    """A whole application in core form."""

    functions: dict[str, Function] = field(default_factory=dict)
    externals: dict[str, External] = field(default_factory=dict)
    constants: dict[str, Constant] = field(default_factory=dict)
    data: dict[str, tuple[int, int]] = field(default_factory=dict)
    """Data objects used: symbol to (size, align)."""
    dispatch: list[DispatchTable] = field(default_factory=list)
    virtual: dict[str, VirtualMethod] = field(default_factory=dict)
    """What virtual calls reach, by key."""
    families: dict[str, frozenset[str]] = field(default_factory=dict)
    """Function block types that share bases, by each of their names."""
    containers: dict[str, set[str]] = field(default_factory=dict)
    """Data objects with instances of a function block type, by its name."""
    nested: dict[tuple[str, int], frozenset[str]] = field(default_factory=dict)
    """Function block types with instances in a variable: (data symbol or type name, root offset)."""
    exposed: set[tuple[str, int]] = field(default_factory=set)
    """Variables reachable through pointers: (data symbol or type name, root offset); offset -1 = all."""

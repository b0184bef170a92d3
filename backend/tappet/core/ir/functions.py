"""Functions of the core IR, and the module they make together."""

from __future__ import annotations

from dataclasses import dataclass, field

from tappet.core.ir.expressions import VirtualMethod
from tappet.core.ir.nodes import Stmt
from tappet.core.ir.places import Base, Local
from tappet.core.ir.statements import Copy
from tappet.core.ir.types import VOID, Scalar


@dataclass(eq=False, slots=True)
class Parameter:
    """A parameter as it is passed: scalars by value, everything else as PTR."""

    name: str
    type: Scalar
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
    labels: int = 0
    """How many labels its text has."""
    callees: set[str] | None = None
    """Functions it calls, and keys of virtual methods, once somebody has looked."""
    exposed: set[tuple[str, int]] = field(default_factory=set)
    """Variables whose addresses it makes known: (data symbol or block type, root offset); offset -1 = all."""
    areas: dict[str, int] = field(default_factory=dict)
    """Bytes of the areas I, Q, M that the body reaches to."""
    assumed: dict[str, object] = field(default_factory=dict)
    """Effects of callees, virtual ones too, that register variables and inputs of this one depend on."""
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


GUARD = "tappet_guard"
"""The C function that says where the next fault of the task returns to."""


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

    @property
    def catches_faults(self) -> bool:
        """Whether some code continues after a fault (`__TRY`): where an invalid pointer ends in one,
        memory has to be as the text says."""
        return GUARD in self.externals

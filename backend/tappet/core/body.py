"""State of lowering one body: its function, where its variables are, the statements so far."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

from tappet.core import ir
from tappet.core.program import LoweringError, Program
from tappet.core.scalars import convert, scalar_of
from tappet.lang import ast
from tappet.lang import types as t
from tappet.lang.analysis.result import carried_type
from tappet.lang.source import Scope, Source
from tappet.lang.symbols import PouSymbol, VarSymbol

if TYPE_CHECKING:
    from tappet.core.guard import Guard

VALUES: dict[type, Callable[..., ir.Expr]] = {}
"""Lowering of an expression to a scalar value, by node class."""
PLACES: dict[type, Callable[..., ir.Place]] = {}
"""Lowering of an expression to memory, by node class; strings and aggregates have no other form."""
BUILTIN_VALUES: dict[str, Callable[..., ir.Expr]] = {}
BUILTIN_PLACES: dict[str, Callable[..., ir.Place]] = {}
BUILTIN_STATEMENTS: dict[str, Callable[..., None]] = {}
"""Lowering of operators in functional form, by name of the BuiltinSymbol."""
TARGETS: dict[type, Callable[..., None]] = {}
"""Assignment to what is no variable, by class of the symbol."""
INITIALISERS: list[Callable[..., None]] = []
"""The one function that gives a place its initial value; set by `initial`."""


class Body:
    """One function under construction."""

    def __init__(self, program: Program, function: ir.Function, source: Source | None) -> None:
        self.program = program
        self.function = function
        self.last_line = 0
        """Line of the statement that is being lowered."""
        self.source = source
        self.pou: PouSymbol | None = None
        self.block: t.FunctionBlock | None = None
        """Type of the own instance; None in functions and programs."""
        self.own_data: ir.Place | None = None
        """What THIS^ is: the own instance, or the data of the program."""
        self.places: dict[int, ir.Place] = {}
        """id(VarSymbol) to place, for locals, parameters and the result."""
        self.entry: list[ir.Stmt] = []
        """Statements put before the body: hidden pointers that are read once."""
        self.out: list[ir.Stmt] = []
        self.in_outs: dict[int, ir.Local] = {}
        self.aggregate_inputs: list[tuple[ir.Local, int, int]] = []
        """Aggregates passed by address: (local, parameter number, size)."""
        self.changed: set[ir.Local] = set()
        """Aggregate inputs that the body may write to."""
        self.foreign_writes = False
        """Whether the body writes to memory that an aggregate input may share."""
        scope = source.scope if source is not None else Scope.APPLICATION
        self.checks = scope is not Scope.LIBRARY
        """Whether implicit check functions apply: to sources of the application, not to libraries."""
        self.leave: Callable[[], None] | None = None
        """Emits what is done wherever the body is left."""
        self.guards: list[Guard] = []
        """Open parts of `__TRY`, the innermost last."""
        self.loop_guards: list[int] = []
        """How many of them were open where each open loop began."""
        self.writing = False
        """Whether the place that is being worked out is written to; an argument of CheckPointer."""
        self.halt_points = False
        """Whether only `HaltPoint` is where a debugger may halt."""
        self.temporaries = 0
        self.held: dict[int, ir.Place] = {}
        """Where the accumulator of IL is kept, by the number of its `Hold`."""

    # -- statements ----------------------------------------------------------------------------------

    def emit(self, statement: ir.Stmt) -> None:
        """Append a statement."""
        self.out.append(statement)

    @contextmanager
    def block_of(self) -> Iterator[list[ir.Stmt]]:
        """Collect statements into a list of their own."""
        outer, self.out = self.out, []
        try:
            yield self.out
        finally:
            self.out = outer

    def line(self, node: ast.Node) -> None:
        """The following code belongs to the line of `node`."""
        self.function.weight += 1
        self.last_line = node.span[0] + 1
        self.out.append(ir.Line(self.last_line))

    def statement(self, node: ast.Node) -> None:
        """As `line`, of a statement of the body."""
        self.function.weight += 1
        span = node.span
        self.last_line = span[0] + 1
        self.out.append(ir.Line(self.last_line, span[1], True, span[2] + 1))

    # -- expressions ---------------------------------------------------------------------------------

    def value(self, e: ast.Expr) -> ir.Expr:
        """Value of a simple type, in the type analysis says it is carried in."""
        self.function.weight += 1
        if e.is_constant and e.constant is not None:
            scalar = scalar_of(carried_type(e))
            if scalar is not None and not isinstance(e.constant, str | bytes):
                return ir.Const(
                    scalar, int(e.constant) if e.constant is True or e.constant is False else e.constant
                )
        writing, self.writing = self.writing, False  # an index or pointer on the way to a target is read
        found = VALUES[e.__class__](self, e)
        self.writing = writing
        return found

    def value_as(self, e: ast.Expr, type_: t.Type | None) -> ir.Expr:
        """Value converted to the scalar of `type_`."""
        if isinstance(type_, t.Interface) and isinstance(e.type, t.FunctionBlock):
            place = self.place(e)
            self.program.expose(self.function, place, e.type)
            return ir.Address(ir.PTR, place)
        scalar = scalar_of(type_)
        assert scalar is not None
        return convert(self.value(e), scalar)

    def place(self, e: ast.Expr) -> ir.Place:
        """Where the object that `e` denotes lies; references denote the object referred to."""
        return PLACES[e.__class__](self, e)

    def target(self, e: ast.Expr) -> ir.Place:
        """As `place`, of what is written to."""
        self.writing = True
        found = self.place(e)
        self.writing = False
        return found

    # -- variables -----------------------------------------------------------------------------------

    def temp(self, scalar: ir.Scalar, once: bool = True) -> ir.Local:
        """A fresh scalar local; `once`: it is stored at one place only."""
        self.temporaries += 1
        return ir.Local(f"t{self.temporaries}", scalar.size, scalar.size, scalar, once)

    def space(self, size: int, align: int) -> ir.Local:
        """A fresh aggregate local."""
        self.temporaries += 1
        return ir.Local(f"t{self.temporaries}", size, max(align, 1))

    def local(self, name: str, type_: t.Type) -> ir.Local:
        """A local for a variable of `type_`."""
        return ir.Local(name, type_.size, type_.align, scalar_of(type_))

    def check_function(self, name: str) -> PouSymbol | None:
        """Implicit check function to call here; None inside libraries and inside the function itself."""
        if not self.checks:
            return None
        found = self.program.check(name)
        return None if found is self.pou else found

    def error(self, message: str, node: ast.Node) -> LoweringError:
        """An error at a node."""
        return LoweringError(message, self.source.uri if self.source else "", node.span)

    # -- places --------------------------------------------------------------------------------------

    def subscripted(self, place: ir.Place) -> ir.Place:
        """Register a place with subscripts for alias scopes."""
        if place.root >= 0 and isinstance(place.base, ir.Data | ir.Self):
            self.function.subscripted.setdefault(place.base, set()).add(place.root)
        return place

    def touch(self, place: ir.Place) -> None:
        """Note a write to a place."""
        base = place.base
        if isinstance(base, ir.Local):
            self.changed.add(base)
        elif not (isinstance(base, ir.Indirect) and base.own):
            self.foreign_writes = True

    def in_out_pointer(self, variable: VarSymbol, slot: ir.Place) -> ir.Local:
        """Local with the address a VAR_IN_OUT member holds, read once at the beginning of the body."""
        found = self.in_outs.get(id(variable))
        if found is None:
            found = self.in_outs[id(variable)] = self.temp(ir.PTR)
            self.entry.append(ir.Store(ir.Place(found), ir.Load(ir.PTR, slot)))
        return found

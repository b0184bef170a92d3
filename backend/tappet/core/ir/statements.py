"""Statements of the core IR: stores, calls, structured flow, checks that end in a fault."""

from __future__ import annotations

from dataclasses import dataclass

from tappet.core.ir.nodes import Expr, Stmt
from tappet.core.ir.places import Local, Place, Subscript
from tappet.core.ir.types import Scalar


@dataclass(eq=False, slots=True)
class Line(Stmt):
    """The following statements belong to this 1-based line of the function's source."""

    line: int
    column: int = 0
    statement: bool = False
    """A statement of the body or the condition of an ELSIF or UNTIL begins here: where the instrumented
    variant may halt."""
    end_line: int = 0
    """Last line of that statement."""


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

    `stop` is evaluated before each pass. `step` is an expression when it is no constant: it has the width of
    the counter, and its own sign, as a counter without sign may count down. The counter wraps.
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
    """Nothing in the loop writes the counter, and `stop` does not read it; set by `loops`."""


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
    until: Line
    """Place of the condition."""


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

"""Statements of the syntax tree."""

from __future__ import annotations

from dataclasses import dataclass, field

from tappet.lang.ast.expressions import Call, Expr, Literal
from tappet.lang.ast.fields import RESOLVED_TREE
from tappet.lang.ast.node import Node, Pragma
from tappet.lang.source import NOWHERE, Span


@dataclass(slots=True, kw_only=True)
class Stmt(Node):
    """Base of the statements."""

    label: str | None = None
    """Jump label written before the statement."""


@dataclass(slots=True, kw_only=True)
class Assign(Stmt):
    """`target op value`; op is `:=`, `S=`, `R=`, `REF=` or `?=`. Chained assignments nest as AssignExpr in
    `value`."""

    op: str
    target: Expr
    value: Expr


@dataclass(slots=True, kw_only=True)
class CallStmt(Stmt):
    """A call as statement."""

    call: Call


@dataclass(slots=True, kw_only=True)
class ExprStmt(Stmt):
    """An expression standing alone (reported as without effect)."""

    expr: Expr
    call: Call | None = field(default=None, metadata=RESOLVED_TREE)
    """The call that is meant where `expr` names what can be called: an action, a program, an instance."""


@dataclass(slots=True, kw_only=True)
class If(Stmt):
    """IF / ELSIF / ELSE. `branches` holds (condition, body)."""

    branches: list[tuple[Expr, list[Stmt]]]
    otherwise: list[Stmt] | None = None


@dataclass(slots=True, kw_only=True)
class CaseRange(Node):
    """One selector of a CASE: `low` or `low..high`."""

    low: Expr
    high: Expr | None = None


@dataclass(slots=True, kw_only=True)
class CaseBranch(Node):
    """Selectors and the body they select."""

    selectors: list[CaseRange]
    body: list[Stmt]


@dataclass(slots=True, kw_only=True)
class Case(Stmt):
    """CASE selector OF ... ELSE ... END_CASE."""

    selector: Expr
    branches: list[CaseBranch]
    otherwise: list[Stmt] | None = None


@dataclass(slots=True, kw_only=True)
class For(Stmt):
    """FOR variable := start TO stop BY step DO."""

    variable: Expr
    start: Expr
    stop: Expr
    step: Expr | None
    body: list[Stmt]


@dataclass(slots=True, kw_only=True)
class While(Stmt):
    """WHILE condition DO."""

    condition: Expr
    body: list[Stmt]


@dataclass(slots=True, kw_only=True)
class RepeatUntil(Stmt):
    """REPEAT body UNTIL condition END_REPEAT."""

    body: list[Stmt]
    condition: Expr


@dataclass(slots=True, kw_only=True)
class Exit(Stmt):
    """EXIT: leaves the innermost loop."""


@dataclass(slots=True, kw_only=True)
class Continue(Stmt):
    """CONTINUE: next turn of the innermost loop."""


@dataclass(slots=True, kw_only=True)
class Return(Stmt):
    """RETURN."""


@dataclass(slots=True, kw_only=True)
class Jump(Stmt):
    """JMP label."""

    target: str
    target_span: Span = NOWHERE


@dataclass(slots=True, kw_only=True)
class Hold(Stmt):
    """Computes a value and keeps it for every `Held` of the same number: the accumulator of IL."""

    slot: int
    value: Expr


@dataclass(slots=True, kw_only=True)
class HaltPoint(Stmt):
    """Computes nothing: where a debugger may halt in a body that was made from a graph, as at the steps of a
    chart. The other statements of such a body are no places to halt."""


@dataclass(slots=True, kw_only=True)
class Empty(Stmt):
    """A lone semicolon, or a label with nothing after it."""


@dataclass(slots=True, kw_only=True)
class PragmaStmt(Stmt):
    """A pragma among statements."""

    pragma: Pragma


@dataclass(slots=True, kw_only=True)
class Described:
    """Literals of a statement that take what is declared about a variable."""

    of: Expr
    address: Literal
    comment: Literal


@dataclass(slots=True, kw_only=True)
class WhenDeclared(Stmt):
    """`body` where every one of `names` is a variable here, else `otherwise`: what a chart becomes depends on
    the flags that are declared, and on whether an association names an action or a BOOL variable."""

    names: list[str]
    body: list[Stmt]
    otherwise: list[Stmt]
    step: str | None = None
    """The step that names an action: an unknown name is an error, reported once: empty in a second place."""
    role: str | None = None
    """STEP, ENTRY or EXIT where only an action may stand."""
    described: Described | None = None
    """What `body` says about a variable."""
    chosen: list[Stmt] = field(default_factory=list, metadata=RESOLVED_TREE)


@dataclass(slots=True, kw_only=True)
class Try(Stmt):
    """__TRY ... __CATCH(variable) ... __FINALLY ... __ENDTRY."""

    body: list[Stmt]
    caught: bool
    """Whether there is a __CATCH."""
    exception: Expr | None
    handler: list[Stmt]
    final: list[Stmt]

"""Expressions of the syntax tree: literals, names and access paths, operators, calls, initial values."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from tappet.lang.ast.fields import ELSEWHERE, RESOLVED, RESOLVED_TREE
from tappet.lang.ast.node import Constant, Node
from tappet.lang.source import NOWHERE, Span

if TYPE_CHECKING:
    from tappet.lang.ast.declarations import TypeRef
    from tappet.lang.symbols import Symbol
    from tappet.lang.types import Type


@dataclass(slots=True, kw_only=True)
class Expr(Node):
    """Base of the expressions."""

    type: Type | None = field(default=None, metadata=RESOLVED)
    """Static type; None after an error that has been reported."""
    constant: Constant = field(default=None, metadata=RESOLVED)
    """Folded value when the expression is constant, else None (use `is_constant`)."""
    is_constant: bool = field(default=False, metadata=RESOLVED)
    untyped: bool = field(default=False, metadata=RESOLVED)
    """Constant made of literals without type prefix only: it adapts to the type its context needs
    (LOPR-02)."""


@dataclass(slots=True, kw_only=True)
class Literal(Expr):
    """A literal as written: `12`, `16#FF`, `INT#3`, `T#5s`, `'abc'`, `TRUE`, `1.5e3`."""

    text: str
    kind: str
    """bool int real string wstring time ltime date tod dt ldate ltod ldt."""
    prefix: str | None = None
    """Type prefix of a typed literal (`INT` in `INT#3`), upper case."""
    value: Constant = None
    """Decoded by the lexer in the unit of the kind."""


@dataclass(slots=True, kw_only=True)
class Name(Expr):
    """An identifier, or a direct address (`%MB193`). `leading_dot` marks `.name`, the global one (GVL-05)."""

    name: str
    leading_dot: bool = False
    symbol: Symbol | None = field(default=None, metadata=RESOLVED)


@dataclass(slots=True, kw_only=True)
class Member(Expr):
    """`base.name`: member, property, method, enum value, namespace, or bit (`base.3`, name "3")."""

    base: Expr
    name: str
    name_span: Span = NOWHERE
    symbol: Symbol | None = field(default=None, metadata=RESOLVED)
    bit: int | None = field(default=None, metadata=RESOLVED)
    """Bit number for a bit access (also through a named constant)."""


@dataclass(slots=True, kw_only=True)
class Index(Expr):
    """`base[i, j]` on arrays, pointers and strings."""

    base: Expr
    indices: list[Expr]


@dataclass(slots=True, kw_only=True)
class Deref(Expr):
    """`base^`."""

    base: Expr


@dataclass(slots=True, kw_only=True)
class Unary(Expr):
    """`-x`, `+x`, `NOT x`. `op` is "-", "+" or "NOT"."""

    op: str
    operand: Expr
    operand_type: Type | None = field(default=None, metadata=RESOLVED)
    """Type the operand is converted to before the operation."""


@dataclass(slots=True, kw_only=True)
class Binary(Expr):
    """Two operands; `op` upper case: + - * / MOD ** AND OR XOR AND_THEN OR_ELSE = <> < > <= >=  (& becomes
    AND)."""

    op: str
    left: Expr
    right: Expr
    operand_type: Type | None = field(default=None, metadata=RESOLVED)
    """Common type both operands are converted to before the operation."""


@dataclass(slots=True, kw_only=True)
class Argument(Node):
    """One actual parameter: `x`, `name := x`, `name => x`; value None for `name =>` or `name :=` left
    empty."""

    name: str | None
    value: Expr | None
    output: bool = False
    parameter: Symbol | None = field(default=None, metadata=RESOLVED)


@dataclass(slots=True, kw_only=True)
class Call(Expr):
    """Call of a function, FB instance, method, program, action, or an operator in functional form."""

    callee: Expr
    args: list[Argument]
    accumulator: Argument | None = field(default=None, metadata=ELSEWHERE)
    """The first of `args` when it is the accumulator of IL; analysis leaves it out where nothing takes it."""
    target: Symbol | None = field(default=None, metadata=RESOLVED)
    """PouSymbol for functions, methods, programs and the body of an FB; BuiltinSymbol for operators."""
    expansion: Expr | None = field(default=None, metadata=RESOLVED_TREE)
    """The same in operator form, for operators in functional form: `ADD(a, b)` is `a + b`, `MOVE(x)` is
    `x`."""
    gate: Expr | None = field(default=None, metadata=RESOLVED)
    """EN of an instance or program that does not declare it, made of nodes in `args`: the call is made where
    it is TRUE."""


@dataclass(slots=True, kw_only=True)
class ArrayInit(Expr):
    """`[1, 3(7), [..]]`; an element is an expression, or a Repeat."""

    elements: list[Expr]
    bare: bool = False
    """Whether it stands without brackets, as in CoDeSys 2.3, where the text alone does not show an array."""


@dataclass(slots=True, kw_only=True)
class Repeat(Expr):
    """`n(value, ...)` inside an array initialiser; empty `values` means n defaults."""

    count: Expr
    values: list[Expr]


@dataclass(slots=True, kw_only=True)
class StructInit(Expr):
    """`(a := 1, b := 2)` as initial value of a structure or FB instance."""

    fields: list[Argument]


@dataclass(slots=True, kw_only=True)
class This(Expr):
    """THIS."""


@dataclass(slots=True, kw_only=True)
class Super(Expr):
    """SUPER."""


@dataclass(slots=True, kw_only=True)
class AssignExpr(Expr):
    """Assignment inside an expression (ExST): `a := b := c`, `IF (x := f()) THEN`; op `:=`, `S=`, `R=`,
    `REF=`."""

    op: str
    target: Expr
    value: Expr


@dataclass(slots=True, kw_only=True)
class Held(Expr):
    """What the `Hold` of this number has computed: the accumulator of IL."""

    slot: int
    carried: Type | None = field(default=None, metadata=RESOLVED)
    """Type in which the value is kept."""


@dataclass(slots=True, kw_only=True)
class TypeOperand(Expr):
    """`POINTER TO X` where an operator takes a type: __NEW, SIZEOF."""

    ref: TypeRef


@dataclass(slots=True, kw_only=True)
class ErrorExpr(Expr):
    """Stands where the parser found no expression; already reported."""

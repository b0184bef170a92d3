"""The syntax tree of the textual languages; the graphical ones are lowered to it as well.

Nodes are mutable dataclasses: the parser fills the syntax, `analysis` fills the fields below the line
`# resolved` (types, symbols, constant values) exactly once; nobody rewrites the tree afterwards.
Every node carries the span of its text. Names keep the spelling of the source; look-ups are
case-insensitive and use the upper-case form.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from tappet.lang.source import NOWHERE, Source, Span

if TYPE_CHECKING:
    from tappet.lang.symbols import Symbol
    from tappet.lang.types import Type

Constant = bool | int | float | str | bytes | None
"""Folded value of a constant expression: numbers in the unit of their type (TIME in ms, LTIME in ns,
DATE and DT in s, TOD in ms), STRING as bytes (latin-1), WSTRING as str."""


@dataclass(slots=True, kw_only=True)
class Node:
    """Anything with a place in the text."""

    span: Span = NOWHERE


@dataclass(slots=True, kw_only=True)
class Pragma(Node):
    """`{...}`: attribute, message, conditional or region, as written without the braces."""

    text: str
    # attribute pragmas only
    attribute: str | None = None
    value: str | None = None


# -- expressions ------------------------------------------------------------------------------------


@dataclass(slots=True, kw_only=True)
class Expr(Node):
    """Base of the expressions."""

    # resolved
    type: Type | None = None
    """Static type; None after an error that has been reported."""
    constant: Constant = None
    """Folded value when the expression is constant, else None (use `is_constant`)."""
    is_constant: bool = False
    untyped: bool = False
    """Constant made of literals without type prefix only: it adapts to the type its context needs
    (LOPR-02)."""


@dataclass(slots=True, kw_only=True)
class Literal(Expr):
    """A literal as written: `12`, `16#FF`, `INT#3`, `T#5s`, `'abc'`, `TRUE`, `1.5e3`."""

    text: str
    kind: str
    """bool int real string wstring time ltime date tod dt ldate ltod ldt null."""
    prefix: str | None = None
    """Type prefix of a typed literal (`INT` in `INT#3`), upper case."""
    value: Constant = None
    """Decoded by the lexer in the unit of the kind."""


@dataclass(slots=True, kw_only=True)
class Name(Expr):
    """An identifier, or a direct address (`%MB193`). `leading_dot` marks `.name`, the global one (GVL-05)."""

    name: str
    leading_dot: bool = False
    # resolved
    symbol: Symbol | None = None


@dataclass(slots=True, kw_only=True)
class Member(Expr):
    """`base.name`: member, property, method, enum value, namespace, or bit (`base.3`, name "3")."""

    base: Expr
    name: str
    name_span: Span = NOWHERE
    # resolved
    symbol: Symbol | None = None
    bit: int | None = None
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
    # resolved
    operand_type: Type | None = None
    """Type the operand is converted to before the operation."""


@dataclass(slots=True, kw_only=True)
class Binary(Expr):
    """Two operands; `op` upper case: + - * / MOD ** AND OR XOR AND_THEN OR_ELSE = <> < > <= >=  (& becomes
    AND)."""

    op: str
    left: Expr
    right: Expr
    # resolved
    operand_type: Type | None = None
    """Common type both operands are converted to before the operation."""


@dataclass(slots=True, kw_only=True)
class Argument(Node):
    """One actual parameter: `x`, `name := x`, `name => x`; value None for `name =>` or `name :=` left
    empty."""

    name: str | None
    value: Expr | None
    output: bool = False
    # resolved
    parameter: Symbol | None = None


@dataclass(slots=True, kw_only=True)
class Call(Expr):
    """Call of a function, FB instance, method, program, action, or an operator in functional form."""

    callee: Expr
    args: list[Argument]
    accumulator: Argument | None = None
    """The first of `args` when it is the accumulator of IL; analysis leaves it out where nothing takes it."""
    # resolved
    target: Symbol | None = None
    """PouSymbol for functions, methods, programs and the body of an FB; BuiltinSymbol for operators."""
    expansion: Expr | None = None
    """The same in operator form, for operators in functional form: `ADD(a, b)` is `a + b`, `MOVE(x)` is
    `x`."""


@dataclass(slots=True, kw_only=True)
class ArrayInit(Expr):
    """`[1, 3(7), [..]]`; an element is an expression, or a Repeat."""

    elements: list[Expr]
    bare: bool = False
    """Whether it stands without brackets, as in CoDeSys 2.3, where the text alone does not tell an array."""


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
    # resolved
    carried: Type | None = None
    """Type in which the value is kept."""


@dataclass(slots=True, kw_only=True)
class ErrorExpr(Expr):
    """Stands where the parser found no expression; already reported."""


# -- statements -------------------------------------------------------------------------------------


@dataclass(slots=True, kw_only=True)
class Stmt(Node):
    """Base of the statements."""

    label: str | None = None
    """Jump label written before the statement."""


@dataclass(slots=True, kw_only=True)
class Assign(Stmt):
    """`target op value`; op is `:=`, `S=`, `R=` or `REF=`. Chained assignments nest as AssignExpr in
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
    # resolved
    call: Call | None = None
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
class Empty(Stmt):
    """A lone semicolon, or a label with nothing after it."""


@dataclass(slots=True, kw_only=True)
class PragmaStmt(Stmt):
    """A pragma among statements."""

    pragma: Pragma


@dataclass(slots=True, kw_only=True)
class WhenDeclared(Stmt):
    """`body` where every one of `names` is a variable here, else `otherwise`: what a chart becomes depends on
    the flags that are declared, and on whether an association names an action or a BOOL variable."""

    names: list[str]
    body: list[Stmt]
    otherwise: list[Stmt]
    step: str | None = None
    """The step that names an action: an unknown name is an error then."""
    # resolved
    chosen: list[Stmt] = field(default_factory=list)


@dataclass(slots=True, kw_only=True)
class Try(Stmt):
    """__TRY ... __CATCH(variable) ... __FINALLY ... __ENDTRY."""

    body: list[Stmt]
    exception: Expr | None
    handler: list[Stmt]
    final: list[Stmt]


# -- declarations -----------------------------------------------------------------------------------


@dataclass(slots=True, kw_only=True)
class TypeRef(Node):
    """A type as written."""

    # resolved
    type: Type | None = None


@dataclass(slots=True, kw_only=True)
class NamedType(TypeRef):
    """`INT`, `Namespace.FB_Motor`, for instances with arguments of FB_Init."""

    name: str
    args: list[Argument] | None = None
    """Written `FB(1, x := 2)`."""
    elements: list[InitArguments] = field(default_factory=list)
    """Written `ARRAY[1..2] OF FB[(1), (x := 2)]`: those of each element, in storage order."""


@dataclass(slots=True, kw_only=True)
class InitArguments(Node):
    """FB_Init arguments of one element of an array of instances."""

    args: list[Argument]


@dataclass(slots=True, kw_only=True)
class StringType(TypeRef):
    """STRING, STRING(20), STRING[20], WSTRING(...)."""

    wide: bool
    length: Expr | None = None


@dataclass(slots=True, kw_only=True)
class SubrangeType(TypeRef):
    """`INT(1..10)`."""

    base: str
    low: Expr
    high: Expr


@dataclass(slots=True, kw_only=True)
class ArrayType(TypeRef):
    """ARRAY[...] OF element; a bound pair of None is `*`."""

    bounds: list[tuple[Expr | None, Expr | None]]
    element: TypeRef


@dataclass(slots=True, kw_only=True)
class PointerType(TypeRef):
    """POINTER TO base."""

    base: TypeRef


@dataclass(slots=True, kw_only=True)
class ReferenceType(TypeRef):
    """REFERENCE TO base."""

    base: TypeRef


@dataclass(slots=True, kw_only=True)
class EnumValue(Node):
    """One value of an enumeration."""

    name: str
    value: Expr | None = None
    comment: str = ""
    # resolved
    number: int = 0


@dataclass(slots=True, kw_only=True)
class EnumType(TypeRef):
    """`(a, b := 5) UINT := b`; the default is kept on the declaration."""

    values: list[EnumValue]
    base: str | None = None


@dataclass(slots=True, kw_only=True)
class StructType(TypeRef):
    """STRUCT or UNION with members."""

    members: list[VarDecl]
    union: bool = False


@dataclass(slots=True, kw_only=True)
class VarDecl(Node):
    """One variable; `a, b : INT` gives two with equal type and initial value."""

    name: str
    name_span: Span = NOWHERE
    type_ref: TypeRef
    initial: Expr | None = None
    initial_ref: bool = False
    """Initialised by `REF=`."""
    address: str | None = None
    """`%IX0.0`, `%QW*` as written after AT, upper case."""
    attributes: list[Pragma] = field(default_factory=list)
    comment: str = ""
    """Comment on the same line or the lines above, without its marks."""
    # resolved
    symbol: Symbol | None = None
    init: Expr | None = None
    """What initialises the variable: `initial`, or the initial value of its alias type, else None."""


@dataclass(slots=True, kw_only=True)
class VarBlock(Node):
    """VAR ... END_VAR. `section` is the keyword; `flags` of CONSTANT, RETAIN, NON_RETAIN, PERSISTENT."""

    section: str
    flags: set[str]
    variables: list[VarDecl]
    attributes: list[Pragma] = field(default_factory=list)


@dataclass(slots=True, kw_only=True)
class Declaration(Node):
    """Base of what a source text declares."""

    name: str
    name_span: Span = NOWHERE
    source: Source | None = None
    attributes: list[Pragma] = field(default_factory=list)
    comment: str = ""
    """Documentation comment above the declaration."""


@dataclass(slots=True, kw_only=True)
class Accessor(Node):
    """GET or SET of a property."""

    blocks: list[VarBlock]
    body: list[Stmt]


@dataclass(slots=True, kw_only=True)
class Property(Declaration):
    """PROPERTY name : type."""

    type_ref: TypeRef | None
    access: str = "PUBLIC"
    modifiers: set[str] = field(default_factory=set)
    getter: Accessor | None = None
    setter: Accessor | None = None


@dataclass(slots=True, kw_only=True)
class Pou(Declaration):
    """PROGRAM, FUNCTION, FUNCTION_BLOCK, METHOD, ACTION or TRANSITION (`kind`, the keyword itself)."""

    kind: str
    return_type: TypeRef | None = None
    blocks: list[VarBlock] = field(default_factory=list)
    body: list[Stmt] = field(default_factory=list)
    language: str = "ST"
    extends: str | None = None
    extends_span: Span = NOWHERE
    implements: list[str] = field(default_factory=list)
    implements_spans: list[Span] = field(default_factory=list)
    access: str = "PUBLIC"
    modifiers: set[str] = field(default_factory=set)
    """Of ABSTRACT, FINAL, OVERRIDE."""
    methods: list[Pou] = field(default_factory=list)
    actions: list[Pou] = field(default_factory=list)
    properties: list[Property] = field(default_factory=list)
    owner: Pou | None = None
    # resolved
    symbol: Symbol | None = None


@dataclass(slots=True, kw_only=True)
class Interface(Declaration):
    """INTERFACE with its method and property heads."""

    extends: list[str] = field(default_factory=list)
    extends_spans: list[Span] = field(default_factory=list)
    methods: list[Pou] = field(default_factory=list)
    properties: list[Property] = field(default_factory=list)
    # resolved
    symbol: Symbol | None = None


@dataclass(slots=True, kw_only=True)
class TypeDecl(Declaration):
    """TYPE name : ... END_TYPE; `extends` for structures."""

    type_ref: TypeRef
    initial: Expr | None = None
    extends: str | None = None
    extends_span: Span = NOWHERE
    # resolved
    type: Type | None = None


@dataclass(slots=True, kw_only=True)
class GlobalList(Declaration):
    """A global variable list; its name comes from the object. Also VAR_CONFIG blocks."""

    blocks: list[VarBlock]


@dataclass(slots=True, kw_only=True)
class Unit(Node):
    """Everything one source text declares, in order."""

    source: Source
    declarations: list[Declaration]

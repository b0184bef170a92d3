"""Declarations of the syntax tree: types as written, variables, POUs and what else a text declares."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from tappet.lang.ast.expressions import Argument, Expr
from tappet.lang.ast.fields import ELSEWHERE, RESOLVED, RESOLVED_TREE
from tappet.lang.ast.node import Node, Pragma
from tappet.lang.ast.statements import Stmt
from tappet.lang.source import NOWHERE, GivenValue, Source, Span

if TYPE_CHECKING:
    from tappet.lang.symbols import Symbol
    from tappet.lang.types import Type


@dataclass(slots=True, kw_only=True)
class TypeRef(Node):
    """A type as written."""

    type: Type | None = field(default=None, metadata=RESOLVED)


@dataclass(slots=True, kw_only=True)
class NamedType(TypeRef):
    """`INT`, `Namespace.FB_Motor`, for instances with arguments of FB_Init."""

    name: str
    args: list[Argument] | None = None
    """Written `FB(1, x := 2)`."""
    elements: list[InitArguments] = field(default_factory=list)
    """Written `ARRAY[1..2] OF FB[(1), (x := 2)]`: those of each element, in storage order."""
    generic: str = ""
    """`FB` of `FB<20>`; `name` is that of the block with these values once `analysis.generic` has made it."""
    values: list[Expr] = field(default_factory=list)
    """Values of the generic constants."""


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
    """POINTER TO base, or REF_TO base."""

    base: TypeRef
    ref_to: bool = False


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
    number: int = field(default=0, metadata=RESOLVED)


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


@dataclass(frozen=True, slots=True)
class Monitored:
    """The property whose value a variable keeps for monitoring."""

    property_name: str
    """Under which the variable is watched."""
    request: str | None = None
    """Name of the variable that asks the task to call Get; None where accessors keep the value."""


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
    given: GivenValue | None = None
    """What `initial` was read from where a library reference gives a value to this parameter."""
    monitored: Monitored | None = None
    """Of a variable that analysis declares for a monitored property."""
    own_initial: Expr | None = None
    """The value of a parameter that `given` took the place of."""
    symbol: Symbol | None = field(default=None, metadata=RESOLVED)
    init: Expr | None = field(default=None, metadata=RESOLVED_TREE)
    """What initialises the variable: `initial`, or the initial value of its alias type, else None."""


@dataclass(slots=True, kw_only=True)
class VarBlock(Node):
    """VAR ... END_VAR. `section` is the keyword; `flags` of CONSTANT, RETAIN, NON_RETAIN, PERSISTENT and
    the access specifiers."""

    section: str
    flags: set[str]
    variables: list[VarDecl]
    attributes: list[Pragma] = field(default_factory=list)
    generic: bool = False
    """VAR_GENERIC CONSTANT: each instance says the values; a VAR CONSTANT otherwise."""


@dataclass(slots=True, kw_only=True)
class Declaration(Node):
    """Base of what a source text declares."""

    name: str
    name_span: Span = NOWHERE
    source: Source | None = None
    attributes: list[Pragma] = field(default_factory=list)
    comment: str = ""
    """Documentation comment above the declaration."""
    access: str = "PUBLIC"
    """PUBLIC, PRIVATE, PROTECTED or INTERNAL."""


@dataclass(slots=True, kw_only=True)
class Accessor(Node):
    """GET or SET of a property."""

    blocks: list[VarBlock]
    body: list[Stmt]
    language: str = "ST"


@dataclass(slots=True, kw_only=True)
class Property(Declaration):
    """PROPERTY name : type."""

    type_ref: TypeRef | None
    modifiers: set[str] = field(default_factory=set)
    getter: Accessor | None = None
    setter: Accessor | None = None


@dataclass(slots=True, kw_only=True)
class Graph(Node):
    """A body that is no list of statements, as its reader found it: a chart, or what is drawn."""

    language: str
    """Whose reader lowers it."""


@dataclass(slots=True, kw_only=True)
class Pou(Declaration):
    """PROGRAM, FUNCTION, FUNCTION_BLOCK, METHOD, ACTION or TRANSITION (`kind`, the keyword itself)."""

    kind: str
    return_type: TypeRef | None = None
    blocks: list[VarBlock] = field(default_factory=list)
    body: list[Stmt] = field(default_factory=list)
    language: str = "ST"
    graph: Graph | None = None
    """The body where it is no list of statements, until `lang.lowering` has made it one."""
    extends: str | None = None
    extends_span: Span = NOWHERE
    extends_type: NamedType | None = None
    """The base where it has generic constants: `EXTENDS FB<20>`."""
    implements: list[str] = field(default_factory=list)
    implements_spans: list[Span] = field(default_factory=list)
    modifiers: set[str] = field(default_factory=set)
    """Of ABSTRACT, FINAL, OVERRIDE."""
    methods: list[Pou] = field(default_factory=list)
    actions: list[Pou] = field(default_factory=list)
    properties: list[Property] = field(default_factory=list)
    owner: Pou | None = field(default=None, metadata=ELSEWHERE)
    symbol: Symbol | None = field(default=None, metadata=RESOLVED)


@dataclass(slots=True, kw_only=True)
class Interface(Declaration):
    """INTERFACE with its method and property heads."""

    extends: list[str] = field(default_factory=list)
    extends_spans: list[Span] = field(default_factory=list)
    methods: list[Pou] = field(default_factory=list)
    properties: list[Property] = field(default_factory=list)
    symbol: Symbol | None = field(default=None, metadata=RESOLVED)


@dataclass(slots=True, kw_only=True)
class TypeDecl(Declaration):
    """TYPE name : ... END_TYPE; `extends` for structures."""

    type_ref: TypeRef
    initial: Expr | None = None
    extends: str | None = None
    extends_span: Span = NOWHERE
    type: Type | None = field(default=None, metadata=RESOLVED)


@dataclass(slots=True, kw_only=True)
class GlobalList(Declaration):
    """A global variable list; its name comes from the object. Also VAR_CONFIG blocks."""

    blocks: list[VarBlock]


@dataclass(slots=True, kw_only=True)
class Unit(Node):
    """Everything one source text declares, in order."""

    source: Source
    declarations: list[Declaration]
    graphs: frozenset[str] = frozenset()
    """Languages of the bodies that were lowered from graphs."""
    copied: bool = False
    """Made for the values of generic constants."""

"""What names denote."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from enum import StrEnum

from tappet.lang import ast
from tappet.lang.source import Source, Span
from tappet.lang.types import FunctionBlock, Interface, Type


class Storage(StrEnum):
    """Where a variable lives; it decides how code reaches it."""

    GLOBAL = "global"  # member of a GVL: data object `owner`, at `offset`
    PROGRAM = "program"  # member of a program: data object `owner`, at `offset`
    INSTANCE = "instance"  # member of the FB instance that `THIS` points to, at `offset`
    LOCAL = "local"  # on the stack of a function or method, and VAR_TEMP of any POU
    PARAMETER = "parameter"  # parameter of a function or method: by value, VAR_IN_OUT by address
    RESULT = "result"  # the return value inside a function, method or property getter
    DIRECT = "direct"  # at an address %I %Q %M
    CONSTANT = "constant"  # folded everywhere; also stored with its GVL or instance


@dataclass(eq=False, slots=True)
class Symbol:
    """Base: a named thing with the place of its declaration."""

    name: str
    source: Source | None = None
    span: Span | None = None
    comment: str = ""
    access: str = ""
    """PUBLIC, PRIVATE, PROTECTED or INTERNAL; empty where a variable has none of them."""


@dataclass(eq=False, slots=True)
class VarSymbol(Symbol):
    """A variable, parameter, structure member or constant."""

    type: Type | None = None
    storage: Storage = Storage.LOCAL
    section: str = "VAR"
    flags: frozenset[str] = frozenset()
    owner: str | None = None
    """Data object for GLOBAL and PROGRAM: name of the GVL or program; for members the type's name."""
    offset: int = 0
    """Bytes inside the data object or instance; for DIRECT bytes inside the area."""
    bit: int | None = None
    area: str | None = None
    """I, Q or M for DIRECT."""
    decl: ast.VarDecl | None = None
    constant: ast.Constant = None
    is_constant: bool = False
    home: Storage = Storage.LOCAL
    """The storage without regard to being constant: GLOBAL, PROGRAM, INSTANCE or LOCAL; same as `storage`
    otherwise."""


@dataclass(eq=False, slots=True)
class TypeSymbol(Symbol):
    """A user-defined data type."""

    type: Type | None = None


@dataclass(eq=False, slots=True)
class EnumValueSymbol(Symbol):
    """A value of an enumeration."""

    type: Type | None = None
    number: int = 0


@dataclass(eq=False, slots=True)
class PouSymbol(Symbol):
    """Program, function, function block, method or action.

    Parameters are in order of declaration: inputs, outputs and in-outs mixed as written.
    """

    pou: ast.Pou | None = None
    kind: str = "PROGRAM"
    qualified_name: str = ""
    """`FB_Motor.Start` for methods and actions; `Standard.TON` stays `TON` with `source.library` set."""
    return_type: Type | None = None
    parameters: list[VarSymbol] = field(default_factory=list)
    locals: dict[str, VarSymbol] = field(default_factory=dict)
    """Every variable visible by its plain name in the body, by upper-case name (own, and inherited or of
    the owner)."""
    instance: FunctionBlock | None = None
    """Instance type of programs, function blocks and of the owner for methods and actions."""
    methods: dict[str, PouSymbol] = field(default_factory=dict)
    actions: dict[str, PouSymbol] = field(default_factory=dict)
    properties: dict[str, PropertySymbol] = field(default_factory=dict)
    owner: PouSymbol | None = None
    base: PouSymbol | None = None
    """The function block after EXTENDS."""
    interfaces: list[InterfaceSymbol] = field(default_factory=list)
    """After IMPLEMENTS, as written."""
    result: VarSymbol | None = None
    """The variable that holds the return value (storage RESULT)."""
    vtable: dict[str, PouSymbol] = field(default_factory=dict)
    """Function blocks: what a virtual call by upper-case name reaches, in slot order: `__BODY` (the block
    itself),
    methods, actions, `__GETX`, `__SETX`; inherited ones first, a derived block keeps the slots of its base.
    Empty when nothing of the block is virtual; then its instances have no `__VFTABLE`."""

    def children(self) -> Iterator[PouSymbol]:
        """Methods, actions and accessors, as far as the POU has them itself."""
        yield from self.methods.values()
        yield from self.actions.values()
        for property_ in self.properties.values():
            yield from property_.accessors()

    def with_children(self) -> Iterator[PouSymbol]:
        """The POU and its methods, actions and accessors."""
        yield self
        yield from self.children()


@dataclass(eq=False, slots=True)
class PropertySymbol(Symbol):
    """A property; getter and setter are called like methods `__getName`, `__setName`."""

    type: Type | None = None
    getter: PouSymbol | None = None
    setter: PouSymbol | None = None

    def accessors(self) -> Iterator[PouSymbol]:
        """Getter and setter, where there are."""
        if self.getter is not None:
            yield self.getter
        if self.setter is not None:
            yield self.setter


@dataclass(eq=False, slots=True)
class InterfaceSymbol(Symbol):
    """An interface: heads of methods and properties (PouSymbols without a body)."""

    type: Interface | None = None
    methods: dict[str, PouSymbol] = field(default_factory=dict)
    """Own and inherited ones by upper-case name, `__GETX` / `__SETX` of the properties included."""
    properties: dict[str, PropertySymbol] = field(default_factory=dict)
    bases: list[InterfaceSymbol] = field(default_factory=list)


@dataclass(eq=False, slots=True)
class GvlSymbol(Symbol):
    """A global variable list: a namespace and a data object."""

    members: dict[str, VarSymbol] = field(default_factory=dict)
    qualified_only: bool = False
    size: int = 0
    decl: ast.GlobalList | None = None


@dataclass(eq=False, slots=True)
class NamespaceSymbol(Symbol):
    """A library namespace."""

    members: dict[str, Symbol] = field(default_factory=dict)


@dataclass(eq=False, slots=True)
class BuiltinSymbol(Symbol):
    """An operator known without a library, resolved for one call: ADD, SEL, SIZEOF, TRUNC ... (LOPR-*).

    `name` is the operation in upper case; every `<T1>_TO_<T2>`, `TO_<T>`, `ANY_TO_<T>` has the name
    `CONVERT`.
    """

    parameter_types: tuple[Type | None, ...] = ()
    """What each argument is converted to; None = the argument is a place or a type and is not loaded
    (ADR, SIZEOF, __ISVALIDREF, __NEW, the target of __QUERYINTERFACE ...)."""
    return_type: Type | None = None
    """Type of the result as lowering computes it (the 32 bit type for ADD(INT, INT)); None = no value."""

"""What analysis hands to code generation, the monitor and the editors.

The contract, construct by construct. "Symbol" and "type" are the fields marked `resolved` in `ast`.

Expressions
    `type` is the static type for checks; it is never a `Reference`: a Name, Member or Call whose symbol's
    type (return type) is a Reference denotes the object referred to. It is None only below a reported
    error. `is_constant` / `constant`: the folded value, already wrapped to `carried_type(expr)`; emit it
    without looking at the operands. NaN and infinities occur. `untyped` is of interest to analysis only.
    Values: lowering computes an expression in `carried_type(expr)` and converts from there to whatever the
    consumer needs. It differs from `type` for arithmetic on narrow integers (LOPR-03): INT * INT has type
    INT, is computed in DINT, and is cut when it is stored in an INT; stored in a DINT it keeps all bits.

    Literal     constant. Untyped literals carry the type their context gave them (5 in `real := 5` is REAL
                5.0).
    Name        symbol VarSymbol (variable, parameter, member of THIS or of the program, GVL variable, or an
                anonymous DIRECT symbol for `%MB3`), EnumValueSymbol, PropertySymbol (own property: call the
                getter / setter on THIS), or, only as base of a Member or callee or operand of SIZEOF / ADR
                / INDEXOF / __NEW: PouSymbol, GvlSymbol, TypeSymbol, NamespaceSymbol, BuiltinSymbol (type
                None).
    Member      symbol VarSymbol: if `base` is a value (base.type is Struct or FunctionBlock) the member
                lies at symbol.offset in it; if base names a GVL, program or namespace the symbol says it
                all, as for a Name. symbol PropertySymbol: call getter / setter on `base`. symbol
                EnumValueSymbol: constant. `bit` not None: bit access, base is the integer. symbol.bit: BIT
                member of a structure.
    Index       base.type Array: one integer per dimension, any integer type, constant ones are in range.
                base.type Pointer: `base[i]` is the i-th element. base.type String: i-th BYTE / WORD.
    Deref       base.type Pointer; `THIS^`, `SUPER^` are Deref(This), Deref(Super).
    This/Super  type Pointer(FunctionBlock): own instance, and as the base type for SUPER.
    Unary       operand_type: convert the operand to it, then apply; the result has that type.
    Binary      operand_type: convert both operands to it, then apply. Comparison gives BOOL. AND OR XOR
                work on BOOL and integers. Not converted (operand_type None): date and time arithmetic where
                the units differ. DT (s), TOD (ms), LDT/LTOD (ns) +- TIME (ms) / LTIME (ns) gives
                the type of the date; date - date gives TIME (LTIME for the L-forms). TIME * number, number *
                TIME, TIME / number give TIME. Look at left.type and right.type.
                Pointer + integer: operand_type is the pointer type, the integer counts bytes (LTYP-72).
                Pointer - pointer: type UDINT, carried in LINT. STRING / WSTRING comparison: operand_type is
                the longer String. `**` like EXPT. Interface and pointer compare as 64 bit values.
    Call        target PouSymbol: FUNCTION, PROGRAM (callee names it), FUNCTION_BLOCK (callee is the
                instance), METHOD (callee is Member(base instance, THIS^, SUPER^ or interface value) or a
                plain Name = own THIS), ACTION (same). args[i].parameter is the VarSymbol; inputs without an
                argument take parameter.decl.init (functions, methods) or keep their value (FB, program).
                VAR_IN_OUT: address of the argument; outputs: copied after the call. A call through SUPER^
                is static, others are virtual through PouSymbol.vtable of the instance when callee base can
                be derived. target BuiltinSymbol: see there; with `expansion` set, lower that instead (ADD,
                AND, GT, MOVE ...). Unselected arguments of SEL, MUX, AND_THEN, OR_ELSE are not evaluated.
    Held        the accumulator of IL: what the Hold of the same number has computed and keeps in `carried`.
    AssignExpr  like Assign; its value is the target after the assignment, type = target type.
    ArrayInit   only as initial value: type Array; elements in storage order, missing ones take the default.
                Nested arrays may also be written flat. Repeat.count is constant; `N(7)` with a constant N, a
                Call for the parser, has become a Repeat.
    StructInit  only as initial value: type Struct or FunctionBlock; fields[i].parameter is the member's
                VarSymbol.

Declarations
    VarDecl.symbol VarSymbol; VarDecl.init the expression that initialises (own, or of an alias type),
    analysed against the declared type. Without init a variable starts with zeros, an Enum with
    Enum.default, structures and blocks with the initial values of their members. A reference with
    `initial_ref` is bound to `init`. Storage of a VarSymbol: see symbols.Storage. VAR_STAT variables are
    GLOBAL members of the hidden list `__STAT_<POU>`, which is in `Analysis.gvls` like any list. Constants
    of simple type have storage CONSTANT, a `home` storage and an offset there, so that their address can be
    taken; constant arrays and structures are ordinary variables that nobody writes. VAR_IN_OUT (any POU),
    VAR_OUTPUT of functions and methods: the parameter is an address. In FB and programs VAR_IN_OUT is a
    member that holds the address. NamedType.args of an instance: arguments of FB_Init, args[i].parameter
    set. PouSymbol.result: where the return value goes. Property accessors: `getter` / `setter` are
    PouSymbols of kind METHOD named `__getX`, `__setX` with a synthesised ast.Pou; inside, the property name
    is the result / the input. FB_Init, FB_Exit, FB_Reinit are ordinary methods of these names.

Statements
    Assign      target and value analysed; convert value to target.type. `REF=`: the target's symbol is of
                type Reference, store the address of value; constant 0 releases. `S=`, `R=`: both BOOL.
                Target may be a property (symbol PropertySymbol), a bit (Member.bit), `str[i]`. Value of
                type FunctionBlock for a target of type Interface: store the address of the instance.
    Case        selector.type integer or enum; CaseRange.low / high are constant.
    For         convert start and stop to variable.type. A constant step keeps its own type; its sign is the
                direction, also for an unsigned variable (BY -1).
    Jump        targets the statement with this label in the same body.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Final

from tappet.lang import ast
from tappet.lang.coding_settings import NO_RULES, StaticAnalysis
from tappet.lang.diagnostics import Diagnostic
from tappet.lang.symbols import (
    BuiltinSymbol,
    GvlSymbol,
    InterfaceSymbol,
    PouSymbol,
    PropertySymbol,
    Symbol,
    VarSymbol,
)
from tappet.lang.types import Reference, Type

ARITHMETIC = frozenset({"+", "-", "*", "/", "MOD"})


@dataclass(frozen=True, slots=True)
class AnalysisOptions:
    """Settings of one analysis."""

    system: bool = False
    """Sources of the product itself: intrinsics (`__CALL`, `__XADD` ...) and names with `__` are legal."""
    byte_addressing: bool = False
    """Numbers of direct addresses are byte offsets (LDEC-59); False: they count in units of their size."""
    area_limits: dict[str, int] = field(default_factory=lambda: {"I": 65536, "Q": 65536, "M": 1 << 20})
    """Bytes of the areas I, Q and M."""
    main_program: str = "PLC_PRG"
    """Program that runs when there is no task configuration."""
    free_addresses: bool = True
    """Variables with an incomplete address that VAR_CONFIG does not name get a free one; False: an error."""
    static: StaticAnalysis = NO_RULES
    """The optional coding rules (S1xxx) that are switched on."""


AGREED: Final = "__AGREED"
"""The hidden list that records which of a marker and its variable has changed."""


@dataclass(frozen=True, slots=True)
class ConfiguredAddress:
    """One line of VAR_CONFIG: the instance variable is copied from (I) or to (Q) the address once per cycle;
    a marker (M) and its variable are the same memory at the ends of each cycle."""

    path: str
    """`PLC_PRG.inst.x` as written."""
    owner: str
    """Data object the variable lies in: program or GVL, upper case."""
    offset: int
    """Of the variable inside the data object, bytes."""
    type: Type
    area: str
    address: int
    """Bytes inside the area."""
    bit: int | None
    agreed: int = 0
    """Of a marker: offset in the list `AGREED` of the value that it and the variable had last."""


@dataclass(frozen=True, slots=True)
class Redeclared:
    """What an edit of declarations has made new; everything else is as in the previous analysis."""

    texts: frozenset[str]
    """Uris of the texts that were declared again."""
    entities: frozenset[int]
    """id() of all symbols and types of the declarations of these texts, present and former."""
    bodies: list[PouSymbol]
    """POUs, methods and accessors whose bodies were analysed again."""


@dataclass(slots=True)
class Analysis:
    """A checked program. Names in dictionaries are upper case."""

    options: AnalysisOptions
    scope: dict[str, Symbol] = field(default_factory=dict)
    """What the application sees: objects, global variables, enumeration values, namespaces."""
    pous: list[PouSymbol] = field(default_factory=list)
    """Programs, functions and function blocks with code or instances, libraries included; methods and actions
    are below their owner. In order of the sources."""
    programs: dict[str, PouSymbol] = field(default_factory=dict)
    gvls: list[GvlSymbol] = field(default_factory=list)
    """In order of initialisation: by 'global_init_slot', then as given. Hidden lists of VAR_STAT at the
    end."""
    types: dict[str, Type] = field(default_factory=dict)
    """User types by name: structures, unions, enumerations, aliases, subranges."""
    interfaces: dict[str, InterfaceSymbol] = field(default_factory=dict)
    configured: list[ConfiguredAddress] = field(default_factory=list)
    diagnostics: list[Diagnostic] = field(default_factory=list)
    called: set[int] = field(default_factory=set)
    """id() of every POU that code calls, instantiates or takes the address of."""
    changed: list[PouSymbol] | None = None
    """POUs, methods and accessors with a new body since the previous analysis; None: everything is new."""
    redeclared: Redeclared | None = None
    """What is new when declarations were edited; None: everything, or what `changed` says."""
    continued: bool = False
    """Whether symbols of the previous analysis live on here."""
    is_waiting: bool = False
    """Whether bodies have not been analysed yet; `resume` analyses them, and the next analysis reports
    them."""
    state: object | None = None
    """What the next analysis may reuse; no business of others."""

    @property
    def ok(self) -> bool:
        """Whether there is no error (warnings do not count)."""
        return all(d.severity != "error" for d in self.diagnostics)

    def function(self, name: str) -> PouSymbol | None:
        """The FUNCTION of this name the application sees, such as CheckBounds (LTYP-150), or None."""
        found = self.scope.get(name.upper())
        return found if isinstance(found, PouSymbol) and found.kind == "FUNCTION" else None


def carried_type(expr: ast.Expr) -> Type | None:
    """The type in which lowering holds the value of `expr` (see the module docstring)."""
    if isinstance(expr, ast.Binary):
        if expr.op in ARITHMETIC:
            return expr.operand_type or expr.type
    elif isinstance(expr, ast.Unary):
        return expr.operand_type or expr.type
    elif isinstance(expr, ast.Call) and isinstance(expr.target, BuiltinSymbol):
        return expr.target.return_type
    elif isinstance(expr, ast.Held) and not expr.is_constant:
        return expr.carried or expr.type
    return expr.type


def yields_reference(e: ast.Expr) -> bool:
    """Whether a call or property returns a REFERENCE, so that it is the place referred to."""
    if isinstance(e, ast.Call):
        return isinstance(e.target, PouSymbol) and isinstance(e.target.return_type, Reference)
    symbol = e.symbol if isinstance(e, (ast.Name, ast.Member)) else None
    return isinstance(symbol, PropertySymbol) and isinstance(symbol.type, Reference)


__all__ = [
    "ARITHMETIC",
    "Analysis",
    "AnalysisOptions",
    "ConfiguredAddress",
    "Redeclared",
    "VarSymbol",
    "carried_type",
    "yields_reference",
]

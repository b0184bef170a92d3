"""What the first pass finds in the sources."""

from __future__ import annotations

from dataclasses import dataclass, field

from tappet.lang import ast
from tappet.lang.analysis.scope import Level
from tappet.lang.source import Source
from tappet.lang.symbols import EnumValueSymbol, GvlSymbol, InterfaceSymbol, PouSymbol, TypeSymbol, VarSymbol


@dataclass(slots=True)
class OwnVariables:
    """Variables a POU declares itself, by upper-case name, in order."""

    variables: dict[str, VarSymbol] = field(default_factory=dict)
    statics: list[VarSymbol] = field(default_factory=list)
    externals: list[VarSymbol] = field(default_factory=list)


@dataclass(slots=True)
class Collected:
    """What the sources declare, in their order."""

    pous: list[tuple[PouSymbol, Level]] = field(default_factory=list)
    """Programs, functions, function blocks."""
    types: list[tuple[TypeSymbol, ast.TypeDecl, Source]] = field(default_factory=list)
    gvls: list[tuple[GvlSymbol, Source]] = field(default_factory=list)
    interfaces: list[tuple[InterfaceSymbol, ast.Interface, Source]] = field(default_factory=list)
    configured: list[tuple[ast.VarDecl, Source]] = field(default_factory=list)
    own: dict[int, OwnVariables] = field(default_factory=dict)
    """By id() of the POU."""
    enum_values: dict[int, list[EnumValueSymbol]] = field(default_factory=dict)
    """By id() of the EnumType."""
    local_enums: list[tuple[ast.EnumType, Source, str]] = field(default_factory=list)
    """Enumerations written in a variable declaration, with a name made for them."""
    enum_of_value: dict[int, ast.EnumType] = field(default_factory=dict)

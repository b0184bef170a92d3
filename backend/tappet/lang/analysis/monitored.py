"""What keeps the last value of a property with `{attribute 'monitoring' := 'variable'}` (LPRG-32)."""

from __future__ import annotations

from tappet.lang import ast
from tappet.lang.attributes import attribute
from tappet.lang.source import Source
from tappet.lang.symbols import PouSymbol, Storage, VarSymbol

SHOWN = "monitored property"
"""Attribute of such a variable; its value is the name under which it is watched."""
_HOMES = {"FUNCTION_BLOCK": Storage.INSTANCE, "PROGRAM": Storage.PROGRAM}


def monitoring_name(owner: str, name: str) -> str:
    """Name of the variable; no text can hold it, and a derived block has one of its own."""
    return f"__{name}${owner}"


def keeping_variable(owner: PouSymbol, property_: ast.Property, source: Source) -> VarSymbol | None:
    """The variable for a property of a block or program; None when it is not monitored so."""
    home = _HOMES.get(owner.kind)
    asked = attribute(property_.attributes, "monitoring")
    if home is None or property_.type_ref is None or (asked or "").lower() != "variable":
        return None
    span = property_.name_span
    name = monitoring_name(owner.name, property_.name)
    mark = ast.Pragma(span=span, text=SHOWN, attribute=SHOWN, value=property_.name)
    decl = ast.VarDecl(name=name, name_span=span, span=span, type_ref=property_.type_ref, attributes=[mark])
    symbol = VarSymbol(
        name, source, span, storage=home, home=home, section="VAR", owner=owner.qualified_name, decl=decl
    )
    decl.symbol = symbol
    return symbol

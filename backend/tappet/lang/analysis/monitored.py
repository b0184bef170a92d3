"""What keeps the value of a property with attribute 'monitoring': 'variable' (LPRG-32) or 'call' (LPRG-33).

With 'variable' it is what the program got or set last. With 'call' the task calls Get at the end of its
cycles while the property is watched: a second variable tells whether it is.
"""

from __future__ import annotations

from tappet.lang import ast
from tappet.lang.attributes import attribute
from tappet.lang.source import Source
from tappet.lang.symbols import PouSymbol, Storage, VarSymbol

SHOWN = "monitored property"
"""Attribute of such a variable; its value is the name under which it is watched."""
CALLED = "monitored by call"
"""Attribute of one that Get is called for; its value is the name of the variable that asks for it."""
_HOMES = {"FUNCTION_BLOCK": Storage.INSTANCE, "PROGRAM": Storage.PROGRAM}


def monitoring_name(owner: str, name: str) -> str:
    """Name of the variable; no text can hold it, and a derived block has one of its own."""
    return f"__{name}${owner}"


def keeping_variables(owner: PouSymbol, property_: ast.Property, source: Source) -> list[VarSymbol]:
    """The variables for a property of a block or program; none when it is not monitored so."""
    home = _HOMES.get(owner.kind)
    asked = (attribute(property_.attributes, "monitoring") or "").lower()
    if home is None or property_.type_ref is None or asked not in ("variable", "call"):
        return []
    if asked == "call" and property_.getter is None:
        return []
    span = property_.name_span
    name = monitoring_name(owner.name, property_.name)
    marks = [ast.Pragma(span=span, text=SHOWN, attribute=SHOWN, value=property_.name)]
    if asked == "variable":
        return [_variable(owner, source, home, name, property_.type_ref, marks)]
    asking = f"{name}?"
    marks.append(ast.Pragma(span=span, text=CALLED, attribute=CALLED, value=asking))
    quiet = [ast.Pragma(span=span, text=mark, attribute=mark) for mark in ("hide", "no_copy")]
    return [
        _variable(owner, source, home, name, property_.type_ref, marks),
        _variable(owner, source, home, asking, ast.NamedType(span=span, name="BYTE"), quiet),
    ]


def _variable(
    owner: PouSymbol, source: Source, home: Storage, name: str, ref: ast.TypeRef, marks: list[ast.Pragma]
) -> VarSymbol:
    span = marks[0].span
    decl = ast.VarDecl(name=name, name_span=span, span=span, type_ref=ref, attributes=marks)
    symbol = VarSymbol(
        name, source, span, storage=home, home=home, section="VAR", owner=owner.qualified_name, decl=decl
    )
    decl.symbol = symbol
    return symbol

"""What keeps the value of a property with attribute 'monitoring': 'variable' (LPRG-32) or 'call' (LPRG-33).

With 'variable' it is what the program got or set last. With 'call' the task calls Get at the end of its
cycles while the property is watched: a second variable holds whether it is.
"""

from __future__ import annotations

from tappet.lang import ast
from tappet.lang.attributes import attribute
from tappet.lang.source import Source, Span
from tappet.lang.symbols import PouSymbol, Storage, VarSymbol

_REQUEST_FLAGS = frozenset({"HIDDEN", "NO_COPY"})
"""The request is not shown, and an online change does not copy it."""
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
    if asked == "variable":
        kept = ast.Monitored(property_.name)
        return [_variable(owner, source, home, name, span, property_.type_ref, kept)]
    kept = ast.Monitored(property_.name, f"{name}?")
    request = _variable(owner, source, home, f"{name}?", span, ast.NamedType(span=span, name="BYTE"))
    request.flags = _REQUEST_FLAGS
    return [_variable(owner, source, home, name, span, property_.type_ref, kept), request]


def _variable(
    owner: PouSymbol,
    source: Source,
    home: Storage,
    name: str,
    span: Span,
    ref: ast.TypeRef,
    monitored: ast.Monitored | None = None,
) -> VarSymbol:
    decl = ast.VarDecl(name=name, name_span=span, span=span, type_ref=ref, monitored=monitored)
    symbol = VarSymbol(
        name, source, span, storage=home, home=home, section="VAR", owner=owner.qualified_name, decl=decl
    )
    decl.symbol = symbol
    return symbol

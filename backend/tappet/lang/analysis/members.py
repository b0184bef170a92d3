"""Members: of structures, instances, programs, lists, namespaces, enumerations, and bits of integers."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from tappet.lang import ast
from tappet.lang import types as t
from tappet.lang.analysis.context import Body
from tappet.lang.analysis.expressions import (
    NAMING,
    Handler,
    evaluate,
    resolve_object,
    resolve_variable,
    text_of,
    value,
)
from tappet.lang.analysis.pins import pin_of_iec
from tappet.lang.heritage import has_unknown_base, is_open, is_unknown_at_heart
from tappet.lang.symbols import (
    EnumValueSymbol,
    GvlSymbol,
    InterfaceSymbol,
    NamespaceSymbol,
    PouSymbol,
    Symbol,
    TypeSymbol,
    VarSymbol,
)
from tappet.lang.types import Elementary


def _member(b: Body, e: ast.Member) -> None:
    base = e.base
    if base.__class__ is ast.Call:
        value(b, base)
    elif not _names_enumeration(b, e):
        evaluate(b, base)
    e.bit = e.symbol = e.type = e.constant = None
    e.is_constant = e.untyped = False
    if not e.name:
        return  # the parser has said that it is missing
    type_ = base.type
    if type_ is None:
        if base.__class__ in NAMING and base.symbol is not None:  # type: ignore[attr-defined]
            _member_of_object(b, e, base.symbol)  # type: ignore[attr-defined]
        return
    handler = _MEMBER_OF.get(type_.__class__)
    if handler is None:
        b.report("E0204", e.name_span, name=e.name, type=type_, hint="")
    else:
        handler(b, e, type_)


def _names_enumeration(b: Body, e: ast.Member) -> bool:
    """Whether `Type.Value` is meant although a global variable has the name of the type, too."""
    base = e.base
    if not b.values or not isinstance(base, ast.Name):
        return False
    key = base.name.upper()
    symbol = b.names.get(key)
    if key not in b.values or key in b.locals or not isinstance(symbol, TypeSymbol):
        return False
    if symbol.type is None:
        b.session.resolve(symbol)
    if not isinstance(symbol.type, t.Enum) or e.name.upper() not in {n.upper() for n in symbol.type.values}:
        return False
    resolve_object(b, base, symbol)
    return True


def _member_of_struct(b: Body, e: ast.Member, type_: t.Struct) -> None:
    found = type_.members.get(e.name.upper())
    if found is None and not type_.size:
        b.session.complete(type_)
        found = type_.members.get(e.name.upper())
    if found is None or found.decl is None or not isinstance(found.decl.symbol, VarSymbol):
        if type_.members and e.name.upper() not in type_.unknown and not is_unknown_at_heart(type_):
            _unknown_member(b, e, type_, [m.name for m in type_.members.values()])
        return
    resolve_variable(b, e, found.decl.symbol)


def _member_of_block(b: Body, e: ast.Member, type_: t.FunctionBlock) -> None:
    pou = type_.pou.symbol if type_.pou is not None else None
    if not isinstance(pou, PouSymbol):
        return
    inside = e.base.__class__ is ast.Deref and e.base.base.__class__ in (ast.This, ast.Super)
    _member_of_pou(b, e, pou, inside)


def _member_of_pou(b: Body, e: ast.Member, pou: PouSymbol, inside: bool) -> None:
    key = e.name.upper()
    symbol = pou.locals.get(key)
    if symbol is not None:
        own = inside or b.block is pou
        if symbol.section in ("VAR_TEMP", "VAR_STAT", "VAR_EXTERNAL") and not own:
            symbol = None
        elif symbol.section == "VAR_IN_OUT" and not own:
            b.report("E0208", e.name_span, name=symbol.name, type=pou.name)
            return
        else:
            resolve_variable(b, e, symbol)
            return
    member = find_member(pou, key)
    if member is None:
        pin = pin_of_iec(b, e.name, pou.parameters, pou.name, e.name_span)
        if pin is not None:
            resolve_variable(b, e, pin)
            return
        if has_unknown_base(pou):
            return
        names = [v.name for v in pou.locals.values() if v.section != "VAR_TEMP"]
        walk: PouSymbol | None = pou
        while walk is not None:
            names += [
                m.name for m in (*walk.methods.values(), *walk.properties.values(), *walk.actions.values())
            ]
            walk = walk.base
        _unknown_member(b, e, pou.name, names)
        return
    resolve_object(b, e, member)


def find_member(pou: PouSymbol, key: str) -> Symbol | None:
    """Method, property or action of a block or of its bases by upper-case name."""
    walk: PouSymbol | None = pou
    seen = 0
    while walk is not None and seen < 1000:
        found: Symbol | None = walk.methods.get(key) or walk.properties.get(key) or walk.actions.get(key)
        if found is not None:
            return found
        walk = walk.base
        seen += 1
    return None


def _member_of_interface(b: Body, e: ast.Member, type_: t.Interface) -> None:
    symbol = type_.pou.symbol if type_.pou is not None else None
    if not isinstance(symbol, InterfaceSymbol):
        return
    key = e.name.upper()
    found: Symbol | None = symbol.properties.get(key) or symbol.methods.get(key)
    if found is None and is_open(symbol):
        return
    if found is None:
        _unknown_member(
            b, e, type_, [m.name for m in (*symbol.methods.values(), *symbol.properties.values())]
        )
    else:
        resolve_object(b, e, found)


def _member_of_object(b: Body, e: ast.Member, symbol: Symbol) -> None:
    key = e.name.upper()
    if isinstance(symbol, GvlSymbol):
        variable = symbol.members.get(key)
        if variable is None:
            _unknown_member(b, e, symbol.name, [v.name for v in symbol.members.values()])
        else:
            resolve_variable(b, e, variable)
    elif isinstance(symbol, NamespaceSymbol):
        found = symbol.members.get(key)
        if found is None:
            hint = b.suggest(e.name, symbol.members.items())
            b.report("E0218", e.name_span, name=e.name, namespace=symbol.name, hint=hint)
        elif isinstance(found, VarSymbol):
            resolve_variable(b, e, found)
        else:
            resolve_object(b, e, found)
    elif isinstance(symbol, TypeSymbol):
        _member_of_type(b, e, symbol, key)
    elif isinstance(symbol, PouSymbol):
        if symbol.kind == "PROGRAM":
            _member_of_pou(b, e, symbol, False)
        elif symbol.kind == "FUNCTION_BLOCK" and (member := _member_of_own(b, symbol, key)) is not None:
            resolve_object(b, e, member)
        elif symbol.kind == "FUNCTION_BLOCK" and (constant := _constant_of(b, symbol, key)) is not None:
            resolve_variable(b, e, constant)
        else:
            b.report("E0204", e.name_span, name=e.name, type=symbol.name, hint="Use an instance of it.")


def _member_of_own(b: Body, block: PouSymbol, key: str) -> Symbol | None:
    """A method, property or action named by its block, for the own instance; elsewhere there is none."""
    walk = b.block
    while walk is not None and walk is not block:
        walk = walk.base
    return find_member(block, key) if walk is not None else None


def _constant_of(b: Body, block: PouSymbol, key: str) -> VarSymbol | None:
    """A constant of a block with a known value: it needs no instance, the name of the type will do."""
    found = block.locals.get(key)
    if found is None or found.section != "VAR" or "CONSTANT" not in found.flags:
        return None
    if found.type is None:
        b.session.resolve(found)
    return found if found.constant is not None else None


def _member_of_type(b: Body, e: ast.Member, symbol: TypeSymbol, key: str) -> None:
    if symbol.type is None:
        b.session.resolve(symbol)
    if not isinstance(symbol.type, t.Enum):
        b.report("E0204", e.name_span, name=e.name, type=symbol.name, hint="Use a variable of this type.")
        return
    enum = symbol.type
    for name, number in enum.values.items():
        if name.upper() == key:
            e.symbol = EnumValueSymbol(name, symbol.source, symbol.span, type=enum, number=number)
            e.type, e.constant, e.is_constant = enum, number, True
            return
    _unknown_member(b, e, enum, list(enum.values))


def _unknown_member(b: Body, e: ast.Member, type_: object, names: list[str]) -> None:
    hint = b.suggest(e.name, [(n.upper(), Symbol(n)) for n in names])
    hint = hint.partition(" (")[0] + "?" if " (" in hint else hint
    b.report("E0204", e.name_span, name=e.name, type=type_, hint=hint)


def _bit(b: Body, e: ast.Member, type_: Elementary) -> None:
    """Bit access `x.3` or through an integer constant `x.enable` (LTYP-140..144)."""
    name = e.name
    if name.isdigit():
        number = int(name)
    else:
        symbol = b.lookup(name)
        if isinstance(symbol, VarSymbol):
            if symbol.type is None:
                b.session.resolve(symbol)
            b.session.used.add(id(symbol))
        content = getattr(symbol, "constant", None) if isinstance(symbol, VarSymbol) else None
        if isinstance(symbol, EnumValueSymbol):
            content = symbol.number
        if not isinstance(content, int) or isinstance(content, bool):
            if symbol is None:
                b.report("E0204", e.name_span, name=name, type=type_, hint="")
            else:
                b.report("E0315", e.name_span, name=name)
            return
        number = content
    if not type_.is_integer:
        b.report("E0314", e.name_span, type=type_)
        return
    if not 0 <= number < 8 * type_.size:
        b.report(
            "E0313", e.name_span, index=number, name=text_of(e.base), type=type_, high=8 * type_.size - 1
        )
        return
    e.bit = number
    e.type = t.BOOL
    content = e.base.constant
    if e.base.is_constant and isinstance(content, int):
        e.is_constant, e.constant = True, bool(content >> number & 1)


def _bit_of_base(b: Body, e: ast.Member, type_: t.Enum | t.Subrange) -> None:
    _bit(b, e, type_.base)


def _member_of_pointer(b: Body, e: ast.Member, type_: t.Pointer) -> None:
    b.report("E0204", e.name_span, name=e.name, type=type_, hint=f"Write {text_of(e.base)}^.{e.name}.")


_MEMBER_OF: dict[type, Callable[[Body, ast.Member, Any], None]] = {
    t.Struct: _member_of_struct,
    t.FunctionBlock: _member_of_block,
    t.Interface: _member_of_interface,
    Elementary: _bit,
    t.Enum: _bit_of_base,
    t.Subrange: _bit_of_base,
    t.Pointer: _member_of_pointer,
}

HANDLERS: dict[type, Handler] = {ast.Member: _member}

"""Places: what can be written, bound or have its address taken."""

from __future__ import annotations

from tappet.lang import ast
from tappet.lang import types as t
from tappet.lang.analysis.context import Body, DirectWrite
from tappet.lang.analysis.expressions import is_null, text_of
from tappet.lang.analysis.result import yields_reference
from tappet.lang.attributes import attribute
from tappet.lang.symbols import (
    EnumValueSymbol,
    GvlSymbol,
    NamespaceSymbol,
    PouSymbol,
    PropertySymbol,
    Storage,
    VarSymbol,
)


def is_place(e: ast.Expr) -> bool:
    """Whether `e` denotes memory (no literal, no computed value, no bit, no property but by reference)."""
    while True:
        if isinstance(e, ast.Name):
            return isinstance(e.symbol, VarSymbol) or yields_reference(e)
        if isinstance(e, ast.Member):
            if yields_reference(e):
                return True
            if e.bit is not None or not isinstance(e.symbol, VarSymbol) or e.symbol.bit is not None:
                return False
            if e.base.type is None:
                return True
            e = e.base
        elif isinstance(e, ast.Index):
            if isinstance(e.base.type, t.Pointer):
                return True
            e = e.base
        elif isinstance(e, ast.Deref):
            return True
        else:
            return yields_reference(e)


def mark_written(b: Body, e: ast.Expr) -> None:
    """Notes that the variables on the way to a place are written."""
    written = b.session.written
    while True:
        if e.__class__ in (ast.Name, ast.Member):
            written.add(id(e.symbol))
        if e.__class__ in (ast.Member, ast.Index):
            e = e.base
        else:
            return


def writable(b: Body, target: ast.Expr) -> bool:
    """Checks that the analysed `target` may be assigned; reports why not."""
    e = target
    written = b.session.written
    while True:
        kind = e.__class__
        if kind is ast.Name:
            return _variable_writable(b, target, e, e.symbol)  # type: ignore[attr-defined]
        if kind is ast.Member:
            assert isinstance(e, ast.Member)
            base = e.base
            if e.bit is None:
                symbol = e.symbol
                if symbol.__class__ is not VarSymbol:
                    return _variable_writable(b, target, e, symbol)
                assert isinstance(symbol, VarSymbol)
                if not _access_allowed(b, e, symbol):
                    return False
                if base.type is None:
                    return _variable_writable(b, target, e, symbol)
                if "CONSTANT" in symbol.flags and not _is_own_input(b, base, symbol):
                    b.report("E0305", target.span, name=text_of(target), hint="It is a constant.")
                    return False
                written.add(id(symbol))
                if base.type.__class__ is t.Interface:
                    return True
            e = base
        elif kind is ast.Index:
            assert isinstance(e, ast.Index)
            if e.base.type.__class__ is t.Pointer:
                return True
            e = e.base
        elif kind is ast.Deref:
            return True
        elif kind is ast.ErrorExpr:
            return False
        else:
            if kind is ast.Call and is_place(e):
                return True
            if (target.type is not None or kind is not ast.Call) and not _unreadable(e):
                b.report("E0305", target.span, name=text_of(target), hint="Only a variable can be assigned.")
            return False


def _unreadable(e: ast.Expr) -> bool:
    """Whether a target begins with what the parser could not read, and has reported."""
    while isinstance(e, ast.Binary):
        e = e.left
    return isinstance(e, ast.ErrorExpr) or (isinstance(e, ast.Member) and not e.name)


def is_input(symbol: VarSymbol) -> bool:
    """Whether a variable lies at a fixed address of the inputs; AT %I* it has memory of its own."""
    return symbol.area == "I" and symbol.home is Storage.DIRECT


def note_output(b: Body, symbol: VarSymbol, target: ast.Expr) -> None:
    """Notes that a variable or operand at an address is written."""
    if symbol.area == "I":
        b.report("W1304", target.span, name=symbol.name)
        return
    if symbol.home is Storage.DIRECT and symbol.area is not None and symbol.type is not None:
        first = 8 * symbol.offset + (symbol.bit or 0)
        last = first + (1 if symbol.bit is not None else 8 * symbol.type.size)
        b.session.outputs.add(DirectWrite(symbol.area, first, last, symbol.name, b.uri, target.span))


def _variable_writable(b: Body, target: ast.Expr, e: ast.Expr, symbol: object) -> bool:
    if symbol is None:
        if is_null(e):
            b.report("E0305", target.span, name=text_of(target), hint="It is a constant.")
        return False
    if isinstance(symbol, VarSymbol):
        if "CONSTANT" in symbol.flags:
            b.report("E0305", target.span, name=text_of(target), hint="It is a constant.")
            return False
        if is_input(symbol):
            b.report("E0306", target.span, name=symbol.name)
            return False
        b.session.written.add(id(symbol))
        if symbol.area is not None:
            note_output(b, symbol, target)
        return True
    if isinstance(symbol, PropertySymbol):
        if yields_reference(e) and symbol.getter is not None and (e is not target or symbol.setter is None):
            return True
        if e is not target:
            b.report(
                "E0305",
                target.span,
                name=text_of(target),
                hint="A property gives a copy: assign it as a whole.",
            )
            return False
        if symbol.setter is None:
            b.report("E0424", target.span, name=symbol.name, what="Set", verb="write")
            return False
        if b.unreadable:
            b.unreadable = [other for other in b.unreadable if other is not target]
        return True
    hint = "Only a variable can be assigned."
    if isinstance(symbol, EnumValueSymbol):
        hint = "It is a value of an enumeration."
    elif isinstance(symbol, (GvlSymbol, NamespaceSymbol)):
        hint = f"Write {symbol.name}.<variable>."
    elif isinstance(symbol, PouSymbol):
        hint = "It is no variable."
    b.report("E0305", target.span, name=text_of(target), hint=hint)
    return False


def _is_own_input(b: Body, base: ast.Expr, symbol: VarSymbol) -> bool:
    """Whether a method writes a constant input of its block behind THIS^, or FB_Init one of an instance in
    its block; CODESYS takes that."""
    if symbol.section != "VAR_INPUT":
        return False
    if isinstance(base, ast.Deref) and isinstance(base.base, ast.This):
        return True
    if b.pou is None or b.pou.name.upper() != "FB_INIT" or b.pou.owner is None:
        return False
    while isinstance(base, (ast.Member, ast.Index)):
        base = base.base
    if isinstance(base, ast.Deref):
        return isinstance(base.base, ast.This)
    return isinstance(base, ast.Name) and base.symbol is b.pou.owner.locals.get(base.name.upper())


def _access_allowed(b: Body, e: ast.Member, symbol: VarSymbol) -> bool:
    """Members of an instance can be written from outside only when they are inputs (LDEC-20, LDEC-22)."""
    base = e.base
    owner: object = None
    if base.type.__class__ is t.FunctionBlock:
        inner = base.base.__class__ if isinstance(base, ast.Deref) else None
        if inner is ast.This or inner is ast.Super:
            return True
        owner = base.type.pou.symbol if base.type.pou is not None else None
    elif base.type is None and base.__class__ in (ast.Name, ast.Member):
        owner = base.symbol
        if not isinstance(owner, PouSymbol):
            return True
    else:
        return True
    if symbol.section == "VAR_INPUT" or owner is b.block or symbol.access in ("PUBLIC", "INTERNAL"):
        return True
    if symbol.section in ("VAR", "VAR_OUTPUT", "VAR_INST") and not _is_value_check(b):
        name = owner.name if isinstance(owner, PouSymbol) else str(base.type)
        b.report("E0209", e.name_span, name=symbol.name, type=name, what=_WHAT[symbol.section])
        return False
    return True


def _is_value_check(b: Body) -> bool:
    """Whether the function is made to check values that tables have for variables, and is never called."""
    return (
        b.pou is not None
        and b.pou.pou is not None
        and (attribute(b.pou.pou.attributes, "tappet_value_check") is not None)
    )


_WHAT = {"VAR": "a local variable", "VAR_OUTPUT": "an output", "VAR_INST": "a local variable"}

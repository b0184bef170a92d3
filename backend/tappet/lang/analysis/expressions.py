"""Operands: literals, names, members, indices, pointers. One function per node class, found by
`EXPRESSIONS`."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from tappet.lang import ast
from tappet.lang import types as t
from tappet.lang.access import home_of, may_use
from tappet.lang.analysis import addresses, conversion, folding, operators
from tappet.lang.analysis.context import Body
from tappet.lang.analysis.scope import AmbiguousSymbol, Fits, QualifiedSymbol, describe
from tappet.lang.heritage import has_unknown_base
from tappet.lang.rules import BINARY_RULES
from tappet.lang.symbols import (
    EnumValueSymbol,
    GvlSymbol,
    NamespaceSymbol,
    PouSymbol,
    PropertySymbol,
    Symbol,
    TypeSymbol,
    VarSymbol,
)
from tappet.lang.types import Elementary, Kind, Type

Handler = Callable[[Body, Any], None]
EXPRESSIONS: dict[type, Handler] = {}
"""Resolves one expression and what is below it, by node class."""

_LITERAL_TYPES: dict[str, Type] = {
    "bool": t.BOOL, "real": t.LREAL, "time": t.TIME, "ltime": t.LTIME, "date": t.DATE, "tod": t.TOD, "dt":
    t.DT,
    "ldate": t.LDATE, "ltod": t.LTOD, "ldt": t.LDT,
}  # fmt: skip
_ADAPTING = frozenset({"time", "date", "tod", "dt", "real"})


def evaluate(b: Body, e: ast.Expr) -> Type | None:
    """Resolves `e`; its type, or None for errors and for names that are no values (`symbol` says what they
    are)."""
    handler = EXPRESSIONS.get(e.__class__)
    if handler is not None:
        handler(b, e)
    return e.type


def place_or_name(b: Body, e: ast.Expr) -> Type | None:
    """As `evaluate` where something is needed that a call without result is not."""
    return value(b, e) if e.__class__ is ast.Call else evaluate(b, e)


def value(b: Body, e: ast.Expr) -> Type | None:
    """Resolves `e` where a value is needed; None after an error, which has been reported."""
    handler = EXPRESSIONS.get(e.__class__)
    if handler is None:
        return None
    handler(b, e)
    if e.type is None:
        if e.__class__ in NAMING:
            symbol = e.symbol  # type: ignore[attr-defined]
            if symbol is not None and symbol.__class__ is not VarSymbol:
                not_a_value(b, e, symbol)
        elif e.__class__ is ast.Call:
            target = e.target
            if target is not None and getattr(target, "return_type", None) is None:
                _no_value(b, e, target)
    return e.type


def _no_value(b: Body, e: ast.Expr, target: Symbol) -> None:
    """A call without result gives 0 where a value is needed."""
    if isinstance(target, PouSymbol) and target.pou is not None and target.pou.return_type is not None:
        return  # its type is faulty, which has been reported
    if not isinstance(target, PouSymbol) or target.kind not in ("FUNCTION", "METHOD"):
        b.report("E0325", e.span, name=target.name)
        return
    b.report("W1147", e.span, name=target.name)
    e.type = t.USINT  # until the context asks for another


def not_a_value(b: Body, e: ast.Expr, symbol: Symbol) -> None:
    """Reports a name that denotes an object instead of a value."""
    if isinstance(symbol, PropertySymbol):
        return
    if isinstance(symbol, PouSymbol):
        hint = (
            f"Call it: {symbol.name}(...)." if symbol.kind != "FUNCTION_BLOCK" else "Use an instance of it."
        )
    elif isinstance(symbol, (GvlSymbol, NamespaceSymbol)):
        hint = f"Write {symbol.name}.<name>."
    elif isinstance(symbol, TypeSymbol) and isinstance(symbol.type, t.Enum):
        hint = f"Write {symbol.name}.<value>."
    else:
        hint = "Declare a variable of this type."
    b.report("E0210", e.span, name=symbol.name, what=describe(symbol), hint=hint)


def clear(e: ast.Expr) -> None:
    """Takes back what an earlier analysis of the same tree left."""
    e.type = e.constant = None
    e.is_constant = e.untyped = False


# -- literals ---------------------------------------------------------------------------------------


def _literal(b: Body, e: ast.Literal) -> None:
    e.untyped = False
    e.is_constant = True
    content = e.constant = e.value
    if content is None:
        clear(e)  # not readable, which the lexer has reported
        return
    if e.prefix is not None:
        _typed_literal(b, e, e.prefix)
        return
    kind = e.kind
    if kind == "int":
        smallest = conversion.smallest_integer(content) if isinstance(content, int) else None
        if smallest is None:
            b.report("E0302", e.span, text=e.text, type="ULINT", low=0, high=(1 << 64) - 1)
            clear(e)
            return
        e.type = smallest
        e.untyped = True
    elif kind == "string" or kind == "wstring":
        e.type = t.String(max(1, len(content)) if isinstance(content, (bytes, str)) else 1, kind == "wstring")
        e.untyped = True
    else:
        e.type = _LITERAL_TYPES.get(kind)
        e.untyped = kind in _ADAPTING
        if content is None or e.type is None:
            clear(e)
        elif e.type.__class__ is Elementary and e.type.kind is not Kind.REAL and isinstance(content, int):
            _range(b, e, e.type)


def _typed_literal(b: Body, e: ast.Literal, prefix: str) -> None:
    target = t.ELEMENTARY.get(prefix)
    content = e.value
    if target is None:
        symbol = b.names.get(prefix)
        if isinstance(symbol, TypeSymbol) and isinstance(symbol.type, t.Enum):
            _enum_literal(b, e, symbol.type)
            return
        b.report("E0202", e.span, name=prefix, hint=b.suggest(prefix))
        clear(e)
        return
    e.type = target
    if target.kind is Kind.REAL and isinstance(content, (int, float)):
        e.constant = folding.wrap(content, target)
    elif target is t.BOOL and content in (0, 1):
        e.constant = bool(content)
    elif isinstance(content, int) and not isinstance(content, bool):
        _range(b, e, target)
    else:
        b.report("E0301", e.span, source=_LITERAL_TYPES.get(e.kind, e.kind.upper()), target=target, hint="")
        clear(e)


def _enum_literal(b: Body, e: ast.Literal, enum: t.Enum) -> None:
    name = e.text.partition("#")[2]
    number = next((n for v, n in enum.values.items() if v.upper() == name.upper()), None)
    if number is None:
        b.report("E0204", e.span, name=name, type=enum, hint="")
        clear(e)
    else:
        e.type, e.constant = enum, number


def _range(b: Body, e: ast.Literal, target: Elementary) -> None:
    low, high = conversion.RANGES.get(target.name, (0, 0))
    number = e.constant
    if isinstance(number, int) and not low <= number <= high:
        b.report("E0302", e.span, text=e.text, type=target, low=low, high=high)
        clear(e)


# -- names ------------------------------------------------------------------------------------------


def _name(b: Body, e: ast.Name) -> None:
    key = e.name.upper()
    symbol: Symbol | None = None if e.leading_dot else b.locals.get(key)
    if symbol is None:
        symbol = b.values.get(key) or b.names.get(key)
        if symbol is None:
            e.untyped = e.is_constant = False
            e.type = e.constant = e.symbol = None
            _unknown_name(b, e, key)
            return
    if symbol.__class__ is VarSymbol:
        resolve_variable(b, e, symbol)
    else:
        resolve_object(b, e, symbol)


def check_use(b: Body, e: ast.Name | ast.Member | ast.NamedType, symbol: Symbol) -> None:
    """Reports what this text may not use (LDEC-127)."""
    if may_use(symbol, b.block, b.source):
        return
    span = e.name_span if isinstance(e, ast.Member) else e.span
    what = describe(symbol).capitalize()
    b.report("E0213", span, what=what, name=symbol.name, type=home_of(symbol), access=symbol.access)


def resolve_variable(b: Body, e: ast.Name | ast.Member, symbol: VarSymbol) -> None:
    """Fills a node that denotes a variable."""
    if symbol.access:
        check_use(b, e, symbol)
    session = b.session
    type_ = symbol.type
    if type_ is None:
        session.resolve(symbol)
        type_ = symbol.type
    session.used.add(id(symbol))
    e.symbol = symbol
    e.type = type_.base if type_.__class__ is t.Reference else type_
    e.is_constant = symbol.is_constant
    e.constant = symbol.constant
    e.untyped = False


def resolve_object(b: Body, e: ast.Name | ast.Member, symbol: Symbol) -> None:
    """A name that is no variable."""
    if symbol.access:
        check_use(b, e, symbol)
    e.type = e.constant = None
    e.is_constant = e.untyped = False
    e.symbol = symbol
    if isinstance(symbol, EnumValueSymbol):
        if symbol.type is None:
            b.session.resolve(symbol)
        e.type, e.constant, e.is_constant = symbol.type, symbol.number, True
    elif isinstance(symbol, PropertySymbol):
        e.type = symbol.type.base if isinstance(symbol.type, t.Reference) else symbol.type
        if symbol.getter is None:
            b.unreadable.append(e)
    elif isinstance(symbol, AmbiguousSymbol):
        e.symbol = None
        choices = ", ".join(dict.fromkeys(symbol.choices))
        b.report("E0203", e.span, name=e.name, choices=choices)
    elif isinstance(symbol, QualifiedSymbol):
        e.symbol = None
        b.session.report_qualified(b.uri, e.span, symbol)


def _unknown_name(b: Body, e: ast.Name, key: str) -> None:
    if key.startswith("%"):
        symbol = addresses.operand(b, e)
        if symbol is not None:
            e.symbol = symbol
            e.type = symbol.type
        return
    if is_null(e):
        e.type, e.constant, e.is_constant, e.untyped = t.USINT, 0, True, True
        return
    if not has_unknown_base(b.block):
        b.report("E0201", e.span, name=e.name, hint=b.suggest(e.name, fits=_fits(b, e)))


def _fits(b: Body, e: ast.Name) -> Fits:
    """What kind of thing is looked for where an unknown name stands: one to call, or one with a value."""
    if b.callee is e:
        return lambda s: (
            isinstance(s, PouSymbol) or (isinstance(s, VarSymbol) and isinstance(s.type, t.FunctionBlock))
        )
    return lambda s: not isinstance(s, (PouSymbol, TypeSymbol))


def is_null(e: ast.Expr) -> bool:
    """Whether `e` is the NULL of pointers, references and interfaces: nothing declared has its name."""
    return isinstance(e, ast.Name) and e.symbol is None and e.name.upper() == "NULL"


def text_of(e: ast.Expr) -> str:
    """The expression as written, for messages; '...' where it is more than a path."""
    if isinstance(e, ast.Name):
        return f".{e.name}" if e.leading_dot else e.name
    if isinstance(e, ast.Member):
        return f"{text_of(e.base)}.{e.name}"
    if isinstance(e, ast.Deref):
        return f"{text_of(e.base)}^"
    if isinstance(e, ast.Index):
        return f"{text_of(e.base)}[{', '.join(text_of(i) for i in e.indices)}]"
    if isinstance(e, ast.Literal):
        return e.text
    if isinstance(e, (ast.This, ast.Super)):
        return "THIS" if isinstance(e, ast.This) else "SUPER"
    if isinstance(e, ast.Call):
        return f"{text_of(e.callee)}(...)"
    return "..."


# -- places -----------------------------------------------------------------------------------------


def _index(b: Body, e: ast.Index) -> None:
    clear(e)
    type_ = value(b, e.base)
    for index in e.indices:
        if value(b, index) is None:
            continue
        base = t.value_type(index.type)  # type: ignore[arg-type]
        if not isinstance(base, Elementary) or not base.is_integer:
            b.report("E0311", index.span, type=index.type)
            index.type = None
    if type_ is None:
        return
    if type_.__class__ is t.Array:
        _array_index(b, e, type_)
        return
    if isinstance(type_, t.Pointer):
        if type_.base is None:
            b.report("E0321", e.span)
            return
        e.type = type_.base
    elif isinstance(type_, t.String):
        e.type = t.WORD if type_.wide else t.BYTE
    else:
        b.report("E0308", e.span, type=type_)
        return
    if len(e.indices) != 1:
        b.report("E0309", e.span, type=type_, expected=1, actual=len(e.indices))
        e.type = None
    elif isinstance(type_, t.String):
        position = e.indices[0].constant
        if isinstance(position, int) and not 0 <= position <= type_.length:
            b.report("E0310", e.indices[0].span, index=position, low=0, high=type_.length)
    _widen_indices(e)


def _array_index(b: Body, e: ast.Index, type_: t.Array) -> None:
    dimensions = type_.open_dims or len(type_.bounds)
    if len(e.indices) > dimensions and not type_.open_dims and isinstance(type_.element, t.Array):
        # a[i, j] on an array of arrays counts like a[i][j]
        b.report("E0309", e.span, type=type_, expected=dimensions, actual=len(e.indices))
        return
    if len(e.indices) != dimensions:
        b.report("E0309", e.span, type=type_, expected=dimensions, actual=len(e.indices))
        return
    element = type_.element
    e.type = element.base if element.__class__ is t.Reference else element
    for index, (low, high) in zip(e.indices, type_.bounds, strict=False):
        position = index.constant
        if index.is_constant and isinstance(position, int) and not low <= position <= high:
            b.report("E0310", index.span, index=position, low=low, high=high)
    _widen_indices(e)


def _widen_indices(e: ast.Index) -> None:
    for index in e.indices:
        index.untyped = False


def _deref(b: Body, e: ast.Deref) -> None:
    clear(e)
    type_ = value(b, e.base)
    if type_ is None:
        return
    if not isinstance(type_, t.Pointer):
        b.report("E0312", e.span, name=text_of(e.base), type=type_)
    elif type_.base is None:
        b.report("E0321", e.span)
    else:
        e.type = type_.base


def _this(b: Body, e: ast.This) -> None:
    clear(e)
    block = b.block
    if block is None or block.instance is None or block.kind not in ("FUNCTION_BLOCK", "PROGRAM"):
        b.report("E0214", e.span, name="THIS")
    else:
        e.type = t.Pointer(block.instance)


def _super(b: Body, e: ast.Super) -> None:
    clear(e)
    block = b.block
    if block is None or block.kind != "FUNCTION_BLOCK":
        b.report("E0214", e.span, name="SUPER")
    elif has_unknown_base(block):
        return
    elif block.base is None or block.base.instance is None:
        b.report("E0215", e.span, name=block.name)
    else:
        e.type = t.Pointer(block.base.instance)


# -- operators --------------------------------------------------------------------------------------


def _unary(b: Body, e: ast.Unary) -> None:
    value(b, e.operand)
    operators.unary(b, e)


def _binary(b: Body, e: ast.Binary) -> None:
    left = e.left
    if left.__class__ is ast.Binary:
        # a + b + c + ... nests to the left as deep as it is long: go down by a loop, not by recursion
        spine = [e]
        while left.__class__ is ast.Binary:
            spine.append(left)
            left = left.left
        value(b, left)
        for node in reversed(spine):
            value(b, node.right)
            operators.binary(b, node)
            for check in BINARY_RULES.get(node.op, ()):
                check(b, node)
        return
    value(b, left)
    value(b, e.right)
    operators.binary(b, e)
    for check in BINARY_RULES.get(e.op, ()):
        check(b, e)


def _aggregate(b: Body, e: ast.ArrayInit | ast.StructInit | ast.Repeat) -> None:
    clear(e)
    what = "An array initialiser" if isinstance(e, (ast.ArrayInit, ast.Repeat)) else "A structure initialiser"
    b.report("E0333", e.span, what=what)


def _type_operand(b: Body, e: ast.TypeOperand) -> None:
    clear(e)
    hint = "Declare a variable of this type."
    b.report("E0210", e.span, name="POINTER TO", what="type", hint=hint)


def _error(b: Body, e: ast.ErrorExpr) -> None:
    clear(e)


NAMING = frozenset({ast.Name, ast.Member})
"""Nodes that may denote an object instead of a value."""

HANDLERS: dict[type, Handler] = {
    ast.Literal: _literal,
    ast.Name: _name,
    ast.Index: _index,
    ast.Deref: _deref,
    ast.This: _this,
    ast.Super: _super,
    ast.Unary: _unary,
    ast.Binary: _binary,
    ast.ArrayInit: _aggregate,
    ast.StructInit: _aggregate,
    ast.Repeat: _aggregate,
    ast.TypeOperand: _type_operand,
    ast.ErrorExpr: _error,
}

"""Initial values: expressions and the aggregates `[1, 3(7)]`, `(a := 1)` (LTYP-91..93, LTYP-102)."""

from __future__ import annotations

from collections.abc import Sequence

from tappet.lang import ast
from tappet.lang import types as t
from tappet.lang.analysis.adaptation import require
from tappet.lang.analysis.calls import bind_reference
from tappet.lang.analysis.context import Body
from tappet.lang.analysis.expressions import clear, evaluate, value
from tappet.lang.heritage import is_unknown_at_heart
from tappet.lang.symbols import PouSymbol, Storage, VarSymbol
from tappet.lang.types import Type

_OPEN_COUNT = 1 << 31


def initialise(b: Body, e: ast.Expr, target: Type, inside_structure: bool = False) -> None:
    """Resolves an initial value against the type it initialises."""
    if isinstance(e, ast.ArrayInit):
        _array(b, e, target)
    elif isinstance(e, ast.StructInit):
        _structure(b, e, target)
    elif isinstance(target, t.Reference):
        if value(b, e) is not None:
            bind_reference(b, e, target)
    else:
        b.assigned = e
        if value(b, e) is not None:
            require(b, e, target)
            if inside_structure:
                _check_constant(b, e)
        b.assigned = None


def _check_constant(b: Body, e: ast.Expr) -> None:
    """Members of a structure must not be initialised by variables (LTYP-102)."""
    if e.is_constant:
        return
    if isinstance(e, (ast.Name, ast.Member)):
        symbol = e.symbol
        changing = isinstance(symbol, VarSymbol) and "CONSTANT" not in symbol.flags
        if changing and symbol.storage is not Storage.PARAMETER:  # type: ignore[union-attr]
            b.report("E0329", e.span)
    elif isinstance(e, ast.Unary):
        _check_constant(b, e.operand)
    elif isinstance(e, ast.Binary):
        _check_constant(b, e.left)
        _check_constant(b, e.right)


def _array(b: Body, e: ast.ArrayInit, target: Type) -> None:
    clear(e)
    if not isinstance(target, t.Array) and e.bare and len(e.elements) > 1:
        for x in e.elements[1:]:
            what = "A value without name"
            b.report("E0326", x.span, what=what, type=target, hint="Write (member := value).")
        return
    if not isinstance(target, t.Array):
        b.report(
            "E0326", e.span, what="A list in brackets", type=target, hint="Only arrays have a list of values."
        )
        return
    e.type = target
    used = _elements(b, e.elements, target)
    if used > target.count:
        b.report("E0327", e.span, actual=used, expected=target.count, type=target)
    e.is_constant = all(_is_constant(x) for x in e.elements)


def _is_constant(e: ast.Expr) -> bool:
    if isinstance(e, ast.Repeat):
        return all(_is_constant(x) for x in e.values)
    return e.is_constant


def _elements(b: Body, elements: list[ast.Expr], array: t.Array) -> int:
    """Resolves the values of an array; how many elements they fill."""
    element = array.element
    for position, x in enumerate(elements):
        if x.__class__ is ast.Call:
            elements[position] = _named_repeat(b, x)
    nested = as_written(array, elements) is not array
    if nested:
        assert isinstance(element, t.Array)
        flat = _elements(b, elements, element)
        return -(-flat // max(1, element.count))
    used = 0
    for x in elements:
        if isinstance(x, ast.Repeat):
            used += _repeat(b, x, array)
        else:
            initialise(b, x, element, inside_structure=False)
            used += 1
    return used


def as_written(array: t.Array, elements: Sequence[ast.Expr]) -> t.Array:
    """An array of arrays without brackets for its rows: as the array of one level that the values fill."""
    while isinstance(array.element, t.Array) and not any(_is_row(x) for x in elements):
        array = t.Array(array.element.element, array.bounds + array.element.bounds)
    return array


def _is_row(value: ast.Expr) -> bool:
    if isinstance(value, ast.Repeat):
        return any(_is_row(x) for x in value.values)
    return isinstance(value, ast.ArrayInit)


def _named_repeat(b: Body, e: ast.Call) -> ast.Expr:
    """`N(7)` with a constant N looks like a call to the parser; only its name shows that it is a
    repetition."""
    callee = e.callee
    if isinstance(callee, ast.Member):
        messages = len(b.session.diagnostics)
        evaluate(b, callee)
        del b.session.diagnostics[messages:]  # it is resolved again
    symbol = b.lookup(callee.name) if isinstance(callee, ast.Name) else getattr(callee, "symbol", None)
    if isinstance(symbol, VarSymbol) and (isinstance(callee, ast.Name) or "CONSTANT" in symbol.flags):
        values = [arg.value for arg in e.args if arg.value is not None and arg.name is None]
        return ast.Repeat(span=e.span, count=callee, values=values)
    return e


def _repeat(b: Body, e: ast.Repeat, array: t.Array) -> int:
    clear(e)
    e.type = array.element
    count = 0
    if value(b, e.count) is not None:
        number = e.count.constant
        if not e.count.is_constant or not isinstance(number, int) or isinstance(number, bool):
            b.report("E0317", e.count.span)
        elif not 0 <= number < _OPEN_COUNT:
            b.report("E0327", e.count.span, actual=number, expected=array.count, type=array)
        else:
            count = number
    if not e.values:
        return count
    if len(e.values) == 1:
        initialise(b, e.values[0], array.element)
        return count
    return count * _elements(b, e.values, array)


def _structure(b: Body, e: ast.StructInit, target: Type) -> None:
    clear(e)
    b.session.aggregates = True
    if isinstance(target, t.Reference):
        target = target.base
    if not isinstance(target, (t.Struct, t.FunctionBlock)):
        b.report(
            "E0326",
            e.span,
            what="A list in parentheses",
            type=target,
            hint="Only structures and blocks have members.",
        )
        return
    b.session.complete(target)
    e.type = target
    constant = True
    seen: set[str] = set()
    for field in e.fields:
        symbol = _field(b, field, target, seen)
        field.parameter = symbol
        if field.value is None:
            continue
        if symbol is None or symbol.type is None:
            continue
        initialise(b, field.value, symbol.type, inside_structure=isinstance(target, t.Struct))
        constant = constant and field.value.is_constant
    if isinstance(target, t.Struct) and target.union and len(seen) > 1:
        b.report("E0431", e.span)
    e.is_constant = constant


def _field(
    b: Body, field: ast.Argument, target: t.Struct | t.FunctionBlock, seen: set[str]
) -> VarSymbol | None:
    if field.name is None or field.output:
        b.report(
            "E0326", field.span, what="A value without name", type=target, hint="Write (member := value)."
        )
        return None
    key = field.name.upper()
    if key in seen:
        b.report("E0328", field.span, name=field.name)
    seen.add(key)
    symbol: object = None
    if isinstance(target, t.Struct):
        member = target.members.get(key)
        if member is not None and member.decl is not None:
            symbol = member.decl.symbol
    elif target.pou is not None and isinstance(target.pou.symbol, PouSymbol):
        symbol = target.pou.symbol.locals.get(key)
    if not isinstance(symbol, VarSymbol):
        names = [m.name for m in target.members.values() if not m.name.startswith("__")]
        reported = isinstance(target, t.Struct) and (not names or key in target.unknown)
        reported = reported or is_unknown_at_heart(target)
        if not reported:
            hint = f"Its members are: {', '.join(names[:8])}{' ...' if len(names) > 8 else ''}."
            b.report("E0204", field.span, name=field.name, type=target, hint=hint)
        return None
    if symbol.type is None:
        b.session.resolve(symbol)
    return symbol

"""Operators on places and types (SIZEOF, ADR, __NEW ...), and the intrinsics of system sources."""

from __future__ import annotations

from tappet.lang import ast
from tappet.lang import types as t
from tappet.lang.analysis import conversion
from tappet.lang.analysis.adaptation import require, retype
from tappet.lang.analysis.builtins import Resolve, count_fits, finish, operands
from tappet.lang.analysis.context import Body
from tappet.lang.analysis.expressions import evaluate, place_or_name, text_of, value
from tappet.lang.analysis.fb_init import bind_fb_init
from tappet.lang.analysis.places import is_place, mark_written, writable
from tappet.lang.analysis.result import yields_reference
from tappet.lang.attributes import attribute
from tappet.lang.parts import innermost
from tappet.lang.source import Scope
from tappet.lang.symbols import PouSymbol, Storage, TypeSymbol, VarSymbol
from tappet.lang.types import Elementary, Type
from tappet.lang.variable_info import VAR_INFO

_UNSIGNED = (t.USINT, t.UINT, t.UDINT, t.ULINT)


def named_type(b: Body, e: ast.Expr) -> Type | None:
    """The type that an operand names (`INT`, a user type, an FB, POINTER TO one, STRING(20)), None when it
    names none."""
    if isinstance(e, ast.TypeOperand):
        return b.session.type_of(b, e.ref, "")
    text = _text_type(e)
    if text is not None:
        return b.session.type_of(b, text, "")
    if isinstance(e, ast.Name) and not e.leading_dot:
        key = e.name.upper()
        if key in b.locals:
            return None
        if key in ("STRING", "WSTRING"):
            return t.String(80, wide=key == "WSTRING")
        elementary = t.ELEMENTARY.get(key)
        if elementary is not None:
            return elementary
        symbol = b.names.get(key)
    else:
        symbol = getattr(e, "symbol", None)
    if isinstance(symbol, TypeSymbol):
        if isinstance(e, ast.Name):
            e.symbol = symbol
        if symbol.type is None:
            b.session.resolve(symbol)  # a value of an enumeration may ask before the types are resolved
        return symbol.type
    if isinstance(symbol, PouSymbol) and symbol.kind == "FUNCTION_BLOCK":
        if isinstance(e, ast.Name):
            e.symbol = symbol
        return symbol.instance
    return None


def _text_type(e: ast.Expr) -> ast.StringType | None:
    """`STRING(20)` or `STRING[20]`, which reads like a call or an element."""
    inner = e.callee if isinstance(e, ast.Call) else e.base if isinstance(e, ast.Index) else None
    if not isinstance(inner, ast.Name) or inner.name.upper() not in ("STRING", "WSTRING"):
        return None
    lengths = [arg.value for arg in e.args] if isinstance(e, ast.Call) else getattr(e, "indices", [])
    if len(lengths) != 1:
        return None
    return ast.StringType(span=e.span, wide=inner.name.upper() == "WSTRING", length=lengths[0])


def _only_argument(b: Body, e: ast.Call, name: str) -> ast.Expr | None:
    return e.args[0].value if count_fits(b, e, name, 1, 1) else None


def _sizeof(b: Body, e: ast.Call, name: str) -> None:
    operand = _only_argument(b, e, name)
    if operand is None:
        return
    variable = isinstance(operand, ast.Name) and isinstance(b.lookup(operand.name), VarSymbol)
    type_ = None if variable else named_type(b, operand)
    if type_ is None:
        type_ = place_or_name(b, operand)
        symbol = getattr(operand, "symbol", None)
        if type_ is None and symbol is not None:
            type_ = named_type(b, operand)
            if type_ is None and isinstance(symbol, PouSymbol):
                type_ = symbol.instance
        if isinstance(symbol, VarSymbol) and isinstance(operand, ast.Literal):
            type_ = symbol.type
    if type_ is None:
        return
    b.session.complete(type_)
    if isinstance(type_, t.Array) and type_.open_dims:
        b.report("E0303", operand.span, op=name, type=type_, hint="Its size is known at run time only.")
        return
    size = type_.size
    result = next((u for u in _UNSIGNED if size <= conversion.RANGES[u.name][1]), t.ULINT)
    if name == "XSIZEOF":
        result = t.ULINT
    finish(e, name, [None], result, size)
    e.untyped = name == "SIZEOF"


def _adr(b: Body, e: ast.Call, name: str) -> None:
    operand = _only_argument(b, e, name)
    if operand is None:
        return
    type_ = place_or_name(b, operand)
    symbol = getattr(operand, "symbol", None)
    if type_ is None:
        if isinstance(symbol, PouSymbol):
            b.session.called.add(id(symbol))
            if symbol.kind == "PROGRAM" and symbol.instance is not None:
                finish(e, name, [None], t.Pointer(symbol.instance))
            else:
                finish(e, name, [None], t.Pointer(None))
        elif symbol is not None and not isinstance(symbol, VarSymbol):  # else its type has been reported
            b.report("E0323", operand.span, op=name, what="a variable", given="an expression")
        return
    meant = operand.expansion if isinstance(operand, ast.Call) else operand
    if isinstance(meant, ast.Literal) and isinstance(type_, t.String):
        finish(e, name, [None], t.Pointer(type_))
        return
    if not is_place(operand):
        b.report("E0323", operand.span, op=name, what="a variable", given="an expression")
        e.type = t.Pointer(type_)
        return
    mark_written(b, operand)
    finish(e, name, [None], t.Pointer(type_))


def _varinfo(b: Body, e: ast.Call, name: str) -> None:
    operand = _only_argument(b, e, name)
    if operand is None or value(b, operand) is None:
        return
    inner = operand.base if isinstance(operand, ast.Member) and operand.bit is not None else operand
    if not is_place(inner):
        b.report("E0323", operand.span, op=name, what="a variable", given="an expression")
        return
    finish(e, name, [None], VAR_INFO)


def _ref(b: Body, e: ast.Call, name: str) -> None:
    """`REF(x)` of IEC 61131-3: what a REF_TO is assigned."""
    operand = _variable_argument(b, e, name)
    if operand is not None and is_place(operand):
        mark_written(b, operand)
        finish(e, "ADR", [None], t.Pointer(operand.type, ref_to=True))


def _variable_argument(b: Body, e: ast.Call, name: str) -> ast.Expr | None:
    """The only argument of a call, evaluated; what is no variable is reported."""
    operand = _only_argument(b, e, name)
    if operand is None or value(b, operand) is None:
        return None
    if not is_place(operand):
        b.report("E0323", operand.span, op=name, what="a variable", given="an expression")
    return operand


def _adrinst(b: Body, e: ast.Call, name: str) -> None:
    if not count_fits(b, e, name, 0, 0):
        return
    block = b.block
    if block is None or block.instance is None:
        b.report("E0214", e.span, name=name)
        return
    finish(e, name, [], t.Pointer(block.instance))


def _bitadr(b: Body, e: ast.Call, name: str) -> None:
    operand = _only_argument(b, e, name)
    if operand is None or value(b, operand) is None:
        return
    symbol = getattr(operand, "symbol", None)
    if not isinstance(symbol, VarSymbol) or symbol.storage is not Storage.DIRECT:
        hint = "Give the variable an address, as in x AT %IX0.0 : BOOL."
        wanted = "a variable with an address"
        b.report("E0323", operand.span, op=name, what=wanted, given="something else", hint=hint)
        e.type = t.DWORD
        return
    finish(e, name, [None], t.DWORD, 8 * symbol.offset + (symbol.bit or 0))


def _indexof(b: Body, e: ast.Call, name: str) -> None:
    operand = _only_argument(b, e, name)
    if operand is None:
        return
    evaluate(b, operand)
    symbol = getattr(operand, "symbol", None)
    if not isinstance(symbol, PouSymbol):
        if symbol is not None or operand.type is not None:
            b.report("E0501", operand.span, name=text_of(operand), hint="INDEXOF needs the name of a POU.")
        return
    b.session.called.add(id(symbol))
    pous = b.session.analysis.pous
    index = next((i for i, p in enumerate(pous) if p is symbol), 0)
    finish(e, name, [None], t.INT, index & 0x7FFF)


def _isvalidref(b: Body, e: ast.Call, name: str) -> None:
    operand = _only_argument(b, e, name)
    e.type = t.BOOL
    if operand is None or value(b, operand) is None:
        return
    symbol = getattr(operand, "symbol", None)
    variable = isinstance(symbol, VarSymbol) and (
        isinstance(symbol.type, t.Reference) or symbol.section == "VAR_IN_OUT"
    )
    if variable or yields_reference(operand):
        finish(e, name, [None], t.BOOL)
    else:
        hint = "Declare it as REFERENCE TO; a pointer is compared with 0."
        given = f"'{operand.type}'"
        b.report("E0323", operand.span, op=name, what="a reference", given=given, hint=hint)


def _new(b: Body, e: ast.Call, name: str) -> None:
    if not count_fits(b, e, name, 1, 2):
        return
    operand = e.args[0].value
    assert operand is not None
    type_ = _made_type(b, operand)
    if type_ is None:
        if not isinstance(operand, ast.TypeOperand):  # else what is unknown in it has been reported
            b.report("E0202", operand.span, name=text_of(operand), hint="__NEW needs a type.")
        return
    length = e.args[1].value if len(e.args) > 1 else None
    count = t.UDINT if length is None else _count(b, length)
    b.session.complete(type_)
    if b.assigned is not e:
        b.report("E0519", e.span)
    made_of = innermost(type_)
    if isinstance(made_of, t.FunctionBlock):
        _check_dynamic(b, operand, made_of)
    finish(e, name, [None, count][: len(e.args)], t.Pointer(type_))


def _made_type(b: Body, operand: ast.Expr) -> Type | None:
    """The type that `__NEW` makes a value of; of `FB(...)` the block, whose FB_Init gets the arguments."""
    made = operand if isinstance(operand, ast.Call) and _text_type(operand) is None else None
    named = made.callee if made is not None else operand
    type_ = named_type(b, named)
    if type_ is None and not isinstance(named, ast.TypeOperand):
        evaluate(b, named)
        type_ = named_type(b, named)
    block = type_.pou.symbol if isinstance(type_, t.FunctionBlock) and type_.pou is not None else None
    if made is None:
        return type_
    made.type = made.constant = made.target = made.expansion = None
    made.is_constant = made.untyped = False
    if not isinstance(block, PouSymbol):
        return None
    for parameter in bind_fb_init(b, made.args, block, made.span):
        b.report("E0504", made.span, name=parameter.name, callee=f"{block.name}.FB_Init")
    return type_


def _count(b: Body, length: ast.Expr) -> Elementary:
    """Type of the length of `__NEW`: any integer."""
    type_ = value(b, length)
    base = t.value_type(type_) if type_ is not None else t.UDINT
    if not isinstance(base, Elementary) or not base.is_integer:
        b.report("E0303", length.span, op="__NEW", type=type_, hint="The length must be an integer.")
        return t.UDINT
    if length.untyped:
        require(b, length, t.UDINT)
        return t.UDINT
    return base


def _check_dynamic(b: Body, operand: ast.Expr, type_: t.FunctionBlock) -> None:
    pou = type_.pou
    symbol = pou.symbol if pou is not None else None
    if pou is None or not isinstance(symbol, PouSymbol):
        return
    b.session.called.add(id(symbol))
    in_library = symbol.source is not None and symbol.source.scope is Scope.LIBRARY
    if not in_library and attribute(pou.attributes, "enable_dynamic_creation") is None:
        b.report("E0427", operand.span, name=type_.name)
    if "ABSTRACT" in pou.modifiers:
        b.report("E0425", operand.span, name=type_.name)


def _delete(b: Body, e: ast.Call, name: str) -> None:
    operand = _only_argument(b, e, name)
    if operand is None or value(b, operand) is None:
        return
    if not isinstance(operand.type, t.Pointer):
        hint = "Write the pointer that __NEW gave."
        b.report("E0323", operand.span, op=name, what="a pointer", given=f"'{operand.type}'", hint=hint)
        return
    if not isinstance(operand, ast.This):
        writable(b, operand)
    finish(e, name, [None], None)


def _query(b: Body, e: ast.Call, name: str) -> None:
    e.type = t.BOOL
    if not count_fits(b, e, name, 2, 2):
        return
    source, destination = e.args[0].value, e.args[1].value
    assert source is not None
    assert destination is not None
    if value(b, source) is None or value(b, destination) is None:
        return
    if not isinstance(source.type, (t.Interface, t.FunctionBlock)):
        b.report("E0521", source.span, name=name, type=source.type, hint="")
        return
    wanted = t.Interface if name == "__QUERYINTERFACE" else t.Pointer
    if not isinstance(destination.type, wanted):
        what = "an interface" if wanted is t.Interface else "a pointer"
        hint = f"The second operand must be a variable of {what}."
        b.report("E0521", destination.span, name=name, type=destination.type, hint=hint)
        return
    writable(b, destination)
    finish(e, name, [source.type, None], t.BOOL)


def _bound(b: Body, e: ast.Call, name: str) -> None:
    if not count_fits(b, e, name, 2, 2):
        return
    array, dimension = e.args[0].value, e.args[1].value
    assert array is not None
    assert dimension is not None
    type_ = value(b, array)
    value(b, dimension)
    e.type = t.DINT
    if type_ is None or dimension.type is None:
        return
    if not isinstance(type_, t.Array):
        b.report("E0308", array.span, type=type_)
        return
    number = dimension.constant
    count = type_.open_dims or len(type_.bounds)
    if not isinstance(number, int):
        b.report("E0317", dimension.span)
    elif not 1 <= number <= count:
        b.report("E0310", dimension.span, index=number, low=1, high=count)
    else:
        bounds = None if type_.open_dims else type_.bounds[number - 1][0 if name == "LOWER_BOUND" else 1]
        finish(e, name, [None, t.DINT], t.DINT, bounds)


# -- system sources ---------------------------------------------------------------------------------


def _system(resolve: Resolve) -> Resolve:
    def check(b: Body, e: ast.Call, name: str) -> None:
        if not b.session.options.system and b.source.scope is not Scope.LIBRARY:
            b.report("E0518", e.span, name=name)
        resolve(b, e, name)

    return check


def _call_address(b: Body, e: ast.Call, name: str) -> None:
    found = operands(b, e, name, 1, 20)
    if found is None:
        e.type = t.LINT
        return
    if require(b, found[0], t.LWORD):
        for argument in found[1:]:
            if argument.untyped:
                retype(argument, t.LREAL if argument.constant.__class__ is float else t.LINT)
        finish(e, name, [t.LWORD, *(x.type for x in found[1:])], t.LINT)


def _fixed(parameters: tuple[Elementary, ...], result: Elementary | None) -> Resolve:
    def resolve(b: Body, e: ast.Call, name: str) -> None:
        found = operands(b, e, name, len(parameters), len(parameters))
        if found is None:
            e.type = result
            return
        for argument, parameter in zip(found, parameters, strict=True):
            require(b, argument, parameter)
        finish(e, name, parameters, result)

    return resolve


def _load(b: Body, e: ast.Call, name: str) -> None:
    operand = _variable_argument(b, e, name)
    if operand is not None:
        finish(e, name, [None], operand.type)


def _store(b: Body, e: ast.Call, name: str) -> None:
    found = operands(b, e, name, 2, 2)
    if found is None:
        return
    target = found[0].type
    assert target is not None
    writable(b, found[0])
    require(b, found[1], target)
    finish(e, name, [None, target], None)


def _exchange(b: Body, e: ast.Call, name: str) -> None:
    """`__XADD(ADR(x), d)`, `__COMPARE_AND_SWAP(ADR(x), old, new)`, on the type of x."""
    wanted = 2 if name == "__XADD" else 3
    found = operands(b, e, name, wanted, wanted)
    if found is None:
        return
    pointer = found[0].type
    if not isinstance(pointer, t.Pointer) or pointer.base is None:
        hint = "Write ADR(...) of the variable."
        b.report("E0323", found[0].span, op=name, what="a pointer", given=f"'{pointer}'", hint=hint)
        return
    for argument in found[1:]:
        require(b, argument, pointer.base)
    result = pointer.base if name == "__XADD" else t.BOOL
    finish(e, name, [pointer, *([pointer.base] * (wanted - 1))], result)


OPERATIONS: dict[str, Resolve] = {
    "SIZEOF": _sizeof,
    "XSIZEOF": _sizeof,
    "ADR": _adr,
    "REF": _ref,
    "__VARINFO": _varinfo,
    "ADRINST": _adrinst,
    "BITADR": _bitadr,
    "INDEXOF": _indexof,
    "LOWER_BOUND": _bound,
    "UPPER_BOUND": _bound,
    "__ISVALIDREF": _isvalidref,
    "__NEW": _new,
    "__DELETE": _delete,
    "__QUERYINTERFACE": _query,
    "__QUERYPOINTER": _query,
    "__CALL": _system(_call_address),
    "__SETJMP": _system(_fixed((t.LWORD,), t.DINT)),
    "__LONGJMP": _system(_fixed((t.LWORD, t.DINT), None)),
    "__FRAME_ADDRESS": _system(_fixed((), t.LWORD)),
    "__MEMCPY": _system(_fixed((t.LWORD, t.LWORD, t.LWORD), None)),
    "__MEMSET": _system(_fixed((t.LWORD, t.BYTE, t.LWORD), None)),
    "__LOAD_ACQUIRE": _system(_load),
    "__STORE_RELEASE": _system(_store),
    "__XADD": _system(_exchange),
    "__COMPARE_AND_SWAP": _system(_exchange),
    "__FENCE": _system(_fixed((), None)),
}

"""Calls of functions, programs, instances, methods and actions (LST-21..LST-23, LDEC-21..LDEC-23)."""

from __future__ import annotations

from collections.abc import Sequence

from tappet.lang import ast
from tappet.lang import types as t
from tappet.lang.analysis import conversion, named_operands
from tappet.lang.analysis.adaptation import complain, require
from tappet.lang.analysis.context import Body
from tappet.lang.analysis.expressions import place_or_name, text_of, value
from tappet.lang.analysis.pins import pin_of_iec
from tappet.lang.analysis.places import is_input, is_place, mark_written, note_output, writable
from tappet.lang.analysis.result import yields_reference
from tappet.lang.analysis.scope import QualifiedSymbol, describe
from tappet.lang.analysis.type_conversions import find_operator
from tappet.lang.any_type import accepts, is_any
from tappet.lang.heritage import has_unknown_base
from tappet.lang.rules import EXPRESSION_RULES
from tappet.lang.source import Span
from tappet.lang.symbols import PouSymbol, PropertySymbol, Storage, Symbol, TypeSymbol, VarSymbol
from tappet.lang.types import Elementary, Type

_CALL_RULES = EXPRESSION_RULES.get(ast.Call, ())
_PASSED = frozenset({"VAR_INPUT", "VAR_IN_OUT"})


def call(b: Body, e: ast.Call) -> None:
    """Resolves and checks a call and its arguments."""
    _resolve(b, e)
    for check in _CALL_RULES:
        check(b, e)


def _resolve(b: Body, e: ast.Call) -> None:
    e.type = e.constant = e.target = e.expansion = e.gate = None
    e.is_constant = e.untyped = False
    callee = e.callee
    if callee.__class__ is ast.Name and not callee.leading_dot:
        key = callee.name.upper()
        symbol = b.locals.get(key) or b.values.get(key) or b.names.get(key)
        if symbol is None or symbol.__class__ is QualifiedSymbol:
            resolve = find_operator(key)
            if resolve is not None:
                callee.type = None
                if any(arg.name is not None for arg in e.args):
                    _named_operator(b, e, key)
                else:
                    resolve(b, e, key)
                callee.symbol = e.target
                return
        elif symbol.__class__ is VarSymbol and symbol.storage is Storage.RESULT:
            own = b.pou
            if own is not None and own.result is symbol:
                callee.type = None
                callee.symbol = own
                _bind(b, e, own)
                return
    b.callee = callee
    type_ = place_or_name(b, callee)
    symbol = getattr(callee, "symbol", None)
    if isinstance(symbol, PouSymbol):
        if symbol.kind == "FUNCTION_BLOCK":
            b.report("E0516", callee.span, name=symbol.name)
            evaluate_arguments(b, e.args)
        else:
            if symbol.pou is not None and symbol.pou.attributes:
                b.warn_obsolete(callee.span, symbol.pou.attributes)
            if symbol.kind == "FUNCTION" and named_operands.enabled(e, symbol):
                _when_enabled(b, e, symbol)
            else:
                _bind(b, e, symbol)
        return
    if isinstance(type_, t.FunctionBlock):
        target = type_.pou.symbol if type_.pou is not None else None
        if isinstance(target, PouSymbol):
            mark_written(b, callee)
            _bind(b, e, target)
            return
    known = not (isinstance(symbol, VarSymbol) and symbol.type is None)  # else its type has been reported
    if type_ is not None or (symbol is not None and known):
        b.report("E0501", callee.span, name=text_of(callee), hint=_hint(b, callee, symbol, type_))
    evaluate_arguments(b, e.args)


def _named_operator(b: Body, e: ast.Call, name: str) -> None:
    if named_operands.enabled(e, None):
        _when_enabled(b, e, None)
        return
    args = named_operands.ordered(b, e, name)
    if args is None:
        evaluate_arguments(b, e.args)
        return
    b.report("W1148", e.span, name=name)
    inner = ast.Call(span=e.span, callee=e.callee, args=args)
    _resolve(b, inner)
    named_operands.mean(e, inner)


def _when_enabled(b: Body, e: ast.Call, target: PouSymbol | None) -> None:
    """A call with EN or ENO, which `target` does not declare; None: of an operator."""
    b.report("W1150", e.span, name=text_of(e.callee))
    inner = ast.Call(span=e.span, callee=e.callee, args=named_operands.without_enable(e))
    if target is None:
        _resolve(b, inner)
    else:
        _bind(b, inner, target)
    named_operands.when_enabled(b, e, inner)


def _hint(b: Body, callee: ast.Expr, symbol: Symbol | None, type_: Type | None) -> str:
    if isinstance(type_, t.Pointer) and isinstance(type_.base, t.FunctionBlock):
        return f"Write {text_of(callee)}^(...)."
    if isinstance(symbol, PropertySymbol):
        return "A property is used without parentheses."
    if isinstance(symbol, TypeSymbol):
        return "Declare a variable of this type."
    if isinstance(symbol, VarSymbol):
        return f"'{symbol.name}' is a {describe(symbol)} of type '{symbol.type}'."
    return ""


def _pass_accumulator(e: ast.Call, accumulator: ast.Argument, target: PouSymbol) -> None:
    """IL: the accumulator is the first operand of what takes one (IL-13)."""
    takes = any(p.section in _PASSED for p in target.parameters)
    passed = bool(e.args) and e.args[0] is accumulator
    if takes != passed:
        e.args = [accumulator, *e.args] if takes else e.args[1:]


def evaluate_arguments(b: Body, args: Sequence[ast.Argument]) -> None:
    """Resolves arguments that no parameters are known for."""
    for arg in args:
        arg.parameter = None
        if arg.value is not None:
            value(b, arg.value)


def _bind(b: Body, e: ast.Call, target: PouSymbol) -> None:
    """Connects the arguments with the parameters of `target`."""
    e.target = target
    result = target.return_type
    e.type = result.base if result.__class__ is t.Reference else result
    b.session.called.add(id(target))
    b.called.append((target, text_of(e.callee), e.span))
    if e.accumulator is not None:
        _pass_accumulator(e, e.accumulator, target)
    parameters = target.parameters
    if target.kind == "ACTION" and target.owner is not None and e.args:
        parameters = target.owner.parameters  # those of the block it belongs to
        callee = e.callee
        if isinstance(callee, ast.Member) and callee.base.type is not None:
            mark_written(b, callee.base)
    if has_unknown_base(target.owner if target.kind == "ACTION" else target):
        evaluate_arguments(b, e.args)  # the inputs of the base are not known
        return
    args: Sequence[ast.Argument] = e.args
    if target.return_type is None and named_operands.enabled(e, target):
        b.report("W1150", e.span, name=text_of(e.callee))
        e.gate = named_operands.gate(b, e)
        args = named_operands.without_enable(e)
    bind_arguments(b, args, parameters, target.name, e.span, target.kind)


def bind_arguments(
    b: Body,
    args: Sequence[ast.Argument],
    parameters: Sequence[VarSymbol],
    callee: str,
    span: Span,
    kind: str,
) -> None:
    """Checks arguments against parameters and sets `Argument.parameter`.

    An argument without a name is for the input at its place, also behind named ones: other systems allow
    that, and real programs use it.
    """
    given: set[int] = set()
    positional = 0
    named = False
    by_name: dict[str, VarSymbol] | None = None
    inputs: list[VarSymbol] | None = None
    for arg in args:
        arg.parameter = None
        name = arg.name
        if name is None:
            if inputs is None:
                inputs = [p for p in parameters if p.section in _PASSED]
            if named and positional < len(inputs) and id(inputs[positional]) in given:
                b.report("E0512", arg.span)
                positional += 1
                evaluate_arguments(b, [arg])
                continue
            if positional >= len(inputs):
                if positional == len(inputs):
                    count = sum(1 for a in args if a.name is None)
                    hint = (
                        f"Its inputs are: {', '.join(p.name for p in inputs)}."
                        if inputs
                        else "It has no inputs."
                    )
                    b.report("E0503", arg.span, callee=callee, expected=len(inputs), actual=count, hint=hint)
                positional += 1
                evaluate_arguments(b, [arg])
                continue
            parameter = inputs[positional]
            positional += 1
        else:
            if not arg.output:
                named = True
                positional += 1
            if by_name is None:
                by_name = {p.name.upper(): p for p in parameters}
            found = by_name.get(name.upper()) or pin_of_iec(b, name, parameters, callee, arg.span)
            if found is None:
                hint = b.suggest(name, [(k, Symbol(p.name)) for k, p in by_name.items()]).partition(" (")[0]
                b.report("E0502", arg.span, name=name, callee=callee, hint=hint + "?" if hint else "")
                evaluate_arguments(b, [arg])
                continue
            parameter = found
        if id(parameter) in given:
            b.report("E0509", arg.span, name=parameter.name)
        given.add(id(parameter))
        arg.parameter = parameter
        _argument(b, arg, parameter, callee)
    _check_missing(b, parameters, given, callee, span, kind)


def _check_missing(
    b: Body, parameters: Sequence[VarSymbol], given: set[int], callee: str, span: Span, kind: str
) -> None:
    for parameter in parameters if kind != "ACTION" else ():
        if id(parameter) in given:
            continue
        if parameter.section == "VAR_IN_OUT":
            b.report("E0505", span, name=parameter.name, callee=callee)
        elif (
            parameter.section == "VAR_INPUT"
            and kind in ("FUNCTION", "METHOD")
            and (parameter.decl is None or parameter.decl.initial is None)
        ):
            b.report("E0504", span, name=parameter.name, callee=callee)


def _argument(b: Body, arg: ast.Argument, parameter: VarSymbol, callee: str) -> None:
    section = parameter.section
    type_ = parameter.type
    if type_ is None:
        b.session.resolve(parameter)
        type_ = parameter.type
    content = arg.value
    if section == "VAR_OUTPUT":
        if not arg.output:
            b.report("E0510", arg.span, name=parameter.name)
        if content is not None:
            _output(b, content, type_)
        return
    if arg.output:
        b.report("E0511", arg.span, name=parameter.name)
    if content is None:
        return
    if value(b, content) is None or type_ is None:
        return
    if section == "VAR_IN_OUT":
        _in_out(b, content, parameter, type_, callee)
    elif type_.__class__ is t.Reference:
        bind_reference(b, content, type_)
    elif is_any(type_):
        _any(b, content, type_)
    else:
        require(b, content, type_)


def _any(b: Body, content: ast.Expr, type_: Type) -> None:
    own = content.type
    assert own is not None
    if not accepts(type_, own):
        b.report("E0301", content.span, source=own, target=type_, hint="")
    elif is_place(content):
        mark_written(b, content)  # through pValue


def _output(b: Body, target: ast.Expr, source: Type | None) -> None:
    type_ = value(b, target)
    if type_ is None or source is None or not writable(b, target):
        return
    if isinstance(getattr(target, "symbol", None), PropertySymbol) and not yields_reference(target):
        hint = "An output cannot be assigned to a property: use a variable."
        b.report("E0305", target.span, name=text_of(target), hint=hint)
        return
    source = source.base if isinstance(source, t.Reference) else source
    code = conversion.verdict(source, type_)
    if code:
        complain(b, target.span, source, type_, code)


def bind_reference(b: Body, content: ast.Expr, type_: t.Reference) -> None:
    """Checks that a reference may be bound to the analysed `content`."""
    if content.is_constant and content.untyped and content.constant == 0:
        return
    if not is_place(content):
        b.report("E0319", content.span, type=type_.base)
        return
    mark_written(b, content)
    own = content.type
    assert own is not None
    if own == type_.base:
        return
    if conversion.refers(own, type_.base) or conversion.same_shape(own, type_.base):
        return
    b.report("E0301", content.span, source=own, target=type_, hint="A reference needs exactly its type.")


def _in_out(b: Body, content: ast.Expr, parameter: VarSymbol, type_: Type, callee: str) -> None:
    type_ = type_.base if isinstance(type_, t.Reference) else type_
    own = content.type
    assert own is not None
    constant = "CONSTANT" in parameter.flags
    if isinstance(content, ast.Member) and (
        content.bit is not None or (isinstance(content.symbol, VarSymbol) and content.symbol.bit is not None)
    ):
        b.report("E0508", content.span)
        return
    texts = isinstance(own, t.String) and isinstance(type_, t.String) and own.wide == type_.wide
    if constant and not is_place(content):
        if not (texts and isinstance(content, ast.Literal)):  # the whole literal is handed over
            require(b, content, type_)
        return
    if not is_place(content) or (not constant and _protected(content)):
        b.report("E0506", content.span, name=parameter.name, callee=callee)
        return
    mark_written(b, content)
    if not constant:
        _note_written(b, content)
    if not (constant and texts) and not _passes(own, type_):
        b.report("E0507", content.span, name=parameter.name, target=type_, source=own)


def _note_written(b: Body, content: ast.Expr) -> None:
    """A variable AT %I* may be written by what it is passed to."""
    symbol = getattr(content, "symbol", None)
    if isinstance(symbol, VarSymbol) and symbol.area == "I":
        note_output(b, symbol, content)


def _protected(content: ast.Expr) -> bool:
    """Whether a place cannot be written: a constant or an input address."""
    e = content
    while True:
        symbol = getattr(e, "symbol", None)
        if isinstance(symbol, VarSymbol) and ("CONSTANT" in symbol.flags or is_input(symbol)):
            return True
        if isinstance(e, ast.Member) or (isinstance(e, ast.Index) and not isinstance(e.base.type, t.Pointer)):
            e = e.base
        else:
            return False


def _passes(own: Type, formal: Type) -> bool:
    """Whether a variable of type `own` may be passed as VAR_IN_OUT of type `formal`."""
    if own is formal or own == formal:
        return True
    if isinstance(formal, t.Array) and isinstance(own, t.Array):
        if formal.open_dims:
            same = own.open_dims == formal.open_dims or len(own.bounds) == formal.open_dims
            return same and own.element == formal.element
        return conversion.same_shape(own, formal)
    if isinstance(formal, t.String) and isinstance(own, t.String):
        return own.wide == formal.wide and own.length >= formal.length
    if isinstance(formal, t.FunctionBlock) and isinstance(own, t.FunctionBlock):
        return conversion.derives(own, formal)
    if isinstance(formal, t.Struct) and isinstance(own, t.Struct):
        return conversion.refers(own, formal)
    if isinstance(formal, t.Pointer) and isinstance(own, t.Pointer):
        return formal.base is None or own.base is None
    formal_base, own_base = t.value_type(formal), t.value_type(own)
    return isinstance(formal_base, Elementary) and formal_base == own_base

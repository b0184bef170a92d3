"""A pointer holds an address of its own type, and a reference is bound before it is used.

A number need not be an address. The order and the distance of two pointers have a meaning inside one array
only. A pointer to BYTE may look at everything, one to WORD at a WSTRING, and one to an element at its array.

Source: coding guidelines of PLCopen, E2, E3, CP25; CODESYS Static Analysis SA0017, SA0019, SA0061, SA0145.

Passes:
    @static
    VAR nA : INT; aA : ARRAY[0..9] OF INT; pA : POINTER TO INT; pB : POINTER TO BYTE; END_VAR
    VAR rA : REFERENCE TO INT; END_VAR
    pA := ADR(nA);
    pA := ADR(aA);
    pB := pA;
    IF pA <> 0 AND pB <> 0 THEN pA := 0; END_IF
    rA REF= nA;
    rA := 2;
Fails:
    @static
    VAR pA : POINTER TO INT; nPlace : LWORD; END_VAR
    nPlace := nPlace + 8;
    pA := nPlace;                  (* S1235: any number *)
Fails:
    @static
    VAR pA, pB : POINTER TO INT; nDistance : LINT; END_VAR
    IF pA < pB THEN                (* S1236: which of them lies first *)
        nDistance := pB - pA;      (* S1236: how far they are apart *)
    END_IF
Fails:
    @static
    VAR nA : INT; pA : POINTER TO DINT; END_VAR
    pA := ADR(nA);                 (* S1237: writes beyond nA *)
Fails:
    @static
    VAR rA : REFERENCE TO INT; END_VAR
    rA := 2;                       (* S1238: of what? *)
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from tappet.lang import ast
from tappet.lang.symbols import BuiltinSymbol, PouSymbol, VarSymbol
from tappet.lang.types import (
    BYTE,
    WORD,
    Array,
    Elementary,
    FunctionBlock,
    Pointer,
    Reference,
    String,
    Type,
    value_type,
)
from tappet.lang.walk import own_expressions, statements

if TYPE_CHECKING:
    from tappet.lang.analysis.context import Body

CODES = ("S1235", "S1236", "S1237", "S1238")
_ORDER = frozenset({"<", ">", "<=", ">="})


def check_pou(b: Body, chosen: frozenset[str]) -> None:
    """Reports what a body does with pointers and references."""
    if b.pou is None or b.pou.pou is None:
        return
    bound = _bound_before(b.pou) if "S1238" in chosen else None
    for s in statements(b.pou.pou.body):
        if isinstance(s, ast.Assign):
            _assigned(b, s, chosen)
        found = list(own_expressions(s))
        for e in found:
            if isinstance(e, ast.AssignExpr):
                _assigned(b, e, chosen)
            elif isinstance(e, ast.Binary) and "S1236" in chosen and _orders(e, "S1214" in chosen):
                b.report("S1236", e.span, op=e.op)
        if bound is not None:
            for name in _unbound(s, found, bound, b.pou):
                b.report("S1238", name.span, name=name.name)


def _assigned(b: Body, s: ast.Assign | ast.AssignExpr, chosen: frozenset[str]) -> None:
    target, source = s.target.type, s.value.type
    if s.op != ":=" or not isinstance(target, Pointer) or source is None:
        return
    if isinstance(value_type(source), Elementary):
        if "S1235" in chosen and not (s.value.is_constant and s.value.constant == 0):
            b.report("S1235", s.value.span, type=source)
    elif isinstance(source, Pointer) and "S1237" in chosen and not _fits(source.base, target.base):
        b.report("S1237", s.value.span, source=source, target=target)


def _fits(source: Type | None, target: Type | None) -> bool:
    """Whether what lies at an address of `source` may be used as `target`."""
    if source is None or target is None or target == BYTE:
        return True
    if isinstance(target, Array) and target.element == BYTE:
        return True
    if isinstance(source, Array) and not isinstance(target, Array):
        return _fits(source.element, target)
    if isinstance(source, Array) and isinstance(target, Array):
        return source.element == target.element
    if isinstance(source, String):
        wide = isinstance(target, String) and target.wide
        return source.wide == wide if isinstance(target, String) else source.wide and target == WORD
    if isinstance(source, FunctionBlock) and isinstance(target, FunctionBlock):
        base: FunctionBlock | None = source
        while base is not None and base is not target:
            base = base.base
        return base is target
    return value_type(source) == value_type(target)


def _orders(e: ast.Binary, arithmetic_reported: bool) -> bool:
    """Whether an operation asks where pointers lie; `pointer - number` only if nothing else reports it."""
    if not isinstance(e.left.type, Pointer):
        return False
    other = isinstance(e.right.type, Pointer)
    return (e.op in _ORDER and other) or (e.op == "-" and (other or not arithmetic_reported))


def _bound_before(pou: PouSymbol) -> set[str]:
    """Upper-case names of references that FB_Init binds before the body runs."""
    owner = pou.owner or pou
    init = owner.methods.get("FB_INIT")
    if init is None or init.pou is None or init is pou:
        return set()
    targets = (s.target for s in statements(init.pou.body) if isinstance(s, ast.Assign) and s.op == "REF=")
    return {target.name.upper() for target in targets if isinstance(target, (ast.Name, ast.Member))}


def _unbound(s: ast.Stmt, found: list[ast.Expr], bound: set[str], pou: PouSymbol) -> Iterator[ast.Name]:
    """References among the expressions of a statement that nothing has bound or tested before, each once."""
    begun = {id(e): e.name.upper() for e in _begun(s, found)}
    for e in found:
        if isinstance(e, ast.Name) and id(e) not in begun and _may_be_open(e.symbol, pou):
            key = e.name.upper()
            if key not in bound and key not in begun.values():
                bound.add(key)
                yield e
    bound.update(begun.values())


def _begun(s: ast.Stmt, found: list[ast.Expr]) -> Iterator[ast.Name]:
    """The names that a statement binds by REF= or tests by __ISVALIDREF."""
    if isinstance(s, ast.Assign) and s.op == "REF=" and isinstance(s.target, ast.Name):
        yield s.target
    for e in found:
        if (
            isinstance(e, ast.Call)
            and isinstance(e.target, BuiltinSymbol)
            and e.target.name == "__ISVALIDREF"
        ):
            yield from (arg.value for arg in e.args if isinstance(arg.value, ast.Name))


def _may_be_open(symbol: object, pou: PouSymbol) -> bool:
    """Whether a reference can be without a target: not one that every call of a function has to pass."""
    if not isinstance(symbol, VarSymbol) or not isinstance(symbol.type, Reference):
        return False
    passed = symbol.section in ("VAR_INPUT", "VAR_IN_OUT") and pou.kind in ("FUNCTION", "METHOD")
    return not passed and (symbol.decl is None or symbol.decl.init is None) and symbol.section != "VAR_IN_OUT"

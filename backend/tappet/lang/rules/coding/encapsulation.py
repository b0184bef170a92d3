"""Data stay where they belong: outputs are written, locals are read inside, globals are shared.

Source: coding guidelines of PLCopen, CP24 (global variables), CP11 (locals); CODESYS Static Analysis SA0012,
SA0038, SA0043, SA0102, SA0107.

Passes:
    @static
    FUNCTION_BLOCK FB_Count
    VAR_INPUT nStep : INT; END_VAR
    VAR_OUTPUT nValue : INT; END_VAR
    VAR nOwn : INT; END_VAR
    nOwn := nOwn + nStep;
    nValue := nOwn;
    END_FUNCTION_BLOCK
    PROGRAM Main
    VAR fbCount : FB_Count; nSeen : INT; END_VAR
    fbCount(nStep := 2, nValue => nSeen);
    END_PROGRAM
Fails:
    @static
    FUNCTION_BLOCK FB_Count
    VAR_INPUT nStep : INT; END_VAR
    VAR_OUTPUT nValue : INT; END_VAR
    nValue := nValue + nStep;      (* S1414: reads its own output *)
    END_FUNCTION_BLOCK
Fails:
    @static
    VAR nLimit : INT := 10; nA : INT; END_VAR   (* S1415: nLimit never changes *)
    IF nA < nLimit THEN nA := nA + 1; END_IF
Fails:
    @static
    @source GVL_Data
    VAR_GLOBAL gCount : INT; END_VAR   (* S1416: only Main uses it *)
    @source Main
    PROGRAM Main
    gCount := gCount + 1;
    END_PROGRAM
    @source Other
    FUNCTION_BLOCK FB_Other
    VAR n1 : INT; END_VAR
    n1 := n1 + 1;
    END_FUNCTION_BLOCK
Fails:
    @static
    FUNCTION_BLOCK FB_Count
    VAR nOwn : INT; END_VAR
    nOwn := nOwn + 1;
    END_FUNCTION_BLOCK
    PROGRAM Main
    VAR fbCount : FB_Count; nSeen : INT; END_VAR
    fbCount();
    nSeen := fbCount.nOwn;         (* S1417: a local variable of the block *)
    END_PROGRAM
Fails:
    @static
    FUNCTION_BLOCK FB_Count
    VAR_INPUT nStep, nLimit : INT; END_VAR
    VAR_OUTPUT nValue : INT; END_VAR
    nValue := MIN(nStep, nLimit);
    END_FUNCTION_BLOCK
    PROGRAM Main
    VAR fbCount : FB_Count; nSeen : INT; END_VAR
    fbCount(nStep := 2, nValue => nSeen);   (* S1418: nLimit is left out *)
    END_PROGRAM
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from tappet.lang import ast
from tappet.lang.named_symbols import named_in
from tappet.lang.source import Scope
from tappet.lang.symbols import PouSymbol, Storage, VarSymbol
from tappet.lang.types import Elementary, Enum, FunctionBlock, String, Subrange
from tappet.lang.walk import all_expressions, statements

if TYPE_CHECKING:
    from tappet.lang.analysis.context import Body, Session

CODES = ("S1414", "S1415", "S1416", "S1417", "S1418")
_SIMPLE = (Elementary, Enum, String, Subrange)
_KEPT = (Storage.PROGRAM, Storage.INSTANCE, Storage.GLOBAL)


def check_pou(b: Body, chosen: frozenset[str]) -> None:
    """Reports reads of own outputs and of the locals of others, and calls that leave inputs out."""
    if b.pou is None or b.pou.pou is None:
        return
    body = b.pou.pou.body
    targets = {id(s.target) for s in statements(body) if isinstance(s, ast.Assign)}
    for e in all_expressions(body):
        if isinstance(e, ast.Call):
            targets |= {id(a.value) for a in e.args if a.output}
            if "S1418" in chosen:
                _left_out(b, e)
        elif isinstance(e, ast.Name) and "S1414" in chosen:
            symbol = e.symbol
            output = isinstance(symbol, VarSymbol) and symbol.section == "VAR_OUTPUT"
            if output and id(e) not in targets and b.block is not None:
                b.report("S1414", e.span, name=e.name)
        elif isinstance(e, ast.Member) and "S1417" in chosen and id(e) not in targets:
            _local_of_another(b, e)


def _left_out(b: Body, e: ast.Call) -> None:
    """Inputs without initial value that a call with arguments does not assign: they keep their last value."""
    target = e.target
    if not isinstance(target, PouSymbol) or target.kind != "FUNCTION_BLOCK" or not e.args:
        return
    given = {id(a.parameter) for a in e.args}
    missing = [
        p.name
        for p in target.parameters
        if p.section == "VAR_INPUT" and id(p) not in given and (p.decl is None or p.decl.init is None)
    ]
    if missing:
        b.report("S1418", e.span, name=target.name, inputs=", ".join(missing))


def _local_of_another(b: Body, e: ast.Member) -> None:
    symbol = e.symbol
    if not isinstance(symbol, VarSymbol) or symbol.section != "VAR":
        return
    base = e.base
    if isinstance(base.type, FunctionBlock):
        pou = base.type.pou
        owner = pou.symbol if pou is not None else None
        if isinstance(base, ast.Deref) and isinstance(base.base, (ast.This, ast.Super)):
            return
    elif base.type is None and isinstance(base, (ast.Name, ast.Member)):
        owner = base.symbol
    else:
        return
    if isinstance(owner, PouSymbol) and owner is not b.block:
        b.report("S1417", e.name_span, name=e.name, owner=owner.name)


def check_program(session: Session, chosen: frozenset[str]) -> None:
    """Reports variables that nothing writes, and global variables that one object uses alone."""
    if "S1415" in chosen:
        variables = [v for gvl in session.analysis.gvls for v in gvl.members.values() if gvl.decl is not None]
        variables += [v for pou in session.analysis.pous for v in pou.locals.values() if v.section == "VAR"]
        for variable in dict.fromkeys(variables):
            _never_written(session, variable)
    if "S1416" not in chosen:
        return
    users: dict[int, dict[str, None]] = {}
    shared = {id(v) for gvl in session.analysis.gvls if gvl.decl is not None for v in gvl.members.values()}
    for pou in session.analysis.pous:
        for part in pou.with_children():
            for key in shared.intersection(named_in(session, part).symbols):
                users.setdefault(key, {})[pou.name] = None
    for gvl in session.analysis.gvls:
        if gvl.source is None or gvl.source.scope is Scope.LIBRARY or gvl.decl is None:
            continue
        for variable in gvl.members.values():
            names = users.get(id(variable), {})
            plain = not variable.flags and variable.area is None and variable.span is not None
            if len(names) == 1 and plain:
                assert variable.span is not None
                user = next(iter(names))
                session.report("S1416", gvl.source.uri, variable.span, name=variable.name, user=user)


def _never_written(session: Session, variable: VarSymbol) -> None:
    source, span, decl = variable.source, variable.span, variable.decl
    if source is None or span is None or decl is None or source.scope is Scope.LIBRARY:
        return
    key = id(variable)
    if (
        decl.initial is not None
        and isinstance(variable.type, _SIMPLE)
        and variable.home in _KEPT
        and not variable.flags
        and decl.address is None
        and not decl.attributes
        and key in session.used
        and key not in session.written
    ):
        session.report("S1415", source.uri, span, name=variable.name)

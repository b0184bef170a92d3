"""Data are written in one place, and blocks are called in one place, in every cycle.

Source: coding guidelines of PLCopen, CP1 (access to members by name), CP2 (all code is used), CP3 (initial
values), CP4 (no overlap), CP7 (global variables in functions), CP16 (instances are called once), CP26
(single assignment of outputs).

Passes:
    @static
    FUNCTION_BLOCK FB_Lamp
    VAR_INPUT bOn : BOOL; END_VAR
    VAR_OUTPUT bLamp : BOOL; END_VAR
    bLamp := bOn;
    END_FUNCTION_BLOCK
Fails:
    @static
    FUNCTION_BLOCK FB_Lamp
    VAR_INPUT bOn : BOOL; END_VAR
    VAR_OUTPUT bLamp : BOOL; END_VAR
    bLamp := FALSE;
    IF bOn THEN bLamp := TRUE; END_IF   (* S1401: written twice *)
    END_FUNCTION_BLOCK
Fails:
    @static
    FUNCTION_BLOCK FB_Lamp
    VAR_INPUT bOn : BOOL; END_VAR
    VAR_OUTPUT bLamp : BOOL; END_VAR
    bLamp := bOn;
    END_FUNCTION_BLOCK
    PROGRAM Main
    VAR fbLamp : FB_Lamp; bOn : BOOL; END_VAR
    IF bOn THEN
        fbLamp(bOn := bOn);        (* S1402: S1403: not in every cycle, and twice *)
    END_IF
    fbLamp(bOn := FALSE);
    END_PROGRAM
Fails:
    @static
    @source GVL_Data
    VAR_GLOBAL nTotal : INT; END_VAR
    @source F_Add
    FUNCTION F_Add : INT
    VAR_INPUT nStep : INT; END_VAR
    nTotal := nTotal + nStep;      (* S1404: a global variable in a function *)
    F_Add := nTotal;
    END_FUNCTION
Fails:
    @static
    VAR i, n1 : INT; END_VAR
    FOR i := 1 TO 10 DO n1 := n1 + i; END_FOR
    n1 := i;                       (* S1405: used behind its loop *)
Fails:
    @static
    FUNCTION F_One : INT
    VAR_INPUT nStep, nUnused : INT; END_VAR   (* S1406: nUnused is not used *)
    F_One := nStep;
    END_FUNCTION
Fails:
    @static
    FUNCTION_BLOCK FB_Step
    VAR_INPUT nStep, nUnused : INT; END_VAR   (* S1406: nUnused is not used *)
    VAR nOwn : INT; END_VAR
    nOwn := nOwn + nStep;
    END_FUNCTION_BLOCK
Fails:
    @static
    FUNCTION F_One : INT
    F_One := 1;
    END_FUNCTION
    PROGRAM Main
    F_One();                       (* S1407: the result is lost *)
    END_PROGRAM
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from tappet.lang import ast
from tappet.lang.diagnostics import Related
from tappet.lang.source import Scope
from tappet.lang.symbols import PouSymbol, Storage, VarSymbol
from tappet.lang.walk import bodies, own_expressions

if TYPE_CHECKING:
    from tappet.lang.analysis.context import Body, Session

CODES = ("S1401", "S1402", "S1403", "S1404", "S1405", "S1406", "S1407")


def check_pou(b: Body, chosen: frozenset[str]) -> None:
    """Reports how a body uses data and instances."""
    pou = b.pou
    if pou is None or pou.pou is None:
        return
    seen = _Seen(b, chosen)
    seen.body(pou.pou.body, 0)
    if "S1406" in chosen and pou.pou.body and pou.kind in ("FUNCTION", "METHOD") and pou.owner is None:
        for p in pou.parameters:
            if p.section == "VAR_INPUT" and id(p) not in b.session.used and p.span is not None:
                b.report("S1406", p.span, name=p.name)


def check_program(session: Session, chosen: frozenset[str]) -> None:
    """Reports inputs of blocks that neither the body nor a method, action or user of the block names."""
    if "S1406" not in chosen:
        return
    for pou in session.analysis.pous:
        source = pou.source
        bare = pou.pou is None or not (pou.pou.body or pou.methods or pou.actions)
        own = source is not None and source.scope is not Scope.LIBRARY
        if pou.kind != "FUNCTION_BLOCK" or bare or not own or pou.interfaces:
            continue
        assert source is not None
        for p in pou.parameters:
            inherited = p.owner is not None and p.owner.upper() != pou.qualified_name.upper()
            if (
                p.section == "VAR_INPUT"
                and id(p) not in session.used
                and p.span is not None
                and not inherited
            ):
                session.report("S1406", source.uri, p.span, name=p.name)


class _Seen:
    """Outputs written, instances called and loops left so far."""

    def __init__(self, b: Body, chosen: frozenset[str]) -> None:
        self.b = b
        self.chosen = chosen
        self.written: dict[int, ast.Expr] = {}
        self.called: dict[int, ast.Expr] = {}
        self.loops: set[int] = set()

    def report(self, code: str, e: ast.Node, other: ast.Node | None = None, **fields: object) -> None:
        if code in self.chosen:
            related = [Related("before here", self.b.uri, other.span)] if other is not None else []
            self.b.report(code, e.span, related, **fields)

    def body(self, body: list[ast.Stmt], depth: int) -> None:
        for s in body:
            if isinstance(s, ast.Assign):
                self._written(s.target)
            elif isinstance(s, ast.CallStmt):
                self._call(s.call, depth)
            for e in own_expressions(s):
                if isinstance(e, ast.Name) and isinstance(e.symbol, VarSymbol):
                    self._name(e, s)
            for part in bodies(s):
                self.body(part, depth + 1)
            if isinstance(s, ast.For) and isinstance(s.variable, ast.Name):
                self.loops.add(id(s.variable.symbol))

    def _name(self, e: ast.Name, s: ast.Stmt) -> None:
        symbol = e.symbol
        assert isinstance(symbol, VarSymbol)
        own = self.b.pou
        if (
            own is not None
            and own.kind == "FUNCTION"
            and symbol.home is Storage.GLOBAL
            and not symbol.is_constant
        ):
            self.report("S1404", e, name=e.name)
        if id(symbol) in self.loops:
            started = isinstance(s, ast.For) and e is s.variable
            assigned = isinstance(s, ast.Assign) and e is s.target
            if started or assigned:
                self.loops.discard(id(symbol))
            else:
                self.report("S1405", e, name=e.name)

    def _written(self, target: ast.Expr) -> None:
        symbol = getattr(target, "symbol", None)
        if isinstance(symbol, VarSymbol) and (symbol.section == "VAR_OUTPUT" or symbol.area == "Q"):
            before = self.written.setdefault(id(symbol), target)
            if before is not target:
                self.report("S1401", target, before, name=symbol.name)

    def _call(self, call: ast.Call, depth: int) -> None:
        target = call.target
        if not isinstance(target, PouSymbol):
            return
        if target.kind == "FUNCTION_BLOCK" and isinstance(call.callee, ast.Name):
            if depth:
                self.report("S1402", call, name=call.callee.name)
            before = self.called.setdefault(id(call.callee.symbol), call)
            if before is not call:
                self.report("S1403", call, before, name=call.callee.name)
        elif target.kind in ("FUNCTION", "METHOD") and target.return_type is not None:
            self.report("S1407", call, name=target.name)

"""A temporary variable gets a value before it is read, and its value is read.

Variables of functions and methods, and VAR_TEMP, begin each call with their initial value: what is read
before the first assignment is always that value. Variables with an initial value of their own, and those
whose first use lies in a loop, are left out.

Source: spec LDEC-24, LDEC-42.

Passes:
    FUNCTION F : INT
    VAR_INPUT x : INT; END_VAR
    VAR n : INT; END_VAR
    n := 2 * x;
    F := n + 1;
    END_FUNCTION
Fails:
    FUNCTION F : INT
    VAR_INPUT x : INT; END_VAR
    VAR n : INT; END_VAR
    F := n + x;                    (* W1134: n has no value yet *)
    n := x;
    F := F + n;
    END_FUNCTION
Fails:
    FUNCTION F : INT
    VAR_INPUT x : INT; END_VAR
    VAR n : INT; END_VAR
    n := 2 * x;                    (* W1135: n is never read *)
    F := x;
    END_FUNCTION
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from tappet.lang import ast
from tappet.lang.diagnostics import Related
from tappet.lang.symbols import VarSymbol
from tappet.lang.types import Elementary, Enum, Pointer, Subrange
from tappet.lang.walk import bodies, expressions, own_expressions, statements

_SIMPLE = (Elementary, Enum, Subrange, Pointer)

if TYPE_CHECKING:
    from tappet.lang.analysis.context import Body

CODES = ("W1134", "W1135")
OWN_CODE_ONLY = True
_SECTIONS = frozenset({"VAR", "VAR_TEMP"})
_LOOPS = (ast.For, ast.While, ast.RepeatUntil)


def check_pou(b: Body) -> None:
    """Reports the first read before any assignment, and variables that are only assigned."""
    pou = b.pou
    if pou is None or pou.pou is None or not pou.pou.body:
        return
    short = pou.kind in ("FUNCTION", "METHOD")
    watched: dict[int, ast.VarDecl] = {}
    for block in pou.pou.blocks:
        if block.section == "VAR_TEMP" or (short and block.section == "VAR"):
            for decl in block.variables:
                symbol = decl.symbol
                if (
                    isinstance(symbol, VarSymbol)
                    and isinstance(symbol.type, _SIMPLE)
                    and not symbol.is_constant
                    and decl.address is None
                    and not decl.attributes
                ):
                    watched[id(symbol)] = decl
    if watched and not any(s.label for s in statements(pou.pou.body)):
        _Uses(watched).report(b, pou.pou.body)


class _Uses:
    """What has been read and assigned so far, in the order of the text."""

    def __init__(self, watched: dict[int, ast.VarDecl]) -> None:
        self.watched = watched
        self.read: dict[int, ast.Name] = {}
        self.early: list[ast.Name] = []
        self.assigned: dict[int, ast.Name] = {}
        self.settled: set[int] = set()

    def report(self, b: Body, body: list[ast.Stmt]) -> None:
        self._body(body, False)
        for name in self.early:
            decl = self.watched[id(name.symbol)]
            b.report("W1134", name.span, [Related("declared here", b.uri, decl.name_span)], name=name.name)
        for key, name in self.assigned.items():
            if key not in self.read:
                b.report("W1135", name.span, name=name.name)

    def _body(self, body: list[ast.Stmt], loop: bool) -> None:
        for s in body:
            if isinstance(s, _LOOPS):
                for e in own_expressions(s):
                    self._settle(e)
                for part in bodies(s):
                    self._body(part, True)
                continue
            if isinstance(s, ast.Assign):
                self._reads(s.value, loop)
                if isinstance(s.target, ast.Name) and s.op == ":=":
                    self._assign(s.target)
                else:
                    self._settle_all(s.target)
            elif isinstance(s, ast.CallStmt):
                self._reads(s.call, loop)
            else:
                for e in own_expressions(s):
                    self._one(e, loop)
            for part in bodies(s):
                self._body(part, loop)

    def _reads(self, e: ast.Expr, loop: bool) -> None:
        for inner in expressions(e):
            self._one(inner, loop)

    def _one(self, e: ast.Expr, loop: bool) -> None:
        if isinstance(e, ast.Call):
            for arg in e.args:
                section = getattr(arg.parameter, "section", "VAR_IN_OUT")
                if arg.value is not None and (section != "VAR_INPUT" or arg.output):
                    self._settle_all(arg.value)  # the callee writes it, or its address is taken
        elif isinstance(e, ast.AssignExpr):
            self._settle_all(e.target)
        elif isinstance(e, ast.Name):
            key = id(e.symbol)
            decl = self.watched.get(key)
            if decl is None:
                return
            known = key in self.read or key in self.settled or key in self.assigned
            if not known and not loop and decl.init is None:
                self.early.append(e)
            self.read.setdefault(key, e)

    def _assign(self, target: ast.Name) -> None:
        key = id(target.symbol)
        if key in self.watched:
            self.assigned.setdefault(key, target)

    def _settle_all(self, e: ast.Expr) -> None:
        for inner in expressions(e):
            self._settle(inner)

    def _settle(self, e: ast.Expr) -> None:
        if isinstance(e, ast.Name) and id(e.symbol) in self.watched:
            self.settled.add(id(e.symbol))
            self.read.setdefault(id(e.symbol), e)

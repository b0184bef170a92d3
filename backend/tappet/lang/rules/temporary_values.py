"""A temporary variable gets a value before it is read, and its value is read.

Variables of functions and methods, and VAR_TEMP, begin each call with their initial value: what is read
where no way has assigned it is always that value. Variables with an initial value of their own are left out,
and constants that are assigned to begin with. Branches, loops, RETURN, EXIT and CONTINUE are followed.

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
Passes:
    FUNCTION F : INT
    VAR_INPUT x : INT; END_VAR
    VAR n, i, last : INT; END_VAR
    n := 0;
    FOR i := 1 TO x DO
        IF i > 3 THEN n := n + last; END_IF   (* assigned in the turn before *)
        last := i;
        IF last = 7 THEN EXIT; END_IF
    END_FOR
    IF n > 3 THEN n := 3; END_IF
    F := n;
    END_FUNCTION
Fails:
    FUNCTION F : INT
    VAR_INPUT x : INT; END_VAR
    VAR n : INT; END_VAR
    IF x > 3 THEN
        n := x;
        F := n;
        RETURN;
    END_IF
    F := n + x;                    (* W1134: the way that assigns n has returned *)
    END_FUNCTION
Fails:
    FUNCTION F : INT
    VAR_INPUT x : INT; END_VAR
    VAR n : INT; END_VAR
    n := x * 2;
    F := n;
    IF x > 3 THEN
        n := x + 1;                (* W1135: nothing reads it on this way *)
        RETURN;
    END_IF
    F := F + n;
    END_FUNCTION
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from tappet.lang import ast
from tappet.lang.dataflow.flow import Liveness, Reaching
from tappet.lang.diagnostics import Related
from tappet.lang.symbols import VarSymbol
from tappet.lang.types import Elementary, Enum, Pointer, Subrange
from tappet.lang.walk import statements

_SIMPLE = (Elementary, Enum, Subrange, Pointer)

if TYPE_CHECKING:
    from tappet.lang.analysis.context import Body

CODES = ("W1134", "W1135")
OWN_CODE_ONLY = True


def check_pou(b: Body) -> None:
    """Reports reads that no assignment reaches, and assignments that nothing reads."""
    watched = temporaries(b)
    if not watched:
        return
    assert b.pou is not None
    assert b.pou.pou is not None
    body = b.pou.pou.body
    if any(s.label for s in statements(body)):
        return
    reaching = Reaching(key for key, decl in watched.items() if decl.init is None)
    reaching.run(body)
    for key, name in reaching.never.items():
        related = [Related("declared here", b.uri, watched[key].name_span)]
        b.report("W1134", name.span, related, name=name.name)
    liveness = Liveness(watched, body)
    reported: set[int] = set()
    for target in reversed(liveness.dead):
        key = id(target.symbol)
        unused = key not in liveness.read
        if (unused and key not in reported) or (not unused and not _begins(body, target)):
            b.report("W1135", target.span, name=target.name)
        reported.add(key)


def temporaries(b: Body) -> dict[int, ast.VarDecl]:
    """The simple variables of a body that begin each call uninitialised, by id() of their symbol."""
    pou = b.pou
    watched: dict[int, ast.VarDecl] = {}
    if pou is None or pou.pou is None or not pou.pou.body:
        return watched
    short = pou.kind in ("FUNCTION", "METHOD")
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
    return watched


def _begins(body: list[ast.Stmt], target: ast.Name) -> bool:
    """Whether an assignment gives a constant to begin with: harmless, and many write it for safety."""
    return any(
        isinstance(s, ast.Assign) and s.target is target and s.value.is_constant for s in statements(body)
    )

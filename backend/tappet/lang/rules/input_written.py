"""An input is written by the caller, not by the block itself.

The value is lost at the next call that passes the input, and stays when the call leaves it out.

Source: coding guidelines of PLCopen, CP12; spec LDEC-20.

Passes:
    FUNCTION_BLOCK FB
    VAR_INPUT nSpeed : INT; END_VAR
    VAR nLimited : INT; END_VAR
    nLimited := MIN(nSpeed, 100);
    END_FUNCTION_BLOCK
Fails:
    FUNCTION_BLOCK FB
    VAR_INPUT nSpeed : INT; END_VAR
    nSpeed := MIN(nSpeed, 100);    (* W1128: nSpeed is an input *)
    END_FUNCTION_BLOCK
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from tappet.lang import ast
from tappet.lang.symbols import VarSymbol
from tappet.lang.types import Reference
from tappet.lang.walk import root, statements

if TYPE_CHECKING:
    from tappet.lang.analysis.context import Body

CODES = ("W1128",)
OWN_CODE_ONLY = True


def check_pou(b: Body) -> None:
    """Reports assignments to own inputs of function blocks; a parameter of a function is a copy."""
    pou = b.pou
    if pou is None or pou.pou is None or pou.kind not in ("FUNCTION_BLOCK", "PROGRAM"):
        return
    written = b.session.written
    names = {id(p) for p in pou.parameters if p.section == "VAR_INPUT" and id(p) in written}
    if not names:
        return
    for s in statements(pou.pou.body):
        if s.__class__ is ast.Assign:
            assert isinstance(s, ast.Assign)
            target = root(s.target)
            if isinstance(target, ast.Name) and id(target.symbol) in names and _own(target.symbol):
                b.report("W1128", s.target.span, name=target.name)


def _own(symbol: object) -> bool:
    """Whether what is written is the input itself, not what it refers to."""
    return isinstance(symbol, VarSymbol) and not isinstance(symbol.type, Reference)

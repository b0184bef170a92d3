"""A local variable is used.

Inputs, outputs, and variables at an address belong to the interface of the POU or the machine and are left
out; so are RETAIN and PERSISTENT variables, which may be there for the values that are stored under them.

Source: spec LDEC-20.

Passes:
    VAR a : INT; END_VAR
    VAR RETAIN kept : INT; END_VAR
    a := 1;
Fails:
    VAR a, b : INT; END_VAR        (* W1103: b is never used *)
    a := 1;
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from tappet.lang.symbols import PouSymbol
from tappet.lang.types import FunctionBlock

if TYPE_CHECKING:
    from tappet.lang.analysis.context import Session

CODES = ("W1103",)
_REMANENT = {"RETAIN", "PERSISTENT"}


def check_variables(session: Session, pou: PouSymbol) -> None:
    """Reports VAR and VAR_TEMP variables that no code names, those of methods as well."""
    for part in (pou, *pou.methods.values()):
        if part.pou is not None and part.pou.body:
            _check(session, part)


def _check(session: Session, pou: PouSymbol) -> None:
    assert pou.pou is not None
    assert pou.source is not None
    used = session.used
    for block in pou.pou.blocks:
        if block.section not in ("VAR", "VAR_TEMP", "VAR_STAT"):
            continue
        if block.flags & _REMANENT and pou.kind not in ("FUNCTION", "METHOD"):
            continue  # declared for what lies in the memory, such as values of an earlier version
        for decl in block.variables:
            symbol = decl.symbol
            if (
                symbol is not None
                and id(symbol) not in used
                and decl.address is None
                and not decl.attributes
                and not isinstance(getattr(symbol, "type", None), FunctionBlock)
            ):
                session.report("W1103", pou.source.uri, decl.name_span, name=decl.name)

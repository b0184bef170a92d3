"""PERSISTENT belongs into the list of persistent variables; in programs and blocks it is kept all the same.

CODESYS keeps such a variable only when the list holds its path, TwinCAT keeps it as it is. Here it is kept
under its path, with a line in the list or without; a line has to name such a variable.

Source: spec LDEC-72; CODESYS C0569.

Passes:
    PROGRAM PLC_PRG
    VAR RETAIN nPieces : UDINT; END_VAR
    nPieces := nPieces + 1;
    END_PROGRAM
Fails:
    PROGRAM PLC_PRG
    VAR PERSISTENT nHours : UDINT; END_VAR   (* W1224: not in the persistent variable list *)
    nHours := nHours + 1;
    END_PROGRAM
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from tappet.lang import ast
from tappet.lang.parts import innermost
from tappet.lang.source import Scope
from tappet.lang.symbols import GvlSymbol, PouSymbol, VarSymbol
from tappet.lang.types import FunctionBlock, Struct, Type

if TYPE_CHECKING:
    from tappet.lang.analysis.context import Session

CODES = ("W1224", "E0448")
_KEPT = frozenset({"VAR", "VAR_INPUT", "VAR_OUTPUT"})


def check_program(session: Session) -> None:
    """Checks the paths of the lists, and the persistent variables of POUs against them."""
    persistent = {id(d) for p in session.analysis.pous for b in _persistent_blocks(p) for d in b.variables}
    listed: set[int] = set()
    for gvl in session.analysis.gvls:
        for decl in _paths(gvl):
            variable = _variable_at(session, decl.name)
            if variable is not None and id(variable) in persistent:
                listed.add(id(variable))
            elif gvl.source is not None:
                session.report("E0448", gvl.source.uri, decl.name_span, path=decl.name)
    for pou in session.analysis.pous:
        if pou.source is None or pou.source.scope is Scope.LIBRARY:
            continue
        for part in pou.with_children():
            _check_part(session, part, listed)


def _paths(gvl: GvlSymbol) -> Iterator[ast.VarDecl]:
    for block in gvl.decl.blocks if gvl.decl is not None else ():
        yield from (decl for decl in block.variables if "." in decl.name)


def _persistent_blocks(pou: PouSymbol) -> Iterator[ast.VarBlock]:
    stored = pou.kind in ("PROGRAM", "FUNCTION_BLOCK")
    for block in pou.pou.blocks if pou.pou is not None else ():
        kept = block.section in ("VAR_STAT", "VAR_INST") or (stored and block.section in _KEPT)
        if kept and "PERSISTENT" in block.flags:
            yield block


def _check_part(session: Session, pou: PouSymbol, listed: set[int]) -> None:
    for block in _persistent_blocks(pou):
        for decl in block.variables:
            if id(decl) not in listed and isinstance(decl.symbol, VarSymbol) and pou.source is not None:
                session.report("W1224", pou.source.uri, decl.name_span, name=decl.name)


def _variable_at(session: Session, path: str) -> ast.VarDecl | None:
    """The declaration of the variable at the end of an instance path."""
    first, *rest = [part.partition("[")[0].upper() for part in path.split(".")]
    program = session.analysis.programs.get(first)
    list_ = next((g for g in session.analysis.gvls if g.name.upper() == first), None)
    type_: Type | None = None
    decl: ast.VarDecl | None = None
    if program is not None:
        type_ = program.instance
    elif list_ is not None and rest:
        variable = list_.members.get(rest.pop(0))
        type_, decl = (variable.type, variable.decl) if variable is not None else (None, None)
    for part in rest:
        inner = None if type_ is None else innermost(type_)
        member = inner.members.get(part) if isinstance(inner, (FunctionBlock, Struct)) else None
        type_, decl = (member.type, member.decl) if member is not None else (None, None)
    return decl

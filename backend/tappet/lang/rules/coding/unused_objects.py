"""What is declared is used: objects, methods, types, enumeration values, global variables.

Source: coding guidelines of PLCopen, CP2 (all code shall be used).

Passes:
    @static
    FUNCTION_BLOCK FB_Used
    VAR n1 : INT; END_VAR
    n1 := n1 + 1;
    END_FUNCTION_BLOCK
    PROGRAM Main
    VAR fbUsed : FB_Used; END_VAR
    fbUsed();
    END_PROGRAM
Fails:
    @static
    FUNCTION F_Unused : INT        (* S1408: never called *)
    F_Unused := 1;
    END_FUNCTION
Fails:
    @static
    @source GVL_Data
    VAR_GLOBAL nUnused : INT; END_VAR   (* S1409: never used *)
    @source Main
    PROGRAM Main
    VAR n1 : INT; END_VAR
    n1 := 1;
    END_PROGRAM
Fails:
    @static
    FUNCTION_BLOCK FB_Used
    VAR n1 : INT; END_VAR
    n1 := n1 + 1;
    END_FUNCTION_BLOCK
    FUNCTION_BLOCK FB_Unused       (* S1410: no instance *)
    VAR n1 : INT; END_VAR
    n1 := n1 + 1;
    END_FUNCTION_BLOCK
    PROGRAM Main
    VAR fbUsed : FB_Used; END_VAR
    fbUsed();
    END_PROGRAM
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from tappet.lang.source import Scope
from tappet.lang.types import Array, Pointer, Reference, Struct

if TYPE_CHECKING:
    from tappet.lang.analysis.context import Session

CODES = ("S1408", "S1409", "S1410")


def check_program(session: Session, chosen: frozenset[str]) -> None:
    """Reports functions, blocks and global variables of the project that nothing uses."""
    instances = _instances(session)
    for pou in session.analysis.pous:
        source = pou.source
        if source is None or source.scope is Scope.LIBRARY or pou.span is None or id(pou) in session.called:
            continue
        if pou.kind == "FUNCTION" and "S1408" in chosen:
            session.report("S1408", source.uri, pou.span, name=pou.name)
        elif pou.kind == "FUNCTION_BLOCK" and "S1410" in chosen and id(pou.instance) not in instances:
            session.report("S1410", source.uri, pou.span, name=pou.name)
    if "S1409" not in chosen:
        return
    for gvl in session.analysis.gvls:
        if gvl.source is None or gvl.source.scope is Scope.LIBRARY or gvl.decl is None:
            continue
        for variable in gvl.members.values():
            if id(variable) not in session.used and variable.span is not None:
                session.report("S1409", gvl.source.uri, variable.span, name=variable.name, owner=gvl.name)


def _instances(session: Session) -> set[int]:
    """id() of the types of all variables, and of the bases of blocks."""
    found: set[int] = set()
    variables = [v for gvl in session.analysis.gvls for v in gvl.members.values()]
    for pou in session.analysis.pous:
        variables += [v for v in pou.locals.values() if v.decl is not None]
        if pou.base is not None:
            found.add(id(pou.base.instance))
        for method in pou.methods.values():
            variables += method.locals.values()
    for type_ in session.analysis.types.values():
        if isinstance(type_, Struct):
            found.update(id(_inner(member.type)) for member in type_.members.values())
    found.update(id(_inner(v.type)) for v in variables)
    return found


def _inner(type_: object) -> object:
    while isinstance(type_, (Array, Pointer, Reference)):
        type_ = type_.element if isinstance(type_, Array) else type_.base
    return type_

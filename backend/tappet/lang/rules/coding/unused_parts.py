"""Types, values of enumerations and methods are used.

Source: coding guidelines of PLCopen, CP2 (all code shall be used); CODESYS Static Analysis SA0031, SA0032.

Passes:
    @static
    TYPE E_Mode : (eOff, eOn); END_TYPE
    TYPE ST_Part : STRUCT nA, nB : INT; END_STRUCT END_TYPE
    FUNCTION_BLOCK FB_Motor
    VAR eMode : E_Mode := E_Mode.eOff; aPart : ARRAY[1..2] OF ST_Part; END_VAR
    METHOD Start
    eMode := E_Mode.eOn;
    aPart[1].nA := 1;
    END_METHOD
    END_FUNCTION_BLOCK
    PROGRAM Main
    VAR fbMotor : FB_Motor; END_VAR
    fbMotor.Start();
    END_PROGRAM
Fails:
    @static
    TYPE E_Mode : (eOff, eOn, eLost); END_TYPE   (* S1411: eLost is never used *)
    PROGRAM Main
    VAR eMode : E_Mode := E_Mode.eOff; END_VAR
    IF eMode = E_Mode.eOn THEN eMode := E_Mode.eOff; END_IF
    END_PROGRAM
Fails:
    @static
    TYPE ST_Old : STRUCT nA : INT; END_STRUCT END_TYPE   (* S1412: no variable has this type *)
    PROGRAM Main
    VAR nA : INT; END_VAR
    nA := 1;
    END_PROGRAM
Fails:
    @static
    FUNCTION_BLOCK FB_Motor
    VAR nA : INT; END_VAR
    METHOD Forgotten               (* S1413: never called *)
    nA := 1;
    END_METHOD
    END_FUNCTION_BLOCK
    PROGRAM Main
    VAR fbMotor : FB_Motor; END_VAR
    fbMotor();
    END_PROGRAM
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

from tappet.lang import ast
from tappet.lang.named_symbols import Named, is_own, named_in, with_parts
from tappet.lang.types import Array, Enum, Pointer, Reference, Struct
from tappet.lang.walk import expressions

if TYPE_CHECKING:
    from tappet.lang.analysis.context import Session

CODES = ("S1411", "S1412", "S1413")
_CALLED_BY_THE_SYSTEM = frozenset({"FB_INIT", "FB_EXIT", "FB_REINIT"})


def check_program(session: Session, chosen: frozenset[str]) -> None:
    """Reports what the project declares and nothing names."""
    if "S1413" in chosen:
        _methods(session)
    if not chosen.intersection(("S1411", "S1412")):
        return
    used = _Used(session)
    for scope_symbol in session.analysis.types.values():
        decl = scope_symbol.decl if isinstance(scope_symbol, (Enum, Struct)) else None
        source = decl.source if decl is not None else None
        if decl is None or not is_own(source):
            continue
        assert source is not None
        if "S1412" in chosen and id(scope_symbol) not in used.types:
            session.report("S1412", source.uri, decl.name_span, name=decl.name)
        elif "S1411" in chosen and isinstance(decl.type_ref, ast.EnumType):
            for entry in decl.type_ref.values:
                if (id(scope_symbol), entry.name.upper()) not in used.values:
                    session.report("S1411", source.uri, entry.span, name=entry.name, type=decl.name)


def _methods(session: Session) -> None:
    """A method counts as used when code calls one of its name: a base or interface may lead to it."""
    called = {
        target.name.upper()
        for calls in session.calls.values()
        for target, _, _ in calls
        if target.kind == "METHOD"
    }
    for pou in session.analysis.pous:
        if not is_own(pou.source):
            continue
        for method in pou.methods.values():
            node, source = method.pou, method.source
            if node is None or source is None or node.attributes or method.name.startswith("__"):
                continue
            key = method.name.upper()
            if key not in called and key not in _CALLED_BY_THE_SYSTEM:
                session.report("S1413", source.uri, node.name_span, name=method.name, owner=pou.name)


class _Used:
    """Types that variables have, and values of enumerations that code names."""

    def __init__(self, session: Session) -> None:
        self.types: set[int] = set()
        self.values: set[tuple[int, str]] = set()
        for pou in with_parts(session):
            if pou.return_type is not None:
                self.type(pou.return_type)
            for variable in pou.locals.values():
                self.type(variable.type)
            if pou.pou is not None:
                self.named(named_in(session, pou))
                for block in pou.pou.blocks:
                    self.names(expressions(*(decl.initial for decl in block.variables)))
        for gvl in session.analysis.gvls:
            for variable in gvl.members.values():
                self.type(variable.type)
                if variable.decl is not None:
                    self.names(expressions(variable.decl.initial))
        for interface in session.analysis.interfaces.values():
            for method in interface.methods.values():
                self.type(method.return_type)
                for parameter in method.parameters:
                    self.type(parameter.type)

    def type(self, type_: object) -> None:
        """Notes a type and those inside it."""
        todo = [type_]
        while todo:
            found = todo.pop()
            if id(found) in self.types or found is None:
                continue
            self.types.add(id(found))
            if isinstance(found, Array):
                todo.append(found.element)
            elif isinstance(found, (Pointer, Reference)):
                todo.append(found.base)
            elif isinstance(found, Struct):
                todo += [found.base, *(m.type for m in found.members.values())]
                for member in found.members.values():
                    if member.decl is not None:
                        self.names(expressions(member.decl.initial))

    def names(self, found: Iterable[ast.Expr]) -> None:
        """Notes what expressions name."""
        named = Named()
        named.read(found)
        self.named(named)

    def named(self, named: Named) -> None:
        """Notes values of enumerations, and types that code names."""
        self.values |= named.values
        for type_ in named.types:
            self.type(type_)

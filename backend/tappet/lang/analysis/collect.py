"""First pass: a symbol for every object, variable and enumeration value. Nothing is resolved yet."""

from __future__ import annotations

from collections.abc import Sequence

from tappet.lang import ast
from tappet.lang import types as t
from tappet.lang.analysis.collect_members import (
    attach,
    collect_child,
    collect_head,
    collect_property,
    collect_property_head,
    declared_pou,
)
from tappet.lang.analysis.collect_variables import (
    add_variable,
    check_name,
    collect_enum_values,
    collect_local_enum,
    collect_variables,
)
from tappet.lang.analysis.collected import Collected
from tappet.lang.analysis.context import Session
from tappet.lang.analysis.same_names import first_place
from tappet.lang.analysis.scope import Level, describe
from tappet.lang.any_type import ANY_TYPES, TYPE_CLASS_SYMBOL
from tappet.lang.attributes import attribute
from tappet.lang.exceptions import EXCEPTION_CODE_SYMBOL
from tappet.lang.source import Source, Span
from tappet.lang.symbols import (
    GvlSymbol,
    InterfaceSymbol,
    NamespaceSymbol,
    Storage,
    Symbol,
    TypeSymbol,
    VarSymbol,
)
from tappet.lang.system_structures import TWINCAT_TYPES
from tappet.lang.variable_info import MEMORY_AREA_SYMBOL, VAR_INFO_SYMBOL

_OWNED = frozenset({"METHOD", "ACTION", "TRANSITION"})


def collect(session: Session, units: Sequence[ast.Unit]) -> Collected:
    """Makes the symbols of all units."""
    found = Collected()
    children: list[tuple[ast.Pou | ast.Property, Source]] = []
    if not session.levels.system:
        _add_system_interface(session)
    for unit in units:
        level = session.levels.of(unit.source)
        for declaration in unit.declarations:
            source = declaration.source or unit.source
            if isinstance(declaration, ast.Pou):
                if declaration.kind in _OWNED:
                    children.append((declaration, source))
                else:
                    _pou(session, found, declaration, source, level)
            elif isinstance(declaration, ast.TypeDecl):
                _type(session, found, declaration, source, level)
            elif isinstance(declaration, ast.GlobalList):
                _gvl(session, found, declaration, source, level)
            elif isinstance(declaration, ast.Interface):
                _interface(session, found, declaration, source, level)
            elif isinstance(declaration, ast.Property):
                children.append((declaration, source))
    for child, source in children:
        attach(session, found, child, source)
    return found


def _add_system_interface(session: Session) -> None:
    query = InterfaceSymbol("IQueryInterface")
    query.type = t.Interface("IQueryInterface", pou=ast.Interface(name="IQueryInterface", symbol=query))
    members: dict[str, Symbol] = {
        "IQUERYINTERFACE": query,
        "TYPE_CLASS": TYPE_CLASS_SYMBOL,
        "EXCEPTIONCODE": EXCEPTION_CODE_SYMBOL,
    }
    members["VAR_INFO"] = VAR_INFO_SYMBOL
    members["MEMORY_AREA"] = MEMORY_AREA_SYMBOL
    members["ANYTYPE"] = TypeSymbol("AnyType", type=ANY_TYPES["ANY"])
    session.levels.system.update(TWINCAT_TYPES)
    session.levels.system["__SYSTEM"] = NamespaceSymbol("__System", members=members)


def _declare(session: Session, level: Level, symbol: Symbol, declaration: ast.Declaration) -> None:
    key = symbol.name.upper()
    if not key:
        return
    source = symbol.source
    assert source is not None
    check_name(session, symbol.name, source, declaration.name_span, describe(symbol))
    old = level.objects.get(key)
    if old is None:
        level.objects[key] = symbol
        return
    places = ", ".join(s.source.uri for s in (old, symbol) if s.source is not None)
    session.report(
        "E0420", source.uri, declaration.name_span, first_place(old), name=symbol.name, places=places
    )


def _pou(session: Session, found: Collected, pou: ast.Pou, source: Source, level: Level) -> None:
    symbol = declared_pou(session, pou, source)
    if pou.kind in ("PROGRAM", "FUNCTION_BLOCK"):
        instance = t.FunctionBlock(pou.name, program=pou.kind == "PROGRAM", pou=pou)
        symbol.instance = session.stand_for(instance, source.uri)
    _declare(session, level, symbol, pou)
    found.pous.append((symbol, level))
    found.own[id(symbol)] = collect_variables(session, found, symbol, pou.blocks, source)
    for method in pou.methods:
        collect_child(session, found, symbol, method, source)
    for action in pou.actions:
        collect_child(session, found, symbol, action, source)
    for property_ in pou.properties:
        collect_property(session, found, symbol, property_, source)


def _named(declaration: ast.Declaration, source: Source) -> tuple[str, Source, Span, str, str]:
    """What every symbol says of its declaration."""
    return declaration.name, source, declaration.name_span, declaration.comment, declaration.access


def _interface(
    session: Session, found: Collected, declaration: ast.Interface, source: Source, level: Level
) -> None:
    symbol = session.stand_for(InterfaceSymbol(*_named(declaration, source)), source.uri)
    symbol.type = session.stand_for(t.Interface(declaration.name, pou=declaration), source.uri)
    declaration.symbol = symbol
    _declare(session, level, symbol, declaration)
    found.interfaces.append((symbol, declaration, source))
    for method in declaration.methods:
        collect_head(session, found, symbol, method, source)
    for property_ in declaration.properties:
        collect_property_head(session, found, symbol, property_, source)


def _type(
    session: Session, found: Collected, declaration: ast.TypeDecl, source: Source, level: Level
) -> None:
    symbol = session.stand_for(TypeSymbol(*_named(declaration, source)), source.uri)
    _declare(session, level, symbol, declaration)
    found.types.append((symbol, declaration, source))
    declaration.type = None
    if isinstance(declaration.type_ref, ast.EnumType):
        qualified = attribute(declaration.attributes, "qualified_only") is not None
        collect_enum_values(session, found, declaration.type_ref, declaration.name, qualified, source)
    elif isinstance(declaration.type_ref, ast.StructType):
        for member in declaration.type_ref.members:
            collect_local_enum(session, found, member.type_ref, f"{declaration.name}_{member.name}", source)


def _gvl(
    session: Session, found: Collected, declaration: ast.GlobalList, source: Source, level: Level
) -> None:
    symbol = GvlSymbol(declaration.name, source, declaration.name_span, declaration.comment, decl=declaration)
    symbol = session.stand_for(symbol, source.uri)
    blocks = [block for block in declaration.blocks if block.section != "VAR_CONFIG"]
    for block in declaration.blocks:
        if block.section == "VAR_CONFIG":
            found.configured += [(decl, source) for decl in block.variables]
    pragmas = [*declaration.attributes, *(p for block in blocks for p in block.attributes)]
    symbol.qualified_only = attribute(pragmas, "qualified_only") is not None
    if not blocks and declaration.blocks:
        return
    _declare(session, level, symbol, declaration)
    level.gvls.append(symbol)
    found.gvls.append((symbol, source))
    for block in blocks:
        flags = frozenset(block.flags)
        for decl in block.variables:
            if "." in decl.name:  # the path of a persistent variable of an instance: no variable of the list
                continue
            variable = VarSymbol(
                decl.name,
                source,
                decl.name_span,
                decl.comment,
                storage=Storage.GLOBAL,
                home=Storage.GLOBAL,
                section="VAR_GLOBAL",
                flags=flags,
                owner=symbol.name,
                decl=decl,
            )
            variable = session.stand_for(variable, source.uri, symbol.name)
            decl.symbol = variable
            add_variable(session, symbol.members, variable, source)
            collect_local_enum(session, found, decl.type_ref, f"{symbol.name}_{decl.name}", source)

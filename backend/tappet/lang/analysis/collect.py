"""First pass: a symbol for every object, variable and enumeration value. Nothing is resolved yet."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field

from tappet.lang import ast
from tappet.lang import types as t
from tappet.lang.analysis.context import Session
from tappet.lang.analysis.monitored import keeping_variable
from tappet.lang.analysis.scope import Level, describe
from tappet.lang.analysis.type_conversions import is_conversion
from tappet.lang.any_type import ANY_TYPES, TYPE_CLASS_SYMBOL
from tappet.lang.attributes import attribute
from tappet.lang.diagnostics import Related
from tappet.lang.source import Scope, Source, Span
from tappet.lang.symbols import (
    EnumValueSymbol,
    GvlSymbol,
    InterfaceSymbol,
    NamespaceSymbol,
    PouSymbol,
    PropertySymbol,
    Storage,
    Symbol,
    TypeSymbol,
    VarSymbol,
)

_OWNED = frozenset({"METHOD", "ACTION", "TRANSITION"})


@dataclass(slots=True)
class OwnVariables:
    """Variables a POU declares itself, by upper-case name, in order."""

    variables: dict[str, VarSymbol] = field(default_factory=dict)
    statics: list[VarSymbol] = field(default_factory=list)
    externals: list[VarSymbol] = field(default_factory=list)


@dataclass(slots=True)
class Collected:
    """What the sources declare, in their order."""

    pous: list[tuple[PouSymbol, Level]] = field(default_factory=list)
    """Programs, functions, function blocks."""
    types: list[tuple[TypeSymbol, ast.TypeDecl, Source]] = field(default_factory=list)
    gvls: list[tuple[GvlSymbol, Source]] = field(default_factory=list)
    interfaces: list[tuple[InterfaceSymbol, ast.Interface, Source]] = field(default_factory=list)
    configured: list[tuple[ast.VarDecl, Source]] = field(default_factory=list)
    own: dict[int, OwnVariables] = field(default_factory=dict)
    """By id() of the POU."""
    enum_values: dict[int, list[EnumValueSymbol]] = field(default_factory=dict)
    """By id() of the EnumType."""
    local_enums: list[tuple[ast.EnumType, Source, str]] = field(default_factory=list)
    """Enumerations written in a variable declaration, with a name made for them."""
    enum_of_value: dict[int, ast.EnumType] = field(default_factory=dict)


def collect(session: Session, units: Sequence[ast.Unit]) -> Collected:
    """Makes the symbols of all units."""
    found = Collected()
    children: list[tuple[ast.Pou | ast.Property, Source]] = []
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
        _attach(session, found, child, source)
    return found


def _add_system_interface(session: Session) -> None:
    query = InterfaceSymbol("IQueryInterface")
    query.type = t.Interface("IQueryInterface", pou=ast.Interface(name="IQueryInterface", symbol=query))
    members: dict[str, Symbol] = {"IQUERYINTERFACE": query, "TYPE_CLASS": TYPE_CLASS_SYMBOL}
    members["ANYTYPE"] = TypeSymbol("AnyType", type=ANY_TYPES["ANY"])
    session.levels.system["__SYSTEM"] = NamespaceSymbol("__System", members=members)


def check_name(session: Session, name: str, source: Source, span: Span, what: str = "") -> None:
    """Names of the user's own hold no two underscores in a row; what is named without an owner is not called
    like a conversion, which could not be used any more (LDEC-07, LDEC-10)."""
    if "__" in name and not session.options.system:
        session.report("E0206", source.uri, span, name=name)
    if what and source.scope is not Scope.LIBRARY and is_conversion(name.upper()):
        session.report("E0105", source.uri, span, name=name, what=what)


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
    related = (Related("first declared here", old.source.uri, old.span),) if old.source and old.span else ()
    session.report("E0420", source.uri, declaration.name_span, related, name=symbol.name, places=places)


def _pou(session: Session, found: Collected, pou: ast.Pou, source: Source, level: Level) -> None:
    symbol = PouSymbol(
        pou.name, source, pou.name_span, pou.comment, pou=pou, kind=pou.kind, qualified_name=pou.name
    )
    pou.symbol = symbol
    if pou.kind in ("PROGRAM", "FUNCTION_BLOCK"):
        symbol.instance = t.FunctionBlock(pou.name, program=pou.kind == "PROGRAM", pou=pou)
    _declare(session, level, symbol, pou)
    found.pous.append((symbol, level))
    found.own[id(symbol)] = _variables(session, found, symbol, pou.blocks, source)
    for method in pou.methods:
        _child(session, found, symbol, method, source)
    for action in pou.actions:
        _child(session, found, symbol, action, source)
    for property_ in pou.properties:
        _property(session, found, symbol, property_, source)


def _attach(session: Session, found: Collected, child: ast.Pou | ast.Property, source: Source) -> None:
    """Connects a method, action or property that has a text of its own with its owner."""
    what = child.kind.capitalize() if isinstance(child, ast.Pou) else "Property"
    owner = session.levels.of(source).objects.get(source.owner.upper()) if source.owner else None
    if isinstance(owner, PouSymbol) and owner.instance is not None:
        if isinstance(child, ast.Pou):
            _child(session, found, owner, child, source)
        else:
            _property(session, found, owner, child, source)
    elif isinstance(owner, InterfaceSymbol):
        if isinstance(child, ast.Pou):
            _head(session, found, owner, child, source)
        else:
            _property_head(session, found, owner, child, source)
    else:
        session.report("E0429", source.uri, child.name_span, what=f"{what} '{child.name}'")


def _child(session: Session, found: Collected, owner: PouSymbol, pou: ast.Pou, source: Source) -> None:
    symbol = PouSymbol(
        pou.name,
        source,
        pou.name_span,
        pou.comment,
        pou=pou,
        kind=pou.kind,
        qualified_name=f"{owner.qualified_name}.{pou.name}",
        instance=owner.instance,
        owner=owner,
    )
    pou.symbol = symbol
    check_name(session, pou.name, source, pou.name_span)
    table = owner.methods if pou.kind == "METHOD" else owner.actions
    key = pou.name.upper()
    if key in owner.methods or key in owner.actions or key in owner.properties:
        session.report("E0205", source.uri, pou.name_span, what=pou.kind.lower(), name=pou.name)
        return
    table[key] = symbol
    found.own[id(symbol)] = _variables(session, found, symbol, pou.blocks, source)


def _property(
    session: Session, found: Collected, owner: PouSymbol, property_: ast.Property, source: Source
) -> None:
    key = property_.name.upper()
    if key in owner.methods or key in owner.actions or key in owner.properties:
        session.report("E0205", source.uri, property_.name_span, what="property", name=property_.name)
        return
    symbol = PropertySymbol(property_.name, source, property_.name_span, property_.comment)
    check_name(session, property_.name, source, property_.name_span)
    owner.properties[key] = symbol
    kept = keeping_variable(owner, property_, source)
    if kept is not None:
        found.own[id(owner)].variables[kept.name.upper()] = kept
    for accessor, prefix in ((property_.getter, "__get"), (property_.setter, "__set")):
        if accessor is None:
            continue
        pou = accessor_pou(property_, accessor, prefix, owner.pou, source)
        head = PouSymbol(
            pou.name,
            source,
            property_.name_span,
            pou=pou,
            kind="METHOD",
            qualified_name=f"{owner.qualified_name}.{pou.name}",
            instance=owner.instance,
            owner=owner,
        )
        pou.symbol = head
        found.own[id(head)] = _variables(session, found, head, accessor.blocks, source)
        _add_accessor_value(found.own[id(head)], property_, prefix, source)
        if prefix == "__get":
            symbol.getter = head
        else:
            symbol.setter = head


def accessor_pou(
    property_: ast.Property, accessor: ast.Accessor, prefix: str, owner: ast.Pou | None, source: Source
) -> ast.Pou:
    """The accessor of a property as the method `__getX` or `__setX`."""
    return ast.Pou(
        span=accessor.span,
        name=f"{prefix}{property_.name}",
        name_span=property_.name_span,
        source=source,
        kind="METHOD",
        return_type=property_.type_ref if prefix == "__get" else None,
        blocks=accessor.blocks,
        body=accessor.body,
        access=property_.access,
        modifiers=property_.modifiers,
        attributes=property_.attributes,
        owner=owner,
    )


def _add_accessor_value(own: OwnVariables, property_: ast.Property, prefix: str, source: Source) -> None:
    """The property's name inside its setter is the value that is set."""
    if prefix != "__set" or property_.type_ref is None:
        return
    decl = ast.VarDecl(
        name=property_.name,
        name_span=property_.name_span,
        span=property_.name_span,
        type_ref=property_.type_ref,
    )
    symbol = VarSymbol(
        property_.name,
        source,
        property_.name_span,
        storage=Storage.PARAMETER,
        home=Storage.PARAMETER,
        section="VAR_INPUT",
        decl=decl,
    )
    decl.symbol = symbol
    own.variables[property_.name.upper()] = symbol


def _interface(
    session: Session, found: Collected, declaration: ast.Interface, source: Source, level: Level
) -> None:
    symbol = InterfaceSymbol(declaration.name, source, declaration.name_span, declaration.comment)
    symbol.type = t.Interface(declaration.name, pou=declaration)
    declaration.symbol = symbol
    _declare(session, level, symbol, declaration)
    found.interfaces.append((symbol, declaration, source))
    for method in declaration.methods:
        _head(session, found, symbol, method, source)
    for property_ in declaration.properties:
        _property_head(session, found, symbol, property_, source)


def _head(session: Session, found: Collected, owner: InterfaceSymbol, pou: ast.Pou, source: Source) -> None:
    symbol = PouSymbol(
        pou.name,
        source,
        pou.name_span,
        pou.comment,
        pou=pou,
        kind="METHOD",
        qualified_name=f"{owner.name}.{pou.name}",
    )
    pou.symbol = symbol
    key = pou.name.upper()
    if key in owner.methods:
        session.report("E0205", source.uri, pou.name_span, what="method", name=pou.name)
        return
    owner.methods[key] = symbol
    found.own[id(symbol)] = _variables(session, found, symbol, pou.blocks, source)


def _property_head(
    session: Session, found: Collected, owner: InterfaceSymbol, property_: ast.Property, source: Source
) -> None:
    symbol = PropertySymbol(property_.name, source, property_.name_span, property_.comment)
    owner.properties[property_.name.upper()] = symbol
    for accessor, prefix in ((property_.getter, "__get"), (property_.setter, "__set")):
        if accessor is None:
            continue
        pou = accessor_pou(property_, accessor, prefix, None, source)
        head = PouSymbol(
            pou.name,
            source,
            property_.name_span,
            pou=pou,
            kind="METHOD",
            qualified_name=f"{owner.name}.{pou.name}",
        )
        pou.symbol = head
        found.own[id(head)] = _variables(session, found, head, accessor.blocks, source)
        _add_accessor_value(found.own[id(head)], property_, prefix, source)
        owner.methods[pou.name.upper()] = head
        if prefix == "__get":
            symbol.getter = head
        else:
            symbol.setter = head


def _type(
    session: Session, found: Collected, declaration: ast.TypeDecl, source: Source, level: Level
) -> None:
    symbol = TypeSymbol(declaration.name, source, declaration.name_span, declaration.comment)
    _declare(session, level, symbol, declaration)
    found.types.append((symbol, declaration, source))
    declaration.type = None
    if isinstance(declaration.type_ref, ast.EnumType):
        qualified = attribute(declaration.attributes, "qualified_only") is not None
        _enum_values(session, found, declaration.type_ref, declaration.name, qualified, source)
    elif isinstance(declaration.type_ref, ast.StructType):
        for member in declaration.type_ref.members:
            _local_enum(session, found, member.type_ref, f"{declaration.name}_{member.name}", source)


def _enum_values(
    session: Session, found: Collected, enum: ast.EnumType, name: str, qualified: bool, source: Source
) -> None:
    level = session.levels.of(source)
    values: list[EnumValueSymbol] = []
    seen: set[str] = set()
    for entry in enum.values:
        key = entry.name.upper()
        if key in seen:
            session.report("E0205", source.uri, entry.span, what="enumeration value", name=entry.name)
            continue
        seen.add(key)
        check_name(session, entry.name, source, entry.span)
        value = EnumValueSymbol(entry.name, source, entry.span, entry.comment)
        values.append(value)
        found.enum_of_value[id(value)] = enum
        level.enum_values.append((name, qualified, value))
    found.enum_values[id(enum)] = values


def _local_enum(session: Session, found: Collected, ref: ast.TypeRef, name: str, source: Source) -> None:
    if isinstance(ref, ast.ArrayType):
        _local_enum(session, found, ref.element, name, source)
    elif isinstance(ref, ast.EnumType):
        _enum_values(session, found, ref, name, False, source)
        found.local_enums.append((ref, source, name))


def _gvl(
    session: Session, found: Collected, declaration: ast.GlobalList, source: Source, level: Level
) -> None:
    symbol = GvlSymbol(declaration.name, source, declaration.name_span, declaration.comment, decl=declaration)
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
            decl.symbol = variable
            _add(session, symbol.members, variable, source)
            _local_enum(session, found, decl.type_ref, f"{symbol.name}_{decl.name}", source)


def _add(session: Session, table: dict[str, VarSymbol], variable: VarSymbol, source: Source) -> bool:
    key = variable.name.upper()
    if not key:
        return False
    span = variable.span
    assert span is not None
    check_name(session, variable.name, source, span, "variable")
    old = table.get(key)
    if old is None:
        table[key] = variable
        return True
    related = (Related("first declared here", old.source.uri, old.span),) if old.source and old.span else ()
    session.report("E0205", source.uri, span, related, what=describe(variable), name=variable.name)
    return False


_SECTIONS: dict[str, frozenset[str]] = {
    "PROGRAM": frozenset(
        {"VAR", "VAR_INPUT", "VAR_OUTPUT", "VAR_IN_OUT", "VAR_TEMP", "VAR_STAT", "VAR_EXTERNAL", "VAR_ACCESS"}
    ),
    "FUNCTION": frozenset({"VAR", "VAR_INPUT", "VAR_OUTPUT", "VAR_IN_OUT", "VAR_STAT", "VAR_EXTERNAL"}),
}
_SECTIONS["FUNCTION_BLOCK"] = _SECTIONS["PROGRAM"]
_SECTIONS["METHOD"] = _SECTIONS["FUNCTION"] | {"VAR_INST"}
_SECTIONS["TRANSITION"] = _SECTIONS["METHOD"]
_SECTIONS["ACTION"] = frozenset({"VAR", "VAR_STAT", "VAR_INST"})
_STORAGE = {"PROGRAM": Storage.PROGRAM, "FUNCTION_BLOCK": Storage.INSTANCE}


def _variables(
    session: Session, found: Collected, pou: PouSymbol, blocks: Iterable[ast.VarBlock], source: Source
) -> OwnVariables:
    own = OwnVariables()
    kind = pou.kind
    legal = _SECTIONS[kind]
    owner = pou.qualified_name
    base_storage = _STORAGE.get(kind, Storage.LOCAL)
    for block in blocks:
        section = block.section
        if section not in legal:
            if section == "VAR_TEMP":
                session.report("E0404", source.uri, block.span)
            else:
                what = f"a {kind.lower().replace('_', ' ')}"
                session.report(
                    "E0405",
                    source.uri,
                    block.span,
                    section=section,
                    what=what,
                    hint="Use VAR or an own object.",
                )
        flags = frozenset(block.flags)
        storage = base_storage
        if section == "VAR_TEMP":
            storage = Storage.LOCAL
        elif section == "VAR_STAT":
            storage = Storage.GLOBAL
        elif section == "VAR_INST":
            storage = Storage.INSTANCE
        elif storage is Storage.LOCAL and section in ("VAR_INPUT", "VAR_OUTPUT", "VAR_IN_OUT"):
            storage = Storage.PARAMETER
        for decl in block.variables:
            variable = VarSymbol(
                decl.name,
                source,
                decl.name_span,
                decl.comment,
                storage=storage,
                home=storage,
                section=section,
                flags=flags,
                owner=f"__STAT_{owner}" if section == "VAR_STAT" else owner,
                decl=decl,
            )
            decl.symbol = variable
            _add(session, own.variables, variable, source)
            if section == "VAR_STAT":
                own.statics.append(variable)
            elif section == "VAR_EXTERNAL":
                own.externals.append(variable)
            _local_enum(session, found, decl.type_ref, f"{pou.name}_{decl.name}", source)
    return own

"""First pass: methods, actions and properties of blocks, and their heads in interfaces."""

from __future__ import annotations

from tappet.lang import ast
from tappet.lang.analysis.collect_variables import check_name, collect_variables
from tappet.lang.analysis.collected import Collected, OwnVariables
from tappet.lang.analysis.context import Session
from tappet.lang.analysis.monitored import keeping_variables
from tappet.lang.analysis.same_names import check_result, is_free, member_named, report_twice
from tappet.lang.source import Source
from tappet.lang.symbols import InterfaceSymbol, PouSymbol, PropertySymbol, Storage, VarSymbol


def attach(session: Session, found: Collected, child: ast.Pou | ast.Property, source: Source) -> None:
    """Connects a method, action or property that has a text of its own with its owner."""
    what = child.kind.capitalize() if isinstance(child, ast.Pou) else "Property"
    owner = session.levels.of(source).objects.get(source.owner.upper()) if source.owner else None
    if isinstance(owner, PouSymbol) and owner.instance is not None:
        if isinstance(child, ast.Pou):
            collect_child(session, found, owner, child, source)
        else:
            collect_property(session, found, owner, child, source)
    elif isinstance(owner, InterfaceSymbol):
        if isinstance(child, ast.Pou):
            collect_head(session, found, owner, child, source)
        else:
            collect_property_head(session, found, owner, child, source)
    else:
        session.report("E0429", source.uri, child.name_span, what=f"{what} '{child.name}'")


def declared_pou(
    session: Session, pou: ast.Pou, source: Source, owner: PouSymbol | InterfaceSymbol | None = None
) -> PouSymbol:
    """The symbol of a POU, or of what belongs to a program, block or interface."""
    block = owner if isinstance(owner, PouSymbol) else None
    within = block.qualified_name if block else owner.name if owner is not None else ""
    symbol = PouSymbol(
        pou.name,
        source,
        pou.name_span,
        pou.comment,
        pou.access,
        pou=pou,
        kind="METHOD" if isinstance(owner, InterfaceSymbol) else pou.kind,
        qualified_name=f"{within}.{pou.name}" if within else pou.name,
        instance=block.instance if block else None,
        owner=block,
    )
    symbol = session.stand_for(symbol, source.uri, within)
    pou.symbol = symbol
    return symbol


def collect_child(session: Session, found: Collected, owner: PouSymbol, pou: ast.Pou, source: Source) -> None:
    """A method, action or transition of a program or block."""
    symbol = declared_pou(session, pou, source, owner)
    check_name(session, pou.name, source, pou.name_span)
    table = owner.methods if pou.kind == "METHOD" else owner.actions
    if not is_free(session, found, owner, pou.kind.lower(), pou.name, source, pou.name_span):
        return
    table[pou.name.upper()] = symbol
    found.own[id(symbol)] = collect_variables(session, found, symbol, pou.blocks, source)


def collect_property(
    session: Session, found: Collected, owner: PouSymbol, property_: ast.Property, source: Source
) -> None:
    """A property of a program or block, with its accessors."""
    if not is_free(session, found, owner, "property", property_.name, source, property_.name_span):
        return
    symbol = PropertySymbol(property_.name, source, property_.name_span, property_.comment, property_.access)
    symbol = session.stand_for(symbol, source.uri, owner.qualified_name)
    check_name(session, property_.name, source, property_.name_span)
    owner.properties[property_.name.upper()] = symbol
    for kept in keeping_variables(owner, property_, source):
        kept = session.stand_for(kept, source.uri, owner.qualified_name)
        assert kept.decl is not None
        kept.decl.symbol = kept
        found.own[id(owner)].variables[kept.name.upper()] = kept
    _add_accessors(session, found, owner, symbol, property_, source)


def _add_accessors(
    session: Session,
    found: Collected,
    owner: PouSymbol | InterfaceSymbol,
    symbol: PropertySymbol,
    property_: ast.Property,
    source: Source,
) -> None:
    block = owner if isinstance(owner, PouSymbol) else None
    for accessor, prefix in ((property_.getter, "__get"), (property_.setter, "__set")):
        if accessor is None:
            continue
        pou = accessor_pou(property_, accessor, prefix, block.pou if block else None, source)
        head = declared_pou(session, pou, source, owner)
        found.own[id(head)] = collect_variables(session, found, head, accessor.blocks, source)
        _add_accessor_value(session, found.own[id(head)], head, property_, source)
        if block is None:
            owner.methods[pou.name.upper()] = head
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
        language=accessor.language,
        access=property_.access,
        modifiers=property_.modifiers,
        attributes=property_.attributes,
        owner=owner,
    )


def _add_accessor_value(
    session: Session, own: OwnVariables, head: PouSymbol, property_: ast.Property, source: Source
) -> None:
    """The property's name inside its setter is the value that is set."""
    if not head.name.startswith("__set") or property_.type_ref is None:
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
    symbol = session.stand_for(symbol, source.uri, f"{head.qualified_name} value")
    decl.symbol = symbol
    check_result(session, head, own, property_.name)
    own.variables[property_.name.upper()] = symbol


def collect_head(
    session: Session, found: Collected, owner: InterfaceSymbol, pou: ast.Pou, source: Source
) -> None:
    """A method of an interface."""
    symbol = declared_pou(session, pou, source, owner)
    old = member_named(owner, pou.name.upper())
    if old is not None:
        report_twice(session, "method", pou.name, source, pou.name_span, old)
        return
    owner.methods[pou.name.upper()] = symbol
    found.own[id(symbol)] = collect_variables(session, found, symbol, pou.blocks, source)


def collect_property_head(
    session: Session, found: Collected, owner: InterfaceSymbol, property_: ast.Property, source: Source
) -> None:
    """A property of an interface, with its accessors."""
    symbol = PropertySymbol(property_.name, source, property_.name_span, property_.comment, property_.access)
    symbol = session.stand_for(symbol, source.uri, owner.name)
    old = member_named(owner, property_.name.upper())
    if old is not None:
        report_twice(session, "property", property_.name, source, property_.name_span, old)
        return
    owner.properties[property_.name.upper()] = symbol
    _add_accessors(session, found, owner, symbol, property_, source)

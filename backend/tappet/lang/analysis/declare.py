"""Second pass over what was collected: bases, types, layout and initial values of all declarations."""

from __future__ import annotations

from collections.abc import Iterable

from tappet.lang import ast
from tappet.lang.analysis import layout, program
from tappet.lang.analysis.collected import Collected
from tappet.lang.analysis.context import Body, Record, Session
from tappet.lang.analysis.declarations import Declarations
from tappet.lang.analysis.given_values import initialise_parameter
from tappet.lang.analysis.heads import link, plain_body
from tappet.lang.analysis.initial import initialise
from tappet.lang.attributes import attribute
from tappet.lang.source import Scope
from tappet.lang.symbols import GvlSymbol, PouSymbol, Storage, VarSymbol

_DEFAULT_SLOT = 50000


def declare(session: Session, found: Collected, declarations: Declarations, whole: Collected) -> None:
    """Resolves what `found` holds: the whole program, or the part of it that is declared again."""
    link(session, found, declarations)
    _register(session, found, declarations)
    _resolve_types(found, declarations)
    _resolve_variables(found, declarations)
    lay_out_lists(session, found)
    _fill(session, whole, declarations)
    _initial_values(session, found, declarations)
    session.accounted = None
    for message in session.diagnostics:
        session.declared.setdefault(message.uri, Record()).messages.append(message)


def _register(session: Session, found: Collected, declarations: Declarations) -> None:
    for symbol, declaration, source in found.types:
        declarations.types[id(symbol)] = (symbol, declaration, plain_body(session, source))
        declarations.declared[id(symbol)] = declaration
        if isinstance(declaration.type_ref, ast.EnumType):
            body = declarations.types[id(symbol)][2]
            declarations.enums[id(declaration.type_ref)] = (
                declaration.type_ref,
                symbol.name,
                body,
                declaration,
            )
    for ref, source, name in found.local_enums:
        declarations.enums[id(ref)] = (ref, name, plain_body(session, source), None)
    for gvl, source in found.gvls:
        # its own variables need no qualification in it, whatever others have the same name
        body = Body(session, source, None, {**gvl.members})
        declarations.bodies[id(gvl)] = body
        for member in gvl.members.values():
            declarations.variables[id(member)] = (member, body)


def _resolve_types(found: Collected, declarations: Declarations) -> None:
    for symbol, _, _ in found.types:
        declarations.symbol_type(symbol)
    for symbol, _, _ in found.types:
        if symbol.type is not None:
            declarations.complete(symbol.type)


def _resolve_variables(found: Collected, declarations: Declarations) -> None:
    for gvl, _ in found.gvls:
        for member in gvl.members.values():
            declarations.resolve(member)
    for entry in list(declarations.variables.values()):
        declarations.resolve(entry[0])
    for pou, _ in found.pous:
        if pou.instance is not None:
            declarations.complete(pou.instance)
    for pou in all_pous(found):
        if pou.pou is not None and pou.pou.return_type is not None:
            result = pou.result
            pou.return_type = result.type if result is not None else None
    for interface, _, _ in found.interfaces:
        for method in interface.methods.values():
            if method.result is not None:
                method.return_type = method.result.type
        for property_ in interface.properties.values():
            _property_type(property_)
    for pou, _ in found.pous:
        for property_ in pou.properties.values():
            _property_type(property_)
    for pou in all_pous(found):
        for variable in found.own[id(pou)].variables.values():
            if variable.type is not None:
                declarations.complete(variable.type)
        if pou.return_type is not None:
            declarations.complete(pou.return_type)


def _property_type(property_: object) -> None:
    getter, setter = getattr(property_, "getter", None), getattr(property_, "setter", None)
    type_ = None
    if isinstance(getter, PouSymbol):
        type_ = getter.return_type
    elif isinstance(setter, PouSymbol) and setter.parameters:
        type_ = setter.parameters[-1].type
    property_.type = type_  # type: ignore[attr-defined]


def all_pous(found: Collected) -> Iterable[PouSymbol]:
    """Every POU, method, action and accessor."""
    for pou, _ in found.pous:
        yield from pou.with_children()


def _heads(found: Collected) -> Iterable[PouSymbol]:
    """The methods of interfaces, each once: their inputs have initial values, too."""
    heads = {id(m): m for interface, _, _ in found.interfaces for m in interface.methods.values()}
    return [method for method in heads.values() if id(method) in found.own]


def lay_out_lists(session: Session, found: Collected) -> None:
    """Gives the variables of global lists their offsets."""
    for gvl, source in found.gvls:
        placement = layout.Placement()
        for member in gvl.members.values():
            type_ = member.type
            if type_ is None or member.home is Storage.DIRECT:
                continue
            session.complete(type_)
            member.offset = placement.place(type_.size, type_.align)
            if placement.offset > layout.SIZE_LIMIT:
                span = member.span
                assert span is not None
                session.report(
                    "E0611", source.uri, span, name=gvl.name, size=placement.offset, limit=layout.SIZE_LIMIT
                )
                placement.offset = 0
        gvl.size = placement.size if gvl.members else 0


def _fill(session: Session, found: Collected, declarations: Declarations) -> None:
    """Puts the results together."""
    analysis = session.analysis
    analysis.pous = [pou for pou, _ in found.pous]
    analysis.types = {s.name.upper(): s.type for s, _, _ in found.types if s.type is not None}
    analysis.interfaces = {i.name.upper(): i for i, _, _ in found.interfaces}
    _make_unique(found, session.named_outside)
    for pou in analysis.pous:
        if pou.kind == "PROGRAM":
            analysis.programs.setdefault(pou.qualified_name.upper(), pou)
    lists = [gvl for gvl, _ in found.gvls]
    lists.sort(key=_init_slot)
    for pou in all_pous(found):
        own = found.own[id(pou)]
        if own.statics:
            lists.append(_static_list(pou, own.statics, declarations))
    analysis.gvls = lists
    scopes = [s for s in session.levels.application.objects.values() if s.source is not None]
    source = next((s.source for s in scopes if s.source is not None), None)
    if source is None:
        source = next((p.source for p in analysis.pous if p.source is not None), None)
    if source is not None:
        analysis.scope = session.levels.seen_by(source)


def _make_unique(found: Collected, named_outside: frozenset[str]) -> None:
    """Objects of one name in several scopes get different link names: the outer ones carry their
    namespace."""
    seen = set(named_outside)
    order = {Scope.APPLICATION: 0, Scope.POUS: 1, Scope.LIBRARY: 2}
    entries: list[PouSymbol | GvlSymbol] = [p for p, _ in found.pous]
    entries += [g for g, _ in found.gvls]
    entries.sort(key=lambda s: order[s.source.scope] if s.source is not None else 0)
    for symbol in entries:
        key = symbol.name.upper()
        source = symbol.source
        if key not in seen:
            seen.add(key)
            if source is not None and source.library:
                seen.add(f"{source.library}.{symbol.name}".upper())
            continue
        prefix = (source.namespace or source.library or "POUS") if source is not None else "POUS"
        unique = f"{prefix}.{symbol.name}"
        number = 2
        while unique.upper() in seen:
            unique = f"{prefix}.{symbol.name}_{number}"
            number += 1
        seen.add(unique.upper())
        if isinstance(symbol, GvlSymbol):
            for member in symbol.members.values():
                member.owner = unique
            symbol.name = unique
        else:
            for child in symbol.with_children():
                child.qualified_name = unique if child is symbol else f"{unique}.{child.name}"
                for variable in child.locals.values():
                    if variable.owner is not None and variable.owner.upper() == key:
                        variable.owner = unique


def _init_slot(gvl: GvlSymbol) -> int:
    decl = gvl.decl
    if decl is None:
        return _DEFAULT_SLOT
    pragmas = [*decl.attributes, *(p for block in decl.blocks for p in block.attributes)]
    slot = attribute(pragmas, "global_init_slot")
    try:
        return int(slot) if slot else _DEFAULT_SLOT
    except ValueError:
        return _DEFAULT_SLOT


def _static_list(pou: PouSymbol, statics: list[VarSymbol], declarations: Declarations) -> GvlSymbol:
    name = f"__STAT_{pou.qualified_name}"
    gvl = GvlSymbol(name, pou.source, pou.span, qualified_only=True)
    placement = layout.Placement()
    for variable in statics:
        variable.owner = name
        gvl.members[variable.name.upper()] = variable
        if variable.type is not None and variable.home is not Storage.DIRECT:
            declarations.complete(variable.type)
            variable.offset = placement.place(variable.type.size, variable.type.align)
    gvl.size = placement.size
    return gvl


def _initial_values(session: Session, found: Collected, declarations: Declarations) -> None:
    for symbol, declaration, _ in found.types:
        body = plain_body(session, symbol.source) if symbol.source is not None else None
        if body is None:
            continue
        session.account(body.uri)
        if isinstance(declaration.type_ref, ast.StructType):
            for decl in declaration.type_ref.members:
                if isinstance(decl.symbol, VarSymbol):
                    _initial_value(body, decl.symbol)
        elif (
            declaration.initial is not None
            and symbol.type is not None
            and not isinstance(declaration.type_ref, ast.EnumType)
        ):
            initialise(body, declaration.initial, symbol.type)
    for gvl, source in found.gvls:
        session.account(source.uri)
        for member in gvl.members.values():
            _initial_value(declarations.bodies[id(gvl)], member)
    for pou in (*all_pous(found), *_heads(found)):
        body = declarations.bodies[id(pou)]
        session.account(body.uri)
        for variable in found.own[id(pou)].variables.values():
            if variable.section != "VAR_EXTERNAL":
                _initial_value(body, variable)


def _initial_value(body: Body, variable: VarSymbol) -> None:
    decl, type_ = variable.decl, variable.type
    if decl is None or type_ is None:
        return
    if decl.given is not None:
        if decl.init is decl.initial and not variable.is_constant:
            decl.init = initialise_parameter(body, variable, decl, type_)
    elif decl.initial is not None and not variable.is_constant:
        initialise(body, decl.initial, type_)
    program.check_fb_init(body, variable, decl, type_)

"""One name denotes one symbol in a scope, and in a block with all its bases (LDEC-09)."""

from __future__ import annotations

from collections.abc import Iterator

from tappet.lang.analysis.collected import Collected, OwnVariables
from tappet.lang.analysis.context import Session
from tappet.lang.analysis.scope import describe
from tappet.lang.diagnostics import Related
from tappet.lang.source import Source, Span
from tappet.lang.symbols import InterfaceSymbol, PouSymbol, PropertySymbol, Symbol, VarSymbol


def first_place(symbol: Symbol) -> tuple[Related, ...]:
    """Where the name was given first."""
    if symbol.source is None or symbol.span is None:
        return ()
    return (Related("first declared here", symbol.source.uri, symbol.span),)


def report_twice(session: Session, what: str, name: str, source: Source, span: Span, old: Symbol) -> None:
    """E0205 at the second declaration of a name."""
    session.report("E0205", source.uri, span, first_place(old), what=what, name=name)


def member_named(owner: PouSymbol | InterfaceSymbol, key: str) -> Symbol | None:
    """The method, action or property of this upper-case name that an object has itself."""
    actions = owner.actions if isinstance(owner, PouSymbol) else {}
    return owner.methods.get(key) or actions.get(key) or owner.properties.get(key)


def is_free(
    session: Session, found: Collected, owner: PouSymbol, what: str, name: str, source: Source, span: Span
) -> bool:
    """Whether a block has no member of this name yet; reports one, and a variable of this name.

    An action may be named as a variable, which the name then means: programs that run with TwinCAT do so.
    """
    key = name.upper()
    old = member_named(owner, key)
    other = old if what == "action" else old or found.own[id(owner)].variables.get(key)
    if other is not None and key:
        report_twice(session, what, name, source, span, other)
    return old is None


def check_result(session: Session, pou: PouSymbol, own: OwnVariables, name: str) -> None:
    """A variable named as the result of its function or method hides it: it could not be assigned."""
    variable = own.variables.get(name.upper())
    if variable is not None and variable.source is not None and variable.span is not None:
        related: tuple[Related, ...] = ()
        if pou.source is not None and pou.span is not None:
            related = (Related("the result has this name", pou.source.uri, pou.span),)
        what = describe(variable)
        session.report("E0205", variable.source.uri, variable.span, related, what=what, name=variable.name)


def check_inherited(session: Session, pou: PouSymbol, own: OwnVariables) -> None:
    """What a block declares has no name that a base has given to something else (E0447). Methods, actions and
    properties replace those of the same kind; VAR_TEMP of a base is its own matter."""
    base = pou.base
    if base is None:
        return
    for symbol in _declared(pou, own):
        old = _inherited(base, symbol)
        if old is None or symbol.source is None or symbol.span is None:
            continue
        owner = base if isinstance(old, VarSymbol) else _holder(base, old)
        session.report(
            "E0447",
            symbol.source.uri,
            symbol.span,
            first_place(old),
            name=symbol.name,
            what=describe(symbol),
            other=describe(old),
            base=owner.name,
        )


def _declared(pou: PouSymbol, own: OwnVariables) -> Iterator[Symbol]:
    yield from (v for v in own.variables.values() if v.section != "VAR_EXTERNAL")
    yield from pou.methods.values()
    yield from pou.actions.values()
    yield from pou.properties.values()


def _inherited(base: PouSymbol, symbol: Symbol) -> Symbol | None:
    """What a base calls so and `symbol` does not replace."""
    key = symbol.name.upper()
    variable = base.locals.get(key)
    if variable is not None and variable.section != "VAR_TEMP":
        return variable
    walk: PouSymbol | None = base
    while walk is not None:
        member = member_named(walk, key)
        if member is not None:
            return None if _replaces(symbol, member) else member
        walk = walk.base
    return None


def _replaces(symbol: Symbol, member: Symbol) -> bool:
    if isinstance(member, PropertySymbol):
        return isinstance(symbol, PropertySymbol)
    return isinstance(symbol, PouSymbol)


def _holder(base: PouSymbol, member: Symbol) -> PouSymbol:
    walk: PouSymbol | None = base
    while walk is not None:
        if member_named(walk, member.name.upper()) is member:
            return walk
        walk = walk.base
    return base

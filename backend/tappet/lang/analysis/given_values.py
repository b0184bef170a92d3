"""Values that a library reference gives to parameters, resolved in the view of the application."""

from __future__ import annotations

from tappet.lang import ast
from tappet.lang.analysis.context import Body, Session
from tappet.lang.analysis.initial import initialise
from tappet.lang.lexer import ID, lex
from tappet.lang.parameter_lists import reported_at_reference
from tappet.lang.source import GivenValue, Scope, Source
from tappet.lang.symbols import VarSymbol
from tappet.lang.types import Type

_AGGREGATES = (ast.ArrayInit, ast.StructInit)


def initialise_parameter(body: Body, variable: VarSymbol, decl: ast.VarDecl, type_: Type) -> ast.Expr | None:
    """Resolves the initial value of a parameter: the one that a reference gives, or that of the library when
    it does not suit, which is reported at the reference. Returns what holds."""
    given, value = decl.given, decl.initial
    assert given is not None
    assert value is not None
    session = body.session
    view = _view(session, body.source, given)
    kept, session.diagnostics = session.diagnostics, []
    initialise(view, value, type_)
    own = [message for message in session.diagnostics if message.uri == view.uri]
    others = [message for message in session.diagnostics if message.uri != view.uri]
    session.diagnostics = kept + others
    reason = next((message.message for message in own if message.severity == "error"), None)
    if reason is None and not (value.is_constant or isinstance(value, _AGGREGATES)):
        reason = "it is no constant"
    if reason is not None:
        session.diagnostics.append(
            reported_at_reference("E0904", body.source, variable.owner or "", given, type_, reason)
        )
        if decl.own_initial is not None:
            initialise(body, decl.own_initial, type_)
        return decl.own_initial
    session.diagnostics += [
        reported_at_reference("W1412", body.source, variable.owner or "", given, type_, message.message)
        for message in own
    ]
    return value


def _view(session: Session, source: Source, given: GivenValue) -> Body:
    view = Body(session, Source(f"{given.place}: {given.name}", given.value), None, {})
    view.names = session.levels.seen_at_reference(source)
    if any(_of_project(view, name) for name in _names(given.value)):
        session.values_of_project = True
    return view


def _names(value: str) -> list[str]:
    lexed = lex(value, "")
    return [text for kind, text in zip(lexed.kinds, lexed.texts, strict=False) if kind is ID]


def _of_project(view: Body, name: str) -> bool:
    """Whether an edit of the project can change what a name denotes."""
    symbol = view.lookup(name)
    return symbol is None or symbol.source is None or symbol.source.scope is not Scope.LIBRARY

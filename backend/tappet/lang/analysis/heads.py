"""Between collecting and resolving: bases and interfaces are linked, every POU gets its view of names."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from itertools import repeat

from tappet.lang import ast
from tappet.lang.access import home_of, may_use
from tappet.lang.analysis.collected import Collected
from tappet.lang.analysis.context import Body, Session
from tappet.lang.analysis.declarations import Declarations
from tappet.lang.analysis.same_names import check_inherited, check_result
from tappet.lang.analysis.scope import Fits, QualifiedSymbol, describe, is_type, suggestion
from tappet.lang.attributes import attribute
from tappet.lang.source import Scope, Source, Span
from tappet.lang.symbols import (
    InterfaceSymbol,
    NamespaceSymbol,
    PouSymbol,
    Storage,
    Symbol,
    VarSymbol,
)

_PASSED = frozenset({"VAR_INPUT", "VAR_OUTPUT", "VAR_IN_OUT"})
_DEPTH_LIMIT = 200
_WITHOUT_RESULT = ("tappet_external", "no_return_type")
"""Attributes of functions that may be without a return type."""


def link(session: Session, found: Collected, declarations: Declarations) -> None:
    """Links EXTENDS and IMPLEMENTS, then makes the views of all POUs."""
    for interface, declaration, source in found.interfaces:
        _link_interface(session, interface, declaration, source)
    for interface, _, _ in found.interfaces:
        _inherit_interface(interface, 0)
    for pou, _ in found.pous:
        _link_pou(session, pou)
    for pou, _ in found.pous:
        _break_cycle(session, pou)
    extended = {id(p.base) for p, _ in found.pous if p.base is not None}
    extended |= {id(p) for p, _ in found.pous if p.name.upper() in session.extended_outside}
    view = _Views(session, found, declarations, extended)
    for pou, _ in found.pous:
        view.block(pou)
    for interface, _, source in found.interfaces:
        for method in interface.methods.values():
            if id(method) not in declarations.bodies:
                view.method(method, None, source)


def _find(session: Session, source: Source, name: str, span: Span) -> Symbol | None:
    symbol: Symbol | None = None
    for number, part in enumerate(name.split(".")):
        if number == 0:
            symbol = session.levels.seen_by(source).get(part.upper())
        elif isinstance(symbol, NamespaceSymbol):
            symbol = symbol.members.get(part.upper())
        else:
            return None
    if isinstance(symbol, QualifiedSymbol) and symbol.target is not None and is_type(symbol.target):
        session.report_qualified(source.uri, span, symbol)
        symbol = symbol.target
    if symbol is not None and not may_use(symbol, None, source):
        home, what = home_of(symbol), describe(symbol).capitalize()
        session.report(
            "E0213", source.uri, span, what=what, name=symbol.name, type=home, access=symbol.access
        )
    return symbol


def _link_interface(
    session: Session, interface: InterfaceSymbol, declaration: ast.Interface, source: Source
) -> None:
    spans = declaration.extends_spans or repeat(declaration.name_span)
    interface.bases = list(_interfaces(session, source, declaration.extends, spans))


def _interfaces(
    session: Session, source: Source, names: Iterable[str], spans: Iterable[Span]
) -> Iterator[InterfaceSymbol]:
    """The interfaces of these names; what is none is reported."""
    for name, span in zip(names, spans, strict=False):
        found = _find(session, source, name, span)
        if isinstance(found, InterfaceSymbol):
            yield found
        else:
            hint = _wrong_interface(session, source, name, found)
            session.report("E0217", source.uri, span, name=name, hint=hint)


def _inherit_interface(interface: InterfaceSymbol, depth: int) -> None:
    if depth > _DEPTH_LIMIT:
        interface.bases = []
        return
    for base in interface.bases:
        _inherit_interface(base, depth + 1)
        for key, method in base.methods.items():
            interface.methods.setdefault(key, method)
        for key, property_ in base.properties.items():
            interface.properties.setdefault(key, property_)


def _link_pou(session: Session, pou: PouSymbol) -> None:
    node, source = pou.pou, pou.source
    if node is None or source is None:
        return
    if node.extends:
        base = _find(session, source, node.extends, node.name_span)
        if isinstance(base, PouSymbol) and base.kind == pou.kind == "FUNCTION_BLOCK":
            pou.base = base
            if base.pou is not None and "FINAL" in base.pou.modifiers:
                session.report("E0426", source.uri, node.name_span, name=base.name)
        elif base is None:
            hint = _near(session, source, node.extends, lambda s: isinstance(s, PouSymbol))
            session.report("E0216", source.uri, node.extends_span, name=node.extends, hint=hint)
        else:
            what = pou.kind.lower().replace("_", " ")
            session.report("E0417", source.uri, node.name_span, name=pou.name, base=base.name, what=what)
    spans = node.implements_spans or repeat(node.name_span)
    pou.interfaces += _interfaces(session, source, node.implements, spans)


def _wrong_interface(session: Session, source: Source, name: str, found: Symbol | None) -> str:
    if found is not None:
        return f"'{name}' is a {describe(found)}."
    return _near(session, source, name, lambda s: isinstance(s, InterfaceSymbol))


def _near(session: Session, source: Source, name: str, fits: Fits) -> str:
    """Advice with a near name of the kind that is needed."""
    known = session.levels.seen_by(source).items()
    return suggestion(name, [(key, symbol) for key, symbol in known if fits(symbol)])


def _break_cycle(session: Session, pou: PouSymbol) -> None:
    chain = [pou]
    seen = {id(pou)}
    walk = pou.base
    source, span = pou.source, pou.span
    while walk is not None:
        if len(chain) > _DEPTH_LIMIT:
            last = chain[-1]
            if last.source is not None and last.span is not None:
                session.report("E0107", last.source.uri, last.span, what="inheritance", limit=_DEPTH_LIMIT)
            last.base = None
            return
        if walk is pou:
            names = " -> ".join(p.name for p in [*chain, pou])
            if source is not None and span is not None:
                session.report("E0408", source.uri, span, name=pou.name, chain=names)
            pou.base = None
            return
        if id(walk) in seen:
            return
        seen.add(id(walk))
        chain.append(walk)
        walk = walk.base


class _Views:
    """Makes `PouSymbol.locals`, `parameters`, `vtable` and the `Body` of every POU."""

    def __init__(
        self, session: Session, found: Collected, declarations: Declarations, extended: set[int]
    ) -> None:
        self.session = session
        self.found = found
        self.declarations = declarations
        self.extended = extended

    def block(self, pou: PouSymbol) -> None:
        """View of a program, function or function block, and of what is below it."""
        if id(pou) in self.declarations.bodies:
            return
        base = pou.base
        if base is not None:
            self.block(base)
            pou.locals.update({k: v for k, v in base.locals.items() if v.section not in ("VAR_TEMP",)})
            pou.parameters += base.parameters
        self._own(pou)
        if pou.kind == "FUNCTION":
            self._function_result(pou)
        self._vtable(pou, base)
        visible: dict[str, Symbol] = {}
        self._members(visible, pou)
        visible.update(pou.locals)
        source = pou.source
        assert source is not None
        body = Body(self.session, source, pou, visible)
        self._enter(pou, body)
        if pou.instance is not None:
            self.declarations.blocks[id(pou.instance)] = pou
        for child in (*pou.methods.values(), *pou.actions.values()):
            self.method(child, pou, child.source or source)
        for property_ in pou.properties.values():
            for accessor in property_.accessors():
                self.method(accessor, pou, accessor.source or source, property_.name)

    def method(
        self, pou: PouSymbol, owner: PouSymbol | None, source: Source, result_name: str | None = None
    ) -> None:
        """View of a method, action, transition or accessor."""
        if owner is not None:
            pou.locals.update({k: v for k, v in owner.locals.items() if v.section != "VAR_TEMP"})
        self._own(pou)
        if pou.kind in ("METHOD", "TRANSITION"):
            name = result_name or pou.name
            if pou.pou is not None and pou.pou.return_type is not None:
                self._result(pou, name)
        visible: dict[str, Symbol] = {}
        if owner is not None:
            self._members(visible, owner)
        visible.update(pou.locals)
        self._enter(pou, Body(self.session, source, pou, visible))

    def _members(self, visible: dict[str, Symbol], pou: PouSymbol) -> None:
        """Methods, actions and properties, those of bases first."""
        chain: list[PouSymbol] = []
        walk: PouSymbol | None = pou
        while walk is not None:
            chain.append(walk)
            walk = walk.base
        for block in reversed(chain):
            visible.update(block.methods)
            visible.update(block.actions)
            visible.update(block.properties)

    def _own(self, pou: PouSymbol) -> None:
        own = self.found.own[id(pou)]
        check_inherited(self.session, pou, own)
        for key, variable in own.variables.items():
            pou.locals[key] = variable
            if variable.section in _PASSED:
                pou.parameters.append(variable)

    def _result(self, pou: PouSymbol, name: str) -> None:
        node = pou.pou
        decl = None
        if node is not None and node.return_type is not None:
            decl = ast.VarDecl(
                name=name, name_span=node.name_span, span=node.name_span, type_ref=node.return_type
            )
        result = VarSymbol(
            name,
            pou.source,
            pou.span,
            storage=Storage.RESULT,
            home=Storage.RESULT,
            section="RESULT",
            owner=pou.qualified_name,
            decl=decl,
        )
        if pou.source is not None:
            result = self.session.stand_for(result, pou.source.uri, f"{pou.qualified_name} result")
        if decl is not None:
            decl.symbol = result
        pou.result = result
        check_result(self.session, pou, self.found.own[id(pou)], name)
        pou.locals.setdefault(name.upper(), result)

    def _function_result(self, pou: PouSymbol) -> None:
        """A function yields one data element (POU-03); C functions and system sources may yield none.

        Functions of other systems may do so, too: their imports mark them.
        """
        node, source = pou.pou, pou.source
        if node is not None and node.return_type is None and source is not None:
            marked = any(attribute(node.attributes, name) is not None for name in _WITHOUT_RESULT)
            if marked or source.scope is Scope.LIBRARY or self.session.options.system:
                return
            self.session.report("E0432", source.uri, node.name_span, name=pou.name)
        self._result(pou, pou.name)

    def _vtable(self, pou: PouSymbol, base: PouSymbol | None) -> None:
        if pou.kind != "FUNCTION_BLOCK":
            return
        if base is not None:
            pou.vtable.update(base.vtable)
        pragmas = pou.pou.attributes if pou.pou is not None else []
        fixed = attribute(pragmas, "no_virtual_actions") is not None  # LSFC-26
        entries: dict[str, PouSymbol] = {**pou.methods, **({} if fixed else pou.actions)}
        for property_ in pou.properties.values():
            for accessor in property_.accessors():
                entries[accessor.name.upper()] = accessor
        if base is not None or id(pou) in self.extended or pou.interfaces or entries:
            pou.vtable.setdefault("__BODY", pou)
            pou.vtable["__BODY"] = pou
        pou.vtable.update(entries)

    def _enter(self, pou: PouSymbol, body: Body) -> None:
        """Registers a view and its variables; connects VAR_EXTERNAL with the global variable."""
        self.declarations.bodies[id(pou)] = body
        own = self.found.own[id(pou)]
        for variable in own.externals:
            self._external(pou, body, variable)
        results = () if pou.result is None else (pou.result,)
        for variable in (*own.variables.values(), *results):
            if variable.decl is not None and variable.section != "VAR_EXTERNAL":
                self.declarations.variables[id(variable)] = (variable, body)

    def _external(self, pou: PouSymbol, body: Body, variable: VarSymbol) -> None:
        key = variable.name.upper()
        target = body.values.get(key) or body.names.get(key)
        span = variable.span
        assert span is not None
        if variable.decl is not None:
            variable.decl.type_ref.type = None
        if isinstance(target, VarSymbol):
            pou.locals[key] = target
            body.locals[key] = target
            if variable.decl is not None and variable.decl.initial is not None:
                body.report("W1207", span, name=variable.name)
        else:
            body.report("E0211", span, name=variable.name)


def plain_body(session: Session, source: Source) -> Body:
    """View of a text that belongs to no POU: a type or a global variable list."""
    return Body(session, source, None, {})

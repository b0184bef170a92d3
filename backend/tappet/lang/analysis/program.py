"""Checks of the whole program: recursion, interfaces, FB_Init arguments, what rules see of the whole."""

from __future__ import annotations

from collections.abc import Iterable

from tappet.lang import ast
from tappet.lang import types as t
from tappet.lang.analysis.collected import Collected
from tappet.lang.analysis.configured import place_incomplete
from tappet.lang.analysis.context import Body, Session
from tappet.lang.analysis.declarations import Declarations
from tappet.lang.analysis.fb_init import bind_fb_init
from tappet.lang.analysis.members import find_member
from tappet.lang.heritage import has_unknown_base
from tappet.lang.rules import PROGRAM_RULES
from tappet.lang.source import Source, Span
from tappet.lang.symbols import InterfaceSymbol, PouSymbol, PropertySymbol, VarSymbol
from tappet.lang.types import Type


def check(session: Session, found: Collected, declarations: Declarations, outer: frozenset[int]) -> None:
    """Runs all checks of the whole program; `outer`: id() of POUs that `check_pous` has checked already."""
    _hidden_objects(session)
    check_pous(session, found, declarations, outer)
    place_incomplete(session, found, declarations)
    for rule in PROGRAM_RULES:
        rule(session)


def check_pous(session: Session, found: Collected, declarations: Declarations, outer: frozenset[int]) -> None:
    """What concerns POUs and what they call, extend and implement, those of `outer` left out."""
    pous = [pou for pou, _ in found.pous if id(pou) not in outer]
    _recursion(session, pous, outer)
    for pou in pous:
        _interfaces(session, pou)
        _overrides(session, pou)
    _external_types(pous, found, declarations)


def _hidden_objects(session: Session) -> None:
    """An object of the application hides an equally named one of the POUs view (CON-09)."""
    outer = session.levels.pous.objects
    for key, symbol in session.levels.application.objects.items():
        if key in outer and symbol.source is not None and symbol.span is not None:
            session.report("W1201", symbol.source.uri, symbol.span, name=symbol.name)


# -- recursion --------------------------------------------------------------------------------------


def _recursion(session: Session, pous: Iterable[PouSymbol], outer: frozenset[int]) -> None:
    """Reports every cycle of calls once, with the chain (POU-02)."""
    finished = set(outer)
    for pou in pous:
        for start in pou.with_children():
            if id(start) not in finished:
                _search(session, start, finished)


def _search(session: Session, start: PouSymbol, finished: set[int]) -> None:
    path: list[PouSymbol] = [start]
    on_path = {id(start): 0}
    stack = [iter(session.calls.get(id(start), ()))]
    reported: set[tuple[int, int]] = set()
    while stack:
        step = next(stack[-1], None)
        if step is None:
            stack.pop()
            done = path.pop()
            del on_path[id(done)]
            finished.add(id(done))
            continue
        target, _, span = step
        if id(target) in on_path:
            edge = (id(path[-1]), id(target))
            if edge in reported:
                continue
            reported.add(edge)
            _report_recursion(session, path, path[on_path[id(target)] :], span)
        elif id(target) not in finished:
            path.append(target)
            on_path[id(target)] = len(path) - 1
            stack.append(iter(session.calls.get(id(target), ())))


def _report_recursion(session: Session, path: list[PouSymbol], cycle: list[PouSymbol], span: Span) -> None:
    caller = path[-1]
    if caller.source is None:
        return
    chain = " -> ".join(p.qualified_name for p in [*cycle, cycle[0]])
    strict = any(p.kind in ("FUNCTION", "PROGRAM") for p in cycle)
    strict |= len(cycle) > 1 and any(_charted(p) for p in cycle)  # one alone has been reported at its step
    session.report("E0515" if strict else "W1117", caller.source.uri, span, chain=chain)


def _charted(pou: PouSymbol) -> bool:
    """Whether this is an action written in SFC: it cannot be at a step of its own chart (LSFC-85)."""
    return pou.kind == "ACTION" and pou.pou is not None and pou.pou.language == "SFC"


# -- interfaces and overriding ----------------------------------------------------------------------


def _interfaces(session: Session, pou: PouSymbol) -> None:
    node, source = pou.pou, pou.source
    if node is None or source is None or "ABSTRACT" in node.modifiers or has_unknown_base(pou):
        return
    for interface in pou.interfaces:
        for key, head in interface.methods.items():
            if key.startswith(("__GET", "__SET")) and key[5:] in interface.properties:
                continue
            own = find_member(pou, key)
            if not isinstance(own, PouSymbol):
                _missing(session, source, node, interface, "method", head.name)
            else:
                _compare(session, own, head, interface.name)
        for key, property_ in interface.properties.items():
            own_property = find_member(pou, key)
            if own_property is None:
                _missing(session, source, node, interface, "property", property_.name)
            elif isinstance(own_property, PropertySymbol):
                _compare_property(session, own_property, property_, interface.name)


def _missing(
    session: Session, source: Source, node: ast.Pou, interface: InterfaceSymbol, what: str, member: str
) -> None:
    session.report(
        "E0418",
        source.uri,
        node.name_span,
        name=node.name,
        what=what,
        member=member,
        interface=interface.name,
    )


def _overrides(session: Session, pou: PouSymbol) -> None:
    if pou.base is None:
        return
    for key, method in pou.methods.items():
        if key in ("FB_INIT", "FB_EXIT", "FB_REINIT"):
            continue
        base = find_member(pou.base, key)
        if isinstance(base, PouSymbol):
            owner = base.owner.name if base.owner is not None else base.name
            _compare(session, method, base, owner)


def _compare(session: Session, own: PouSymbol, base: PouSymbol, base_name: str) -> None:
    """A method that overrides or implements another one has its parameters and result."""
    reason = ""
    if _differ(own.return_type, base.return_type, own, base):
        reason = f"it returns '{own.return_type}' instead of '{base.return_type}'"
    elif len(own.parameters) != len(base.parameters):
        reason = f"it has {len(own.parameters)} parameters instead of {len(base.parameters)}"
    else:
        for mine, other in zip(own.parameters, base.parameters, strict=True):
            if mine.name.upper() != other.name.upper() or mine.section != other.section:
                reason = f"parameter '{mine.name}' is '{other.name}' there"
            elif mine.type is not None and other.type is not None and mine.type != other.type:
                reason = f"parameter '{mine.name}' is '{mine.type}' instead of '{other.type}'"
            else:
                continue
            break
    if reason and own.source is not None and own.span is not None:
        session.report(
            "E0419", own.source.uri, own.span, what="Method", name=own.name, base=base_name, reason=reason
        )


def _differ(mine: Type | None, other: Type | None, own: PouSymbol, base: PouSymbol) -> bool:
    """Whether two results differ; not when one has a type that is unknown, which has been reported."""
    for found, pou in ((mine, own), (other, base)):
        if found is None and pou.pou is not None and pou.pou.return_type is not None:
            return False
    return mine != other


def _compare_property(session: Session, own: PropertySymbol, head: PropertySymbol, interface: str) -> None:
    """A property that implements one of an interface has its type and its accessors."""
    reason = ""
    if own.type is not None and head.type is not None and own.type != head.type:
        reason = f"it is '{own.type}' instead of '{head.type}'"
    elif head.getter is not None and own.getter is None:
        reason = "it has no Get"
    elif head.setter is not None and own.setter is None:
        reason = "it has no Set"
    if reason and own.source is not None and own.span is not None:
        session.report(
            "E0419", own.source.uri, own.span, what="Property", name=own.name, base=interface, reason=reason
        )


# -- declarations -----------------------------------------------------------------------------------


def check_fb_init(body: Body, variable: VarSymbol, decl: ast.VarDecl, type_: Type) -> None:
    """Arguments in the declaration of an instance are those of FB_Init behind the first two (LDEC-102)."""
    ref: ast.TypeRef = decl.type_ref
    while isinstance(ref, ast.ArrayType):
        ref = ref.element
    count = 1
    while isinstance(type_, t.Array):
        count *= type_.count
        type_ = type_.element
    args = ref.args if isinstance(ref, ast.NamedType) else None
    elements = ref.elements if isinstance(ref, ast.NamedType) else []
    block = type_.pou.symbol if isinstance(type_, t.FunctionBlock) and type_.pou is not None else None
    if not isinstance(block, PouSymbol) or variable.section in ("VAR_IN_OUT", "VAR_EXTERNAL"):
        given = args or [a for element in elements for a in element.args]
        if given:
            body.report("E0503", ref.span, callee=str(type_), expected=0, actual=len(given), hint="")
        return
    if not elements:
        _bind_fb_init(body, args or [], block, variable, ref.span if args else decl.span)
        return
    if len(elements) != count:
        body.report("E0441", ref.span, actual=len(elements), type=variable.type, expected=count)
    for element in elements:
        _bind_fb_init(body, element.args, block, variable, element.span)


def _bind_fb_init(
    body: Body, args: list[ast.Argument], block: PouSymbol, variable: VarSymbol, span: Span
) -> None:
    for parameter in bind_fb_init(body, args, block, span):
        body.report("E0421", span, name=parameter.name, variable=variable.name, type=block.name)


def _external_types(pous: Iterable[PouSymbol], found: Collected, declarations: Declarations) -> None:
    """VAR_EXTERNAL must repeat the type of the global variable (LDEC-27)."""
    for pou in pous:
        for entry in pou.with_children():
            body = declarations.bodies[id(entry)]
            for variable in found.own[id(entry)].externals:
                target = entry.locals.get(variable.name.upper())
                decl = variable.decl
                if target is variable or target is None or decl is None:
                    continue
                type_ = declarations.type_of(body, decl.type_ref, variable.name)
                if type_ is not None and target.type is not None and type_ != target.type:
                    body.report(
                        "E0212",
                        decl.span,
                        name=variable.name,
                        type=type_,
                        other=target.type,
                        owner=target.owner,
                    )

"""A second analysis after an edit of bodies: declarations, types and layout stay, new bodies are resolved.

An edit qualifies when every changed unit declares the same programs, functions, blocks and children with the
same variables as before. Everything else takes the full way.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace

from tappet.lang import ast
from tappet.lang.analysis.bodies import State, finish
from tappet.lang.analysis.collect_members import accessor_pou
from tappet.lang.analysis.context import SUGGESTION_LIMIT, Body
from tappet.lang.analysis.initial import initialise
from tappet.lang.analysis.program import check_fb_init
from tappet.lang.analysis.result import Analysis, AnalysisOptions
from tappet.lang.ast.fields import source_fields
from tappet.lang.source import Source
from tappet.lang.symbols import PouSymbol, PropertySymbol, VarSymbol

_NOT_COMPARED = frozenset({"comment", "source", "body"})
"""Of what the source says: where it comes from, and statements."""
_UNNAMED = (ast.EnumType, ast.StructType)


def reanalyse(
    previous: Analysis,
    units: Sequence[ast.Unit],
    options: AnalysisOptions,
    first: frozenset[str] | None = None,
) -> Analysis | None:
    """The analysis of `units` made from `previous`; None when more than bodies has changed. With `first`,
    those that waited wait on."""
    state = previous.state
    if not isinstance(state, State) or options != previous.options or len(units) != len(state.units):
        return None
    pairs = [(old, new) for old, new in zip(state.units, units, strict=True) if old is not new]
    if not all(_only_bodies(old, new) for old, new in pairs):
        return None
    edited = {old.source.uri for old, _ in pairs}
    if any(uri in edited and record.messages for uri, record in state.session.declared.items()):
        return None
    if not state.waiting:
        state.session.suggestions = 0
    changed: list[PouSymbol] = []
    state.session.analysis = replace(previous, changed=changed, redeclared=None, continued=True)
    previous.state = None
    for old, new in pairs:
        for before, after in zip(old.declarations, new.declarations, strict=True):
            _rebind(state, before, after, new.source, changed)
    state.units = tuple(units)
    late = bool(state.waiting)
    state.waiting.update((id(symbol), symbol) for symbol in changed)
    state.variable_checks.forget(changed)
    state.analyse_waiting(first=frozenset(edited) if first is not None else None)
    if late and state.session.suggestions >= SUGGESTION_LIMIT:
        return None
    result = finish(state)
    # a new address in a body may take the place of a variable that other bodies are linked with
    return result if result.configured == previous.configured else None


# -- comparison -------------------------------------------------------------------------------------


def _only_bodies(old: ast.Unit, new: ast.Unit) -> bool:
    if replace(old.source, text="", body_line=0, bodies=()) != replace(
        new.source, text="", body_line=0, bodies=()
    ):
        return False
    if not all(isinstance(d, (ast.Pou, ast.Property)) for d in old.declarations):
        return False
    return _same(old.declarations, new.declarations) and _with_code(old) == _with_code(new)


def _with_code(unit: ast.Unit) -> list[bool]:
    """Which blocks have a body: others ask for that."""
    return [isinstance(d, ast.Pou) and d.kind == "FUNCTION_BLOCK" and bool(d.body) for d in unit.declarations]


_COMPARED: dict[type, tuple[str, ...]] = {}


def _compared_fields(node: ast.Node) -> tuple[str, ...]:
    kind = node.__class__
    found = _COMPARED.get(kind)
    if found is None:
        found = _COMPARED[kind] = tuple(n for n in source_fields(kind) if n not in _NOT_COMPARED)
    return found


def _same(old: object, new: object) -> bool:
    """Whether two trees declare the same, places and statements left out."""
    if old.__class__ is not new.__class__:
        return False
    if isinstance(old, _UNNAMED):
        return False
    if isinstance(old, list):
        assert isinstance(new, list)
        return len(old) == len(new) and all(map(_same, old, new))
    if isinstance(old, tuple):
        assert isinstance(new, tuple)
        return len(old) == len(new) and all(map(_same, old, new))
    if isinstance(old, ast.Node):
        return all(_same(getattr(old, name), getattr(new, name)) for name in _compared_fields(old))
    return old == new


# -- new nodes for old symbols ----------------------------------------------------------------------


def _rebind(
    state: State,
    old: ast.Declaration,
    new: ast.Declaration,
    source: Source,
    changed: list[PouSymbol],
    owner: PouSymbol | None = None,
) -> None:
    if isinstance(old, ast.Pou) and isinstance(new, ast.Pou):
        symbol = old.symbol
        if not isinstance(symbol, PouSymbol):
            return  # a second object of the same name, which has been reported
        _rebind_pou(state, symbol, new, source, changed)
        for before, after in _children(old, new):
            _rebind(state, before, after, source, changed, symbol)
    elif isinstance(old, ast.Property) and isinstance(new, ast.Property):
        owner = owner or _owner_of(state, source)
        found = owner.properties.get(old.name.upper()) if owner is not None else None
        if isinstance(found, PropertySymbol) and owner is not None:
            found.source, found.span, found.comment = source, new.name_span, new.comment
            for accessor, head, prefix in (
                (new.getter, found.getter, "__get"),
                (new.setter, found.setter, "__set"),
            ):
                if accessor is not None and head is not None:
                    pou = accessor_pou(new, accessor, prefix, owner.pou, source)
                    _rebind_pou(state, head, pou, source, changed)


def _owner_of(state: State, source: Source) -> PouSymbol | None:
    name = (source.owner or "").upper()
    owner = state.session.levels.of(source).objects.get(name)
    return owner if isinstance(owner, PouSymbol) else None


def _children(old: ast.Pou, new: ast.Pou) -> Iterable[tuple[ast.Declaration, ast.Declaration]]:
    yield from zip(old.methods, new.methods, strict=True)
    yield from zip(old.actions, new.actions, strict=True)
    yield from zip(old.properties, new.properties, strict=True)


def _rebind_pou(
    state: State, symbol: PouSymbol, node: ast.Pou, source: Source, changed: list[PouSymbol]
) -> None:
    """Makes `node` the tree of `symbol`: its declarations get the symbols and types of the old ones."""
    old = symbol.pou
    body = state.declarations.bodies.get(id(symbol))
    if old is None or body is None:
        return
    fresh = Body(state.session, source, symbol, body.locals)
    state.declarations.bodies[id(symbol)] = fresh
    node.symbol = symbol
    symbol.pou, symbol.source, symbol.span = node, source, node.name_span
    symbol.comment = node.comment
    if symbol.instance is not None and symbol.owner is None:
        symbol.instance.pou = node
    if symbol.result is not None:
        symbol.result.source, symbol.result.span = source, node.name_span
    if node.return_type is not None:
        state.declarations.type_of(fresh, node.return_type, symbol.name)
    for old_block, new_block in zip(old.blocks, node.blocks, strict=True):
        for before, after in zip(old_block.variables, new_block.variables, strict=True):
            _rebind_variable(state, fresh, before, after, source)
    changed.append(symbol)


def _rebind_variable(
    state: State, body: Body, before: ast.VarDecl, after: ast.VarDecl, source: Source
) -> None:
    variable = before.symbol
    after.symbol = variable
    after.init = after.initial or before.init
    if not isinstance(variable, VarSymbol):
        return
    if variable.decl is before:
        variable.decl, variable.source, variable.span = after, source, after.name_span
        variable.comment = after.comment
    state.declarations.type_of(body, after.type_ref, after.name)
    if after.initial is not None and variable.type is not None:
        session = state.session
        kept = session.diagnostics
        session.diagnostics = []  # the same declaration has been checked before
        initialise(body, after.initial, variable.type)
        session.diagnostics = kept
    if variable.type is not None and _passes_arguments(after.type_ref):
        check_fb_init(body, variable, after, variable.type)


def _passes_arguments(ref: ast.TypeRef) -> bool:
    while isinstance(ref, ast.ArrayType):
        ref = ref.element
    return isinstance(ref, ast.NamedType) and bool(ref.args or ref.elements)

"""Mends of names: the right spelling, a declaration, the library that has it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from tappet.lang import ast
from tappet.lang import types as t
from tappet.lang.analysis.scope import AmbiguousSymbol, QualifiedSymbol
from tappet.lang.nearest import nearest
from tappet.lang.services import describe
from tappet.lang.services.cursor import chain_before, enclosing_call, operand
from tappet.lang.services.expected_type import type_for
from tappet.lang.services.fix_site import Site, indent_of, insert_before_line
from tappet.lang.services.resolution import block_members, callable_pou, is_hidden, members, resolve
from tappet.lang.services.results import CodeAction, Edit
from tappet.lang.source import Span, split_lines
from tappet.lang.symbols import GvlSymbol, InterfaceSymbol, NamespaceSymbol, PouSymbol, Symbol, TypeSymbol

_PROPOSED = 3


def unknown_name(site: Site) -> Iterator[CodeAction]:
    """A name that is not declared: a declaration, the near names it may mean, a library (E0201)."""
    name = site.written
    if not name:
        return
    called = site.lexed.kinds[site.token + 1] == "("
    known: dict[str, Symbol] = dict(site.snapshot.analysis.scope)
    known |= block_members(site.scope.block)
    known |= {key: symbol for key, symbol in site.scope.locals.items() if symbol.name}
    type_ = type_for(site, name)
    if type_:  # a function that does not exist: no variable mends that
        for edit in _declaration(site, name, type_):
            title = f"Declare '{name}' as {type_}"
            yield site.action("declareAs", title, edit, preferred=True, name=name, type=type_)
        yield site.action("declare", f"Declare '{name}'...", declare=name, type_=type_, name=name)
    yield from _spellings(site, name, known.items(), called, preferred=not type_)
    yield from _libraries(site, name)


def qualified(site: Site) -> Iterator[CodeAction]:
    """A name that must be qualified (E0207, E0220)."""
    yield site.replacement(site.span, site.facts["choice"])


def unknown_type(site: Site) -> Iterator[CodeAction]:
    """A type that does not exist: its right spelling, a library (E0202, E0216, E0217)."""
    kinds: tuple[type[Symbol], ...] = (TypeSymbol, InterfaceSymbol, PouSymbol)
    if site.diagnostic.code == "E0216":
        kinds = (PouSymbol,)
    elif site.diagnostic.code == "E0217":
        kinds = (InterfaceSymbol,)
    known = [
        (key, symbol)
        for key, symbol in site.snapshot.analysis.scope.items()
        if isinstance(symbol, kinds)
        and (not isinstance(symbol, PouSymbol) or symbol.kind == "FUNCTION_BLOCK")
    ]
    found = list(_spellings(site, site.written, known, False))
    if site.diagnostic.code == "E0202":
        elementary = {name: TypeSymbol(name, type=type_) for name, type_ in t.ELEMENTARY.items()}
        known_types = [*elementary.items(), ("STRING", TypeSymbol("STRING"))]
        found += _spellings(site, site.written, [(k, s) for k, s in known_types if "_" not in k[:2]], False)
    yield from found[:_PROPOSED]
    yield from _libraries(site, site.written)


def unknown_member(site: Site) -> Iterator[CodeAction]:
    """A member that does not exist: its right spelling (E0204, E0218)."""
    dot = site.token - 1
    if dot < 1 or site.lexed.kinds[dot] != ".":
        return
    start = chain_before(site.lexed, dot)
    meaning = resolve(site.scope, operand(site.lexed, site.view.source, start, dot))
    yield from _spellings(site, site.written, members(meaning).items(), False)


def unknown_parameter(site: Site) -> Iterator[CodeAction]:
    """A parameter that does not exist: its right spelling (E0502)."""
    call = enclosing_call(site.lexed, site.view.source, site.token - 1)
    pou = callable_pou(resolve(site.scope, call.callee)) if call is not None else None
    if pou is not None:
        pins = [(pin.name.upper(), pin) for pin in describe.pins(pou)]
        span = site.token_span(site.token)
        yield from _spellings(site, site.lexed.texts[site.token], pins, False, span)


def _spellings(
    site: Site,
    name: str,
    known: Iterable[tuple[str, Symbol]],
    called: bool,
    span: Span | None = None,
    *,
    preferred: bool = True,
) -> Iterator[CodeAction]:
    """Close names that exist, closest first."""
    table: dict[str, str] = {}
    for key, symbol in known:
        if key.startswith("__") or is_hidden(symbol):
            continue
        if called and isinstance(symbol, (GvlSymbol, NamespaceSymbol, InterfaceSymbol)):
            continue
        if isinstance(symbol, QualifiedSymbol):
            table[key] = symbol.choice
        elif isinstance(symbol, AmbiguousSymbol):
            table[key] = symbol.choices[0]
        else:
            table[key] = symbol.name
    for number, key in enumerate(nearest(name, table, _PROPOSED)):
        edit = site.replace(span or site.span, table[key])
        title = f"Replace by '{table[key]}'"
        yield site.action("replace", title, edit, preferred=preferred and number == 0, name=table[key])


def _libraries(site: Site, name: str) -> Iterator[CodeAction]:
    for library in site.offering(name.partition(".")[0]):
        title = f"Add library {library}"
        yield site.action("addLibrary", title, library=library, name=name, library_name=library)


# -- declarations


def _declaration(site: Site, name: str, type_: str) -> Iterator[Edit]:
    """The edit that declares a variable in the POU around the message, if there is a text for it."""
    pou = site.scope.pou
    if pou is not None and pou.kind in ("ACTION", "TRANSITION"):
        pou = pou.owner
    node = pou.pou if pou is not None else None
    if pou is None or node is None or pou.source is None or pou.name.startswith("__"):
        return
    text = site.snapshot.text_of(pou.source.uri)
    if text is None or text.read_only or site.in_declaration:
        return
    lines = split_lines(text.source.text)
    block = next((b for b in reversed(node.blocks) if b.section == "VAR" and not b.flags), None)
    if block is not None:
        line, column = block.span.end_line, block.span.end_column
        end = lines[line][:column].upper().rfind("END_VAR")
        if end < 0:
            return  # not closed: mend that first
        before = lines[line][:end]
        if before.strip():
            place = text.place(Span(line, end, line, end))
            yield Edit(place, f"{name} : {type_}; ")
            return
        inner = before + "    "
        if (
            block.variables
            and not lines[block.variables[-1].span.line][: block.variables[-1].span.column].strip()
        ):
            inner = indent_of(lines[block.variables[-1].span.line])
        yield insert_before_line(text, lines, line, f"{inner}{name} : {type_};\n")
        return
    after = node.blocks[-1].span.end_line if node.blocks else _end_of_head(node)
    yield insert_before_line(text, lines, after + 1, f"VAR\n    {name} : {type_};\nEND_VAR\n")


def _end_of_head(node: ast.Pou) -> int:
    ends = [node.name_span.end_line, node.extends_span.end_line]
    ends += [span.end_line for span in node.implements_spans]
    if node.return_type is not None:
        ends.append(node.return_type.span.end_line)
    return max(ends)

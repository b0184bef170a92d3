"""Mends of coding rules in declarations: names, prefixes, one variable a line, constants."""

from __future__ import annotations

from collections.abc import Iterator

from tappet.lang import ast
from tappet.lang.services.documents import Position
from tappet.lang.services.fix_site import Site, indent_of
from tappet.lang.services.fix_syntax import removal
from tappet.lang.services.rename import rename
from tappet.lang.services.results import CodeAction, ServiceError
from tappet.lang.source import Span
from tappet.lang.symbols import VarSymbol


def prefixed(site: Site) -> Iterator[CodeAction]:
    """Give a variable the prefix of its type, everywhere (S1004)."""
    name = site.facts["name"]
    yield from _renamed(site, site.facts["prefix"] + name[0].upper() + name[1:])


def capitals(site: Site) -> Iterator[CodeAction]:
    """Write a constant in capitals, everywhere (S1008)."""
    yield from _renamed(site, site.facts["proposal"])


def _renamed(site: Site, name: str) -> Iterator[CodeAction]:
    place = site.view.place(site.span)
    try:
        begin = Position(place.span.line, place.span.column)
        edits = rename(site.snapshot, place.document, begin, name)
    except ServiceError:  # the name is taken, or would be
        return
    yield site.action("rename", f"Rename to '{name}'", *edits, preferred=True, name=name)


def own_line(site: Site) -> Iterator[CodeAction]:
    """Declare a variable apart from the one before it (S1108)."""
    lexed, at = site.lexed, site.token
    end = at
    while lexed.kinds[end] not in (":", "END_VAR") and end < len(lexed.kinds) - 1:
        end += 1
    stop = end
    while lexed.kinds[stop] not in (";", "END_VAR") and stop < len(lexed.kinds) - 1:
        stop += 1
    if lexed.kinds[end] != ":" or lexed.kinds[stop] != ";" or lexed.kinds[at - 1] != ",":
        return
    before, colon, last = site.token_span(at - 2), site.token_span(end), site.token_span(stop)
    if colon.line != last.line or site.spoken(Span(*before[2:], *site.span[:2])):
        return
    type_ = site.lines[colon.line][colon.end_column : last.end_column].strip()
    indent = indent_of(site.lines[before.line])
    between = Span(*before[2:], *site.span[:2])
    edit = site.replace(between, f" : {type_}\n{indent or '    '}")
    yield site.action("ownLine", "Declare it in a line of its own", edit, preferred=True)


def strict_values(site: Site) -> Iterator[CodeAction]:
    """Let an enumeration take its own values only (S1113)."""
    at = site.token
    if at and site.lexed.kinds[at - 1] == "TYPE":
        at -= 1
    place = site.token_span(at)
    text = "{attribute 'strict'}"
    line = site.lines[place.line]
    if line[: place.column].strip():
        edit = site.insert(place.line, place.column, f"\n{text}\n")
    else:
        edit = site.before_line(place.line, f"{indent_of(line)}{text}\n")
    yield site.insertion(edit, text)


def constant(site: Site) -> Iterator[CodeAction]:
    """Move a variable that nothing writes to a block of constants (S1415)."""
    block = next((node for node in reversed(site.path) if isinstance(node, ast.VarBlock)), None)
    decl = next((node for node in reversed(site.path) if isinstance(node, ast.VarDecl)), None)
    if block is None or decl is None or block.attributes:
        return
    alone = [other for other in block.variables if other.type_ref.span == decl.type_ref.span] == [decl]
    lines = site.lines[decl.name_span.line]
    end = site.token
    while site.lexed.kinds[end] not in (";", "END_VAR") and end < len(site.lexed.kinds) - 1:
        end += 1
    last = site.token_span(end)
    if not alone or site.lexed.kinds[end] != ";" or last.line != decl.name_span.line:
        return
    declared = lines[decl.name_span.column : last.end_column]
    comment = lines[last.end_column :].strip()
    if comment.startswith("//"):
        declared += f" {comment}"
    text = f"{block.section} CONSTANT\n    {declared}\nEND_VAR\n"
    head = site.lines[block.span.line][: block.span.column]
    if head.strip():
        added = site.insert(block.span.line, block.span.column, f"\n{text}")
    else:
        added = site.before_line(block.span.line, text)
    title = f"Make '{decl.name}' a constant"
    yield site.action("makeConstant", title, removal(site, site.token), added, preferred=True, name=decl.name)


def external(site: Site) -> Iterator[CodeAction]:
    """Declare a global variable in VAR_EXTERNAL (S1610)."""
    name = next((node for node in reversed(site.path) if isinstance(node, ast.Name)), None)
    pou = next((node for node in reversed(site.path) if isinstance(node, ast.Pou)), None)
    symbol = name.symbol if name is not None else None
    if pou is None or not isinstance(symbol, VarSymbol) or symbol.type is None or not pou.blocks:
        return
    last = pou.blocks[-1].span
    text = f"VAR_EXTERNAL\n    {symbol.name} : {symbol.type};\nEND_VAR"
    edit = site.insert(last.end_line, last.end_column, f"\n{text}")
    yield site.action("addExternal", f"Declare '{symbol.name}' in VAR_EXTERNAL", edit, preferred=True,
                      name=symbol.name)  # fmt: skip

"""Mends of what is written wrongly: missing ends and signs, arrows, conversions, what is never used."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tappet.lang import ast
from tappet.lang.analysis.conversion import NUMBERS
from tappet.lang.lexer import ID
from tappet.lang.services.fix_site import Site, indent_of
from tappet.lang.services.results import CodeAction, Edit
from tappet.lang.source import Span
from tappet.lang.symbols import EnumValueSymbol
from tappet.lang.types import Enum

_INSERTED = frozenset([";", ":=", ":", ")", "]", "THEN", "DO", "OF", "TO", "END_VAR", ","])
_NUMBERS = frozenset(type_.name for type_ in NUMBERS)
_OPERATORS = re.compile(r"[-+*/<>=&\s]")


def missing_end(site: Site) -> Iterator[CodeAction]:
    """Insert the keyword that closes a construct (E0103), or put it in place of a wrong one (E0110)."""
    end = site.facts["end"]
    if site.diagnostic.code == "E0110":
        yield site.replacement(site.token_span(site.token), end)
        return
    indent = indent_of(site.lines[int(site.facts["opened"])])
    at = site.token
    lexed = site.lexed
    if at and lexed.lines[at - 1] == lexed.lines[at]:
        edit = site.insert(lexed.lines[at], lexed.columns[at], f"{end} ")
    else:
        edit = site.before_line(lexed.lines[at], f"{indent}{end}\n")
    yield site.insertion(edit, end)


def expected(site: Site) -> Iterator[CodeAction]:
    """Insert a sign or word that is missing, or write the right one in place of a wrong one (E0101)."""
    if site.facts.get("instead"):
        yield site.replacement(site.span, site.facts["instead"])
    wanted = site.facts.get("missing", "")
    if wanted not in _INSERTED:
        return
    span = site.span
    if site.facts.get("place") != "behind":
        if not site.token:
            return
        span = site.token_span(site.token - 1)
    text = wanted if not wanted[0].isalpha() and wanted != ":=" else f" {wanted}"
    yield site.insertion(site.insert(span.end_line, span.end_column, text), wanted)


def conversion(site: Site) -> Iterator[CodeAction]:
    """Wrap a value into the conversion that the message names (E0301, W1001..W1003)."""
    function = site.facts.get("function", "")
    if not function:
        return
    yield site.conversion(function)


def condition(site: Site) -> Iterator[CodeAction]:
    """Compare a number that stands as a condition with 0 (E0307)."""
    text = site.written
    if not text or site.facts["source"] not in _NUMBERS:
        return
    compared = f"({text}) <> 0" if _OPERATORS.search(text) else f"{text} <> 0"
    yield site.action(
        "compare", "Compare with 0", site.replace(site.span, compared), preferred=True, text=compared
    )


def equality(site: Site) -> Iterator[CodeAction]:
    """Make an assignment of a comparison that does nothing (W1108)."""
    level = 0
    for index in range(site.token, len(site.lexed.kinds)):
        kind = site.lexed.kinds[index]
        level += (kind in ("(", "[")) - (kind in (")", "]"))
        if kind == "=" and level == 0:
            yield site.replacement(site.token_span(index), ":=")
            return
        if kind == ";":
            return


def time_prefix(site: Site) -> Iterator[CodeAction]:
    """Write the `T#` of a duration (E0016)."""
    yield site.insertion(site.insert(site.span.line, site.span.column, "T#"), "T#")


def arrow(site: Site) -> Iterator[CodeAction]:
    """Turn `:=` into `=>` for an output and back for an input (E0510, E0511)."""
    wanted = "=>" if site.diagnostic.code == "E0510" else ":="
    if site.lexed.kinds[site.token + 1] in (":=", "=>"):
        yield site.replacement(site.token_span(site.token + 1), wanted)


def label(site: Site) -> Iterator[CodeAction]:
    """Remove a label that nothing jumps to (W1115)."""
    kinds = site.lexed.kinds
    if kinds[site.token] is ID and kinds[site.token + 1] == ":":
        following = site.token_span(site.token + 2)
        end = site.token_span(site.token + 1)
        until = following[:2] if following.line == end.line else end[2:]
        edit = site.replace(Span(site.span.line, site.span.column, *until), "")
        name = site.lexed.texts[site.token]
        yield site.action("removeLabel", f"Remove label '{name}'", edit, preferred=True, name=name)


def unused(site: Site) -> Iterator[CodeAction]:
    """Remove the declaration of a variable that is never used (W1103)."""
    name = site.lexed.texts[site.token]
    edit = removal(site, site.token)
    yield site.action("removeVariable", f"Remove variable '{name}'", edit, preferred=True, name=name)


def removal(site: Site, at: int) -> Edit:
    """The edit that takes the variable whose name is token `at` out of its declaration."""
    lexed = site.lexed
    kinds = lexed.kinds
    start = site.token_span(at)
    if kinds[at + 1] == ",":
        following = site.token_span(at + 2)
        return site.replace(Span(start.line, start.column, following.line, following.column), "")
    if at and kinds[at - 1] == ",":
        comma = site.token_span(at - 1)
        return site.replace(Span(comma.line, comma.column, start.end_line, start.end_column), "")
    end = at
    while kinds[end] not in (";", "END_VAR") and end < len(kinds) - 1:
        end += 1
    last = site.token_span(end if kinds[end] == ";" else end - 1)
    before = site.lines[start.line][: start.column].strip()
    next_line = lexed.lines[end + 1] if end + 1 < len(kinds) else len(site.lines)
    alone = not before and next_line > last.end_line
    if alone and last.end_line + 1 < len(site.lines):
        return site.replace(Span(start.line, 0, last.end_line + 1, 0), "")
    rest = site.lines[last.end_line][last.end_column :]
    blanks = len(rest) - len(rest.lstrip())
    return site.replace(Span(start.line, start.column, last.end_line, last.end_column + blanks), "")


def cases(site: Site) -> Iterator[CodeAction]:
    """Add the values of an enumeration that a CASE does not handle, or an ELSE (W1104)."""
    node = next((item for item in reversed(site.path) if isinstance(item, ast.Case)), None)
    if node is None or not isinstance(node.selector.type, Enum):
        return
    enum = node.selector.type
    taken: list[tuple[int, int]] = []
    for branch in node.branches:
        for selector in branch.selectors:
            low = selector.low.constant
            high = low if selector.high is None else selector.high.constant
            if isinstance(low, int) and isinstance(high, int):
                taken.append((low, high))
    missing = [name for name, value in enum.values.items() if not any(a <= value <= b for a, b in taken)]
    end = _end_of_case(site, node)
    if end is None:
        return
    place = site.token_span(end)
    outer = indent_of(site.lines[place.line])
    inner = outer + "    "
    qualified = False
    if node.branches:
        first = node.branches[0].span
        if not site.lines[first.line][: first.column].strip():
            inner = indent_of(site.lines[first.line])
        qualified = isinstance(node.branches[0].selectors[0].low, ast.Member)
    global_name = site.snapshot.analysis.scope.get(missing[0].upper()) if missing else None
    if not (isinstance(global_name, EnumValueSymbol) and global_name.type is enum):
        qualified = True
    prefix = f"{enum.name}." if qualified else ""
    own_line = not site.lines[place.line][: place.column].strip()

    def put(text: str) -> Edit:
        if own_line:
            return site.before_line(place.line, text)
        return site.insert(place.line, place.column, f"\n{text}{outer}")

    text = "".join(f"{inner}{prefix}{name}:\n{inner}    ;\n" for name in missing)
    names = ", ".join(missing)
    if missing:
        yield site.action("addCases", f"Add {names}", put(text), preferred=True, names=names)
    yield site.action("addElse", "Add ELSE", put(f"{outer}ELSE\n{outer}    ;\n"))


def _end_of_case(site: Site, node: ast.Case) -> int | None:
    """Index of the END_CASE of a CASE."""
    level = 0
    kinds = site.lexed.kinds
    for index in range(len(kinds)):
        if (site.lexed.lines[index], site.lexed.columns[index]) < node.span[:2]:
            continue
        level += (kinds[index] == "CASE") - (kinds[index] == "END_CASE")
        if kinds[index] == "END_CASE" and level == 0:
            return index
    return None

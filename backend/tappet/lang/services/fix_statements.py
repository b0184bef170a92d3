"""Mends of coding rules among statements: each leaves what the program does as it is."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import TypeVar

from tappet.lang import ast
from tappet.lang.analysis import carried_type
from tappet.lang.services.describe import slice_of
from tappet.lang.services.fix_site import Site, indent_of
from tappet.lang.services.results import CodeAction
from tappet.lang.source import Span
from tappet.lang.symbols import EnumValueSymbol, PouSymbol, VarSymbol
from tappet.lang.types import BOOL, Enum

_SIMPLE = (ast.Name, ast.Member, ast.Index, ast.Deref, ast.Call, ast.Literal)
"""Expressions that need no parentheses wherever they stand."""
_NEUTRAL: dict[str, object] = {"+": 0, "-": 0, "*": 1, "/": 1, "AND": True, "OR": False}
"""Constant with which an operation gives its other operand; of `-` and `/` it stands on the right."""
_Node = TypeVar("_Node", bound=ast.Node)


def else_branch(site: Site) -> Iterator[CodeAction]:
    """Add the empty ELSE of a CASE or of a chain of ELSIF (S1205, S1206)."""
    begin, end = ("CASE", "END_CASE") if site.diagnostic.code == "S1205" else ("IF", "END_IF")
    at = _end_of(site, begin, end)
    if at is None:
        return
    place = site.token_span(at)
    line = site.lines[place.line]
    outer = indent_of(line)
    text = f"{outer}ELSE\n{outer}    ;\n"
    own_line = not line[: place.column].strip()
    edit = (
        site.before_line(place.line, text)
        if own_line
        else site.insert(place.line, place.column, f"\n{text}{outer}")
    )
    yield site.action("addElse", "Add ELSE", edit, preferred=True)


def _end_of(site: Site, begin: str, end: str) -> int | None:
    """Index of the keyword that closes what begins at the message."""
    level = 0
    for index in range(site.token, len(site.lexed.kinds)):
        kind = site.lexed.kinds[index]
        level += (kind == begin) - (kind == end)
        if kind == end and level == 0:
            return index
    return None


def needless_statement(site: Site) -> Iterator[CodeAction]:
    """Take away a ';' alone or a RETURN at the end (S1209, S1210)."""
    kinds = site.lexed.kinds
    begin = end = site.token
    while kinds[end] != ";" and end < len(kinds) - 1:
        end += 1
    if kinds[end] != ";" or end - begin > 1:
        return
    first, last = site.token_span(begin), site.token_span(end)
    line = site.lines[last.end_line]
    alone = not site.lines[first.line][: first.column].strip() and not line[last.end_column :].strip()
    if alone and first.line == last.line and last.line + 1 < len(site.lines):
        edit = site.replace(Span(first.line, 0, last.line + 1, 0), "")
    else:
        edit = site.replace(Span(*first[:2], *last[2:]), "")
    text = site.lexed.texts[begin]
    yield site.action("removeStatement", f"Remove '{text}'", edit, preferred=True, name=text)


def compared_with_bool(site: Site) -> Iterator[CodeAction]:
    """Write a BOOL instead of its comparison with TRUE or FALSE (S1212)."""
    node = _at(site, ast.Binary, lambda e: e.op in ("=", "<>"))
    if node is None:
        return
    for literal, other in ((node.left, node.right), (node.right, node.left)):
        if isinstance(literal, ast.Literal) and literal.kind == "bool" and other.type is BOOL:
            same = (literal.constant is True) == (node.op == "=")
            text = _operand(site, other)
            yield site.replacement(site.span, text if same else f"NOT {text}")
            return


def parentheses(site: Site) -> Iterator[CodeAction]:
    """Write the parentheses that hold anyway (S1216)."""
    node = _at(site, ast.Binary)
    if node is None:
        return
    edits = []
    for side, bare in (
        (node.left, node.left.span[:2] == node.span[:2]),
        (node.right, node.right.span[2:] == node.span[2:]),
    ):
        if isinstance(side, ast.Binary) and bare and {side.op, node.op} == {"AND", "OR"}:
            edits.append(site.insert(side.span.line, side.span.column, "("))
            edits.append(site.insert(side.span.end_line, side.span.end_column, ")"))
    if edits:
        yield site.action("parentheses", "Write the parentheses", *edits, preferred=True)


def explicit_conversion(site: Site) -> Iterator[CodeAction]:
    """Write the conversion that happens anyway (S1217). A result that is computed in a wider type than its
    own would be cut by it."""
    node = _at(site, ast.Expr)
    if node is None or carried_type(node) != node.type or site.facts["target"] == "BIT":
        return
    yield site.conversion(f"TO_{site.facts['target']}")


def condition_itself(site: Site) -> Iterator[CodeAction]:
    """Assign a condition instead of TRUE and FALSE in its branches (S1220)."""
    node = _at(site, ast.If)
    if node is None or node.otherwise is None or site.spoken(node.span):
        return
    condition, body = node.branches[0]
    one, other = body[0], node.otherwise[0]
    if not isinstance(one, ast.Assign) or not isinstance(other, ast.Assign) or one.label or other.label:
        return
    values = (one.value.constant, other.value.constant)
    if one.op != ":=" or other.op != ":=" or values[0] is values[1]:
        return
    target = slice_of(site.view.source, one.target.span)
    if values[0] is True:
        value = slice_of(site.view.source, condition.span)
    else:
        value = f"NOT {_operand(site, condition)}"
    yield site.action(
        "assignCondition",
        "Assign the condition itself",
        site.replace(node.span, f"{target} := {value};"),
        preferred=True,
    )


def qualified_value(site: Site) -> Iterator[CodeAction]:
    """Write a value of an enumeration with its type (S1223)."""
    node = _at(site, ast.Name)
    symbol = node.symbol if node is not None else None
    if isinstance(symbol, EnumValueSymbol) and isinstance(symbol.type, Enum) and symbol.type.decl is not None:
        yield site.replacement(site.span, f"{symbol.type.name}.{symbol.name}")


def neutral_operand(site: Site) -> Iterator[CodeAction]:
    """Take away an operand that changes nothing (S1227), where it is not one that decides the result."""
    node = _at(site, ast.Binary, lambda e: e.op in _NEUTRAL)
    if node is None:
        return
    sides = ((node.right, node.left), (node.left, node.right))
    for literal, other in sides[:1] if node.op in ("-", "/") else sides:
        constant, neutral = literal.constant, _NEUTRAL[node.op]
        fits = isinstance(literal, ast.Literal) and constant == neutral
        if fits and isinstance(constant, bool) == isinstance(neutral, bool) and other.type == node.type:
            yield site.replacement(site.span, _operand(site, other))
            return


def typed_literal(site: Site) -> Iterator[CodeAction]:
    """Write the type before a literal (S1242)."""
    node = _at(site, ast.Literal)
    if node is not None:
        yield site.replacement(site.span, f"{site.facts['type']}#{site.facts['text']}")


def one_path(site: Site) -> Iterator[CodeAction]:
    """Write the list or the library before a name, as other places do (S1423)."""
    node = _at(site, ast.Name)
    symbol = node.symbol if node is not None else None
    owner: str | None = None
    if isinstance(symbol, VarSymbol):
        owner = symbol.owner
    elif isinstance(symbol, PouSymbol) and symbol.source is not None:
        owner = symbol.source.namespace
    if owner and symbol is not None:
        yield site.replacement(site.span, f"{owner}.{symbol.name}")


def declared_spelling(site: Site) -> Iterator[CodeAction]:
    """Write a name as it is declared (S1007)."""
    declared = site.facts["declared"]
    span = site.span
    end = Span(span.end_line, span.end_column - len(declared), span.end_line, span.end_column)
    yield site.replacement(end, declared)


def _at(site: Site, kind: type[_Node], fits: Callable[[_Node], bool] = lambda node: True) -> _Node | None:
    """The node that the message is about."""
    for node in reversed(site.path):
        if isinstance(node, kind) and node.span == site.span and fits(node):
            return node
    return None


def _operand(site: Site, e: ast.Expr) -> str:
    """An operand as it can replace the operation that it was part of."""
    text = slice_of(site.view.source, e.span)
    return text if isinstance(e, _SIMPLE) else f"({text})"

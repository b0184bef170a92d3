"""What stands at a position: declaration, type, comment, value."""

from __future__ import annotations

from tappet.iec import literals
from tappet.lang import ast
from tappet.lang import types as t
from tappet.lang.analysis.scope import QualifiedSymbol
from tappet.lang.lexer import ID, INT, NUMBER, STRING
from tappet.lang.services import describe
from tappet.lang.services.cursor import token_at
from tappet.lang.services.documents import Position
from tappet.lang.services.occurrences import Occurrence, key_of, occurrence_at
from tappet.lang.services.operators import head_of
from tappet.lang.services.resolution import enum_values
from tappet.lang.services.results import Hover
from tappet.lang.services.workspace import Snapshot, View
from tappet.lang.source import Span
from tappet.lang.symbols import EnumValueSymbol, Symbol, TypeSymbol, VarSymbol
from tappet.translation.language import Language
from tappet.translation.library_comments import comment


def hover(snapshot: Snapshot, document: str, position: Position, language: Language = "en") -> Hover | None:
    """The explanation of what stands at a position of a document; None where there is nothing to say.

    Comments of libraries come in the language, where there are words for them.
    """
    view = snapshot.view(document, position)
    found = occurrence_at(snapshot, view.index, view.position)
    if found is not None:
        symbol = found.symbol or _declared_symbol(snapshot, found)
        if symbol is not None:
            return Hover(
                view.place(found.span).span,
                describe.code_of(snapshot, symbol, language),
                _prose(symbol, language),
            )
        if found.type is not None:
            return Hover(view.place(found.span).span, str(found.type))
    return _token_hover(view)


def _declared_symbol(snapshot: Snapshot, found: Occurrence) -> Symbol | None:
    """The symbol of a type or enumeration value whose declaration was found without one."""
    for symbol in snapshot.analysis.scope.values():
        meant = symbol.target if isinstance(symbol, QualifiedSymbol) else symbol
        if meant is not None and key_of(meant) == found.key:
            return meant
    return None


def _prose(symbol: Symbol, language: Language) -> str:
    text = describe.comment_of(symbol)
    if isinstance(symbol, EnumValueSymbol) and isinstance(symbol.type, t.Enum):
        value = enum_values(symbol.type).get(symbol.name.upper())
        text = value.comment if value is not None else text
    facts = [describe.in_language(text, symbol, language), describe.value_facts(symbol)]
    if isinstance(symbol, VarSymbol):
        block = symbol.type
        if isinstance(block, t.FunctionBlock) and block.pou is not None and block.pou.comment:
            facts.append(f"{block.name}: {_said(block.pou, language)}")
        elif isinstance(block, (t.Struct, t.Enum)) and block.decl is not None and block.decl.comment:
            facts.append(f"{block.name}: {_said(block.decl, language)}")
    if isinstance(symbol, TypeSymbol) and isinstance(symbol.type, t.Struct):
        facts.append(f"{symbol.type.size} bytes")
    home = describe.home_of(symbol)
    if home:
        facts.append(f"in {home}")
    return "\n\n".join(fact for fact in facts if fact)


def _said(node: ast.Pou | ast.TypeDecl, language: Language) -> str:
    """The comment of a type."""
    library = node.source.library if node.source is not None else None
    return comment(node.comment, library, language) if library else node.comment


def _token_hover(view: View) -> Hover | None:
    lexed = view.lexed
    index = token_at(lexed, view.position)
    if index is None:
        return None
    kind, text = lexed.kinds[index], lexed.texts[index]
    line, column = lexed.lines[index], lexed.columns[index]
    span = view.place(Span(line, column, line, column + len(text))).span
    if kind is NUMBER or kind is INT:
        return _literal_hover(text, span)
    if kind is not STRING and (kind is ID or lexed.kinds[index + 1] == "("):
        head = head_of(text)
        if head is not None and (kind is not ID or view.snapshot.analysis.scope.get(text.upper()) is None):
            return Hover(span, head[0], head[1])
    return None


def _literal_hover(text: str, span: Span) -> Hover | None:
    """A number in the bases it is not written in, a time in its units."""
    decoded = literals.decode(text)
    value = decoded.value
    if isinstance(value, bool) or not isinstance(value, int):
        return None
    if decoded.kind == "time":
        return Hover(span, describe.duration_text(value * 1_000_000), f"{value} ms")
    if decoded.kind == "ltime":
        return Hover(span, describe.duration_text(value, long=True), f"{value} ns")
    if decoded.kind == "int" and ("#" in text or value > 9):
        return Hover(
            span,
            str(value),
            f"16#{value & 0xFFFFFFFFFFFFFFFF:X} \N{MIDDLE DOT} 2#{value & 0xFFFFFFFFFFFFFFFF:b}",
        )
    return None

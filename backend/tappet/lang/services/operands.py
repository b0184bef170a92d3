"""What declarations say about the operands of a body: the columns beside them in the table of IL (IL-01)."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from tappet.lang.lexer import lex
from tappet.lang.services import describe
from tappet.lang.services.cursor import operand
from tappet.lang.services.resolution import Meaning, Scope, resolve, scope_at
from tappet.lang.services.workspace import View
from tappet.lang.source import Source
from tappet.lang.symbols import VarSymbol


@dataclass(frozen=True, slots=True)
class OperandFacts:
    """Type, address and comment from the declaration of an operand; '' where there is none."""

    type: str
    address: str
    comment: str


def facts(view: View, operands: Iterable[str]) -> Iterator[OperandFacts | None]:
    """The facts of each operand as written in the body around the view; None for what names no variable."""
    scope = scope_at(view)
    for text in operands:
        meaning = _meaning(scope, text)
        symbol = meaning.symbol
        if isinstance(symbol, VarSymbol):
            address = symbol.decl.address if symbol.decl is not None else None
            yield OperandFacts(describe.type_as_written(symbol), address or "", describe.comment_of(symbol))
        elif symbol is not None:
            yield OperandFacts(describe.short(symbol), "", describe.comment_of(symbol))
        elif meaning.type is not None:
            yield OperandFacts(str(meaning.type), "", "")
        else:
            yield None


def _meaning(scope: Scope, text: str) -> Meaning:
    lexed = lex(text, "")
    end = len(lexed.kinds) - 1  # END is no token
    return resolve(scope, operand(lexed, Source("", text), 0, end))

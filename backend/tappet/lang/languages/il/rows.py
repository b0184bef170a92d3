"""The parts of a row: its end, its operands and the path of a function."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from tappet.lang import ast
from tappet.lang.diagnostics import report
from tappet.lang.languages.il.network import Network
from tappet.lang.languages.il.operators import INSTRUCTIONS
from tappet.lang.lexer import END, ID, INT, NUMBER
from tappet.lang.parser_core import BODY_END
from tappet.lang.source import Span

if TYPE_CHECKING:
    from tappet.lang.parser_statements import StatementParser

PATHS: Final = (ast.Name, ast.Member, ast.Index, ast.Deref, ast.This, ast.Super)
"""Expressions that name a place."""
BODY_ENDS: Final = BODY_END - {"STRUCT", "UNION", "ELSE", "ELSIF", "UNTIL", "__CATCH", "__FINALLY", "END_VAR"}
"""Tokens at which a body of IL ends; the keywords of statements are faulty rows."""
_NUMBERS: Final = (INT, NUMBER)


class RowReader:
    """Reads what stands in a row."""

    def __init__(self, parser: StatementParser) -> None:
        self.p = parser
        self.net = Network()

    def at_row_end(self) -> bool:
        """Whether the row ends before the next token."""
        p = self.p
        return p.kinds[p.i] in BODY_ENDS or p.lines[p.i] != p.lines[p.i - 1]

    def skip_row(self) -> None:
        """Leave out what remains of a faulty row, its parameter list included."""
        p = self.p
        while not self.at_row_end():
            p.i += 1

    def fault(self, code: str, span: Span, **fields: object) -> None:
        """Report with the number of the network and of the row (IL-60)."""
        p = self.p
        p.failed_at = p.i
        if p.i in p.lexed.damaged or (p.kinds[p.i] is END and p.lexed.unclosed_comment):
            return
        place = {"network": self.net.number, "row": self.net.row}
        p.diagnostics.append(report(code, p.source.uri, span, **place, **fields))

    def path(self) -> ast.Expr:
        """`name`, `instance.method`, `THIS^.method`: an operand without its parentheses."""
        p = self.p
        start = p.i
        if p.kinds[start] is ID:
            p.i += 1
            found: ast.Expr = ast.Name(span=p.span_at(start), name=p.texts[start])
        else:
            found = p.other_operand(start, p.kinds[start])
        while p.kinds[p.i] in (".", "[", "^") and not self.at_row_end():
            found = p.postfix(found, start)
        return found

    def is_formal(self) -> bool:
        """Whether the `(` here opens a list of named parameters, or an empty one."""
        p = self.p
        kinds, i = p.kinds, p.i + 1
        if kinds[i] == ")":
            return True
        return kinds[i] is not END and kinds[i + 1] in (":=", "=>")

    def at_separate_modifier(self) -> bool:
        """Whether `N,(` stands here, as in `XOR N,(a, b)` (fbd_ld_il.md 5, note 3)."""
        p = self.p
        return p.texts[p.i].upper() == "N" and p.kinds[p.i + 1] == "," and p.kinds[p.i + 2] == "("

    # -- operands

    def operands(self, name: str) -> list[ast.Expr]:
        """One operand, or several separated by commas; a comma at the end of the row continues (IL-11)."""
        first = self.operand(name)
        if first is None:
            return []
        found = [first]
        p = self.p
        while p.kinds[p.i] == "," and p.lines[p.i] == p.lines[p.i - 1]:
            p.i += 1
            following = self.operand(name, next_row=True)
            if following is None:
                break
            found.append(following)
        return found

    def operand(self, name: str, next_row: bool = False) -> ast.Expr | None:
        """A variable or a literal; None after a message."""
        p = self.p
        missing = p.kinds[p.i] in BODY_ENDS or (self.at_row_end() and not next_row)
        if missing or (next_row and self.at_row_end() and self.begins_instruction()):
            at = p.span_at(p.i - 1)
            self.fault("E0120", at, op=name, what="an operand")
            return None
        kind = p.kinds[p.i]
        start = p.i
        if kind in ("-", "+") and p.kinds[start + 1] in _NUMBERS:
            p.i += 1
            literal = p.operand()
            return ast.Unary(span=p.span_from(start), op=kind, operand=literal)
        if kind in ("-", "+", "NOT", "("):
            self.fault("E0124", p.span_at(start))
            return None
        found = p.operand()
        if isinstance(found, ast.Call):
            self.fault("E0124", found.span)
        return None if isinstance(found, (ast.ErrorExpr, ast.Call)) else found

    def begins_instruction(self) -> bool:
        """Whether an operator with an operand stands here, where an operand was to come."""
        p = self.p
        i = p.i
        known = p.texts[i].upper() in INSTRUCTIONS
        return known and p.lines[i + 1] == p.lines[i] and p.kinds[i + 1] not in (",", ".")

    def check_arguments(self, call: ast.Call) -> None:
        """Actual values are single operands (IL-14)."""
        for argument in call.args:
            if argument.value is not None and not is_operand(argument.value):
                self.fault("E0124", argument.value.span)

    def called(
        self, callee: ast.Expr, accumulator: ast.Expr | None, operands: list[ast.Expr], row: Span
    ) -> ast.Call:
        """The call of a function with the accumulator before the operands."""
        args = [ast.Argument(span=operand.span, name=None, value=operand) for operand in operands]
        first = None
        if accumulator is not None:
            first = ast.Argument(span=accumulator.span, name=None, value=accumulator)
            args.insert(0, first)
            row = accumulator.span.to(row) if accumulator.span[:2] < row[:2] else row
        return ast.Call(span=row, callee=callee, args=args, accumulator=first)


def is_operand(e: ast.Expr) -> bool:
    """A variable, a literal, or what the parser has reported."""
    if isinstance(e, ast.Unary):
        return e.op != "NOT" and isinstance(e.operand, ast.Literal)
    return isinstance(e, (*PATHS, ast.Literal, ast.ErrorExpr))


def has_index(e: ast.Expr) -> bool:
    """Whether a path has an index, which may be out of range."""
    while isinstance(e, (ast.Member, ast.Deref)):
        e = e.base
    return isinstance(e, ast.Index)

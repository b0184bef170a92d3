"""What is done where no statement stands: stray ends, missing `;` and keywords, excessive nesting."""

from __future__ import annotations

from typing import Final

from tappet.iec.words import ENDS
from tappet.lang import ast
from tappet.lang.lexer import END, ID
from tappet.lang.parser_core import BODY_END, COMPOUND, MAX_NESTING, STATEMENT_KEYWORDS
from tappet.lang.parser_expressions import ExpressionParser

_OPENED_BY: Final = {end: begin for begin, end in ENDS.items()}
_STATEMENT_ENDS: Final = frozenset(ENDS[word] for word in COMPOUND)
_BRANCH_OWNERS: Final = {
    "ELSE": ("IF", "CASE"),
    "ELSIF": ("IF",),
    "UNTIL": ("REPEAT",),
    "__CATCH": ("__TRY",),
    "__FINALLY": ("__TRY",),
}
"""Keywords that begin a further part of a statement, and the statements they belong to."""
_WRONG_BEGIN: Final = {
    "THEN": "THEN belongs to IF or ELSIF.",
    "DO": "DO belongs to FOR or WHILE.",
    "OF": "OF belongs to CASE.",
    ")": "Remove it or write the '(' it closes.",
    "]": "Remove it or write the '[' it closes.",
    ":=": "Write a variable before ':='.",
    "=": "Write the variable, and ':=' to assign.",
}


class StatementRecovery(ExpressionParser):
    """Finds the way back to the next statement."""

    __slots__ = ()

    def stray_end(self, kind: str) -> bool:
        """Step over an end or branch keyword that no open construct waits for, and report it."""
        if kind in _STATEMENT_ENDS:
            begin = _OPENED_BY[kind]
            if any(opener == begin for opener, _ in self.open):
                return False
            if self.orphan_ends:
                self.orphan_ends -= 1
            elif self.open and ENDS[self.open[-1][0]] in _STATEMENT_ENDS:
                return False  # `close` reports that the wrong end was written
            else:
                self.error("E0106", found=kind, hint=f"Remove it or write the {begin} it closes.")
        elif kind in _BRANCH_OWNERS:
            owners = _BRANCH_OWNERS[kind]
            if any(opener in owners for opener, _ in self.open):
                return False
            if not self.orphan_ends:
                self.error("E0106", found=kind, hint=f"{kind} belongs to {' or '.join(owners)}.")
                self.orphan_ends += 1
            if kind == "ELSIF" or kind == "UNTIL":
                self.i += 1
                self.expression()
                if self.kinds[self.i] == "THEN":
                    self.i += 1
                return True
        elif kind == "END_VAR":
            self.error("E0106", found=kind, hint="Remove it or write the VAR it closes.")
        else:
            return False
        self.i += 1
        if self.kinds[self.i] == ";":
            self.i += 1
        return True

    def end_of_statement(self, messages_before: int) -> None:
        """Take the `;`. After an error in the statement, skip its rest without a further message."""
        kinds = self.kinds
        if kinds[self.i] == ";":
            self.i += 1
            return
        if len(self.diagnostics) > messages_before or self.failed_at == self.i:
            self.skip_statement()
            return
        self.missing(";", self._semicolon_hint())
        kind = kinds[self.i]
        begins = kind is ID and kinds[self.i + 1] in (":=", "(", ".", "[", "^")
        if not (begins or kind in BODY_END or kind in STATEMENT_KEYWORDS):
            self.skip_statement()

    def _semicolon_hint(self) -> str:
        kind = self.kinds[self.i]
        if kind == ":":
            return "Assignment is ':='; a label stands alone before ':'."
        if kind in (")", "]"):
            return "Remove it or write the opening bracket."
        if kind is ID and self.texts[self.i].upper() in ("S", "R", "REF"):
            return "Write ':=', 'S=', 'R=' or 'REF='."
        return "End the statement with ';'."

    def no_statement(self, start: int, failed_before: int, messages_before: int) -> ast.Stmt:
        """Nothing at `start` begins a statement: say so in place of the message about an expression."""
        del self.diagnostics[messages_before:]
        self.failed_at = failed_before
        kind = self.kinds[start]
        hint = _WRONG_BEGIN.get(kind, "Write a variable, a call or a keyword such as IF.")
        self.error("E0102", found=self.found(), hint=hint)
        self.i = start if kind in ("THEN", "DO", "OF") else start + 1
        self.skip_statement()
        return ast.Empty(span=self.span_at(start))

    def nested_too_deep(self, start: int) -> ast.Stmt:
        """Report excessive nesting and leave the statement out, with all that is in it."""
        self.error("E0107", what="statement", limit=MAX_NESTING)
        level = 0
        kinds = self.kinds
        i = start
        while kinds[i] is not END:
            kind = kinds[i]
            if kind in COMPOUND:
                level += 1
            elif kind in _STATEMENT_ENDS:
                level -= 1
                if level == 0:
                    i += 1
                    break
            elif kind in BODY_END and kind not in _BRANCH_OWNERS:
                break
            i += 1
        self.i = self.failed_at = i
        if kinds[i] == ";":
            self.i += 1
        return ast.Empty(span=self.span_from(start))

    def head_end(self, keyword: str) -> None:
        """Take THEN, DO or OF; after an error go to it if it stands before the next statement."""
        if self.kinds[self.i] == keyword:
            self.i += 1
            return
        self.missing(keyword)
        kinds = self.kinds
        i = self.i
        if kinds[i] is ID and self.lines[i] == self.lines[i - 1] != self.lines[i + 1]:
            self.i = i + 1  # a misspelt keyword at the end of the line
            return
        line = self.lines[i]
        while kinds[i] not in BODY_END and kinds[i] != ";" and self.lines[i] == line:
            if kinds[i] == keyword:
                self.i = i + 1
                return
            if kinds[i] in STATEMENT_KEYWORDS or kinds[i + 1] == ":=":
                return
            i += 1

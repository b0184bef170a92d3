"""Statements of ST and extended ST (spec LST-20..LST-45)."""

from __future__ import annotations

from collections.abc import Callable
from typing import Final

from tappet.iec.words import OBJECT_HEADS, SECTIONS
from tappet.lang import ast
from tappet.lang.lexer import ID, INT, NUMBER, STRING
from tappet.lang.parser_core import BODY_END, MAX_NESTING
from tappet.lang.parser_recovery import StatementRecovery

_LABEL_PARTS: Final = frozenset(
    [ID, INT, NUMBER, STRING, ".", ",", "..", "-", "+", "*", "(", ")", "TRUE", "FALSE"]
)
_LITERAL_HEADS: Final = frozenset([INT, NUMBER, STRING, "-", "+", "TRUE", "FALSE"])
"""These begin no statement, so in a CASE they begin a label."""
_OWN_PRAGMAS: Final = OBJECT_HEADS | SECTIONS
"""What a pragma above it belongs to; it is no statement there."""
MAX_BRANCHES: Final = 1000
"""Branches of one IF; each ELSIF is nested in the one before when code is made."""


class StatementParser(StatementRecovery):
    """Reads lists of statements."""

    __slots__ = ()

    def statements(self, in_case: bool = False) -> list[ast.Stmt]:
        """Statements up to a keyword that ends the list, or (in a CASE) up to the next label."""
        out: list[ast.Stmt] = []
        kinds = self.kinds
        trivia = self.trivia
        append = out.append
        while True:
            start = self.i
            kind = kinds[start]
            if start in trivia and kind not in _OWN_PRAGMAS:
                for pragma in self.pragmas_before(start):
                    append(ast.PragmaStmt(span=pragma.span, pragma=pragma))
            if kind in BODY_END:
                if self.stray_end(kind):
                    continue
                return out
            if in_case and (kind in _LITERAL_HEADS or ((kind is ID or kind == "(") and self.at_case_label())):
                return out
            append(self.statement(start, kind))

    def statement(self, start: int, kind: str) -> ast.Stmt:
        """One statement with its `;`."""
        handler = _HANDLERS.get(kind)
        if handler is not None:
            if len(self.open) >= MAX_NESTING:
                return self.nested_too_deep(start)
            return handler(self, start)
        kinds = self.kinds
        if kind is ID and kinds[start + 1] == ":":
            return self.labelled(start)
        failed_before = self.failed_at
        messages_before = len(self.diagnostics)
        target = self.binary(0)
        operator = None
        if kinds[self.i] == ":=" or kinds[self.i] is ID:
            operator = self.assignment_operator()
        elif kinds[self.i] == "?=":
            operator = "?="
            self.i += 1
        target = self.bounded(target, start)
        if operator is not None:
            value = self.expression()
            if kinds[self.i] == ";":
                self.i += 1
                return ast.Assign(span=self.span_from(start), op=operator, target=target, value=value)
            result: ast.Stmt = ast.Assign(span=self.span_from(start), op=operator, target=target, value=value)
        else:
            if isinstance(target, ast.Call):
                result = ast.CallStmt(span=target.span, call=target)
            elif self.i == start:
                return self.no_statement(start, failed_before, messages_before)
            else:
                result = ast.ExprStmt(span=target.span, expr=target)
        self.end_of_statement(messages_before)
        result.span = self.span_from(start)
        return result

    def labelled(self, start: int) -> ast.Stmt:
        """`label: statement`; the label of nothing is put on an empty statement."""
        name = self.texts[start]
        self.i = start + 2
        kind = self.kinds[self.i]
        labels_another = kind is ID and self.kinds[self.i + 1] == ":"
        if kind in BODY_END or labels_another or self.pragmas_before(self.i):
            return ast.Empty(span=self.span_from(start), label=name)
        result = self.statement(self.i, kind)
        result.label = name
        result.span = self.span_from(start)
        return result

    # -- compound statements

    def if_statement(self, start: int) -> ast.Stmt:
        """IF condition THEN ... ELSIF ... ELSE ... END_IF."""
        opener = ("IF", self.lines[start])
        self.open.append(opener)
        self.i = start + 1
        branches: list[tuple[ast.Expr, list[ast.Stmt]]] = []
        otherwise: list[ast.Stmt] | None = None
        while True:
            condition = self.expression()
            self.head_end("THEN")
            branches.append((condition, self.statements()))
            if self.kinds[self.i] != "ELSIF":
                break
            if len(branches) == MAX_BRANCHES:
                self.error("E0107", what="chain of ELSIF", limit=MAX_BRANCHES)
            self.i += 1
        while self.kinds[self.i] in ("ELSE", "ELSIF"):
            if self.kinds[self.i] == "ELSE" and otherwise is None:
                self.i += 1
                otherwise = self.statements()
            else:
                self.error(
                    "E0106",
                    found=self.kinds[self.i],
                    hint="ELSE is the last branch of an IF and stands once.",
                )
                if self.kinds[self.i] == "ELSIF":
                    self.i += 1
                    self.expression()
                    self.head_end("THEN")
                else:
                    self.i += 1
                otherwise = (otherwise or []) + self.statements()
        self.open.pop()
        self.close(opener)
        self.optional_semicolon()
        return ast.If(span=self.span_from(start), branches=branches, otherwise=otherwise)

    def optional_semicolon(self) -> None:
        """The `;` behind an END_ keyword may be left out."""
        if self.kinds[self.i] == ";":
            self.i += 1

    def case_statement(self, start: int) -> ast.Stmt:
        """CASE selector OF labels: ... ELSE ... END_CASE."""
        opener = ("CASE", self.lines[start])
        self.open.append(opener)
        self.i = start + 1
        selector = self.expression()
        self.head_end("OF")
        branches: list[ast.CaseBranch] = []
        otherwise: list[ast.Stmt] | None = None
        leading = self.statements(in_case=True)
        code = next((item for item in leading if not isinstance(item, (ast.PragmaStmt, ast.Empty))), None)
        if code is not None:
            self.failed_at = -1
            self.error("E0101", code.span, expected="A label with ':'", found="the first statement",
                       hint="Write the values that select the statements, and ':'.")  # fmt: skip
        if leading:
            branches.append(ast.CaseBranch(span=leading[0].span, selectors=[], body=leading))
        while True:
            kind = self.kinds[self.i]
            if kind == "ELSE" and otherwise is None:
                self.i += 1
                self.optional_colon()
                otherwise = self.statements()
            elif kind == "ELSE" or kind == "ELSIF":
                self.error("E0106", found=kind, hint="ELSE is the last branch of a CASE and stands once.")
                self.i += 1
                otherwise = (otherwise or []) + self.statements()
            elif (kind is ID or kind == "(" or kind in _LITERAL_HEADS) and otherwise is None:
                branches.append(self.case_branch())
            else:
                break
        self.open.pop()
        self.close(opener)
        self.optional_semicolon()
        return ast.Case(span=self.span_from(start), selector=selector, branches=branches, otherwise=otherwise)

    def optional_colon(self) -> None:
        """`ELSE:` is written by some although the colon means nothing."""
        if self.kinds[self.i] == ":":
            self.error("E0101", expected="A statement", found="':'", hint="Remove the ':' behind ELSE.")
            self.i += 1

    def at_case_label(self) -> bool:
        """Whether a list of constants and a ':' stand here. Looks at no token twice without success."""
        i = self.i
        if i < self.label_scan_end:
            return False
        kinds = self.kinds
        kind = kinds[i]
        if kind is ID and kinds[i + 1] not in (":", ",", "..", ".", "+", "-", "*", "("):
            return False
        level = 0
        while True:
            kind = kinds[i]
            if kind == ":" and level == 0:
                return True
            if kind == "(":
                level += 1
            elif kind == ")":
                level -= 1
            if kind not in _LABEL_PARTS or level < 0:
                break
            i += 1
        self.label_scan_end = i
        return False

    def case_branch(self) -> ast.CaseBranch:
        """`value, low..high: statements`."""
        start = self.i
        selectors = [self.case_range()]
        while self.kinds[self.i] == ",":
            self.i += 1
            selectors.append(self.case_range())
        self.take(":", hint="Write ':' behind the values of a CASE branch.")
        body = self.statements(in_case=True)
        return ast.CaseBranch(span=self.span_from(start), selectors=selectors, body=body)

    def case_range(self) -> ast.CaseRange:
        """One value, or `low..high`."""
        start = self.i
        low = self.bounded(self.binary(0), start)
        high = None
        if self.kinds[self.i] == "..":
            self.i += 1
            high = self.bounded(self.binary(0), start)
        return ast.CaseRange(span=self.span_from(start), low=low, high=high)

    def for_statement(self, start: int) -> ast.Stmt:
        """FOR variable := start TO stop BY step DO ... END_FOR."""
        opener = ("FOR", self.lines[start])
        self.open.append(opener)
        self.i = start + 1
        variable = self.bounded(self.operand(), start)
        self.take(":=", hint="Write FOR variable := start TO stop DO.")
        first = self.expression()
        self.take("TO")
        last = self.expression()
        step = None
        if self.word() == "BY":
            self.i += 1
            step = self.expression()
        self.head_end("DO")
        body = self.statements()
        self.open.pop()
        self.close(opener)
        self.optional_semicolon()
        return ast.For(
            span=self.span_from(start), variable=variable, start=first, stop=last, step=step, body=body
        )

    def while_statement(self, start: int) -> ast.Stmt:
        """WHILE condition DO ... END_WHILE."""
        opener = ("WHILE", self.lines[start])
        self.open.append(opener)
        self.i = start + 1
        condition = self.expression()
        self.head_end("DO")
        body = self.statements()
        self.open.pop()
        self.close(opener)
        self.optional_semicolon()
        return ast.While(span=self.span_from(start), condition=condition, body=body)

    def repeat_statement(self, start: int) -> ast.Stmt:
        """REPEAT ... UNTIL condition END_REPEAT."""
        opener = ("REPEAT", self.lines[start])
        self.open.append(opener)
        self.i = start + 1
        body = self.statements()
        self.open.pop()
        condition: ast.Expr
        if self.take("UNTIL", f"UNTIL for the REPEAT of line {opener[1] + 1}"):
            condition = self.expression()
            self.optional_semicolon()
        else:
            condition = ast.ErrorExpr(span=self.span_at(self.i))
        self.close(opener)
        self.optional_semicolon()
        return ast.RepeatUntil(span=self.span_from(start), body=body, condition=condition)

    def try_statement(self, start: int) -> ast.Stmt:
        """__TRY ... __CATCH(variable) ... __FINALLY ... __ENDTRY."""
        opener = ("__TRY", self.lines[start])
        self.open.append(opener)
        self.i = start + 1
        body = self.statements()
        exception: ast.Expr | None = None
        handler: list[ast.Stmt] = []
        final: list[ast.Stmt] = []
        caught = self.kinds[self.i] == "__CATCH"
        if caught:
            self.i += 1
            if self.kinds[self.i] == "(":
                self.i += 1
                if self.kinds[self.i] != ")":
                    exception = self.expression()
                self.take(")")
            handler = self.statements()
        if self.kinds[self.i] == "__FINALLY":
            self.i += 1
            final = self.statements()
        self.open.pop()
        self.close(opener)
        self.optional_semicolon()
        return ast.Try(
            span=self.span_from(start),
            body=body,
            caught=caught,
            exception=exception,
            handler=handler,
            final=final,
        )

    # -- simple statements

    def word_statement(self, start: int) -> ast.Stmt:
        """EXIT, CONTINUE or RETURN; `RETURN(condition)` returns when the condition holds."""
        self.i = start + 1
        if self.kinds[start] == "RETURN" and self.kinds[self.i] == "(":
            return self.conditional_return(start)
        self.end_of_statement(len(self.diagnostics))
        return _WORD_NODES[self.kinds[start]](span=self.span_from(start))

    def conditional_return(self, start: int) -> ast.Stmt:
        """`RETURN(condition);` is `IF condition THEN RETURN; END_IF`."""
        messages = len(self.diagnostics)
        condition = self.expression()
        leave = ast.Return(span=self.span_at(start))
        self.end_of_statement(messages)
        return ast.If(span=self.span_from(start), branches=[(condition, [leave])])

    def jump_statement(self, start: int) -> ast.Stmt:
        """JMP label."""
        self.i = start + 1
        messages = len(self.diagnostics)
        target, place = self.name("label", "Write JMP and the label to go to.")
        self.end_of_statement(messages)
        return ast.Jump(span=self.span_from(start), target=target, target_span=place)

    def empty_statement(self, start: int) -> ast.Stmt:
        """A lone `;`."""
        self.i = start + 1
        return ast.Empty(span=self.span_at(start))


_WORD_NODES: Final[dict[str, type[ast.Exit | ast.Continue | ast.Return]]] = {
    "EXIT": ast.Exit,
    "CONTINUE": ast.Continue,
    "RETURN": ast.Return,
}
_HANDLERS: Final[dict[str, Callable[[StatementParser, int], ast.Stmt]]] = {
    "IF": StatementParser.if_statement,
    "CASE": StatementParser.case_statement,
    "FOR": StatementParser.for_statement,
    "WHILE": StatementParser.while_statement,
    "REPEAT": StatementParser.repeat_statement,
    "__TRY": StatementParser.try_statement,
    "EXIT": StatementParser.word_statement,
    "CONTINUE": StatementParser.word_statement,
    "RETURN": StatementParser.word_statement,
    "JMP": StatementParser.jump_statement,
    ";": StatementParser.empty_statement,
}

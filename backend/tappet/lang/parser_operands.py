"""Operands of expressions: literals, variables with their members and indices, calls, parentheses."""

from __future__ import annotations

from abc import abstractmethod
from typing import Final

from tappet.iec import literals
from tappet.iec.words import WORD_OPERATORS
from tappet.lang import ast
from tappet.lang.diagnostics import report
from tappet.lang.lexer import ADDRESS, END, ID, INT, NUMBER, STRING
from tappet.lang.parser_arguments import ArgumentParser
from tappet.lang.parser_core import BODY_END, MAX_NESTING, make_span
from tappet.lang.source import Span

_POSTFIX: Final = frozenset([".", "[", "(", "^"])
_CALLABLE_OPERATORS: Final = frozenset(WORD_OPERATORS) - {"NOT"}
_HINTS: Final = {
    "=": "Comparison is '=', assignment is ':='.",
    "THEN": "Write a condition before THEN.",
    "DO": "Write a value before DO.",
    "OF": "Write a selector before OF.",
    ":=": "Write a variable before ':='.",
}
_ASSIGNING: Final = frozenset(["+", "-", "*", "/", "&"])
"""Operators that other languages join with '='."""


class OperandParser(ArgumentParser):
    """Reads operands; `i` stands behind them afterwards."""

    __slots__ = ()

    @abstractmethod
    def type_reference(self, what: str = "type") -> ast.TypeRef:
        """A type; see `parser_types`."""

    def operand(self) -> ast.Expr:
        """A literal, a variable with its members and indices, a call, or an expression in parentheses."""
        start = self.i
        kind = self.kinds[start]
        result: ast.Expr
        if kind is ID:
            text = self.texts[start]
            line, column = self.lines[start], self.columns[start]
            self.i = start + 1
            result = ast.Name(span=make_span((line, column, line, column + len(text))), name=text)
        elif kind is INT or kind is NUMBER or kind is STRING:
            return self.literal()
        else:
            result = self.other_operand(start, kind)
        while self.kinds[self.i] in _POSTFIX:
            result = self.postfix(result, start)
        return result

    def postfix(self, base: ast.Expr, start: int) -> ast.Expr:
        """One `.member`, `[index]`, `^` or `(arguments)` behind `base`."""
        i = self.i
        kind = self.kinds[i]
        if kind == ".":
            self.i = i + 1
            name, name_span = self.member_name()
            return ast.Member(span=self.span_from(start), base=base, name=name, name_span=name_span)
        if kind == "(":
            args = self.arguments(of_call=True)
            return ast.Call(span=self.span_from(start), callee=base, args=args)
        if kind == "^":
            self.i = i + 1
            return ast.Deref(span=self.span_from(start), base=base)
        self.i = i + 1
        if self.depth >= MAX_NESTING:
            return self.too_deep()
        self.depth += 1
        indices = [self.expression()]
        while self.kinds[self.i] == ",":
            self.i += 1
            indices.append(self.expression())
        self.depth -= 1
        self.take("]")
        return ast.Index(span=self.span_from(start), base=base, indices=indices)

    def member_name(self) -> tuple[str, Span]:
        """The name behind a dot: also a bit number or a keyword, which can mean nothing else there."""
        i = self.i
        kind = self.kinds[i]
        text = self.texts[i]
        if kind is ID or kind is INT:
            self.i = i + 1
            return text, self.span_at(i)
        if (
            kind is not END
            and text.upper() == kind
            and text[0].isalpha()
            and self._is_member_keyword(i, kind)
        ):
            self.i = i + 1
            return text, self.span_at(i)
        if kind is ADDRESS and text.upper().startswith("%X") and text[2:].isdigit():
            self.i = i + 1  # `.%X3`, the IEC form of `.3`
            return text[2:], self.span_at(i)
        self.error(
            "E0109", what="The name of a member", found=self.found(), hint="Write the member behind the dot."
        )
        return "", self.span_at(i - 1)

    def _is_member_keyword(self, i: int, kind: str) -> bool:
        """A keyword behind a dot is a member unless it stands on the next line or ends the statement."""
        if self.lines[i] != self.lines[i - 1]:
            return False
        return kind not in BODY_END or self.kinds[i + 1] in (":=", ";", ".", "(", ")", "[", ",", "^")

    def other_operand(self, start: int, kind: str) -> ast.Expr:
        """Operands that begin with neither a name nor a literal."""
        self.i = start + 1
        if kind == "(":
            return self.parenthesised(start)
        if kind == "TRUE" or kind == "FALSE":
            return ast.Literal(
                span=self.span_at(start), text=self.texts[start], kind="bool", value=kind == "TRUE"
            )
        if kind is ADDRESS:
            return ast.Name(span=self.span_at(start), name=self.texts[start].upper())
        if kind == "." and self.kinds[start + 1] is ID:
            self.i = start + 2
            return ast.Name(span=self.span_from(start), name=self.texts[start + 1], leading_dot=True)
        if kind == "THIS":
            return ast.This(span=self.span_at(start))
        if kind == "SUPER":
            return ast.Super(span=self.span_at(start))
        if kind in _CALLABLE_OPERATORS and self.kinds[self.i] == "(":
            return ast.Name(span=self.span_at(start), name=kind)
        self.i = start
        if kind == "[":
            return self.array_initial()
        if kind == "POINTER" and self.kinds[start + 1] == "TO":
            ref = self.type_reference()
            return ast.TypeOperand(span=self.span_from(start), ref=ref)
        return self.missing_expression()

    def missing_expression(self) -> ast.Expr:
        """Report that an operand is missing here; takes nothing."""
        self.error("E0104", found=self.found(), hint=self._operand_hint())
        return ast.ErrorExpr(span=self.span_at(self.i))

    def _operand_hint(self) -> str:
        """What was meant where an operand is missing: maybe an operator of another language."""
        kind, before = self.kinds[self.i], self.kinds[self.i - 1]
        if kind == "=" and before in _ASSIGNING:
            return f"There is no '{before}='; write x := x {before} y."
        if before in ("+", "-") and before == self.kinds[self.i - 2]:
            return f"There is no '{before}{before}'; write x := x {before} 1."
        return _HINTS.get(kind, "Write a value or a variable.")

    def literal(self) -> ast.Expr:
        """A literal other than TRUE, FALSE and NULL; `Type#value` is the member of an enumeration."""
        i = self.i
        self.i = i + 1
        text = self.texts[i]
        line, column = self.lines[i], self.columns[i]
        span = make_span((line, column, line, column + len(text)))
        if self.kinds[i] is INT and len(text) < 19:
            return ast.Literal(span=span, text=text, kind="int", value=int(text))
        unclosed = self.kinds[i] is STRING and self._unclosed(span)
        if unclosed:
            text = text.rstrip("$") + text[0]
        decoded = literals.decode(text)
        if decoded.kind == "enum":
            prefix, _, name = text.partition("#")
            at = column + len(prefix)
            base = ast.Name(span=Span(line, column, line, at), name=prefix)
            return ast.Member(
                span=span, base=base, name=name, name_span=Span(line, at + 1, line, column + len(text))
            )
        problem = decoded.problem
        if problem and not unclosed:
            self.diagnostics.append(report(problem, self.source.uri, span, **decoded.fields))
        return ast.Literal(
            span=span, text=text, kind=decoded.kind, prefix=decoded.prefix, value=decoded.value
        )

    def _unclosed(self, span: Span) -> bool:
        return any(item.span[:2] == span[:2] for item in self.lexed.diagnostics)

    def parenthesised(self, start: int) -> ast.Expr:
        """`(expression)`, or `(a := 1, b := 2)` for a structure; the `(` is taken."""
        if self.depth >= MAX_NESTING:
            return self.too_deep()
        self.depth += 1
        inner = self.expression()
        structure = isinstance(inner, ast.AssignExpr) and isinstance(inner.target, ast.Name)
        if self.kinds[self.i] == "," and structure:
            assert isinstance(inner, ast.AssignExpr)
            assert isinstance(inner.target, ast.Name)
            entries = [ast.Argument(span=inner.span, name=inner.target.name, value=inner.value)]
            while self.kinds[self.i] == ",":
                self.i += 1
                entries.append(self.argument())
            self.take(")")
            inner = ast.StructInit(span=self.span_from(start), fields=entries)
        else:
            self.take(")")
        self.depth -= 1
        return inner

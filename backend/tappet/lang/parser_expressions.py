"""Expressions: assignments and operators by precedence (spec LST-04)."""

from __future__ import annotations

from dataclasses import fields
from typing import Final

from tappet.lang import ast
from tappet.lang.diagnostics import report
from tappet.lang.lexer import ID
from tappet.lang.parser_core import MAX_NESTING, MAX_TREE_DEPTH, make_span
from tappet.lang.parser_operands import OperandParser

_PRECEDENCE: Final = {
    "OR": 1, "OR_ELSE": 1,
    "XOR": 2,
    "AND": 3, "&": 3, "AND_THEN": 3,
    "=": 4, "<>": 4,
    "<": 5, ">": 5, "<=": 5, ">=": 5,
    "+": 6, "-": 6,
    "*": 7, "/": 7, "MOD": 7,
}  # fmt: skip
_SET_OPERATORS: Final = frozenset(["S", "R", "REF"])
_DEEP_TOKENS: Final = 2 * MAX_TREE_DEPTH
"""An expression of fewer tokens cannot be too deep."""


class ExpressionParser(OperandParser):
    """Reads expressions; `i` stands behind them afterwards."""

    __slots__ = ()

    def expression(self) -> ast.Expr:
        """A whole expression, assignments included (LST-41)."""
        start = self.i
        left = self.binary(0)
        kind = self.kinds[self.i]
        if kind == ":=" or kind is ID:
            operator = self.assignment_operator()
            if operator:
                value = self.assigned_value()
                left = ast.AssignExpr(span=self.span_from(start), op=operator, target=left, value=value)
        return self.bounded(left, start) if self.i - start > _DEEP_TOKENS else left

    def bounded(self, tree: ast.Expr, start: int) -> ast.Expr:
        """`tree`, which began at token `start`; an error in its place when it is too deep."""
        if self.i - start <= _DEEP_TOKENS or self.depth:
            return tree
        return self.checked_depth(tree)

    def assigned_value(self) -> ast.Expr:
        """The right side of an assignment; a further assignment nests."""
        if self.depth >= MAX_NESTING:
            return self.too_deep()
        self.depth += 1
        value = self.expression()
        self.depth -= 1
        return value

    def assignment_operator(self) -> str | None:
        """Take `:=`, `S=`, `R=` or `REF=` if it stands here."""
        i = self.i
        if self.kinds[i] == ":=":
            self.i = i + 1
            return ":="
        if self.kinds[i] is ID and self.kinds[i + 1] == "=":
            word = self.texts[i].upper()
            if word in _SET_OPERATORS:
                self.i = i + 2
                return word + "="
        return None

    def checked_depth(self, tree: ast.Expr) -> ast.Expr:
        """`tree`, or an error in its place when recursive passes over it would not fit the stack."""
        level: list[object] = [tree]
        for _ in range(MAX_TREE_DEPTH):
            below: list[object] = []
            for node in level:
                if isinstance(node, ast.Node):
                    for item in fields(node):
                        child = getattr(node, item.name)
                        if isinstance(child, list):
                            below.extend(child)
                        elif isinstance(child, ast.Node):
                            below.append(child)
            if not below:
                return tree
            level = below
        self.diagnostics.append(
            report("E0107", self.source.uri, tree.span, what="expression", limit=MAX_TREE_DEPTH)
        )
        return ast.ErrorExpr(span=tree.span)

    def binary(self, minimum: int) -> ast.Expr:
        """Operators that bind stronger than `minimum`, left to right."""
        kinds = self.kinds
        start = self.i
        left = self.unary()
        while True:
            operator = kinds[self.i]
            precedence = _PRECEDENCE.get(operator, 0)
            if precedence <= minimum:
                return left
            self.i += 1
            right = self.binary(precedence)
            a, b = left.span, right.span
            # Parentheses of an operand belong to the whole.
            around = kinds[start] == "(" or kinds[self.i - 1] == ")"
            left = ast.Binary(
                span=self.span_from(start) if around else make_span((a[0], a[1], b[2], b[3])),
                op="AND" if operator == "&" else operator,
                left=left,
                right=right,
            )

    def unary(self) -> ast.Expr:
        """Signs and NOT, then `**`, which binds stronger (LST-04 level 3)."""
        start = self.i
        kind = self.kinds[start]
        if kind == "NOT" and self._named_operand(start + 1):
            self.i = start + 1
            callee = ast.Name(span=self.span_at(start), name=kind)
            args = self.arguments(of_call=True)
            return ast.Call(span=self.span_from(start), callee=callee, args=args)
        if kind == "-" or kind == "NOT" or kind == "+":
            if self.depth >= MAX_NESTING:
                return self.too_deep()
            self.depth += 1
            self.i = start + 1
            operand = self.unary()
            self.depth -= 1
            return ast.Unary(span=self.span_from(start), op=kind, operand=operand)
        left = self.operand()
        while self.kinds[self.i] == "**":
            self.i += 1
            right = self.unary() if self.kinds[self.i] in ("-", "+", "NOT") else self.operand()
            left = ast.Binary(span=self.span_from(start), op="**", left=left, right=right)
        return left

    def _named_operand(self, i: int) -> bool:
        """Whether `(IN := x)` stands at token `i`, as IEC 61131-3 names the operand of an operator."""
        kinds, texts = self.kinds, self.texts
        return (
            kinds[i] == "("
            and kinds[i + 1] is ID
            and kinds[i + 2] == ":="
            and (texts[i + 1].upper() in ("IN", "EN"))
        )

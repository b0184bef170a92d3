"""Expressions: operator precedence (spec LST-04), operands, calls, and initial values."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import fields
from typing import Final

from tappet.iec import literals
from tappet.lang import ast
from tappet.lang.diagnostics import report
from tappet.lang.lexer import ADDRESS, END, ID, INT, NUMBER, STRING
from tappet.lang.parser_core import BODY_END, MAX_NESTING, MAX_TREE_DEPTH, Core, make_span
from tappet.lang.source import Span
from tappet.lang.types import ELEMENTARY

_PRECEDENCE: Final = {
    "OR": 1, "OR_ELSE": 1,
    "XOR": 2,
    "AND": 3, "&": 3, "AND_THEN": 3,
    "=": 4, "<>": 4,
    "<": 5, ">": 5, "<=": 5, ">=": 5,
    "+": 6, "-": 6,
    "*": 7, "/": 7, "MOD": 7,
}  # fmt: skip
_POSTFIX: Final = frozenset([".", "[", "(", "^"])
_CALLABLE_OPERATORS: Final = frozenset(["AND", "OR", "XOR", "MOD", "AND_THEN", "OR_ELSE"])
_SET_OPERATORS: Final = frozenset(["S", "R", "REF"])
_NO_PARAMETER: Final = frozenset([",", ")"])
_DEEP_TOKENS: Final = 2 * MAX_TREE_DEPTH
"""An expression of fewer tokens cannot be too deep."""
_HINTS: Final = {
    "=": "Comparison is '=', assignment is ':='.",
    "THEN": "Write a condition before THEN.",
    "DO": "Write a value before DO.",
    "OF": "Write a selector before OF.",
    ":=": "Write a variable before ':='.",
}


_ASSIGNING: Final = frozenset(["+", "-", "*", "/", "&"])
"""Operators that other languages join with '='."""


class ExpressionParser(Core, ABC):
    """Reads expressions; `i` stands behind them afterwards."""

    __slots__ = ()

    @abstractmethod
    def type_reference(self, what: str = "type") -> ast.TypeRef:
        """A type; see `parser_types`."""

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

    def too_deep(self) -> ast.Expr:
        """Report excessive nesting and leave the rest of the statement out."""
        start = self.i
        self.error("E0107", what="expression", limit=MAX_NESTING)
        kinds = self.kinds
        i = start
        while kinds[i] != ";" and kinds[i] not in BODY_END and kinds[i] not in ("THEN", "DO", "OF"):
            i += 1
        self.i = self.failed_at = i
        return ast.ErrorExpr(span=self.span_from(start))

    def literal(self) -> ast.Expr:
        """A literal other than TRUE, FALSE and NULL; `Type#value` is the member of an enumeration."""
        i = self.i
        self.i = i + 1
        text = self.texts[i]
        line, column = self.lines[i], self.columns[i]
        span = make_span((line, column, line, column + len(text)))
        if self.kinds[i] is INT and len(text) < 19:
            return ast.Literal(span=span, text=text, kind="int", value=int(text))
        decoded = literals.decode(text)
        if decoded.kind == "enum":
            prefix, _, name = text.partition("#")
            at = column + len(prefix)
            base = ast.Name(span=Span(line, column, line, at), name=prefix)
            return ast.Member(
                span=span, base=base, name=name, name_span=Span(line, at + 1, line, column + len(text))
            )
        problem = decoded.problem
        if problem and not (self.kinds[i] is STRING and self._unclosed(span)):
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

    # -- calls

    def arguments(self, of_structure: bool = False, of_call: bool = False) -> list[ast.Argument]:
        """`(a, name := b, name => c)`; stands at the `(`. The values of a structure may be arrays.

        In a call `(x := y)` is an assignment, as in every expression, and no structure.
        """
        self.i += 1
        kinds = self.kinds
        args: list[ast.Argument] = []
        if kinds[self.i] == ")":
            self.i += 1
            return args
        if self.depth >= MAX_NESTING:
            self.too_deep()
            return args
        self.depth += 1
        while True:
            args.append(self.argument(of_structure, of_call))
            kind = kinds[self.i]
            if kind == ",":
                self.i += 1
                if kinds[self.i] != ")":
                    continue
                kind = ")"  # TwinCAT and CODESYS take a comma behind the last argument
            if kind == ")":
                self.i += 1
                break
            if not self._forgotten_comma():
                self.expected("',' or ')'", "Close the list of arguments with ')'.")
                break
            self.missing(",", "Separate arguments by commas.")
        self.depth -= 1
        return args

    def _forgotten_comma(self) -> bool:
        """Whether the token after an argument begins another one: same line, or a named argument."""
        i = self.i
        kind = self.kinds[i]
        if kind is ID and self.kinds[i + 1] in (":=", "=>"):
            return self._closes_soon(i)
        return kind in (ID, INT, NUMBER, STRING) and self.lines[i] == self.lines[i - 1]

    def _closes_soon(self, i: int) -> bool:
        """Whether the arguments continue at token `i`: a `)` or `,` comes before the statement ends."""
        kinds = self.kinds
        for at in range(i, min(i + 40, len(kinds))):
            kind = kinds[at]
            if kind == ")" or kind == ",":
                return True
            if kind == ";" or kind in BODY_END:
                return False
        return False

    def argument(self, of_structure: bool = False, of_call: bool = False) -> ast.Argument:
        """One actual parameter, or the initial value of a member of a structure."""
        start = self.i
        kinds = self.kinds
        second = kinds[start + 1] if kinds[start] is not END else END
        if (second == ":=" or second == "=>") and self.texts[start][0:1].isidentifier():
            self.i = start + 2
            if kinds[self.i] in _NO_PARAMETER:
                value = None
            elif of_call and kinds[self.i] == "(":
                value = self.expression()
            else:
                value = self.bare_element() if of_structure else self.initial_value()
            return ast.Argument(
                span=self.span_from(start), name=self.texts[start], value=value, output=second == "=>"
            )
        value = self.array_element() if of_structure else self.expression()
        return ast.Argument(span=value.span, name=None, value=value)

    # -- initial values

    def initial_value(self) -> ast.Expr:
        """An expression, `[...]` for an array, or `(name := value, ...)` for a structure or FB instance."""
        kinds = self.kinds
        i = self.i
        kind = kinds[i]
        if kind == "[":
            return self.array_initial()
        if kind == "(" and (
            (
                kinds[i + 2] == ":=" and self.texts[i + 1][0:1].isidentifier()
                if kinds[i + 1] is not END
                else False
            )
            or kinds[i + 1] == ")"
        ):
            return self.structure_initial()
        return self.expression()

    def structure_initial(self) -> ast.Expr:
        """`(name := value, ...)`; stands at the `(`. CoDeSys 2.3 writes arrays without brackets here, too."""
        start = self.i
        entries: list[ast.Argument] = []
        for entry in self.arguments(of_structure=True):
            owner = entries[-1] if entries and entry.name is None else None
            if owner is None or owner.value is None or entry.value is None:
                entries.append(entry)
            elif isinstance(owner.value, ast.ArrayInit) and owner.value.bare:
                owner.value.elements.append(entry.value)
            else:
                span = make_span((*owner.value.span[:2], *entry.span[2:]))
                owner.value = ast.ArrayInit(span=span, elements=[owner.value, entry.value], bare=True)
        return ast.StructInit(span=self.span_from(start), fields=entries)

    def bare_element(self) -> ast.Expr:
        """The value of a member; `3(0)` is an array of it alone."""
        value = self.array_element()
        if isinstance(value, ast.Repeat):
            return ast.ArrayInit(span=value.span, elements=[value], bare=True)
        return value

    def array_initial(self) -> ast.Expr:
        """`[value, n(value, ...), ...]`; stands at the `[`."""
        start = self.i
        self.i = start + 1
        if self.depth >= MAX_NESTING:
            return self.too_deep()
        self.depth += 1
        elements: list[ast.Expr] = []
        if self.kinds[self.i] != "]":
            elements.append(self.array_element())
            while self.kinds[self.i] == ",":
                self.i += 1
                elements.append(self.array_element())
        self.depth -= 1
        self.take("]")
        return ast.ArrayInit(span=self.span_from(start), elements=elements)

    def initial_value_of(self, type_ref: ast.TypeRef) -> ast.Expr:
        """The initial value of a variable. CoDeSys 2.3 writes arrays without brackets: `1, 2, 4(0)`; only the
        analysis knows whether a name denotes an array."""
        named = isinstance(type_ref, ast.NamedType) and type_ref.name.upper() not in ELEMENTARY
        if not named and not isinstance(type_ref, ast.ArrayType):
            return self.initial_value()
        start = self.i
        first = self.array_element()
        single = isinstance(first, ast.StructInit) and not named
        if self.kinds[self.i] != "," and not isinstance(first, ast.Repeat) and not single:
            return first
        elements = [first]
        while self.kinds[self.i] == ",":
            self.i += 1
            elements.append(self.array_element())
        return ast.ArrayInit(span=self.span_from(start), elements=elements, bare=named)

    def array_element(self) -> ast.Expr:
        """One element, or `n(value, ...)` for n times the values."""
        start = self.i
        kind = self.kinds[start]
        if (kind is INT or kind is NUMBER) and self.kinds[start + 1] == "(":
            count = self.literal()
            self.i += 1
            if self.depth >= MAX_NESTING:
                return self.too_deep()
            self.depth += 1
            values: list[ast.Expr] = []
            if self.kinds[self.i] != ")":
                values.append(self.array_element())
                while self.kinds[self.i] == ",":
                    self.i += 1
                    values.append(self.array_element())
            self.depth -= 1
            self.take(")")
            return ast.Repeat(span=self.span_from(start), count=count, values=values)
        return self.initial_value()

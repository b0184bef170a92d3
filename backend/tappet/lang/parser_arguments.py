"""Arguments of calls, and the initial values of variables, structures and arrays."""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import Final

from tappet.lang import ast
from tappet.lang.lexer import END, ID, INT, NUMBER, STRING
from tappet.lang.parser_core import BODY_END, MAX_NESTING, Core, make_span
from tappet.lang.types import ELEMENTARY

_NO_PARAMETER: Final = frozenset([",", ")"])


class ArgumentParser(Core, ABC):
    """Reads arguments and initial values; `i` stands behind them afterwards."""

    __slots__ = ()

    @abstractmethod
    def expression(self) -> ast.Expr:
        """A whole expression; see `parser_expressions`."""

    @abstractmethod
    def literal(self) -> ast.Expr:
        """A literal; see `parser_operands`."""

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
        elements = self._elements("]")
        return ast.ArrayInit(span=self.span_from(start), elements=elements)

    def _elements(self, end: str) -> list[ast.Expr]:
        """Elements of an array up to `end`, which is taken."""
        self.depth += 1
        elements: list[ast.Expr] = []
        if self.kinds[self.i] != end:
            elements.append(self.array_element())
            while self.kinds[self.i] == ",":
                self.i += 1
                elements.append(self.array_element())
        self.depth -= 1
        self.take(end)
        return elements

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
            values = self._elements(")")
            return ast.Repeat(span=self.span_from(start), count=count, values=values)
        return self.initial_value()

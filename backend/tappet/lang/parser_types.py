"""Types as written (spec LTYP-*)."""

from __future__ import annotations

from abc import abstractmethod
from typing import Final

from tappet.iec.words import ENDS
from tappet.lang import ast
from tappet.lang.lexer import END, ID
from tappet.lang.parser_core import MAX_NESTING
from tappet.lang.parser_statements import StatementParser

_STRONGER_THAN_COMPARISON = 5
"""Precedence of `<` and `>`, which end a value of a generic constant; inside parentheses they compare."""
_BEGIN_TYPE: Final = frozenset(["ARRAY", "POINTER", "REFERENCE", "STRUCT", "UNION"])
"""Keywords that begin a type."""


class TypeParser(StatementParser):
    """Reads types."""

    __slots__ = ()

    @abstractmethod
    def variables(self, end: str, paths: bool = False) -> list[ast.VarDecl]:
        """Members of a structure; see `parser_variables`."""

    def type_reference(self, what: str = "type") -> ast.TypeRef:
        """A type; where there is none, a NamedType with an empty name, and an error is reported."""
        start = self.i
        kind = self.kinds[start]
        if self.depth >= MAX_NESTING:
            self.too_deep()
            return ast.NamedType(span=self.span_at(start), name="")
        self.depth += 1
        result: ast.TypeRef
        if kind is ID:
            result = self._named_type(start)
        elif kind == "ARRAY":
            result = self._array_type(start)
        elif kind == "POINTER" or kind == "REFERENCE":
            self.i = start + 1
            self.take("TO", hint=f"Write {kind} TO and the type.")
            base = self.type_reference()
            node = ast.PointerType if kind == "POINTER" else ast.ReferenceType
            result = node(span=self.span_from(start), base=base)
        elif kind == "(":
            result = self._enumeration(start)
        elif kind == "STRUCT" or kind == "UNION":
            result = self._structure(start, kind)
        elif kind == "PARAMS":
            self.error("E0113", what="PARAMS OF", hint="Use an ARRAY[*] OF in VAR_IN_OUT.")
            self.i = start + 1
            if self.kinds[self.i] == "OF":
                self.i += 1
            result = self.type_reference()
        else:
            self.error(
                "E0101", expected=f"A {what}", found=self.found(), hint="Write a type such as BOOL or INT."
            )
            result = ast.NamedType(span=self.span_at(start), name="")
        self.depth -= 1
        return result

    def _named_type(self, start: int) -> ast.TypeRef:
        text = self.texts[start]
        upper = text.upper()
        kinds = self.kinds
        if (upper == "STRING" or upper == "WSTRING") and kinds[start + 1] != ".":
            return self._string_type(start, upper == "WSTRING")
        self.i = start + 1
        name = text
        if upper == "REF_TO" and (kinds[self.i] is ID or kinds[self.i] in _BEGIN_TYPE):
            base = self.type_reference()
            return ast.PointerType(span=self.span_from(start), base=base, ref_to=True)
        while kinds[self.i] == ".":
            self.i += 1
            part, _ = self.member_name()
            name = f"{name}.{part}"
        if kinds[self.i] == "<":
            return self.generic_type(start, name)
        if kinds[self.i] == "[" and kinds[self.i + 1] == "(":
            elements = self._element_arguments()
            return ast.NamedType(span=self.span_from(start), name=name, elements=elements)
        if kinds[self.i] != "(":
            return ast.NamedType(span=self.span_from(start), name=name)
        # `INT(1..10)` is a subrange, `FB(1, x := 2)` passes arguments to FB_Init
        opening = self.i
        if kinds[opening + 1] == ")" or (kinds[opening + 1] is not END and kinds[opening + 2] == ":="):
            args = self.arguments()
            return ast.NamedType(span=self.span_from(start), name=name, args=args)
        self.i = opening + 1
        first = self.argument()
        if kinds[self.i] == ".." and first.value is not None:
            self.i += 1
            high = self.expression()
            self.take(")")
            return ast.SubrangeType(span=self.span_from(start), base=name, low=first.value, high=high)
        args = [first]
        while kinds[self.i] == ",":
            self.i += 1
            args.append(self.argument())
        self.take(")")
        return ast.NamedType(span=self.span_from(start), name=name, args=args)

    def generic_type(self, start: int, name: str) -> ast.NamedType:
        """`<20, (2 * n)>` behind the name of a block, and what FB_Init gets."""
        values: list[ast.Expr] = []
        while True:
            self.i += 1
            values.append(self.binary(_STRONGER_THAN_COMPARISON))
            if self.kinds[self.i] != ",":
                break
        self.take(">")
        node = ast.NamedType(span=self.span_from(start), name=name, generic=name, values=values)
        if self.kinds[self.i] == "[" and self.kinds[self.i + 1] == "(":
            node.elements = self._element_arguments()
        elif self.kinds[self.i] == "(":
            node.args = self.arguments()
        node.span = self.span_from(start)
        return node

    def _element_arguments(self) -> list[ast.InitArguments]:
        """`[(a), (n := b)]`: arguments of FB_Init for each element of an array."""
        found: list[ast.InitArguments] = []
        while True:
            self.i += 1
            start = self.i
            if self.kinds[start] != "(":
                self.expected("'('", "Write the values of each element in parentheses: [(n := 1), (n := 2)].")
                return found
            args = self.arguments()
            found.append(ast.InitArguments(span=self.span_from(start), args=args))
            if self.kinds[self.i] != ",":
                break
        self.take("]")
        return found

    def _string_type(self, start: int, wide: bool) -> ast.TypeRef:
        self.i = start + 1
        length = None
        opening = self.kinds[self.i]
        if opening == "(" or opening == "[":
            self.i += 1
            length = self.expression()
            self.take(")" if opening == "(" else "]")
        return ast.StringType(span=self.span_from(start), wide=wide, length=length)

    def _array_type(self, start: int) -> ast.TypeRef:
        self.i = start + 1
        bounds: list[tuple[ast.Expr | None, ast.Expr | None]] = []
        if self.take("[", hint="Write ARRAY[low..high] OF and the type."):
            bounds.append(self._array_bounds())
            while self.kinds[self.i] == ",":
                self.i += 1
                bounds.append(self._array_bounds())
            self.take("]")
        self.take("OF", hint="Write OF and the type of the elements.")
        element = self.type_reference()
        return ast.ArrayType(span=self.span_from(start), bounds=bounds, element=element)

    def _array_bounds(self) -> tuple[ast.Expr | None, ast.Expr | None]:
        if self.kinds[self.i] == "*":
            self.i += 1
            return None, None
        low = self.expression()
        if not self.take("..", hint="Write both bounds, as in 0..9."):
            return low, ast.ErrorExpr(span=self.span_at(self.i))
        return low, self.expression()

    def _enumeration(self, start: int) -> ast.TypeRef:
        self.i = start + 1
        values: list[ast.EnumValue] = []
        kinds = self.kinds
        while True:
            first = self.i
            name, _ = self.name("enumeration value")
            value = None
            if kinds[self.i] == ":=":
                self.i += 1
                value = self.expression()
            if self.i == first:
                break
            entry = ast.EnumValue(span=self.span_from(first), name=name, value=value)
            values.append(entry)
            more = kinds[self.i] == ","
            if more:
                self.i += 1
            entry.comment = self.comment_of(first, self.i - 1)
            if not more:
                if kinds[self.i] is not ID:
                    break
                self.missing(",", "Separate the values by commas.")
        self.take(")", hint="Close the list of values with ')'.")
        base = None
        if kinds[self.i] is ID and self.lines[self.i] == self.lines[self.i - 1]:
            base = self.texts[self.i].upper()
            self.i += 1
        return ast.EnumType(span=self.span_from(start), values=values, base=base)

    def _structure(self, start: int, kind: str) -> ast.StructType:
        opener = (kind, self.lines[start])
        self.i = start + 1
        self.open.append(opener)
        members = self.variables(ENDS[kind])
        self.open.pop()
        self.close(opener)
        return ast.StructType(span=self.span_from(start), members=members, union=kind == "UNION")

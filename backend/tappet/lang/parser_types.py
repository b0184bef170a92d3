"""Types as written, blocks of variables, and TYPE blocks (spec LDEC-02..LDEC-04, LTYP-*)."""

from __future__ import annotations

from typing import Final

from tappet.lang import ast
from tappet.lang.lexer import ADDRESS, END, ID
from tappet.lang.parser_core import ENDS, MAX_NESTING, OBJECT_HEADS, SECTIONS, STATEMENT_KEYWORDS
from tappet.lang.parser_statements import StatementParser
from tappet.lang.source import Span

_FLAGS: Final = frozenset(["CONSTANT", "RETAIN", "NON_RETAIN", "PERSISTENT"])
_ACCESS_WORDS: Final = frozenset(["PUBLIC", "INTERNAL"])
_BLOCK_STOPS: Final = (
    frozenset(ENDS.values()) | OBJECT_HEADS | SECTIONS | STATEMENT_KEYWORDS | {END, "END_VAR"}
)
_USE_SECOND: Final = frozenset(["(", ".", "[", "^"])
"""Behind a name at the begin of a line: a statement, not a declaration."""


class TypeParser(StatementParser):
    """Reads types and variables."""

    __slots__ = ()

    # -- types

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
        while kinds[self.i] == ".":
            self.i += 1
            part, _ = self.member_name()
            name = f"{name}.{part}"
        if kinds[self.i] != "(":
            return ast.NamedType(span=self.span_from(start), name=name)
        # `INT(1..10)` is a subrange, `FB(1, x := 2)` passes arguments to FB_Init
        opening = self.i
        if kinds[opening + 1] == ")" or kinds[opening + 2] == ":=":
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
                self.expected("','", "Separate the values by commas.")
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

    # -- variables

    def variable_block(self) -> ast.VarBlock:
        """VAR_x flags ... END_VAR; stands at the section keyword."""
        start = self.i
        section = self.kinds[start]
        attributes = self.attributes_before(start)
        self.i = start + 1
        flags: set[str] = set()
        while self.kinds[self.i] in _FLAGS:
            flags.add(self.kinds[self.i])
            self.i += 1
        attributes += self.attributes_after(self.i - 1)
        opener = (section, self.lines[start])
        variables = self.variables("END_VAR", paths=section == "VAR_CONFIG" or section == "VAR_ACCESS")
        if self.kinds[self.i] == "END_VAR":
            if self.i in self.trivia:
                attributes += self.attributes_before(self.i)
            self.i += 1
            if self.kinds[self.i] == ";":
                self.i += 1
        else:
            self.error("E0103", end="END_VAR", begin=section, line=opener[1] + 1, found=self.found())
        return ast.VarBlock(
            span=self.span_from(start),
            section=section,
            flags=flags,
            variables=variables,
            attributes=attributes,
        )

    def variables(self, end: str, paths: bool = False) -> list[ast.VarDecl]:
        """Declarations up to the keyword `end`, or to one that shows that it is missing."""
        out: list[ast.VarDecl] = []
        kinds = self.kinds
        while True:
            start = self.i
            kind = kinds[start]
            if kind == end or kind is END:
                return out
            if kind is ID:
                if (
                    kinds[start + 1] in _USE_SECOND
                    and not paths
                    and self.lines[start] != self.lines[start - 1]
                ):
                    return out  # a statement: the end is missing
                self.variable(out, paths)
            elif kind == ";":
                self.i += 1
            elif kind in _BLOCK_STOPS and not self._declares_keyword(start):
                return out
            else:
                self.variable(out, paths)

    def _declares_keyword(self, index: int) -> bool:
        return self.kinds[index + 1] in (":", ",", "AT") and self.kinds[index] is not END

    def variable(self, out: list[ast.VarDecl], paths: bool) -> None:
        """`a, b AT address : type := initial;` appended to `out`, one node per name."""
        start = self.i
        kinds = self.kinds
        messages = len(self.diagnostics)
        names = [self._path() if paths else self._variable_name()]
        while kinds[self.i] == ",":
            self.i += 1
            names.append(self._variable_name())
        if self.i == start:  # not even a name
            self.i = start + 1
            self._skip_variable()
            return
        address = self._address() if kinds[self.i] == "AT" else None
        type_ref: ast.TypeRef
        if kinds[self.i] == ":":
            self.i += 1
            type_ref = self.type_reference()
        elif kinds[self.i] is ID and len(self.diagnostics) == messages:
            self.expected("':'", "Write ':' between the name and the type.")
            type_ref = self.type_reference()
        else:
            self.expected("':' and a type", "Declare a variable as 'name : type;'.")
            type_ref = ast.NamedType(span=self.span_at(self.i), name="")
        initial, initial_ref = self.initialisation()
        if kinds[self.i] == ";":
            self.i += 1
        elif len(self.diagnostics) > messages or self.failed_at == self.i:
            self._skip_variable()
        else:
            self.expected("';'", "End the declaration with ';'.")
            if not (kinds[self.i] in _BLOCK_STOPS or self.lines[self.i] != self.lines[self.i - 1]):
                self._skip_variable()
        span = self.span_from(start)
        attributes: list[ast.Pragma] = []
        comment = ""
        if self.trivia:
            attributes = self.attributes_of(start, self.i - 1)
            comment = self.comment_of(start, self.i - 1)
        for name, name_span in names:
            out.append(
                ast.VarDecl(
                    span=span,
                    name=name,
                    name_span=name_span,
                    type_ref=type_ref,
                    initial=initial,
                    initial_ref=initial_ref,
                    address=address,
                    attributes=attributes,
                    comment=comment,
                )
            )

    def _variable_name(self) -> tuple[str, Span]:
        start = self.i
        name, span = self.name("variable", "Declare a variable as 'name : type;'.")
        kinds = self.kinds
        if name and self._is_word(self.i):
            at = self.i
            while self._is_word(at):
                at += 1
            if kinds[at] in (":", ",", "AT") and self.lines[at] == self.lines[start]:
                self.i = at
                name = " ".join(self.texts[start:at])
                span = self.span_from(start)
                self.i = at - 1
                self.error("E0111", span, name=name)
                self.i = at
                name = name.replace(" ", "_")
        return name, span

    def _is_word(self, index: int) -> bool:
        return self.kinds[index] is ID or (
            self.kinds[index] == self.texts[index].upper() != "AT" and self.texts[index][:1].isalpha()
        )

    def _path(self) -> tuple[str, Span]:
        """`PLC_PRG.instance[1].member` of a VAR_CONFIG, as one text."""
        start = self.i
        self.name("variable", "Write the full path of the variable.")
        kinds = self.kinds
        while kinds[self.i] == "." or kinds[self.i] == "[":
            if kinds[self.i] == ".":
                self.i += 1
                self.member_name()
            else:
                self.i += 1
                self.expression()
                while kinds[self.i] == ",":
                    self.i += 1
                    self.expression()
                self.take("]")
        return "".join(self.texts[start : self.i]), self.span_from(start)

    def _address(self) -> str:
        self.i += 1
        if self.kinds[self.i] is not ADDRESS:
            self.expected("An address", "Write an address such as %IX0.0, %QW2 or %I*.")
            return ""
        self.i += 1
        return self.texts[self.i - 1].upper()

    def initialisation(self) -> tuple[ast.Expr | None, bool]:
        """`:= value` or `REF= variable` if it stands here; the flag tells the second."""
        start = self.i
        kind = self.kinds[start]
        if kind == ":=":
            self.i = start + 1
            return self.bounded(self.initial_value(), start), False
        if kind is ID and self.kinds[start + 1] == "=" and self.texts[start].upper() == "REF":
            self.i = start + 2
            return self.bounded(self.expression(), start), True
        if kind == "=":
            self.error("E0101", expected="':='", found="'='", hint="An initial value is written with ':='.")
            self.i = start + 1
            return self.bounded(self.initial_value(), start), False
        return None, False

    def _skip_variable(self) -> None:
        """Go behind the `;` of a faulty declaration, or to the next one that begins a line."""
        kinds, lines = self.kinds, self.lines
        i = self.i
        while kinds[i] is not END:
            kind = kinds[i]
            if kind == ";":
                i += 1
                break
            if kind in _BLOCK_STOPS:
                break
            if lines[i] != lines[i - 1] and kind is ID and kinds[i + 1] in (":", ",", "AT"):
                break
            i += 1
        self.i = i

    # -- TYPE

    def type_block(self) -> list[ast.Declaration]:
        """TYPE name : definition; ... END_TYPE; stands at TYPE."""
        start = self.i
        opener = ("TYPE", self.lines[start])
        self.open.append(opener)
        self.i = start + 1
        out: list[ast.Declaration] = []
        kinds = self.kinds
        while kinds[self.i] != "END_TYPE":
            kind = kinds[self.i]
            if kind == ";":
                self.i += 1
            elif kind is END or kind in OBJECT_HEADS or kind in SECTIONS or kind in ENDS.values():
                break
            else:
                head = start if not out else self.i
                before = self.i
                declaration = self._type_definition(head)
                if declaration is not None:
                    out.append(declaration)
                if self.i == before:
                    self.i += 1
                    self._skip_variable()
        if not out and kinds[self.i] == "END_TYPE":
            self.error(
                "E0109", what="The name of a type", found="END_TYPE", hint="Write 'name : definition;'."
            )
        self.open.pop()
        self.close(opener)
        if self.kinds[self.i] == ";":
            self.i += 1
        return out

    def _type_definition(self, head: int) -> ast.TypeDecl | None:
        start = self.i
        messages = len(self.diagnostics)
        attributes = self.attributes_before(head) + (self.attributes_before(start) if start != head else [])
        comment = self.comment_above(head) or (self.comment_above(start) if start != head else "")
        while self.word() in _ACCESS_WORDS and self.kinds[self.i + 1] is ID:
            self.i += 1
        name, name_span = self.name("type", "Write 'TYPE name : definition; END_TYPE'.")
        if not name:
            return None
        extends = self._extends()
        self.take(
            ":", "':' after the type name", "Write ':' between the name of the type and its definition."
        )
        comment = comment or self.comment_of(self.i - 1, self.i - 1)
        extends = extends or (self._extends_after_struct() if self.kinds[self.i] == "STRUCT" else None)
        type_ref = self.type_reference("type definition")
        initial, _ = self.initialisation()
        if self.kinds[self.i] == ";":
            self.i += 1
        elif len(self.diagnostics) > messages or self.failed_at == self.i:
            if self.kinds[self.i] != "END_TYPE":
                self._skip_variable()
        elif not isinstance(type_ref, ast.StructType) and self.kinds[self.i] != "END_TYPE":
            self.expected("';'", "End the definition with ';'.")
        return ast.TypeDecl(
            span=self.span_from(head),
            name=name,
            name_span=name_span,
            source=self.source,
            attributes=attributes,
            comment=comment,
            type_ref=type_ref,
            initial=initial,
            extends=extends,
        )

    def _extends(self) -> str | None:
        if self.word() != "EXTENDS":
            return None
        self.i += 1
        return self.qualified_name("base type") or None

    def _extends_after_struct(self) -> str | None:
        """`STRUCT EXTENDS base`, which other systems write; the words between are stepped over."""
        if self.kinds[self.i + 1] is not ID or self.texts[self.i + 1].upper() != "EXTENDS":
            return None
        if self.kinds[self.i + 2] is not ID or self.kinds[self.i + 3] in (":", ",", "AT"):
            return None
        struct = self.i
        self.i += 2
        base = self.qualified_name("base type")
        # read on as if STRUCT stood behind the base
        self.i -= 1
        self.kinds[self.i] = self.kinds[struct]
        return base or None

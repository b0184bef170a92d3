"""Blocks of variables (spec LDEC-02..LDEC-04) and the members of structures."""

from __future__ import annotations

from typing import Final

from tappet.iec.words import ACCESS_SPECIFIERS, ENDS, OBJECT_HEADS, SECTION_FLAGS, SECTIONS
from tappet.lang import ast
from tappet.lang.lexer import ADDRESS, END, ID
from tappet.lang.parser_core import STATEMENT_KEYWORDS
from tappet.lang.parser_types import TypeParser
from tappet.lang.source import Span

BEHIND_NAME: Final = frozenset([":", ",", "AT"])
"""What follows the name of a variable."""
_BLOCK_STOPS: Final = (
    frozenset(ENDS.values()) | OBJECT_HEADS | SECTIONS | STATEMENT_KEYWORDS | {END, "END_VAR"}
)
_USE_SECOND: Final = frozenset(["(", ".", "[", "^"])
"""Behind a name at the begin of a line: a statement, not a declaration."""


class VariableParser(TypeParser):
    """Reads declarations of variables."""

    __slots__ = ()

    def variable_block(self) -> ast.VarBlock:
        """VAR_x flags ... END_VAR; stands at the section keyword."""
        start = self.i
        section = self.kinds[start]
        attributes = self.attributes_before(start)
        self.i = start + 1
        flags: set[str] = set()
        while self.kinds[self.i] in SECTION_FLAGS or self._at_access():
            flags.add(self.word() if self.kinds[self.i] is ID else self.kinds[self.i])
            self.i += 1
        if section == "VAR_GENERIC" and "CONSTANT" not in flags:
            self.expected("CONSTANT", "Write VAR_GENERIC CONSTANT.")
        attributes += self.attributes_after(self.i - 1)
        opener = (section, self.lines[start])
        listed = (
            section == "VAR_GLOBAL" and "PERSISTENT" in flags
        )  # paths of instances, as CODESYS writes them
        variables = self.variables("END_VAR", paths=listed or section in ("VAR_CONFIG", "VAR_ACCESS"))
        if self.kinds[self.i] == "END_VAR":
            if self.i in self.trivia:
                attributes += self.attributes_before(self.i)
            self.i += 1
            if self.kinds[self.i] == ";":
                self.i += 1
        else:
            self.missing_end("E0103", "END_VAR", section, opener[1])
        generic = section == "VAR_GENERIC"
        if generic:
            section, flags = "VAR", flags | {"CONSTANT"}
            for decl in variables:  # the value of an instance takes its place; this one is for the checks
                decl.initial = decl.initial or ast.Literal(text="1", kind="int", value=1, span=decl.span)
        return ast.VarBlock(
            span=self.span_from(start),
            section=section,
            flags=flags,
            variables=variables,
            attributes=attributes,
            generic=generic,
        )

    def _at_access(self) -> bool:
        """Whether an access specifier stands here, and not a variable of that name."""
        return self.word() in ACCESS_SPECIFIERS and self.kinds[self.i + 1] not in BEHIND_NAME

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
            self.missing(":", "Write ':' between the name and the type.")
            type_ref = self.type_reference()
        else:
            self.expected("':' and a type", "Declare a variable as 'name : type;'.")
            type_ref = ast.NamedType(span=self.span_at(self.i), name="")
        initial, initial_ref = self.initialisation(type_ref)
        if kinds[self.i] == ";":
            self.i += 1
        elif len(self.diagnostics) > messages or self.failed_at == self.i:
            self._skip_variable()
        else:
            self.missing(";", "End the declaration with ';'.")
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
        """`PLC_PRG.instance[1].member` of a VAR_CONFIG, as one text; `.global` names no list."""
        start = self.i
        if self.kinds[start] == "." and self.kinds[start + 1] is ID:
            self.i += 1
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

    def initialisation(self, type_ref: ast.TypeRef) -> tuple[ast.Expr | None, bool]:
        """`:= value` or `REF= variable` if it stands here; the flag is set for the second."""
        start = self.i
        kind = self.kinds[start]
        if kind == ":=":
            self.i = start + 1
            value = self.initial_value_of(type_ref)
            return self.bounded(value, start), False
        if kind is ID and self.kinds[start + 1] == "=" and self.texts[start].upper() == "REF":
            self.i = start + 2
            return self.bounded(self.expression(), start), True
        if kind == "=":
            hint = "An initial value is written with ':='."
            self.error("E0101", expected="':='", found="'='", hint=hint, instead=":=")
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

"""TYPE name : definition; END_TYPE."""

from __future__ import annotations

from typing import Final

from tappet.iec.words import ENDS, OBJECT_HEADS, SECTIONS
from tappet.lang import ast
from tappet.lang.lexer import END, ID
from tappet.lang.parser_variables import VariableParser
from tappet.lang.source import NOWHERE, Span

_ACCESS_WORDS: Final = frozenset(["PUBLIC", "INTERNAL"])


class TypeBlockParser(VariableParser):
    """Reads TYPE blocks."""

    __slots__ = ()

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
        access = "PUBLIC"
        while self.word() in _ACCESS_WORDS and self.kinds[self.i + 1] is ID:
            access = self.word()
            self.i += 1
        name, name_span = self.name("type", "Write 'TYPE name : definition; END_TYPE'.")
        if not name:
            return None
        extends, extends_span = self._extends()
        self.take(
            ":", "':' after the type name", "Write ':' between the name of the type and its definition."
        )
        comment = comment or self.comment_of(self.i - 1, self.i - 1)
        if self.kinds[self.i] == "STRUCT" and not extends:
            extends, extends_span = self._extends_after_struct()
        type_ref = self.type_reference("type definition")
        initial, _ = self.initialisation(type_ref)
        if self.kinds[self.i] == ";":
            self.i += 1
        elif len(self.diagnostics) > messages or self.failed_at == self.i:
            if self.kinds[self.i] != "END_TYPE":
                self._skip_variable()
        elif not isinstance(type_ref, ast.StructType) and self.kinds[self.i] != "END_TYPE":
            self.missing(";", "End the definition with ';'.")
        return ast.TypeDecl(
            access=access,
            span=self.span_from(head),
            name=name,
            name_span=name_span,
            source=self.source,
            attributes=attributes,
            comment=comment,
            type_ref=type_ref,
            initial=initial,
            extends=extends or None,
            extends_span=extends_span,
        )

    def _extends(self) -> tuple[str, Span]:
        if self.word() != "EXTENDS":
            return "", NOWHERE
        self.i += 1
        return self.qualified_name("base type")

    def _extends_after_struct(self) -> tuple[str, Span]:
        """`STRUCT EXTENDS base`, which other systems write; the words between are stepped over."""
        if self.kinds[self.i + 1] is not ID or self.texts[self.i + 1].upper() != "EXTENDS":
            return "", NOWHERE
        if self.kinds[self.i + 2] is not ID or self.kinds[self.i + 3] in (":", ",", "AT"):
            return "", NOWHERE
        struct = self.i
        self.i += 2
        base = self.qualified_name("base type")
        # read on as if STRUCT stood behind the base
        self.i -= 1
        self.kinds[self.i] = self.kinds[struct]
        return base

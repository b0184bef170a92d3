"""Objects: POUs with their methods, actions and properties, interfaces, global variable lists."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import PurePosixPath
from typing import Final, TypeVar

from tappet.iec.words import (
    ACCESS_SPECIFIERS,
    CHILD_HEADS,
    ENDS,
    GLOBAL_SECTIONS,
    INHERITANCE_MODIFIERS,
    OBJECT_HEADS,
    POU_HEADS,
    SECTIONS,
)
from tappet.lang import ast
from tappet.lang.languages import reader_of, text_readers
from tappet.lang.languages.drawn import DrawnReader
from tappet.lang.languages.reader import TextReader
from tappet.lang.lexer import END, ID
from tappet.lang.parser_core import BODY_END, Opener
from tappet.lang.parser_type_blocks import TypeBlockParser
from tappet.lang.source import NOWHERE

_BEHIND_VARIABLE: Final = frozenset([":=", "(", ".", "[", "^"])
"""What follows a name that begins a statement."""
_HOLDERS: Final = frozenset(["PROGRAM", "FUNCTION_BLOCK"])
_TYPED: Final = frozenset(["FUNCTION", "METHOD"])


_Head = TypeVar("_Head", ast.Pou, ast.Property, ast.Interface)


class Parser(TypeBlockParser):
    """Reads a whole text."""

    __slots__ = ()

    def unit(self) -> ast.Unit:
        """Everything the text declares."""
        out: list[ast.Declaration] = []
        kinds = self.kinds
        source = self.source
        bare = source.name is not None and source.owner is not None
        if bare and kinds[0] not in OBJECT_HEADS and not self._begins_accessor():
            out.append(self._bare_action())
        while True:
            kind = kinds[self.i]
            if kind is END:
                break
            if kind in POU_HEADS:
                out.append(self.pou(kind))
            elif kind in GLOBAL_SECTIONS:
                self._global_list(out)
            elif kind == "TYPE":
                out.extend(self.type_block())
            elif kind in CHILD_HEADS:
                self._child(out, kind)
            elif kind == "INTERFACE":
                out.append(self.interface())
            elif kind is ID and self.word() == "FUNCTIONBLOCK":  # CoDeSys 2.3 takes the header as one word
                out.append(self.pou("FUNCTION_BLOCK"))
            elif kind == ";":
                self.i += 1
            else:
                self._no_declaration(kind)
        self._name_global_list(out)
        return ast.Unit(span=self.span_from(0), source=source, declarations=out)

    def _begins_accessor(self) -> bool:
        return self.word() in ("GET", "SET")

    def _bare_action(self) -> ast.Pou:
        """The body of an action whose head is not in the text."""
        action = ast.Pou(name=self.source.name or "", kind="ACTION", source=self.source)
        self._members(action, ("ACTION", 0))
        action.span = self.span_from(0)
        return action

    def _no_declaration(self, kind: str) -> None:
        """Report what begins no object, and go to what does."""
        if kind in ENDS.values() or kind == "END_VAR":
            self.error("E0106", found=kind, hint="Remove it or write the beginning it closes.")
        else:
            self.error("E0108", found=self.found())
        kinds = self.kinds
        i = self.i + 1
        while kinds[i] is not END and kinds[i] not in OBJECT_HEADS and kinds[i] not in GLOBAL_SECTIONS:
            i += 1
        self.i = i

    def _child(self, out: list[ast.Declaration], kind: str) -> None:
        """A method, action or property outside a block: in a text of its own, or of the block before it."""
        child: ast.Pou | ast.Property = self.property() if kind == "PROPERTY" else self.pou(kind)
        before = next((item for item in reversed(out) if isinstance(item, ast.Pou)), None)
        if (
            self.source.owner is None
            and before is not None
            and before.kind in _HOLDERS
            and before.owner is None
        ):
            _adopt(before, child)
        else:
            out.append(child)

    # -- global lists

    def _global_list(self, out: list[ast.Declaration]) -> None:
        start = self.i
        first = next((item for item in out if isinstance(item, ast.GlobalList)), None)
        attributes = self.attributes_before(start)
        comment = self.comment_above(start)
        block = self.variable_block()
        if first is not None:
            first.blocks.append(block)
            first.span = first.span.to(block.span)
            return
        out.append(
            ast.GlobalList(
                span=block.span,
                name=self.source.name or "",
                name_span=self.span_at(start),
                source=self.source,
                attributes=attributes,
                comment=comment,
                blocks=[block],
            )
        )

    def _name_global_list(self, out: list[ast.Declaration]) -> None:
        """A list without an object name gets the one of its file; other objects of the file keep theirs."""
        for item in out:
            if isinstance(item, ast.GlobalList) and not item.name:
                stem = PurePosixPath(self.source.uri.replace("\\", "/")).name
                stem = stem[:-3] if stem.lower().endswith(".st") else stem
                name = (
                    "".join(char if char.isascii() and char.isalnum() else "_" for char in stem) or "Globals"
                )
                taken = any(other.name.upper() == name.upper() for other in out if other is not item)
                item.name = f"{name}_Globals" if taken else name

    # -- POUs

    def pou(self, kind: str, owner: ast.Pou | ast.Interface | None = None) -> ast.Pou:
        """A POU, method, action or transition; stands at the keyword `kind`."""
        start = self.i
        opener = (kind, self.lines[start])
        pou = self._head(ast.Pou, kind.lower().replace("_", " "), kind=kind)
        pou.owner = owner if isinstance(owner, ast.Pou) else None
        while self.kinds[self.i] == "VAR_GENERIC":  # CODESYS writes it before EXTENDS
            self._section(pou)
        self._heritage(pou)
        if kind in _TYPED and self.kinds[self.i] == ":":
            self.i += 1
            pou.return_type = self.type_reference("return type")
        elif kind in ("ACTION", "TRANSITION") and self.kinds[self.i] == ":":
            self.i += 1
        elif self.kinds[self.i] == ":":
            hint = f"A {kind.lower().replace('_', ' ')} has no return type; use VAR_OUTPUT."
            self.error("E0101", expected="A declaration", found="':'", hint=hint)
            self.i += 1
            self.type_reference()
        elif kind in _TYPED and self._forgotten_colon():
            self.missing(":", "Write ':' between the name and the return type.")
            pou.return_type = self.type_reference("return type")
        if self.kinds[self.i] == ";" and self.lines[self.i] == self.lines[self.i - 1]:
            self.i += 1
        if self.failed_at == self.i:  # a faulty head: its rest is the rest of the line
            while self.lines[self.i] == self.lines[start] and self.kinds[self.i] not in BODY_END:
                self.i += 1
        self.open.append(opener)
        self._members(pou, opener)
        self.open.pop()
        self.close(opener)
        pou.span = self.span_from(start)
        return pou

    def _forgotten_colon(self) -> bool:
        """Whether a type follows the name of a function directly, in its line."""
        i = self.i
        if self.kinds[i] is not ID or self.lines[i] != self.lines[i - 1]:
            return False
        return self.kinds[i + 1] in SECTIONS or self.lines[i + 1] != self.lines[i]

    def _head(self, make: Callable[..., _Head], what: str, **own: object) -> _Head:
        """The node of a declaration whose keyword stands here, up to its name; `own` is for `make` alone."""
        start = self.i
        self.i = start + 1
        access, modifiers = self._access()
        name, name_span = self.name(what)
        node = make(
            span=self.span_at(start),
            name=name,
            name_span=name_span,
            source=self.source,
            attributes=self.attributes_before(start),
            comment=self.comment_above(start) or self.comment_of(self.i - 1, self.i - 1),
            access=access,
            **own,
        )
        if isinstance(node, ast.Pou | ast.Property):
            node.modifiers = modifiers
        return node

    def _access(self) -> tuple[str, set[str]]:
        """Words before a name such as PRIVATE or ABSTRACT; such a word may also be the name itself."""
        access = "PUBLIC"
        modifiers: set[str] = set()
        while self.kinds[self.i] is ID and self.kinds[self.i + 1] is ID:
            if self.texts[self.i + 1].upper() in ("EXTENDS", "IMPLEMENTS"):
                break
            word = self.word()
            if word in ACCESS_SPECIFIERS:
                access = word
            elif word in INHERITANCE_MODIFIERS:
                modifiers.add(word)
            else:
                break
            self.i += 1
        return access, modifiers

    def _heritage(self, pou: ast.Pou) -> None:
        while self.word() in ("EXTENDS", "IMPLEMENTS"):
            word = self.word()
            self.i += 1
            at = self.i
            names = [self.qualified_name("base" if word == "EXTENDS" else "interface")]
            if word == "EXTENDS" and self.kinds[self.i] == "<":
                pou.extends_type = self.generic_type(at, names[0][0])
            while self.kinds[self.i] == ",":
                if word == "EXTENDS":
                    self.error(
                        "E0113",
                        what="More than one base",
                        hint="Extend one block; IMPLEMENTS takes any number of interfaces.",
                    )
                self.i += 1
                names.append(self.qualified_name("interface"))
            if word == "IMPLEMENTS":
                pou.implements += [name for name, _ in names if name]
                pou.implements_spans += [span for name, span in names if name]
            else:
                pou.extends, pou.extends_span = names[0][0] or None, names[0][1]

    def _members(self, pou: ast.Pou, opener: Opener) -> None:
        """Variables, statements and children up to the end of `pou`, in any order."""
        kinds = self.kinds
        end = ENDS[opener[0]]
        while True:
            kind = kinds[self.i]
            if kind not in BODY_END or (kind == "TRANSITION" and self._goes_on(pou)):
                if not self._part_of_body(pou, kind):
                    break
            elif kind == end or kind is END:
                if self.source.bodies and self._drawn(pou, opener):
                    break
                if self.i in self.trivia and not pou.body:
                    pou.body += self.statements()  # pragmas alone
                break
            elif kind in SECTIONS:
                if any(not isinstance(item, ast.PragmaStmt) for item in pou.body):
                    self.error("E0112", section=kind)
                self._section(pou)
            elif kind in CHILD_HEADS and pou.kind in _HOLDERS:
                _adopt(pou, self.property(pou) if kind == "PROPERTY" else self.pou(kind, pou))
            elif kind in OBJECT_HEADS:
                break
            elif kind == "STRUCT" or kind == "UNION":
                hint = "Declare the structure in a TYPE block."
                self.error("E0114", what=f"A {kind}", where=f"a {opener[0]}", hint=hint)
                self.i += 1
                self.variables(ENDS[kind])
                self._pass(ENDS[kind])
            elif not self._part_of_body(pou, kind):
                break
        if pou.graph is not None:
            self.graphs.append(pou)

    def _part_of_body(self, pou: ast.Pou, kind: str) -> bool:
        """Let the reader of the language take what stands here; whether something was taken."""
        at = self.i
        self._reader(pou).read(self, pou)
        return self.i != at or self._foreign_end(kind)

    def _section(self, pou: ast.Pou) -> None:
        """One block of variables."""
        section = self.kinds[self.i]
        block = self.variable_block()
        if block.generic and pou.kind != "FUNCTION_BLOCK":
            what = f"a {pou.kind.lower()}"
            hint = "Write a VAR CONSTANT; blocks have generic constants."
            self.error("E0405", block.span, section=section, what=what, hint=hint)
        pou.blocks.append(block)

    def _drawn(self, pou: ast.Pou, opener: Opener) -> bool:
        """Let the body be read that is drawn between the head and the end that stands here."""
        for part in self.source.bodies:
            if part.drawn is not None and opener[1] < part.line <= self.lines[self.i]:
                reader = reader_of(part.language)
                assert isinstance(reader, DrawnReader)
                self.diagnostics += reader.read_drawn(self.source, part, pou)
                return True
        return False

    def _goes_on(self, pou: ast.Pou) -> bool:
        """Whether the graph of a body continues with what could be an object of its own."""
        if pou.graph is None:
            return False
        reader = reader_of(pou.graph.language)
        return isinstance(reader, TextReader) and reader.begins(self, pou)

    def _reader(self, pou: ast.Pou) -> TextReader:
        """The reader of the body that begins or continues here."""
        line = self.lines[self.i]
        for part in reversed(self.source.bodies):
            if part.line <= line:
                named = reader_of(part.language) if part.language else None
                if isinstance(named, TextReader):
                    return named
                break
        return next(reader for reader in text_readers() if reader.begins(self, pou))

    def _pass(self, kind: str) -> None:
        if self.kinds[self.i] == kind:
            self.i += 1

    def _foreign_end(self, kind: str) -> bool:
        """Step over an end keyword of something that was never begun, unless it is a slip of the own end."""
        if kind in SECTIONS or kind in OBJECT_HEADS:
            return True
        if kind is END or kind not in ENDS.values():
            return False
        if any(ENDS[begin] == kind for begin, _ in self.open):
            return False
        following = self.kinds[self.i + 1]
        if following is END or following in OBJECT_HEADS:
            return False
        self.error("E0106", found=kind, hint="Remove it or write the beginning it closes.")
        self.i += 1
        return True

    # -- properties and interfaces

    def property(self, owner: ast.Pou | ast.Interface | None = None) -> ast.Property:
        """PROPERTY name : type GET ... END_GET SET ... END_SET END_PROPERTY."""
        start = self.i
        opener = ("PROPERTY", self.lines[start])
        node = self._head(ast.Property, "property", type_ref=None)
        if self.take(":", "':' and a type", "Write 'PROPERTY name : type'."):
            node.type_ref = self.type_reference()
        if self.kinds[self.i] == ";":
            self.i += 1
        self.open.append(opener)
        while True:
            word = self.word()
            if word == "GET" and node.getter is None:
                node.getter = self._accessor("GET", node)
            elif word == "SET" and node.setter is None:
                node.setter = self._accessor("SET", node)
            elif self.kinds[self.i] in SECTIONS:
                hint = "Declare it in the GET or SET that uses it."
                self.error("E0114", what="A variable", where="a PROPERTY outside GET and SET", hint=hint)
                self.variable_block()
            else:
                break
        if self.kinds[self.i] not in BODY_END or self.kinds[self.i] == "END_VAR":
            self.expected("GET, SET or END_PROPERTY", "Statements belong between GET and END_GET.")
            self._skip_to("END_PROPERTY")
        self.open.pop()
        self.close(opener)
        node.span = self.span_from(start)
        return node

    def _accessor(self, word: str, of: ast.Property) -> ast.Accessor:
        """GET or SET of a property, which is read like a method."""
        start = self.i
        opener = (word, self.lines[start])
        self.i = start + 1
        while self.word() in ACCESS_SPECIFIERS and self.kinds[self.i + 1] not in _BEHIND_VARIABLE:
            self.i += 1  # the property says who may use it
        method = ast.Pou(
            span=NOWHERE, name=of.name, name_span=of.name_span, source=self.source, kind="METHOD"
        )
        while self.kinds[self.i] in SECTIONS:
            method.blocks.append(self.variable_block())
        bare = self.word() in ("GET", "SET") and self.kinds[self.i + 1] not in _BEHIND_VARIABLE
        if not bare and self.kinds[self.i] != "END_PROPERTY":
            self.open.append(opener)
            self._members(method, opener)
            self.open.pop()
            self.close(opener)
        return ast.Accessor(
            span=self.span_from(start), blocks=method.blocks, body=method.body, language=method.language
        )

    def interface(self) -> ast.Interface:
        """INTERFACE name EXTENDS a, b with the heads of methods and properties."""
        start = self.i
        opener = ("INTERFACE", self.lines[start])
        node = self._head(ast.Interface, "interface")
        if self.word() == "EXTENDS":
            self.i += 1
            bases = [self.qualified_name("interface")]
            while self.kinds[self.i] == ",":
                self.i += 1
                bases.append(self.qualified_name("interface"))
            node.extends = [name for name, _ in bases if name]
            node.extends_spans = [span for name, span in bases if name]
        self.open.append(opener)
        while True:
            kind = self.kinds[self.i]
            if kind == "METHOD":
                node.methods.append(self.pou(kind, node))
            elif kind == "PROPERTY":
                node.properties.append(self.property(node))
            elif kind == ";":
                self.i += 1
            elif kind in OBJECT_HEADS or kind in ENDS.values() or kind is END:
                break
            else:
                hint = "An interface has heads of methods and properties only."
                self.error("E0114", what=self.found(), where="an INTERFACE", hint=hint)
                self._skip_to("END_INTERFACE")
        self.open.pop()
        self.close(opener)
        node.span = self.span_from(start)
        return node

    def _skip_to(self, end: str) -> None:
        """Go to `end`, or to where the next object begins."""
        kinds = self.kinds
        while kinds[self.i] is not END and kinds[self.i] not in OBJECT_HEADS and kinds[self.i] != end:
            self.i += 1


def _adopt(pou: ast.Pou, child: ast.Pou | ast.Property) -> None:
    if isinstance(child, ast.Property):
        pou.properties.append(child)
        return
    child.owner = pou
    (pou.methods if child.kind == "METHOD" else pou.actions).append(child)

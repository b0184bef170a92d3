"""XML as a tree with line numbers, read without entities, and written in one canonical form.

The reader takes no document type declaration: entities are the way to make a small file large or to read
other files. Prefixes are resolved here and not by expat, because exports exist whose prefixes are undeclared.
"""

from __future__ import annotations

import gc
import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from xml.parsers import expat
from xml.sax.saxutils import escape

from tappet.project.exchange.decoding import decode_xml
from tappet.project.exchange.report import ExchangeError

_NO_MEMORY = expat.errors.codes[expat.errors.XML_ERROR_NO_MEMORY]
MAX_DEPTH = 200
MAX_NODES = 4_000_000
XHTML = "http://www.w3.org/1999/xhtml"
_XML = "http://www.w3.org/XML/1998/namespace"
_KNOWN_PREFIXES = {_XML: "xml", "http://www.w3.org/2001/XMLSchema-instance": "xsi"}
_DECLARATION = re.compile(r"\s*<\?xml[^>]*\?>")
_TC6 = re.compile(r"http://www\.plcopen\.org/xml/tc6")
_ILLEGAL = re.compile("[^\t\n\r\u0020-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")


@dataclass(slots=True)
class Element:
    """An element: its name without prefix, and its content in order."""

    tag: str
    namespace: str = ""
    attributes: dict[str, str] = field(default_factory=dict)
    """By name; those with a prefix by `{namespace}name`."""
    content: list[Element | str] = field(default_factory=list)
    line: int = 0
    """Line of its start tag, from 1; 0 in trees that were not read."""

    def __iter__(self) -> Iterator[Element]:
        return (item for item in self.content if isinstance(item, Element))

    def child(self, tag: str) -> Element | None:
        """The first child with this name."""
        return next((item for item in self if item.tag == tag), None)

    def children(self, tag: str) -> list[Element]:
        """All children with this name."""
        return [item for item in self if item.tag == tag]

    def find(self, path: str) -> Element | None:
        """The first element at a path of names joined by `/`."""
        found: list[Element] = [self]
        for tag in path.split("/"):
            found = [item for parent in found for item in parent.children(tag)]
        return found[0] if found else None

    def walk(self) -> Iterator[Element]:
        """This element and all below it, in the order of the document."""
        waiting = [self]
        while waiting:
            item = waiting.pop()
            yield item
            waiting.extend(reversed(list(item)))

    def get(self, name: str, default: str = "") -> str:
        """The value of an attribute."""
        return self.attributes.get(name, default)

    def text(self) -> str:
        """All text below, in order; the paragraphs of formatted text as lines."""
        pieces: list[str] = []
        paragraphs = 0
        waiting: list[Element | str] = [self]
        while waiting:
            item = waiting.pop()
            if isinstance(item, str):
                pieces.append(item)
                continue
            if item.tag == "br":
                pieces.append("\n")
            elif item.tag == "p":
                paragraphs += 1
                if paragraphs > 1:
                    pieces.append("\n")
            waiting.extend(reversed(item.content))
        return "".join(pieces)


def read_xml(source: str, content: bytes, skipped: frozenset[str] = frozenset()) -> Element:
    """The root of an XML file, without elements of the names in `skipped` and what is below them.

    Raises ExchangeError naming the line.
    """
    text = _DECLARATION.sub(
        lambda match: "\n" * match.group().count("\n"), decode_xml(source, content), count=1
    )
    return _Reader(source, skipped).read(text.lstrip("\ufeff"))


class _Reader:
    """Builds the tree from what expat reports; a name seen before costs one look-up."""

    def __init__(self, source: str, skipped: frozenset[str]) -> None:
        self.source = source
        self._skipped = skipped
        self._inside_skipped = 0
        """Depth below the outermost element that is skipped; 0 outside."""
        self._stack: list[Element] = []
        self._spaces: list[tuple[int, dict[str, str]]] = [(0, {"xml": _XML})]
        """Prefixes in force, with the depth of the element that declares them."""
        self._names: dict[str, tuple[str, str]] = {}
        """Name and namespace of tags under the prefixes in force."""
        self._root: Element | None = None
        self._pieces: list[str] = []
        self._nodes = 0
        self._parser = expat.ParserCreate("utf-8")
        self._parser.buffer_text = True
        self._parser.StartElementHandler = self._start
        self._parser.EndElementHandler = self._end
        self._parser.CharacterDataHandler = self._pieces.append
        self._parser.StartDoctypeDeclHandler = self._refuse
        self._parser.EntityDeclHandler = self._refuse

    def read(self, text: str) -> Element:
        collects = gc.isenabled()
        gc.disable()  # a tree makes no garbage, and the collector would walk all of it again and again
        try:
            self._parser.Parse(text.encode("utf-8", errors="replace"), True)
        except expat.ExpatError as error:
            if error.code == _NO_MEMORY:
                raise MemoryError from error
            raise ExchangeError(
                self.source, f"is no sound XML ({expat.ErrorString(error.code)})", error.lineno
            ) from error
        finally:
            if collects:
                gc.enable()
        assert self._root is not None, "a sound document has a root"
        return self._root

    def _refuse(self, *_: object) -> None:
        raise ExchangeError(
            self.source,
            "holds a document type declaration, which is not read; remove it",
            self._parser.CurrentLineNumber,
        )

    def _start(self, name: str, attributes: dict[str, str]) -> None:
        if self._inside_skipped:
            self._inside_skipped += 1
            return
        if self._pieces:
            self._flush()
        if name in self._skipped:
            self._inside_skipped = 1
            return
        stack = self._stack
        line = self._parser.CurrentLineNumber
        self._nodes += 1 + len(attributes)
        if len(stack) >= MAX_DEPTH:
            raise ExchangeError(self.source, f"has elements nested deeper than {MAX_DEPTH}", line)
        if self._nodes > MAX_NODES:
            raise ExchangeError(self.source, f"has more than {MAX_NODES} elements and attributes", line)
        for key in attributes:
            if ":" in key or key == "xmlns":
                attributes = self._resolved(attributes)
                break
        known = self._names.get(name)
        if known is None:
            prefix, _, local = name.rpartition(":")
            known = self._names[name] = local, self._spaces[-1][1].get(prefix, "")
        item = Element(known[0], known[1], attributes, [], line)
        if stack:
            stack[-1].content.append(item)
        else:
            self._root = item
        stack.append(item)

    def _resolved(self, attributes: dict[str, str]) -> dict[str, str]:
        """Attributes by name and namespace; what declares prefixes is taken out and holds from here on."""
        declared = {
            key.removeprefix("xmlns").removeprefix(":"): value
            for key, value in attributes.items()
            if key == "xmlns" or key.startswith("xmlns:")
        }
        if declared:
            self._spaces.append((len(self._stack) + 1, {**self._spaces[-1][1], **declared}))
            self._names = {}
        spaces = self._spaces[-1][1]
        plain: dict[str, str] = {}
        for key, value in attributes.items():
            if key == "xmlns" or key.startswith("xmlns:"):
                continue
            head, _, tail = key.rpartition(":")
            space = spaces.get(head, "") if head else ""
            plain[f"{{{space}}}{tail}" if space else tail] = value
        return plain

    def _end(self, _: str) -> None:
        if self._inside_skipped:
            self._inside_skipped -= 1
            self._pieces.clear()
            return
        if self._pieces:
            self._flush()
        if self._spaces[-1][0] == len(self._stack):
            self._spaces.pop()
            self._names = {}
        self._stack.pop()

    def _flush(self) -> None:
        if self._stack:
            self._stack[-1].content.append("".join(self._pieces))
        self._pieces.clear()


def xml_text(root: Element) -> str:
    """An element as text: the same tree always gives the same text, and reading it gives the same tree.

    Elements of the TC6 namespaces, whichever version, are written without one, so that the text may stand in
    a document of any of them.
    """
    pieces: list[str] = []
    waiting: list[tuple[Element | str | None, str]] = [(root, "")]
    while waiting:
        item, space = waiting.pop()
        if item is None:
            pieces.append(space)
            continue
        if isinstance(item, str):
            pieces.append(escape_text(item))
            continue
        own = "" if _TC6.match(item.namespace) else item.namespace
        pieces.append(f"<{item.tag}")
        if own != space:
            pieces.append(f' xmlns="{escape_attribute(own)}"')
        pieces.append(_attributes_text(item.attributes))
        if not item.content:
            pieces.append(" />")
            continue
        pieces.append(">")
        waiting.append((None, f"</{item.tag}>"))
        waiting.extend((part, own) for part in reversed(item.content))
    return "".join(pieces)


def _attributes_text(attributes: Mapping[str, str]) -> str:
    pieces = []
    for index, (name, value) in enumerate(attributes.items()):
        if name.startswith("{"):
            space, _, local = name[1:].partition("}")
            prefix = _KNOWN_PREFIXES.get(space, f"a{index}")
            if prefix != "xml":
                pieces.append(f' xmlns:{prefix}="{escape_attribute(space)}"')
            name = f"{prefix}:{local}"
        pieces.append(f' {name}="{escape_attribute(value)}"')
    return "".join(pieces)


def is_legal(text: str) -> bool:
    """Whether XML 1.0 can hold the text: it has no control characters but tabs and line breaks."""
    return _ILLEGAL.search(text) is None


def escape_text(text: str) -> str:
    """Text as element content."""
    return escape(text, {"\r": "&#13;"})


def escape_attribute(text: str) -> str:
    """Text as the value of an attribute in double quotes."""
    return escape(text, {'"': "&quot;", "\n": "&#10;", "\r": "&#13;", "\t": "&#9;"})

"""Writing XML line by line, indented, always the same for the same calls."""

from __future__ import annotations

import base64

from tappet.project.exchange.xml_tree import XHTML, escape_attribute, escape_text, is_legal


class XmlLines:
    """The lines of a document, and how deep the open elements are."""

    def __init__(self) -> None:
        self.lines: list[str] = []
        self.depth = 0

    def tag(self, tag: str, **attributes: str) -> OpenElement:
        """An element that is open in a `with` block."""
        return OpenElement(self, tag, attributes)

    def optional(self, tag: str, **attributes: str) -> OpenElement:
        """An element that is open in a `with` block, and is not written if nothing is in it."""
        return OpenElement(self, tag, attributes, optional=True)

    def empty(self, tag: str, **attributes: str) -> None:
        """An element without content."""
        self.line(f"<{tag}{_attributes_text(attributes)} />")

    def text_element(self, tag: str, text: str, html: bool = True, **attributes: str) -> None:
        """An element with a text in it, exactly; in base64 if XML cannot hold it."""
        if not is_legal(text):
            attributes["encoding"] = "base64"
            text = base64.b64encode(text.encode()).decode()
        inner = f'<xhtml xmlns="{XHTML}">{escape_text(text)}</xhtml>' if html else escape_text(text)
        self.line(f"<{tag}{_attributes_text(attributes)}>{inner}</{tag}>")

    def xhtml(self, text: str) -> None:
        """Formatted text of one paragraph."""
        self.line(f'<xhtml xmlns="{XHTML}">{escape_text(text)}</xhtml>')

    def line(self, text: str) -> None:
        """A line of XML as it is."""
        self.lines.append("  " * self.depth + text)


class OpenElement:
    """An element that is open as long as the context lasts; one without content is written as empty."""

    def __init__(
        self, lines: XmlLines, tag: str, attributes: dict[str, str], *, optional: bool = False
    ) -> None:
        self._optional = optional
        self._out = lines
        self._tag = tag
        self._attributes = attributes
        self._begun = 0

    def __enter__(self) -> None:
        self._out.line(f"<{self._tag}{_attributes_text(self._attributes)}>")
        self._out.depth += 1
        self._begun = len(self._out.lines)

    def __exit__(self, *_: object) -> None:
        self._out.depth -= 1
        if len(self._out.lines) == self._begun:
            self._out.lines.pop()
            if not self._optional:
                self._out.empty(self._tag, **self._attributes)
        else:
            self._out.line(f"</{self._tag}>")


def _attributes_text(attributes: dict[str, str]) -> str:
    return "".join(f' {name}="{escape_attribute(value)}"' for name, value in attributes.items())

"""Writes a text for the compiler, which knows the object and part that each of its lines comes from.

Kinds of objects write their text with a `SourceWriter`; `sources` says which texts an application has.
"""

from __future__ import annotations

from typing import Literal

from msgspec.structs import replace

from tappet.iec.languages import language_of
from tappet.iec.listing import listing_of
from tappet.iec.places import BodyText, Segment, SourceMap
from tappet.iec.sections import end_keyword
from tappet.project.data import BodyData
from tappet.project.model import ProjectObject

Part = Literal["declaration", "implementation"]


class SourceWriter:
    """Joins parts and keywords line by line and remembers which part each line came from."""

    def __init__(self) -> None:
        self.name: str | None = None
        """Name of the object where its text carries none."""
        self.body_line = 0
        self.line = 0
        self._segments: list[Segment] = []
        self._bodies: list[BodyText] = []
        self._pieces: list[str] = []

    def part(self, object_id: str, part: Part, text: str) -> None:
        """Append a part of an object."""
        self._append(Segment(self.line, object_id, part), text)

    def element(self, object_id: str, element: str, text: str) -> None:
        """Append lines that are about an element of a drawn object."""
        segment = Segment(self.line, object_id, "implementation", elements=((element, 0),), drawn=True)
        self._append(segment, text)

    def about(self, object_id: str, line: int, column: int, length: int, text: str) -> None:
        """Append a line that is about a range of the implementation of an object, which is not text here."""
        place = (column, column + length)
        self._append(Segment(self.line, object_id, "implementation", part_line=line, about=place), text)

    def keyword(self, text: str | None) -> None:
        """Append a line that is in no part; None appends nothing."""
        if text is not None:
            self._pieces.append(text)
            self.line += text.count("\n") + 1

    def declared_body(self, item: ProjectObject, data: BodyData) -> None:
        """Append the declaration and the body of an object, and the keyword that ends it."""
        self.part(item.id, "declaration", data.declaration)
        self.body(item, data.implementation, data.language)
        self.keyword(end_keyword(data.declaration))

    def body(self, item: ProjectObject, implementation: str, language: str) -> None:
        """Append the body that the text is all about."""
        self.body_line = self.line
        self.inner_body(item, item.name, implementation, language)

    def inner_body(self, item: ProjectObject, title: str, implementation: str, language: str) -> None:
        """Append a body: text, the listing of what is drawn, or an error where another tool has written what
        nothing here reads; `title` names it there."""
        known = language_of(language)
        form = known.form_of(implementation)
        segment = Segment(self.line, item.id, "implementation")
        if form == "drawn":
            self._bodies.append(BodyText(self.line, language, implementation))
            listing = listing_of(implementation)
            elements = tuple((element.id, element.line) for element in listing.elements)
            self._append(replace(segment, elements=elements, drawn=True), "\n".join(listing.lines))
        elif form == "kept":
            self._append(segment, _not_compiled(title, language))
        else:
            self._bodies.append(BodyText(self.line, language if known.named else ""))
            self._append(segment, implementation)

    def text(self) -> str:
        """Everything appended so far."""
        return "\n".join(self._pieces)

    def bodies(self) -> tuple[BodyText, ...]:
        """The bodies, if the language of one has to be said."""
        return tuple(self._bodies) if any(body.language for body in self._bodies) else ()

    def map(self) -> SourceMap:
        """What the lines show."""
        return SourceMap(tuple(self._segments))

    def _append(self, segment: Segment, text: str) -> None:
        width = len(text) - text.rfind("\n") - 1
        self._segments.append(replace(segment, count=text.count("\n") + 1, width=width))
        self.keyword(text)


def _not_compiled(name: str, language: str) -> str:
    return (
        f"{{error 'The body of {name} is in {language}, which cannot be compiled yet; it was imported "
        "and is kept unchanged; write it in ST to run it'}"
    )

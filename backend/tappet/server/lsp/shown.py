"""A document as one client shows it: places of the analysed text as places in the client's own lines.

Mostly both texts are the same. Where they are not (another user has edited the document, see
`shared_texts`), places in lines that both have are moved, and places in other lines are not published to this
client at all.
"""

from __future__ import annotations

from tappet.lang.services.documents import Position
from tappet.lang.services.results import ServiceError
from tappet.lang.source import Span
from tappet.server.lsp.positions import Line, to_position, to_range
from tappet.server.lsp.protocol import structures as lsp
from tappet.server.lsp.text_difference import TextDifference


class OtherTextError(ServiceError):
    """A line that the analysed text does not have: somebody else has edited the document since."""


class ShownDocument:
    """One document and its client."""

    __slots__ = ("_analysed", "_difference", "_shown", "document", "spelled")

    def __init__(
        self, document: str, spelled: str, analysed: Line, shown: Line, difference: TextDifference | None
    ) -> None:
        """`difference` is from the shown text to the analysed one; None where they are the same."""
        self.document = document
        self.spelled = spelled
        """Its uri as the client writes it."""
        self._analysed = analysed
        self._shown = shown
        self._difference = difference

    @property
    def is_other(self) -> bool:
        """Whether the client shows another text than the analysed one."""
        return self._difference is not None

    def line(self, number: int) -> str:
        """A line of the analysed text."""
        return self._analysed(number)

    def shown_line(self, number: int) -> int | None:
        """A line of the analysed text as the client counts it; None for one that it does not show."""
        return number if self._difference is None else self._difference.to_here(number)

    def range(self, span: Span) -> lsp.Range | None:
        """A range of the analysed text for the client; None when it lies in lines that are not shown."""
        found = to_range(self._analysed, span)
        if self._difference is None:
            return found
        moved = self._difference.span_to_here(span)
        if moved is None:
            return None
        return lsp.Range(
            lsp.Position(moved.line, found.start.character), lsp.Position(moved.end_line, found.end.character)
        )

    def own_position(self, position: lsp.Position) -> Position:
        """A position of the client in its own text."""
        return to_position(self._shown, position)

    def position(self, position: lsp.Position) -> Position:
        """A position of the client in the analysed text. Raises OtherTextError."""
        found = self.own_position(position)
        if self._difference is None:
            return found
        line = self._difference.to_there(found.line)
        if line is None:
            raise OtherTextError(
                f"Somebody else has edited '{self.spelled}'; line {found.line + 1} is not part of it. "
                "Edit it here, or read the other text"
            )
        return Position(line, found.column)

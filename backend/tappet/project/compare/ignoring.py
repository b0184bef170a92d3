"""What of a text does not count in a comparison: white space, comments, pragmas."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from tappet.iec.languages import is_plain_text
from tappet.iec.tokens import COMMENT, PRAGMA, blanked, pieces
from tappet.project.data import BodyData
from tappet.project.model import ProjectObject


@dataclass(frozen=True, slots=True)
class Ignoring:
    """What does not count. By default everything does."""

    white_space: bool = False
    """Blanks and line ends between words; those inside of strings always count."""
    comments: bool = False
    pragmas: bool = False

    def same(self, old: Any, new: Any, *, iec: bool) -> bool:
        """Whether two values of a field are the same; `iec` says that texts are in an IEC language."""
        if old == new:
            return True
        if not isinstance(old, str) or not isinstance(new, str) or self == EVERYTHING_COUNTS:
            return False
        return self._counted(old, iec) == self._counted(new, iec)

    def _counted(self, text: str, iec: bool) -> list[str]:
        """What counts of a text, in pieces."""
        if not iec:
            return text.split() if self.white_space else [text]
        kinds = [COMMENT] * self.comments + [PRAGMA] * self.pragmas
        if self.white_space:
            return [
                " ".join(piece.split()) if kind == COMMENT else piece
                for kind, piece, _, _ in pieces(text)
                if kind not in kinds
            ]
        # Where a comment stood alone, its line does not count either.
        before = text.split("\n")
        after = blanked(text, *kinds).split("\n")
        return [
            line.rstrip() if line != was else line
            for was, line in zip(before, after, strict=True)
            if line == was or line.strip()
        ]


EVERYTHING_COUNTS = Ignoring()


def is_iec_text(item: ProjectObject, field: str) -> bool:
    """Whether a text of an object is in an IEC language, so that comments and pragmas are known in it."""
    if field == "implementation" and isinstance(item.data, BodyData):
        return is_plain_text(item.data.language)
    return field in ("declaration", "implementation")

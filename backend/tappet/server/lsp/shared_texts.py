"""The unsaved texts of all sessions of a project, and which of them the shared analysis takes.

The rule: of a document that several sessions have open, the analysis takes the newest edit. A text that is
the stored one when it is opened or typed is no edit: opening an object never hides what somebody else is
writing in it, and neither does reading it again after it was saved. When the session of the newest edit
closes the document, the newest edit of the others counts, or else the stored text.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

Stored = Callable[[str], str | None]
"""The stored text of a document; None when there is none, or none is known."""


def nothing_stored(document: str) -> str | None:
    """Where only one session has texts, each of them counts."""
    return None


@dataclass(slots=True)
class _Shown:
    text: str
    edit: int
    """Number of the edit; 0 for what was the stored text."""


class SharedTexts:
    """Texts by document and session."""

    def __init__(self, stored: Stored = nothing_stored) -> None:
        self.stored = stored
        self._shown: dict[str, dict[object, _Shown]] = {}
        self._edits = 0

    def put(self, session: object, document: str, text: str) -> None:
        """A session shows this text of a document."""
        self._edits += 1
        edit = 0 if text == self.stored(document) else self._edits
        self._shown.setdefault(document, {})[session] = _Shown(text, edit)

    def drop(self, session: object, document: str) -> None:
        """A session shows a document no longer."""
        shown = self._shown.get(document, {})
        shown.pop(session, None)
        if not shown:
            self._shown.pop(document, None)

    def taken(self, document: str) -> str | None:
        """The text that the analysis takes; None: the stored one."""
        newest = max(self._shown.get(document, {}).values(), key=lambda shown: shown.edit, default=None)
        return newest.text if newest is not None and newest.edit else None

    def analysed(self, document: str) -> str | None:
        """The text that the analysis takes, also when it is the stored one."""
        taken = self.taken(document)
        return taken if taken is not None else self.stored(document)

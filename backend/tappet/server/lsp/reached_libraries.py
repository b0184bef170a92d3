"""Which texts of libraries a program reaches: its messages come before the others are analysed."""

from __future__ import annotations

from collections import deque
from collections.abc import Collection, Sequence

from tappet.lang.source import Source
from tappet.libraries.named import KEPT, index_of, known_index, named_texts


class ReachedLibraries:
    """Answers from the index of library texts in the user's cache folder (`libraries.named`)."""

    def __init__(self) -> None:
        self._made: deque[Sequence[Source]] = deque(maxlen=KEPT)
        """Libraries whose index is there: their texts need not be read once more to find that out."""

    def reached(self, libraries: Sequence[Source], own: Sequence[Source]) -> Collection[Source] | None:
        """The texts that a program of the texts `own` reaches; None while there is no index."""
        index = known_index(libraries)
        return None if index is None or index.everything else named_texts(libraries, own, index)

    def make(self, libraries: Sequence[Source]) -> None:
        """Make the index if there is none; these libraries are analysed."""
        if libraries not in self._made:
            index_of(libraries)
            self._made.append(libraries)

"""Comparisons that are open: what projects are compared with is kept while somebody looks at it."""

from __future__ import annotations

import secrets
from collections import OrderedDict
from dataclasses import dataclass, field
from datetime import datetime
from threading import Lock

from tappet.project.compare.differences import Comparison
from tappet.project.compare.ignoring import Ignoring
from tappet.project.model import Project
from tappet.project.store import Store
from tappet.server.problems import Problem

MOST_OF_A_USER = 4
MOST = 16
"""The ones that nobody asked for longest go; a whole project is in each."""


@dataclass(slots=True)
class OpenComparison:
    """What a project is compared with."""

    project_id: str
    user_id: str
    title: str
    old: Project
    at: datetime | None = None
    revision: int | None = None
    """Of the project; None: as it is."""
    notes: tuple[str, ...] = ()
    id: str = field(default_factory=lambda: secrets.token_hex(16))
    _last: tuple[int, Ignoring, Comparison] | None = None

    def with_project(self, store: Store, ignoring: Ignoring) -> tuple[int, Comparison]:
        """The comparison with the project as it is now, and its revision. Raises UnknownProjectError."""
        number = self.revision if self.revision is not None else store.project(self.project_id).revision
        last = self._last
        if last is not None and last[:2] == (number, ignoring):
            return number, last[2]
        if self.revision is None:
            info, new = store.snapshot(self.project_id)
            number = info.revision
        else:
            new = store.project_at(self.project_id, self.revision)
        comparison = Comparison(self.old, new, ignoring)
        self._last = number, ignoring, comparison
        return number, comparison


class Comparisons:
    """The open comparisons of a server, by id."""

    def __init__(self) -> None:
        self._open: OrderedDict[str, OpenComparison] = OrderedDict()
        self._lock = Lock()

    def add(self, comparison: OpenComparison) -> OpenComparison:
        """Keep a comparison; older ones may go."""
        with self._lock:
            mine = [key for key, one in self._open.items() if one.user_id == comparison.user_id]
            for key in mine[: max(0, len(mine) + 1 - MOST_OF_A_USER)]:
                del self._open[key]
            while len(self._open) >= MOST:
                self._open.popitem(last=False)
            self._open[comparison.id] = comparison
        return comparison

    def get(self, project_id: str, comparison_id: str, user_id: str) -> OpenComparison:
        """A comparison of a user. Raises a 404 problem."""
        with self._lock:
            found = self._open.get(comparison_id)
            if found is None or (found.project_id, found.user_id) != (project_id, user_id):
                raise Problem(404, "not-found", "This comparison is not open any more; compare again.")
            self._open.move_to_end(comparison_id)
            return found

    def close(self, project_id: str, comparison_id: str, user_id: str) -> None:
        """Forget a comparison of a user. Raises a 404 problem."""
        self.get(project_id, comparison_id, user_id)
        with self._lock:
            self._open.pop(comparison_id, None)

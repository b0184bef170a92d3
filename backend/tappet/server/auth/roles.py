"""The four roles, each including the ones below it."""

from __future__ import annotations

from enum import StrEnum


class Role(StrEnum):
    """What a user may do."""

    VIEWER = "viewer"
    """Sees projects and live values."""
    OPERATOR = "operator"
    """Also writes and forces values, starts and stops."""
    ENGINEER = "engineer"
    """Also edits projects, builds and downloads."""
    ADMIN = "admin"
    """Also keeps the users."""

    @property
    def rank(self) -> int:
        """0 for the least."""
        return list(Role).index(self)

    def includes(self, other: Role) -> bool:
        """Whether this role may do what `other` may."""
        return self.rank >= other.rank

    def at_most(self, other: Role) -> Role:
        """The lesser of both."""
        return self if self.rank <= other.rank else other

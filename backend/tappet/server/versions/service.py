"""The versions of an application, out of the audit log and the packages that are kept."""

from __future__ import annotations

from sqlalchemy import Connection, select

from tappet.project.model import Project
from tappet.server.audit import Result
from tappet.server.builds.packages import PackageStore
from tappet.server.problems import Problem
from tappet.server.tables import audit
from tappet.server.versions.shapes import Version

MOST = 200
"""Versions of one answer."""
LOADED = ("download", "online-change")
"""What the audit log calls it."""


def versions(
    db: Connection,
    packages: PackageStore,
    project_id: str,
    application: str,
    runtime_id: str,
    runs: str | None,
) -> list[Version]:
    """The newest first; `runs` is the code that the runtime has now."""
    query = (
        select(audit.c.at, audit.c.username, audit.c.action, audit.c.new_value)
        .where(
            audit.c.action.in_(LOADED),
            audit.c.result == Result.OK.value,
            audit.c.project_id == project_id,
            audit.c.runtime_id == runtime_id,
            audit.c.subject == application,
            audit.c.new_value.is_not(None),
        )
        .order_by(audit.c.id.desc())
        .limit(MOST)
    )
    found: list[Version] = []
    for at, username, how, code_id in db.execute(query):
        first = runs == code_id and not any(version.runs for version in found)
        kept = packages.has_source(code_id)
        found.append(Version(code_id=code_id, at=at, username=username, how=how, runs=first, kept=kept))
    return found


def source_of(packages: PackageStore, code_id: str) -> Project:
    """The project that a version was built from. Raises the problem `no-source`."""
    found = packages.source(code_id)
    if found is None:
        raise Problem(
            409,
            "no-source",
            "This server does not have the source of that version any more; the newest ten of an application "
            "are kept. Choose a newer one.",
        )
    return found[0]

"""Search and replace in a project."""

from __future__ import annotations

from dataclasses import dataclass

from tappet.project.model import Project
from tappet.project.search.finding import find_in_project
from tappet.project.search.pattern import Pattern, replacement
from tappet.project.search.replacing import replace_in_project
from tappet.project.store import Store
from tappet.server.dependencies import Engineer, StoreDep, Viewer
from tappet.server.routing import Router
from tappet.server.search.library_search import find_in_libraries
from tappet.server.search.replies import search_report
from tappet.server.search.shapes import (
    ReplaceOrder,
    ReplaceReport,
    SearchOrder,
    SearchReport,
    UndoReport,
)
from tappet.server.shapes import Number

router = Router(prefix="/projects/{project_id}", tags=["search"])


@router.post("/search")
def search(project_id: str, body: SearchOrder, who: Viewer, store: StoreDep) -> SearchReport:
    """Search names, texts and tables of the objects of a project, or the libraries that it refers to.

    An answer has at most `limit` hits; `next` says where to go on. A text that is no regular expression is
    the problem `invalid-pattern` (422).
    """
    project = store.load(project_id)
    replace = None if body.replacement is None else replacement(Pattern(body.query()), body.replacement)
    if body.libraries:
        return find_in_libraries(project, body.query(), after=body.after, limit=body.limit)
    return search_report(
        find_in_project(
            project,
            body.query(),
            within=body.within,
            children=body.children,
            after=body.after,
            limit=body.limit,
        ),
        replace,
    )


@router.post("/replace")
def replace(project_id: str, body: ReplaceOrder, who: Engineer, store: StoreDep) -> ReplaceReport:
    """Replace chosen hits of a search, all of them or none, as one change of the project.

    When somebody else has changed one of the objects since, the answer is the problem `stale-revision` (409),
    and nothing was written.
    """
    query = body.query.query()
    pattern = Pattern(query)
    replaced = replacement(pattern, body.replacement)
    chosen = {one.object_id: one.hits for one in body.objects}

    def changed(project: Project) -> tuple[Project, _Replaced]:
        result, hits = replace_in_project(project, query, pattern, replaced, chosen)
        before = project.objects
        others = [before[key] for key, item in result.objects.items() if item != before[key]]
        return result, _Replaced(hits, tuple((item.id, item.revision + 1) for item in others))

    bases: list[tuple[str, int, dict[str, object]]] = [
        (one.object_id, one.base_revision, {}) for one in body.objects
    ]
    comment = f"{body.query.text} → {body.replacement}"
    outcome = store.edit(project_id, who.username, "replace", changed, comment, bases=bases)
    return ReplaceReport(
        hits=outcome.hits,
        objects=len(outcome.objects),
        revision=_change_of(store, project_id, outcome.objects),
    )


@dataclass(frozen=True, slots=True)
class _Replaced:
    hits: int
    objects: tuple[tuple[str, int], ...]
    """Those that are not as they were, each with its new revision."""


def _change_of(store: Store, project_id: str, objects: tuple[tuple[str, int], ...]) -> int | None:
    """The change of the project that gave objects these revisions."""
    for object_id, revision in objects:
        for state in store.object_revisions(project_id, object_id):
            if state.revision == revision:
                return state.project_revision
    return None


@router.post("/revisions/{revision}/undo")
def undo_change(project_id: str, revision: Number, who: Engineer, store: StoreDep) -> UndoReport:
    """Take back one change of the project, as a new change.

    When one of its objects was changed again, the answer is the problem `changed-since` (409).
    """
    return UndoReport(revision=store.undo_change(project_id, revision, who.username))

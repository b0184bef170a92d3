"""Comparing a project, and taking differences over into it."""

from __future__ import annotations

from typing import Annotated, Any

from fastapi import Query, UploadFile

from tappet.project.compare.differences import Comparison, Difference
from tappet.project.compare.ignoring import EVERYTHING_COUNTS, Ignoring
from tappet.project.compare.taking import Take, UnknownDifferenceError, take
from tappet.project.model import Project, ProjectObject
from tappet.project.store import Store
from tappet.server.audit import Act
from tappet.server.audited import ActRecord, audited
from tappet.server.auth.roles import Role
from tappet.server.comparisons.service import OpenComparison
from tappet.server.comparisons.shapes import (
    ComparedObject,
    ComparedProject,
    ComparedRuntime,
    ComparisonDetail,
    DifferenceDetail,
    DifferenceItem,
    MergeOrder,
    MergeOutcome,
    NewComparison,
    TakenDifference,
)
from tappet.server.dependencies import ServicesDep, StoreDep, Viewer
from tappet.server.problems import Problem
from tappet.server.projects.routes import MAX_ARCHIVE_BYTES
from tappet.server.routing import Router
from tappet.server.services import Services

router = Router(prefix="/projects/{project_id}/comparisons", tags=["comparisons"])
Flag = Annotated[bool, Query(description="Differences in nothing else are left out.")]


@router.post("", status_code=201)
def open_comparison(
    project_id: str, body: NewComparison, who: Viewer, store: StoreDep, services: ServicesDep
) -> ComparisonDetail:
    """Compare a project, or a revision of it, with another one, with a revision, or with what runs."""
    store.project(project_id)
    if isinstance(body.old, ComparedProject):
        opened = _with_project(store, project_id, who.user_id, body.old)
    else:
        opened = _with_runtime(services, project_id, who.user_id, body.old)
    opened.revision = body.revision
    return _answer(services.comparisons.add(opened), store, EVERYTHING_COUNTS)


@router.post("/files", status_code=201, max_body_size=MAX_ARCHIVE_BYTES)
def open_comparison_with_files(
    project_id: str, files: list[UploadFile], who: Viewer, store: StoreDep, services: ServicesDep
) -> ComparisonDetail:
    """Compare a project with a project folder or archive of our own, or with files of other systems."""
    from tappet.server.exchange.uploads import Upload  # all formats: only for who imports

    name = store.project(project_id).name
    read = Upload(files).as_project(name)
    title = ", ".join(file.filename or "file" for file in files[:3]) + (", ..." if len(files) > 3 else "")
    notes = tuple(str(entry) for entry in read.report.noteworthy())
    opened = OpenComparison(project_id, who.user_id, title[:200], read.project, notes=notes)
    return _answer(services.comparisons.add(opened), store, EVERYTHING_COUNTS)


def _with_project(store: Store, project_id: str, user_id: str, old: ComparedProject) -> OpenComparison:
    info, project = store.snapshot(old.project_id)
    if old.revision is None:
        return OpenComparison(project_id, user_id, info.name, project, info.changed_at)
    then = store.project_at(old.project_id, old.revision)
    title = f"{info.name} ({old.revision})"
    return OpenComparison(project_id, user_id, title, then)


def _with_runtime(services: Services, project_id: str, user_id: str, old: ComparedRuntime) -> OpenComparison:
    link = services.runtimes.get(old.runtime_id)
    if not link.connected:
        link.loaded_symbols()  # raises the problem that says since when
    info = link.info
    if info is None or info.code_id is None:
        raise Problem(409, "nothing-loaded", f"There is no application in '{link.name}'.")
    source = services.commissioning.packages.source(info.code_id)
    if source is None:
        raise Problem(
            409,
            "no-source",
            f"'{link.name}' runs '{info.application}', whose source this server does not have: another one "
            "downloaded it, or a version before sources were kept. Download it from here to compare with it, "
            "or upload the source that the controller keeps as a project and compare with that.",
        )
    project, at = source
    return OpenComparison(project_id, user_id, f"{link.name}: {info.application}", project, at)


@router.get("/{comparison_id}")
def read_comparison(
    project_id: str,
    comparison_id: str,
    who: Viewer,
    store: StoreDep,
    services: ServicesDep,
    ignore_white_space: Flag = False,
    ignore_comments: Flag = False,
    ignore_pragmas: Flag = False,
) -> ComparisonDetail:
    """What differs by now."""
    opened = services.comparisons.get(project_id, comparison_id, who.user_id)
    return _answer(opened, store, Ignoring(ignore_white_space, ignore_comments, ignore_pragmas))


@router.get("/{comparison_id}/objects/{key}")
def read_difference(
    project_id: str, comparison_id: str, key: str, who: Viewer, store: StoreDep, services: ServicesDep
) -> DifferenceDetail:
    """The data of an object on both sides."""
    opened = services.comparisons.get(project_id, comparison_id, who.user_id)
    difference = _difference(opened.with_project(store, EVERYTHING_COUNTS)[1], key)
    return DifferenceDetail(old=_data(difference.old), new=_data(difference.new))


@router.post("/{comparison_id}/merge", max_body_size=MAX_ARCHIVE_BYTES)
def merge_differences(
    act: Annotated[ActRecord, audited("project-merged", Role.ENGINEER)],
    project_id: str,
    comparison_id: str,
    body: MergeOrder,
    store: StoreDep,
    services: ServicesDep,
) -> MergeOutcome:
    """Take differences over into the project as it is, as one change, which can be undone.

    If somebody changed one of the objects since it was compared (`base_revision`), the answer is the problem
    `changed-since` (409), and nothing was changed.
    """
    opened = services.comparisons.get(project_id, comparison_id, act.who.user_id)
    if opened.revision is not None:
        raise Problem(409, "earlier-revision", "An earlier revision of the project cannot be changed.")
    name = store.project(project_id).name
    act.begin(Act("project-merged", name, None, f"{len(body.take)} of {opened.title}", project_id))
    before: set[tuple[str, int]] = set()

    def merged(project: Project) -> tuple[Project, None]:
        before.update((item.id, item.revision) for item in project.objects.values())
        comparison = Comparison(opened.old, project)
        for one in body.take:
            new = _difference(comparison, one.key).new
            if one.base_revision is not None and new is not None and new.revision != one.base_revision:
                raise Problem(
                    409,
                    "changed-since",
                    f"'{new.name}' was changed after it was compared; compare again.",
                )
        return take(comparison, [_take(one) for one in body.take]), None

    comment = body.comment or opened.title
    store.edit(project_id, act.who.username, "merge", merged, comment)
    after = {(item.id, item.revision) for item in store.tree(project_id)}
    touched = {object_id for object_id, _ in before ^ after}
    return MergeOutcome(project_revision=store.project(project_id).revision, touched=sorted(touched))


@router.delete("/{comparison_id}", status_code=204)
def close_comparison(project_id: str, comparison_id: str, who: Viewer, services: ServicesDep) -> None:
    """Forget what the project was compared with."""
    services.comparisons.close(project_id, comparison_id, who.user_id)


def _take(one: TakenDifference) -> Take:
    return Take(one.key, one.whole, one.name, one.place, tuple(one.fields), one.texts)


def _difference(comparison: Comparison, key: str) -> Difference:
    try:
        return comparison.differences[key]
    except KeyError:
        raise UnknownDifferenceError(
            "This object does not differ any more, or was deleted; compare again"
        ) from None


def _data(item: ProjectObject | None) -> dict[str, Any] | None:
    return None if item is None else item.data.model_dump(mode="json")


def _answer(opened: OpenComparison, store: Store, ignoring: Ignoring) -> ComparisonDetail:
    number, comparison = opened.with_project(store, ignoring)
    return ComparisonDetail(
        id=opened.id,
        title=opened.title,
        at=opened.at,
        project_revision=number,
        can_merge=opened.revision is None,
        differences=[_item(comparison, one) for one in comparison.differences.values()],
        notes=list(opened.notes),
    )


def _item(comparison: Comparison, one: Difference) -> DifferenceItem:
    return DifferenceItem(
        key=one.key,
        state=one.state,
        kind=one.item.kind,
        subkind=one.item.subkind,
        old=_side(comparison.old, one.old),
        new=_side(comparison.new, one.new),
        fields=list(one.fields),
        renamed=one.renamed,
        moved=one.moved,
        reordered=one.reordered,
    )


def _side(project: Project, item: ProjectObject | None) -> ComparedObject | None:
    if item is None:
        return None
    return ComparedObject(id=item.id, name=item.name, path=project.path_of(item.id), revision=item.revision)

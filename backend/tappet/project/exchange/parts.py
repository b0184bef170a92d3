"""Parts of a project on their way out: what is chosen with what is above and below it, and ST texts."""

from __future__ import annotations

from collections.abc import Collection

from tappet.project.errors import UnknownObjectError
from tappet.project.folder.filenames import stem_of
from tappet.project.library_texts import text_with_parts
from tappet.project.model import Project, ProjectObject, is_pous_root
from tappet.project.placement import owner_of
from tappet.project.sources import compiled


def chosen_ids(project: Project, ids: Collection[str], without: Collection[str] = ()) -> frozenset[str]:
    """These objects (none: all roots) with all below them, but not those of `without` and what is below them.

    Of names in one line from a root the nearest decides, so that any choice can be told by few of them.
    Raises UnknownObjectError.
    """
    named = {project.get(object_id).id: True for object_id in ids}
    named |= {project.get(object_id).id: False for object_id in without}
    chosen: dict[str | None, bool] = {None: not ids}
    for item in project.walk():
        chosen[item.id] = named.get(item.id, chosen[item.parent_id])
    return frozenset(object_id for object_id, taken in chosen.items() if taken and object_id is not None)


def part_of(project: Project, ids: Collection[str], without: Collection[str] = ()) -> Project:
    """The objects of `chosen_ids`, and what they stand in. Raises UnknownObjectError."""
    kept = set(chosen_ids(project, ids, without))
    for object_id in tuple(kept):
        kept.update(item.id for item in project.ancestors(object_id))
    objects: dict[str, ProjectObject] = {}
    places: dict[tuple[str | None, bool], int] = {}
    for item in project.walk():
        if item.id in kept:
            view = item.parent_id, is_pous_root(item.parent_id, item.kind)
            index = places.get(view, 0)
            places[view] = index + 1
            objects[item.id] = item.model_copy(update={"index": index})
    return Project(project.name, project.description, objects)


def st_files(project: Project) -> dict[str, str]:
    """The ST text of every POU, type, interface and variable list by path, in the folders of the tree.

    Raises UnknownObjectError when there is none.
    """
    found = {}
    for item in project.walk():
        if compiled(item).source is not None and not _is_member(project, item):
            names = [above.name for above in project.ancestors(item.id)][::-1]
            found["/".join([*map(stem_of, names), f"{stem_of(item.name)}.st"])] = text_with_parts(
                project, item
            )
    if not found:
        raise UnknownObjectError("Nothing of what was chosen is ST text: no POU, type or variable list")
    return found


def _is_member(project: Project, item: ProjectObject) -> bool:
    """Whether the text of an object is a part of the text of its owner."""
    owner = owner_of(project, item.parent_id)
    return owner is not None and compiled(owner).members != "none"

"""The store: projects and objects, every revision of them, and who is notified of changes."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any, TypeVar

from tappet.project import edit
from tappet.project.model import Project, ProjectObject
from tappet.project.store import history
from tappet.project.store.changes import apply_project
from tappet.project.store.project_list import ProjectList
from tappet.project.store.records import ChangeEvent, ObjectContent, ObjectSummary, ProjectInfo
from tappet.project.store.rows import read_files, read_info, read_project, read_summaries
from tappet.project.store.saving import check_base, read_object, save_data, with_contents, with_index
from tappet.project.store.undoing import NotUndoableError, Step, steps_of, undo_change

T = TypeVar("T")


class Store(ProjectList):
    """Projects in a database. All methods block for it; call them from threads, several at once if needed.

    Every change of a project locks its row, so that changes of one project follow each other.
    """

    # -- objects ------------------------------------------------------------------------------------

    def load(self, project_id: str, *, with_files: bool = False) -> Project:
        """A whole project as it is. Raises UnknownProjectError."""
        return self.snapshot(project_id, with_files=with_files)[1]

    def snapshot(self, project_id: str, *, with_files: bool = False) -> tuple[ProjectInfo, Project]:
        """A whole project and the revision it has. Raises UnknownProjectError."""
        with self._reading.begin() as connection:
            stored = read_project(connection, read_info(connection, project_id), with_files=with_files)
            return stored.info, stored.project

    def tree(self, project_id: str) -> list[ObjectSummary]:
        """All objects without their data. Raises UnknownProjectError."""
        with self._reading.begin() as connection:
            read_info(connection, project_id)
            return read_summaries(connection, project_id)

    def get(self, project_id: str, object_id: str) -> ProjectObject:
        """One object. Raises UnknownProjectError, UnknownObjectError."""
        with self._reading.begin() as connection:
            read_info(connection, project_id)
            return with_index(connection, project_id, read_object(connection, project_id, object_id))

    def save(
        self,
        project_id: str,
        object_id: str,
        base_revision: int,
        data: Any,
        author: str,
        *,
        comment: str = "",
        autosave: bool = False,
    ) -> ProjectObject:
        """Store other data of an object that was read at `base_revision`.

        Autosaves that follow each other shortly leave one revision, explicit saves are kept for ever.
        Raises StaleRevision with both versions, InvalidDataError, UnknownObjectError, UnknownProjectError.
        """
        with self.engine.begin() as connection:
            info = read_info(connection, project_id, lock=True)
            saved, event = save_data(
                connection, info, object_id, base_revision, data, author, comment, autosave
            )
        self._notify(event)
        return saved

    def save_all(
        self, project_id: str, contents: Sequence[ObjectContent], author: str, *, comment: str = ""
    ) -> list[ProjectObject]:
        """Store other data of several objects as one change of the project: all of them, or none.

        Raises StaleRevision for the first that somebody else has changed, InvalidDataError,
        UnknownObjectError, UnknownProjectError.
        """
        with self.engine.begin() as connection:
            info = read_info(connection, project_id, lock=True)
            stored = read_project(connection, info)
            wanted = with_contents(connection, info, stored.project, contents)
            result, event = apply_project(connection, stored, wanted, "save", author, comment)
        self._notify(event)
        return [result.get(content.object_id) for content in contents]

    def add(
        self,
        project_id: str,
        author: str,
        parent_id: str | None,
        kind: str,
        name: str | None = None,
        *,
        subkind: str | None = None,
        language: str | None = None,
        data: Mapping[str, Any] | None = None,
        index: int | None = None,
        comment: str = "",
    ) -> ProjectObject:
        """Add an object; see `edit.add_object`."""
        return self.edit(
            project_id,
            author,
            "add",
            lambda project: edit.add_object(
                project,
                parent_id,
                kind,
                name,
                subkind=subkind,
                language=language,
                data=data,
                index=index,
            ),
            comment,
        )

    def copy(
        self,
        project_id: str,
        author: str,
        object_id: str,
        parent_id: str | None,
        *,
        index: int | None = None,
        source_project_id: str | None = None,
        comment: str = "",
    ) -> ProjectObject:
        """Copy an object with all below it, also from another project; see `edit.copy_object`."""
        source = None
        if source_project_id not in (None, project_id):
            source = self.load(str(source_project_id))
        return self.edit(
            project_id,
            author,
            "copy",
            lambda project: edit.copy_object(project, object_id, parent_id, index=index, source=source),
            comment,
        )

    def arrange(
        self,
        project_id: str,
        author: str,
        object_id: str,
        *,
        name: str | None = None,
        place: tuple[str | None, int | None] | None = None,
        excluded: bool | None = None,
        base_revision: int | None = None,
        comment: str = "",
    ) -> ProjectObject:
        """Rename an object, put it at `place` (parent, index or None for the end), exclude it from the build.

        Raises StaleRevision when `base_revision` is given and old, and what `edit` raises.
        """

        def arranged(project: Project) -> tuple[Project, ProjectObject]:
            if name is not None:
                project = edit.rename_object(project, object_id, name)
            if place is not None:
                project = edit.move_object(project, object_id, *place)
            if excluded is not None:
                project = edit.exclude_object(project, object_id, excluded)
            return project, project.get(object_id)

        yours = {} if name is None else {"name": name}
        bases = [] if base_revision is None else [(object_id, base_revision, yours)]
        action = "rename" if name is not None else "move" if place is not None else "build"
        moved = object_id if place is not None else None
        return self.edit(project_id, author, action, arranged, comment, bases=bases, moved=moved)

    def delete(self, project_id: str, author: str, *object_ids: str, comment: str = "") -> None:
        """Delete objects and all below them as one change; their revisions stay.

        Raises UnknownObjectError, NeededObjectError.
        """

        def without(project: Project) -> tuple[Project, None]:
            return edit.delete_objects(project, object_ids), None

        self.edit(project_id, author, "delete", without, comment)

    def edit(
        self,
        project_id: str,
        author: str,
        action: str,
        change: Callable[[Project], tuple[Project, T]],
        comment: str = "",
        *,
        bases: Sequence[tuple[str, int, Mapping[str, Any]]] = (),
        moved: str | None = None,
    ) -> T:
        """Make any change of a project as one revision: `change` gets it as it is and returns what shall be.

        An object that `change` returns comes back with its stored revision. Each of `bases` is (object id,
        revision, yours) to be checked first. Raises StaleRevision, UnknownProjectError, and whatever `change`
        raises.
        """
        with self.engine.begin() as connection:
            info = read_info(connection, project_id, lock=True)
            for base in bases:
                check_base(connection, project_id, *base)
            stored = read_project(connection, info)
            wanted, outcome = change(stored.project)
            result, event = apply_project(connection, stored, wanted, action, author, comment, moved=moved)
        self._notify(event)
        known = result.objects.get(outcome.id) if isinstance(outcome, ProjectObject) else None
        return outcome if known is None else known  # type: ignore[return-value]

    # -- history ------------------------------------------------------------------------------------

    def undo(self, project_id: str, author: str, *, redo: bool = False) -> tuple[Step, ChangeEvent | None]:
        """Take back the last change of the tree by this author, or with `redo` what was undone last.

        The event is None when the project is so already. Raises NotUndoableError, ChangedSinceError,
        UnknownProjectError, and what the outcome would have wrong.
        """
        with self.engine.begin() as connection:
            info = read_info(connection, project_id, lock=True)
            steps = steps_of(connection, project_id, author)
            step = steps.redo if redo else steps.undo
            if step is None:
                raise NotUndoableError(f"There is nothing to {'redo' if redo else 'undo'}")
            _, event = undo_change(connection, info, step.revision, author, redo=redo)
        self._notify(event)
        return step, event

    def revert_object(
        self, project_id: str, object_id: str, revision: int, author: str, *, comment: str = ""
    ) -> ProjectObject:
        """Give an object the name and data of a revision again, as a new revision; its place stays.

        A deleted object comes back where it was, with what was deleted below it in the same change.
        Raises UnknownRevisionError, NameTakenError, NotPlaceableError (its parent is gone too).
        """
        with self.engine.begin() as connection:
            info = read_info(connection, project_id, lock=True)
            stored = read_project(connection, info)
            then, position = history.object_at(connection, project_id, object_id, revision)
            if object_id in stored.project.objects:
                wanted = edit.give_content(stored.project, then)
            else:
                last = history.object_revisions(connection, project_id, object_id)[0]
                below = history.deleted_with(connection, project_id, last.project_revision)
                siblings = stored.project.siblings(then.parent_id, then.kind)
                index = sum(stored.positions[item.id] < position for item in siblings)
                wanted = edit.restore_objects(stored.project, then, below, index)
            result, event = apply_project(connection, stored, wanted, "revert", author, comment)
        self._notify(event)
        return result.get(object_id)

    def revert_project(
        self, project_id: str, revision: int, author: str, *, comment: str = ""
    ) -> ProjectInfo:
        """Make a project what it was after a change, as a new change; deleted objects come back.

        Raises UnknownProjectError, UnknownRevisionError.
        """
        with self.engine.begin() as connection:
            info = read_info(connection, project_id, lock=True)
            stored = read_project(connection, info)
            wanted = history.project_at(connection, info, revision)
            _, event = apply_project(connection, stored, wanted, "revert", author, comment)
            info = read_info(connection, project_id)
        self._notify(event)
        return info

    def undo_change(self, project_id: str, revision: int, author: str) -> int:
        """Take back one change of a project, as a new change; answers the revision that makes.

        Raises UnknownProjectError, UnknownRevisionError, ChangedSinceError.
        """
        with self.engine.begin() as connection:
            info = read_info(connection, project_id, lock=True)
            number, event = undo_change(connection, info, revision, author)
        self._notify(event)
        return number

    def extra_files(self, project_id: str) -> dict[str, bytes]:
        """Files of the imported folder that are no objects. Raises UnknownProjectError."""
        with self._reading.begin() as connection:
            read_info(connection, project_id)
            return read_files(connection, project_id)

"""What becomes of an imported object whose name exists: decisions applied, contents joined."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from pydantic import ValidationError

from tappet.project.data import Data
from tappet.project.errors import InvalidDataError, ProjectError
from tappet.project.exchange.drafts import Draft
from tappet.project.exchange.existing import (
    ComparedText,
    Comparison,
    Decision,
    Decisions,
    Existing,
    ExistingAct,
    Histories,
)
from tappet.project.exchange.growing_tree import GrowingTree
from tappet.project.exchange.three_way import JoinedData, is_line_text, join_data, nearest
from tappet.project.kind_registry import kinds
from tappet.project.model import ProjectObject
from tappet.project.naming import name_key
from tappet.project.objects import describe, valid_data


class ConflictError(ProjectError):
    """Both sides have changed the same in different ways."""

    code = "import_conflict"


@dataclass(frozen=True, slots=True)
class Given:
    """What an object of the project gets, and what the report says of it."""

    data: Data | Mapping[str, Any]
    text: str = ""


@dataclass(slots=True)
class Decided:
    """The decisions of a user, and what the project knows of the past of its objects."""

    decisions: Decisions = field(default_factory=Decisions)
    histories: Histories = field(default_factory=dict)
    """The states of objects, newest first."""
    missing: set[str] = field(default_factory=set)
    """Objects whose history would have told the common ancestor."""
    compare: str = ""
    """Key of a draft that shall be compared."""

    def decision(self, draft: Draft, there: ProjectObject | None, given: ExistingAct | None) -> Decision:
        """What to do with a draft; `given` is what was decided for what it is in."""
        decision = self.decisions.objects.get(draft.key) or Decision(act=given or self.decisions.all)
        if there is None or there.kind == draft.kind or decision.act in ("rename", "skip"):
            return decision
        return Decision(act="rename")

    def content(self, draft: Draft, there: ProjectObject, decision: Decision) -> Given:
        """What the object that is there gets. Raises ConflictError, InvalidDataError."""
        if decision.act == "overwrite":
            return Given(draft.data, "has the content of the file now")
        joined, ancestor = self._joined(draft, there)
        open_conflicts = {name: at for name, at in joined.conflicts.items() if name not in decision.texts}
        if open_conflicts:
            raise ConflictError(
                f"the project and the file differ in {_named(open_conflicts)}, so it stays as it is; "
                "compare both, or overwrite, rename or skip it"
            )
        unknown = decision.texts.keys() - there.data.model_dump().keys()
        if unknown:
            raise InvalidDataError(f"'{there.name}' has no text '{min(unknown)}'")
        known = (
            "has the changes of both since their common version"
            if ancestor
            else "has what either of both has"
        )
        said = "as the user has joined it" if decision.texts else known
        return Given(joined.data | decision.texts, said)

    def compare_texts(self, draft: Draft, there: ProjectObject) -> Comparison:
        """Both versions of an object, to be looked at."""
        joined, ancestor = self._joined(draft, there)
        ours, theirs = there.data.model_dump(mode="json"), _plain(draft)
        texts = [
            ComparedText(
                field=name,
                ours=ours[name],
                theirs=str(theirs.get(name, "")),
                merged=joined.data[name],
                conflicts=joined.conflicts.get(name, ()),
            )
            for name in ours
            if isinstance(ours[name], str) and is_line_text(name, ours, theirs)
        ]
        rest = tuple(name for name in joined.conflicts if name not in {text.field for text in texts})
        return Comparison(ancestor=ancestor, texts=tuple(texts), fields=rest)

    def _joined(self, draft: Draft, there: ProjectObject) -> tuple[JoinedData, bool]:
        """The data of both joined, and whether their common ancestor is known."""
        base = None
        theirs = _plain(draft)
        if draft.id == there.id:  # both were the same object once
            self.missing |= {there.id} - self.histories.keys()
            base = nearest(self.histories.get(there.id, ()), theirs)
        return join_data(base, there.data.model_dump(mode="json"), theirs), base is not None


def compared(draft: Draft, there: ProjectObject, tree: GrowingTree, proposal: str) -> Existing:
    """What the preview shows of an object whose name exists."""
    acts: tuple[ExistingAct, ...] = ("overwrite", "rename", "merge", "skip")
    known = kinds().get(draft.kind)
    if there.kind != draft.kind:
        acts = ("rename", "skip")
    elif known is not None and known.naming.style == "fixed":
        acts = ("overwrite", "merge", "skip")
    return Existing(
        object_id=there.id,
        path=tree.before.path_of(there.id),
        acts=acts,
        same=_is_same(draft, there, tree),
        proposal=proposal,
    )


def _is_same(draft: Draft, there: ProjectObject, tree: GrowingTree) -> bool:
    if draft.kind != there.kind or _plain(draft) != tree.before.get(there.id).data.model_dump(mode="json"):
        return False
    members = {name_key(child.name): child for child in tree.before.children(there.id)}
    children = {name_key(child.name): child for child in draft.children}
    return members.keys() == children.keys() and all(
        _is_same(child, members[key], tree) for key, child in children.items()
    )


def _plain(draft: Draft) -> dict[str, Any]:
    """The data of a draft with every field. Raises InvalidDataError."""
    try:
        return valid_data(draft.kind, draft.data).model_dump(mode="json")
    except ValidationError as error:
        raise InvalidDataError(f"{draft.kind} '{draft.name}': {describe(error)}") from error


def _named(conflicts: Mapping[str, tuple[int, ...]]) -> str:
    """`declaration (2 places), priority`."""
    parts = []
    for name, lines in conflicts.items():
        count = f" ({len(lines)} {'place' if len(lines) == 1 else 'places'})" if lines else ""
        parts.append(f"{name}{count}")
    return ", ".join(parts)

"""PLCopen XML: the project structure, CODESYS's tree of folders and object ids, applied to drafts."""

from __future__ import annotations

from collections.abc import Iterable

from tappet.project.exchange.drafts import Draft, hex_id, is_implied
from tappet.project.exchange.xml_tree import Element
from tappet.project.kind_registry import kinds
from tappet.project.model import DEVICE


def arrange(
    structure: Element | None,
    pool: Draft,
    devices: list[Draft],
    generic: list[Draft],
    by_id: dict[str, Draft],
) -> None:
    """Put drafts into the folders and the order of the structure; what it does not name stays where it is."""
    root = Draft("root", "", children=devices)
    tree = _Tree(pool, root, by_id)
    for draft in generic:
        tree.parents[draft] = pool
        pool.children.append(draft)
    for top in (pool, root):
        tree.enter(top)
    if structure is not None:
        tree.visit(structure)
    devices[:] = root.children
    _drop_implied([pool, root])


class _Tree:
    def __init__(self, pool: Draft, root: Draft, by_id: dict[str, Draft]) -> None:
        self.pool = pool
        self.root = root
        self.by_id = by_id
        self.parents: dict[Draft, Draft] = {}
        self._placed: set[Draft] = set()

    def enter(self, top: Draft) -> None:
        waiting = [top]
        while waiting:
            item = waiting.pop()
            for child in item.children:
                self.parents[child] = item
            waiting += item.children

    def visit(self, structure: Element) -> None:
        """Walk the structure; each entry: a node, the draft it is below, the folders between."""
        waiting: list[tuple[Element, Draft | None, tuple[Element, ...], bool]] = [
            (structure, None, (), False)
        ]
        while waiting:
            node, owner, folders, inside = waiting.pop()
            if node.tag == "Folder":
                folders = (*folders, node)
                if owner is not None or not inside:
                    self._folder(owner or self.pool, folders)
            elif node.tag == "Object":
                found = self.by_id.get(hex_id(node.get("ObjectId")) or "")
                if found is not None and found not in self._placed:
                    self._move(found, owner, folders)
                    owner, folders, inside = found, (), True
                else:
                    owner, folders, inside = None, (), True
            waiting.extend((child, owner, folders, inside) for child in reversed(list(node)))

    def _folder(self, place: Draft, folders: Iterable[Element]) -> Draft:
        for node in folders:
            known = len(place.children)
            made = place.folder(node.get("Name"))
            if len(place.children) > known:
                made.id = hex_id(node.get("ObjectId"))
                self.parents[made] = place
            place = made
        return place

    def _move(self, draft: Draft, owner: Draft | None, folders: tuple[Element, ...]) -> None:
        self._placed.add(draft)
        now = self.parents[draft]
        target = owner
        if target is None:
            target = self.root if draft.kind == DEVICE else now
        elif not _may_be_below(draft, target) or self._is_below(target, draft):
            target, folders = now, ()
        now.children = [child for child in now.children if child is not draft]
        place = self._folder(target, folders)
        place.children.append(draft)
        self.parents[draft] = place

    def _is_below(self, item: Draft | None, top: Draft) -> bool:
        while item is not None:
            if item is top:
                return True
            item = self.parents.get(item)
        return False


def _may_be_below(draft: Draft, owner: Draft) -> bool:
    known = kinds().get(draft.kind)
    return known is None or owner.kind not in kinds() or owner.kind in known.placement.parents


def _drop_implied(tops: list[Draft]) -> None:
    """Remove what was made to hold children and holds none, because the file has the real one."""
    waiting = list(tops)
    while waiting:
        item = waiting.pop()
        implied = {child.kind for child in item.children if is_implied(child.kind)}
        for kind in implied:
            same = [child for child in item.children if child.kind == kind]
            if len(same) > 1:
                empty = [
                    child for child in same if child.id is None and not child.children and not child.data
                ]
                item.children = [child for child in item.children if child not in empty]
        waiting += item.children

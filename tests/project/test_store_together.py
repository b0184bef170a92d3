"""Several objects stored as one change of the project: all of them, or none."""

from __future__ import annotations

import pytest
from tests.project.project_paths import APP
from tests.project.project_paths import stored_at as at
from tests.project.test_store import text

from tappet.project.errors import InvalidDataError, UnknownObjectError
from tappet.project.model import ProjectObject
from tappet.project.store import StaleRevision, Store
from tappet.project.store.records import ObjectContent


def test_several_objects_are_saved_as_one_change(store: Store, pid: str, prg: ProjectObject) -> None:
    app = at(store, pid, APP)
    gvl = store.add(pid, "ann", app.id, "gvl", "GVL")
    before = store.project(pid).revision
    contents = [
        ObjectContent(prg.id, prg.revision, text("PROGRAM PLC_PRG", "GVL.b := 1;")),
        ObjectContent(gvl.id, gvl.revision, {"declaration": "VAR_GLOBAL\n    b : INT;\nEND_VAR"}),
    ]
    saved = store.save_all(pid, contents, "ann", comment="a is b")
    assert [item.revision for item in saved] == [prg.revision + 1, gvl.revision + 1]
    assert [item.data for item in saved] == [store.get(pid, item.id).data for item in (prg, gvl)]
    (change, *_) = store.project_revisions(pid)
    assert (change.revision, change.comment, {name for _, name in change.objects}) == (
        before + 1,
        "a is b",
        {"PLC_PRG", "GVL"},
    )
    again = [ObjectContent(c.object_id, i.revision, c.data) for c, i in zip(contents, saved, strict=True)]
    assert store.save_all(pid, again, "ann") == saved
    assert store.project(pid).revision == before + 1


def test_of_several_objects_none_is_saved_when_one_is_stale(
    store: Store, pid: str, prg: ProjectObject
) -> None:
    gvl = store.add(pid, "ann", at(store, pid, APP).id, "gvl", "GVL")
    mine = [ObjectContent(prg.id, prg.revision, text("PROGRAM PLC_PRG", "mine;"))]
    store.save(pid, gvl.id, gvl.revision, {"declaration": "VAR_GLOBAL (* bob *) END_VAR"}, "bob")
    before = store.project(pid).revision
    with pytest.raises(StaleRevision, match="'GVL' was changed by bob") as caught:
        store.save_all(pid, [*mine, ObjectContent(gvl.id, gvl.revision, {"declaration": "x"})], "ann")
    assert caught.value.object_id == gvl.id
    store.delete(pid, "bob", gvl.id)
    with pytest.raises(StaleRevision, match="deleted by bob"):
        store.save_all(pid, [*mine, ObjectContent(gvl.id, gvl.revision, {"declaration": "x"})], "ann")
    with pytest.raises(UnknownObjectError):
        store.save_all(pid, [*mine, ObjectContent("nobody", 1, {})], "ann")
    with pytest.raises(InvalidDataError, match="twice"):
        store.save_all(pid, [*mine, *mine], "ann")
    assert store.get(pid, prg.id).data == prg.data
    assert store.project(pid).revision == before + 1

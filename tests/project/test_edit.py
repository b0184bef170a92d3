"""Adding, renaming, moving, copying and deleting objects, and the placement rules."""

from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.project.project_paths import APP, at

from tappet.project import edit
from tappet.project.errors import (
    InvalidDataError,
    InvalidNameError,
    NameTakenError,
    NotPlaceableError,
    ProjectError,
    UnknownObjectError,
)
from tappet.project.kind_registry import kinds
from tappet.project.kinds.task import TaskData
from tappet.project.model import Project, ProjectObject, new_id
from tappet.project.new_project import new_project
from tappet.project.object_kind import ObjectKind
from tappet.project.objects import make_object
from tappet.project.placement import Site, check_project, check_spelling, proposed_name


def names(project: Project, parent: ProjectObject | None) -> list[str]:
    children = project.children(parent.id if parent else None)
    for kind in {child.kind for child in children}:
        siblings = project.siblings(parent.id if parent else None, kind)
        assert [child.index for child in siblings] == list(range(len(siblings)))
    return [child.name for child in children]


def test_adding_fills_in_the_template() -> None:
    project = new_project("x")
    app = at(project, APP)
    project, block = edit.add_object(project, app.id, "pou", "FB_Motor", subkind="function_block")
    assert block.subkind == "function_block"
    assert block.data.model_dump()["declaration"].startswith("FUNCTION_BLOCK FB_Motor\n")
    project, dut = edit.add_object(project, app.id, "dut", "E_Mode", subkind="enum", index=0)
    assert dut.subkind == "enum"
    assert names(project, app) == ["E_Mode", "Library Manager", "PLC_PRG", "Task Configuration", "FB_Motor"]
    project, prop = edit.add_object(project, block.id, "property", "Speed")
    assert names(project, prop) == ["Get", "Set"]
    check_project(project)


@pytest.mark.parametrize("kind", kinds().values(), ids=kinds().keys())
def test_every_template_says_what_it_is(kind: ObjectKind[Any]) -> None:
    project = new_project("x")
    app = at(project, APP)
    parent = app.id
    if kind.placement.parents[0] == "axis_pool":
        project, pool = edit.add_object(project, app.id, "axis_pool")
        parent = pool.id
    for subkind in kind.templates:
        project, item = edit.add_object(project, parent, kind.name, subkind=subkind)
        plain = subkind == "variable_list"  # its kind alone determines a list without parameters
        assert item.subkind == (None if plain else subkind)
    with pytest.raises(InvalidDataError):
        edit.add_object(Project("x"), None, "pou", "P", subkind="struct")


def test_a_new_device_comes_with_an_application() -> None:
    project, device = edit.add_object(new_project("x"), None, "device", "Second")
    assert at(project, "Second/PLC Logic/Application/Task Configuration").kind == "task_configuration"
    assert at(project, "Second/PLC Logic/Application/Library Manager").data.model_dump() == {
        "references": ({"name": "Standard", "version": "*", "namespace": ""},)
    }
    assert device.index == 1


def test_names_proposed_by_the_dialog() -> None:
    project = new_project("x")
    app = at(project, APP)
    assert proposed_name(Site.of(project, app.id), "pou") == "POU"
    project = edit.delete_object(project, at(project, f"{APP}/PLC_PRG").id)
    assert proposed_name(Site.of(project, app.id), "pou") == "PLC_PRG"
    project, _ = edit.add_object(project, app.id, "gvl")
    assert proposed_name(Site.of(project, app.id), "gvl") == "GVL_1"
    assert proposed_name(Site.of(project, None), "library_manager") == "Library Manager"


@pytest.mark.parametrize(
    ("kind", "place", "message"),
    [
        ("task_configuration", None, "cannot be below the POUs view"),  # CON-08
        ("device", APP, "cannot be below the application 'Application'"),
        ("task", APP, "belongs below task configuration"),
        ("task_configuration", APP, "only one is possible"),  # TASK-02
        ("library_manager", APP, "only one is possible"),  # LIB-01
        ("method", APP, "cannot be below"),
        ("action", f"{APP}/F", "A function such as 'F' has no action"),
        ("persistent", f"{APP}/Folder", "has a persistent already"),  # PERS-02
        ("library_manager", f"{APP}/Folder", "cannot be in a folder"),
        ("oscillogram", APP, "plug-in that is not installed"),
    ],
)
def test_places_that_are_refused(kind: str, place: str | None, message: str) -> None:
    project = new_project("x")
    app = at(project, APP)
    project, _ = edit.add_object(project, app.id, "folder", "Folder")
    project, _ = edit.add_object(project, app.id, "pou", "F", subkind="function")
    project, _ = edit.add_object(project, app.id, "persistent")
    with pytest.raises(NotPlaceableError, match=message):
        edit.add_object(project, at(project, place).id if place else None, kind)


def test_names_are_unique_in_an_application_across_folders() -> None:
    project = new_project("x")
    app = at(project, APP)
    project, folder = edit.add_object(project, app.id, "folder", "Motors")
    project, _ = edit.add_object(project, folder.id, "pou", "FB_Motor")
    with pytest.raises(NameTakenError, match="Application/Motors/FB_Motor"):
        edit.add_object(project, app.id, "gvl", "fb_motor")
    with pytest.raises(NameTakenError):
        edit.add_object(project, app.id, "folder", "MOTORS")
    with pytest.raises(NameTakenError):
        edit.add_object(project, app.id, "pou", "Motors")
    project, _ = edit.add_object(project, None, "pou", "FB_Motor")  # CON-09: the application hides it
    project, _ = edit.add_object(project, None, "device", "FB_Motor")
    with pytest.raises(NameTakenError):
        edit.add_object(project, None, "device", "fb_motor")
    check_project(project)


def test_renaming_follows_into_header_and_tasks() -> None:
    project = new_project("x")
    main = at(project, f"{APP}/PLC_PRG")
    project = edit.rename_object(project, main.id, "Main")
    assert project.get(main.id).data.model_dump()["declaration"].startswith("PROGRAM Main\n")
    task = at(project, f"{APP}/Task Configuration/MainTask").data
    assert isinstance(task, TaskData)
    assert [call.name for call in task.pous] == ["Main"]
    assert edit.rename_object(project, main.id, "Main") is project
    project = edit.rename_object(project, main.id, "MAIN")
    assert project.get(main.id).name == "MAIN"


def test_fixed_names_stay() -> None:
    project = new_project("x")
    for name in ("Library Manager", "Task Configuration"):
        with pytest.raises(InvalidNameError, match="is named"):
            edit.rename_object(project, at(project, f"{APP}/{name}").id, "Other")


def test_a_variable_list_keeps_its_text_when_renamed() -> None:
    project, gvl = edit.add_object(
        new_project("x"), None, "gvl", "A", data={"declaration": "TYPE A : INT; END_TYPE"}
    )
    project = edit.rename_object(project, gvl.id, "B")
    assert project.get(gvl.id).data == gvl.data


def test_moving_among_siblings_and_parents() -> None:
    project = Project("x")
    ids = {}
    for name in "ABC":
        project, item = edit.add_object(project, None, "pou", name)
        ids[name] = item.id
    project, folder = edit.add_object(project, None, "folder", "F")
    project = edit.move_object(project, ids["C"], None, 0)
    assert names(project, None) == ["C", "A", "B", "F"]
    project = edit.move_object(project, ids["C"], None)
    assert names(project, None) == ["A", "B", "F", "C"]
    project = edit.move_object(project, ids["A"], folder.id)
    project = edit.move_object(project, ids["B"], folder.id, 0)
    assert names(project, None) == ["F", "C"]
    assert names(project, folder) == ["B", "A"]
    with pytest.raises(NotPlaceableError, match="into itself"):
        edit.move_object(project, folder.id, folder.id)
    with pytest.raises(UnknownObjectError):
        edit.move_object(project, folder.id, new_id())


def test_moving_into_another_application_needs_a_free_name() -> None:
    project, _ = edit.add_object(new_project("x"), None, "device", "Second")
    other = at(project, "Second/PLC Logic/Application")
    project, pou = edit.add_object(
        project, other.id, "pou", "PLC_PRG"
    )  # CON-07: the same name twice is legal
    with pytest.raises(NameTakenError):
        edit.move_object(project, pou.id, at(project, APP).id)


def test_copying_an_application_to_another_device() -> None:
    """CON-02: names inside stay, the pasted application gets a free name."""
    project, _ = edit.add_object(new_project("x"), None, "device", "Second")
    logic = at(project, "Second/PLC Logic")
    project, copied = edit.copy_object(project, at(project, APP).id, logic.id)
    assert copied.name == "Application_1"
    assert names(project, copied) == ["Library Manager", "PLC_PRG", "Task Configuration"]
    ids = [item.id for item in project.walk()]
    assert len(ids) == len(set(ids)) == len(project.objects)
    check_project(project)


def test_a_copy_is_named_in_its_header() -> None:
    project = new_project("x")
    main = at(project, f"{APP}/PLC_PRG")
    project, copied = edit.copy_object(project, main.id, main.parent_id, index=0)
    assert copied.name == "PLC_PRG_1"
    assert copied.data.model_dump()["declaration"].startswith("PROGRAM PLC_PRG_1\n")
    assert copied.index == 0


def test_copying_from_another_project() -> None:
    source = new_project("a")
    target, copied = edit.copy_object(Project("b"), at(source, f"{APP}/PLC_PRG").id, None, source=source)
    assert [item.name for item in target.walk()] == ["PLC_PRG"]
    assert copied.parent_id is None


def test_a_second_library_manager_is_not_pasted() -> None:
    project = new_project("x")
    manager = at(project, f"{APP}/Library Manager")
    with pytest.raises(NotPlaceableError, match="only one"):
        edit.copy_object(project, manager.id, manager.parent_id)


def test_deleting_takes_what_is_below() -> None:
    project = new_project("x")
    project, pou = edit.add_object(
        project, at(project, APP).id, "pou", "FB", subkind="function_block", index=0
    )
    project, _ = edit.add_object(project, pou.id, "property", "Speed")
    project = edit.delete_object(project, pou.id)
    assert project.objects == {key: project.objects[key] for key in new_ids(project)}
    assert names(project, at(project, APP)) == ["Library Manager", "PLC_PRG", "Task Configuration"]
    assert not project.find_kind("accessor")


def new_ids(project: Project) -> list[str]:
    return [item.id for item in project.walk()]


def unknown(parent: ProjectObject) -> ProjectObject:
    return make_object(
        id=new_id(), parent_id=parent.id, kind="oscillogram", name="Curve", index=9, data={"a": 1}
    )


def test_objects_of_missing_plug_ins_can_be_moved_and_copied_where_they_were() -> None:
    project, _ = edit.add_object(new_project("x"), None, "device", "Second")
    item = unknown(at(project, APP))
    project = Project("x", objects={**project.objects, item.id: item})
    other = at(project, "Second/PLC Logic/Application")
    project, copied = edit.copy_object(project, item.id, other.id)
    assert copied.data == item.data
    project = edit.move_object(project, item.id, at(project, APP).id, 0)
    assert names(project, at(project, APP))[0] == "Curve"
    with pytest.raises(NotPlaceableError, match="not installed"):
        edit.move_object(project, item.id, None)
    check_project(project)


def test_broken_trees_are_found() -> None:
    project = new_project("x")
    app = at(project, APP)
    lost = make_object(id=new_id(), parent_id=new_id(), kind="gvl", name="G", data={})
    with pytest.raises(ProjectError, match="parent of 'G' is missing"):
        check_project(Project("x", objects={**project.objects, lost.id: lost}))
    one, two = new_id(), new_id()
    loop = [
        make_object(id=one, parent_id=two, kind="folder", name="A", data={}),
        make_object(id=two, parent_id=one, kind="folder", name="B", data={}),
    ]
    with pytest.raises(ProjectError, match="their own ancestors"):
        check_project(Project("x", objects={item.id: item for item in loop}))
    double = make_object(id=new_id(), parent_id=app.id, kind="gvl", name="plc_prg", data={})
    with pytest.raises(NameTakenError):
        check_project(Project("x", objects={**project.objects, double.id: double}))


KINDS = st.sampled_from(
    ["folder", "pou", "dut", "gvl", "interface", "method", "property", "action", "device", "task"]
)


@given(st.data())
def test_any_sequence_of_edits_keeps_the_tree_sound(data: st.DataObject) -> None:
    project = new_project("x")
    for _ in range(data.draw(st.integers(1, 8))):
        ids = st.sampled_from([item.id for item in project.walk()])
        try:
            match data.draw(st.sampled_from(["add", "move", "copy", "delete", "rename"])):
                case "add":
                    project, _ = edit.add_object(
                        project,
                        data.draw(ids | st.none()),
                        data.draw(KINDS),
                        index=data.draw(st.integers(0, 3)),
                    )
                case "move":
                    project = edit.move_object(
                        project, data.draw(ids), data.draw(ids | st.none()), data.draw(st.integers(0, 3))
                    )
                case "copy":
                    project, _ = edit.copy_object(project, data.draw(ids), data.draw(ids | st.none()))
                case "rename":
                    project = edit.rename_object(
                        project, data.draw(ids), data.draw(st.sampled_from(["A", "b", "IF"]))
                    )
                case _ if len(project.objects) > 3:
                    project = edit.delete_object(project, data.draw(ids))
        except ProjectError:
            continue
        if not project.objects:
            return
        check_project(project)
        for parent in (None, *project.walk()):
            names(project, parent)


@pytest.mark.parametrize("kind", kinds().values(), ids=kinds().keys())
def test_every_proposed_name_is_possible(kind: ObjectKind[Any]) -> None:
    for name in kind.naming.names or (kind.naming.proposal, kind.naming.first or kind.naming.proposal):
        check_spelling(kind.name, name)

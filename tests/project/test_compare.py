"""Comparing projects and taking differences over."""

from __future__ import annotations

from dataclasses import replace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from project_strategies import projects

from tappet.project import edit
from tappet.project.compare.differences import Comparison
from tappet.project.compare.ignoring import Ignoring
from tappet.project.compare.taking import Take, UnknownDifferenceError, take, take_all
from tappet.project.errors import NameTakenError, ProjectError
from tappet.project.model import Project, ProjectObject, is_pous_root, new_id
from tappet.project.new_project import new_project


def outline(project: Project, parent_id: str | None = None) -> list[object]:
    """All that a project holds, in its order, without ids."""
    return [
        (
            is_pous_root(item.parent_id, item.kind),
            item.kind,
            item.name,
            item.index,
            item.data.model_dump(mode="json"),
            outline(project, item.id),
        )
        for item in project.children(parent_id)
    ]


def with_fresh_ids(project: Project) -> Project:
    """The same project as another system would give it: no id is known."""
    ids = {old: new_id() for old in project.objects}
    objects = {
        ids[item.id]: item.model_copy(
            update={"id": ids[item.id], "parent_id": ids[item.parent_id] if item.parent_id else None}
        )
        for item in project.objects.values()
    }
    return replace(project, objects=objects)


@st.composite
def edited(draw: st.DrawFn, project: Project) -> Project:
    """A project after some edits of all sorts."""
    for _ in range(draw(st.integers(0, 6))):
        if not project.objects:
            break
        item = draw(st.sampled_from(list(project.walk())))
        other = draw(st.sampled_from(list(project.walk())))
        act = draw(st.sampled_from(["delete", "rename", "move", "copy", "order", "text"]))
        try:
            if act == "delete":
                project = edit.delete_object(project, item.id)
            elif act == "rename":
                project = edit.rename_object(
                    project, item.id, draw(st.sampled_from(["Bb", "PLC_PRG", "Cc_1"]))
                )
            elif act == "move":
                project = edit.move_object(project, item.id, other.id, draw(st.integers(0, 3)))
            elif act == "order":
                project = edit.move_object(project, item.id, item.parent_id, draw(st.integers(0, 3)))
            elif act == "copy":
                project, _ = edit.copy_object(project, item.id, other.id)
            elif "declaration" in type(item.data).model_fields:
                data = item.data.model_dump() | {
                    "declaration": draw(st.sampled_from(["", "VAR\nEND_VAR", "x"]))
                }
                project = edit.change_data(project, item.id, data)
        except ProjectError:
            continue
    return project


@settings(max_examples=60, deadline=None)
@given(st.data())
def test_taking_all_differences_gives_the_other_project(data: st.DataObject) -> None:
    old = data.draw(projects())
    new = data.draw(st.one_of(edited(old), edited(with_fresh_ids(old)), projects()))
    comparison = Comparison(old, new)
    taken = take_all(comparison)
    assert outline(taken) == outline(old)
    assert not Comparison(old, taken).differences
    assert not Comparison(new, new).differences
    assert bool(comparison.differences) == (outline(old) != outline(new))


@settings(max_examples=60, deadline=None)
@given(st.data())
def test_differences_that_are_not_taken_stay(data: st.DataObject) -> None:
    old = data.draw(projects())
    new = data.draw(edited(old))
    comparison = Comparison(old, new)
    keys = data.draw(st.lists(st.sampled_from([*comparison.differences, ""]), unique=True, max_size=3))
    try:
        taken = take(comparison, [Take(key) for key in keys if key])
    except ProjectError:  # not every choice is a sound project
        return
    left = Comparison(old, taken).differences
    assert not set(left).intersection(keys), "what is taken differs no more"
    untouched = [
        one for one in comparison.differences.values() if one.state == "changed" and one.key not in keys
    ]
    for one in untouched:
        assert one.new is not None
        assert taken.get(one.key).data == one.new.data, "what is not taken is as it was"


@pytest.fixture
def press() -> Project:
    """A project with a function block of some lines and a folder."""
    project = new_project("Press")
    application = project.applications()[0].id
    project, _ = edit.add_object(project, application, "folder", "Drives")
    project, block = edit.add_object(project, application, "pou", "FB_Motor", subkind="function_block")
    lines = "\n".join(f"    nValue{i} : INT; // value {i}" for i in range(8))
    return edit.change_data(
        project,
        block.id,
        {
            "declaration": f"FUNCTION_BLOCK FB_Motor\nVAR\n{lines}\nEND_VAR",
            "implementation": "nValue0 := 1;\n{attribute 'x'}\nnValue1 := 2;",
        },
    )


def found(project: Project, name: str) -> ProjectObject:
    return next(item for item in project.walk() if item.name == name)


def with_text(project: Project, name: str, field: str, old: str, new: str) -> Project:
    item = found(project, name)
    data = item.data.model_dump()
    assert old in data[field]
    return edit.change_data(project, item.id, data | {field: data[field].replace(old, new)})


def test_a_renamed_object_of_a_stranger_is_recognised(press: Project) -> None:
    other = with_fresh_ids(edit.rename_object(press, found(press, "FB_Motor").id, "FB_Drive"))
    other = with_text(other, "FB_Drive", "implementation", "nValue0 := 1", "nValue0 := 3")
    (one,) = Comparison(press, other).differences.values()
    assert (one.state, one.renamed, one.fields) == ("changed", True, ("declaration", "implementation"))


def test_a_moved_object_of_a_stranger_is_recognised(press: Project) -> None:
    other = with_fresh_ids(edit.move_object(press, found(press, "FB_Motor").id, found(press, "Drives").id))
    (one,) = Comparison(press, other).differences.values()
    assert (one.state, one.moved, one.fields, one.item.name) == ("changed", True, (), "FB_Motor")


def test_what_moved_among_its_siblings_is_as_little_as_possible(press: Project) -> None:
    application = press.applications()[0]
    first = press.children(application.id)[0]
    other = edit.move_object(press, first.id, application.id)
    assert [one.item.name for one in Comparison(press, other).differences.values()] == [first.name]


@pytest.mark.parametrize(
    ("old", "new", "ignoring", "same"),
    [
        ("nValue0 := 1;", "nValue0:=1;", Ignoring(white_space=True), True),
        ("nValue0 := 1;", "\n\nnValue0 :=\n  1;", Ignoring(white_space=True), True),
        ("nValue0 := 1;", "n Value0 := 1;", Ignoring(white_space=True), False),
        ("nValue0 := 1;", "nValue0 := 1; // note", Ignoring(comments=True), True),
        ("nValue0 := 1;", "(* several\n lines *)\nnValue0 := 1;", Ignoring(comments=True), True),
        ("nValue0 := 1;", "nValue0 := 1;// note", Ignoring(white_space=True), False),
        ("nValue0 := 1;", "nValue0 := 1; // note", Ignoring(pragmas=True), False),
        ("{attribute 'x'}\n", "", Ignoring(pragmas=True), True),
        ("{attribute 'x'}", "{attribute 'y'}", Ignoring(comments=True, white_space=True), False),
        ("{attribute 'x'}", "(* {attribute 'x'} *)", Ignoring(True, True, True), True),
    ],
)
def test_what_does_not_count(press: Project, old: str, new: str, ignoring: Ignoring, same: bool) -> None:
    other = with_text(press, "FB_Motor", "implementation", old, new)
    assert bool(Comparison(press, other, ignoring).differences) != same
    assert Comparison(press, other).differences


def test_white_space_in_strings_counts(press: Project) -> None:
    one = with_text(press, "FB_Motor", "implementation", "nValue0 := 1;", "s := 'a b';")
    other = with_text(press, "FB_Motor", "implementation", "nValue0 := 1;", "s := 'a  b';")
    assert Comparison(one, other, Ignoring(white_space=True)).differences


def test_a_part_of_an_object_is_taken(press: Project) -> None:
    other = with_text(press, "FB_Motor", "implementation", "nValue0 := 1", "nValue0 := 5")
    other = with_text(other, "FB_Motor", "declaration", "nValue7 : INT", "nValue7 : DINT")
    other = edit.rename_object(other, found(other, "FB_Motor").id, "FB_Drive")
    key = found(other, "FB_Drive").id
    comparison = Comparison(press, other)
    taken = found(take(comparison, [Take(key, False, fields=("implementation",))]), "FB_Drive")
    before, after = taken.data.model_dump(), found(other, "FB_Drive").data.model_dump()
    assert before["implementation"] == found(press, "FB_Motor").data.model_dump()["implementation"]
    assert before["declaration"] == after["declaration"]
    renamed = found(take(comparison, [Take(key, False, name=True)]), "FB_Motor")
    assert renamed.data.model_dump()["declaration"].startswith("FUNCTION_BLOCK FB_Motor\n")
    assert "nValue7 : DINT" in renamed.data.model_dump()["declaration"]
    merged = Take(key, False, texts={"implementation": "nValue0 := 7;"})
    assert (
        found(take(comparison, [merged]), "FB_Drive").data.model_dump()["implementation"] == "nValue0 := 7;"
    )


def test_a_removed_object_comes_with_what_it_was_in_and_with_what_was_below(press: Project) -> None:
    press = edit.move_object(press, found(press, "FB_Motor").id, found(press, "Drives").id)
    press, _ = edit.add_object(press, found(press, "FB_Motor").id, "method", "Start")
    other = edit.delete_object(press, found(press, "Drives").id)
    comparison = Comparison(press, other)
    assert {one.state for one in comparison.differences.values()} == {"removed"}
    taken = take(comparison, [Take(f"-{found(press, 'FB_Motor').id}")])
    assert outline(taken) == outline(press)
    assert taken.objects.keys() == press.objects.keys(), "under the ids that they had"


def test_choices_that_do_not_go_together_are_refused(press: Project) -> None:
    motor = found(press, "FB_Motor").id
    other = edit.rename_object(press, motor, "FB_Drive")
    other, added = edit.add_object(other, press.applications()[0].id, "pou", "FB_Motor")
    comparison = Comparison(press, other)
    with pytest.raises(NameTakenError, match="FB_Motor"):
        take(comparison, [Take(motor)])
    assert outline(take(comparison, [Take(motor), Take(added.id)])) == outline(press)
    with pytest.raises(UnknownDifferenceError, match="compare again"):
        take(comparison, [Take("0" * 32)])
    with pytest.raises(UnknownDifferenceError, match="one side only"):
        take(comparison, [Take(added.id, False, name=True)])
    with pytest.raises(UnknownDifferenceError, match="no field 'speed'"):
        take(comparison, [Take(motor, False, fields=("speed",))])

"""CNC programs and their settings in the tree and in folders (cnc.md CNC-01 to CNC-17, views_watch.md
CNCS-01, CNCS-11)."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st
from pydantic import ValidationError

from tappet.project import edit, folder
from tappet.project.cnc.program import CncProgramData
from tappet.project.cnc.settings import COLUMN_NAMES, CncSettingsData
from tappet.project.errors import (
    InvalidDataError,
    InvalidNameError,
    NameTakenError,
    NeededObjectError,
    NotPlaceableError,
)
from tappet.project.model import Project, ProjectObject
from tappet.project.new_project import new_project


def with_program(name: str | None = None, **data: Any) -> tuple[Project, ProjectObject, str]:
    """A project with a CNC program, the program, and the id of the application."""
    project = new_project("Machine")
    (application,) = project.applications()
    project, item = edit.add_object(project, application.id, "cnc", name)
    if data:
        project = edit.change_data(project, item.id, data)
    return project, project.get(item.id), application.id


def of_kind(project: Project, kind: str) -> list[ProjectObject]:
    return [item for item in project.walk() if item.kind == kind]


def test_a_program_stands_below_an_application_and_nowhere_else() -> None:
    """CNC-01, CNC-02: below an application, also in a folder of it; the name is an identifier, once."""
    project, item, application = with_program()
    assert item.name == "CNC"
    project, inside = edit.add_object(project, application, "folder", "Paths")
    project, second = edit.add_object(project, inside.id, "cnc")
    assert second.name == "CNC_1"
    (pou, *_) = of_kind(project, "pou")
    for parent in (None, pou.id, item.id):
        with pytest.raises(NotPlaceableError):
            edit.add_object(project, parent, "cnc")
    with pytest.raises(NameTakenError):
        edit.add_object(project, application, "cnc", "cnc")
    with pytest.raises(InvalidNameError):
        edit.add_object(project, application, "cnc", "2nd path")


def test_the_properties_begin_as_the_specification_says() -> None:
    """CNC-10 to CNC-16: text, SMC_CNC_REF, 100 elements, velocity 0, accelerations 100, start 0."""
    data = with_program()[1].data_as(CncProgramData)
    assert (data.view, data.compile_mode, data.queue_size) == ("text", "cnc_ref", 100)
    assert (data.velocity, data.acceleration, data.deceleration) == (0.0, 100.0, 100.0)
    assert set(data.start.model_dump().values()) == {0.0}
    assert not data.exclude_from_build, "CNC-09"
    assert data.implementation.startswith("N0 G0 X0 Y0 F100\n")


@pytest.mark.parametrize(
    "wrong",
    [
        {"queue_size": 4},
        {"queue_size": 100.5},
        {"velocity": -1.0},
        {"acceleration": 1.1e9},
        {"deceleration": float("nan")},
        {"start": {"x": float("inf")}},
        {"start": {"d": 1.0}},
        {"compile_mode": "SMC_CNC_REF"},
        {"offline_values": [{"name": "a b", "value": 1.0}]},
        {"offline_values": [{"name": "GVL.x", "value": 1.0}, {"name": "gvl.X", "value": 2.0}]},
    ],
)
def test_properties_that_no_program_can_have_are_refused(wrong: dict[str, Any]) -> None:
    """CNC-12 to CNC-17: their ranges."""
    with pytest.raises(ValidationError):
        CncProgramData.model_validate(wrong)
    project, item, _ = with_program()
    with pytest.raises(InvalidDataError):
        edit.change_data(project, item.id, wrong)


def test_the_settings_come_with_the_first_program_and_go_after_the_last() -> None:
    """CNC-03, CNCS-01: exactly one, cannot be renamed, deleted only when there is no CNC program any more."""
    project, first, application = with_program()
    (settings,) = of_kind(project, "cnc_settings")
    assert settings.parent_id == application
    project, folder_ = edit.add_object(project, application, "folder", "Paths")
    project, second = edit.add_object(project, folder_.id, "cnc", "Second")
    assert of_kind(project, "cnc_settings") == [project.get(settings.id)]
    with pytest.raises(InvalidNameError):
        edit.rename_object(project, settings.id, "Mine")
    with pytest.raises(NotPlaceableError):
        edit.add_object(project, application, "cnc_settings")
    project = edit.delete_object(project, first.id)
    with pytest.raises(NeededObjectError, match="'CNC settings' is needed by 'Second'; delete that first"):
        edit.delete_object(project, settings.id)
    assert of_kind(edit.delete_objects(project, [settings.id, second.id]), "cnc_settings") == []
    project = edit.delete_object(project, second.id)
    project = edit.delete_object(project, settings.id)
    assert of_kind(project, "cnc_settings") == []


def test_programs_that_go_to_another_application_find_settings_there() -> None:
    """CNCS-01: one each application, however the first program gets there."""
    project, item, application = with_program()
    project, other = edit.add_object(project, application, "application", "Second")
    project, inside = edit.add_object(project, application, "folder", "Paths")
    project = edit.move_object(project, item.id, inside.id)
    copied, _ = edit.copy_object(project, inside.id, other.id)
    assert sorted(str(one.parent_id) for one in of_kind(copied, "cnc_settings")) == sorted(
        [application, other.id]
    )
    moved = edit.move_object(project, inside.id, other.id)
    assert other.id in {one.parent_id for one in of_kind(moved, "cnc_settings")}
    (settings,) = of_kind(project, "cnc_settings")
    taken = edit.move_object(project, settings.id, other.id)
    assert {one.parent_id for one in of_kind(taken, "cnc_settings")} == {application, other.id}


def test_a_program_that_is_brought_back_brings_its_settings() -> None:
    """CNCS-01 after both were deleted and the program is restored."""
    project, item, _ = with_program()
    (settings,) = of_kind(project, "cnc_settings")
    gone = edit.delete_objects(project, [item.id, settings.id])
    back = edit.restore_objects(gone, item, [], 0)
    assert len(of_kind(back, "cnc_settings")) == 1


def test_the_columns_of_tables_are_each_there_once() -> None:
    """CNCS-11: order and visibility; the type of an element is no column that could be hidden."""
    usual = CncSettingsData()
    assert [column.name for column in usual.columns] == list(COLUMN_NAMES)
    assert "type" not in COLUMN_NAMES
    with pytest.raises(ValidationError, match="the column x stands there twice"):
        CncSettingsData.model_validate({"columns": [{"name": "x"}, {"name": "x", "visible": False}]})


LINES = st.text(st.characters(codec="utf-8", exclude_characters="\r\x00\ufeff"), max_size=200)


@given(text=LINES, suppressed=st.booleans(), start=st.floats(-1e9, 1e9))
def test_the_text_is_a_file_of_its_own_that_comes_back_unchanged(
    tmp_path_factory: pytest.TempPathFactory, text: str, suppressed: bool, start: float
) -> None:
    """CNC-01: `NAME.cnc` beside the properties, byte by byte."""
    project, item, _ = with_program(
        implementation=text, step_suppression=suppressed, start={"x": start}, compile_mode="out_queue"
    )
    place = tmp_path_factory.mktemp("project")
    folder.save(project, place)
    (file,) = place.rglob("CNC.cnc")
    assert file.read_bytes() == text.encode()
    read = folder.load(place)
    (back,) = of_kind(read, "cnc")
    assert back.data == project.get(item.id).data


def test_a_program_of_default_properties_is_nothing_but_its_text(tmp_path: Path) -> None:
    """A diff of a folder reads as the program."""
    project, _, _ = with_program()
    folder.save(project, tmp_path)
    assert [file.name for file in tmp_path.rglob("CNC*.*")] == ["CNC.cnc"]

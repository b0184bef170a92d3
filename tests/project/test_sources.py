"""What the compiler gets of a project (seams 1 and 5; POU-07, CON-06..CON-09, TASK-12..TASK-20)."""

from dataclasses import asdict
from random import Random

import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.project.project_paths import APP, at

from tappet.iec.places import BodyText, Place, Span
from tappet.iec.source import Source
from tappet.iec.task import Watchdog
from tappet.project import edit
from tappet.project.data import CodeData
from tappet.project.errors import InvalidDataError, ProjectError, UnknownObjectError
from tappet.project.library_reference import LibraryReference, ParameterValue
from tappet.project.model import Project
from tappet.project.new_project import new_project
from tappet.project.sources import (
    WrittenSources,
    application_sources,
    libraries,
    objects_with_libraries,
    source_of,
    tasks,
)


def machine() -> Project:
    project = new_project("machine")
    app = at(project, APP)
    project, folder = edit.add_object(project, app.id, "folder", "Drives")
    declaration = "FUNCTION_BLOCK FB_Motor\nVAR\n    rSpeed : REAL;\nEND_VAR"
    body = {"declaration": declaration, "implementation": "rSpeed := 1.0;"}
    project, motor = edit.add_object(project, folder.id, "pou", "FB_Motor", data=body)
    project, inner = edit.add_object(project, motor.id, "folder", "Private")
    body = {"declaration": "METHOD Start : BOOL", "implementation": "Start := TRUE;"}
    project, _ = edit.add_object(project, inner.id, "method", "Start", data=body)
    project, _ = edit.add_object(
        project, motor.id, "action", "Reset", data={"implementation": "rSpeed := 0;"}
    )
    project, speed = edit.add_object(
        project, motor.id, "property", "Speed", data={"declaration": "PROPERTY Speed : REAL"}
    )
    get, set_ = project.children(speed.id)
    project = edit.change_data(project, get.id, {"implementation": "Speed := rSpeed;"})
    project = edit.change_data(
        project, set_.id, {"declaration": "VAR\n    r : REAL;\nEND_VAR", "implementation": "rSpeed := Speed;"}
    )
    project, _ = edit.add_object(project, None, "gvl", "Shared", data={"declaration": "VAR_GLOBAL\nEND_VAR"})
    return project


def texts(project: Project) -> dict[str, Source]:
    return {source.uri: source for source in application_sources(project, at(project, APP).id)}


def test_texts_of_an_application() -> None:
    found = texts(machine())
    assert list(found) == [
        "PLC_PRG",
        "FB_Motor",
        "FB_Motor.Start",
        "FB_Motor.Reset",
        "FB_Motor.Speed",
        "Shared",
    ]
    motor = found["FB_Motor"]
    assert motor.text == (
        "FUNCTION_BLOCK FB_Motor\nVAR\n    rSpeed : REAL;\nEND_VAR\nrSpeed := 1.0;\nEND_FUNCTION_BLOCK"
    )
    assert (motor.body_line, motor.scope, motor.owner, motor.name) == (4, "application", None, None)
    assert found["PLC_PRG"].text == "PROGRAM PLC_PRG\nVAR\nEND_VAR\n\nEND_PROGRAM"
    assert found["FB_Motor.Start"].owner == "FB_Motor"
    assert found["FB_Motor.Reset"].text == "ACTION Reset\nrSpeed := 0;\nEND_ACTION"
    assert found["FB_Motor.Reset"].body_line == 1
    assert found["FB_Motor.Speed"].text == (
        "PROPERTY Speed : REAL\n"
        "GET\nSpeed := rSpeed;\nEND_GET\n"
        "SET\nVAR\n    r : REAL;\nEND_VAR\nrSpeed := Speed;\nEND_SET\n"
        "END_PROPERTY"
    )
    assert (found["Shared"].scope, found["Shared"].name) == ("pous", "Shared")


def at_line(text: Source, line: int) -> Place:
    return text.map.place(Span(line, 0, line, 0))


def test_every_line_finds_its_editor() -> None:
    project = machine()
    found = texts(project)
    motor = at(project, f"{APP}/Drives/FB_Motor")
    assert at_line(found["FB_Motor"], 2) == Place(motor.id, "declaration", Span(2, 0, 2, 0))
    assert at_line(found["FB_Motor"], 4) == Place(motor.id, "implementation", Span(0, 0, 0, 0))
    setter = at(project, f"{APP}/Drives/FB_Motor/Speed/Set")
    speed = found["FB_Motor.Speed"]
    assert at_line(speed, 6) == Place(setter.id, "declaration", Span(1, 0, 1, 0))
    assert at_line(speed, 8) == Place(setter.id, "implementation", Span(0, 0, 0, 0))
    assert source_of(project, setter.id) == speed
    assert source_of(project, at(project, APP).id) is None
    reset = found["FB_Motor.Reset"]
    first = Place(reset.segments[0].object_id, "implementation", Span(0, 0, 0, 0))
    assert at_line(reset, 0) == at_line(reset, 1) == first
    assert at_line(reset, 2) == Place(reset.segments[0].object_id, "implementation", Span(0, 12, 0, 12))


def test_one_text_of_each_object_is_that_of_its_application() -> None:
    project = machine()
    for source in texts(project).values():
        assert source_of(project, source.segments[0].object_id) == source


def test_an_interface_is_a_frame_around_its_methods() -> None:
    project, itf = edit.add_object(new_project("x"), None, "interface", "I_Drive")
    project, _ = edit.add_object(
        project, itf.id, "method", "Stop", data={"declaration": "METHOD Stop : BOOL"}
    )
    found = texts(project)
    assert found["I_Drive"].text == "INTERFACE I_Drive\nEND_INTERFACE"
    assert (found["I_Drive.Stop"].owner, found["I_Drive.Stop"].scope) == ("I_Drive", "pous")


def test_a_child_application_sees_its_parent() -> None:
    """CON-07, CON-09: what is above is visible below, and hidden by an equal name."""
    project = new_project("x")
    parent = at(project, APP)
    project, _ = edit.add_object(project, parent.id, "gvl", "Limits")
    project, child = edit.add_object(project, parent.id, "application", "Child")
    project, own = edit.add_object(project, child.id, "pou", "PLC_PRG")
    found = application_sources(project, child.id)
    assert [source.uri for source in found] == ["PLC_PRG", "Limits"]
    assert found[0].segments[0].object_id == own.id
    assert [source.uri for source in application_sources(project, parent.id)] == ["PLC_PRG", "Limits"]


def test_tasks() -> None:
    project = new_project("x")
    app = at(project, APP)
    configuration = at(project, f"{APP}/Task Configuration")
    data = {
        "type": "event",
        "priority": 3,
        "event": "GVL.xGo",
        "interval": "300",
        "watchdog": {"enabled": True, "time": "T#5ms", "sensitivity": 2},
        "pous": [{"name": "A"}, {"name": "B", "comment": "second"}],
    }
    project, _ = edit.add_object(project, configuration.id, "task", "Fast", data=data)
    main, fast = tasks(project, app.id)
    assert (main.name, main.kind, main.interval_ns, main.priority, main.programs) == (
        "MainTask",
        "cyclic",
        20_000_000,
        1,
        ("PLC_PRG",),
    )
    assert (main.event, main.watchdog) == (None, None)
    assert (fast.kind, fast.interval_ns, fast.event, fast.programs) == ("event", 0, "GVL.xGo", ("A", "B"))
    assert fast.watchdog == Watchdog(5_000_000, 2)


def test_without_tasks_plc_prg_is_called() -> None:
    project = new_project("x")
    app = at(project, APP)
    project = edit.delete_object(project, at(project, f"{APP}/Task Configuration/MainTask").id)
    (task,) = tasks(project, app.id)
    assert (task.name, task.programs, task.object_id) == ("MainTask", ("PLC_PRG",), None)
    project = edit.delete_object(project, at(project, f"{APP}/PLC_PRG").id)
    assert tasks(project, app.id) == []


def test_libraries_come_from_the_application_and_the_pous_view() -> None:
    project, manager = edit.add_object(new_project("x"), None, "library_manager")
    data = {"references": [{"name": "Util", "namespace": "U"}, {"name": "STANDARD"}]}
    project = edit.change_data(project, manager.id, data)
    assert [item.name for item in libraries(project, at(project, APP).id)] == ["Standard", "Util"]


def test_a_reference_comes_with_its_parameters_and_its_place() -> None:
    project = new_project("x")
    manager = at(project, f"{APP}/Library Manager")
    values = [{"list": "GVL_Param", "name": "cMax", "value": "3"}, {"name": "cMin", "value": "1"}]
    references = [{"name": "Util", "version": "1.0", "placeholder": "U", "parameters": values}]
    project = edit.change_data(project, manager.id, {"references": references})
    given = (ParameterValue("GVL_Param", "cMax", "3"), ParameterValue("", "cMin", "1"))
    (found,) = libraries(project, at(project, APP).id)
    assert found == LibraryReference("Util", "1.0", None, "U", given, place=f"{APP}/Library Manager")
    assert LibraryReference.of(asdict(found)) == found
    assert [item.id for item in objects_with_libraries(project, at(project, APP).id)] == [manager.id]
    twice = [{"name": "cMax", "value": "1"}, {"name": "CMAX", "value": "2"}]
    with pytest.raises(InvalidDataError, match="the parameter 'CMAX' of 'Util' has two values"):
        edit.change_data(project, manager.id, {"references": [{"name": "Util", "parameters": twice}]})


def test_only_an_application_is_compiled() -> None:
    project = new_project("x")
    with pytest.raises(UnknownObjectError, match="is a pou, not an application"):
        application_sources(project, at(project, f"{APP}/PLC_PRG").id)


def test_language_of_a_body() -> None:
    """A body in IL is compiled as such whatever its first row looks like; ST is recognised by its text."""
    project = new_project("Plant")
    (application,) = project.applications()
    project, rows = edit.add_object(project, application.id, "pou", "Rows", language="IL")
    project, _ = edit.add_object(project, rows.id, "action", "Clear", language="IL")
    project, _ = edit.add_object(project, rows.id, "method", "Plain")
    found = {text.uri: text.bodies for text in application_sources(project, application.id)}
    assert found["Rows"] == (BodyText(3, "IL"),)
    assert found["Rows.Clear"] == (BodyText(1, "IL"),)
    assert found["Rows.Plain"] == ()
    with pytest.raises(InvalidDataError, match="possible: ST, IL"):
        edit.add_object(project, application.id, "pou", "Chart", language="FBD")
    with pytest.raises(InvalidDataError, match="possible: none"):
        edit.add_object(project, application.id, "gvl", "Values", language="IL")


def test_chart_as_text_is_compiled() -> None:
    project = new_project("Plant")
    (application,) = project.applications()
    chart = "INITIAL_STEP S: END_STEP\nTRANSITION FROM S TO S := TRUE; END_TRANSITION"
    data = {"declaration": "PROGRAM Chart", "implementation": chart, "language": "SFC"}
    project, _ = edit.add_object(project, application.id, "pou", "Chart", data=data)
    found = {text.uri: text.text for text in application_sources(project, application.id)}
    assert chart in found["Chart"]


CHANGES = ("text", "name", "exclude", "delete", "copy", "move")


@given(random=st.randoms(use_true_random=False))
def test_texts_written_again_after_edits_are_those_of_the_project(random: Random) -> None:
    project, written = machine(), WrittenSources()
    for _ in range(8):
        project = _changed(project, random)
        application = at(project, APP).id
        whole = application_sources(project, application)
        again = application_sources(project, application, written)
        assert [asdict(source) for source in again] == [asdict(source) for source in whole]


def _changed(project: Project, random: Random) -> Project:
    """A project after one edit of an object that has a text, or of none where the edit is not possible."""
    items = [item for item in project.walk() if isinstance(item.data, CodeData)]
    if not items:
        return project
    item = random.choice(items)
    change = random.choice(CHANGES)
    try:
        if change == "text":
            fields = [name for name in ("declaration", "implementation") if hasattr(item.data, name)]
            name = random.choice(fields)
            return edit.change_data(project, item.id, {name: getattr(item.data, name) + "\n// edited"})
        if change == "name":
            return edit.rename_object(project, item.id, f"{item.name}{random.randrange(10)}")
        if change == "exclude":
            return edit.exclude_object(project, item.id, not item.excluded)
        if change == "delete":
            return edit.delete_object(project, item.id)
        target = random.choice([*project.walk()]).id
        act = edit.copy_object if change == "copy" else edit.move_object
        changed = act(project, item.id, target)
        return changed[0] if isinstance(changed, tuple) else changed
    except ProjectError:
        return project


def test_an_object_that_stays_the_same_keeps_its_text() -> None:
    project, written = machine(), WrittenSources()
    application = at(project, APP).id
    before = {text.uri: text for text in application_sources(project, application, written)}
    motor = at(project, f"{APP}/Drives/FB_Motor")
    edited = edit.change_data(project, motor.id, {"implementation": "rSpeed := 2.0;"})
    after = {text.uri: text for text in application_sources(edited, application, written)}
    assert {uri for uri, text in after.items() if text is not before[uri]} == {"FB_Motor"}
    getter = at(project, f"{APP}/Drives/FB_Motor/Speed/Get")
    edited = edit.change_data(edited, getter.id, {"implementation": "Speed := 3.0;"})
    last = {text.uri: text for text in application_sources(edited, application, written)}
    # a block is written again with what is below it, its accessors among that
    assert {uri for uri, text in last.items() if text is not after[uri]} == {"FB_Motor", "FB_Motor.Speed"}

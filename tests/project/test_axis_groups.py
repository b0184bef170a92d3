"""Axis groups in the tree and what the compiler gets of them (axis_group.md AG-01, AG-02, AG-03, AG-05)."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.project.axis_projects import application_id, build, errors, only, with_axes

from tappet.libraries import load
from tappet.libraries.catalog import items
from tappet.project import edit
from tappet.project.axis_groups.kinematics import FORMS, table
from tappet.project.axis_groups.settings import AxisGroupSettings, PathDynamics
from tappet.project.errors import InvalidDataError
from tappet.project.folder import codec
from tappet.project.model import Project
from tappet.project.sources import application_sources, libraries, tasks
from tappet.runtime.local import LocalRuntime

KINEMATICS_JSON = Path(__file__).parents[2] / "frontend/src/kinds/axis_group/kinematics.json"
DECLARATION = """PROGRAM PLC_PRG
VAR
    fbPower : SMC_GroupPower;
    fbEnable : MC_GroupEnable;
    fbDisable : MC_GroupDisable;
    fbMove : MC_MoveLinearAbsolute;
END_VAR"""
BODY = """fbPower(AxisGroup := Machine, Enable := TRUE, bRegulatorOn := TRUE, bDriveStart := TRUE);
fbEnable(AxisGroup := Machine, Execute := fbPower.Status);
fbMove.Position.a[0] := 30.0;
fbMove.Position.a[1] := 40.0;
fbMove(AxisGroup := Machine, Execute := fbEnable.Done, CoordSystem := SMC_COORD_SYSTEM.ACS);"""
DEFAULTS = {"velocity": 10.0, "acceleration": 100.0, "deceleration": 100.0, "jerk": 0.0}


def with_group(*axes: str, **data: Any) -> Project:
    """A project with the axes X and Y and the group Machine of these axes."""
    project = with_axes("X", "Y")
    data = {"axes": list(axes), **data}
    project, _ = edit.add_object(project, application_id(project), "axis_group", "Machine", data=data)
    return project


def programmed(project: Project, body: str = BODY) -> Project:
    (program,) = project.find_kind("pou")
    return edit.change_data(project, program.id, {"declaration": DECLARATION, "implementation": body})


def running(project: Project) -> LocalRuntime:
    result = build(project)
    assert [str(d) for d in result.diagnostics if d.severity == "error"] == []
    assert result.package is not None
    return LocalRuntime(result.package)


def test_a_group_brings_its_libraries() -> None:
    project = with_group("X", "Y")
    names = [reference.name for reference in libraries(project, application_id(project))]
    assert {"SM3_Basic", "SM3_AxisGroup"} <= set(names)


def test_a_group_has_its_axes_and_moves_by_the_defaults_of_its_settings() -> None:
    """AG-01: 50 mm with 10 mm/s and 100 mm/s² take 5.1 s."""
    with running(programmed(with_group("X", "Y", defaults=DEFAULTS))) as plc:
        plc.run(cycles=3)
        assert plc.literal("Machine.iAxes") == "2"
        began = next(n for n in range(20) if plc.run(cycles=1) is None and plc.read("PLC_PRG.fbMove.Busy"))
        assert began < 10
        cycles = 0
        while plc.read("PLC_PRG.fbMove.Busy"):
            plc.run(cycles=1)
            cycles += 1
            assert cycles < 400
        assert cycles * 0.02 == pytest.approx(5.1, abs=0.06)
        assert plc.read("PLC_PRG.fbMove.Done")
        assert plc.read("X.fSetPosition") == pytest.approx(30.0)
        assert plc.read("Y.fSetPosition") == pytest.approx(40.0)


def test_no_movement_exceeds_the_limits_of_the_group() -> None:
    limits = {"velocity": 4.0, "acceleration": 20.0, "deceleration": 20.0, "jerk": 0.0}
    project = with_group("X", "Y", limits=limits)
    body = BODY.replace("Execute := fbEnable.Done", "Execute := fbEnable.Done, Velocity := 50.0, "
                        "Acceleration := 90.0, Deceleration := 90.0")  # fmt: skip
    with running(programmed(project, body)) as plc:
        velocities, accelerations = [], []
        for _ in range(300):
            plc.run(cycles=1)
            velocities.append(float(plc.read("Machine.fPathVelocity")))
            accelerations.append(float(plc.read("Machine.fPathAcceleration")))
    assert max(velocities) == pytest.approx(4.0)
    assert max(accelerations) == pytest.approx(20.0)


def test_products_lie_where_the_settings_have_them() -> None:
    """Product 1 is shifted by (50, 7) and turned by 90 degrees: (30, 40) there is (50 - 40, 7 + 30)."""
    frame = {"x": 50.0, "y": 7.0, "z": 0.0, "a": 90.0, "b": 0.0, "c": 0.0}
    project = with_group("X", "Y", pcs_1=frame, defaults={**DEFAULTS, "velocity": 50.0})
    with running(programmed(project, BODY.replace("SYSTEM.ACS", "SYSTEM.PCS_1"))) as plc:
        plc.run(cycles=200)
        assert plc.read("X.fSetPosition") == pytest.approx(10.0)
        assert plc.read("Y.fSetPosition") == pytest.approx(37.0)


def test_the_bus_task_of_the_axes_prepares_the_group_also_in_a_folder() -> None:
    project = with_axes("X", "Y")
    project, folder = edit.add_object(project, application_id(project), "folder", "Groups")
    project, _ = edit.add_object(project, folder.id, "axis_group", "Machine", data={"axes": ["x", "Y"]})
    (task,) = tasks(project, application_id(project))
    assert task.programs == ("SM3_Group_Machine", "SM3_Begin_MainTask", "PLC_PRG", "SM3_End_MainTask")
    assert errors(project) == []


def test_the_axes_of_a_group_follow_an_online_change_once_it_is_disabled() -> None:
    project = programmed(with_group("X"), "fbEnable(AxisGroup := Machine);\nfbDisable(AxisGroup := Machine);")
    more = edit.change_data(project, only(project, "axis_group").id, {"axes": ["Y", "X"]})
    with running(project) as plc:
        plc.run(cycles=2)
        plc.write("PLC_PRG.fbEnable.Execute", True)
        plc.run(cycles=1)
        assert plc.literal("Machine.eState") == "GroupStandby"
        changed = build(more, plc.package).package
        assert changed is not None
        plc.plc.download(changed.to_bytes(), "online_change")
        plc.run(cycles=2)
        assert plc.literal("Machine.iAxes") == "1"
        plc.write("PLC_PRG.fbDisable.Execute", True)
        plc.run(cycles=3)
        assert plc.literal("Machine.iAxes") == "2"
        assert plc.literal("IoConfig_GroupPanel_Machine.Machine.ePrepared") == "SMC_NO_ERROR"


@pytest.mark.parametrize(
    ("axes", "message", "index"),
    [
        (["X", ""], "No axis is chosen for index 2", 1),
        (["X", "Gone"], "The axis Gone of the axis group Machine does not exist", 1),
        (["Y", "X", "y"], "The axis y is twice in the axis group Machine", 2),
    ],
)
def test_what_cannot_be_a_group_is_an_error_at_its_row(axes: list[str], message: str, index: int) -> None:
    project = with_group(*axes)
    found = [d for d in build(project).diagnostics if d.severity == "error"]
    assert len(found) == 1
    assert message in found[0].message
    source = next(s for s in application_sources(project, application_id(project)) if s.uri == found[0].uri)
    place = source.map.place(found[0].span)
    assert place.object_id == only(project, "axis_group").id
    assert place.element == f"axis:{index}"


def test_a_program_adds_the_axes_of_a_group_without_any() -> None:
    """AG-02; a warning says that it has none."""
    project = with_group()
    found = [d.message for d in build(project).diagnostics if d.severity == "warning"]
    said = "The axis group Machine has no axes; choose those that it moves, or have a program add them"
    assert found == [said]
    (program,) = project.find_kind("pou")
    data = {
        "declaration": "PROGRAM PLC_PRG\nVAR\n    fbAdd : MC_AddAxisToGroup;\nEND_VAR",
        "implementation": "fbAdd(AxisGroup := Machine, Axis := Y, Execute := TRUE);",
    }
    with running(edit.change_data(project, program.id, data)) as plc:
        plc.run(cycles=5)
        assert plc.literal("Machine.iAxes") == "1"
        assert plc.read("PLC_PRG.fbAdd.Done")


def test_the_forms_are_those_of_the_library() -> None:
    """Each kinematics of SM3_Transformation with its number of axes and its parameters."""
    library = load("SM3_Transformation")
    found = {}
    for item in items(library):
        if item.kind == "function_block" and item.name.startswith("Kin_"):
            pins = [(pin.name, pin.type) for pin in item.inputs if pin.name != "adOffset"]
            text = next(source.text for source in library.sources if source.uri.endswith(f"/{item.name}"))
            axes = re.search(r"GetNumAxes := (\d)", text)
            assert axes is not None
            found[item.name] = (int(axes[1]), [name for pin in pins for name in _members(*pin)])
    assert {name: (form.axes, list(form.parameters)) for name, form in FORMS.items()} == found
    assert KINEMATICS_JSON.read_text(encoding="utf-8") == table()


def _members(name: str, type_name: str) -> list[str]:
    if type_name == "LREAL":
        return [name]
    one = next(item for item in items(load("SM3_Kinematics")) if item.name == type_name.rpartition(".")[2])
    return [f"{name}.{member.name}" for member in one.members]


def test_a_group_moves_by_its_kinematics() -> None:
    """A SCARA with arms of 300 and 200 mm: (300, 200) is a right angle at its elbow, the first joint at 0."""
    parameters = {"dArmLength1": 300.0, "dArmLength2": 200.0}
    kinematics = {"type": "Kin_Scara2_Z", "parameters": parameters}
    project = with_group("X", "Y", "Z", kinematics=kinematics, defaults={**DEFAULTS, "velocity": 50.0})
    pool = only(project, "axis_pool")
    project, _ = edit.add_object(project, pool.id, "axis", "Z", data={"axis_type": "finite"})
    names = [reference.name for reference in libraries(project, application_id(project))]
    assert "SM3_Transformation" in names
    body = BODY.replace("a[0] := 30.0", "a[0] := 300.0").replace("a[1] := 40.0", "a[1] := 200.0")
    body = "fbSet(AxisGroup := Machine, Execute := TRUE);\n" + body.replace("SYSTEM.ACS", "SYSTEM.MCS")
    project = programmed(project, body)
    declaration = DECLARATION.replace("END_VAR", "    fbSet : MC_GroupSetPosition;\nEND_VAR")
    (program,) = project.find_kind("pou")
    project = edit.change_data(project, program.id, {"declaration": declaration, "implementation": body})
    with running(project) as plc:
        plc.write("PLC_PRG.fbSet.Position.a[1]", 45.0)
        plc.write("PLC_PRG.fbSet.CoordSystem", 0)
        plc.run(cycles=1500)
        assert plc.literal("IoConfig_GroupPanel_Machine.Machine.ePrepared") == "SMC_NO_ERROR"
        assert plc.literal("PLC_PRG.fbMove.ErrorID") == "SMC_NO_ERROR"
        assert plc.read("PLC_PRG.fbMove.Done")
        assert [plc.read(f"{axis}.fSetPosition") for axis in "XYZ"] == pytest.approx(
            [0.0, 90.0, 0.0], abs=1e-6
        )


def test_a_kinematics_has_its_axes() -> None:
    project = with_group("X", "Y", kinematics={"type": "Kin_Gantry3"})
    assert errors(project) == [
        "The kinematics Kin_Gantry3 of the axis group Machine needs 3 axes, not 2; choose the others"
    ]


def test_an_axis_is_in_one_group_only() -> None:
    project = with_group("X", "Y")
    data = {"axes": ["Y"]}
    project, _ = edit.add_object(project, application_id(project), "axis_group", "Other", data=data)
    said = "The axis Y of the axis group {} is in the axis group {}, too; an axis can be in one group only"
    assert errors(project) == [said.format("Machine", "Other"), said.format("Other", "Machine")]


def test_an_axis_that_is_excluded_is_none() -> None:
    project = with_group("X", "Y")
    axis = next(axis for axis in project.find_kind("axis") if axis.name == "Y")
    project = edit.exclude_object(project, axis.id, True)
    assert errors(project) == ["The axis Y of the axis group Machine does not exist; choose another axis"]


def test_axes_of_a_group_have_one_bus_task() -> None:
    project = with_group("X", "Y")
    fast = {"interval": "T#1ms", "pous": []}
    project, _ = edit.add_object(project, only(project, "task_configuration").id, "task", "Fast", data=fast)
    axis = next(axis for axis in project.find_kind("axis") if axis.name == "Y")
    project = edit.change_data(project, axis.id, {**axis.data.model_dump(), "bus_task": "MainTask"})
    assert errors(project) == [
        "The axes X and Y of the axis group Machine have different bus tasks; choose the same one"
    ]


def test_names_are_followed() -> None:
    project = programmed(with_group("X", "Y"))
    axis = next(axis for axis in project.find_kind("axis") if axis.name == "X")
    project = edit.rename_object(project, axis.id, "Portal")
    assert only(project, "axis_group").data_as(AxisGroupSettings).axes == ["Portal", "Y"]
    project = edit.rename_object(project, only(project, "axis_group").id, "Gantry")
    text = only(project, "pou").data.model_dump()["implementation"]
    assert "AxisGroup := Gantry" in text
    assert "Machine" not in text
    assert errors(project) == []


@pytest.mark.parametrize(
    ("data", "place"),
    [
        ({"axes": ["1X"]}, "axes"),
        ({"axes": [f"A{n}" for n in range(7)]}, "axes"),
        ({"limits": {"velocity": -1.0}}, "velocity"),
        ({"limits": {"velocity": 1.0}, "defaults": {"velocity": 2.0}}, "default velocity"),
        ({"pcs_1": {"x": float("nan")}}, "x"),
        ({"kinematics": {"type": "Kin_Gantry3", "parameters": {"dArmLength1": 1.0}}}, "no parameter"),
        ({"kinematics": {"type": "Kin_Nothing"}}, "type"),
    ],
)
def test_impossible_settings_are_refused_by_name(data: dict[str, Any], place: str) -> None:
    with pytest.raises(InvalidDataError, match=place):
        with_group("X", **data)


@given(
    axes=st.lists(st.sampled_from(["X", "Y", "Z", "A", "B", "C", ""]), max_size=6),
    values=st.lists(st.floats(0, 1e9), min_size=4, max_size=4),
    places=st.lists(st.floats(-1e9, 1e9), min_size=6, max_size=6),
)
def test_settings_are_the_same_out_of_a_folder(
    axes: list[str], values: list[float], places: list[float]
) -> None:
    """The folder format keeps each number to the last bit."""
    dynamics = dict(zip(PathDynamics.model_fields, values, strict=True))
    frame = dict(zip("xyzabc", places, strict=True))
    project = with_group(*axes, limits=dynamics, pcs_2=frame)
    read = codec.decode(codec.encode(project)).project
    assert only(read, "axis_group").data == only(project, "axis_group").data

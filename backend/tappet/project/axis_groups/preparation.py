"""What the bus task of the axes does for an axis group, which nobody has to write: it adds the axes and
places the products at the start, and lets the panel of the group act.

A program of its own for each group is called in front of the programs of that task. Where the axes cannot be
a group (one does not exist, is in another group or in another bus task), errors at the group say why (AG-02).
A group without axes gets them from a program.
"""

from __future__ import annotations

import zlib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

from tappet.iec.task import Task
from tappet.project.axes.cyclic_calls import bus_task_of, fastest_cyclic
from tappet.project.axes.settings import AxisSettings
from tappet.project.axes.variables import NOT_WRITTEN_BY_HAND
from tappet.project.axis_groups.kinematics import FORMS, KIN_ENDING
from tappet.project.axis_groups.settings import AxisGroupSettings
from tappet.project.axis_groups.variables import LIBRARY, frame
from tappet.project.model import APPLICATION, Project, ProjectObject
from tappet.project.naming import name_key
from tappet.project.source_text import SourceWriter

PANEL = "IoConfig_GroupPanel_{name}"
"""The list that holds the panel of a group under the name of the group."""


@dataclass(frozen=True, slots=True)
class _Fault:
    """What is wrong with an axis of a group, or with all of them."""

    text: str
    index: int | None = None


def around_tasks(
    project: Project, group: ProjectObject, tasks: Sequence[Task], writer: SourceWriter
) -> list[Task]:
    """The tasks with the program of a group in the bus task of its axes; writes that program."""
    names = group.data_as(AxisGroupSettings).axes
    axes = _axes(project, group)
    moved_by = [bus_task_of(axes[name_key(name)], project, tasks) for name in names if name_key(name) in axes]
    faults = _faults(project, group, names, axes) or _foreign_tasks(group, names, moved_by)
    bus = moved_by[0] if moved_by else fastest_cyclic(tasks)
    writer.name = PANEL.format(name=group.name)
    writer.keyword(NOT_WRITTEN_BY_HAND)
    writer.keyword("{attribute 'qualified_only'}\nVAR_GLOBAL")
    panel = f"    {{attribute 'hide'}}\n    {group.name} : {LIBRARY}.AxisGroupPanel;"
    writer.part(group.id, "declaration", panel)
    writer.keyword("END_VAR")
    if not names:
        text = (
            f"The axis group {group.name} has no axes; choose those that it moves, or have a program add them"
        )
        _write_faults(group, [_Fault(text)], writer, "warning")
    if faults:
        _write_faults(group, faults, writer)
        return list(tasks)
    if bus is None:
        return list(tasks)  # The axes say why no task moves them
    program = f"SM3_Group_{group.name}"
    writer.keyword(f"{{attribute 'hide'}}\nPROGRAM {program}")
    writer.part(group.id, "declaration", _statements(group.name, group.data_as(AxisGroupSettings)))
    writer.keyword("END_PROGRAM")
    return [replace(t, programs=(program, *t.programs)) if t is bus else t for t in tasks]


def _statements(name: str, settings: AxisGroupSettings) -> str:
    panel = f"{PANEL.format(name=name)}.{name}"
    steps = [
        f"    {panel}.Add(Group := {name}, Axis := {axis}, uiIdent := {index});"
        for index, axis in enumerate(settings.axes, 1)
    ]
    if settings.kinematics.type:
        steps.append(f"    {panel}.SetKinematics(Group := {name}, itfKin := {name}{KIN_ENDING});")
    lists = {"PCS_1": frame(settings.pcs_1), "PCS_2": frame(settings.pcs_2)}
    variables = [f"    st{system} : {LIBRARY}.MC_COORD_REF := {place};" for system, place in lists.items()]
    steps += [
        f"    {panel}.Place(Group := {name}, eSystem := {LIBRARY}.SMC_COORD_SYSTEM.{system}, "
        f"stFrame := st{system});"
        for system in lists
    ]
    settled = [*steps, *variables, settings.kinematics.model_dump_json()]
    number = zlib.crc32("\n".join(settled).encode()) or 1
    return "\n".join(
        [
            "VAR CONSTANT",
            *variables,
            "END_VAR",
            f"IF {panel}.Prepares(Group := {name}, udiSettings := {number}) THEN",
            *steps,
            "END_IF",
            f"IF {panel}.xUsed THEN",
            f"    {panel}(AxisGroup := {name});",
            "END_IF",
        ]
    )


def _application_of(project: Project, item: ProjectObject) -> ProjectObject:
    return next(above for above in project.ancestors(item.id) if above.kind == APPLICATION)


def _of_application(project: Project, item: ProjectObject, data: type) -> list[ProjectObject]:
    """The objects of an application with such data that are built."""
    application = _application_of(project, item)
    return [
        one
        for one in project.walk(application.id)
        if isinstance(one.data, data)
        and _application_of(project, one) is application
        and not any(above.excluded for above in (one, *project.ancestors(one.id)))
    ]


def _axes(project: Project, group: ProjectObject) -> Mapping[str, ProjectObject]:
    return {name_key(one.name): one for one in _of_application(project, group, AxisSettings)}


def _faults(
    project: Project, group: ProjectObject, names: Sequence[str], axes: Mapping[str, ProjectObject]
) -> list[_Fault]:
    """What keeps the axes from being a group."""
    owners = _owners(project, group)
    found: list[_Fault] = []
    seen: set[str] = set()
    for index, name in enumerate(names):
        key = name_key(name)
        if not name:
            text = (
                f"No axis is chosen for index {index + 1} of the axis group {group.name}; choose one, or "
                "remove the row"
            )
        elif key not in axes:
            text = f"The axis {name} of the axis group {group.name} does not exist; choose another axis"
        elif key in seen:
            text = f"The axis {name} is twice in the axis group {group.name}; choose another axis"
        elif key in owners:
            text = (
                f"The axis {name} of the axis group {group.name} is in the axis group {owners[key]}, too; "
                "an axis can be in one group only"
            )
        else:
            text = ""
        seen.add(key)
        if text:
            found.append(_Fault(text, index))
    return found or _too_few(group, names)


def _too_few(group: ProjectObject, names: Sequence[str]) -> list[_Fault]:
    """The kinematics needs more axes than there are; those that are added by a program count for nothing."""
    form = FORMS.get(group.data_as(AxisGroupSettings).kinematics.type)
    if form is None or len(names) >= form.axes:
        return []
    kinematics = group.data_as(AxisGroupSettings).kinematics.type
    text = (
        f"The kinematics {kinematics} of the axis group {group.name} needs {form.axes} axes, not "
        f"{len(names)}; choose the others"
    )
    return [_Fault(text, len(names) - 1 if names else None)]


def _foreign_tasks(
    group: ProjectObject, names: Sequence[str], moved_by: Sequence[Task | None]
) -> list[_Fault]:
    """The first axis in another bus task than the first one."""
    for index, (name, task) in enumerate(zip(names, moved_by, strict=True)):
        if task is not moved_by[0]:
            text = (
                f"The axes {names[0]} and {name} of the axis group {group.name} have different bus tasks; "
                "choose the same one"
            )
            return [_Fault(text, index)]
    return []


def _owners(project: Project, group: ProjectObject) -> Mapping[str, str]:
    """The axes of the other groups of the application, by key: the name of a group."""
    return {
        name_key(axis): other.name
        for other in _of_application(project, group, AxisGroupSettings)
        if other.id != group.id
        for axis in other.data_as(AxisGroupSettings).axes
    }


def _write_faults(
    group: ProjectObject, faults: Sequence[_Fault], writer: SourceWriter, severity: str = "error"
) -> None:
    writer.keyword(f"{{attribute 'hide'}}\nFUNCTION SM3_{group.name}_Findings : BOOL")
    for fault in faults:
        text = f"{{{severity} '{fault.text}'}}"
        if fault.index is None:
            writer.part(group.id, "declaration", text)
        else:
            writer.element(group.id, f"axis:{fault.index}", text)
    writer.keyword(f"SM3_{group.name}_Findings := TRUE;\nEND_FUNCTION")

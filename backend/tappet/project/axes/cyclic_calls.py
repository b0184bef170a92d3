"""The calls that axes need around the programs of their bus task, which nobody has to write.

For each task that moves axes there are two programs, one before all others of the task and one behind them:
the first takes over what the drives say, the second lets their panels act and moves the axes on by a cycle,
both in the order of the tree. With `xStop` of the second the runtime asks for a controlled stop before it
stops (INF-08). Behind a fault of any program it calls a third part instead of the programs, in which axes
brake: a cycle that has begun is completed, and then there are cycles of the axes alone. Where no task can
move an axis, an error at the axis says why.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from tappet.iec.task import Task
from tappet.project.axes.channels import assignment, bound
from tappet.project.axes.drives import LIBRARY, drive_name, drive_of
from tappet.project.axes.literals import real
from tappet.project.axes.settings import AxisSettings
from tappet.project.axes.variables import NOT_WRITTEN_BY_HAND
from tappet.project.model import Project, ProjectObject
from tappet.project.naming import name_key
from tappet.project.source_text import SourceWriter

PANELS = "IoConfig_AxisPanels"
"""The list of the panels, each with the name of its axis."""
_NS_PER_S = 1_000_000_000
_BEGIN = """{axis}.fTaskCycle := {cycle};
{axis}.BeginCycle();"""
_END = f"""IF {PANELS}.{{axis}}.xUsed THEN
    {PANELS}.{{axis}}(Axis := {{axis}});
END_IF
IF xStop THEN
    {{axis}}.bDriveStart := FALSE;
    xMoves := xMoves OR ABS({{axis}}.fSetVelocity) > 0.0;
END_IF
{{axis}}.EndCycle();"""
_BEGIN_VARIABLES = """VAR_OUTPUT
    udiBegun : UDINT;
END_VAR
udiBegun := udiBegun + 1;"""
_END_VARIABLES = """VAR_INPUT
    xStop : BOOL;
END_VAR
VAR_OUTPUT
    udiEnded : UDINT;
END_VAR
VAR
    xMoves : BOOL;
    udiStood : UDINT;
END_VAR
xMoves := FALSE;"""
_END_LAST = """IF xStop THEN
    udiStood := SEL(xMoves, udiStood + 1, 0);
END_IF
udiEnded := {before}.udiBegun;"""
_BRAKE = """{{attribute 'hide'}}
{{attribute 'tappet_export' := 'SM3_Brake_{task}'}}
FUNCTION SM3_Brake_{task} : BOOL
IF {before}.udiBegun = {behind}.udiEnded THEN
    {before}();
END_IF
{behind}(xStop := TRUE);
SM3_Brake_{task} := TRUE;
END_FUNCTION"""


@dataclass(frozen=True, slots=True)
class _Moved:
    """An axis and the task that moves it, or why there is none."""

    axis: ProjectObject
    task: Task | None
    fault: str = ""


@dataclass(frozen=True, slots=True)
class _Piece:
    """Statements of an axis."""

    axis_id: str
    text: str
    channel: str = ""
    """The channel that they carry: messages about them are at its row."""


def around_tasks(
    project: Project, pool: ProjectObject, tasks: Sequence[Task], writer: SourceWriter
) -> list[Task]:
    """The tasks with the calls of the axes of a pool in them; writes the programs that are called."""
    axes = [
        item
        for item in project.children(pool.id)
        if isinstance(item.data, AxisSettings) and not item.excluded
    ]
    moved = _behind_their_masters([_moved(item, pool, tasks) for item in axes])
    if not moved:
        return list(tasks)
    writer.name = PANELS
    writer.keyword(NOT_WRITTEN_BY_HAND)
    _panels(writer, moved)
    _faults(writer, [one for one in moved if one.task is None])
    return [_with_calls(task, [one.axis for one in moved if one.task is task], writer) for task in tasks]


def bus_task_of(axis: ProjectObject, project: Project, tasks: Sequence[Task]) -> Task | None:
    """The task of an application that moves an axis; None where none can."""
    assert axis.parent_id is not None
    return _moved(axis, project.get(axis.parent_id), tasks).task


def fastest_cyclic(tasks: Sequence[Task]) -> Task | None:
    """The bus task of what nobody has chosen one for; None without any cyclic task."""
    cyclic = [task for task in tasks if task.kind == "cyclic"]
    return min(cyclic, key=lambda task: (task.interval_ns, task.priority)) if cyclic else None


def _moved(axis: ProjectObject, pool: ProjectObject, tasks: Sequence[Task]) -> _Moved:
    """An axis with its task: its own choice, else that of the pool, else the fastest cyclic one."""
    chosen = axis.data_as(AxisSettings).bus_task or _bus_task_of(pool)
    if not chosen:
        fastest = fastest_cyclic(tasks)
        if fastest is not None:
            return _Moved(axis, fastest)
        return _Moved(
            axis,
            None,
            f"The application has no cyclic task that could move the axis {axis.name}; add a cyclic task",
        )
    task = next((task for task in tasks if name_key(task.name) == name_key(chosen)), None)
    if task is None:
        return _Moved(
            axis,
            None,
            f"The bus task {chosen} of the axis {axis.name} does not exist; choose another bus task",
        )
    if task.kind != "cyclic":
        return _Moved(
            axis,
            None,
            f"The bus task {task.name} of the axis {axis.name} is not cyclic; set values are computed for a "
            "fixed time, so choose a cyclic task",
        )
    return _Moved(axis, task)


def _behind_their_masters(moved: Sequence[_Moved]) -> list[_Moved]:
    """Logical axes behind the others, or why they cannot mirror their masters."""
    known = {name_key(one.axis.name): one for one in moved}
    others = [one for one in moved if not _is_logical(one.axis)]
    return others + [_mirrored(one, known) for one in moved if _is_logical(one.axis)]


def _is_logical(axis: ProjectObject) -> bool:
    return axis.data_as(AxisSettings).drive == "SM_Drive_Logical"


def _mirrored(one: _Moved, known: Mapping[str, _Moved]) -> _Moved:
    name, chosen = one.axis.name, one.axis.data_as(AxisSettings).mirroring.master
    master = known.get(name_key(chosen))
    fault = ""
    if not chosen:
        fault = f"The logical axis {name} has no master; choose the axis that it mirrors"
    elif master is None:
        fault = f"The axis {chosen} that {name} mirrors does not exist; choose another master"
    elif master is one:
        fault = f"The logical axis {name} is its own master; choose another axis"
    elif one.task is not None and master.task is not one.task:
        fault = f"The axis {name} has another bus task than its master {chosen}; choose the same one"
    return replace(one, task=None, fault=fault) if fault else one


def _bus_task_of(pool: ProjectObject) -> str:
    return str(getattr(pool.data, "bus_task", ""))


def _faults(writer: SourceWriter, moved: Sequence[_Moved]) -> None:
    """Says at each of these axes why no task moves it."""
    if moved:
        writer.keyword("{attribute 'hide'}\nFUNCTION SM3_NoBusTask : BOOL")
        for one in moved:
            writer.part(one.axis.id, "declaration", f"{{error '{one.fault}'}}")
        writer.keyword("END_FUNCTION")


def _with_calls(task: Task, axes: Sequence[ProjectObject], writer: SourceWriter) -> Task:
    if not axes:
        return task
    cycle = real(task.interval_ns / _NS_PER_S)
    before, behind = f"SM3_Begin_{task.name}", f"SM3_End_{task.name}"
    begin, end = [], []
    for axis in axes:
        begin += [*_carried(axis, inputs=True), _calls(axis, before=True, cycle=cycle)]
        end += [_calls(axis, before=False, cycle=cycle), *_carried(axis, inputs=False)]
    _program(writer, f"PROGRAM {before}\n{_BEGIN_VARIABLES}", begin)
    _program(writer, f"PROGRAM {behind}\n{_END_VARIABLES}", end, _END_LAST.format(before=before))
    writer.keyword(_BRAKE.format(task=task.name, before=before, behind=behind))
    return replace(task, programs=(before, *task.programs, behind))


def _calls(axis: ProjectObject, before: bool, cycle: str) -> _Piece:
    """The calls of an axis and its drive in front of the programs, or behind them."""
    drive = drive_of(axis.data_as(AxisSettings))
    text = drive.before + _BEGIN if before else _END + drive.behind
    return _Piece(axis.id, text.format(axis=axis.name, drive=drive_name(axis.name), cycle=cycle))


def _carried(axis: ProjectObject, inputs: bool) -> Iterator[_Piece]:
    """The assignments of channels that are not mapped automatically."""
    settings = axis.data_as(AxisSettings)
    for channel, binding in bound(settings.drive, settings.mapping):
        if channel.is_input == inputs:
            yield _Piece(axis.id, assignment(axis.name, channel, binding), channel.name)


def _program(writer: SourceWriter, head: str, pieces: Sequence[_Piece], last: str = "") -> None:
    """A program with the statements of each axis."""
    writer.keyword(f"{{attribute 'hide'}}\n{head}")
    for piece in pieces:
        if piece.channel:
            writer.element(piece.axis_id, piece.channel, piece.text)
        else:
            writer.part(piece.axis_id, "declaration", piece.text)
    writer.keyword(last or None)
    writer.keyword("END_PROGRAM")


def _panels(writer: SourceWriter, moved: Sequence[_Moved]) -> None:
    """The panels of the axes that are moved; they cost one look a cycle as long as nobody uses them."""
    tasks = [(one.axis, one.task) for one in moved if one.task is not None]
    if tasks:
        writer.keyword("{attribute 'qualified_only'}\nVAR_GLOBAL")
        for axis, task in tasks:
            panel = f"{axis.name} : {LIBRARY}.AxisPanel := (sBusTask := '{task.name}');"
            writer.part(axis.id, "declaration", f"    {{attribute 'hide'}}\n    {panel}")
        writer.keyword("END_VAR")

"""The object kind trace: its settings, what of them the runtime needs, and names that follow."""

from __future__ import annotations

import pytest
from axis_projects import build
from pydantic import ValidationError

from tappet.codegen.expressions.compiler import compile_expression
from tappet.project.edit import add_object, change_data, rename_object
from tappet.project.kinds.task import TASK
from tappet.project.kinds.trace import TRACE
from tappet.project.motion_project import motion_project
from tappet.project.trace import TraceChannel, TraceData, TraceRecord, TraceTrigger, axis_channels


def _record(**fields: object) -> TraceRecord:
    return TraceRecord.model_validate(fields)


def test_defaults_are_those_of_the_specification() -> None:
    data, record, channel = TraceData(), TraceRecord(), TraceChannel()
    assert (data.refresh_rate, data.points, data.stacked) == (500, 10_000, False)  # TRC-10 .. TRC-12
    assert (record.every, record.buffer, record.condition, record.task) == (
        1,
        100,
        "",
        "",
    )  # TRC-24 .. TRC-27
    assert (record.trigger.edge, record.trigger.position, record.trigger.level) == ("none", 50, "")
    assert (channel.graph, channel.color, channel.visible) == ("line", "", True)  # TRC-41, TRC-42
    assert not channel.minimum_warning.on
    assert not channel.maximum_warning.on


@pytest.mark.parametrize(
    ("fields", "said"),
    [
        ({"records": [{"name": "A"}, {"name": "a"}]}, "two records are named"),
        (
            {"records": [{"channels": [{"variable": "P.a"}, {"variable": "p.A "}]}]},
            "twice; add it to another",
        ),
        ({"records": [{"buffer": 0}]}, "greater than or equal to 1"),
        ({"records": [{"trigger": {"position": 101}}]}, "less than or equal to 100"),
        ({"records": [{"every": 0}]}, "greater than or equal to 1"),
        ({"records": [{"channels": [{"color": "red"}]}]}, "pattern"),
        ({"records": [{"channels": [{"appearance": {"minimum": 5, "maximum": 5}}]}]}, "not less than"),
        ({"records": [{"appearance": {"x": {"length": "soon"}}}]}, "is no time"),
        ({"refresh_rate": 0}, "greater than or equal to 50"),
    ],
)
def test_what_cannot_be_is_refused(fields: dict[str, object], said: str) -> None:
    with pytest.raises(ValidationError, match=said):
        TraceData.model_validate(fields)


def test_the_same_variable_may_be_in_two_records_and_new_ones_may_be_empty() -> None:
    channels = [{"variable": "P.a"}, {}, {}, {"formula": "a", "name": "double"}]
    data = TraceData.model_validate({"records": [{"name": n, "channels": channels} for n in ("A", "B")]})
    assert [record["variables"] for record in data.recorded()["records"]] == [["P.a"], ["P.a"]]


def test_only_what_is_recorded_needs_a_download() -> None:
    """trace EX-07."""
    plain = _record(channels=[{"variable": "P.a"}])
    before = TraceData(records=(plain,)).digest()
    coloured = _record(
        comment="x",
        trace_pou=True,
        appearance={"font_size": 20},
        channels=[{"variable": "P.a", "color": "#00ff00", "graph": "step"}],
    )
    assert TraceData(records=(coloured,), refresh_rate=100, stacked=True).digest() == before
    formula = _record(channels=[{"variable": "P.a"}, {"formula": "a * 2", "name": "b"}])
    assert TraceData(records=(formula,)).digest() == before
    for other in (
        _record(channels=[{"variable": "P.a"}, {"variable": "P.b"}]),
        _record(channels=[{"variable": "P.a"}], buffer=200),
        _record(channels=[{"variable": "P.a"}], condition="P.x"),
        plain.model_copy(update={"trigger": TraceTrigger(variable="P.x", edge="positive")}),
    ):
        assert TraceData(records=(other,)).digest() != before


def test_names_of_tasks_programs_and_axes_follow() -> None:
    project = motion_project("P")
    (application,) = project.applications()
    project, trace = add_object(project, application.id, TRACE.name, "Trace")
    record = _record(
        task="MainTask",
        condition="NOT PLC_PRG.xBack",
        trigger={"variable": "plc_prg.fbBack.Done", "edge": "positive", "level": "GVL.PLC_PRG"},
        channels=[{"variable": "PLC_PRG.a[PLC_PRG.i]"}, {"variable": "Drive.fActPosition - Other.Drive"}],
    )
    project = change_data(project, trace.id, TraceData(records=(record,)).model_dump())
    (task,) = project.find_kind(TASK.name)
    for kind, name, new in (("pou", "PLC_PRG", "Main"), ("axis", "Drive", "X"), ("task", task.name, "Fast")):
        (item,) = (one for one in project.find_kind(kind) if one.name == name)
        project = rename_object(project, item.id, new)
    found = project.get(trace.id).data_as(TraceData).records[0]
    assert found.task == ("Fast" if task.name == "MainTask" else "MainTask")
    assert found.condition == "NOT Main.xBack"
    assert (found.trigger.variable, found.trigger.level) == ("Main.fbBack.Done", "GVL.PLC_PRG")
    assert [c.variable for c in found.channels] == ["Main.a[Main.i]", "X.fActPosition - Other.Drive"]


def test_the_device_trace_of_an_axis() -> None:
    """Each variable of it exists in an axis of a project."""
    built = build(motion_project("P"))
    assert built.package is not None
    channels = axis_channels("Drive")
    for channel in channels:
        assert compile_expression(channel.variable, built.package.symbols).type_name == "LREAL"
    assert len({channel.shown_name for channel in channels}) == len(channels)

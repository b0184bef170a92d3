"""Task groups, and watchdogs in percent of the interval (TASK-30)."""

from __future__ import annotations

from typing import Any

import pytest
from pydantic import ValidationError
from tests.project import axis_projects
from tests.project.axis_projects import only

from tappet.project import edit
from tappet.project.kinds.task import TaskData
from tappet.project.kinds.task_configuration import TaskConfigurationData
from tappet.project.model import Project
from tappet.project.new_project import new_project


def with_group(group: str, **task: Any) -> Project:
    project = new_project("machine")
    configuration = only(project, "task_configuration")
    groups = [{"name": "Motion", "processors": [1, 3], "policy": "round_robin"}]
    project = edit.change_data(project, configuration.id, {"groups": groups})
    calls = [{"name": "PLC_PRG"}]
    return edit.change_data(project, only(project, "task").id, {"group": group, "pous": calls, **task})


def test_a_task_has_processors_and_policy_of_its_group() -> None:
    package = axis_projects.build(with_group("motion")).package
    assert package is not None
    assert [(t.name, t.processors, t.policy) for t in package.tasks] == [("MainTask", (1, 3), "round_robin")]
    package = axis_projects.build(with_group("")).package
    assert package is not None
    assert [(t.processors, t.policy) for t in package.tasks] == [((), "fifo")]


def test_an_unknown_group_is_told_at_the_task() -> None:
    project = with_group("Moton")
    (error,) = axis_projects.errors(project)
    assert error == "Task MainTask: there is no task group Moton; choose another one"


def test_names_of_groups_are_unique() -> None:
    with pytest.raises(ValidationError, match="two task groups named Motion"):
        TaskConfigurationData.model_validate({"groups": [{"name": "Motion"}, {"name": "MOTION"}]})


@pytest.mark.parametrize(
    ("interval", "percent", "time_ns"),
    [
        ("T#20ms", 100, 20_000_000),
        ("T#20ms", 250, 50_000_000),
        ("300", 50, 150_000),
        ("T#20ms", None, 7_000_000),
    ],
)
def test_a_watchdog_may_be_given_in_percent_of_the_interval(
    interval: str, percent: int | None, time_ns: int
) -> None:
    watchdog = {"enabled": True, "time": "T#7ms", "percent": percent, "sensitivity": 2}
    package = axis_projects.build(with_group("", interval=interval, watchdog=watchdog)).package
    assert package is not None
    assert package.tasks[0].watchdog is not None
    assert package.tasks[0].watchdog.time_ns == time_ns


def test_percent_says_nothing_where_there_is_no_interval() -> None:
    watchdog = {"enabled": True, "time": "T#7ms", "percent": 50}
    package = axis_projects.build(with_group("", type="freewheeling", watchdog=watchdog)).package
    assert package is not None
    assert package.tasks[0].watchdog is not None
    assert package.tasks[0].watchdog.time_ns == 7_000_000


def test_percent_is_a_positive_number() -> None:
    with pytest.raises(ValidationError):
        TaskData.model_validate({"watchdog": {"percent": 0}})

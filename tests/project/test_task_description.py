"""All parameters of tasks come from the description of the device (TASK-07): what it permits is stored,
compiled, packed and loaded; what it does not is refused by each of them.

The limits stand here as tasks.md has them (TASK-11 to TASK-16, TASK-30), and as decided where it is silent.
"""

from __future__ import annotations

from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st
from msgspec.structs import replace
from pydantic import ValidationError

from tappet.codegen.build import BuildOptions, BuildResult, build_application
from tappet.codegen.package import CodePackage, PackageError
from tappet.iec.task import Task
from tappet.lang.source import Source
from tappet.project.kinds.task import TaskData
from tappet.project.kinds.task_configuration import TaskConfigurationData
from tappet.runtime.errors import PlcError
from tappet.runtime.plc import SoftPlc

PROGRAM = "PROGRAM PLC_PRG\nVAR\n    xGo : BOOL;\nEND_VAR\nxGo := NOT xGo;\nEND_PROGRAM"
KINDS = ("cyclic", "freewheeling", "event", "status", "external")
EXTERNAL = ("StartDone", "OnlineChangeDone", "SIGUSR1", "SIGUSR2")
MOST = 64


def built(*tasks: Task) -> BuildResult:
    return build_application([Source("PLC_PRG", PROGRAM)], list(tasks), BuildOptions(application="App"))


def task(name: str = "Main", **settings: Any) -> Task:
    return Task(name, **({"programs": ("PLC_PRG",)} | settings))


def errors(*tasks: Task) -> list[str]:
    return [d.code for d in built(*tasks).diagnostics if d.severity == "error"]


def package(*tasks: Task) -> CodePackage:
    made = built(*tasks).package
    assert made is not None
    return made


def is_stored(data: dict[str, Any]) -> bool:
    try:
        TaskData.model_validate(data)
    except ValidationError:
        return False
    return True


@given(st.integers(-40, 80))
def test_priorities_that_are_stored(priority: int) -> None:
    assert is_stored({"priority": priority}) == (0 <= priority <= 31)


@pytest.mark.parametrize("priority", [-1, 0, 31, 32])
def test_priorities_that_are_compiled_and_packed(priority: int) -> None:
    permitted = 0 <= priority <= 31
    assert errors(task(priority=priority)) == ([] if permitted else ["E0702"])
    made = package(task())
    made.tasks[0] = replace(made.tasks[0], priority=priority)
    if permitted:
        assert CodePackage.from_bytes(made.to_bytes()).tasks[0].priority == priority
    else:
        with pytest.raises(PackageError, match="priority"):
            CodePackage.from_bytes(made.to_bytes())


@pytest.mark.parametrize("kind", KINDS)
def test_every_kind_is_stored_and_compiled(kind: str) -> None:
    event = {"event": "PLC_PRG.xGo", "status": "PLC_PRG.xGo", "external": "sigusr1"}.get(kind, "")
    assert is_stored({"type": kind, "event": event})
    tasks = [task("Other"), task(kind=kind, event=event or None)]
    assert [made.kind for made in package(*tasks).tasks] == ["cyclic", kind]


def test_another_kind_is_refused() -> None:
    assert not is_stored({"type": "interrupt"})
    assert errors(task(kind="interrupt")) == ["E0708"]


@pytest.mark.parametrize("event", [*EXTERNAL, "startdone", "SIGTERM", "Exception", "PLC_PRG.xGo"])
def test_external_events(event: str) -> None:
    """Those of the device; the others of its system events start no task."""
    permitted = event.upper() in [known.upper() for known in EXTERNAL]
    found = [
        d for d in built(task("Other"), task(kind="external", event=event)).diagnostics if d.code == "E0711"
    ]
    assert bool(found) != permitted
    assert all(name in found[0].message + found[0].advice for name in EXTERNAL) if found else permitted


@pytest.mark.parametrize(
    ("watchdog", "stored"),
    [
        ({"percent": 1}, True),
        ({"percent": 1_000_000}, True),
        ({"percent": 0}, False),
        ({"percent": 1_000_001}, False),
        ({"sensitivity": 0}, True),
        ({"sensitivity": 1_000_000}, True),
        ({"sensitivity": -1}, False),
        ({"sensitivity": 1_000_001}, False),
    ],
)
def test_watchdogs(watchdog: dict[str, int], stored: bool) -> None:
    assert is_stored({"watchdog": {"enabled": True, **watchdog}}) == stored


@pytest.mark.parametrize(("processor", "stored"), [(0, True), (1023, True), (1024, False), (-1, False)])
def test_processors_of_groups(processor: int, stored: bool) -> None:
    data = {"groups": [{"name": "Motion", "processors": [processor]}]}
    if stored:
        TaskConfigurationData.model_validate(data)
    else:
        with pytest.raises(ValidationError):
            TaskConfigurationData.model_validate(data)


def test_as_many_tasks_as_the_device_permits() -> None:
    """One more is refused by the compiler, and by a runtime that gets it from elsewhere."""
    names = [f"Task{number}" for number in range(MOST + 1)]
    assert errors(*(task(name) for name in names)) == ["E0712"]
    most = package(*(task(name) for name in names[:MOST]))
    plc = SoftPlc(None, virtual=True)
    try:
        plc.load(most)
        assert len(plc.tasks()) == MOST
        more = CodePackage.from_bytes(most.to_bytes())
        more.tasks.append(replace(more.tasks[0], name=names[MOST]))
        with pytest.raises(PlcError, match=f"{MOST + 1} tasks; at most {MOST}"):
            plc.load(more)
        assert len(plc.tasks()) == MOST, "the old application stays"
    finally:
        plc.close()

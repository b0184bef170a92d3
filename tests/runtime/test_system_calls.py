"""What programs get of the system: lines in the log, facts of their task, the clock."""

from __future__ import annotations

import time
from datetime import UTC, datetime
from pathlib import Path

from library_programs import MS, TC2_SYSTEM, compiled

from tappet.codegen.build import BuildOptions
from tappet.iec.task import Task
from tappet.runtime.local import LocalRuntime

UNIX_SINCE_1601_S = int((datetime(1970, 1, 1, tzinfo=UTC) - datetime(1601, 1, 1, tzinfo=UTC)).total_seconds())
UNIX_OF_2000_NS = int(datetime(2000, 1, 1, tzinfo=UTC).timestamp()) * 1_000_000_000

LOG = """PROGRAM PLC_PRG
VAR
    n : INT; result, task, order : DINT; index : GETCURTASKINDEX; version : ST_LibVersion;
END_VAR
index();
task := GETCURTASKINDEXEX();
version.iMajor := 3; version.iMinor := 1;
order := F_CmpLibVersion(version, 3, 0, 9, 9);
IF n = 0 THEN
    result := ADSLOGSTR(ADSLOG_MSGTYPE_ERROR OR ADSLOG_MSGTYPE_LOG, 'axis %s stopped', 'X1');
    ADSLOGDINT(ADSLOG_MSGTYPE_WARN, 'count %d', -5);
    ADSLOGLREAL(ADSLOG_MSGTYPE_HINT, '%f mm', 2.5);
    ADSLOGSTR(ADSLOG_MSGTYPE_HINT, '100 % sure %n', 'unused');
END_IF
n := n + 1;
END_PROGRAM
"""


def test_messages_of_programs_come_into_the_log() -> None:
    with LocalRuntime(compiled(LOG, TC2_SYSTEM)) as runtime:
        runtime.run(cycles=3)
        lines = [(e.severity, e.message) for e in runtime.plc.log.since() if e.component == "program"]
        assert [runtime.read(f"PLC_PRG.{v}") for v in ("index.index", "task", "order", "result")] == [
            1,
            1,
            1,
            0,
        ]
    assert lines == [
        ("error", "axis X1 stopped"),
        ("warning", "count -5"),
        ("info", "2.5 mm"),
        ("info", "100 % sure %n"),
    ]


def test_messages_that_come_too_fast_are_counted() -> None:
    text = LOG.replace("IF n = 0 THEN", "WHILE n < 300 DO n := n + 1;").replace("END_IF", "END_WHILE")
    with LocalRuntime(compiled(text, TC2_SYSTEM)) as runtime:
        runtime.run(cycles=1)
        lines = [e.message for e in runtime.plc.log.since() if e.component == "program"]
    assert len(lines) == 257
    assert lines[-1] == "944 messages came faster than the log takes them"


TASK_FACTS = """PROGRAM PLC_PRG
VAR n : INT; first : BOOL; info : PlcTaskSystemInfo; END_VAR
n := n + 1;
info := F_GetTaskInfo();
IF n = 1 THEN first := info.FirstCycle; END_IF
END_PROGRAM
"""


def test_a_program_asks_for_its_task() -> None:
    with LocalRuntime(compiled(TASK_FACTS, TC2_SYSTEM)) as runtime:
        runtime.run(cycles=5)
        wanted = {"first": True, "info.FirstCycle": False, "info.CycleTime": 100_000, "info.CycleCount": 4}
        assert {name: runtime.read(f"PLC_PRG.{name}") for name in wanted} == wanted


CLOCK = """PROGRAM PLC_PRG
VAR fb : GETSYSTEMTIME; steps : ULINT; END_VAR
fb();
steps := SHL(UDINT_TO_ULINT(fb.timeHiDW), 32) OR UDINT_TO_ULINT(fb.timeLoDW);
END_PROGRAM
"""


def test_the_system_time_counts_from_1601(tmp_path: Path) -> None:
    with LocalRuntime(compiled(CLOCK, TC2_SYSTEM), virtual=False) as runtime:
        before = time.time_ns()
        runtime.run(cycles=3)
        steps = runtime.read("PLC_PRG.steps")
        after = time.time_ns()
    assert isinstance(steps, int)
    unix_ns = steps * 100 - UNIX_SINCE_1601_S * 1_000_000_000
    assert before - 20 * MS <= unix_ns <= after


SYSTEM_INFO = """FUNCTION_BLOCK Early
VAR task : DINT; name : STRING(63); tasks : UDINT; interval : UDINT; END_VAR
METHOD FB_Init : BOOL
VAR_INPUT bInitRetains : BOOL; bInCopyCode : BOOL; END_VAR
task := GETCURTASKINDEXEX();
name := _TaskInfo[2].TaskName;
tasks := _AppInfo.TaskCnt;
interval := TwinCAT_SystemInfoVarList._TaskInfo[1].CycleTime;
END_METHOD
END_FUNCTION_BLOCK
PROGRAM PLC_PRG
VAR
    n, firsts : INT; early : Early; info : PlcTaskSystemInfo; app : PlcAppSystemInfo; now, last, step : LINT;
    equal : BOOL;
END_VAR
VAR PERSISTENT kept : INT := 3; END_VAR
n := n + 1;
info := TwinCAT_SystemInfoVarList._TaskInfo[GETCURTASKINDEXEX()];
app := TwinCAT_SystemInfoVarList._AppInfo;
IF info.FirstCycle THEN firsts := firsts + 1; END_IF
last := now; now := info.DcTaskTime; step := now - last;
equal := info.CycleCount = F_GetTaskInfo().CycleCount;
END_PROGRAM
PROGRAM SLOW_PRG
VAR n : INT; info : PlcTaskSystemInfo; END_VAR
n := n + 1;
info := _TaskInfo[GETCURTASKINDEXEX()];
END_PROGRAM
"""
TASKS = (
    Task("Quick", interval_ns=10 * MS, priority=3, programs=("PLC_PRG",)),
    Task("Slow one", interval_ns=50 * MS, priority=7, programs=("SLOW_PRG",)),
)
NAMED = BuildOptions("Line", project="Bottling", compiled=1_700_000_000)


def test_the_lists_of_the_system_tell_of_all_tasks_and_the_application(tmp_path: Path) -> None:
    first = compiled(SYSTEM_INFO, TC2_SYSTEM, tasks=TASKS, options=NAMED)
    with LocalRuntime(first, folder=tmp_path) as runtime:
        runtime.run(cycles=11)
        wanted = {
            "PLC_PRG.early.task": 0, "PLC_PRG.early.name": "Slow one", "PLC_PRG.early.tasks": 2,
            "PLC_PRG.early.interval": 100_000, "PLC_PRG.firsts": 1, "PLC_PRG.equal": True,
            "PLC_PRG.info.CycleTime": 100_000, "PLC_PRG.info.Priority": 3, "PLC_PRG.info.TaskName": "Quick",
            "PLC_PRG.step": 10 * MS, "SLOW_PRG.info.CycleTime": 500_000, "SLOW_PRG.info.Priority": 7,
            "TwinCAT_SystemInfoVarList._TaskInfo[2].TaskName": "Slow one",
            "TwinCAT_SystemInfoVarList._TaskInfo[0].CycleTime": 0,
            "TwinCAT_SystemInfoVarList._TaskInfo[3].CycleTime": 0,
            "PLC_PRG.app.TaskCnt": 2, "PLC_PRG.app.OnlineChangeCnt": 0, "PLC_PRG.app.AppName": "Line",
            "PLC_PRG.app.ProjectName": "Bottling", "PLC_PRG.app.BootDataLoaded": False,
        }  # fmt: skip
        assert {name: runtime.read(name) for name in wanted} == wanted
        for program in ("PLC_PRG", "SLOW_PRG"):
            cycles = runtime.read(f"{program}.n")
            assert isinstance(cycles, int)
            assert runtime.read(f"{program}.info.CycleCount") == cycles - 1
        assert runtime.literal("PLC_PRG.app.AppTimestamp") == "DT#2023-11-14-22:13:20"
        assert runtime.read("PLC_PRG.now") == 100 * MS - UNIX_OF_2000_NS


def test_the_time_of_a_task_counts_from_2000() -> None:
    with LocalRuntime(compiled(SYSTEM_INFO, TC2_SYSTEM, tasks=TASKS), virtual=False) as runtime:
        before = time.time_ns()
        runtime.run(cycles=3)
        due = runtime.read("PLC_PRG.now")
        after = time.time_ns()
    assert isinstance(due, int)
    assert before - 20 * MS <= due + UNIX_OF_2000_NS <= after


def test_a_reset_and_an_online_change_are_told(tmp_path: Path) -> None:
    first = compiled(SYSTEM_INFO, TC2_SYSTEM, tasks=TASKS, options=NAMED)
    with LocalRuntime(first, folder=tmp_path) as runtime:
        runtime.run(cycles=3)
        for n, text in enumerate(("n := n + 2;", "n := n + 3;"), start=1):
            changed = SYSTEM_INFO.replace("n := n + 1;", text, 1)
            later = compiled(changed, TC2_SYSTEM, previous=first, tasks=TASKS, options=NAMED)
            runtime.plc.download(later.to_bytes(), "online_change")
            first = later
            runtime.run(cycles=2)
            assert runtime.read("PLC_PRG.app.OnlineChangeCnt") == n
        assert runtime.read("PLC_PRG.firsts") == 1
        assert runtime.literal("PLC_PRG.app.PersistentStatus").endswith("PS_None")
        runtime.reset("warm")
        runtime.start()
        runtime.run(cycles=2)
        assert runtime.read("PLC_PRG.info.CycleCount") == 1
        assert runtime.read("PLC_PRG.firsts") == 1
        assert runtime.literal("PLC_PRG.app.PersistentStatus").endswith("PS_All")
        assert runtime.read("PLC_PRG.app.BootDataLoaded") is True


def test_statistics_set_back_make_no_first_cycle() -> None:
    with LocalRuntime(compiled(SYSTEM_INFO, TC2_SYSTEM, tasks=TASKS)) as runtime:
        runtime.run(cycles=3)
        runtime.plc.reset_statistics(None)
        runtime.run(cycles=3)
        assert runtime.read("PLC_PRG.firsts") == 1

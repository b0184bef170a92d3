"""What programs get of the system: lines in the log, facts of their task, the clock."""

from __future__ import annotations

import time
from datetime import UTC, datetime
from pathlib import Path

from library_programs import MS, TC2_SYSTEM, compiled

from tappet.runtime.local import LocalRuntime

UNIX_SINCE_1601_S = int((datetime(1970, 1, 1, tzinfo=UTC) - datetime(1601, 1, 1, tzinfo=UTC)).total_seconds())

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

"""SysMem and SysTime: memory, heap and clock of the runtime as programs of CODESYS use them."""

from __future__ import annotations

import datetime

import pytest

from tappet.codegen.build import BuildOptions, BuildSession, LibraryReference, build_application
from tappet.iec.task import Task
from tappet.lang.source import Source
from tappet.runtime.local import LocalRuntime

MS = 1_000_000
SESSION = BuildSession()


def runtime_of(text: str, *libraries: str) -> LocalRuntime:
    """The program on virtual time, a cycle each 10 ms."""
    result = build_application(
        [Source("PLC_PRG", text)],
        (Task("Main", interval_ns=10 * MS, programs=("PLC_PRG",)),),
        BuildOptions(libraries=tuple(LibraryReference(name) for name in libraries), level=1),
        session=SESSION,
    )
    assert [str(d) for d in result.diagnostics if d.severity == "error"] == []
    assert result.package is not None
    return LocalRuntime(result.package)


MEMORY = """PROGRAM PLC_PRG
VAR
    a : ARRAY [0..9] OF BYTE := [1, 2, 3, 4, 5, 6, 7, 8, 9, 10];
    b, c, d : ARRAY [0..9] OF BYTE;
    order : ARRAY [0..3] OF DINT;
    words : ARRAY [0..1] OF DWORD := [16#01020304, 16#A0B0C0D0];
    p : POINTER TO ARRAY [0..999] OF BYTE; result : RTS_IEC_RESULT; sum : DINT; i : INT; n : INT;
    ok : BOOL := TRUE;
END_VAR
n := n + 1;
IF n = 1 THEN
SysMemCpy(ADR(b), ADR(a), SIZEOF(a));
SysMemSet(ADR(c), 16#1FF, 9);
d := a;
SysMemMove(ADR(d[3]), ADR(d[0]), 7);
order[0] := SysMemCmp(ADR(a), ADR(b), 10);
order[1] := SysMemCmp(ADR(a), ADR(c), 10);
order[2] := SysMemCmp(ADR(c), ADR(a), 10);
order[3] := SysMemCmp(ADR(c), ADR(a), 0);
SysMemForceSwap(ADR(words), 4, 2);
END_IF
p := SysMemAllocData('PLC_PRG', 1000, ADR(result));
FOR i := 0 TO 999 DO ok := ok AND p^[i] = 0; p^[i] := 255; END_FOR
ok := ok AND SysMemFreeData('PLC_PRG', p) = 0;
END_PROGRAM
"""


def test_memory() -> None:
    with runtime_of(
        MEMORY, "SysMem, * (System)", "SysTimeRtc, * (System)", "SysTimeCore, * (System)"
    ) as runtime:
        runtime.run(cycles=200)
        assert runtime.literal("PLC_PRG.b") == "[1, 2, 3, 4, 5, 6, 7, 8, 9, 10]"
        assert runtime.literal("PLC_PRG.c") == "[255, 255, 255, 255, 255, 255, 255, 255, 255, 0]"
        assert runtime.literal("PLC_PRG.d") == "[1, 2, 3, 1, 2, 3, 4, 5, 6, 7]"
        assert runtime.literal("PLC_PRG.order") == "[0, -1, 1, 0]"
        assert [runtime.read(f"PLC_PRG.words[{i}]") for i in (0, 1)] == [0x04030201, 0xD0C0B0A0]
        assert [runtime.read(f"PLC_PRG.{v}") for v in ("ok", "result")] == [True, 0]


CLOCK = """PROGRAM PLC_PRG
VAR ms : UDINT; us, ns, high : SYSTIME; result : RTS_IEC_RESULT; utc : UDINT; END_VAR
ms := SysTimeGetMs();
SysTimeGetUs(us);
SysTimeGetNs(ns);
utc := SysTimeRtcGet(result);
SysTimeRtcHighResGet(high);
END_PROGRAM
"""


def test_the_clock_is_the_virtual_one() -> None:
    with runtime_of(CLOCK, "SysTimeCore, * (System)", "SysTimeRtc, * (System)") as runtime:
        runtime.run(cycles=1)
        first = runtime.read("PLC_PRG.high")
        runtime.run(cycles=250)
        assert [runtime.read(f"PLC_PRG.{v}") for v in ("ms", "us", "ns")] == [2500, 2_500_000, 2_500_000_000]
        assert isinstance(first, int)
        assert runtime.read("PLC_PRG.high") == first + 2500
        assert runtime.read("PLC_PRG.utc") == (first + 2500) // 1000


DATES = """PROGRAM PLC_PRG
VAR utc, back : UDINT; date : SYSTIMEDATE; wrong : RTS_IEC_RESULT; END_VAR
SysTimeRtcConvertUtcToDate(utc, date);
SysTimeRtcConvertDateToUtc(date, back);
date.wMonth := 13;
wrong := SysTimeRtcConvertDateToUtc(date, utc);
END_PROGRAM
"""


def test_dates_are_those_of_the_calendar() -> None:
    days = [0, 58, 59, 789, 11_015, 11_016, 11_017, 18_261, 19_782, 19_783, 47_540, 47_541, 49_709]
    with runtime_of(DATES, "SysTimeRtc, * (System)") as runtime:
        for seconds in [*(86_400 * day + 86_399 for day in days), 1, 1_700_000_000, 2**32 - 1]:
            runtime.write("PLC_PRG.utc", seconds)
            runtime.run(cycles=1)
            wanted = datetime.datetime.fromtimestamp(seconds, datetime.UTC)
            names = ("wYear", "wDay", "wHour", "wMinute", "wSecond", "wDayOfWeek", "wYday")
            assert [runtime.read(f"PLC_PRG.date.{name}") for name in names] == [
                wanted.year, wanted.day, wanted.hour, wanted.minute, wanted.second,
                wanted.isoweekday(), wanted.timetuple().tm_yday,
            ]  # fmt: skip
            assert runtime.read("PLC_PRG.back") == seconds
            assert runtime.read("PLC_PRG.wrong") == 2


@pytest.mark.parametrize(
    "name", ["SysMem23, * (System)", "SysTimeCore, * (System)", "Tc2_System, * (Beckhoff Automation GmbH)"]
)
def test_the_names_of_other_systems_find_them(name: str) -> None:
    with runtime_of("PROGRAM PLC_PRG\nEND_PROGRAM", name) as runtime:
        runtime.run(cycles=1)

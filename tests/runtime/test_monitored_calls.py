"""Properties with attribute 'monitoring' := 'call': Get runs in the task while somebody watches (LPRG-33)."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from plc_programs import build

from tappet.runtime.local import LocalRuntime

TEXT = """
FUNCTION_BLOCK FB
VAR_OUTPUT gets, n, zero : INT; END_VAR
{attribute 'monitoring' := 'call'}
PROPERTY Twice : INT
GET
gets := gets + 1; Twice := 2 * n;
END_GET
END_PROPERTY
{attribute 'monitoring' := 'call'}
PROPERTY Text : STRING
GET
Text := CONCAT('n', 'o');
END_GET
END_PROPERTY
{attribute 'monitoring' := 'call'}
PROPERTY Quotient : INT
GET
Quotient := n / zero;
END_GET
END_PROPERTY
n := n + 1;
END_FUNCTION_BLOCK
FUNCTION_BLOCK FB_Derived EXTENDS FB
VAR MORE END_VAR
{attribute 'monitoring' := 'call'}
PROPERTY Twice : INT
GET
gets := gets + 1; Twice := -2 * n;
END_GET
END_PROPERTY
SUPER^();
END_FUNCTION_BLOCK
PROGRAM PLC_PRG
VAR fb : FB; many : ARRAY[1..5] OF FB_Derived; runs : INT; END_VAR
{attribute 'monitoring' := 'call'}
PROPERTY Cycles : INT
GET
Cycles := 100 + runs;
END_GET
END_PROPERTY
runs := runs + 1; fb(); many[3]();
END_PROGRAM
"""
LISTS = {"Globals": "VAR_GLOBAL listed : FB; END_VAR"}


@pytest.fixture
def runtime() -> Iterator[LocalRuntime]:
    with LocalRuntime(build(TEXT.replace("MORE", ""), gvls=LISTS)) as local:
        yield local


def watched(runtime: LocalRuntime, *paths: str) -> list[object]:
    """What a trace samples in the next cycle."""
    trace = runtime.trace([f"PLC_PRG.{path}" for path in paths])
    runtime.run(cycles=1)
    trace.close()
    return list(trace.samples[-1].values.values())


def test_get_is_called_for_what_is_watched_only(runtime: LocalRuntime) -> None:
    """At the end of the cycle that is sampled; of a derived block its own, in arrays and programs as well."""
    runtime.run(cycles=3)
    assert [runtime.read(f"PLC_PRG.{path}") for path in ("fb.gets", "many[3].gets")] == [0, 0]
    assert watched(runtime, "fb.Twice", "fb.Text") == [8, "no"]
    runtime.run(cycles=3)
    assert [runtime.read(f"PLC_PRG.{path}") for path in ("fb.gets", "many[3].gets")] == [1, 0]
    assert watched(runtime, "many[3].Twice", "Cycles") == [-16, 108]


def test_lists_are_served_too(runtime: LocalRuntime) -> None:
    trace = runtime.trace(["Globals.listed.Text"])
    runtime.run(cycles=1)
    assert trace.samples[-1].values == {"Globals.listed.Text": "no"}


def test_a_fault_of_get_is_told_and_ends_nothing(runtime: LocalRuntime) -> None:
    runtime.trace(["PLC_PRG.fb.Quotient", "PLC_PRG.fb.Twice"])
    runtime.run(cycles=3)
    runtime.plc.poll()
    runtime.run(cycles=2)
    runtime.plc.poll()
    found = [entry.message for entry in runtime.plc.log.since() if entry.component == "monitoring"]
    assert found == [
        "monitoring 'PLC_PRG.fb.Quotient' ended in an exception of its Get, which is called no more"
    ]
    assert runtime.state == "run"
    assert runtime.read("PLC_PRG.fb.n") == runtime.read("PLC_PRG.fb.gets") == 5


def test_watching_goes_on_over_an_online_change(runtime: LocalRuntime) -> None:
    trace = runtime.trace(["PLC_PRG.many[3].Twice"])
    runtime.run(cycles=2)
    changed = build(TEXT.replace("MORE", "more : LREAL;"), gvls=LISTS, previous=runtime.package)
    runtime.plc.download(changed.to_bytes(), "online_change")
    runtime.plc.poll()
    runtime.run(cycles=2)
    assert trace.samples[-1].values == {"PLC_PRG.many[3].Twice": -8}
    assert runtime.read("PLC_PRG.many[3].gets") == 4


def test_reading_waits_for_the_task() -> None:
    """In real time; what has been read is kept up to date for a while."""
    with LocalRuntime(build(TEXT.replace("MORE", ""), gvls=LISTS), virtual=False) as runtime:
        runtime.start()
        assert runtime.read("PLC_PRG.Cycles") >= 100
        assert runtime.read("PLC_PRG.fb.Text") == "no"
        assert runtime.read("PLC_PRG.fb.gets") == 0

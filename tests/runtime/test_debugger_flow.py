"""Flow control: executed statements of one cycle with the values after them; listed by hand, and against the
plain model of random programs."""

from collections import Counter
from collections.abc import Iterator

import pytest
from debugger_model import Program
from debugger_programs import URI, add, build_both, halted, loaded, until, value
from test_debugger_steps import seeds

from tappet.runtime.errors import PlcError
from tappet.runtime.plc import SoftPlc

TEXT = """FUNCTION Half : DINT
VAR_INPUT
    a : DINT;
END_VAR
Half := a / 2;
IF Half > 1000000 THEN
    RETURN;
END_IF
Half := Half + 1;
END_FUNCTION
PROGRAM PLC_PRG
VAR
    i : DINT;
    h : DINT;
    k : INT;
    list : ARRAY [1..3] OF INT;
    warm : BOOL;
    ratio : LREAL;
END_VAR
i := i + 1;
h := Half(a := i) * 10;
FOR k := 1 TO 3 DO
    list[k] := list[k] + k;
END_FOR
IF i < 0 THEN
    h := -1;
END_IF
warm := i > 2;
ratio := h / 4.0;
END_PROGRAM
"""


@pytest.fixture
def plc() -> Iterator[SoftPlc]:
    plc = loaded(TEXT)
    yield plc
    plc.close()


def shown(plc: SoftPlc) -> dict[int, tuple[int, dict[str, str]]]:
    """Executed lines with count and values."""
    found = plc.debugger.flow(URI).statements
    return {s.line: (s.count, {v.name: v.literal for v in s.values}) for s in found}


def test_executed_lines_with_the_values_they_had(plc: SoftPlc) -> None:
    plc.debugger.set_flow([URI])
    plc.start()
    until(lambda: plc.debugger.flow(URI).cycle > 0 and 20 in shown(plc) and shown(plc)[20][1] != {})
    until(lambda: int(shown(plc)[20][1]["i"]) > 5)
    lines = shown(plc)
    i = int(lines[20][1]["i"])
    assert sorted(lines) == [5, 6, 9, 20, 21, 22, 23, 25, 28, 29], "26 and 7 are not executed"
    assert lines[5] == (1, {"Half": str(i // 2), "a": str(i)})
    assert lines[9] == (1, {"Half": str(i // 2 + 1)}), "the last statement of a function has values, too"
    h = (i // 2 + 1) * 10
    assert lines[21] == (1, {"h": str(h), "i": str(i)})
    assert lines[23] == (3, {"list[k]": str(3 * i), "k": "3"})
    assert lines[28] == (1, {"warm": "TRUE", "i": str(i)})
    assert lines[29][1]["ratio"] == str(h / 4.0)


def test_the_present_cycle_of_a_halted_task(plc: SoftPlc) -> None:
    plc.debugger.set_flow([URI])
    add(plc, 25)
    plc.start()
    halted(plc)
    lines = shown(plc)
    assert sorted(lines) == [5, 6, 9, 20, 21, 22, 23, 25]
    assert lines[20][1] == {"i": str(value(plc, "PLC_PRG.i"))}


def test_a_cycle_that_had_begun_before_is_no_complete_one(plc: SoftPlc) -> None:
    """Flow control set in the midst of a cycle knows nothing of the statements before."""
    add(plc, 25)
    plc.start()
    halted(plc)
    plc.debugger.set_flow([URI])
    flow = plc.debugger._flow
    assert flow is not None
    for complete in (False, True):
        plc.debugger.control("continue")
        cycle = halted(plc).halted[0].cycle
        assert flow.table["doneCycle"] == (cycle - 1 if complete else 0)


def test_it_ends(plc: SoftPlc) -> None:
    plc.debugger.set_flow([URI])
    plc.start()
    until(lambda: plc.debugger.flow(URI).cycle > 0)
    with pytest.raises(PlcError, match="not under flow control"):
        plc.debugger.flow("Other")
    plc.debugger.set_flow([])
    until(lambda: not plc.debugger.state().active)
    with pytest.raises(PlcError, match="not under flow control"):
        plc.debugger.flow(URI)


def test_it_goes_on_after_a_download(plc: SoftPlc) -> None:
    plc.debugger.set_flow([URI])
    package, variant = build_both(TEXT.replace("i + 1", "i + 2"))
    plc.load(package)
    plc.debugger.load(variant)
    plc.start()
    until(lambda: plc.debugger.flow(URI).cycle > 0 and 20 in shown(plc))


@pytest.mark.parametrize("seed", seeds(40, 5))
def test_random_programs(seed: int) -> None:
    program = Program(seed)
    loops = set(program.loop_lines())
    cycles = [program.cycle() for _ in range(60)]
    plc = loaded(program.text)
    try:
        plc.debugger.set_flow([URI])
        first = plc.loaded().contexts.tasks[0]["cycle"]
        plc.start()
        until(lambda: plc.debugger.flow(URI).cycle > first + 3)
        plc.stop()
        ran = plc.tasks()[0].iec_cycles
        snapshot = plc.debugger.flow(URI)
        found = {s.line: s.count for s in snapshot.statements if s.line not in loops}
        expected = [
            {n: c for n, c in Counter(line for line, _ in events).items() if n not in loops}
            for events in cycles[:ran]
        ]
        assert found in expected[-4:], program.text
    finally:
        plc.close()

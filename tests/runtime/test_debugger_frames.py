"""Frames of unusual activations: derived blocks, methods, recursion, VAR_IN_OUT, arrays, strings, __TRY."""

from collections.abc import Iterator

import pytest
from debugger_programs import add, halted, line, loaded, step, until, value

from tappet.runtime.plc import SoftPlc
from tappet.runtime.recorder import RecorderSpec

TEXT = """TYPE Mode : (Off, Slow, Fast); END_TYPE
TYPE Setting : STRUCT
    tDelay : TIME := T#1s500ms;
    eMode : Mode := Fast;
    dtLast : DT := DT#2024-02-29-12:30:00;
    awLimits : ARRAY [0..1] OF REAL := [0.5, 1E10];
    sName : STRING(10) := 'it$'s';
END_STRUCT END_TYPE
TYPE Point : STRUCT
    x : INT;
    y : INT;
END_STRUCT END_TYPE
FUNCTION_BLOCK FB_Base
VAR
    count : DINT;
END_VAR
METHOD Step : DINT
VAR_INPUT
    by : DINT;
    name : STRING(20);
    where : Point;
END_VAR
VAR_IN_OUT
    total : DINT;
END_VAR
VAR
    list : ARRAY [1..3] OF INT := [7, 8, 9];
END_VAR
count := count + by;
total := total + count;
Step := count;
END_METHOD
END_FUNCTION_BLOCK
FUNCTION_BLOCK FB_Derived EXTENDS FB_Base
VAR
    more : LREAL := 2.5;
END_VAR
Step(by := 2, name := 'inner', where := p, total := sum);
END_FUNCTION_BLOCK
VAR_GLOBAL
    sum : DINT;
    p : Point := (x := 3, y := 4);
END_VAR
FUNCTION_BLOCK FB_Faculty
METHOD Fact : LINT
VAR_INPUT
    n : LINT;
END_VAR
IF n <= 1 THEN
    Fact := 1;
ELSE
    Fact := n * THIS^.Fact(n - 1);
END_IF
END_METHOD
END_FUNCTION_BLOCK
FUNCTION Safe : DINT
VAR_INPUT
    divisor : DINT;
END_VAR
VAR
    before : DINT;
END_VAR
before := 5;
__TRY
    Safe := Half(10, divisor);
__CATCH
    Safe := -1;
__ENDTRY
before := 6;
END_FUNCTION
FUNCTION Half : DINT
VAR_INPUT
    a : DINT;
    b : DINT;
END_VAR
Half := a / b;
END_FUNCTION
PROGRAM PLC_PRG
VAR
    block : FB_Derived;
    faculty : FB_Faculty;
    f : LINT;
    s : DINT;
    setting : Setting;
    large : ARRAY [1..1000] OF DINT;
END_VAR
block();
f := faculty.Fact(5);
s := Safe(0);
END_PROGRAM
"""
LINES = {text: number for number, text in enumerate(TEXT.splitlines(), start=1)}


def at(text: str) -> int:
    """The line of a statement."""
    return next(number for line, number in LINES.items() if line.strip() == text)


@pytest.fixture
def plc() -> Iterator[SoftPlc]:
    plc = loaded(TEXT)
    yield plc
    plc.close()


def shown(plc: SoftPlc, frame: int, scope: str) -> dict[str, object]:
    found = plc.debugger.variables("Main", frame).variables
    return {v.name: v.value for v in found if v.scope == scope}


def test_a_method_of_a_base_that_a_derived_block_calls(plc: SoftPlc) -> None:
    add(plc, at("Step := count;"))
    plc.start()
    halted(plc)
    frames = plc.debugger.stack("Main").frames
    assert [(f.place.pou, f.instance) for f in frames] == [
        ("FB_Base.Step", "PLC_PRG.block"),
        ("FB_Derived", "PLC_PRG.block"),
        ("PLC_PRG", None),
    ]
    local = shown(plc, 0, "local")
    assert (local["by"], local["name"], local["where"]) == (2, "inner", {"x": 3, "y": 4})
    assert (local["total"], local["list"], local["Step"]) == (2, [7, 8, 9], 0)
    assert shown(plc, 0, "this")["count"] == 2
    assert shown(plc, 1, "this")["more"] == 2.5
    total = next(v for v in plc.debugger.variables("Main", 0).variables if v.name == "total")
    assert (total.path or "").upper().endswith("SUM")
    plc.debugger.write("Main", 0, "total", 70)
    assert shown(plc, 0, "local")["total"] == 70
    with pytest.raises(ValueError, match="number"):
        plc.debugger.write("Main", 0, "by", "no number")


def test_texts_are_iec_literals_down_to_the_parts(plc: SoftPlc) -> None:
    """By which a structure can be compared with how it was declared; long ones are cut off."""
    add(plc, at("block();"))
    plc.start()
    halted(plc)
    found = {v.name: v for v in plc.debugger.variables("Main", 0).variables}
    assert found["setting"].text == (
        "(tDelay := T#1s500ms, eMode := Fast, dtLast := DT#2024-02-29-12:30:00, "
        "awLimits := [0.5, 1.0E10], sName := 'it$'s')"
    )
    assert found["setting"].literal == ""
    assert found["f"].text == found["f"].literal == "0"
    assert found["large"].text == "[" + "0, " * 333 + "…"


def test_recursion(plc: SoftPlc) -> None:
    add(plc, at("Fact := 1;"))
    plc.start()
    halted(plc)
    frames = plc.debugger.stack("Main").frames
    assert [f.place.pou for f in frames] == ["FB_Faculty.Fact"] * 5 + ["PLC_PRG"]
    assert [shown(plc, n, "local")["n"] for n in range(5)] == [1, 2, 3, 4, 5]
    plc.debugger.remove(None)
    assert [step(plc, "step_out") for _ in range(2)] == [at("s := Safe(0);"), at("block();")]
    assert value(plc, "PLC_PRG.f") == 120


def test_a_fault_that_is_caught_cuts_the_stack(plc: SoftPlc) -> None:
    add(plc, at("Half := a / b;"))
    plc.start()
    halted(plc)
    assert len(plc.debugger.stack("Main").frames) == 3
    assert step(plc, "step_over") == at("Safe := -1;")
    assert [f.place.pou for f in plc.debugger.stack("Main").frames] == ["Safe", "PLC_PRG"]
    assert shown(plc, 0, "local") == {"divisor": 0, "Safe": 0, "before": 5}
    plc.debugger.remove(None)
    assert step(plc, "step_over") == at("before := 6;")
    assert step(plc, "step_over") == at("block();")
    assert value(plc, "PLC_PRG.s") == -1


ENDLESS = """FUNCTION_BLOCK FB_Down
METHOD Down : LINT
VAR_INPUT
    n : LINT;
END_VAR
VAR
    room : ARRAY [0..99] OF LINT;
END_VAR
room[n MOD 100] := n;
Down := THIS^.Down(n + 1) + room[(n + 1) MOD 100];
END_METHOD
END_FUNCTION_BLOCK
PROGRAM PLC_PRG
VAR
    go : BOOL := TRUE;
    n : LINT;
    down : FB_Down;
END_VAR
n := n + 1;
IF go THEN
    n := down.Down(1);
END_IF
END_PROGRAM
"""


def test_the_end_of_the_stack_is_an_exception_in_instrumented_code_too() -> None:
    plc = loaded(ENDLESS)
    try:
        plc.debugger.keep_active(True)
        for _ in range(2):
            plc.start()
            until(lambda: plc.state == "exception")
            report = plc.exception()
            assert report is not None
            assert (report.name, report.pou) == ("STACK_OVERFLOW", "FB_Down.Down")
            plc.reset("cold")
        add(plc, 19)
        plc.start()
        assert line(plc) == 19
        assert [f.place.pou for f in plc.debugger.stack("Main").frames] == ["PLC_PRG"]
    finally:
        plc.close()


def test_people_who_watch_see_present_values_of_a_halted_task(plc: SoftPlc) -> None:
    """Recorders with a pace go on while a task is halted; those of every cycle have whole cycles only."""
    place = plc.symbols().resolve("PLC_PRG.s")
    items = ((place.offset, place.size),)
    watched = plc.loaded().sampled.record(RecorderSpec(items, 0, min_interval_ns=1_000_000))
    traced = plc.loaded().sampled.record(RecorderSpec(items, 0))
    add(plc, at("f := faculty.Fact(5);"))
    plc.start()
    halted(plc)
    watched.take()
    traced.take()
    from tappet.runtime.forces import PlacedValue
    from tappet.runtime.places import Place

    plc.write([PlacedValue(Place(place.offset, place.size), (4711).to_bytes(4, "little"))])
    seen: list[int] = []

    def arrived() -> bool:
        seen.extend(int.from_bytes(frame.data[:4], "little") for frame in watched.take())
        return 4711 in seen

    until(arrived)
    assert traced.take() == []

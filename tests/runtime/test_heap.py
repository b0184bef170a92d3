"""Memory of __NEW: bounded, checked, the application's own; wrong use ends in an exception."""

from __future__ import annotations

import msgspec
import pytest
from plc_programs import MS, build

from tappet.codegen.faults import Fault
from tappet.codegen.package import CodePackage
from tappet.iec.task import Task
from tappet.runtime.local import ApplicationException, LocalRuntime

VARIABLES = "PROGRAM PLC_PRG\nVAR p, q : POINTER TO DINT; b : POINTER TO BYTE; v, n, caught : DINT; END_VAR\n"


def application(body: str, *, limit: int | None = None, poison: bool = False) -> CodePackage:
    package = build(f"{VARIABLES}{body}\nEND_PROGRAM")
    return with_heap(package, package.facts.heap_limit if limit is None else limit, poison)


def with_heap(package: CodePackage, limit: int, poison: bool = False) -> CodePackage:
    facts = msgspec.structs.replace(package.facts, heap_limit=limit, heap_poison=poison)
    return msgspec.structs.replace(package, facts=facts)


def used(runtime: LocalRuntime) -> tuple[int, int]:
    assert runtime.plc.application is not None
    return runtime.plc.application.heap.used


WRONG = {
    "of a variable": ("p := ADR(v);\n__DELETE(p);", Fault.INVALID_RELEASE, "not memory of __NEW", 4),
    "twice": ("p := __NEW(DINT); q := p; __DELETE(p);\n__DELETE(q);", Fault.INVALID_RELEASE, "already", 4),
    "of an element": ("p := __NEW(DINT, 10);\np := p + 4;\n__DELETE(p);", Fault.INVALID_RELEASE, "inside", 5),
    "of nothing made": ("p := 16#10;\n__DELETE(p);", Fault.INVALID_RELEASE, "not memory of __NEW", 4),
    "of a wild address": (
        "p := 16#FFFF_FFFF_FFFF_FFF0;\n__DELETE(p);",
        Fault.INVALID_RELEASE,
        "not memory of __NEW",
        4,
    ),
    "written behind": (
        "b := __NEW(BYTE, 5);\nb[5] := 1;\n__DELETE(b);",
        Fault.HEAP_DAMAGED,
        "behind its end",
        5,
    ),
    "written before": (
        "b := __NEW(BYTE, 5);\nb[-1] := 0;\n__DELETE(b);",
        Fault.HEAP_DAMAGED,
        "before its begin",
        5,
    ),
    "written behind and kept": (
        "n := n + 1;\nb := __NEW(BYTE, 8);\nb[8] := 1;",
        Fault.HEAP_DAMAGED,
        "behind",
        4,
    ),
}


@pytest.mark.parametrize("case", WRONG)
def test_a_wrong_release_names_its_place(case: str) -> None:
    body, code, says, line = WRONG[case]
    with LocalRuntime(application(body)) as runtime:
        with pytest.raises(ApplicationException) as caught:
            runtime.run(cycles=1)
        report = caught.value.report
        assert (report.code, report.pou, report.line) == (code, "PLC_PRG", line)
        assert says in report.message
        runtime.reset("cold")
        assert used(runtime) == (0, 0)


def test_damage_names_who_made_the_memory() -> None:
    with LocalRuntime(application(WRONG["written behind"][0])) as runtime:
        with pytest.raises(ApplicationException) as caught:
            runtime.run(cycles=1)
        assert caught.value.report.values["made by __NEW in"] == "PLC_PRG, line 3"


@pytest.mark.parametrize("size", range(1, 41))
def test_every_byte_behind_the_memory_is_guarded(size: int) -> None:
    """Whatever the size: the first byte behind is not the program's, whatever it is set to."""
    body = f"b := __NEW(BYTE, {size});\nb[{size}] := b[{size}] XOR 1;\n__DELETE(b);"
    with (
        LocalRuntime(application(body)) as runtime,
        pytest.raises(ApplicationException, match="behind its end"),
    ):
        runtime.run(cycles=1)


def test_an_exception_for_another_reason_tells_of_damage() -> None:
    body = "b := __NEW(BYTE, 5);\nb[6] := 1;\np := 0;\np^ := 1;"
    with LocalRuntime(application(body)) as runtime:
        with pytest.raises(ApplicationException) as caught:
            runtime.run(cycles=1)
        report = caught.value.report
        assert report.code == Fault.NULL_REFERENCE
        assert report.values["damaged memory"].endswith("5 bytes")
        assert report.values["made by __NEW in"] == "PLC_PRG, line 3"


def test_a_program_may_catch_a_wrong_release() -> None:
    body = """__TRY p := ADR(v); __DELETE(p); __CATCH caught := caught + 1; __ENDTRY
    q := __NEW(DINT); __DELETE(q);"""
    with LocalRuntime(application(body)) as runtime:
        runtime.run(cycles=3)
        assert runtime.read("PLC_PRG.caught") == 3
        assert used(runtime) == (0, 0)


def test_fb_exit_runs_for_no_wrong_address() -> None:
    block = """{attribute 'enable_dynamic_creation'}
    FUNCTION_BLOCK Part
    VAR_INPUT pCount : POINTER TO DINT; END_VAR
    METHOD FB_Exit : BOOL
    VAR_INPUT bInCopyCode : BOOL; END_VAR
    pCount^ := pCount^ + 1;
    END_METHOD
    END_FUNCTION_BLOCK
    """
    body = """VAR parts, other : POINTER TO Part; number : DINT; END_VAR
    parts := __NEW(Part, 3);
    FOR v := 0 TO 2 DO parts[v].pCount := ADR(n); END_FOR
    other := parts;
    __DELETE(parts);
    IF number = 0 THEN number := n; END_IF
    __TRY __DELETE(other); __CATCH caught := caught + 1; __ENDTRY"""
    text = block + VARIABLES + body + "\nEND_PROGRAM"
    with LocalRuntime(build(text)) as runtime:
        runtime.run(cycles=1)
        assert [runtime.read(f"PLC_PRG.{name}") for name in ("number", "n", "caught")] == [3, 3, 1]


def test_beyond_the_limit_new_gives_0() -> None:
    body = "b := __NEW(BYTE, 1000); IF b <> 0 THEN n := n + 1; ELSE v := v + 1; END_IF"
    with LocalRuntime(application(body, limit=64 << 10)) as runtime:
        runtime.run(cycles=100)
        assert 55 <= runtime.read("PLC_PRG.n") <= 64
        assert runtime.read("PLC_PRG.n") + runtime.read("PLC_PRG.v") == 100
        runtime.reset("cold")
        runtime.start()
        runtime.run(cycles=10)
        assert runtime.read("PLC_PRG.n") == 10


@pytest.mark.parametrize("length", ["-1", "16#7FFF_FFFF_FFFF_FFFF", "70_000_000"])
def test_impossible_lengths_give_0(length: str) -> None:
    body = f"VAR l : LINT := {length}; END_VAR\np := __NEW(DINT, l); n := SEL(p = 0, 1, 2);"
    with LocalRuntime(application(body)) as runtime:
        runtime.run(cycles=1)
        assert runtime.read("PLC_PRG.n") == 2


def test_no_memory_when_the_limit_is_0() -> None:
    with LocalRuntime(application("p := __NEW(DINT); n := SEL(p = 0, 1, 2);", limit=0)) as runtime:
        runtime.run(cycles=1)
        assert runtime.read("PLC_PRG.n") == 2


def test_pointers_fit_into_dword() -> None:
    body = "VAR d : DWORD; END_VAR\np := __NEW(DINT); p^ := 7; d := p; q := d; n := q^; __DELETE(q);"
    with LocalRuntime(application(body)) as runtime:
        runtime.run(cycles=1)
        assert runtime.read("PLC_PRG.n") == 7


def test_released_memory_is_filled_when_asked_for() -> None:
    body = "p := __NEW(DINT); p^ := 7; q := p; __DELETE(p); n := q^;"
    with LocalRuntime(application(body, poison=True)) as runtime:
        runtime.run(cycles=1)
        assert runtime.read("PLC_PRG.n") == -0x22222223


def test_an_index_beyond_the_arena_is_an_exception() -> None:
    body = "b := __NEW(BYTE, 60_000); b[100_000] := 1;"
    with LocalRuntime(application(body, limit=64 << 10)) as runtime:
        with pytest.raises(ApplicationException) as caught:
            runtime.run(cycles=1)
        assert caught.value.report.code == Fault.ACCESS_VIOLATION


SHUFFLE = """TYPE SLOT : STRUCT p : POINTER TO BYTE; size, value : UDINT; END_STRUCT END_TYPE
FUNCTION_BLOCK Shuffle
VAR_INPUT seed : UDINT; most : UDINT; END_VAR
VAR slots : ARRAY[0..99] OF SLOT; i, k, size : UDINT; wrong, made, refused : DINT; END_VAR
METHOD Draw : UDINT
VAR_INPUT limit : UDINT; END_VAR
seed := seed * 1664525 + 1013904223;
Draw := SHR(seed, 8) MOD limit;
END_METHOD
METHOD Empty
VAR i : DINT; END_VAR
FOR i := 0 TO 99 DO __DELETE(slots[i].p); END_FOR
END_METHOD
i := Draw(100);
IF slots[i].p = 0 THEN
    size := Draw(most) + 1;
    IF Draw(10) = 0 THEN size := size * 50; END_IF
    slots[i].p := __NEW(BYTE, size);
    slots[i].size := size;
    slots[i].value := Draw(255) + 1;
    IF slots[i].p = 0 THEN
        refused := refused + 1;
    ELSE
        made := made + 1;
        FOR k := 0 TO size - 1 DO
            IF slots[i].p[k] <> 0 THEN wrong := wrong + 1; END_IF
            slots[i].p[k] := TO_BYTE(slots[i].value);
        END_FOR
    END_IF
ELSE
    FOR k := 0 TO slots[i].size - 1 DO
        IF slots[i].p[k] <> TO_BYTE(slots[i].value) THEN wrong := wrong + 1; END_IF
    END_FOR
    __DELETE(slots[i].p);
END_IF
END_FUNCTION_BLOCK
PROGRAM PLC_PRG
VAR shuffle : Shuffle := (seed := 4711, most := 200); i : DINT; stop : BOOL; END_VAR
IF stop THEN shuffle.Empty(); RETURN; END_IF
FOR i := 1 TO 200 DO shuffle(); END_FOR
END_PROGRAM
PROGRAM Second
VAR shuffle : Shuffle := (seed := 815, most := 3000); i : DINT; END_VAR
IF PLC_PRG.stop THEN shuffle.Empty(); RETURN; END_IF
FOR i := 1 TO 200 DO shuffle(); END_FOR
END_PROGRAM
"""
TASKS = (
    Task("Main", interval_ns=1 * MS, priority=1, programs=("PLC_PRG",)),
    Task("Other", interval_ns=1 * MS, priority=2, programs=("Second",)),
)


@pytest.mark.parametrize("limit", [256 << 10, 64 << 20])
def test_memory_of_many_sizes_is_never_shared(limit: int) -> None:
    """All of it is zero when it is made, holds what it was given, and comes back whole."""
    with LocalRuntime(with_heap(build(SHUFFLE, TASKS), limit)) as runtime:
        runtime.run(cycles=300)
        for program in ("PLC_PRG", "Second"):
            assert runtime.read(f"{program}.shuffle.wrong") == 0
            assert runtime.read(f"{program}.shuffle.made") > 1000
        refused = sum(runtime.read(f"{program}.shuffle.refused") for program in ("PLC_PRG", "Second"))
        assert (refused > 0) == (limit < 1 << 20)
        runtime.write("PLC_PRG.stop", True)
        runtime.run(cycles=2)
        assert used(runtime) == (0, 0)
        assert runtime.plc.application is not None
        heap = runtime.plc.application.heap
        assert heap.free_blocks() == 1, "what was given back has become one block again"


def test_tasks_share_the_arena() -> None:
    with LocalRuntime(build(SHUFFLE, TASKS), virtual=False) as runtime:
        runtime.run(time_ns=700 * MS)
        for program in ("PLC_PRG", "Second"):
            assert runtime.read(f"{program}.shuffle.wrong") == 0
            assert runtime.read(f"{program}.shuffle.made") > 100
        runtime.write("PLC_PRG.stop", True)
        runtime.run(time_ns=50 * MS)
        assert used(runtime) == (0, 0)


def test_an_online_change_keeps_what_was_made() -> None:
    first = application("IF p = 0 THEN p := __NEW(DINT); p^ := 41; END_IF n := p^;")
    text = (
        VARIABLES.replace("v, n", "more : LREAL; v, n")
        + "n := p^ + 1; __DELETE(p); p := __NEW(DINT);\nEND_PROGRAM"
    )
    changed = build(text, previous=first)
    with LocalRuntime(first) as runtime:
        runtime.run(cycles=2)
        runtime.plc.download(changed.to_bytes(), "online_change")
        runtime.run(cycles=1)
        assert runtime.read("PLC_PRG.n") == 42
        assert used(runtime)[0] == 1


def test_an_online_change_brings_the_first_new() -> None:
    first = application("n := n + 1;")
    with LocalRuntime(first) as runtime:
        runtime.run(cycles=1)
        assert runtime.plc.application is not None
        assert not runtime.plc.application.heap.opened
        text = VARIABLES + "IF p = 0 THEN p := __NEW(DINT); END_IF\nEND_PROGRAM"
        runtime.plc.download(build(text, previous=first).to_bytes(), "online_change")
        runtime.run(cycles=1)
        assert used(runtime)[0] == 1


def test_a_download_finds_a_heap_of_its_own() -> None:
    """Whatever the application before did to its memory."""
    with LocalRuntime(application("b := __NEW(BYTE, 40); b[41] := 1; b[-1] := 1;")) as runtime:
        with pytest.raises(ApplicationException):
            runtime.run(cycles=1)
        runtime.plc.download(application("b := __NEW(BYTE, 40); n := n + 1; __DELETE(b);").to_bytes())
        runtime.start()
        runtime.run(cycles=50)
        assert runtime.read("PLC_PRG.n") == 50

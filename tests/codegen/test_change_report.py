"""The report of an online change says of each variable what happens to it, and why."""

from __future__ import annotations

import math
import struct
from typing import Any

import pytest
from compiled_programs import build, change_over
from hypothesis import given
from hypothesis import strategies as st
from linked_application import loaded

from tappet.codegen.change_report import change_report
from tappet.codegen.converted_values import Conversion, Scalar, convert

PROGRAM = """
TYPE S : STRUCT a : INT; b : BOOL; {members} END_STRUCT END_TYPE
FUNCTION_BLOCK FB
VAR n : INT; {own} END_VAR
METHOD FB_Init : BOOL
VAR_INPUT bInitRetains : BOOL; bInCopyCode : BOOL; END_VAR
END_METHOD
METHOD FB_Exit : BOOL
VAR_INPUT bInCopyCode : BOOL; END_VAR
END_METHOD
END_FUNCTION_BLOCK
PROGRAM PLC_PRG
VAR {variables} END_VAR
END_PROGRAM
VAR_GLOBAL {globals} END_VAR
"""


def text(variables: str, members: str = "", own: str = "", globals: str = "g : INT;") -> str:
    return PROGRAM.format(variables=variables, members=members, own=own, globals=globals)


def rows(before: str, after: str) -> dict[str, tuple[str, str]]:
    old = build(before)
    report = change_report(old, build(after, old))
    assert report.omitted == 0
    return {row.path: (row.effect, row.reason) for row in report.rows}


@pytest.mark.parametrize(
    ("before", "after", "expected"),
    [
        ("x : INT;", "x : INT; y : INT;", {"y": ("initialised", "new"), "x": ("moved", "place")}),
        ("x : INT; y : INT;", "x : INT;", {"y": ("lost", "removed"), "x": ("moved", "place")}),
        ("x : INT;", "x : DINT;", {"x": ("converted", "type_changed")}),
        ("x : INT;", "x : STRING;", {"x": ("initialised", "type_changed")}),
        ("x : INT := 1;", "x : INT := 2;", {"x": ("kept", "initial_value")}),
        ("x : STRING(20);", "x : STRING(9);", {"x": ("converted", "string_shortened")}),
        ("x : STRING(9);", "x : STRING(20);", {"x": ("moved", "place")}),
        ("x : INT;", "x AT %MW4 : INT;", {"x": ("initialised", "address")}),
        (
            "x : ARRAY [1..3] OF INT;",
            "x : ARRAY [2..5] OF INT;",
            {"x": ("lost", "elements_removed"), "x[2..3]": ("moved", "place")},
        ),
        (
            "{attribute 'no_copy'} x : INT; y : INT;",
            "{attribute 'no_copy'} x : INT; y : INT; z : INT;",
            {
                "x": ("initialised", "no_copy"),
                "y": ("moved", "place"),
                "z": ("initialised", "new"),
            },
        ),
    ],
)
def test_variables_of_a_program(before: str, after: str, expected: dict[str, tuple[str, str]]) -> None:
    found = rows(text(before), text(after))
    assert found == {f"PLC_PRG.{name}": row for name, row in expected.items()}


def test_members_and_instances() -> None:
    variables = "f : FB; s : ARRAY [1..2] OF S;"
    old = build(text(variables))
    new = build(text(variables, members="c : INT;", own="m : INT := 3;"), old)
    found = {row.path: row for row in change_report(old, new).rows}
    assert found["PLC_PRG.f"].calls == ("FB_Exit", "FB_Init")
    assert (found["PLC_PRG.f.m"].effect, found["PLC_PRG.f.m"].reason) == ("initialised", "new")
    assert found["PLC_PRG.s[1..2].c"].effect == "initialised"
    assert found["PLC_PRG.s[1..2].a"].effect == "moved"


def test_an_instance_that_goes_is_left() -> None:
    old = build(text("f : FB; x : INT;"))
    found = {row.path: row for row in change_report(old, build(text("x : INT;"), old)).rows}
    assert (found["PLC_PRG.f"].effect, found["PLC_PRG.f"].calls) == ("lost", ("FB_Exit",))


def test_initial_values_inside_of_what_stays() -> None:
    found = rows(text("s : S := (a := 1);"), text("s : S := (a := 2);"))
    assert found == {"PLC_PRG.s.a": ("kept", "initial_value")}


def test_code_alone_changes_no_variable() -> None:
    old = build(text("x : INT;"))
    new = build(text("x : INT;").replace("END_PROGRAM", "x := 1;\nEND_PROGRAM"), old)
    assert new.code_id != old.code_id
    assert change_report(old, new).rows == ()


# -- conversion -------------------------------------------------------------------------------------

VALUES = {"SINT": -5, "UINT": 65_000, "DINT": 70_000, "LINT": -3, "BYTE": 200, "REAL": 2.5, "LREAL": 1e300}
RANGES = {
    "SINT": (-128, 127), "INT": (-32768, 32767), "DINT": (-(2**31), 2**31 - 1), "LINT": (-(2**63), 2**63 - 1),
    "BYTE": (0, 255), "UINT": (0, 65535), "LWORD": (0, 2**64 - 1),
}  # fmt: skip


@pytest.mark.parametrize("before", VALUES)
def test_a_number_keeps_its_value_where_it_fits(before: str) -> None:
    value = VALUES[before]
    targets = [*RANGES, "REAL", "LREAL"]
    given = "".join(f"v{t} : {before} := {value}; " for t in targets)
    wanted = "".join(f"v{t} : {t} := 1; " for t in targets)
    old = build(f"PROGRAM PLC_PRG\nVAR {given} END_VAR\nEND_PROGRAM")
    new = build(f"PROGRAM PLC_PRG\nVAR {wanted} END_VAR\nEND_PROGRAM", old)
    with loaded(old) as application:
        changed = change_over(application, new)
        found = {t: changed.read(f"PLC_PRG.v{t}") for t in targets}
        changed.close()
    expected: dict[str, Any] = {}
    for target in targets:
        if target in RANGES:
            low, high = RANGES[target]
            expected[target] = value if low <= value <= high and value == int(value) else 1
        else:
            expected[target] = 1 if target == "REAL" and abs(value) > 3.5e38 else value
    assert found == expected


@pytest.mark.parametrize(
    ("before", "after", "expected"),
    [
        ("TIME := T#1M5S", "LTIME", 65 * 10**9),
        ("LTIME := LTIME#65S", "TIME", 65_000),
        ("LTIME := LTIME#5NS", "TIME", 0),
        ("DATE := D#1970-01-03", "LDATE", 2 * 86_400 * 10**9),
        ("TOD := TOD#00:01:00", "LTOD", 60 * 10**9),
        ("BOOL := TRUE", "INT", 1),
        ("(r, g, b) := b", "DINT", 2),
        ("TIME := T#1S", "DINT", 0),
    ],
)
def test_other_values(before: str, after: str, expected: object) -> None:
    old = build(f"PROGRAM PLC_PRG\nVAR x : {before}; END_VAR\nEND_PROGRAM")
    new = build(f"PROGRAM PLC_PRG\nVAR x : {after}; END_VAR\nEND_PROGRAM", old)
    with loaded(old) as application:
        changed = change_over(application, new)
        assert changed.read("PLC_PRG.x") == expected
        changed.close()


def test_bits() -> None:
    source = (
        "TYPE S : STRUCT a : {a}; b : {b}; END_STRUCT END_TYPE\n"
        "PROGRAM PLC_PRG\nVAR s : S; END_VAR\ns.a := TRUE; s.b := TRUE;\nEND_PROGRAM"
    )
    old = build(source.format(a="BIT", b="BOOL"))
    new = build(source.format(a="BOOL", b="BIT"), old)
    with loaded(old) as application:
        application.cycle()
        changed = change_over(application, new)
        assert (changed.read("PLC_PRG.s.a"), changed.read("PLC_PRG.s.b")) == (True, True)
        changed.close()


def test_arrays_of_several_dimensions_keep_what_both_have() -> None:
    source = "PROGRAM PLC_PRG\nVAR a : ARRAY [{i}, {k}] OF INT := [{n}(7)]; END_VAR\n{body}\nEND_PROGRAM"
    fill = "a[1, 1] := 11; a[1, 2] := 12; a[2, 1] := 21; a[2, 2] := 22;"
    old = build(source.format(i="1..2", k="1..2", n=4, body=fill))
    new = build(source.format(i="0..2", k="2..4", n=9, body=""), old)
    with loaded(old) as application:
        application.cycle()
        changed = change_over(application, new)
        assert changed.read("PLC_PRG.a") == [7, 7, 7, 12, 7, 7, 22, 7, 7]
        changed.close()


@given(st.floats(allow_nan=True), st.sampled_from(["int", "uint"]), st.sampled_from([1, 2, 4, 8]))
def test_a_real_number_is_whole_or_stays_out(value: float, kind: Any, size: Any) -> None:
    after = bytearray(size)
    fits = convert(struct.pack("<d", value), after, Conversion(Scalar(0, "real", 8), Scalar(0, kind, size)))
    low, high = (
        (-(2 ** (8 * size - 1)), 2 ** (8 * size - 1) - 1) if kind == "int" else (0, 2 ** (8 * size) - 1)
    )
    expected = math.isfinite(value) and value.is_integer() and low <= int(value) <= high
    assert fits == expected
    if fits:
        assert int.from_bytes(after, "little", signed=kind == "int") == value


POINTED = """
TYPE S : STRUCT a : INT; END_STRUCT END_TYPE
INTERFACE I_Motor END_INTERFACE
FUNCTION_BLOCK Motor IMPLEMENTS I_Motor
VAR n : INT; END_VAR
END_FUNCTION_BLOCK
FUNCTION_BLOCK Fast EXTENDS Motor
VAR m : INT; END_VAR
END_FUNCTION_BLOCK
VAR_GLOBAL gS : S; END_VAR
PROGRAM Targets
VAR {targets} END_VAR
END_PROGRAM
PROGRAM Pointers
VAR
    pInt : POINTER TO INT; pReal : POINTER TO LREAL; pAny : POINTER TO BYTE; pS : POINTER TO S;
    rMotor : REFERENCE TO Motor; pFast : POINTER TO Fast; iMotor : I_Motor;
    row : ARRAY [1..3] OF POINTER TO INT; pp : POINTER TO POINTER TO INT;
END_VAR
END_PROGRAM
"""


@pytest.mark.parametrize(
    ("before", "after", "expected"),
    [
        # nothing moves: nothing is said
        ("x : INT;", "x : INT := 3;", {}),
        # an INT goes, an LREAL moves
        (
            "x : INT; y : LREAL;",
            "y : LREAL;",
            {"pInt": "cleared", "row[1..3]": "cleared", "pAny": "cleared", "pReal": "follows"},
        ),
        # all stay alive at other places
        ("x : INT;", "n : LREAL; x : INT;", {"pInt": "follows", "row[1..3]": "follows", "pAny": "follows"}),
        # an instance goes: it can be reached by its type, its base, an interface, and by what it holds
        (
            "f : Fast; y : LREAL;",
            "y : LREAL;",
            {
                "pInt": "cleared",
                "row[1..3]": "cleared",
                "pAny": "cleared",
                "rMotor": "cleared",
                "pFast": "cleared",
                "iMotor": "cleared",
                "pReal": "follows",
            },
        ),
        # an INT that becomes a DINT is another variable to a pointer
        ("x : INT;", "x : DINT;", {"pInt": "cleared", "row[1..3]": "cleared", "pAny": "cleared"}),
        # what moves are the elements of an array
        (
            "s : ARRAY [1..2] OF S;",
            "n : LREAL; s : ARRAY [1..9] OF S;",
            {"pS": "follows", "pInt": "follows", "row[1..3]": "follows", "pAny": "follows"},
        ),
    ],
)
def test_pointers_to_what_moves_or_goes(before: str, after: str, expected: dict[str, str]) -> None:
    old = build(POINTED.format(targets=before))
    new = build(POINTED.format(targets=after), old)
    reasons = {"cleared": "target_lost", "follows": "target_moved"}
    found = {row.path: row for row in change_report(old, new).rows if row.effect in reasons}
    assert {path: row.effect for path, row in found.items()} == {
        f"Pointers.{name}": effect for name, effect in expected.items()
    }
    assert all(row.reason == reasons[row.effect] for row in found.values())


def test_a_pointer_that_comes_with_the_change_is_no_concern() -> None:
    old = build(text("x : INT; y : INT;"))
    new = build(text("y : INT; p : POINTER TO INT;"), old)
    assert {row.path: row.effect for row in change_report(old, new).rows} == {
        "PLC_PRG.x": "lost",
        "PLC_PRG.y": "moved",
        "PLC_PRG.p": "initialised",
    }

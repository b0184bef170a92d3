"""Online changes: what stays in place, what moves, what starts again, and pointers that follow."""

from __future__ import annotations

import pytest
from compiled_programs import build, change_over
from hypothesis import given
from hypothesis import strategies as st
from linked_application import loaded

from tappet.codegen.online_code import Fresh
from tappet.codegen.package import OnlineChange

BASE = """
FUNCTION_BLOCK FB_Counter
VAR_INPUT step : INT := 1; END_VAR
VAR_OUTPUT value : INT; END_VAR
{more}
METHOD Get : INT
Get := value;
END_METHOD
{methods}
value := value + step;
END_FUNCTION_BLOCK
FUNCTION_BLOCK FB_Plain
VAR_OUTPUT n : INT; END_VAR
n := n + {add};
END_FUNCTION_BLOCK
PROGRAM Other
VAR_OUTPUT o : DINT := 4; END_VAR
o := o + 1;
END_PROGRAM
PROGRAM PLC_PRG
VAR
    {first}
    a : INT := 7; c : FB_Counter; row : ARRAY [1..{rows}] OF FB_Counter; p : FB_Plain;
    pa : POINTER TO INT := ADR(a); r : REFERENCE TO FB_Counter; s : STRING({length}) := 'text'; k : INT;
END_VAR
r REF= c;
a := a + 1; c(); p(); Other();
FOR k := 1 TO {rows} DO row[k](step := k); END_FOR
END_PROGRAM
"""


def text(**changes: object) -> str:
    values = {"more": "", "methods": "", "add": 1, "first": "", "rows": 3, "length": 10}
    return BASE.format(**(values | changes))


def test_code_only_keeps_the_layout():
    old = build(text())
    new = build(text(add=100), old)
    change = new.online_change
    assert change is not None
    assert (change.moves, change.initialise) == ((), ())
    assert new.data_id == old.data_id
    assert new.code_id != old.code_id
    assert "tappet.online_change" not in new.exports
    with loaded(old) as application:
        application.cycle()
        changed = change_over(application, new)
        changed.cycle()
        assert changed.read("PLC_PRG.p.n") == 101
        changed.close()


def test_new_variable_in_front_moves_the_others():
    old = build(text())
    new = build(text(first="added : LREAL := 2.5;"), old)
    change = new.online_change
    assert change is not None
    assert change.reasons == ("declaration of PLC_PRG changed",)
    assert new.data_objects["tappet.data.OTHER"] == old.data_objects["tappet.data.OTHER"]
    with loaded(old) as application:
        for _ in range(3):
            application.cycle()
        changed = change_over(application, new)
        assert changed.read("PLC_PRG.added") == 2.5
        assert changed.read("PLC_PRG.a") == 10
        assert changed.read("PLC_PRG.c.value") == 3
        assert changed.read("PLC_PRG.row[2].value") == 6
        assert changed.read("PLC_PRG.s") == "text"
        assert changed.read("Other.o") == 7
        a = changed.package.symbols.resolve("PLC_PRG.a")
        assert changed.read("PLC_PRG.pa") == changed.address + a.offset
        c = changed.package.symbols.resolve("PLC_PRG.c")
        assert changed.read("PLC_PRG.r") == changed.address + c.offset
        changed.cycle()
        assert changed.read("PLC_PRG.c.value") == 4
        changed.close()


def test_changed_block_keeps_values_and_is_reinitialised():
    old = build(text())
    method = "METHOD FB_Reinit : BOOL\nextra := extra + 1000;\nEND_METHOD"
    new = build(text(more="VAR extra : DINT := 5; twice : INT := 2 * step; END_VAR", methods=method), old)
    with loaded(old) as application:
        application.cycle()
        application.cycle()
        changed = change_over(application, new)
        assert changed.read("PLC_PRG.c.value") == 2
        assert changed.read("PLC_PRG.c.extra") == 1005
        assert changed.read("PLC_PRG.row[3].value") == 6
        assert changed.read("PLC_PRG.row[3].extra") == 1005
        assert changed.read("PLC_PRG.row[3].twice") == 6
        changed.close()


def test_arrays_grow_and_strings_shrink():
    old = build(text())
    new = build(text(rows=5, length=2), old)
    with loaded(old) as application:
        application.cycle()
        changed = change_over(application, new)
        values = [changed.read(f"PLC_PRG.row[{n}].value") for n in range(1, 6)]
        assert values == [1, 2, 3, 0, 0]
        assert changed.read("PLC_PRG.s") == "te"
        changed.cycle()
        assert changed.read("PLC_PRG.row[5].value") == 5
        changed.close()


def test_pointer_to_a_removed_variable_becomes_null():
    old = build("PROGRAM PLC_PRG VAR x : INT; y : INT; p : POINTER TO INT; END_VAR p := ADR(x); END_PROGRAM")
    new = build("PROGRAM PLC_PRG VAR y : INT; p : POINTER TO INT; END_VAR END_PROGRAM", old)
    with loaded(old) as application:
        application.cycle()
        assert application.read("PLC_PRG.p") != 0
        changed = change_over(application, new)
        assert changed.read("PLC_PRG.p") == 0
        changed.close()


def test_type_numbers_are_kept():
    old = build(text())
    new = build(text() + "FUNCTION_BLOCK FB_A METHOD M END_METHOD END_FUNCTION_BLOCK", old)
    assert {k: v for k, v in new.type_ids.items() if k in old.type_ids} == old.type_ids


ATTRIBUTED = """
FUNCTION_BLOCK FB_Marked
VAR_OUTPUT
    kept : INT := 1;
    {{attribute 'no_copy'}}
    anew : INT := 1;
    {{attribute 'init_on_onlchange'}}
    always : INT := 1;
END_VAR
VAR {more} END_VAR
kept := kept + {add}; anew := anew + {add}; always := always + {add};
END_FUNCTION_BLOCK
PROGRAM PLC_PRG
VAR one : FB_Marked; row : ARRAY[0..1] OF FB_Marked; END_VAR
one(); row[1]();
END_PROGRAM
"""


def test_attributes_decide_what_an_online_change_initialises():
    """LPRG-28, LPRG-35: no_copy counts where the instance moves, init_on_onlchange always."""
    for more, anew in (("", 3), ("x : LREAL;", 1)):
        old = build(ATTRIBUTED.format(more="", add=1))
        new = build(ATTRIBUTED.format(more=more, add=0), old)
        with loaded(old) as application:
            application.cycle()
            application.cycle()
            changed = change_over(application, new)
            changed.cycle()
            for path in ("one", "row[1]"):
                values = [changed.read(f"PLC_PRG.{path}.{name}") for name in ("kept", "anew", "always")]
                assert values == [3, anew, 1]
            changed.close()


@pytest.mark.parametrize("more", ["", "x : LREAL;"], ids=["code", "declarations"])
def test_an_online_change_initialises_one_bit_of_a_byte(more: str):
    """LPRG-28 of a BIT: the bits beside it stay."""
    program = """
TYPE ST_Bits : STRUCT
    before : BIT;
    {{attribute 'init_on_onlchange'}}
    marked : BIT := TRUE;
    after : BIT := TRUE;
END_STRUCT END_TYPE
VAR_GLOBAL bits : ST_Bits; END_VAR
PROGRAM PLC_PRG
VAR n : INT; {more} END_VAR
bits.before := TRUE; bits.marked := {marked}; bits.after := FALSE; n := n + 1;
END_PROGRAM
"""
    old = build(program.format(more="", marked="FALSE"))
    new = build(program.format(more=more, marked="NOT bits.before"), old)
    with loaded(old) as application:
        application.cycle()
        assert application.read("bits.marked") is False
        changed = change_over(application, new)
        values = [changed.read(f"bits.{name}") for name in ("before", "marked", "after")]
        assert values == [True, True, False]
        changed.close()


@given(ranges=st.lists(st.tuples(st.integers(0, 40), st.integers(1, 20)), max_size=6))
def test_a_byte_is_new_wherever_one_of_the_ranges_has_it(ranges: list[tuple[int, int]]) -> None:
    """A changed constant of an instance that is new as a whole has a range of its own inside another one."""
    fresh = Fresh(OnlineChange("", "", initialise=tuple(ranges)))
    new = {byte for start, size in ranges for byte in range(start, start + size)}
    assert [byte for byte in range(64) if fresh.covers(byte)] == sorted(new)

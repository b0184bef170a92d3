"""FB_Exit, FB_Init and FB_Reinit around an online change (LDEC-44, LDEC-103..LDEC-108, LPRG-36)."""

from __future__ import annotations

import pytest
from compiled_programs import build, change_over
from linked_application import loaded

from tappet.codegen.package import CodePackage

BASE = """
FUNCTION_BLOCK FB_Base
VAR kept : INT := 1; {base} END_VAR
METHOD FB_Init : BOOL
VAR_INPUT bInitRetains, bInCopyCode : BOOL; END_VAR
Log.Note('I', bInCopyCode, bInitRetains);
Log.found := kept;
kept := 50;
{init}
END_METHOD
METHOD FB_Exit : BOOL
VAR_INPUT bInCopyCode : BOOL; END_VAR
Log.Note('E', bInCopyCode, FALSE);
Log.left := kept;
END_METHOD
METHOD FB_Reinit : BOOL
Log.Note('R', FALSE, FALSE);
Log.again := kept;
END_METHOD
kept := kept + {add};
END_FUNCTION_BLOCK
FUNCTION_BLOCK FB_Derived EXTENDS FB_Base
METHOD FB_Init : BOOL
VAR_INPUT bInitRetains, bInCopyCode : BOOL; END_VAR
Log.Note('i', bInCopyCode, bInitRetains);
END_METHOD
METHOD FB_Exit : BOOL
VAR_INPUT bInCopyCode : BOOL; END_VAR
Log.Note('e', bInCopyCode, FALSE);
END_METHOD
METHOD FB_Reinit : BOOL
Log.Note('r', FALSE, FALSE);
END_METHOD
SUPER^();
END_FUNCTION_BLOCK
PROGRAM Log
VAR_INPUT text : STRING(200); found, left, again : INT; END_VAR
METHOD Note : BOOL
VAR_INPUT what : STRING(1); copied, retains : BOOL; END_VAR
VAR n : INT; END_VAR
WHILE text[n] <> 0 DO n := n + 1; END_WHILE
text[n] := what[0];
IF copied THEN n := n + 1; text[n] := 16#2B; END_IF
IF retains THEN n := n + 1; text[n] := 16#21; END_IF
text[n + 1] := 0;
END_METHOD
END_PROGRAM
PROGRAM PLC_PRG
VAR
    {first}
    {fbs}
    y : INT := 3;
    z : POINTER TO INT := ADR(y);
END_VAR
{calls}
END_PROGRAM
"""


def text(**changes: object) -> str:
    values = {"base": "", "init": "", "add": 1, "first": "", "fbs": "fb : FB_Base;", "calls": "fb();"}
    return BASE.format(**(values | changes))


def log(package: CodePackage, changed: CodePackage, cycles: int = 2) -> dict[str, object]:
    """What was called by the change alone, and values behind it."""
    with loaded(package) as application:
        for _ in range(cycles):
            application.cycle()
        application.write("Log.text", "''")
        after = change_over(application, changed)
        found = {name: after.read(f"Log.{name}") for name in ("text", "found", "left", "again")}
        found["kept"] = after.read("PLC_PRG.fb.kept")
        after.close()
    return found


def test_calls_around_a_moved_instance() -> None:
    """LDEC-106: Exit of the old one, Init of the new one, the values are copied, Reinit."""
    old = build(text())
    found = log(old, build(text(first="more : LREAL;"), old))
    assert found == {"text": "E+I+R", "found": 1, "left": 52, "again": 52, "kept": 52}


def test_new_members_have_what_init_gave_them() -> None:
    """LDEC-103, LDEC-106: the values of the old instance are copied over those of FB_Init, new ones stay."""
    old = build(text())
    new = build(text(base="fresh, plain : INT := 4;", init="fresh := 77;"), old)
    with loaded(old) as application:
        application.cycle()
        changed = change_over(application, new)
        values = [changed.read(f"PLC_PRG.fb.{name}") for name in ("kept", "fresh", "plain")]
        changed.close()
    assert values == [51, 77, 4]


def test_order_with_inheritance() -> None:
    """LDEC-107: Exit from the derived block to the base, Init and Reinit from the base."""
    old = build(text(fbs="fb : FB_Derived;"))
    found = log(old, build(text(fbs="fb : FB_Derived;", first="more : LREAL;"), old))
    assert found["text"] == "e+E+I+i+Rr"


def test_a_removed_instance_is_left() -> None:
    """LDEC-105: FB_Exit of a deleted instance, nothing else."""
    old = build(text(fbs="fb : FB_Base; other : FB_Base;"))
    found = log(old, build(text(), old))
    assert sorted(str(found["text"])) == sorted("E+E+I+R")


def test_a_new_instance_is_initialised() -> None:
    """LDEC-101, LDEC-110: what a change adds gets FB_Init only; nothing is copied to it, not even what is
    retained."""
    old = build(text(fbs="fb : INT;", calls=""))
    new = build(text(fbs="fb : INT; fresh : FB_Base;", calls="fresh();"), old)
    with loaded(old) as application:
        application.cycle()
        application.write("Log.text", "''")
        changed = change_over(application, new)
        assert changed.read("Log.text") == "I!"
        assert changed.read("PLC_PRG.fresh.kept") == 50
        changed.close()


@pytest.mark.parametrize("attribute", ["'symbol' := 'no-exit'", "'no-exit'"])
def test_instances_without_exit(attribute: str) -> None:
    """LPRG-36, language_pragmas EX-10: FB_Exit of POU1 only."""
    fbs = f"fb : FB_Base; {{attribute {attribute}}} POU2 : FB_Base;"
    old = build(text(fbs=fbs))
    found = log(old, build(text(fbs=fbs, first="more : LREAL;"), old))
    assert str(found["text"]).count("E+") == 1
    assert str(found["text"]).count("I+") == 2


def test_nothing_is_called_when_code_alone_has_changed() -> None:
    """LDEC-108."""
    old = build(text())
    assert log(old, build(text(add=10), old))["text"] == ""


def test_a_download_initialises() -> None:
    """LDEC-110."""
    with loaded(build(text())) as application:
        assert application.read("Log.text") == "I!"


def test_a_pointer_keeps_what_it_has() -> None:
    """LDEC-44: a pointer with ADR as initial value is not initialised again, it follows its target."""
    main = """PROGRAM PLC_PRG
    VAR {first} y : INT := 3; x : INT := 4; z : POINTER TO INT := ADR(y); END_VAR
    {code}
    END_PROGRAM"""
    old = build(main.format(first="", code="z := ADR(x);"))
    new = build(main.format(first="more : LREAL;", code="x := 9; y := z^;"), old)
    with loaded(old) as application:
        application.cycle()
        changed = change_over(application, new)
        changed.cycle()
        assert changed.read("PLC_PRG.y") == 9
        changed.close()


DYNAMIC = """
{{attribute 'enable_dynamic_creation'}}
FUNCTION_BLOCK FB_Dynamic
VAR n : INT; {more} END_VAR
n := n + {add};
END_FUNCTION_BLOCK
TYPE Rec : STRUCT a : INT; {member} END_STRUCT END_TYPE
PROGRAM PLC_PRG
VAR {first} p : POINTER TO FB_Dynamic; q : POINTER TO Rec; END_VAR
IF p = 0 THEN p := __NEW(FB_Dynamic); q := __NEW(Rec); END_IF
p^();
END_PROGRAM
"""


def dynamic(**changes: object) -> str:
    return DYNAMIC.format(**({"more": "", "add": 1, "member": "", "first": ""} | changes))


@pytest.mark.parametrize(
    ("changes", "name"),
    [({"more": "x : LREAL;"}, "FB_Dynamic"), ({"member": "b : LREAL;"}, "Rec")],
)
def test_what_new_has_made_keeps_its_form(changes: dict[str, str], name: str) -> None:
    """LOPR-101: no online change after a change of the declaration: nothing moves what lies on the heap."""
    old = build(dynamic())
    change = build(dynamic(**changes), old).online_change
    assert change is not None
    assert f"'{name}' is created with __NEW" in change.refused
    later = build(dynamic(**changes, add=5), old).online_change  # one more edit, of code alone
    assert later is not None
    assert later.refused == change.refused


@pytest.mark.parametrize("changes", [{"add": 5}, {"first": "x : LREAL;"}])
def test_what_new_has_made_lives_on(changes: dict[str, object]) -> None:
    old = build(dynamic())
    new = build(dynamic(**changes), old)
    assert new.online_change is not None
    assert new.online_change.refused == ""
    assert CodePackage.from_bytes(new.to_bytes()).online_change == new.online_change


ARRAYS = """
FUNCTION_BLOCK FB_Part
VAR_INPUT n : DINT; END_VAR
VAR {more} END_VAR
METHOD FB_Init : BOOL
VAR_INPUT bInitRetains, bInCopyCode : BOOL; END_VAR
IF bInCopyCode THEN Count.inits := Count.inits + 1; {init} END_IF
n := -1;
END_METHOD
METHOD FB_Reinit : BOOL
Count.reinits := Count.reinits + 1;
Count.sum := Count.sum + n;
END_METHOD
END_FUNCTION_BLOCK
TYPE Row : STRUCT a : INT; parts : ARRAY[1..5] OF FB_Part; END_STRUCT END_TYPE
PROGRAM Count
VAR_INPUT inits, reinits, sum : DINT; END_VAR
END_PROGRAM
PROGRAM PLC_PRG
VAR {first} i, j : DINT; many : ARRAY[1..{count}] OF FB_Part; rows : ARRAY[0..9] OF Row; END_VAR
FOR i := 1 TO {count} DO many[i].n := i; END_FOR
FOR i := 0 TO 9 DO
    FOR j := 1 TO 5 DO rows[i].parts[j].n := 1000 * i + j; END_FOR
END_FOR
END_PROGRAM
"""
EDITS = [{"first": "x : LREAL;"}, {"more": "fresh : INT; x : LREAL;", "init": "fresh := 7;"}]


def arrays(count: int, **changes: str) -> str:
    return ARRAYS.format(**({"more": "", "init": "", "first": "", "count": count} | changes))


@pytest.mark.parametrize("changes", EDITS)
def test_every_element_of_an_array(changes: dict[str, str]) -> None:
    """LDEC-104, LDEC-106: also where arrays lie in elements of arrays."""
    old = build(arrays(300))
    new = build(arrays(300, **changes), old)
    with loaded(old) as application:
        application.cycle()
        after = change_over(application, new)
        found = [after.read(f"Count.{name}") for name in ("inits", "reinits", "sum")]
        kept = [after.read(f"PLC_PRG.{path}") for path in ("many[1].n", "many[300].n", "rows[9].parts[5].n")]
        parts = ("many[300]", "rows[0].parts[1]") if "more" in changes else ()
        fresh = [after.read(f"PLC_PRG.{part}.fresh") for part in parts]
        after.close()
    assert found == [350, 350, sum(range(301)) + sum(1000 * i + j for i in range(10) for j in range(1, 6))]
    assert kept == [1, 300, 9005]
    assert fresh == [7] * len(parts)


@pytest.mark.parametrize("changes", EDITS)
def test_large_arrays_take_no_more_code(changes: dict[str, str]) -> None:
    few, many = (
        sum(map(len, build(arrays(count, **changes), build(arrays(count))).objects))
        for count in (300, 30_000)
    )
    assert many < 1.1 * few

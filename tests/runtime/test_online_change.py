"""Online change: values stay, code changes, forces and recorders find their variables again."""

from collections.abc import Callable, Sequence
from pathlib import Path

import pytest
from plc_programs import MS, build

from tappet.codegen.change_report import change_report
from tappet.iec.task import Task
from tappet.runtime.errors import OtherApplicationError, PlcError
from tappet.runtime.forces import PlacedValue
from tappet.runtime.local import LocalRuntime
from tappet.runtime.online_change import OnlineChangeError, check_change
from tappet.runtime.places import Place
from tappet.runtime.plc import SoftPlc

ONE = """
PROGRAM PLC_PRG
VAR n : DINT; other : DINT := 5; END_VAR
n := n + 1;
END_PROGRAM
"""
CODE_ONLY = ONE.replace("n := n + 1;", "n := n + 100;")
MORE_DATA = """
PROGRAM PLC_PRG
VAR fresh : LREAL := 2.5; arr : ARRAY [0..99] OF INT := [100(7)]; n : DINT; other : DINT := 5; END_VAR
n := n + 10;
END_PROGRAM
"""


def change(runtime: LocalRuntime, text: str) -> None:
    runtime.plc.download(build(text, previous=runtime.package).to_bytes(), "online_change")


def test_code_changes_while_values_stay() -> None:
    with LocalRuntime(build(ONE)) as runtime:
        runtime.run(cycles=3)
        change(runtime, CODE_ONLY)
        runtime.run(cycles=1)
        assert runtime.read("PLC_PRG.n") == 103
        assert "code exchanged while running" in runtime.plc.log.since()[-1].message


def test_data_moves_and_new_variables_are_initialised() -> None:
    """LDEC-47, LDEC-60: contents move, only what is new gets its initial value."""
    with LocalRuntime(build(ONE)) as runtime:
        runtime.run(cycles=3)
        runtime.write("PLC_PRG.other", 77)
        change(runtime, MORE_DATA)
        runtime.run(cycles=1)
        assert [runtime.read(f"PLC_PRG.{v}") for v in ("n", "other", "fresh", "arr[99]")] == [13, 77, 2.5, 7]


LIFE = """
FUNCTION_BLOCK FB
VAR n : INT; {more} END_VAR
METHOD FB_Init : BOOL
VAR_INPUT bInitRetains, bInCopyCode : BOOL; END_VAR
Calls.sum := Calls.sum * 10 + SEL(bInCopyCode, 1, 2);
END_METHOD
METHOD FB_Exit : BOOL
VAR_INPUT bInCopyCode : BOOL; END_VAR
Calls.sum := Calls.sum * 10 + SEL(bInCopyCode, 3, 4);
END_METHOD
METHOD FB_Reinit : BOOL
Calls.sum := Calls.sum * 10 + 5; Calls.kept := n;
END_METHOD
n := n + 1;
END_FUNCTION_BLOCK
PROGRAM Calls
VAR_INPUT sum : DINT; kept : INT; END_VAR
END_PROGRAM
PROGRAM PLC_PRG
VAR fb : FB; END_VAR
fb();
END_PROGRAM
"""


TARGETS = ("INT", "LREAL", "S", "Block")


@pytest.mark.parametrize("order", [TARGETS[n:] + TARGETS[:n] for n in range(4)])
@pytest.mark.parametrize("gone", ["INT", "LREAL", "S", "Block", None])
def test_pointers_become_what_the_report_says(order: tuple[str, ...], gone: str | None) -> None:
    """Whichever of its variables goes, wherever it lies: a pointer that is 0 afterwards was told before, and
    one that was told of nothing is as it was."""

    def text(types: Sequence[str], more: str = "") -> str:
        variables = "".join(f"v{type_} : {type_}; " for type_ in types)
        pointers = "".join(f"p{type_} : POINTER TO {type_}; " for type_ in order)
        takes = "".join(f"Pointers.p{type_} := ADR(v{type_}); " for type_ in types)
        takes = takes if len(types) == len(TARGETS) and not more else ""
        return f"""
TYPE S : STRUCT a : WORD; END_STRUCT END_TYPE
FUNCTION_BLOCK Block VAR n : DWORD; END_VAR END_FUNCTION_BLOCK
PROGRAM Pointers VAR_INPUT {pointers} END_VAR END_PROGRAM
PROGRAM PLC_PRG VAR {more} {variables} END_VAR {takes} END_PROGRAM
"""

    kept = [type_ for type_ in order if type_ != gone]
    with LocalRuntime(build(text(order))) as runtime:
        runtime.run(cycles=1)
        before = {type_: runtime.read(f"Pointers.p{type_}") for type_ in order}
        assert all(before.values())
        package = build(text(kept, "" if gone else "wide : LREAL;"), previous=runtime.package)
        told = {row.path: row.effect for row in change_report(runtime.package, package).rows}
        runtime.plc.download(package.to_bytes(), "online_change")
        runtime.run(cycles=1)
        for type_ in order:
            name = f"Pointers.p{type_}"
            pointer, effect = runtime.read(name), told.get(name)
            if pointer == 0:
                assert effect == "cleared", (type_, told)
            elif pointer != before[type_]:
                assert effect in ("follows", "cleared"), (type_, told)
            if type_ == gone:
                assert pointer == 0


def test_blocks_are_left_and_entered() -> None:
    """LDEC-106: FB_Exit of the old instance, FB_Init of the new one, its values, FB_Reinit."""
    with LocalRuntime(build(LIFE.format(more=""))) as runtime:
        runtime.run(cycles=3)
        assert runtime.read("Calls.sum") == 1
        change(runtime, LIFE.format(more="x : LREAL;"))
        runtime.run(cycles=1)
        assert [runtime.read(path) for path in ("Calls.sum", "Calls.kept", "PLC_PRG.fb.n")] == [1425, 3, 4]


PARTS = """
FUNCTION_BLOCK FB
VAR_OUTPUT got : INT; calls : INT; copied : BOOL; END_VAR
VAR {{attribute 'no_copy'}} part : Part(size := 5); END_VAR
METHOD FB_Init : BOOL
VAR_INPUT bInitRetains, bInCopyCode : BOOL; start : INT; END_VAR
got := start; calls := calls + 1; copied := bInCopyCode;
END_METHOD
END_FUNCTION_BLOCK
FUNCTION_BLOCK Part
VAR_OUTPUT size : INT; END_VAR
METHOD FB_Init : BOOL
VAR_INPUT bInitRetains, bInCopyCode : BOOL; size : INT; END_VAR
THIS^.size := size;
END_METHOD
END_FUNCTION_BLOCK
TYPE Rec : STRUCT n : INT; {member} END_STRUCT END_TYPE
FUNCTION_BLOCK Holder
VAR_OUTPUT n : INT; static : INT; END_VAR
VAR {inner} END_VAR
VAR_STAT {static} END_VAR
METHOD M
VAR_INST {kept} END_VAR
END_METHOD
n := n + 1; {read}
END_FUNCTION_BLOCK
PROGRAM PLC_PRG
VAR n : INT; old : FB(start := 1); h : Holder; rec : Rec; changed : {changed}; {fbs} END_VAR
n := n + 1; h();
END_PROGRAM
"""
ADDED = {
    "member": "fb : FB(start := 30);",
    "inner": "fb : FB(start := 40);",
    "static": "fb2 : FB(start := 50);",
    "kept": "fb : FB(start := 60);",
    "read": "static := fb2.got;",
    "changed": "FB(start := 70)",
    "fbs": "one : FB(start := 2); computed : FB(start := 2 * n + h.n); more : ARRAY[1..9] OF FB(start := 4);"
    "each : ARRAY[1..2] OF FB[(start := 5), (start := 6)];",
}


def test_added_instances_get_their_arguments() -> None:
    """LDEC-102, LDEC-103: wherever a change adds an instance, FB_Init has the values of its declaration, and
    runs once; the instances that were there keep what they have."""
    before = dict.fromkeys(ADDED, "") | {"changed": "INT"}
    with LocalRuntime(build(PARTS.format(**before))) as runtime:
        runtime.run(cycles=2)
        change(runtime, PARTS.format(**ADDED))
        runtime.run(cycles=1)
        added = {
            "one": 2, "computed": 6, "more[1]": 4, "more[9]": 4, "each[1]": 5, "each[2]": 6, "rec.fb": 30,
            "h.fb": 40, "h.M.fb": 60, "changed": 70,
        }  # fmt: skip
        for path, start in added.items():
            found = [
                runtime.read(f"PLC_PRG.{path}.{name}") for name in ("got", "calls", "copied", "part.size")
            ]
            assert found == [start, 1, False, 5], path
        assert runtime.read("PLC_PRG.h.static") == 50
        assert [runtime.read(f"PLC_PRG.{name}") for name in ("n", "h.n", "old.got", "old.calls")] == [
            3,
            3,
            1,
            1,
        ]


def test_objects_of_the_heap_keep_their_form() -> None:
    """LOPR-101: a block that __NEW has made cannot be moved; the running application goes on."""
    text = """
    {attribute 'enable_dynamic_creation'}
    FUNCTION_BLOCK FB
    VAR n : INT; MORE END_VAR
    n := n + 1;
    END_FUNCTION_BLOCK
    PROGRAM PLC_PRG
    VAR p : POINTER TO FB; n : INT; END_VAR
    IF p = 0 THEN p := __NEW(FB); END_IF
    p^(); n := n + 1;
    END_PROGRAM
    """
    with LocalRuntime(build(text.replace("MORE", ""))) as runtime:
        runtime.run(cycles=2)
        with pytest.raises(PlcError, match="'FB' is created with __NEW"):
            change(runtime, text.replace("MORE", "x : LREAL;"))
        runtime.run(cycles=1)
        assert runtime.read("PLC_PRG.n") == 3


def test_forces_and_traces_follow_their_variables() -> None:
    with LocalRuntime(build(ONE)) as runtime:
        trace = runtime.trace(["PLC_PRG.n"])
        runtime.force("PLC_PRG.other", 9)
        runtime.run(cycles=2)
        change(runtime, MORE_DATA)
        runtime.run(cycles=2)
        assert [s.values["PLC_PRG.n"] for s in trace.samples] == [1, 2, 12, 22]
        assert [path for _, path in runtime.plc.forces()] == ["PLC_PRG.other"]
        assert runtime.read("PLC_PRG.other") == 9


def test_force_of_a_removed_variable_is_released_and_logged() -> None:
    with LocalRuntime(build(ONE)) as runtime:
        runtime.force("PLC_PRG.other", 9)
        change(runtime, "PROGRAM PLC_PRG VAR n : DINT; END_VAR n := n + 1; END_PROGRAM")
        assert runtime.plc.forces() == []
        assert any("their variables are gone" in e.message for e in runtime.plc.log.since())


def test_many_changes_in_real_time_lose_no_cycle() -> None:
    task = Task("Main", interval_ns=1 * MS, programs=("PLC_PRG",))
    text = """
    PROGRAM PLC_PRG
    VAR n : LINT; last : LINT; jumps : DINT; END_VAR
    n := n + 1;
    IF n <> last + 1 THEN jumps := jumps + 1; END_IF
    last := n;
    END_PROGRAM
    """
    with LocalRuntime(build(text, (task,)), virtual=False) as runtime:
        for number in range(10):
            changed = text.replace("VAR n", f"VAR v{number} : LREAL := {number}.5; n")
            package = build(changed, (task,), previous=runtime.package)
            runtime.plc.download(package.to_bytes(), "online_change")
            runtime.run(cycles=5)
            assert runtime.read(f"PLC_PRG.v{number}") == number + 0.5
        assert runtime.read("PLC_PRG.jumps") == 0


def test_a_package_for_another_base_is_refused() -> None:
    with LocalRuntime(build(ONE)) as runtime:
        other = build(MORE_DATA, previous=build(CODE_ONLY))
        with pytest.raises(PlcError, match="another application than the running one"):
            runtime.plc.download(other.to_bytes(), "online_change")
        runtime.run(cycles=1)


def test_a_plain_package_is_no_online_change() -> None:
    with pytest.raises(OnlineChangeError, match="not built as an online change"):
        check_change(build(ONE), build(CODE_ONLY))


def test_the_changed_application_boots(tmp_path: Path) -> None:
    with LocalRuntime(build(ONE), folder=tmp_path) as runtime:
        change(runtime, MORE_DATA)
        code_id = runtime.package.code_id
    from tappet.runtime.plc import SoftPlc

    plc = SoftPlc(tmp_path, virtual=True)
    assert plc.boot()
    assert plc.info().code_id == code_id
    plc.close()


@pytest.mark.parametrize("act", ["read", "write", "force", "unforce", "record", "flight_read"])
def test_places_of_the_application_before_mean_nothing_any_more(act: str) -> None:
    """An order that was under way during the change names other variables: nothing is done."""
    plc = SoftPlc(None)
    plc.load(build("PROGRAM PLC_PRG\nVAR a : DINT := 1; END_VAR\na := a;\nEND_PROGRAM"))
    try:
        old = plc.loaded().package
        place = plc.symbols().resolve("PLC_PRG.a")
        text = "PROGRAM PLC_PRG\nVAR a : DINT := 1; b : DINT := 2; END_VAR\nb := a + 1;\nEND_PROGRAM"
        plc.download(build(text, previous=old).to_bytes(), "online_change")
        values = [PlacedValue(Place(place.offset, 4), b"\x09\0\0\0")]
        orders: dict[str, Callable[[], object]] = {
            "read": lambda: plc.read([(place.offset, 4)], old.code_id),
            "write": lambda: plc.write(values, old.code_id),
            "force": lambda: plc.force(values, code_id=old.code_id),
            "unforce": lambda: plc.unforce(None, code_id=old.code_id),
            "record": lambda: plc.record([(place.offset, 4)], None, 1, 0, code_id=old.code_id),
            "flight_read": lambda: plc.flight_read(1, [(place.offset, 4)], old.code_id),
        }
        with pytest.raises(OtherApplicationError, match="nothing was done"):
            orders[act]()
        image = plc.loaded().image
        assert b"\x09\0\0\0" not in image.read(0, image.size)
        assert not plc.forces()
    finally:
        plc.close()

"""States, resets and what survives what (gvl_dut_symbols PERS-01, PERS-02; gvl_dut_symbols EX-07)."""

from pathlib import Path

import pytest
from plc_programs import build

from tappet.runtime.boot import FILE
from tappet.runtime.errors import PlcError
from tappet.runtime.plc import SoftPlc
from tappet.runtime.state import Event

TEXT = """
PROGRAM PLC_PRG
VAR RETAIN iRem1 : INT; END_VAR
VAR
    iNorm : INT;
    {attribute 'no_init'}
    iKept : INT;
    n : DINT;
END_VAR
n := n + 1;
END_PROGRAM
"""
PERSISTENT = "VAR_GLOBAL PERSISTENT RETAIN\n iVarPers1 : DINT;\n bVarPers : BOOL;\nEND_VAR"
NAMES = ("PLC_PRG.iRem1", "Persistent.iVarPers1", "Persistent.bVarPers", "PLC_PRG.iNorm")


def package(persistent: str = PERSISTENT):
    return build(TEXT, gvls={"Persistent": persistent})


@pytest.fixture
def plc(tmp_path: Path):
    plc = SoftPlc(tmp_path)
    yield plc
    plc.close()


def put(plc: SoftPlc) -> None:
    from tappet.runtime.forces import PlacedValue
    from tappet.runtime.places import Place

    symbols = plc.symbols()
    values = []
    for path, value in zip((*NAMES, "PLC_PRG.iKept"), (11, 22, True, 33, 44), strict=True):
        ref = symbols.resolve(path)
        values.append(PlacedValue(Place(ref.offset, ref.size, ref.bit), symbols.encode(ref, value)))
    done = plc.write(values)
    while not done():
        pass


def get(plc: SoftPlc, names: tuple[str, ...] = NAMES) -> list[object]:
    symbols = plc.symbols()
    refs = [symbols.resolve(n) for n in names]
    return [
        symbols.decode(r, d) for r, d in zip(refs, plc.read([(r.offset, r.size) for r in refs]), strict=True)
    ]


def test_ex_07_resets_and_download(plc: SoftPlc) -> None:
    plc.download(package().to_bytes())
    put(plc)
    plc.reset("warm")
    assert get(plc) == [11, 22, True, 0]
    put(plc)
    plc.reset("cold")
    assert get(plc) == [0, 22, True, 0]
    plc.download(package().to_bytes())
    assert get(plc) == [0, 22, True, 0]
    plc.reset("origin")
    assert plc.state == "empty"
    plc.download(package().to_bytes())
    assert get(plc) == [0, 0, False, 0]


def test_ex_07_reboot(tmp_path: Path) -> None:
    first = SoftPlc(tmp_path)
    first.download(package().to_bytes())
    put(first)
    first.start()
    first.close()
    second = SoftPlc(tmp_path)
    assert second.boot()
    assert second.state == "run"
    assert get(second) == [11, 22, True, 0]
    second.close()


def test_ex_07_appended_variable_keeps_the_others(plc: SoftPlc) -> None:
    plc.download(package().to_bytes())
    put(plc)
    longer = PERSISTENT.replace("END_VAR", " p3 : INT;\nEND_VAR")
    plc.download(package(longer).to_bytes())
    assert get(plc, ("Persistent.iVarPers1", "Persistent.bVarPers", "Persistent.p3")) == [22, True, 0]


def test_ex_07_renamed_or_retyped_variable_is_initialised_and_logged(plc: SoftPlc) -> None:
    plc.download(package().to_bytes())
    put(plc)
    changed = "VAR_GLOBAL PERSISTENT RETAIN\n iOther : DINT;\n bVarPers : INT;\nEND_VAR"
    plc.download(package(changed).to_bytes())
    assert get(plc, ("Persistent.iOther", "Persistent.bVarPers")) == [0, 0]
    assert any("PERSISTENT.IVARPERS1" in e.message for e in plc.log.since())


BLOCK = """
FUNCTION_BLOCK FB_Base
VAR CONSTANT factors : ARRAY[0..1] OF INT := [{0}, 7]; END_VAR
VAR first : INT; END_VAR
first := factors[0];
END_FUNCTION_BLOCK
FUNCTION_BLOCK FB_Count EXTENDS FB_Base
VAR_INPUT CONSTANT given : INT; END_VAR
VAR CONSTANT c : INT := {0}; name : STRING := 'v{0}'; bit : BIT := {0} = 2; END_VAR
VAR n : INT; other : BIT; END_VAR
SUPER^();
n := n + 1;
other := TRUE;
END_FUNCTION_BLOCK
PROGRAM PLC_PRG
VAR RETAIN kept : FB_Count := (given := {0}0); END_VAR
VAR inside : FB_Count := (given := {0}1); END_VAR
kept();
inside();
Store.lasting[1]();
Store.lasting[2]();
END_PROGRAM
"""
STORE = """
VAR_GLOBAL PERSISTENT RETAIN
    lasting : ARRAY[1..2] OF FB_Count := [(given := {0}4), (given := {0}5)];
END_VAR
"""


def with_constants(number: int):
    return build(BLOCK.format(number), gvls={"Store": STORE.format(number)})


def shown(plc: SoftPlc, name: str) -> list[object]:
    members = ("n", "other", "c", "factors[0]", "factors[1]", "name", "bit", "given")
    return get(plc, tuple(f"{name}.{member}" for member in members))


def test_constants_of_remanent_instances_are_those_of_the_download(plc: SoftPlc) -> None:
    plc.download(with_constants(1).to_bytes())
    plc.single_cycle()
    assert shown(plc, "PLC_PRG.kept") == [1, True, 1, 1, 7, "v1", False, 10]
    assert shown(plc, "Store.lasting[2]") == [1, True, 1, 1, 7, "v1", False, 15]
    plc.download(with_constants(2).to_bytes())
    assert shown(plc, "PLC_PRG.kept") == [0, False, 2, 2, 7, "v2", True, 20]
    assert shown(plc, "Store.lasting[1]") == [1, True, 2, 2, 7, "v2", True, 24]
    assert shown(plc, "Store.lasting[2]") == [1, True, 2, 2, 7, "v2", True, 25]
    assert get(plc, ("Store.lasting[1].first",)) == [1]
    plc.single_cycle()
    assert get(plc, ("Store.lasting[1].first",)) == [2]
    plc.reset("warm")
    assert shown(plc, "PLC_PRG.kept") == [1, True, 2, 2, 7, "v2", True, 20]
    assert shown(plc, "Store.lasting[1]") == [2, True, 2, 2, 7, "v2", True, 24]
    plc.reset("cold")
    assert shown(plc, "PLC_PRG.kept") == [0, False, 2, 2, 7, "v2", True, 20]
    assert shown(plc, "Store.lasting[1]") == [2, True, 2, 2, 7, "v2", True, 24]


def test_constants_of_remanent_instances_are_those_of_the_boot_application(tmp_path: Path) -> None:
    first = SoftPlc(tmp_path)
    first.download(with_constants(1).to_bytes())
    first.single_cycle()
    first.close()
    (tmp_path / FILE).write_bytes(with_constants(2).to_bytes())
    second = SoftPlc(tmp_path)
    assert second.boot()
    second.stop()
    for name, given in (("PLC_PRG.kept", 20), ("Store.lasting[1]", 24), ("Store.lasting[2]", 25)):
        n, *others = shown(second, name)
        assert isinstance(n, int)
        assert n >= 1
        assert others == [True, 2, 2, 7, "v2", True, given]
    second.close()


def test_another_application_does_not_inherit(plc: SoftPlc) -> None:
    plc.download(package().to_bytes())
    put(plc)
    plc.download(build(TEXT, gvls={"Persistent": PERSISTENT}, name="Other").to_bytes())
    assert get(plc) == [0, 0, False, 0]


def test_no_init_survives_resets(plc: SoftPlc) -> None:
    plc.download(package().to_bytes())
    put(plc)
    plc.reset("cold")
    assert get(plc, ("PLC_PRG.iKept",)) == [44]


def test_origin_removes_everything(plc: SoftPlc, tmp_path: Path) -> None:
    plc.download(package().to_bytes())
    put(plc)
    assert sorted(p.name for p in tmp_path.iterdir()) == ["boot.tappet", "retain.live", "running"]
    plc.reset("origin")
    assert list(tmp_path.iterdir()) == []
    assert not plc.boot()


def test_stop_and_run_keep_values(plc: SoftPlc) -> None:
    plc.download(package().to_bytes())
    plc.start()
    put(plc)
    plc.stop()
    stopped = get(plc, ("PLC_PRG.n",))
    assert get(plc) == [11, 22, True, 33]
    plc.start()
    plc.stop()
    assert get(plc, ("PLC_PRG.n",)) >= stopped


def test_states_and_events(plc: SoftPlc) -> None:
    events: list[Event] = []
    plc.on_event = events.append
    plc.download(package().to_bytes())
    plc.start()
    plc.stop()
    plc.reset("cold")
    assert [(e.kind, e.state) for e in events] == [
        ("application", "stop"), ("state", "run"), ("state", "stop"), ("state", "stop"),
    ]  # fmt: skip


def test_commands_without_an_application_are_refused(plc: SoftPlc) -> None:
    for command in (plc.start, plc.stop, plc.symbols, plc.tasks, lambda: plc.reset("warm")):
        with pytest.raises(PlcError, match="download one first"):
            command()


def test_a_refused_package_leaves_the_old_application(plc: SoftPlc) -> None:
    plc.download(package().to_bytes())
    plc.start()
    with pytest.raises(PlcError, match="refused"):
        plc.download(b"TAPPET-PKG\x01garbage")
    assert plc.state == "run"


def test_damaged_boot_application_is_reported(plc: SoftPlc, tmp_path: Path) -> None:
    (tmp_path / "boot.tappet").write_bytes(b"TAPPET-PKG\x01\x80")
    assert not plc.boot()
    assert plc.state == "empty"
    assert "damaged" in plc.log.since()[-1].message


def test_unknown_reset_is_named(plc: SoftPlc) -> None:
    with pytest.raises(PlcError, match="known are warm, cold and origin"):
        plc.reset("hot")


def test_memory_does_not_grow_over_downloads(plc: SoftPlc) -> None:
    data = package().to_bytes()

    def resident() -> int:
        with open("/proc/self/statm", encoding="ascii") as file:
            return int(file.read().split()[1]) * 4096

    def rounds(count: int) -> None:
        for _ in range(count):
            plc.download(data)
            plc.start()

    rounds(10)
    before = resident()
    rounds(60)
    assert resident() - before < 8 << 20


def left_by_exit(text: str) -> object:
    """The persistent variable `left` after the FB_Exit methods of a program."""
    plc = SoftPlc(None)
    plc.load(build(text, gvls={"Persistent": "VAR_GLOBAL PERSISTENT left : DINT; END_VAR"}))
    application = plc.application
    assert application is not None
    assert application.run_exit() is None
    (left,) = get(plc, ("Persistent.left",))
    plc.close()
    return left


def test_fb_exit_runs_before_a_download() -> None:
    text = """
    FUNCTION_BLOCK FB_Exiting
    VAR x : INT; END_VAR
    METHOD FB_Exit : BOOL
    VAR_INPUT bInCopyCode : BOOL; END_VAR
    left := left + 1;
    END_METHOD
    END_FUNCTION_BLOCK
    PROGRAM PLC_PRG
    VAR fb : FB_Exiting; END_VAR
    fb();
    END_PROGRAM
    """
    assert left_by_exit(text) == 1


def test_instances_can_be_left_out_of_fb_exit() -> None:
    """LPRG-36, language_pragmas EX-10."""
    text = """
    FUNCTION_BLOCK POU
    VAR_INPUT n : INT; END_VAR
    METHOD FB_Exit : BOOL
    VAR_INPUT bInCopyCode : BOOL; END_VAR
    left := left * 10 + n;
    END_METHOD
    END_FUNCTION_BLOCK
    FUNCTION_BLOCK Outer
    VAR
        a : POU := (n := 3);
        {attribute 'no-exit'}
        b : POU := (n := 4);
    END_VAR
    END_FUNCTION_BLOCK
    PROGRAM PLC_PRG
    VAR
        POU1 : POU := (n := 1);
        {attribute 'symbol' := 'no-exit'}
        POU2 : POU := (n := 2);
        inner : Outer;
    END_VAR
    POU1(); POU2(); inner();
    END_PROGRAM
    """
    assert left_by_exit(text) == 13


def test_the_loaded_application_becomes_the_boot_application(tmp_path: Path) -> None:
    first = SoftPlc(tmp_path)
    first.load(package())
    assert not (tmp_path / FILE).exists()
    first.create_boot_application()
    first.close()
    second = SoftPlc(tmp_path)
    assert second.boot()
    assert second.state == "run"
    second.close()


def test_a_boot_application_needs_an_application_and_a_folder(plc: SoftPlc, tmp_path: Path) -> None:
    with pytest.raises(PlcError, match="no application"):
        plc.create_boot_application()
    without = SoftPlc(None)
    without.load(package())
    with pytest.raises(PlcError, match="has no data folder"):
        without.create_boot_application()
    without.close()
    (tmp_path / "gone").mkdir()
    removed = SoftPlc(tmp_path / "gone")
    removed.load(package())
    removed.folder = tmp_path / "nowhere"
    with pytest.raises(PlcError, match="could not be stored"):
        removed.create_boot_application()
    removed.close()

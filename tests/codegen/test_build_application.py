"""The build driver: packages, layouts, remanence, tasks, libraries, caches, system builds."""

from __future__ import annotations

import contextlib
import io
from dataclasses import dataclass
from pathlib import Path

import msgspec
import pytest
from compiled_programs import build, result
from elftools.elf.elffile import ELFFile
from linked_application import loaded

from tappet.codegen.build import (
    BuildOptions,
    BuildSession,
    LibraryReference,
    build_application,
)
from tappet.codegen.check import check_application, format_diagnostic
from tappet.codegen.package import MAGIC, CodePackage, PackageError
from tappet.codegen.system import SystemBuildError, build_system, layout_of
from tappet.iec.task import Watchdog
from tappet.lang.source import Scope, Source

PROGRAM = """
PROGRAM PLC_PRG
VAR a : INT := 5; b : LREAL; END_VAR
VAR RETAIN kept : DINT; END_VAR
a := a + 1;
END_PROGRAM
"""


@dataclass
class Task:
    name: str = "T1"
    kind: str = "cyclic"
    interval_ns: int = 1_000_000
    priority: int = 1
    event: str | None = None
    watchdog: Watchdog | None = None
    programs: tuple[str, ...] = ("PLC_PRG",)
    processors: tuple[int, ...] = ()
    policy: str = "fifo"


def codes(text: str, *tasks: Task) -> list[str]:
    found = build_application([Source("a.st", text)], tasks)
    return [d.code for d in found.diagnostics if d.severity == "error"]


def test_package_survives_serialisation():
    package = build(PROGRAM)
    again = CodePackage.from_bytes(package.to_bytes())
    assert again == package
    with loaded(again) as application:
        application.cycle()
        assert application.read("PLC_PRG.a") == 6


def test_equal_sources_give_equal_packages():
    assert build(PROGRAM).to_bytes() == build(PROGRAM).to_bytes()


def test_damaged_packages_are_refused_or_harmless():
    whole = build(PROGRAM).to_bytes()
    for at in range(0, len(whole), 13):
        for mask in (0xFF, 0x01, 0x80):
            data = bytearray(whole)
            data[at] ^= mask
            with contextlib.suppress(PackageError):
                CodePackage.from_bytes(bytes(data))


@pytest.mark.parametrize(
    ("field", "value"),
    [
        ("event_offset", b"x"), ("interval_ns", float("inf")), ("event_bit", "bit"), ("priority", 99),
        ("kind", "sometimes"),
    ],
)  # fmt: skip
def test_a_task_with_values_of_other_types_is_refused(field: str, value: object):
    whole = build(PROGRAM).to_bytes()
    head = len(MAGIC) + 1
    body = msgspec.msgpack.decode(whole[head:])
    body["tasks"][0][field] = value
    with pytest.raises(PackageError, match=rf"tasks\[0\]\.{field}|tasks\[\.\.\.\]\.{field}"):
        CodePackage.from_bytes(whole[:head] + msgspec.msgpack.encode(body))


def test_truncated_package_is_refused():
    data = build(PROGRAM).to_bytes()
    for length in (0, 5, 11, 40, len(data) // 2, len(data) - 1):
        with pytest.raises(PackageError):
            CodePackage.from_bytes(data[:length])


def test_objects_carry_the_line_of_every_statement():
    package = build(
        "PROGRAM PLC_PRG\nVAR a : INT; b : INT; END_VAR\na := a / b;\n\nb := a MOD b;\nEND_PROGRAM"
    )
    elf = ELFFile(io.BytesIO(package.objects[0]))
    dwarf = elf.get_dwarf_info()
    lines = set()
    names = set()
    for unit in dwarf.iter_CUs():
        program = dwarf.line_program_for_CU(unit)
        lines |= {e.state.line for e in program.get_entries() if e.state and not e.state.end_sequence}
        names |= {
            d.attributes["DW_AT_name"].value
            for d in unit.iter_DIEs()
            if d.tag == "DW_TAG_subprogram" and "DW_AT_name" in d.attributes
        }
    assert {3, 5} <= lines
    assert b"PLC_PRG" in names or any(
        s.name == "st.PLC_PRG" for s in elf.get_section_by_name(".symtab").iter_symbols()
    )


def test_remanent_variables_are_found_by_path():
    package = build(
        """
        FUNCTION_BLOCK FB VAR RETAIN n : INT; END_VAR VAR m : INT; END_VAR END_FUNCTION_BLOCK
        PROGRAM PLC_PRG
        VAR f : FB; g : ARRAY [1..2] OF FB; plain : INT; END_VAR
        VAR RETAIN r : LREAL; whole : FB; END_VAR
        END_PROGRAM
        """
    )
    assert [r.path for r in package.retain] == [
        "PLC_PRG.f.n", "PLC_PRG.g[1].n", "PLC_PRG.g[2].n", "PLC_PRG.r", "PLC_PRG.whole",
    ]  # fmt: skip
    for item in package.retain:
        ref = package.symbols.resolve(item.path)
        assert (ref.offset, ref.size) == (item.offset, item.size)


def test_persistent_list():
    sources = [
        Source("PLC_PRG", "PROGRAM PLC_PRG END_PROGRAM"),
        Source("P", "VAR_GLOBAL PERSISTENT RETAIN x : DINT := 3; END_VAR", name="P"),
    ]
    package = build_application(sources).package
    assert package is not None
    assert [(p.path, p.type_signature) for p in package.persistent] == [("P.x", "DINT")]
    assert package.retain == []


@pytest.mark.parametrize(
    ("task", "code"),
    [
        (Task(programs=("Nope",)), "E0701"),
        (Task(priority=40), "E0702"),
        (Task(interval_ns=0), "E0706"),
        (Task(kind="event"), "E0707"),
        (Task(kind="sometimes"), "E0708"),
        (Task(programs=("F",)), "E0709"),
        (Task(kind="event", event="PLC_PRG.nothing"), "E0704"),
        (Task(kind="event", event="PLC_PRG.a"), "E0705"),
        (Task(watchdog=Watchdog(0)), "E0710"),
        (Task(watchdog=Watchdog(1000, -1)), "E0710"),
    ],
)
def test_wrong_tasks_are_reported(task: Task, code: str):
    assert codes(PROGRAM + "FUNCTION F : INT END_FUNCTION", task) == [code]


def test_a_watchdog_tolerates_nothing_at_sensitivity_0():
    package = build_application([Source("a.st", PROGRAM)], [Task(watchdog=Watchdog(1000, 0))]).package
    assert package is not None
    assert package.tasks[0].watchdog == Watchdog(1000, 0)


def test_warnings_about_tasks_are_in_the_build():
    text = (
        PROGRAM + "PROGRAM Idle\nEND_PROGRAM\nPROGRAM Alone\nVAR go : BOOL; END_VAR\ngo := TRUE;\nEND_PROGRAM"
    )
    tasks = [Task("E", "event", event="PLC_PRG.go", programs=()), Task("F", "status", event="PLC_PRG.go")]
    found = build_application([Source("a.st", text.replace("a : INT := 5;", "a : INT; go : BOOL;"))], tasks)
    assert found.package is not None
    assert [d.code for d in found.diagnostics if d.code.startswith("W14")] == [
        "W1402",
        "W1401",
        "W1403",
        "W1403",
    ]


def test_two_tasks_of_one_name():
    assert codes(PROGRAM, Task(), Task()) == ["E0703"]


def test_event_variable_is_placed():
    text = "PROGRAM PLC_PRG VAR go : BOOL; f AT %MX3.9 : BOOL; END_VAR END_PROGRAM"
    tasks = [Task("A", "event", event="PLC_PRG.go"), Task("B", "status", event="PLC_PRG.f")]
    package = build_application([Source("a", text)], tasks).package
    assert package is not None
    go, f = (package.symbols.resolve(f"PLC_PRG.{n}") for n in ("go", "f"))
    assert [(t.event_offset, t.event_bit) for t in package.tasks] == [(go.offset, None), (f.offset, 1)]


def test_missing_library_is_an_error_with_the_names_there_are():
    options = BuildOptions(libraries=(LibraryReference("Nonsense"),))
    found = build_application([Source("a", PROGRAM)], (), options)
    (error,) = [d for d in found.diagnostics if d.severity == "error"]
    assert error.code == "E0902"
    assert "Standard" in error.message


def test_edit_compiles_one_module_again(tmp_path: Path):
    def sources(constant: int) -> list[Source]:
        block = (
            "FUNCTION_BLOCK FB{n}\nVAR a : ARRAY [0..9] OF INT; i : INT; END_VAR\n"
            + "FOR i := 0 TO 9 DO a[i] := a[i] * 3 + i - {c}; END_FOR\n" * 40
            + "END_FUNCTION_BLOCK"
        )
        blocks = [Source(f"FB{n}", block.format(n=n, c=constant if n == 3 else 1)) for n in range(10)]
        instances = " ".join(f"f{n} : FB{n};" for n in range(10))
        calls = " ".join(f"f{n}();" for n in range(10))
        return [*blocks, Source("PLC_PRG", f"PROGRAM PLC_PRG VAR {instances} END_VAR {calls} END_PROGRAM")]

    session, options = BuildSession(), BuildOptions(level=1, cache=tmp_path)
    first = build_application(sources(1), (), options, session=session)
    assert first.package is not None
    assert len(first.package.objects) > 3
    second = build_application(sources(2), (), options, session=session)
    assert second.package is not None
    assert second.cached_objects == len(second.package.objects) - 1
    third = build_application(sources(2), (), options)
    assert third.package is not None
    assert third.cached_objects == len(third.package.objects)
    with loaded(third.package) as application:
        application.cycle()
        assert application.read("PLC_PRG.f4.a") == application.read("PLC_PRG.f5.a")
        assert application.read("PLC_PRG.f3.a") != application.read("PLC_PRG.f4.a")


def test_small_functions_of_other_modules_still_work():
    body = "x := x + Twice(x) - Twice(1);\n" * 300
    blocks = "".join(
        f"FUNCTION_BLOCK FB{n}\nVAR_OUTPUT x : DINT := {n}; END_VAR\n{body}END_FUNCTION_BLOCK\n"
        for n in range(8)
    )
    text = (
        "FUNCTION Twice : DINT\nVAR_INPUT n : DINT; END_VAR\nTwice := 2 * n;\nEND_FUNCTION\n"
        + blocks
        + "PROGRAM PLC_PRG\nVAR f0 : FB0; f7 : FB7; END_VAR\nf0(); f7();\nEND_PROGRAM"
    )
    with loaded(build(text, level=1)) as application:
        application.cycle()
        x = 7
        for _ in range(300):
            x = (x + 2 * x - 2) % (1 << 32)
        assert application.read("PLC_PRG.f7.x") == (x - (1 << 32) if x >= 1 << 31 else x)


def test_check_finds_without_building():
    found = check_application([Source("a.st", "PROGRAM P\nVAR x : INT; END_VAR\ny := 1;\nEND_PROGRAM")])
    assert [format_diagnostic(d).split(" ")[:3] for d in found if d.severity == "error"] == [
        ["a.st:3:1:", "error", "E0201:"]
    ]


def test_unused_library_code_is_not_compiled():
    plain = result(PROGRAM).inner
    assert plain.functions == 3


SYSTEM = """
TYPE ST_Item : STRUCT count : DINT; address : LWORD; name : STRING(7); END_STRUCT END_TYPE
{attribute 'tappet_external' := 'abs'}
FUNCTION C_Abs : DINT
VAR_INPUT n : DINT; END_VAR
END_FUNCTION
{attribute 'tappet_export' := 'twice_abs'}
FUNCTION TwiceAbs : DINT
VAR_INPUT n : DINT; pItem : POINTER TO ST_Item; END_VAR
TwiceAbs := Helper(C_Abs(n));
IF pItem <> 0 THEN
    __XADD(ADR(pItem^.count), 5);
    __MEMSET(ADR(pItem^.name), 65, 3);
    IF __COMPARE_AND_SWAP(ADR(pItem^.address), LWORD#7, LWORD#9) THEN
        __STORE_RELEASE(pItem^.count, __LOAD_ACQUIRE(pItem^.count) * 2);
    END_IF
    __FENCE();
END_IF
END_FUNCTION
FUNCTION Helper : DINT
VAR_INPUT n : DINT; END_VAR
Helper := 2 * n;
END_FUNCTION
"""


def test_system_build_exports_c_functions():
    import ctypes

    import llvmlite.binding as llvm

    from tappet.codegen.compile_options import OptimiseOptions
    from tappet.codegen.optimise import target_machine

    built = build_system([Source("s.st", SYSTEM, Scope.LIBRARY)])
    assert built.members_of("ST_Item") == {
        "count": (0, 4, "DINT"), "address": (8, 8, "LWORD"), "name": (16, 8, "STRING(7)"),
    }  # fmt: skip
    assert built.size_of("st_item") == 24
    assert layout_of(built.analysis, "ST_ITEM")["name"][0] == 16
    machine = target_machine(OptimiseOptions())
    jit = llvm.create_lljit_compiler(machine, use_jit_link=True)
    builder = llvm.JITLibraryBuilder().add_current_process().add_object_img(built.object)
    tracker = builder.export_symbol("twice_abs").link(jit, "system")
    function = ctypes.CFUNCTYPE(ctypes.c_int32, ctypes.c_int32, ctypes.c_void_p)(tracker["twice_abs"])
    item = ctypes.create_string_buffer(24)
    item[8] = 7
    assert function(-21, ctypes.addressof(item)) == 42
    assert bytes(item) == (10).to_bytes(8, "little") + (9).to_bytes(8, "little") + b"AAA".ljust(8, b"\0")


def test_system_build_lists_errors():
    with pytest.raises(SystemBuildError, match="E0201"):
        build_system([Source("s.st", "FUNCTION F : INT F := nothing; END_FUNCTION", Scope.LIBRARY)])

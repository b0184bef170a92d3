"""What CNC programs give the compiler, in projects as a user makes them (cnc.md 12, CNC-09 to CNC-11)."""

from __future__ import annotations

import math
from typing import Any

import pytest
from tests.project.cam_projects import build, package

from tappet.codegen.build import BuildResult
from tappet.motion.queue_sources import with_queues
from tappet.project import edit, sources
from tappet.project.cnc.code import MOST_MESSAGES
from tappet.project.model import Project
from tappet.project.new_project import new_project
from tappet.runtime.local import LocalRuntime

LINES = "N10 G1 X100 Y0 F50 E100 E-100\nN20 G1 X100 Y50\n"


def project_with(code: str, variables: str, **programs: dict[str, Any]) -> Project:
    """A project with CNC programs of these data, and PLC_PRG."""
    project = new_project("machine")
    (application,) = project.applications()
    for name, data in programs.items():
        project, _ = edit.add_object(project, application.id, "cnc", name, data=data)
    (program,) = project.find_kind("pou")
    declaration = f"PROGRAM PLC_PRG\nVAR\n{variables}\nEND_VAR"
    return edit.change_data(project, program.id, {"declaration": declaration, "implementation": code})


def changed(project: Project, name: str, **data: Any) -> Project:
    (item,) = (item for item in project.find_kind("cnc") if item.name == name)
    return edit.change_data(project, item.id, {**item.data.model_dump(), **data})


def messages(project: Project, result: BuildResult) -> list[tuple[str, str, int, int, int]]:
    """Severity, name of the object, line, first and last column of each message about a CNC program."""
    (application,) = project.applications()
    texts = with_queues(sources.application_sources(project, application.id))
    maps = {source.uri: source.map for source in texts}
    found = []
    for one in result.diagnostics:
        known = maps.get(one.uri)
        if known is None or one.severity not in ("error", "warning"):
            continue
        place = known.place(one.span)
        item = project.get(place.object_id)
        if item.kind == "cnc":
            assert place.part == "implementation"
            found.append((one.severity, item.name, place.span.line, place.span.column, place.span.end_column))
    return found


QUEUES = """n := SM3_CNC.g_CNCQueueManager.Count;
FOR i := 0 TO n - 1 DO
    pQueue := SM3_CNC.g_CNCQueueManager.GetOutQueue(i);
    aTags[i] := pQueue^.wOUTQUEUEStructID;
    aNames[i] := pQueue^.strProgramName;
END_FOR
m := SM3_CNC.g_CNCProgManager.Count;
FOR i := 0 TO m - 1 DO
    pRef := SM3_CNC.g_CNCProgManager.GetProgram(i);
    aTags[10 + i] := pRef^.wCNCREFStructID;
    aNames[10 + i] := pRef^.strProgramName;
END_FOR"""
MANAGED = """    pQueue : POINTER TO SM3_CNC.SMC_OUTQUEUE;
    pRef : POINTER TO SM3_CNC.SMC_CNC_REF;
    n, m, i : INT;
    aTags : ARRAY[0..19] OF WORD;
    aNames : ARRAY[0..19] OF STRING;"""


def test_the_managers_know_the_programs_of_each_mode() -> None:
    """cnc EX-10, EX-11: two queues and one program of words; what is excluded is not there."""
    project = project_with(
        QUEUES,
        MANAGED,
        Out={"compile_mode": "out_queue", "implementation": LINES},
        Back={"compile_mode": "out_queue", "implementation": "% Return\nG0 X1 F10"},
        Words={"implementation": LINES},
        Kept={"implementation": LINES, "exclude_from_build": True},
    )
    with LocalRuntime(package(project)) as runtime:
        runtime.run(cycles=1)

        def values(*names: str) -> list[object]:
            return [runtime.read(f"PLC_PRG.{name}") for name in names]

        assert values("n", "m") == [2, 1]
        assert values("aTags[0]", "aTags[1]", "aTags[10]") == [0x9878, 0x9878, 0xBA56]
        assert values("aNames[0]", "aNames[1]", "aNames[10]") == ["Out", "Return", "Words"]
        runtime.reset("cold")
        runtime.start()
        runtime.run(cycles=1)
        assert values("n", "m") == [2, 1]


DECODE = """dec(ncprog := Example, bExecute := TRUE,
    nSizeOutQueue := SIZEOF(aBuffer), pbyBufferOutQueue := ADR(aBuffer));"""
RUN_WORDS = f"""{DECODE}
check(bExecute := TRUE, poqDataIn := dec.poqDataOut);
ipo(bExecute := TRUE, poqDataIn := dec.poqDataOut, dwIpoTime := 20000);
{{record}}"""
RUN_QUEUE = """ipo(bExecute := TRUE, poqDataIn := ADR(Example), dwIpoTime := 20000);
{record}"""
RECORD = """IF ipo.bWorking THEN
    fFastest := MAX(fFastest, ipo.dVel);
    nWorking := nWorking + 1;
END_IF"""
DECODER = """    dec : SM3_CNC.SMC_NCDecoder;
    aBuffer : ARRAY[1..50] OF SM3_CNC.SMC_GEOINFO;"""
INTERPOLATOR = """    ipo : SM3_CNC.SMC_Interpolator;
    fFastest : LREAL;
    nWorking : DINT;"""
CHAIN = f"""{DECODER}
    check : SM3_CNC.SMC_CheckVelocities;
{INTERPOLATOR}"""


@pytest.mark.parametrize(
    ("mode", "code", "blocks"), [("cnc_ref", RUN_WORDS, CHAIN), ("out_queue", RUN_QUEUE, INTERPOLATOR)]
)
def test_a_program_runs_to_its_end_point_in_both_modes(mode: str, code: str, blocks: str) -> None:
    """DAT-03, DAT-04, cnc_runtime EX-01: words through the chain, or the queue directly; 2.5 s and 1.5 s."""
    project = project_with(
        code.format(record=RECORD), blocks, Example={"compile_mode": mode, "implementation": LINES}
    )
    with LocalRuntime(package(project)) as runtime:
        runtime.run(time_ns=5_000_000_000)
        read = runtime.read
        assert read("PLC_PRG.ipo.bDone") is True
        assert read("PLC_PRG.ipo.wErrorID") == 0
        assert (read("PLC_PRG.ipo.piSetPosition.dX"), read("PLC_PRG.ipo.piSetPosition.dY")) == (100.0, 50.0)
        assert read("PLC_PRG.fFastest") == pytest.approx(50.0)
        assert float(str(read("PLC_PRG.nWorking"))) * 0.02 == pytest.approx(4.0, abs=0.06)


def test_a_queue_is_preprocessed_by_the_settings() -> None:
    """DAT-03: smoothing at compile time; byGenerator is that of the editor, the list is closed."""
    text = "N0 G1 X10 Y0 F100\nN10 G51 D2\nN20 G1 X10 Y20\nN30 G1 X20 Y20\nN40 G50"
    project = project_with(
        "n := UINT_TO_INT(SM3_CNC.SMC_GetCount(ADR(Example))); i := Example_A[2].iMoveType;",
        "    n, i : INT;",
        Example={"compile_mode": "out_queue", "implementation": text},
    )
    (settings,) = project.find_kind("cnc_settings")
    plain = package(project)
    project = edit.change_data(project, settings.id, {"preprocessing": [{"block": "SMC_SmoothPath"}]})
    for built, count in ((plain, 3), (package(project), 4)):
        with LocalRuntime(built) as runtime:
            runtime.run(cycles=1)
            assert runtime.read("PLC_PRG.n") == count
            assert runtime.read("IoConfig_Example.Example.byGenerator") == 255
            assert runtime.read("IoConfig_Example.Example.bEndOfList") is True
            assert runtime.read("IoConfig_Example.Example_A[0].iSourceLine_No") == 0


def test_words_of_variables_are_read_when_the_line_is_decoded() -> None:
    """CNC-38: of every type that a word may have."""
    kinds = ("INT", "BYTE", "WORD", "DINT", "DWORD", "REAL", "SINT", "USINT", "UINT", "UDINT", "LREAL")
    variables = "\n".join(f"    v{n} : {kind} := {n + 1};" for n, kind in enumerate(kinds))
    lines = "\n".join(f"G1 X$PLC_PRG.v{n}$ F10" for n in range(len(kinds)))
    ends = ", ".join(f"fEnd{n}" for n in range(len(kinds)))
    reads = "\n".join(f"fEnd{n} := aBuffer[{n + 1}].piDestPos.dX;" for n in range(len(kinds)))
    project = project_with(
        f"{DECODE}\n{reads}",
        f"{DECODER}\n{variables}\n    {ends} : LREAL;",
        Example={"implementation": lines},
    )
    with LocalRuntime(package(project)) as runtime:
        runtime.run(cycles=20)
        found = [runtime.read(f"PLC_PRG.fEnd{n}") for n in range(len(kinds))]
        assert found == [float(n + 1) for n in range(len(kinds))]


def test_what_is_wrong_is_said_at_its_line_and_word() -> None:
    """CNC-37: text, unknown variables, variables of other types, each with its range in the program."""
    text = "N0 G1 X$PLC_PRG.s$ F10\nN1 G77 X1\n\nN2 G1 Y$GVL.nothing$\nN1 G1 Z1\nN3 G0 X"
    project = project_with("n := 1;", "    s : STRING;\n    n : INT;", Example={"implementation": text})
    result = build(project)
    assert result.package is None
    assert sorted(messages(project, result), key=lambda one: one[2]) == [
        ("error", "Example", 0, 6, 18),
        ("error", "Example", 1, 3, 6),
        ("error", "Example", 3, 6, 20),
        ("warning", "Example", 4, 0, 1),
        ("error", "Example", 5, 6, 7),
    ]


def test_what_only_the_blocks_find_is_said_too() -> None:
    """cnc EX-32: no velocity, an acceleration of 0: the queue cannot be made."""
    for text, line in (("(start)\nN0 G1 X10", 1), ("N0 G1 X10 F10 E0", 0)):
        project = project_with(
            "n := 1;", "    n : INT;", Example={"implementation": text, "compile_mode": "out_queue"}
        )
        result = build(project)
        assert result.package is None
        assert [one[:3] for one in messages(project, result)] == [("error", "Example", line)]


def test_a_preprocessing_block_that_is_gone_stops_the_build() -> None:
    project = project_with("n := 1;", "    n : INT;", Example={"compile_mode": "out_queue"})
    (settings,) = project.find_kind("cnc_settings")
    project = edit.change_data(project, settings.id, {"preprocessing": [{"block": "SMC_Nothing"}]})
    assert any("SMC_Nothing" in str(one) for one in build(project).diagnostics if one.severity == "error")


def test_variables_in_a_queue_are_warned_of() -> None:
    """CNC-35: their offline values are compiled."""
    project = project_with(
        "f := Example_A[0].piDestPos.dX;",
        "    f : LREAL;",
        Example={
            "implementation": "G1 X$GVL.x$ F10",
            "compile_mode": "out_queue",
            "offline_values": [{"name": "gvl.X", "value": 7.5}],
        },
    )
    result = build(project)
    assert messages(project, result) == [("warning", "Example", 0, 3, 11)]
    assert result.package is not None
    with LocalRuntime(result.package) as runtime:
        runtime.run(cycles=1)
        assert runtime.read("PLC_PRG.f") == 7.5


def test_the_mode_file_is_refused_by_name() -> None:
    """CNC-11: level X."""
    project = project_with("n := 1;", "    n : INT;", Example={"compile_mode": "file"})
    (error,) = (str(one) for one in build(project).diagnostics if one.severity == "error")
    assert "compile mode File is not supported" in error


def test_many_mistakes_do_not_drown_the_build() -> None:
    project = project_with("n := 1;", "    n : INT;", Example={"implementation": "G77\n" * 1000})
    assert len(messages(project, build(project))) == MOST_MESSAGES


def test_an_online_change_takes_over_the_program_that_was_edited() -> None:
    """In both modes; the managers know it afterwards, also where a program came or went."""
    code = f"{QUEUES}\nfWords := Words_A[6].fValue;\nfQueue := Out_A[0].piDestPos.dX;"
    project = project_with(
        code,
        f"{MANAGED}\n    fWords, fQueue : LREAL;",
        Out={"compile_mode": "out_queue", "implementation": "G1 X1 F10"},
        Words={"implementation": "N5 G1 X1 F10"},
    )
    first = package(project)
    with LocalRuntime(first) as runtime:
        runtime.run(cycles=1)

        def state() -> list[object]:
            return [runtime.read(f"PLC_PRG.{name}") for name in ("fWords", "fQueue", "n", "m")]

        assert state() == [1.0, 1.0, 1, 1]
        project = changed(project, "Words", implementation="N5 G1 X2 F10\nN6 G1 X3")
        project = changed(project, "Out", implementation="G1 X4 F10\nG1 Y2")
        second = package(project, first)
        runtime.plc.download(second.to_bytes(), "online_change")
        runtime.run(cycles=1)
        assert state() == [2.0, 4.0, 1, 1]
        (application,) = project.applications()
        project, _ = edit.add_object(project, application.id, "cnc", "Third", data={"implementation": LINES})
        runtime.plc.download(package(project, second).to_bytes(), "online_change")
        runtime.run(cycles=1)
        assert state() == [2.0, 4.0, 1, 2]
        assert runtime.read("PLC_PRG.aTags[11]") == 0xBA56


def test_a_renamed_program_is_used_under_its_new_name() -> None:
    project = project_with(
        "n := UDINT_TO_DINT(Example.nElements);", "    n : DINT;", Example={"implementation": "G0 X1"}
    )
    (item,) = project.find_kind("cnc")
    project = edit.rename_object(project, item.id, "Contour")
    with LocalRuntime(package(project)) as runtime:
        runtime.run(cycles=1)
        # F, E, E-, end of the defaults; G0, X1, end of the line
        assert runtime.read("PLC_PRG.n") == 7


def test_a_name_of_any_characters_becomes_a_literal() -> None:
    project = project_with(
        "s := Example.strProgramName;", "    s : STRING;", Example={"implementation": "% a'b$c{d}é€\nG0 X1"}
    )
    with LocalRuntime(package(project)) as runtime:
        runtime.run(cycles=1)
        assert runtime.read("PLC_PRG.s") == "a'b$c{d}é?"


def test_a_queue_keeps_full_precision() -> None:
    """What is compiled is bit for bit what the decoder makes: an arc of a third of a turn."""
    project = project_with(
        "fLength := Example_A[0].dLength;",
        "    fLength : LREAL;",
        Example={
            "compile_mode": "out_queue",
            "implementation": "G98\nG3 X-0.5 Y0.8660254037844387 I0 J0 F10",
            "start": {"x": 1.0},
        },
    )
    with LocalRuntime(package(project)) as runtime:
        runtime.run(cycles=1)
        assert runtime.read("PLC_PRG.fLength") == pytest.approx(2 * math.pi / 3, rel=1e-14)

"""CoDeSys 2.3 exports: names that are keywords elsewhere, and words that meant something else."""

from __future__ import annotations

from tappet.project.exchange.importing import Imported, import_files

APPLICATION = "Tappet Soft PLC/PLC Logic/Application"


def imported(text: str) -> Imported:
    return import_files({"blocks.exp": text.encode("cp1252")})


def part(done: Imported, name: str, key: str = "implementation") -> str:
    found = done.project.find(f"{APPLICATION}/{name}")
    assert found is not None, [done.project.path_of(item.id) for item in done.project.walk()]
    value = getattr(found.data, key)
    assert isinstance(value, str)
    return value


def notes(done: Imported, name: str) -> list[str]:
    return [
        entry.text for entry in done.report.entries if entry.object == name and entry.outcome == "changed"
    ]


def test_a_pou_may_have_the_name_of_a_modifier() -> None:
    done = imported(
        "FUNCTION OVERRIDE : REAL\nVAR_INPUT\n\tA : REAL;\nEND_VAR\nOVERRIDE := A;\nEND_FUNCTION\n"
    )
    assert part(done, "OVERRIDE") == "OVERRIDE := A;"


def test_transitions_between_steps_are_part_of_the_body() -> None:
    chart = """INITIAL_STEP Idle:
\tCount(N);
END_STEP
TRANSITION FROM Idle TO Busy := ready; END_TRANSITION
STEP Busy:
END_STEP
STEP Failed:
END_STEP
TRANSITION done FROM Busy TO Idle := n > 9; END_TRANSITION
TRANSITION fault (PRIORITY := 2) FROM Busy TO Failed := n > 99; END_TRANSITION
TRANSITION (PRIORITY := 1) FROM Failed TO Idle := ready;
END_TRANSITION"""
    done = imported(
        "PROGRAM PLC_PRG\nVAR\n\tready : BOOL;\n\tn : INT;\nEND_VAR\n"
        f"(* @END_DECLARATION := '0' *)\n{chart}\n"
        "ACTION Count:\nn := n + 1;\nEND_ACTION\nTRANSITION From := ready;\nEND_TRANSITION\nEND_PROGRAM\n"
    )
    assert part(done, "PLC_PRG") == chart
    assert part(done, "PLC_PRG", "language") == "ST"
    assert part(done, "PLC_PRG/Count") == "n := n + 1;"
    assert part(done, "PLC_PRG/From") == ":= ready;"
    assert not [entry for entry in done.report.entries if entry.outcome != "imported"]


def test_a_chart_of_its_own_form_is_kept() -> None:
    done = imported(
        "PROGRAM PLC_PRG\nVAR\nEND_VAR\n(* @END_DECLARATION := '0' *)\n_SFC\n_STEP 1\nEND_PROGRAM\n"
    )
    assert part(done, "PLC_PRG", "language") == "SFC"
    assert [entry.outcome for entry in done.report.entries if entry.object == "PLC_PRG"] == ["kept"]


def test_parts_of_an_export_are_no_names_and_no_comments() -> None:
    text = """
(* @NESTEDCOMMENTS := 'Yes' *)
FUNCTION_BLOCK CAMERA
VAR_INPUT
\tTRACE : BOOL;
\tCAM_ON : BOOL;
\tLIBRARY, RESOURCE : INT;
END_VAR
(*
RESOURCE is counted down
LIBRARY of pictures
*)
(* @END_DECLARATION := '0' *)
CNC := CAM_ON;
TRACE := FALSE;
END_FUNCTION_BLOCK

VAR_GLOBAL
\tCNC : BOOL;
END_VAR

LIBRARY
Valves.lib 5.12.10 14:48:34
END_LIBRARY

PROGRAM LAST
VAR
END_VAR
;
END_PROGRAM
"""
    done = imported(text)
    assert "CAM_ON : BOOL;\n\tLIBRARY, RESOURCE : INT;" in part(done, "CAMERA", "declaration")
    assert "LIBRARY of pictures" in part(done, "CAMERA", "declaration")
    assert part(done, "CAMERA") == "CNC := CAM_ON;\nTRACE := FALSE;"
    assert "CNC : BOOL;" in part(done, "Global_Variables", "declaration")
    assert part(done, "LAST") == ";"
    refused = [entry.object for entry in done.report.entries if entry.outcome == "refused"]
    assert refused == ["Valves.lib"]


def test_a_pointer_has_four_bytes() -> None:
    text = """
FUNCTION COUNTED : UINT
VAR_INPUT
\tFIRST, ROW : POINTER TO ARRAY[0..99] OF REAL;
\tSIZE : UINT;
END_VAR
VAR
\tCELL : REAL;
END_VAR
COUNTED := (SIZE - sizeof( row )) / SIZEOF(First) + SIZE / SIZEOF(CELL) - SIZEOF(ROW^); (* SIZEOF(ROW) *)
END_FUNCTION
"""
    done = imported(text)
    assert part(done, "COUNTED") == (
        "COUNTED := (SIZE - sizeof( DWORD )) / SIZEOF(DWORD) + SIZE / SIZEOF(CELL) - SIZEOF(ROW^);"
        " (* SIZEOF(ROW) *)"
    )
    assert len([note for note in notes(done, "COUNTED") if "SIZEOF(DWORD)" in note]) == 1


def test_names_that_are_keywords_today() -> None:
    text = """
FUNCTION_BLOCK CONTROL
VAR_INPUT
\tREFERENCE : REAL;
\tMethod, This : INT;
END_VAR
VAR
\tUNION : ARRAY[0..Method] OF INT;
END_VAR
(* REFERENCE *)
IF Reference > 1.0 THEN UNION[This] := method; END_IF;
END_FUNCTION_BLOCK

PROGRAM USER
VAR
\tC : CONTROL;
END_VAR
C(REFERENCE := 2.0, METHOD := C.THIS);
END_PROGRAM
"""
    done = imported(text)
    assert "REFERENCE_ : REAL;\n\tMethod_, This_ : INT;" in part(done, "CONTROL", "declaration")
    assert "UNION_ : ARRAY[0..Method_] OF INT;" in part(done, "CONTROL", "declaration")
    assert part(done, "CONTROL") == (
        "(* REFERENCE *)\nIF Reference_ > 1.0 THEN UNION_[This_] := method_; END_IF;"
    )
    assert part(done, "USER") == "C(REFERENCE_ := 2.0, METHOD_ := C.THIS_);"
    assert notes(done, "USER") == [
        "names that are keywords today end in an underscore now: REFERENCE_",
        "names that are keywords today end in an underscore now: METHOD_",
        "names that are keywords today end in an underscore now: THIS_",
    ]
    relative = imported("PROGRAM P\nVAR\n\tR : REFERENCE TO INT;\nEND_VAR\nR := THIS^.R;\nEND_PROGRAM\n")
    assert "R : REFERENCE TO INT;" in part(relative, "P", "declaration")
    assert part(relative, "P") == "R := THIS^.R;"


PROJECT = """

(* @NESTEDCOMMENTS := 'Yes' *)
(* @PATH := '' *)
PROGRAM PLC_PRG
VAR
	DELAY : TON;
END_VAR
(* @END_DECLARATION := '0' *)
DELAY(IN := TRUE, PT := T#1s);
END_PROGRAM

(* @PATH := '' *)

VISUALISATION panel _VISU_TYPES : 1,1
_BG_BMP : ''
_SIMPLE : 0
_TEXT : 5,4294967284,400
_END_ELEM
(* @TEXTSCALINGVARS := '_TEXTSCALINGVARS: $'$',$'$'' *)
END_VISUALISATION

PLC_CONFIGURATION
_GLOBAL
_END_GLOBAL
_COMMENT: 'PROGRAM of the device'
PLC_END


RESOURCE
{event_task : 'start','Called at start','','FUNCTION systemevent: DWORD$R$NEND_VAR'}{event_task_info : 0,1}
{event_task : 'stop','Called at stop','LAST_STEPS','FUNCTION systemevent: DWORD'}{event_task_info : 0,2}

TASK main (PRIORITY := 1, INTERVAL := T#3ms);
PLC_PRG();
{Additional_info : 1,0,0,0,1,4294967295}
END_TASK

TASK slow (PRIORITY := 12, INTERVAL := T#1s);
REPORT(FULL := TRUE);
CLEANUP();
{Additional_info : 1,0,0,0,1,4294967295}
END_TASK

TASK event (PRIORITY := 3, EVENT := DOOR);
END_TASK

END_RESOURCE


_ALARMCONFIG
_ALARMCLASSLIST : 1
_END_ALARMCONFIG


MACRO
MacroName: 'Take the axes in'
MacroMenu: 'Axes'
MacroCmd: 'query off ok'
MacroCmd: 'project import $$PROJECT_PATH$$\\PROGRAM.EXP'
END_MACRO


LIBRARY
STANDARD.LIB 4.10.05 11:14:46
(* @LIBRARYSYMFILEINFO := '0' *)
NumOfPOUs: 2
CONCAT: 0
TON: 0
NumOfGVLs: 0
END_LIBRARY

LIBRARY
Util.lib 18.5.10 15:14:28
(* @LIBRARYSYMFILEINFO := '0' *)
NumOfPOUs: 1
BLINK: 2048
NumOfGVLs: 1
Globale_Variablen: 0
END_LIBRARY

LIBRARY
C:\\Libs\\Pumps.lib 1.1.10 15:14:28
(* @LIBRARYSYMFILEINFO := '0' *)
NumOfPOUs: 2
PUMP_ON: 2048
PUMP_OFF: 2048
NumOfGVLs: 0
END_LIBRARY

_WORKSPACE
_GLOBALVISUALSETTINGS
_END_GLOBALVISUALSETTINGS
_END_WORKSPACE
"""


def test_a_whole_project_with_its_tasks_and_libraries() -> None:
    done = imported(PROJECT)
    tasks = {}
    for name in ("main", "slow", "event"):
        found = done.project.find(f"{APPLICATION}/Task Configuration/{name}")
        assert found is not None
        tasks[name] = found.data.model_dump()
    assert tasks["main"]["interval"] == "T#3ms"
    assert [pou["name"] for pou in tasks["main"]["pous"]] == ["PLC_PRG"]
    assert [pou["name"] for pou in tasks["slow"]["pous"]] == ["REPORT", "CLEANUP"]
    assert (tasks["slow"]["priority"], tasks["slow"]["interval"]) == (12, "T#1s")
    assert (tasks["event"]["type"], tasks["event"]["event"]) == ("event", "DOOR")
    manager = done.project.find(f"{APPLICATION}/Library Manager")
    assert manager is not None
    names = [item["name"] for item in manager.data.model_dump()["references"]]
    assert sorted(names) == ["Standard", "Util"]
    refused = {entry.object: entry.text for entry in done.report.entries if entry.outcome == "refused"}
    assert set(refused) == {
        "panel",
        "PLC_CONFIGURATION",
        "stop",
        "_ALARMCONFIG",
        "MACRO",
        "Pumps.lib",
        "_WORKSPACE",
    }
    assert "LAST_STEPS" in refused["stop"]
    assert refused["Pumps.lib"].endswith("PUMP_ON, PUMP_OFF")


def test_texts_in_the_code_page_of_the_country() -> None:
    text = "PROGRAM P\nVAR\n\tS : STRING := '%s';\nEND_VAR\n(* %s *)\n;\nEND_PROGRAM\n"
    cyrillic = import_files({"p.exp": (text % ("Нагрев 5°", "управление насосом")).encode("cp1251")})
    assert "(* управление насосом *)" in part(cyrillic, "P")
    assert "'$CD$E0$E3$F0$E5$E2 5$B0'" in part(cyrillic, "P", "declaration")
    chinese = import_files({"p.exp": (text % ("温度", "水泵启动后延时，运行")).encode("gbk")})
    assert "(* 水泵启动后延时，运行 *)" in part(chinese, "P")
    assert "'$CE$C2$B6$C8'" in part(chinese, "P", "declaration")
    western = import_files(
        {"p.exp": (text % ("Wärme 5° für 3 €", "Überdruck löst Gerät aus")).encode("cp1252")}
    )
    assert "(* Überdruck löst Gerät aus *)" in part(western, "P")
    assert "'Wärme 5° für 3 $80'" in part(western, "P", "declaration")


def test_all_texts_of_an_import_are_in_one_code_page() -> None:
    text = "PROGRAM %s\nVAR\nEND_VAR\n(* %s *)\n;\nEND_PROGRAM\n"
    files = {
        "a.exp": (text % ("A", "да")).encode("cp1251"),
        "b.exp": (text % ("B", "управление насосом")).encode("cp1251"),
        "c.st": (text % ("C", "ход")).encode(),
    }
    done = import_files(files)
    assert "(* да *)" in part(done, "A")
    assert "(* управление насосом *)" in part(done, "B")
    assert "(* ход *)" in part(done, "C")


def test_addresses_through_modules_of_a_device() -> None:
    text = """
VAR_GLOBAL
\tLEVEL AT %ID0.2.0 : REAL;
\tHEAT AT %IR3.1 : REAL;
\tKEYS AT %IB0.4.2 : BYTE;
\tENTER AT %IX0.4.2.3 : BOOL;
\tHIGH_BIT AT %QX2.1.17 : BOOL;
\tPLAIN AT %IX0.5 : BOOL;
\tNEXT AT %QW4 : WORD;
END_VAR

PROGRAM P
VAR
END_VAR
HIGH_BIT := %IX0.4.2.3 AND %IX0.5; (* %ID0.2.0 *)
END_PROGRAM
"""
    done = imported(text)
    listed = part(done, "Global_Variables", "declaration")
    assert "LEVEL AT %ID512 : REAL;" in listed
    assert "HEAT AT %ID514 : REAL;" in listed
    assert "KEYS AT %IB2064 : BYTE;" in listed
    assert "ENTER AT %IX1032.3 : BOOL;" in listed
    assert "HIGH_BIT AT %QX1025.1 : BOOL;" in listed
    assert "PLAIN AT %IX0.5 : BOOL;" in listed
    assert "NEXT AT %QW4 : WORD;" in listed
    assert part(done, "P") == "HIGH_BIT := %IX1032.3 AND %IX0.5; (* %ID0.2.0 *)"
    assert any("%ID0.2.0 became %ID512" in note for note in notes(done, "Global_Variables"))


def test_names_of_the_controller_configuration() -> None:
    text = """
PLC_CONFIGURATION
_MODULE: '3S'
_CHANNEL
_SECTION_NAME: 'Input'
_INDEX_IN_PARENT: '1'
_SYMBOLIC_NAME: 'TANK_LEVEL'
_COMMENT: 'in percent'
_CHANNEL_MODE: 'I'
_IECADR: %IW0.2.0
_BIT 0: %IX0.2.0.0 '' 'Bit 0'
_BIT 1: %IX0.2.0.1 'TANK_FULL' 'Bit 1'
_END_CHANNEL
_CHANNEL
_SYMBOLIC_NAME: ''
_COMMENT: 'not used'
_CHANNEL_MODE: 'Q'
_IECADR: %QB1
_END_CHANNEL
_END_MODULE
PLC_END

PROGRAM P
VAR
END_VAR
TANK_FULL := TANK_LEVEL > 90;
END_PROGRAM
"""
    done = imported(text)
    assert part(done, "PLC_CONFIGURATION", "declaration") == (
        "VAR_GLOBAL\n\tTANK_LEVEL AT %IW1024 : WORD; (* in percent *)\n"
        "\tTANK_FULL AT %IX1024.1 : BOOL; (* Bit 1 *)\nEND_VAR"
    )
    assert any("2 symbolic names" in note for note in notes(done, "PLC_CONFIGURATION"))


def test_persistent_variables_are_declared_in_the_persistent_list() -> None:
    """LDEC-80: RETAIN stays valid where it is."""
    text = """
(* @GLOBAL_VARIABLE_LIST := 'Counts' *)
VAR_GLOBAL RETAIN PERSISTENT
\thours : DINT := 3;
END_VAR
VAR_GLOBAL RETAIN
\tpieces : DINT;
END_VAR
(* @OBJECT_END := 'Counts' *)
(* @GLOBAL_VARIABLE_LIST := 'Kept' *)
VAR_GLOBAL PERSISTENT
\tstarts : DINT;
END_VAR
(* @OBJECT_END := 'Kept' *)
"""
    done = imported(text)
    assert part(done, "Counts", "declaration") == "VAR_GLOBAL RETAIN\n\tpieces : DINT;\nEND_VAR"
    kept = part(done, "PersistentVars", "declaration")
    assert "hours : DINT := 3;" in kept
    assert "starts : DINT;" in kept
    assert done.project.find(f"{APPLICATION}/Kept") is None
    assert notes(done, "Counts") == notes(done, "Kept") != []
    found = done.project.find(f"{APPLICATION}/PersistentVars")
    assert found is not None
    assert found.kind == "persistent"
    again = import_files({"more.exp": text.replace("hours", "days").encode()}, done.project)
    kept = part(again, "PersistentVars", "declaration")
    assert "hours : DINT := 3;" in kept
    assert "days : DINT := 3;" in kept
    assert "which was there already" in notes(again, "PersistentVars")[0]


def test_the_addresses_that_twincat_2_writes_are_a_list_of_their_own() -> None:
    """Its list has no name, and `.motor` is a global variable of any list."""
    lists = (
        "(* @GLOBAL_VARIABLE_LIST := 'Global_Variables' *)\n"
        "VAR_GLOBAL\n\tmotor AT %Q* : BOOL;\nEND_VAR\n(* @OBJECT_END := 'Global_Variables' *)\n"
    )
    configured = (
        "(* Generated automatically by TwinCAT - (read only) *)\n"
        "VAR_CONFIG\n\t.motor AT %QX4.2 : BOOL;\nEND_VAR\n"
    )
    done = import_files({"A_CONFIG.EXP": configured.encode(), "GLOBALS.EXP": lists.encode()})
    assert ".motor AT %QX4.2" in part(done, "Variable_Configuration", "declaration")
    assert "motor AT %Q*" in part(done, "Global_Variables", "declaration")
    assert list(done.report.noteworthy()) == []

"""CoDeSys 2.3 exports: names that are keywords elsewhere, and words that meant something else."""

from __future__ import annotations

from tappet.project.exchange import Imported, import_files

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
Standard.lib 5.12.10 14:48:34
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
    assert refused == ["LIBRARY"]


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

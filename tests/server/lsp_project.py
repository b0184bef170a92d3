"""The project that the tests of the language server work on."""

from __future__ import annotations

from typing import Any

from lsp_client import Client, FakeProject, uri

DECLARATION = "PROGRAM PLC_PRG\nVAR\n    motor : FB_Motor; // the drive\n    iCount : INT;\nEND_VAR"
PROJECT = {
    "PLC_PRG": (DECLARATION, "iCount := iCount + 1;\n"),
    "FB_Motor": (
        "FUNCTION_BLOCK FB_Motor\nVAR_INPUT\n    xOn : BOOL; (* run *)\nEND_VAR\n"
        "VAR_OUTPUT\n    xRuns : BOOL;\nEND_VAR",
        "xRuns := xOn;",
    ),
    "E_Mode": ("TYPE E_Mode : (Off, Auto); END_TYPE", ""),
}
BODY = uri("PLC_PRG", "implementation")
HEAD = uri("PLC_PRG", "declaration")


def start(**objects: tuple[str, str]) -> Client:
    return Client(FakeProject(**{**PROJECT, **objects}))


def here(line: int, start_: int, end: int) -> dict[str, Any]:
    return {"start": {"line": line, "character": start_}, "end": {"line": line, "character": end}}

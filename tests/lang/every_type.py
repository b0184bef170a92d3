"""A program with a variable of every type, for the tests of expressions."""

from __future__ import annotations

from resolved import codes, program

ALL = (
    "VAR b : BOOL; si : SINT; i : INT; di : DINT; li : LINT; us : USINT; ui : UINT; ud : UDINT; ul : ULINT; "
    "by : BYTE; w : WORD; dw : DWORD; lw : LWORD; re : REAL; lr : LREAL; tm : TIME; ltm : LTIME; d : DATE; "
    "td : TOD; dtm : DT; str : STRING; wstr : WSTRING; e : E; sub : INT(0..10); p : POINTER TO INT; "
    "q : POINTER TO BYTE; arr : ARRAY[0..7] OF INT; st : S; r : REFERENCE TO INT; END_VAR"
)
TYPES = "TYPE E : (one, two); END_TYPE TYPE S : STRUCT x : INT; y : REAL; END_STRUCT END_TYPE"


def found(body: str) -> list[str]:
    """Codes of a body with a variable of every type."""
    return codes(program(ALL, body, TYPES))

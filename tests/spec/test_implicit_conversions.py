"""LOPR-01: every pair of simple types is assigned as the table of language_operators.md, section 1, says."""

from __future__ import annotations

import pytest

from tappet.lang.analysis import analyse
from tappet.lang.parser import parse
from tappet.lang.source import Source

_NAMES = (
    "BOOL BYTE WORD DWORD LWORD SINT INT DINT LINT USINT UINT UDINT ULINT REAL LREAL TIME DATE TOD DT STRING "
    "WSTRING"
)
TYPES = _NAMES.split()
SILENT = {
    "SINT": "INT DINT LINT REAL LREAL",
    "INT": "DINT LINT REAL LREAL",
    "DINT": "LINT LREAL",
    "USINT": "BYTE INT UINT WORD DINT UDINT DWORD LINT ULINT LWORD REAL LREAL",
    "UINT": "WORD UDINT ULINT DWORD LWORD DINT LINT REAL LREAL",
    "UDINT": "DWORD ULINT LWORD LINT LREAL",
    "ULINT": "LWORD",
    "REAL": "LREAL",
}
WARNED = {
    "SINT": "USINT BYTE UINT WORD UDINT DWORD ULINT LWORD",
    "INT": "UINT UDINT ULINT WORD DWORD LWORD",
    "DINT": "UDINT ULINT DWORD LWORD REAL",
    "LINT": "ULINT LWORD REAL LREAL",
    "USINT": "SINT",
    "UINT": "INT",
    "UDINT": "DINT REAL",
    "ULINT": "LINT REAL LREAL",
    "LREAL": "REAL",
}
UNSIGNED = {"BYTE": "USINT", "WORD": "UINT", "DWORD": "UDINT", "LWORD": "ULINT"}
"""Bit strings convert as the unsigned integers of their width."""
ABOUT_CONVERSIONS = {"W1001", "W1002", "W1003"}


@pytest.mark.parametrize("source", TYPES)
def test_assignment_of(source: str) -> None:
    row = UNSIGNED.get(source, source)
    silent = {source, row, *SILENT.get(row, "").split()}
    warned = set(WARNED.get(row, "").split())
    expected = {t: "silent" if t in silent else "warning" if t in warned else "error" for t in TYPES}
    variables = "\n".join(f"to{target} : {target};" for target in TYPES)
    lines = [f"to{target} := given;" for target in TYPES]
    head = f"PROGRAM P\nVAR\ngiven : {source};\n{variables}\nEND_VAR\n"
    text = head + "\n".join(lines) + "\nEND_PROGRAM"
    result = parse(Source("P", text))
    assert result.diagnostics == []
    found = dict.fromkeys(TYPES, "silent")
    for message in analyse([result.unit]).diagnostics:
        at = message.span.line - head.count("\n")
        if message.severity == "error":
            found[TYPES[at]] = "error"
        elif message.code in ABOUT_CONVERSIONS:
            found[TYPES[at]] = "warning"
    assert found == expected

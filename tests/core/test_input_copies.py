"""Which strings passed by value are copied, and which are read where the caller has them."""

from __future__ import annotations

import pytest

from tappet.core import ir, passes
from tappet.core.lower import lower
from tappet.iec.task import Task
from tappet.lang.analysis.run import analyse
from tappet.lang.parser import parse
from tappet.lang.source import Source

TEXT = """
VAR_GLOBAL g : STRING(20); END_VAR
FUNCTION Size : INT
VAR_INPUT s : STRING(20); END_VAR
VAR p : POINTER TO BYTE; END_VAR
p := ADR(s);
WHILE p[Size] <> 0 DO Size := Size + 1; END_WHILE
END_FUNCTION
FUNCTION Noise : INT
VAR_INPUT s : STRING(20); END_VAR
g := s;
END_FUNCTION
FUNCTION Out : INT
VAR_INPUT s : STRING(20); END_VAR
VAR_IN_OUT t : STRING(20); END_VAR
Out := Size(s);
END_FUNCTION
FUNCTION F : STRING(20)
VAR_INPUT s, t : STRING(20); q : POINTER TO BYTE; n : INT; END_VAR
VAR p, r : POINTER TO BYTE; d : DWORD; own : STRING(20); a : ARRAY [0..1] OF POINTER TO BYTE; END_VAR
{body}
END_FUNCTION
PROGRAM PLC_PRG
VAR x : STRING(20); END_VAR
x := F(x, x, ADR(x), 1);
END_PROGRAM
"""


def copies(body: str) -> list[int]:
    """Numbers of the parameters that F copies: 1 is `s`, 2 is `t`."""
    unit = parse(Source("a", TEXT.format(body=body)))
    analysis = analyse([unit.unit])
    assert [str(d) for d in [*unit.diagnostics, *analysis.diagnostics] if d.severity == "error"] == []
    module = lower(analysis, [Task("T", programs=("PLC_PRG",))]).module
    passes.run(module)
    found = []
    for statement in module.functions["F"].body:
        if isinstance(statement, ir.Copy) and isinstance(statement.source.base, ir.Indirect):
            pointer = statement.source.base.pointer
            if isinstance(pointer, ir.Argument):
                found.append(pointer.number)
    return found


@pytest.mark.parametrize(
    ("body", "left"),
    [
        ("F := s;", []),
        ("p := ADR(s); r := ADR(F); r[0] := p[0];", []),
        ("p := ADR(s) + n; r := ADR(F); WHILE p^ <> 0 DO r^ := p^; p := p + 1; r := r + 1; END_WHILE", []),
        ("p := ADR(s); p := ADR(t); r := ADR(own); r^ := p^; F := own;", []),
        ("n := Size(s) + Size(t);", []),
        ("p := ADR(s); p^ := 0;", [1]),
        ("d := ADR(s); p := d; p^ := 0;", [1]),
        ("FOR d := ADR(s) TO ADR(s) + 3 DO p := d; p^ := 0; END_FOR", [1]),
        ("s := t;", [1]),
        ("p := ADR(s); q^ := p^;", [1, 2]),
        ("p := ADR(s); g := 'x';", [1, 2]),
        ("n := Size(s); n := Noise(t);", [1, 2]),
        ("n := Out(t, s);", [1]),
        ("a[0] := ADR(s); p := a[0]; p := ADR(t); n := p[0];", [1]),
        ("p := 16#1000; p^ := 0; n := Size(s);", [1, 2]),
    ],
)
def test_copies_left(body: str, left: list[int]):
    assert copies(body) == left

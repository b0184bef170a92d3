"""Inputs that are not copied because of what other bodies leave alone, when an edit changes these."""

from __future__ import annotations

from compiled_programs import running

from tappet.codegen.build import BuildSession, build_application
from tappet.lang.source import Source

READER = """
VAR_GLOBAL g : STRING(20); END_VAR
FUNCTION Keep : STRING(20)
VAR_INPUT s : STRING(20); END_VAR
VAR p : POINTER TO BYTE; END_VAR
p := ADR(s);
Aside();
Keep := s;
END_FUNCTION
PROGRAM PLC_PRG
VAR r : STRING(20); END_VAR
g := 'before';
r := Keep(g);
END_PROGRAM
"""
ASIDE = "FUNCTION Aside : INT\nVAR n : INT; END_VAR\n{body}\nEND_FUNCTION"


def test_an_input_is_copied_once_a_called_function_writes_memory():
    session = BuildSession()
    found = []
    for body in ("n := 1;", "g := 'after'; n := 2;", "n := 3;"):
        sources = [Source("Reader", READER), Source("Aside", ASIDE.format(body=body))]
        built = build_application(sources, session=session)
        assert built.package is not None
        with running(built.package) as application:
            application.cycle()
            found.append((application.read("PLC_PRG.r"), built.partial))
    assert found == [("before", False), ("before", True), ("before", True)]

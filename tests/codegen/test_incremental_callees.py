"""What bodies rest on that were not edited: which blocks have instances, what the bodies they call write."""

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


BLOCKS = """
INTERFACE I_N
METHOD N : INT END_METHOD
END_INTERFACE
FUNCTION_BLOCK FB_A IMPLEMENTS I_N
METHOD N : INT N := 1; END_METHOD
END_FUNCTION_BLOCK
{attribute 'enable_dynamic_creation'}
FUNCTION_BLOCK FB_B IMPLEMENTS I_N
METHOD N : INT N := 20 + PLC_PRG.sum; END_METHOD
END_FUNCTION_BLOCK
FUNCTION Total : INT
VAR_INPUT which : I_N; END_VAR
VAR i : INT; END_VAR
FOR i := 1 TO 3 DO Total := Total + which.N(); END_FOR
END_FUNCTION
"""
MAKER = """
PROGRAM PLC_PRG
VAR_INPUT sum : INT; END_VAR
VAR a : FB_A; p : POINTER TO FB_B; i : I_N; k, r : INT; END_VAR
i := a;
@
FOR k := 1 TO 3 DO sum := sum + i.N(); END_FOR
r := Total(i);
END_PROGRAM
"""


def test_an_edit_makes_the_first_instance_of_another_implementation():
    session = BuildSession()
    found = []
    for body in ("k := 1;", "p := __NEW(FB_B); i := p^;", "k := 2;"):
        sources = [Source("Blocks", BLOCKS), Source("Maker", MAKER.replace("@", body))]
        built = build_application(sources, session=session)
        assert built.package is not None
        with running(built.package) as application:
            application.cycle()
            found.append((application.read("PLC_PRG.sum"), application.read("PLC_PRG.r"), built.partial))
    assert found == [(3, 3, False), (140, 480, True), (3, 3, True)]

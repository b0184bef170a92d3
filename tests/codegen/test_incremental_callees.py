"""What bodies rest on that were not edited: which blocks have instances, what the bodies they call write."""

from __future__ import annotations

import pytest
from edited_application import OPTIONS, messages
from linked_application import loaded

from tappet.codegen.build import BuildResult, BuildSession, build_application
from tappet.codegen.package import CodePackage
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
        with loaded(built.package) as application:
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
        with loaded(built.package) as application:
            application.cycle()
            found.append((application.read("PLC_PRG.sum"), application.read("PLC_PRG.r"), built.partial))
    assert found == [(3, 3, False), (140, 480, True), (3, 3, True)]


CHAIN = """
FUNCTION Pure : DINT
VAR_INPUT n : DINT; END_VAR
{pure}
END_FUNCTION
"""
VIRTUAL = """
FUNCTION_BLOCK FB_A
VAR k : DINT; END_VAR
METHOD M1 : DINT
M1 := 1;
END_METHOD
METHOD M2 : DINT
M2 := 20;
END_METHOD
END_FUNCTION_BLOCK
FUNCTION_BLOCK FB_B EXTENDS FB_A
METHOD M1 : DINT
M1 := 300;
END_METHOD
METHOD M2 : DINT
M2 := 4000;
END_METHOD
END_FUNCTION_BLOCK
PROGRAM PLC_PRG
VAR_INPUT sum : DINT; END_VAR
VAR a : FB_A; b : FB_B; p : POINTER TO FB_A; i : DINT; END_VAR
p := ADR(b);
sum := p^.M1() + p^.M2();
FOR i := 0 TO 9 DO sum := sum + Pure(i); END_FOR
END_PROGRAM
"""


def run_of(session: BuildSession, texts: dict[str, str], *paths: str, partial: bool) -> list[object]:
    built = build_application([Source(n, text) for n, text in texts.items()], (), OPTIONS, None, session)
    assert messages(built) == [m for m in messages(built) if "error" not in m]
    assert built.package is not None
    assert built.partial == partial
    with loaded(built.package) as application:
        application.cycle()
        return [application.read(path) for path in paths]


@pytest.mark.usefixtures("small_modules")
def test_functions_that_rested_on_an_edited_one_keep_their_virtual_calls():
    """PLC_PRG keeps `sum` in a register while it calls Pure; that ends when Pure reads `sum`."""
    session = BuildSession()
    texts = {"Pure": CHAIN.format(pure="Pure := n;"), "Rest": VIRTUAL}
    assert run_of(session, texts, "PLC_PRG.sum", partial=False) == [4300 + 45]
    texts["Pure"] = CHAIN.format(pure="PLC_PRG.sum := PLC_PRG.sum + 1; Pure := n;")
    (changed,) = run_of(session, texts, "PLC_PRG.sum", partial=True)
    assert [changed] == run_of(BuildSession(), texts, "PLC_PRG.sum", partial=False)
    assert isinstance(changed, int)
    assert changed > 4300


BASE = """
FUNCTION_BLOCK FB_Base
VAR_INPUT n : DINT; END_VAR
VAR i : DINT; END_VAR
METHOD Loop
VAR_INPUT p : POINTER TO DINT; END_VAR
FOR i := 0 TO 9 DO n := n + 1; p^ := 100 + i; END_FOR
END_METHOD
END_FUNCTION_BLOCK
PROGRAM PLC_PRG
VAR d : FB_Derived; other : DINT; END_VAR
d.Loop(d.Where());
END_PROGRAM
"""
DERIVED = """
FUNCTION_BLOCK FB_Derived EXTENDS FB_Base
METHOD Where : POINTER TO DINT
{where}
END_METHOD
END_FUNCTION_BLOCK
"""


@pytest.mark.usefixtures("small_modules")
def test_address_taken_in_a_derived_block_reaches_the_base():
    session = BuildSession()
    texts = {"Base": BASE, "Derived": DERIVED.format(where="Where := ADR(PLC_PRG.other);")}
    assert run_of(session, texts, "PLC_PRG.d.n", partial=False) == [10]
    texts["Derived"] = DERIVED.format(where="Where := ADR(n);")
    assert run_of(session, texts, "PLC_PRG.d.n", partial=True) == [109]


DYNAMIC = """
INTERFACE I_Thing
METHOD Name : DINT
END_METHOD
END_INTERFACE
FUNCTION_BLOCK FB_One IMPLEMENTS I_Thing
METHOD Name : DINT
Name := 1;
END_METHOD
END_FUNCTION_BLOCK
{attribute 'enable_dynamic_creation'}
FUNCTION_BLOCK FB_Two IMPLEMENTS I_Thing
METHOD Name : DINT
Name := 2;
END_METHOD
END_FUNCTION_BLOCK
"""
USER = """
PROGRAM PLC_PRG
VAR one : FB_One; p : POINTER TO FB_Two; entity : I_Thing; sum : DINT; END_VAR
entity := one;
%s
sum := entity.Name();
END_PROGRAM
"""


@pytest.mark.usefixtures("small_modules")
def test_block_type_known_from_the_running_application_gets_its_methods():
    texts = {"Things": DYNAMIC, "PLC_PRG": USER % "p := __NEW(FB_Two); entity := p^;"}

    def build(session: BuildSession, previous: CodePackage | None) -> BuildResult:
        return build_application([Source(n, x) for n, x in texts.items()], (), OPTIONS, previous, session)

    old = build(BuildSession(), None).package
    assert old is not None
    new_texts = dict(texts)
    texts["PLC_PRG"] = USER % ""
    session = BuildSession()
    without = build(session, old).package
    assert without is not None
    texts = new_texts
    after = build(session, without)
    assert after.partial
    assert after.package is not None
    with loaded(after.package) as application:
        application.cycle()
        assert application.read("PLC_PRG.sum") == 2

"""SM3_CNC: the lists of the CNC objects of an application. Spec DAT-02, cnc EX-10, EX-11."""

from tests.libraries.st_program import run

PROGRAM = """
PROGRAM Main
VAR
    first, second : SM3_CNC.SMC_OUTQUEUE;
    words         : SM3_CNC.SMC_CNC_REF;
    xBegun, xFull : BOOL;
    pQueue        : POINTER TO SM3_CNC.SMC_OUTQUEUE;
    pProgram      : POINTER TO SM3_CNC.SMC_CNC_REF;
    n, i, iPrograms, iGood : INT; iLeft : INT := -1;
    awTags        : ARRAY[0..3] OF WORD;
    xOutside      : BOOL;
    aMany         : ARRAY[0..199] OF SM3_CNC.SMC_CNC_REF;
END_VAR
IF NOT xBegun THEN
    xBegun := g_CNCQueueManager.Register(ADR(first)) AND g_CNCQueueManager.Register(ADR(second));
    g_CNCQueueManager.Register(ADR(first));
    g_CNCProgManager.Register(ADR(words));
    g_CNCProgManager.Register(0);
END_IF
n := g_CNCQueueManager.Count;
FOR i := 0 TO n - 1 DO
    pQueue := g_CNCQueueManager.GetOutQueue(i);
    awTags[i] := pQueue^.wOUTQUEUEStructID;
END_FOR
iPrograms := g_CNCProgManager.Count;
pProgram := g_CNCProgManager.GetProgram(0);
awTags[3] := pProgram^.wCNCREFStructID;
xOutside := g_CNCQueueManager.GetOutQueue(n) <> 0 OR g_CNCQueueManager.GetOutQueue(-1) <> 0
    OR g_CNCProgManager.GetProgram(1) <> 0;
FOR i := 0 TO 199 DO
    IF g_CNCProgManager.Register(ADR(aMany[i])) THEN
        iGood := iGood + 1;
    END_IF
END_FOR
xFull := g_CNCProgManager.Count = 100;
g_CNCProgManager.Clear();
iLeft := g_CNCProgManager.Count;
END_PROGRAM
"""


def test_the_objects_of_an_application() -> None:
    """Two queues and one program: counted once each, with their tags; none outside, none beyond the room."""
    with run(PROGRAM, cycles=1) as program:
        assert program.literal("Main.xBegun") == "TRUE"
        assert program.literal("Main.n") == "2"
        assert program.literal("Main.iPrograms") == "1"
        tags = program.numbers("Main.awTags")
        assert (tags[0], tags[1], tags[3]) == (0x9878, 0x9878, 0xBA56)
        assert program.literal("Main.xOutside") == "FALSE"
        assert program.literal("Main.iGood") == "99"
        assert program.literal("Main.xFull") == "TRUE"
        assert program.literal("Main.iLeft") == "0"

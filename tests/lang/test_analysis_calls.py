"""Calls, parameters, methods, interfaces, recursion (LST-21..23, LDEC-21..23, LDEC-100..127, POU-02)."""

from __future__ import annotations

import pytest
from resolved import analysed, body_of, codes, messages, program, value_of

from tappet.lang import ast
from tappet.lang import types as t
from tappet.lang.analysis import AnalysisOptions, check_tasks
from tappet.lang.source import Scope, Source
from tappet.lang.symbols import PouSymbol, PropertySymbol, VarSymbol

FUNCTION = (
    "FUNCTION Fct : INT\nVAR_INPUT a : INT; c : INT := 7; END_VAR VAR_IN_OUT io : INT; END_VAR "
    "VAR_OUTPUT o : DINT; END_VAR\nFct := a + c; io := a; o := a;\nEND_FUNCTION"
)
BLOCK = (
    "FUNCTION_BLOCK FB\nVAR_INPUT a : INT; t : TIME; END_VAR VAR_OUTPUT q : BOOL; END_VAR VAR n : "
    "INT; END_VAR\n"
    "q := a > n; n := a;\nMETHOD Up : INT\nVAR_INPUT by : INT; END_VAR\nn := n + by; Up := n;\nEND_METHOD\n"
    "ACTION Zero\nn := 0;\nEND_ACTION\nPROPERTY Level : INT\nGET\nLevel := n;\nEND_GET\nSET\nn := "
    "Level;\nEND_SET\n"
    "END_PROPERTY\nPROPERTY Only : INT\nGET\nOnly := n;\nEND_GET\nEND_PROPERTY\nEND_FUNCTION_BLOCK"
)
VARIABLES = "VAR x, y : INT; d : DINT; b : BOOL; f : FB; p : POINTER TO FB; r : REAL; END_VAR"


def found(body: str, declaration: str = VARIABLES) -> list[str]:
    return codes(program(declaration, body, FUNCTION, BLOCK))


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        ("x := Fct(1, 2, y);", []),
        ("x := Fct(a := 1, io := y);", []),
        ("x := Fct(1, io := y, o => d);", []),
        ("x := Fct(a := 1, c := 2, io := y, o => d);", []),
        ("Fct(1, 2, y);", []),
        ("x := Fct(1, 2, y, o =>);", []),
        ("x := Fct(c := 1, io := y);", ["E0504"]),
        ("x := Fct(1, 2);", ["E0505"]),
        ("x := Fct(1, 2, y, 4);", ["E0503"]),
        ("x := Fct(a := 1, a := 2, io := y);", ["E0509"]),
        ("x := Fct(a := 1, 2, io := y);", []),
        ("x := Fct(a := 1, 2, y);", []),
        ("x := Fct(c := 1, 2, io := y);", ["E0504", "E0512"]),
        ("x := Fct(a := 1, 2, y, 4);", ["E0503"]),
        ("x := Fct(aa := 1, io := y);", ["E0504", "E0502"]),
        ("x := Fct(a := 1, io := 5);", ["E0506"]),
        ("x := Fct(a := 1, io := d);", ["E0507"]),
        ("x := Fct(a := 1, io := d.3);", ["E0508"]),
        ("x := Fct(a := 1, io := y, o := d);", ["E0510"]),
        ("x := Fct(a => x, io := y);", ["E0511"]),
        ("x := Fct(a := 1, io := y, o => x);", ["E0301"]),
        ("x := Fct(a := r, io := y);", ["E0301"]),
        ("x := Fct(a := 1, io := y, o => 5);", ["E0305"]),
        ("x := Fct;", ["E0210"]),
        ("f(a := 1, t := T#1s, q => b); b := f.q;", []),
        ("f(); f(1, T#2s); f.a := 3; x := f.n;", []),
        ("f(a := TRUE);", ["E0301"]),
        ("f.n := 3;", ["E0209"]),
        ("f.q := TRUE;", ["E0209"]),
        ("f.nope := 3;", ["E0204"]),
        ("x := f();", ["E0325"]),
        ("f() := 3;", ["E0325"]),
        ("f.Zero() := 3;", ["E0325"]),
        ("x := f() := 3;", ["E0325"]),
        ("f()();", ["E0325"]),
        ("d := SIZEOF(f());", ["E0325"]),
        ("p := ADR(f());", ["E0325"]),
        ("FB();", ["E0516"]),
        ("p^(a := 1); p^.Up(1); b := p^.q;", []),
        ("p(a := 1);", ["E0501"]),
        ("x := f.Up(1); x := f.Up(by := 2); f.Zero();", []),
        ("x := f.Up();", ["E0504"]),
        ("x := f.Zero();", ["E0325"]),
        ("f.Level := f.Level + 1; x := f.Only;", []),
        ("f.Only := 1;", ["E0424"]),
        ("f.Level := TRUE;", ["E0301"]),
        ("x();", ["E0501"]),
        ("foo(x);", ["E0201"]),
        ("P2(); x := P2.v; P2.v := 1;", ["E0209"]),
    ],
)
def test_calls(body: str, expected: list[str]) -> None:
    other = "PROGRAM P2\nVAR v : INT; END_VAR\nv := v + 1;\nEND_PROGRAM"
    assert codes(program(VARIABLES, body, FUNCTION, BLOCK, other)) == expected


def test_arguments_name_their_parameters() -> None:
    analysis = program(VARIABLES, "x := Fct(1, io := y, o => d);", FUNCTION, BLOCK)
    call = value_of(analysis)
    assert isinstance(call, ast.Call)
    assert isinstance(call.target, PouSymbol)
    assert [a.parameter.name for a in call.args if a.parameter is not None] == ["a", "io", "o"]
    assert (call.type, call.target.kind) == (t.INT, "FUNCTION")


def test_targets_of_instances_methods_and_properties() -> None:
    analysis = program(VARIABLES, "f(); f.Up(1); f.Zero(); x := f.Level;", FUNCTION, BLOCK)
    calls = [s.call for s in body_of(analysis) if isinstance(s, ast.CallStmt)]
    assert [(c.target.kind, c.target.qualified_name) for c in calls if isinstance(c.target, PouSymbol)] == [
        ("FUNCTION_BLOCK", "FB"),
        ("METHOD", "FB.Up"),
        ("ACTION", "FB.Zero"),
    ]
    read = value_of(analysis, 3)
    assert isinstance(read, ast.Member)
    assert isinstance(read.symbol, PropertySymbol)
    assert read.type is t.INT


def test_in_out_of_strings_and_open_arrays() -> None:
    functions = (
        "FUNCTION Fs : INT\nVAR_IN_OUT s : STRING(20); END_VAR\nFs := 1;\nEND_FUNCTION",
        "FUNCTION Fa : INT\nVAR_IN_OUT a : ARRAY[*] OF INT; END_VAR\n"
        "Fa := a[LOWER_BOUND(a, 1)] + DINT_TO_INT(UPPER_BOUND(a, 1));\nEND_FUNCTION",
        "FUNCTION Fc : INT\nVAR_IN_OUT CONSTANT s : STRING; END_VAR\nFc := 1;\nEND_FUNCTION",
    )
    declaration = (
        "VAR s1 : STRING(20); s2 : STRING(80); s3 : STRING(5); a : ARRAY[3..9] OF INT; n : INT; END_VAR"
    )
    assert (
        codes(program(declaration, "n := Fs(s1); n := Fs(s2); n := Fa(a); n := Fc('abc');", *functions)) == []
    )
    assert codes(program(declaration, "n := Fs(s3); n := Fc(5);", *functions)) == ["E0507", "E0301"]


def test_in_out_is_not_accessible_from_outside() -> None:
    block = (
        "FUNCTION_BLOCK FB\nVAR_IN_OUT io : INT; END_VAR\nio := io + 1; THIS^.io := 2;\nEND_FUNCTION_BLOCK"
    )
    analysis = program("VAR f : FB; x : INT; END_VAR", "f(io := x); x := f.io;", block)
    assert messages(analysis) == ["No external access to 'VAR_IN_OUT' parameter 'io' of 'FB'"]


def test_protected_variables_are_no_in_outs() -> None:
    block = "FUNCTION_BLOCK FB\nVAR_IN_OUT io : INT; END_VAR\nio := 1;\nEND_FUNCTION_BLOCK"
    declaration = "VAR f : FB; i AT %IW0 : INT; END_VAR VAR CONSTANT c : INT := 1; END_VAR"
    assert codes(program(declaration, "f(io := c); f(io := i); f(io := f);", block)) == [
        "E0506",
        "E0506",
        "E0507",
    ]


def test_references() -> None:
    declaration = "VAR r : REFERENCE TO INT; q : REFERENCE TO INT REF= x; x : INT; d : DINT; END_VAR"
    good = "r REF= x; r := 5; x := r * 2; r REF= 0; q REF= r;"
    assert codes(program(declaration, good)) == ["W1205"]
    bad = "r REF= d; r REF= 5; x REF= r; r REF= x + 1;"
    assert codes(program(declaration, bad)) == ["W1205", "E0301", "E0319", "E0320", "E0319"]


def test_methods_see_their_block() -> None:
    analysis = analysed(
        "FUNCTION_BLOCK Base\nVAR n : INT; END_VAR VAR_TEMP tmp : INT; END_VAR\ntmp := n; Step();\n"
        "METHOD Step\nn := n + 1; THIS^.n := SUPERFLUOUS();\nEND_METHOD\n"
        "METHOD SUPERFLUOUS : INT\nSUPERFLUOUS := tmp;\nEND_METHOD\nEND_FUNCTION_BLOCK"
    )
    assert messages(analysis) == ["Identifier 'tmp' not defined"]


def test_inheritance_super_and_this() -> None:
    texts = (
        "FUNCTION_BLOCK Base\nVAR n : INT; END_VAR\nn := 1;\nMETHOD M : INT\nM := "
        "n;\nEND_METHOD\nEND_FUNCTION_BLOCK",
        "FUNCTION_BLOCK Child EXTENDS Base\nVAR k : INT; END_VAR\nSUPER^(); k := SUPER^.M() + "
        "THIS^.M() + M() + n;\n"
        "METHOD M : INT\nM := SUPER^.M() + k;\nEND_METHOD\nEND_FUNCTION_BLOCK",
    )
    declaration = "VAR c : Child; p : POINTER TO Base; b : Base; x : INT; END_VAR"
    analysis = program(declaration, "p := ADR(c); x := p^.M(); b := c; x := c.M();", *texts)
    assert codes(analysis) == []
    child = next(p for p in analysis.pous if p.name == "Child")
    assert {k: v.qualified_name for k, v in child.vtable.items()} == {"__BODY": "Child", "M": "Child.M"}


@pytest.mark.parametrize(
    ("text", "code"),
    [
        ("PROGRAM Q\nSUPER^();\nEND_PROGRAM", "E0214"),
        ("FUNCTION_BLOCK Q\nSUPER^();\nEND_FUNCTION_BLOCK", "E0215"),
        ("FUNCTION Q : INT\nQ := THIS^.x;\nEND_FUNCTION", "E0214"),
        (
            "FUNCTION_BLOCK A EXTENDS F1\nEND_FUNCTION_BLOCK\nFUNCTION F1 : INT\nF1 := 1;\nEND_FUNCTION",
            "E0417",
        ),
        (
            "FUNCTION_BLOCK FINAL A\nEND_FUNCTION_BLOCK\nFUNCTION_BLOCK B EXTENDS A\nEND_FUNCTION_BLOCK",
            "E0426",
        ),
        (
            "FUNCTION_BLOCK ABSTRACT A\nEND_FUNCTION_BLOCK\nFUNCTION_BLOCK B\nVAR a : A; "
            "END_VAR\nEND_FUNCTION_BLOCK",
            "E0425",
        ),
        (
            "FUNCTION_BLOCK A\nMETHOD PRIVATE M\nEND_METHOD\nEND_FUNCTION_BLOCK\n"
            "FUNCTION_BLOCK B\nVAR a : A; END_VAR\na.M();\nEND_FUNCTION_BLOCK",
            "E0213",
        ),
        (
            "FUNCTION_BLOCK A\nMETHOD M : INT\nM := 1;\nEND_METHOD\nEND_FUNCTION_BLOCK\n"
            "FUNCTION_BLOCK B EXTENDS A\nMETHOD M : REAL\nM := 1;\nEND_METHOD\nEND_FUNCTION_BLOCK",
            "E0419",
        ),
        (
            "FUNCTION_BLOCK A\nVAR x : INT; END_VAR\nMETHOD M\nEND_METHOD\nMETHOD "
            "m\nEND_METHOD\nEND_FUNCTION_BLOCK",
            "E0205",
        ),
    ],
)
def test_faulty_object_orientation(text: str, code: str) -> None:
    assert code in codes(analysed(text))


INTERFACES = (
    "INTERFACE IBase EXTENDS __System.IQueryInterface\nMETHOD mb : BOOL\nEND_METHOD\nPROPERTY v : "
    "INT\nGET\nEND_GET\n"
    "END_PROPERTY\nEND_INTERFACE",
    "INTERFACE IMore EXTENDS IBase\nMETHOD mm : INT\nVAR_INPUT a : INT; END_VAR\nEND_METHOD\nEND_INTERFACE",
    "FUNCTION_BLOCK FB IMPLEMENTS IMore\nMETHOD mb : BOOL\nmb := TRUE;\nEND_METHOD\nMETHOD mm : INT\n"
    "VAR_INPUT a : INT; END_VAR\nmm := a;\nEND_METHOD\nPROPERTY v : INT\nGET\nv := "
    "1;\nEND_GET\nEND_PROPERTY\n"
    "END_FUNCTION_BLOCK",
    "FUNCTION_BLOCK Other\nEND_FUNCTION_BLOCK",
)
ITF_VARIABLES = "VAR f : FB; o : Other; b : IBase; m : IMore; x : INT; ok : BOOL; p : POINTER TO FB; END_VAR"


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        ("b := f; m := f; b := m; b := 0; ok := b <> 0; ok := b = m;", []),
        ("ok := b.mb(); x := m.mm(a := 3); x := b.v; ok := m.mb();", []),
        ("m := b;", ["E0301"]),
        ("b := o;", ["E0301"]),
        ("x := b.mm(3);", ["E0204"]),
        ("b.v := 1;", ["E0424"]),
        ("ok := __QUERYINTERFACE(b, m); ok := __QUERYINTERFACE(f, m); ok := __QUERYPOINTER(b, p);", []),
        ("ok := __QUERYINTERFACE(x, m);", ["E0521"]),
        ("ok := __QUERYINTERFACE(b, x);", ["E0521"]),
    ],
)
def test_interfaces(body: str, expected: list[str]) -> None:
    assert codes(program(ITF_VARIABLES, body, *INTERFACES)) == expected


def test_missing_members_of_an_interface() -> None:
    analysis = analysed(
        *INTERFACES[:2],
        "FUNCTION_BLOCK Bad IMPLEMENTS IMore\nMETHOD mb : INT\nmb := 1;\nEND_METHOD\nEND_FUNCTION_BLOCK",
    )
    assert messages(analysis) == [
        "Method 'mb' differs from the one of 'IMore': it returns 'INT' instead of 'BOOL'",
        "function block 'Bad' does not implement method 'mm' of interface 'IMore'",
        "function block 'Bad' does not implement property 'v' of interface 'IMore'",
    ] or set(codes(analysis)) == {"E0418", "E0419"}


def test_fb_init_arguments() -> None:
    """LDEC-102."""
    block = (
        "FUNCTION_BLOCK Dev\nVAR_OUTPUT port : INT; END_VAR\nMETHOD FB_Init : BOOL\n"
        "VAR_INPUT bInitRetains : BOOL; bInCopyCode : BOOL; n : INT; END_VAR\nport := "
        "n;\nEND_METHOD\nEND_FUNCTION_BLOCK"
    )
    analysis = program(
        "VAR a : Dev(n := 1); b : Dev(2) := (port := 3); c : ARRAY[0..1] OF Dev(n := 3); END_VAR", "", block
    )
    assert codes(analysis) == []
    assert codes(program("VAR a : Dev; END_VAR", "", block)) == ["E0421"]
    assert codes(program("VAR a : Dev(n := TRUE); END_VAR", "", block)) == ["E0301"]
    assert codes(
        program("VAR a : INT; b : Other(1); END_VAR", "", "FUNCTION_BLOCK Other\nEND_FUNCTION_BLOCK")
    ) == ["E0503"]


def test_dynamic_creation() -> None:
    """LOPR-100..103."""
    texts = (
        "{attribute 'enable_dynamic_creation'}\nFUNCTION_BLOCK Dyn\nEND_FUNCTION_BLOCK",
        "FUNCTION_BLOCK Plain\nEND_FUNCTION_BLOCK",
        "TYPE S : STRUCT a : INT; END_STRUCT END_TYPE",
    )
    declaration = (
        "VAR d : POINTER TO Dyn; ps : POINTER TO S; b : POINTER TO BYTE; q : POINTER TO "
        "Plain; n : INT; END_VAR"
    )
    good = (
        "d := __NEW(Dyn); ps := __NEW(S); b := __NEW(BYTE, 25); b := __NEW(BYTE, n); __DELETE(d); "
        "b[24] := 125;"
    )
    assert codes(program(declaration, good, *texts)) == []
    bad = "q := __NEW(Plain); __NEW(BYTE, 4); b := __NEW(BYTE); __DELETE(n); b := __NEW(Nope);"
    assert codes(program(declaration, bad, *texts)) == ["E0427", "E0519", "E0323", "E0201", "E0202"]


@pytest.mark.parametrize(
    ("texts", "chain", "code"),
    [
        (("FUNCTION F : INT\nVAR_INPUT a : INT; END_VAR\nF := F(1);\nEND_FUNCTION",), "F -> F", "E0515"),
        (
            (
                "FUNCTION A : INT\nA := B();\nEND_FUNCTION",
                "FUNCTION B : INT\nB := C();\nEND_FUNCTION",
                "FUNCTION C : INT\nC := A();\nEND_FUNCTION",
            ),
            "A -> B -> C -> A",
            "E0515",
        ),
        (("PROGRAM P1\nP2();\nEND_PROGRAM", "PROGRAM P2\nP1();\nEND_PROGRAM"), "P1 -> P2 -> P1", "E0515"),
        (
            (
                "FUNCTION_BLOCK FB\nVAR n : POINTER TO FB; END_VAR\nMETHOD "
                "Walk\nn^.Walk();\nEND_METHOD\nEND_FUNCTION_BLOCK",
            ),
            "FB.Walk -> FB.Walk",
            "W1117",
        ),
    ],
)
def test_recursion_is_reported_with_its_chain(texts: tuple[str, ...], chain: str, code: str) -> None:
    analysis = analysed(*texts)
    assert codes(analysis) == [code]
    assert chain in messages(analysis)[0]


def test_libraries_may_use_intrinsics() -> None:
    source = Source("L/F", "FUNCTION F : LINT\nF := __CALL(1);\nEND_FUNCTION", Scope.LIBRARY, library="L")
    assert codes(analysed(source)) == []
    assert codes(analysed(source, options=AnalysisOptions(system=True))) == []


class _Task:
    """A task with defaults."""

    watchdog = None

    def __init__(self, name: str, programs: tuple[str, ...] = ("P",), **facts: object) -> None:
        self.name = name
        self.programs = programs
        self.kind = str(facts.get("kind", "cyclic"))
        interval, priority = facts.get("interval_ns", 10_000_000), facts.get("priority", 1)
        assert isinstance(interval, int)
        assert isinstance(priority, int)
        self.interval_ns, self.priority = interval, priority
        event = facts.get("event")
        self.event = None if event is None else str(event)


@pytest.mark.parametrize(
    ("tasks", "expected"),
    [
        ([_Task("T")], []),
        ([_Task("T", priority=32)], ["E0702"]),
        ([_Task("T"), _Task("t")], ["E0703"]),
        ([_Task("T", ("PP",))], ["E0701", "W1403"]),
        ([_Task("T", ("Fct",))], ["E0709", "W1403"]),
        ([_Task("T", ())], ["W1402", "W1403"]),
        ([_Task("T", kind="hourly")], ["E0708", "W1401"]),
        ([_Task("T", interval_ns=0)], ["E0706"]),
        ([_Task("T"), _Task("E", kind="event", event="G.go")], []),
        ([_Task("T"), _Task("E", kind="status", event="P.b")], []),
        ([_Task("T"), _Task("E", kind="event", event="go")], []),
        ([_Task("T"), _Task("E", kind="event", event="G.n.3")], []),
        ([_Task("T"), _Task("E", kind="event", event="G.n")], ["E0705"]),
        ([_Task("T"), _Task("E", kind="event", event="G.nope")], ["E0704"]),
        ([_Task("T"), _Task("E", kind="event", event="1 +")], ["E0704"]),
        ([_Task("T"), _Task("E", kind="event")], ["E0707"]),
        ([_Task("E", kind="event", event="G.go")], ["W1401"]),
        ([], ["E0219"]),
    ],
)
def test_task_configuration(tasks: list[_Task], expected: list[str]) -> None:
    gvl = Source("G", "VAR_GLOBAL go : BOOL; n : INT; END_VAR", name="G")
    analysis = program(VARIABLES, "", FUNCTION, BLOCK, gvl)
    found = [d.code for d in check_tasks(tasks, analysis)]
    assert [code for code in found if code != "W1404"] == expected


def test_an_unknown_program_names_task_and_suggestion() -> None:
    analysis = analysed("PROGRAM Main\nEND_PROGRAM")
    message = str(check_tasks([_Task("Fast", ("Mainn",))], analysis)[0])
    assert message.endswith("Task 'Fast': program 'Mainn' does not exist. Did you mean 'Main'?")


def test_no_tasks_but_the_main_program() -> None:
    assert check_tasks([], analysed("PROGRAM PLC_PRG\nEND_PROGRAM")) == []


def test_symbols_of_variables_say_where_they_live() -> None:
    analysis = analysed(BLOCK, FUNCTION)
    function = next(p for p in analysis.pous if p.name == "Fct")
    storages = {v.name: v.storage.value for v in function.locals.values() if isinstance(v, VarSymbol)}
    assert storages == {
        "a": "parameter",
        "c": "parameter",
        "io": "parameter",
        "o": "parameter",
        "Fct": "result",
    }

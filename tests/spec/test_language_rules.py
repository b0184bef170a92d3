"""Rules of the language documents that no worked example covers: one small program each."""

from __future__ import annotations

from dataclasses import dataclass, field

import pytest
from linked_application import ApplicationFault, LoadedApplication
from tests.spec.language_cases import Outcome, guarded

from tappet.codegen.build import BuildOptions, BuildResult, BuildSession, build_application
from tappet.lang.source import Source

SESSION = BuildSession()


@dataclass
class Rule:
    """A program and what must come of it."""

    ids: str
    variables: str
    code: str
    values: dict[str, str] = field(default_factory=dict)
    error: str = ""
    warning: str = ""
    fault: str = ""
    others: tuple[str, ...] = ()
    cycles: int = 1


FB = "FUNCTION_BLOCK FB VAR_INPUT i : INT; END_VAR VAR_OUTPUT o : INT; END_VAR VAR n : INT; END_VAR o := i; END_FUNCTION_BLOCK"  # noqa: E501
RULES = [
    Rule("LDEC-04", "A, B : INT := 2;", "", {"A": "2", "B": "2"}),
    Rule(
        "LDEC-20 local variables survive in programs, not in functions",
        "n, a, b : INT;",
        "n := n + 1; a := F(); b := F();",
        {"n": "3", "a": "1", "b": "1"},
        others=("FUNCTION F : INT VAR n : INT; END_VAR n := n + 1; F := n; END_FUNCTION",),
        cycles=3,
    ),
    Rule("LDEC-20 not written from outside", "fb : FB;", "fb.n := 3;", error="E0209", others=(FB,)),
    Rule("LDEC-30 is not implemented", "", "F(1, 2);", error="E0113",
         others=("FUNCTION F : INT VAR_INPUT p : PARAMS OF INT; END_VAR F := 1; END_FUNCTION",)),
    Rule("LTYP-65", "r : REFERENCE TO INT; x : INT;", "x := r;", fault="null"),
    Rule("LTYP-75", "p : POINTER TO BYTE; ok : BOOL;", "p := ADR(F); ok := p <> 0;", {"ok": "TRUE"},
         others=("FUNCTION F : INT VAR_INPUT x : INT; END_VAR F := x; END_FUNCTION",)),
    Rule("LTYP-76", "d : DWORD; x : INT;", "d := ADR(x);", warning="W1302"),
    Rule("LTYP-77", "p : POINTER TO INT; x : INT;", "x := p^;", fault="null"),
    Rule("LTYP-95", "a : ARRAY[0..2] OF INT := [1, 2, 3]; b : ARRAY[0..2] OF INT;", "b := a; a[1] := 9;",
         {"b[0]": "1", "b[1]": "2", "b[2]": "3"}),
    Rule("LTYP-95 only of identical type", "a : ARRAY[0..2] OF INT; b : ARRAY[0..3] OF INT;", "b := a;",
         error="E0301"),
    Rule("LTYP-104", "d : D;", "d.x := 3; d.y := d.x + 1;", {"d.x": "3", "d.y": "4"},
         others=("TYPE B : STRUCT x : INT; END_STRUCT END_TYPE",
                 "TYPE D EXTENDS B : STRUCT y : INT; END_STRUCT END_TYPE")),
    Rule("LTYP-105", "s : S; n : INT;", "n := SIZEOF(s);", {"n": "24"},
         others=("TYPE S : STRUCT a : BYTE; b : DINT; c : BYTE; d : LREAL; END_STRUCT END_TYPE",)),
    Rule("LTYP-130", "m : T_Message;", "m := 'abc';", {"m": "'abc'"},
         others=("TYPE T_Message : STRING(50); END_TYPE",)),
    Rule("LOPR-04 LOPR-19", "a : INT; b : LREAL;", "a := -2 * -3 - -1; b := 0.1 + 0.2;",
         {"a": "7", "b": "0.30000000000000004"}),
    Rule("LOPR-06 LOPR-24", "a, b, c : BYTE;",
         "a := ANDN(16#F0, 16#30); b := ORN(16#00, 16#F0); c := XORN(16#FF, 16#0F);",
         {"a": "192", "b": "15", "c": "15"}),
    Rule("LOPR-63", "fb : FB_Self; ok : BOOL;", "fb(); ok := fb.p = ADR(fb);", {"ok": "TRUE"},
         others=("FUNCTION_BLOCK FB_Self VAR_OUTPUT p : POINTER TO FB_Self; END_VAR"
                 " p := ADRINST(); END_FUNCTION_BLOCK",)),
    Rule("LOPR-106", "fb : FB_I; itf : I; p : POINTER TO FB_I; ok : BOOL; n : INT;",
         "itf := fb; fb.n := 5; ok := __QUERYPOINTER(itf, p); n := p^.n;", {"ok": "TRUE", "n": "5"},
         others=("INTERFACE I EXTENDS __System.IQueryInterface END_INTERFACE",
                 "FUNCTION_BLOCK FB_I IMPLEMENTS I VAR_INPUT n : INT; END_VAR END_FUNCTION_BLOCK")),
    Rule("LST-02", "a : INT;", "a (* one (* nested *) comment *) := // to the end\n 3; (* over\nlines *)",
         {"a": "3"}),
    Rule("LST-03", "a, b : INT; arr : ARRAY[0..3] OF INT := [1, 2, 3, 4];",
         "%MW100 := 5; a := arr[1] + %MW100 * (b := 2) - F(arr[3]);", {"a": "8", "b": "2"},
         others=("FUNCTION F : INT VAR_INPUT x : INT; END_VAR F := x; END_FUNCTION",)),
    Rule("LST-10", "a : INT;", "a := 3；", error="E0001"),
    Rule("LST-05 both operands are evaluated", "a, b : BOOL; n : INT;",
         "a := FALSE AND Counted(n); b := TRUE OR Counted(n);", {"n": "2"},
         others=("FUNCTION Counted : BOOL VAR_IN_OUT n : INT; END_VAR n := n + 1; Counted := TRUE;"
                 " END_FUNCTION",)),
    Rule("LST-07 LOPR-121", "r : INT;", "r := Fct(7) + 3;", {"r": "17"},
         others=("FUNCTION Fct : INT VAR_INPUT x : INT; END_VAR Fct := 2 * x; END_FUNCTION",)),
    Rule("LST-33", "a : INT;", "a := 1; EXIT;", error="E0801"),
    Rule("LST-34", "i, n : INT;",
         "WHILE i < 5 DO i := i + 1; IF i = 3 THEN CONTINUE; END_IF n := n + i; END_WHILE",
         {"n": "12"}),
    Rule("LST-35 into a loop", "i : INT;", "JMP inside; FOR i := 1 TO 3 DO inside: i := i + 1; END_FOR",
         error="E0802"),
    Rule("LST-35 into a branch", "i : INT;", "IF i = 0 THEN JMP other; ELSE other: i := 2; END_IF",
         error="E0802"),
    Rule("LST-35 out of a loop", "i, n : INT;",
         "FOR i := 1 TO 9 DO IF i = 4 THEN JMP done; END_IF n := i; END_FOR done: n := n * 10;",
         {"n": "30", "i": "4"}),
    Rule("LPRG-01 LPRG-04", "{ATTRIBUTE 'hide'}\n a : INT; b : INT; {attribute 'hide'}", "a := 1; b := 2;",
         {"a": "1", "b": "2"}),
    Rule("LPRG-02", "a {attribute 'hide'} : INT;", "a := 1; {info 'x'}\n{info 'y'}\na := a + 1;", {"a": "2"}),
    Rule("LPRG-12", "a : INT;", "{warning 2 'look here'}\na := 1;", {"a": "1"}, warning="look here"),
    Rule("LPRG-14", "a : INT;", "{IF defined (nothing)}\n{error 'not shown'}\n{END_IF}\na := 1;", {"a": "1"}),
    Rule("LPRG-27", "fb : FB_N; s : STRING;", "s := fb.name;", {"s": "'PLC_PRG.fb'"},
         others=("{attribute 'reflection'}\nFUNCTION_BLOCK FB_N VAR_OUTPUT\n{attribute 'no_init'}\n"
                 "{attribute 'init_namespace'}\nname : STRING;\nEND_VAR END_FUNCTION_BLOCK",)),
    Rule("LDEC-29", "", "", others=("PROGRAM Q VAR_ACCESS END_VAR END_PROGRAM",)),
    Rule("LDEC-95", "b AT %QX0.0 : BOOL; fb : FB_Q; atonce, later : BOOL;",
         "b := TRUE; atonce := %QX0.0; fb(); later := %QX1.0;", {"atonce": "TRUE", "later": "FALSE"},
         others=("FUNCTION_BLOCK FB_Q VAR q AT %Q* : BOOL; END_VAR q := TRUE; END_FUNCTION_BLOCK",
                 "VAR_CONFIG PLC_PRG.fb.q AT %QX1.0 : BOOL; END_VAR")),
    Rule("LDEC-95 at the end of the task", "fb : FB_Q; later : BOOL;", "fb(); later := %QX1.0;",
         {"later": "TRUE"}, cycles=2,
         others=("FUNCTION_BLOCK FB_Q VAR q AT %Q* : BOOL; END_VAR q := TRUE; END_FUNCTION_BLOCK",
                 "VAR_CONFIG PLC_PRG.fb.q AT %QX1.0 : BOOL; END_VAR")),
]  # fmt: skip


def build(rule: Rule) -> BuildResult:
    main = f"PROGRAM PLC_PRG\nVAR\n{rule.variables}\nEND_VAR\n{rule.code}\nEND_PROGRAM"
    sources = [Source(f"text{n}", text, name=f"Text{n}") for n, text in enumerate((main, *rule.others))]
    return build_application(sources, session=SESSION, options=BuildOptions(level=1))


@pytest.mark.parametrize("rule", RULES, ids=[rule.ids for rule in RULES])
def test_rule(rule: Rule) -> None:
    result = build(rule)
    errors = [d for d in result.diagnostics if d.severity == "error"]
    if rule.error:
        assert rule.error in [d.code for d in errors], [str(d) for d in errors]
        return
    assert [str(d) for d in errors] == []
    if rule.warning:
        assert any(rule.warning in (d.code, d.message) for d in result.diagnostics)

    def work() -> Outcome:
        assert result.package is not None
        application = LoadedApplication(result.package)
        try:
            application.start()
            for _ in range(rule.cycles):
                application.cycle()
        except ApplicationFault as fault:
            return Outcome([], [], str(fault), {})
        return Outcome([], [], None, {path: application.literal(f"PLC_PRG.{path}") for path in rule.values})

    outcome = guarded(work)
    if rule.fault:
        assert outcome.fault is not None
        assert rule.fault in outcome.fault.lower() or "signal 11" in outcome.fault
        return
    assert outcome.fault is None
    assert outcome.values == rule.values


@pytest.mark.parametrize("words", ["PERSISTENT", "PERSISTENT RETAIN", "RETAIN PERSISTENT"])
def test_forms_of_persistent_lists(words: str) -> None:
    """LDEC-73."""
    lists = Source("P", f"VAR_GLOBAL {words}\n a : INT; b : DINT;\nEND_VAR", name="Kept")
    result = build_application([lists, Source("M", "PROGRAM PLC_PRG\na := a + 1;\nEND_PROGRAM")])
    assert result.package is not None
    assert [item.path for item in result.package.persistent] == ["Kept.a", "Kept.b"]
    assert result.package.retain == []


def test_only_the_marked_variables_of_a_block_are_retained() -> None:
    """LDEC-76, storage kind 1."""
    block = "FUNCTION_BLOCK FB VAR a : INT; END_VAR VAR RETAIN r : INT; END_VAR a := r; END_FUNCTION_BLOCK"
    main = "PROGRAM PLC_PRG VAR one, two : FB; END_VAR\none(); two();\nEND_PROGRAM"
    result = build_application([Source("B", block), Source("M", main)])
    assert result.package is not None
    assert [item.path for item in result.package.retain] == ["PLC_PRG.one.r", "PLC_PRG.two.r"]

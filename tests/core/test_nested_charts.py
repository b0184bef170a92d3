"""Charts in actions and methods: each has its own steps in every instance (LSFC-07, section 6)."""

from __future__ import annotations

from chart_runs import Run, chart

INNER = """
INITIAL_STEP Init: InA(N); END_STEP
STEP Work: InB(N); END_STEP
TRANSITION FROM Init TO Work := TRUE; END_TRANSITION
TRANSITION FROM Work TO Init := back; END_TRANSITION
"""
COUNTERS = "ACTION InA: inA_ := inA_ + 1; END_ACTION\nACTION InB: inB_ := inB_ + 1; END_ACTION"


def test_chart_in_an_action_of_a_chart() -> None:
    run = Run(
        chart(
            f"""
INITIAL_STEP Init: END_STEP
STEP Run: Nested(N); END_STEP
TRANSITION FROM Init TO Run := TRUE; END_TRANSITION
TRANSITION FROM Run TO Init := stop; END_TRANSITION
ACTION Nested: {INNER} END_ACTION
{COUNTERS}""",
            "inA_, inB_ : INT; back, stop : BOOL;",
        )
    )
    run.call()  # the outer chart is in its own initial step
    assert (run["inA_"], run["inB_"], run["Init.x"]) == ("0", "0", "TRUE")
    run.call(4)
    assert (run["Init.x"], run["Run.x"], run["Nested.Work.x"], run["Nested.Init.x"]) == (
        "FALSE", "TRUE", "TRUE", "FALSE",
    )  # fmt: skip
    assert int(run["inB_"]) == 3
    run["back"] = "TRUE"
    run.call(2)
    assert run["Nested.Init.x"] == "TRUE"


def test_chart_in_an_action_of_several_instances() -> None:
    run = Run(
        f"""PROGRAM P
VAR a, b : FB; END_VAR
a.Cycle();
IF a.inB_ > 1 THEN b.Cycle(); END_IF
END_PROGRAM
FUNCTION_BLOCK FB
VAR inA_, inB_ : INT; back : BOOL; END_VAR
ACTION Cycle: {INNER} END_ACTION
{COUNTERS}
END_FUNCTION_BLOCK"""
    )
    run.call(4)
    assert (run["a.inA_"], run["a.inB_"]) == ("2", "3")
    assert (run["b.inA_"], run["b.inB_"]) == ("2", "1")


def test_chart_in_a_method_keeps_its_steps() -> None:
    run = Run(
        """PROGRAM P
VAR a, b : FB; got : INT; END_VAR
got := a.Next(TRUE);
b.Next(FALSE);
END_PROGRAM
FUNCTION_BLOCK FB
VAR visits : INT; END_VAR
METHOD Next : INT
VAR_INPUT go : BOOL; END_VAR
INITIAL_STEP S: END_STEP
STEP T: Visit(P1); END_STEP
TRANSITION FROM S TO T := go; END_TRANSITION
TRANSITION FROM T TO S := NOT go; END_TRANSITION
END_METHOD
ACTION Visit: visits := visits + 1; END_ACTION
END_FUNCTION_BLOCK"""
    )
    run.call(3)
    assert (run["a.Next.T.x"], run["b.Next.T.x"], run["b.Next.S.x"]) == ("TRUE", "FALSE", "TRUE")
    assert (run["a.visits"], run["b.visits"]) == ("1", "0")

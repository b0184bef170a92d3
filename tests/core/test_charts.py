"""Charts call by call on virtual time, 10 ms apart: the examples and rules of language_sfc.md."""

from __future__ import annotations

import pytest
from chart_runs import SESSION, Run, chart
from linked_application import loaded

from tappet.codegen.build import BuildOptions, build_application
from tappet.lang.source import Source


def test_linear_chain() -> None:
    """language_sfc EX-01; LSFC-01, -02, -12, LSFC-20, LSFC-30, LSFC-40, LSFC-50, -52, -55, -56."""
    run = Run(
        chart(
            """
INITIAL_STEP Init: A(N); END_STEP
STEP Step2: B(N); END_STEP
TRANSITION t1 FROM Init TO Step2 := go; END_TRANSITION
TRANSITION FROM Step2 TO Init := FALSE; END_TRANSITION
ACTION A: nA := nA + 1; END_ACTION
ACTION B: nB := nB + 1; END_ACTION""",
            "go : BOOL; nA, nB : INT;",
        )
    )
    rows = []
    for call in range(1, 6):
        if call == 3:
            run["go"] = "TRUE"
        a, b = run["nA"], run["nB"]
        run.call()
        row = (run["Init.x"], run["Step2.x"], run["nA"] != a, run["nB"] != b, run["_A._x"], run["_A.x"])
        rows.append(row)
        if call == 3:
            assert run["Step2._x"] == "TRUE"
    assert rows == [
        ("TRUE", "FALSE", True, False, "TRUE", "TRUE"),
        ("TRUE", "FALSE", True, False, "TRUE", "TRUE"),
        ("TRUE", "FALSE", True, False, "TRUE", "TRUE"),
        ("FALSE", "TRUE", True, True, "FALSE", "TRUE"),
        ("FALSE", "TRUE", False, True, "FALSE", "FALSE"),
    ]


QUALIFIERS = [
    ("N", [2, 3, 4, 5, 6], 7),  # LSFC-30
    ("S", [*range(2, 12)], 12),  # LSFC-32
    ("P", [2], 3),  # LSFC-35
    ("L, T#25MS", [2, 3, 4], 5),  # LSFC-33
    ("D, T#25MS", [5, 6], 7),  # LSFC-34
    ("D, T#60MS", [], None),
    ("SD, T#45MS", [*range(7, 12)], 12),  # LSFC-36
    ("DS, T#25MS", [*range(5, 12)], 12),  # LSFC-37
    ("DS, T#60MS", [], None),
    ("SL, T#75MS", [*range(2, 10)], 10),  # LSFC-38
    ("SL, T#200MS", [*range(2, 12)], 12),
]


@pytest.mark.parametrize(("qualifier", "active", "last"), QUALIFIERS)
def test_qualifiers(qualifier: str, active: list[int], last: int | None) -> None:
    """language_sfc EX-02; LSFC-30..LSFC-42: S1 is active in calls 2..6, S2 in 7..11, S3 with R from 12 on."""
    run = Run(
        chart(
            f"""
INITIAL_STEP S0: Count(STEP); END_STEP
STEP S1: Act({qualifier}); lamp({qualifier}); Count(STEP); END_STEP
STEP S2: Count(STEP); END_STEP
STEP S3: Act(R); lamp(R); Count(STEP); END_STEP
TRANSITION FROM S0 TO S1 := TRUE; END_TRANSITION
TRANSITION FROM S1 TO S2 := call_ >= 6; END_TRANSITION
TRANSITION FROM S2 TO S3 := call_ >= 11; END_TRANSITION
TRANSITION FROM S3 TO S0 := FALSE; END_TRANSITION
ACTION Count: call_ := call_ + 1; END_ACTION
ACTION Act: executed := executed + 1; END_ACTION""",
            "executed : INT; lamp : BOOL;",
        )
    )
    states, executions = [], []
    for number in range(1, 16):
        before = int(run["executed"])
        run.call()
        if run["_Act._x"] == "TRUE":
            states.append(number)
        if int(run["executed"]) > before:
            executions.append(number)
        assert (run["lamp"] == "TRUE") is (number in active), "LSFC-41"
    assert states == active
    assert executions == [*active, *([last] if last is not None else [])]


def test_pulses_at_both_ends() -> None:
    """P1 and P0 execute once, in the first call of the step and in the call after its last one."""
    run = Run(
        chart(
            """
INITIAL_STEP S0: END_STEP
STEP S1: Begin(P1); Finish(P0); Count(N); END_STEP
TRANSITION FROM S0 TO S1 := TRUE; END_TRANSITION
TRANSITION FROM S1 TO S0 := call_ = 3; END_TRANSITION
ACTION Count: call_ := call_ + 1; END_ACTION
ACTION Begin: b := b + 1; END_ACTION
ACTION Finish: f := f + 1; END_ACTION""",
            "b, f : INT;",
        )
    )
    seen = []
    for _ in range(6):
        run.call()
        seen.append((run["b"], run["f"]))
    assert seen == [("0", "0"), ("1", "0"), ("1", "0"), ("1", "0"), ("1", "1"), ("2", "1")]


def test_entry_step_and_exit_actions() -> None:
    """LSFC-04, LSFC-11, LSFC-12, LSFC-05: the exit action runs in the call after the transition."""
    run = Run(
        chart(
            """
INITIAL_STEP S0: E0(ENTRY); X0(EXIT); END_STEP
STEP S1: E1(ENTRY); M1(STEP); X1(EXIT); END_STEP
TRANSITION FROM S0 TO S1 := S0.t >= T#10ms; END_TRANSITION
TRANSITION FROM S1 TO S0 := n = 2; END_TRANSITION
ACTION E0: log := log * 10 + 1; END_ACTION
ACTION X0: log := log * 10 + 2; END_ACTION
ACTION E1: log := log * 10 + 3; n := 0; END_ACTION
ACTION M1: log := log * 10 + 4; n := n + 1; END_ACTION
ACTION X1: log := log * 10 + 5; END_ACTION""",
            "log, n : DINT;",
        )
    )
    seen = []
    for _ in range(5):
        run.call()
        seen.append(run["log"])
    # the exit action of the step before runs ahead of the entry action of the next one
    assert seen == ["1", "1", "1234", "12344", "1234451"]


BRANCH = """
INITIAL_STEP S: END_STEP
STEP A: END_STEP
STEP B: END_STEP
STEP C: END_STEP
TRANSITION FROM A TO S := {back}; END_TRANSITION
TRANSITION FROM B TO S := {back}; END_TRANSITION
TRANSITION FROM C TO S := {back}; END_TRANSITION"""
"""Three steps beside each other, and the ways back from them."""


def test_alternative_branch() -> None:
    """language_sfc EX-04; LSFC-16, LSFC-17: from left to right, those further right are not evaluated."""
    run = Run(
        chart(
            BRANCH.format(back="FALSE")
            + """
TRANSITION FROM S TO A := Asked(1, FALSE); END_TRANSITION
TRANSITION FROM S TO B := Asked(2, TRUE); END_TRANSITION
TRANSITION FROM S TO C := Asked(4, TRUE); END_TRANSITION"""
        ),
        "VAR_GLOBAL questions : INT; END_VAR",
        "FUNCTION Asked : BOOL VAR_INPUT bit : INT; answer : BOOL; END_VAR\n"
        "questions := questions + bit; Asked := answer; END_FUNCTION",
    )
    run.call(2)
    assert [run[f"{step}.x"] for step in "SABC"] == ["FALSE", "FALSE", "TRUE", "FALSE"]
    assert run.application.literal("questions") == "3"


def test_priority_goes_before_the_order() -> None:
    """LSFC-17: PRIORITY decides, the lowest number first; transitions without one follow."""
    run = Run(
        chart(
            BRANCH.format(back="TRUE")
            + """
TRANSITION FROM S TO A := TRUE; END_TRANSITION
TRANSITION (PRIORITY := 2) FROM S TO B := TRUE; END_TRANSITION
TRANSITION named (PRIORITY := 1) FROM S TO C := TRUE; END_TRANSITION"""
        )
    )
    run.call(2)
    assert [run[f"{step}.x"] for step in "SABC"] == ["FALSE", "FALSE", "FALSE", "TRUE"]


def test_parallel_branch() -> None:
    """language_sfc EX-05; LSFC-18, LSFC-19: lines begin together, and end when all are at their last step."""
    run = Run(
        chart(
            """
INITIAL_STEP S: END_STEP
STEP P1: END_STEP
STEP P2: END_STEP
STEP Q1: END_STEP
STEP Ready: END_STEP
TRANSITION FROM S TO (P1, Q1) := TRUE; END_TRANSITION
TRANSITION FROM P1 TO P2 := P1.t >= T#20ms; END_TRANSITION
TRANSITION FROM (P2, Q1) TO Ready := TRUE; END_TRANSITION
TRANSITION FROM Ready TO S := FALSE; END_TRANSITION""",
            "SFCCurrentStep : STRING; SFCTrans : BOOL;",
        )
    )
    rows = []
    for _ in range(6):
        run.call()
        active = "".join(f"{s} " for s in ("S", "P1", "P2", "Q1", "Ready") if run[f"{s}.x"] == "TRUE")
        rows.append((active.strip(), run["SFCCurrentStep"].strip("'"), run["SFCTrans"]))
    assert rows == [
        ("S", "S", "TRUE"),
        ("P1 Q1", "Q1", "FALSE"),  # LSFC-69: the rightmost line
        ("P1 Q1", "Q1", "FALSE"),
        ("P1 Q1", "Q1", "TRUE"),  # LSFC-68
        ("P2 Q1", "Q1", "TRUE"),
        ("Ready", "Ready", "FALSE"),
    ]


def test_one_call_moves_a_token_by_one_step() -> None:
    """Section 6, phase 8; also round a loop, and from a step to itself."""
    run = Run(
        chart(
            """
INITIAL_STEP S: END_STEP
STEP A: In(ENTRY); Out(EXIT); END_STEP
TRANSITION FROM S TO A := TRUE; END_TRANSITION
TRANSITION FROM A TO A := TRUE; END_TRANSITION
ACTION In: ins := ins + 1; END_ACTION
ACTION Out: outs := outs + 1; END_ACTION""",
            "ins, outs : INT;",
        )
    )
    run.call(4)
    assert [run["A.x"], run["ins"], run["outs"], run["A.t"]] == ["TRUE", "3", "2", "T#0ms"]


def test_flags_of_steps_are_seen_from_other_objects() -> None:
    """language_sfc EX-03; LSFC-53, LSFC-57, LSFC-58."""
    program = chart(
        """
INITIAL_STEP step1: END_STEP
STEP step2: END_STEP
TRANSITION FROM step1 TO step2 := step1.t > T#15ms; END_TRANSITION
TRANSITION FROM step2 TO step1 := FALSE; END_TRANSITION""",
        head="PROGRAM sfc1",
    )
    other = "PROGRAM P VAR boolvar1 : BOOL; age : TIME; END_VAR\nsfc1(); boolvar1 := sfc1.step1.x; age := sfc1.step2.t;\nEND_PROGRAM"  # noqa: E501
    run = Run(other, program)
    assert run.active("boolvar1", 6) == [1, 2, 3]
    assert run["age"] == "T#20ms"


def test_virtual_actions() -> None:
    """language_sfc EX-06; LSFC-26: a derived block's action replaces the base's where actions are virtual."""
    base = """{ATTRIBUTE}FUNCTION_BLOCK POU_SFC
VAR an_int : INT; test_act, test_meth : STRING; END_VAR
INITIAL_STEP Init: END_STEP
STEP Work: ActiveAction(STEP); END_STEP
TRANSITION FROM Init TO Work := TRUE; END_TRANSITION
TRANSITION FROM Work TO Init := FALSE; END_TRANSITION
ACTION ActiveAction: an_int := an_int + 1; test_act := 'father_action'; METH(); END_ACTION
METHOD METH test_meth := 'father_method'; END_METHOD
END_FUNCTION_BLOCK"""
    child = """FUNCTION_BLOCK POU_child EXTENDS POU_SFC
SUPER^();
ACTION ActiveAction: test_act := 'child_action'; METH(); END_ACTION
METHOD METH test_meth := 'child_method'; END_METHOD
END_FUNCTION_BLOCK"""
    main = "PROGRAM P VAR Child : POU_child; END_VAR\nChild();\nEND_PROGRAM"
    run = Run(main, base.replace("{ATTRIBUTE}", ""), child)
    run.call(3)
    assert run["Child.test_act"] == "'child_action'"
    assert run["Child.test_meth"] == "'child_method'"
    run = Run(main, base.replace("{ATTRIBUTE}", "{attribute 'no_virtual_actions'}\n"), child)
    run.call(3)
    assert run["Child.test_act"] == "'father_action'"
    assert run["Child.test_meth"] == "'child_method'"
    assert run["Child.an_int"] == "2"


def test_actions_in_il_and_in_objects_of_their_own() -> None:
    """LSFC-07, LSFC-09: an action may be an object below the POU, in another language, at several steps."""
    text = chart(
        """
INITIAL_STEP S: Act(N); END_STEP
STEP T: Act(N); Other(N); END_STEP
TRANSITION FROM S TO T := TRUE; END_TRANSITION
TRANSITION FROM T TO S := FALSE; END_TRANSITION
ACTION Other: LD n2\nADD 5\nST n2\nEND_ACTION""",
        "n, n2 : INT;",
    )
    action = Source("P.Act", "ACTION Act\nn := n + 1;\nEND_ACTION", owner="P", name="Act")
    result = build_application([Source("P", text), action], session=SESSION, options=BuildOptions(level=1))
    assert [str(d) for d in result.diagnostics if d.severity == "error"] == []
    assert result.package is not None
    with loaded(result.package) as application:
        for _ in range(3):
            application.cycle()
        assert [application.literal("P.n"), application.literal("P.n2")] == ["3", "10"]


def test_ten_actions_at_a_step() -> None:
    """LSFC-05: at least nine; LSFC-42: S lets several actions run beside later steps."""
    flags = [f"b{n}" for n in range(10)]
    steps = f"""
INITIAL_STEP S: {" ".join(f"{f}(S);" for f in flags)} END_STEP
STEP T: END_STEP
TRANSITION FROM S TO T := TRUE; END_TRANSITION
TRANSITION FROM T TO S := FALSE; END_TRANSITION"""
    run = Run(chart(steps, f"{', '.join(flags)} : BOOL;"))
    run.call(5)
    assert [run[f] for f in flags] == ["TRUE"] * 10


def test_actions_run_in_alphabetical_order() -> None:
    """Section 6, phase 7: last executions first, then the active ones, each by name."""
    run = Run(
        chart(
            """
INITIAL_STEP S: z(N); B(N); END_STEP
STEP T: A(N); C(N); END_STEP
TRANSITION FROM S TO T := TRUE; END_TRANSITION
TRANSITION FROM T TO S := FALSE; END_TRANSITION
ACTION z: log := log * 10 + 4; END_ACTION
ACTION C: log := log * 10 + 3; END_ACTION
ACTION B: log := log * 10 + 2; END_ACTION
ACTION A: log := log * 10 + 1; END_ACTION""",
            "log : DINT;",
        )
    )
    run.call(2)
    assert run["log"] == "242413"

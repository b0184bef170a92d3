"""Textual charts: what is reported about them (language_sfc.md, section 5), and that any text is read."""

from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tappet.lang import ast
from tappet.lang.analysis import analyse
from tappet.lang.parser import parse
from tappet.lang.source import Source

GOOD = """INITIAL_STEP S: Act(N); lamp(S); END_STEP
STEP T: Act(L, T#1s); END_STEP
TRANSITION FROM S TO T := lamp; END_TRANSITION
TRANSITION FROM T TO S := n > 3; END_TRANSITION
ACTION Act: n := n + 1; END_ACTION"""


def messages(body: str, variables: str = "") -> list[tuple[str, str]]:
    text = f"PROGRAM P\nVAR lamp : BOOL; n : INT; {variables} END_VAR\n{body}\nEND_PROGRAM"
    result = parse(Source("P", text))
    found = result.diagnostics or analyse([result.unit]).diagnostics
    return [(d.code, d.message) for d in found if d.code not in ("W1103", "W1206")]


def test_a_chart_that_ends_anywhere_is_read() -> None:
    text = "PROGRAM P\n" + GOOD.replace("TRANSITION FROM S", "TRANSITION first (PRIORITY := 1) FROM S")
    for end in range(len(text)):
        parse(Source("P", text[:end]))


def test_good_chart_has_no_message() -> None:
    assert messages(GOOD) == []


@pytest.mark.parametrize(
    ("old", "new", "code", "words"),
    [
        ("INITIAL_STEP", "STEP", "E0821", "no initial step"),  # LSFC-80, LSFC-02
        ("STEP T", "INITIAL_STEP T", "E0821", "2 initial steps"),  # LSFC-80
        ("TO T :=", "TO X :=", "E0822", "'X'"),  # LSFC-82, LSFC-20
        ("STEP T:", "STEP S:", "E0823", "'S'"),  # LSFC-03
        ("Act(N)", "Act(Q)", "E0824", "'S'"),  # LSFC-83
        ("Act(L, T#1s)", "Act(L)", "E0825", "L needs a time"),  # LSFC-39, LSFC-83
        ("lamp(S)", "lamp(S, T#1s)", "W1119", "S takes no time"),  # LSFC-39
        ("lamp(S)", "lmp(S)", "E0826", "'lmp'"),  # LSFC-84
        ("Act(N);", "Start(ENTRY);", "E0826", "'Start'"),  # LSFC-84
        ("TRANSITION FROM T TO S := n > 3; END_TRANSITION", "", "E0827", "'T'"),  # LSFC-01
        (":= lamp;", ":= (lamp := TRUE);", "E0828", "assign"),  # LSFC-14, LSFC-81
        (":= lamp;", ":= n;", "E0301", "BOOL"),  # LSFC-13, LSFC-81
        (":= lamp;", ":= inst(IN := lamp);", "E0325", "'FB'"),  # LSFC-14, LSFC-81
        ("lamp(S)", "n(S)", "E0301", "BOOL"),  # LSFC-41: a BOOL variable
        ("TRANSITION FROM S", "TRANSITION FROM S, T", "E0101", ""),
        ("END_STEP\nSTEP", "\nSTEP", "E0103", "END_STEP"),
        ("lamp; END_TRANSITION", "lamp;", "E0103", "END_TRANSITION"),
    ],
)
def test_faults_are_reported(old: str, new: str, code: str, words: str) -> None:
    assert old in GOOD
    block = "\nEND_PROGRAM\nFUNCTION_BLOCK FB VAR_INPUT IN : BOOL; END_VAR END_FUNCTION_BLOCK\nPROGRAM Q"
    found = messages(
        GOOD.replace(old, new, 1) + (block if "inst" in new else ""), "inst : FB;" if "inst" in new else ""
    )
    assert code in [c for c, _ in found], found
    assert any(words in message for c, message in found if c == code), found


def test_implicit_names_are_taken() -> None:
    """LSFC-57: an own variable with the name of a step or of an action's flag is an error."""
    assert "E0205" in [c for c, _ in messages(GOOD, "T : INT;")]
    assert "E0205" in [c for c, _ in messages(GOOD, "_Act : INT;")]


def test_conditions_may_be_any_bool() -> None:
    """LSFC-13: variable, address, constant, expression, function call."""
    for condition in ("lamp", "%IX0.3", "TRUE", "(n <= 100) AND lamp", "F(n)", "S.t > T#1s", "NOT T.x"):
        body = GOOD.replace("lamp;", f"{condition};")
        function = (
            "\nEND_PROGRAM\nFUNCTION F : BOOL VAR_INPUT x : INT; END_VAR F := x > 3; END_FUNCTION\nPROGRAM Q"
        )
        assert messages(body + function) == [], condition


def test_a_function_has_no_chart() -> None:
    """A chart needs variables that are kept: those of a program, a block, or an action or method of one."""
    steps = "INITIAL_STEP S: END_STEP TRANSITION FROM S TO S := TRUE; END_TRANSITION"
    for head in ("ACTION A:", "METHOD M"):
        body = f"n := 1;\n{head}\n{steps}\nEND_{head.split()[0]}"
        assert [c for c, _ in messages(body) if c[0] == "E"] == []
    found = messages(f"END_PROGRAM FUNCTION F : INT\n{steps}\nEND_FUNCTION\nPROGRAM Q")
    assert [c for c, _ in found if c[0] == "E"] == ["E0113"]


def test_an_action_is_not_at_a_step_of_its_own_chart() -> None:
    """LSFC-85: directly, or through another action."""
    chart = "INITIAL_STEP S{0}: {1}(N); END_STEP TRANSITION FROM S{0} TO S{0} := TRUE; END_TRANSITION"
    one = f"A();\nACTION A: {chart.format(1, 'A')} END_ACTION"
    two = f"A();\nACTION A: {chart.format(1, 'B')} END_ACTION\nACTION B: {chart.format(2, 'A')} END_ACTION"
    for body, code in ((one, "E0829"), (two, "E0515")):
        assert [c for c, _ in messages(body) if c[0] == "E"] == [code]


def test_words_of_charts_stay_free() -> None:
    """STEP and INITIAL_STEP are no keywords: ST may use them as names and labels."""
    body = "Step := 3;\nIF Step > 2 THEN JMP initial_step; END_IF\ninitial_step: Step := 4;"
    assert messages(body, "Step : INT;") == []


def test_steps_and_transitions_are_places() -> None:
    """References and renaming find a step where it is defined and where transitions name it."""
    pou = parse(
        Source("P", f"PROGRAM P\nVAR lamp : BOOL; n : INT; END_VAR\n{GOOD}\nEND_PROGRAM")
    ).unit.declarations[0]
    assert isinstance(pou, ast.Pou)
    assert pou.language == "SFC"
    steps = [d.name_span[:2] for d in pou.blocks[-1].variables if d.name == "T"]
    assert steps == [(3, 5)]


_WORDS = """STEP INITIAL_STEP END_STEP TRANSITION END_TRANSITION FROM TO := : ; , ( ) PRIORITY S T Act N L D
SD T#1s ACTION END_ACTION lamp n 3 AND MAX_TIME ENTRY END_PROGRAM IF END_IF"""


@given(st.lists(st.sampled_from(_WORDS.split()), max_size=40))
@settings(max_examples=150, deadline=None)
def test_any_text_is_read(pieces: list[str]) -> None:
    messages(f"INITIAL_STEP S: Act(N); END_STEP\n{' '.join(pieces)}")

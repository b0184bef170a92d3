"""`{warning disable CODE}` switches a warning off to the `restore` or to the end of the text."""

from __future__ import annotations

import pytest
from sample_stage import diagnose

from tappet.lang.analysis.suppression import without_warnings

BODY = "VAR a, b : REAL; x : BOOL; u : UINT; i : INT; END_VAR\n"


@pytest.mark.parametrize(
    ("text", "lines"),
    [
        ("x := a = b;\n", [3]),
        ("{warning disable W1122}\nx := a = b;\n", []),
        ("{warning disable W1122}\nx := a = b;\n{warning restore W1122}\nx := a = b;\n", [6]),
        ("{WARNING DISABLE w1122, W1133}\nx := a = b;\n", []),
        ("{warning disable W1133}\nx := a = b;\n", [4]),
        ("{warning disable C0195}\nu := i;\n", []),
        ("{warning restore W1122}\nx := a = b;\n", [4]),
    ],
)
def test_range_of_a_pragma(text: str, lines: list[int]) -> None:
    found = [d for d in diagnose(BODY + text) if d.code in ("W1122", "W1001")]
    assert [d.span.line + 1 for d in found] == lines


def test_errors_stay() -> None:
    assert [d.code for d in diagnose("{warning disable E0201}\nnope := 1;\n")] == ["E0201"]


@pytest.mark.parametrize(
    ("text", "lines"),
    [
        ("{analysis -54}\nx := a = b;\n", []),
        ("{analysis -54}\nx := a = b;\n{analysis +54}\nx := a = b;\n", [6]),
        ("{analysis -33, -SA0054}\nx := a = b;\n", []),
        ("{analysis -W1122}\nx := a = b;\n{ANALYSIS +w1122}\nx := a = b;\n", [6]),
        ("{analysis -33}\nx := a = b;\n", [4]),
        ("x := a = b;\n{analysis -54}\n", [3]),
    ],
)
def test_static_analysis_is_switched_off_in_the_text(text: str, lines: list[int]) -> None:
    found = [d for d in diagnose(BODY + text) if d.code == "W1122"]
    assert [d.span.line + 1 for d in found] == lines


@pytest.mark.parametrize("number", [55, 56, 59])
def test_each_of_several_numbers_switches_a_warning_off(number: int) -> None:
    comparison = "x := u >= 0;\n"
    assert "W1113" in {d.code for d in diagnose(BODY + comparison)}
    assert "W1113" not in {d.code for d in diagnose(BODY + f"{{analysis -{number}}}\n" + comparison)}


def test_attribute_switches_rules_off_in_an_object() -> None:
    text = "{attribute 'analysis' := '-54, -NC0007'}\n" + BODY + "x := a = b;\n"
    found = {d.code for d in diagnose("@static\n" + text)}
    assert "S1101" in found
    assert not found & {"W1122", "S1001", "S1004"}


def test_codes_that_a_project_switches_off_hide_no_error() -> None:
    found = diagnose(BODY + "x := a = b;\nnope := 1;\n")
    assert {"W1122", "E0201"} <= {d.code for d in found}
    left = {d.code for d in without_warnings(found, {d.code for d in found})}
    assert left == {d.code for d in found if d.severity == "error"}
    assert without_warnings(found, ()) == found

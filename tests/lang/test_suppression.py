"""`{warning disable CODE}` switches a warning off to the `restore` or to the end of the text."""

from __future__ import annotations

import pytest
from sample_stage import diagnose

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

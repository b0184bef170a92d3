"""Where RETAIN and PERSISTENT may stand (gvl_dut_symbols PERS-04, PERS-06)."""

from __future__ import annotations

import itertools

import pytest
from sample_stage import diagnose

KEYWORDS = ("RETAIN", "PERSISTENT", "RETAIN PERSISTENT", "PERSISTENT RETAIN")


def _codes(text: str) -> set[str]:
    return {d.code for d in diagnose(text)} & {"W1202", "E0402"}


@pytest.mark.parametrize("keyword", KEYWORDS)
def test_remanent_locals_of_functions_have_no_effect(keyword: str) -> None:
    """PERS-04: a warning says so; a program keeps them."""
    body = "VAR {keyword} n : INT; END_VAR n := n + 1;"
    function = "FUNCTION F : INT\n" + body + " F := n; END_FUNCTION"
    assert _codes(function.format(keyword=keyword)) == {"W1202"}
    assert _codes(function.format(keyword="")) == set()
    assert _codes(("PROGRAM P\n" + body + " END_PROGRAM").format(keyword=keyword)) == set()


@pytest.mark.parametrize(("keyword", "area"), itertools.product(KEYWORDS, "IQM"))
def test_remanent_variables_have_no_address(keyword: str, area: str) -> None:
    """PERS-06."""
    text = "PROGRAM P\nVAR {keyword} x {at}: BOOL; END_VAR x := x; END_PROGRAM"
    at = f"AT %{area}X0.0 "
    assert _codes(text.format(keyword=keyword, at=at)) == {"E0402"}
    assert _codes(text.format(keyword=keyword, at="")) == set()
    assert _codes(text.format(keyword="", at=at)) == set()

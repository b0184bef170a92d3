"""One table of the dialect: what the browser has is generated, and both readers say the same of programs."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from tappet.cnc.checks import check
from tappet.cnc.dialect import FILE, table
from tappet.cnc.parser import parse

CASES = json.loads((Path(__file__).parent / "check_cases.json").read_text(encoding="utf-8"))
"""Programs with line and column, from 0, of what is an error; the test of the browser reads them too."""


def test_the_table_of_the_browser_is_current() -> None:
    stored = (Path(__file__).parents[2] / FILE).read_text(encoding="utf-8")
    assert stored == table(), "run `make generate`"


@pytest.mark.parametrize("case", CASES, ids=[case["text"] for case in CASES])
def test_errors_are_where_the_cases_say(case: dict[str, object]) -> None:
    """GC-05 to GC-09, CNC-37."""
    found = [one for one in check(parse(str(case["text"])).lines) if one.severity == "error"]
    assert [[one.line, one.column] for one in found] == case["errors"]

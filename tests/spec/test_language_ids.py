"""Every numbered rule of the language documents is bound to a test.

`data/language_ids.csv` lists the rules. `shown_by` names the language cases or the tests that show a rule;
where it is empty, a test names the rule itself: in its docstring, a comment, a parameter. `convention` marks
naming advice without behaviour. `open: ...` says what is missing: no test may name such a rule, except in a
range of rules.
"""

from __future__ import annotations

import csv
import re
from collections import Counter
from pathlib import Path

import pytest
from tests.spec.language_cases import load_cases

ROOT = Path(__file__).parents[2]
TESTS = ROOT / "tests"
_ID = re.compile(r"\b(LDEC|LOPR|LPRG|LSFC|LST|LTYP)-(\d+)(?:\.\.(?:\1-)?(\d+))?((?:, -\d+)*)")
_CASE = re.compile(r"[A-Z]+-\d+")


def read() -> dict[str, str]:
    with (Path(__file__).parent / "data" / "language_ids.csv").open(encoding="utf-8") as file:
        return {row["id"]: row["shown_by"] for row in csv.DictReader(file)}


def named() -> tuple[set[tuple[str, int]], set[tuple[str, int]]]:
    """What the texts of all tests name: ranges such as LSFC-30..LSFC-38 included, and one by one."""
    found, single = set(), set()
    for path in (*TESTS.rglob("*.py"), *TESTS.rglob("*.st")):
        for family, first, last, more in _ID.findall(path.read_text(encoding="utf-8")):
            numbers = [
                *range(int(first), int(last or first) + 1),
                *(int(n) for n in re.findall(r"\d+", more)),
            ]
            found |= {(family, number) for number in numbers}
            single |= {(family, number) for number in numbers if not last}
    return found, single


RULES = read()
NAMED, SINGLE = named()
CASES = {case["id"] for case in load_cases()}


@pytest.mark.parametrize("rule", RULES)
def test_rule_is_bound_to_a_test(rule: str) -> None:
    shown_by = RULES[rule]
    family, number = rule.split("-")
    is_named = (family, int(number)) in NAMED
    if not shown_by:
        assert is_named, f"no test names {rule}"
    elif shown_by.startswith("open: "):
        assert (family, int(number)) not in SINGLE, f"a test names {rule}: take it off the list of open rules"
    elif shown_by != "convention":
        for reference in shown_by.split():
            if _CASE.fullmatch(reference):
                assert reference in CASES
                continue
            path, _, test = reference.partition("::")
            assert f"def {test}" in (ROOT / path).read_text(encoding="utf-8")


def test_no_rule_is_lost_or_invented(capsys: pytest.CaptureFixture[str]) -> None:
    assert len(RULES) == 470
    missing = Counter(text.removeprefix("open: ") for text in RULES.values() if text.startswith("open: "))
    with capsys.disabled():
        print(
            f"\nlanguage rules: {len(RULES) - missing.total()} of {len(RULES)} shown; open: {dict(missing)}"
        )

"""Every numbered rule of the documents of motion and of cams is bound to a test.

`data/motion_ids.csv` lists the rules of `motion_semantics` and `cam`. `shown_by` names the tests that show
a rule; where it is empty, a test names the rule itself. `convention` marks advice to programmers. `open: ...`
says what is missing. Both documents have rules CAM-01 to CAM-22: a test that names one counts for both.
"""

from __future__ import annotations

import csv
import re
from functools import cache
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
PLACES = (("tests", "*.py"), ("tests", "*.st"), ("frontend/src", "*.test.ts"), ("frontend/src", "*.test.tsx"))
_FAMILY = r"(?:STA|CAL|EXE|ENA|SEQ|PRO|ERR|PWR|HOM|GEA|CAM|TAP|DCS|TPR|TRQ|FOL|VIR|DIA|INF|PAR|UNI|EX)"
_RUN = re.compile(rf"\b({_FAMILY})-(\d+)((?:(?: to |\.\.|, | and )(?:{_FAMILY}-)?\d+)*)")
_NEXT = re.compile(rf"( to |\.\.|, | and )(?:({_FAMILY})-)?(\d+)")


def read() -> list[tuple[str, str, str]]:
    with (Path(__file__).parent / "data" / "motion_ids.csv").open(encoding="utf-8") as file:
        return [(row["document"], row["id"], row["shown_by"]) for row in csv.DictReader(file)]


@cache
def named() -> frozenset[str]:
    """The rules in the texts of tests; `GEA-01 to GEA-04`, `TAP-01, TAP-06` and `CAM-14, 15` too."""
    found = set()
    for folder, pattern in PLACES:
        for path in (ROOT / folder).rglob(pattern):
            for family, first, more in _RUN.findall(path.read_text(encoding="utf-8")):
                last = int(first)
                found.add(f"{family}-{last:02}")
                for joint, other, number in _NEXT.findall(more):
                    family = other or family
                    numbers = range(last, int(number) + 1) if joint in (" to ", "..") else (int(number),)
                    found |= {f"{family}-{one:02}" for one in numbers}
                    last = int(number)
    return frozenset(found)


RULES = read()


@pytest.mark.parametrize(("document", "rule", "shown_by"), RULES, ids=[f"{row[0]} {row[1]}" for row in RULES])
def test_rule_is_bound_to_a_test(document: str, rule: str, shown_by: str) -> None:
    if not shown_by:
        assert rule in named(), f"no test names {document} {rule}"
    elif not shown_by.startswith("open: ") and shown_by != "convention":
        for reference in shown_by.split():
            path, _, test = reference.partition("::")
            assert f"def {test}(" in (ROOT / path).read_text(encoding="utf-8"), reference


def test_no_rule_is_lost_or_invented(capsys: pytest.CaptureFixture[str]) -> None:
    """179 rules of motion, 81 of cams."""
    documents = [document for document, _, _ in RULES]
    assert (documents.count("motion_semantics"), documents.count("cam")) == (179, 81)
    assert len({row[:2] for row in RULES}) == len(RULES)
    missing = [f"{document} {rule}" for document, rule, shown_by in RULES if shown_by.startswith("open: ")]
    with capsys.disabled():
        print(f"\nrules of motion: {len(RULES) - len(missing)} of {len(RULES)} shown; open: {missing}")

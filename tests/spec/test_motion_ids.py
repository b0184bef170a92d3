"""Every numbered rule and worked example of the documents of motion is bound to a test.

`data/motion_ids.csv` lists the rules and examples of `motion_semantics`, `cam`, `ax3000` and `axis_group`,
and those of `devices` that are about SoftMotion drives (AXIS and devices EX-05 to devices EX-08). `shown_by`
names the tests that show a rule; where it is empty, a test names the rule itself, which will do only for a
number that no other document has. A front-end test is named by its file, which names the rule. `convention`
marks advice to programmers. `open: ...` says what is missing.
"""

from __future__ import annotations

import csv
import re
from collections import Counter
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
WIDELY_USED = ("ax3000", "devices")
"""Documents whose families of rules (TASK, PERS, AXIS ...) other documents have too."""
NUMBERS = Counter(rule for _, rule, _ in RULES)


@pytest.mark.parametrize(("document", "rule", "shown_by"), RULES, ids=[f"{row[0]} {row[1]}" for row in RULES])
def test_rule_is_bound_to_a_test(document: str, rule: str, shown_by: str) -> None:
    if not shown_by:
        assert NUMBERS[rule] == 1, "name its tests: another document has the same number"
        assert document not in WIDELY_USED
        assert not rule.startswith("EX-"), "name the test that has the numbers of the example"
        assert rule in named(), f"no test names {document} {rule}"
    elif not shown_by.startswith("open: ") and shown_by != "convention":
        for reference in shown_by.split():
            path, _, test = reference.partition("::")
            text = (ROOT / path).read_text(encoding="utf-8")
            assert (f"def {test}(" if test else rule) in text, reference


def test_no_rule_is_lost_or_invented(capsys: pytest.CaptureFixture[str]) -> None:
    """Rules and worked examples of each document."""
    documents = Counter(document for document, _, _ in RULES)
    assert documents == {
        "motion_semantics": 179 + 29,
        "cam": 81 + 16,
        "ax3000": 129 + 22,
        "devices": 40 + 4,
        "axis_group": 53 + 9,
    }
    assert len({row[:2] for row in RULES}) == len(RULES)
    missing = {(document, rule): text for document, rule, text in RULES if text.startswith("open: ")}
    with capsys.disabled():
        for document, count in documents.items():
            kept = {rule: text for (of, rule), text in missing.items() if of == document}
            print(f"\n{document}: {count - len(kept)} of {count} shown; open: {kept}")

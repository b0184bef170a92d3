"""Every rule and example of `trace` is bound to tests: of Python by name, of the front end by title.

`open: ...` says what is missing.
"""

from __future__ import annotations

import csv
import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
KNOWN = (ROOT / "docs/requirements/trace.md").read_text(encoding="utf-8")
with (Path(__file__).parent / "data" / "trace_ids.csv").open(encoding="utf-8") as file:
    RULES = {row["id"]: row["shown_by"] for row in csv.DictReader(file)}


@pytest.mark.parametrize("rule", RULES)
def test_rule_is_bound_to_a_test(rule: str) -> None:
    assert rule in KNOWN, f"trace.md has no {rule}"
    if RULES[rule].startswith("open: "):
        return
    for reference in RULES[rule].split("; "):
        path, _, name = reference.partition("::")
        text = (ROOT / path).read_text(encoding="utf-8")
        wanted = f"def {name}(" if path.endswith(".py") else f"it('{name}'"
        assert wanted in text, f"{path} has no {name}"


def test_no_rule_is_left_out(capsys: pytest.CaptureFixture[str]) -> None:
    assert set(re.findall(r"</a>((?:TRC|EX)-\d+) ", KNOWN)) == set(RULES)
    with capsys.disabled():
        for rule, text in RULES.items():
            if text.startswith("open: "):
                print(f"\ntrace {rule} {text}", end="")

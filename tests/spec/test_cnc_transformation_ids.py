"""Every rule of sections 9 and 10 of `cnc_runtime`, and their example, is bound to a test."""

from __future__ import annotations

import csv
import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]


def read() -> dict[str, str]:
    with (Path(__file__).parent / "data" / "cnc_transformation_ids.csv").open(encoding="utf-8") as file:
        return {row["id"]: row["shown_by"] for row in csv.DictReader(file)}


RULES = read()


@pytest.mark.parametrize("rule", RULES)
def test_rule_is_bound_to_a_test(rule: str) -> None:
    assert RULES[rule]
    for reference in RULES[rule].split():
        path, _, test = reference.partition("::")
        assert f"def {test}(" in (ROOT / path).read_text(encoding="utf-8"), reference


def test_no_rule_is_lost_or_invented() -> None:
    text = (ROOT / "docs" / "requirements" / "cnc_runtime.md").read_text(encoding="utf-8")
    rows = re.findall(r'^\| <a id="([a-z0-9-]+)"></a>', text, re.MULTILINE)
    documented = [row.upper() for row in rows if re.fullmatch(r"cncr-(18|20)\d|ex-41", row)]
    assert sorted(RULES) == sorted(documented)

"""Every numbered rule of the online functions is bound to a test.

`data/online_ids.csv` lists section 9 of `concepts`. `shown_by` names the tests; `open: ...` says what is
missing. The rules of online changes are among those of the language documents (`test_language_ids`).
"""

from __future__ import annotations

import csv
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]


def read() -> list[tuple[str, str, str]]:
    with (Path(__file__).parent / "data" / "online_ids.csv").open(encoding="utf-8") as file:
        return [(row["document"], row["id"], row["shown_by"]) for row in csv.DictReader(file)]


RULES = read()


@pytest.mark.parametrize(("document", "rule", "shown_by"), RULES, ids=[f"{row[0]} {row[1]}" for row in RULES])
def test_rule_is_bound_to_a_test(document: str, rule: str, shown_by: str) -> None:
    assert shown_by
    if shown_by.startswith("open: "):
        return
    for reference in shown_by.split():
        path, _, test = reference.partition("::")
        assert f"def {test}(" in (ROOT / path).read_text(encoding="utf-8"), reference


def test_no_rule_is_lost_or_invented(capsys: pytest.CaptureFixture[str]) -> None:
    assert [row[:2] for row in RULES] == [("concepts", f"ONL-{number:02}") for number in range(1, 10)]
    with capsys.disabled():
        for document, rule, text in RULES:
            if text.startswith("open: "):
                print(f"\n{document} {rule} {text}", end="")

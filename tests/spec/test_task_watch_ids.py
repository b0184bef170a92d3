"""Every numbered rule and worked example of tasks, watch lists, forces, persistence and online functions is
bound to a test.

`data/task_watch_ids.csv` lists those of `tasks`, of section 3 of `views_watch`, of section 4 of
`gvl_dut_symbols` and of section 9 of `concepts`; the rules of online changes are among those of the language
documents (`test_language_ids`). `shown_by` names the tests; a file alone holds several of them. `open: ...`
says what is missing.
"""

from __future__ import annotations

import csv
from collections import Counter
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]


def read() -> list[tuple[str, str, str]]:
    with (Path(__file__).parent / "data" / "task_watch_ids.csv").open(encoding="utf-8") as file:
        return [(row["document"], row["id"], row["shown_by"]) for row in csv.DictReader(file)]


RULES = read()


@pytest.mark.parametrize(("document", "rule", "shown_by"), RULES, ids=[f"{row[0]} {row[1]}" for row in RULES])
def test_rule_is_bound_to_a_test(document: str, rule: str, shown_by: str) -> None:
    assert shown_by
    if shown_by.startswith("open: "):
        return
    for reference in shown_by.split():
        path, _, test = reference.partition("::")
        text = (ROOT / path).read_text(encoding="utf-8")
        assert f"def {test}(" in text if test else "test" in text, reference


def test_no_rule_is_lost_or_invented(capsys: pytest.CaptureFixture[str]) -> None:
    documents = Counter(document for document, _, _ in RULES)
    assert documents == {
        "tasks": 49 + 7, "views_watch": 13 + 2, "gvl_dut_symbols": 7 + 1, "concepts": 9,
    }  # fmt: skip
    assert len({row[:2] for row in RULES}) == len(RULES)
    with capsys.disabled():
        for document, rule, text in RULES:
            if text.startswith("open: "):
                print(f"\n{document} {rule} {text}", end="")

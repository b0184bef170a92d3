"""The rules and worked examples about G-code text, the decoder and CNC files are bound to tests.

`data/cnc_decoder_ids.csv` lists them; `open: ...` says what is missing.
"""

from __future__ import annotations

import csv
from collections import Counter
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
with (Path(__file__).parent / "data" / "cnc_decoder_ids.csv").open(encoding="utf-8") as _file:
    RULES = list(csv.DictReader(_file))
OPEN = "open: "


@pytest.mark.parametrize("row", RULES, ids=[f"{row['document']} {row['id']}" for row in RULES])
def test_rule_is_bound_to_a_test(row: dict[str, str]) -> None:
    shown_by = row["shown_by"]
    assert shown_by
    for reference in () if shown_by.startswith(OPEN) else shown_by.split():
        path, _, test = reference.partition("::")
        assert f"def {test}(" in (ROOT / path).read_text(encoding="utf-8"), reference
    document = (ROOT / "docs" / "requirements" / f"{row['document']}.md").read_text(encoding="utf-8")
    assert row["id"].startswith("EX-") or f"</a>{row['id']} |" in document


def test_no_rule_is_lost() -> None:
    """All of GC, those of GEO that are decoded, VAR; the decoder, files and viewer of cnc_runtime."""
    assert len({(row["document"], row["id"]) for row in RULES}) == len(RULES)
    families = Counter(row["id"].split("-")[0] for row in RULES)
    assert families == {"GC": 13, "GEO": 18, "VAR": 8, "EX": 15, "CNCR": 22}

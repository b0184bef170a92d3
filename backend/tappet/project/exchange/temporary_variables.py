"""VAR_TEMP of functions and methods, which other systems allow: their VAR means the same (LDEC-25)."""

from __future__ import annotations

from collections.abc import Iterable

from tappet.iec.tokens import words
from tappet.project.exchange.drafts import Batch, Draft
from tappet.project.exchange.report import ImportReport

_STORED_PER_CALL = frozenset(["FUNCTION", "METHOD"])


def rewrite_temporaries(batch: Batch, report: ImportReport) -> None:
    """Make VAR of VAR_TEMP where each call has its own variables anyway."""
    if not batch.complete:
        _rewrite([batch.loose, batch.pous, *batch.devices], report)


def _rewrite(drafts: Iterable[Draft], report: ImportReport) -> None:
    for draft in drafts:
        text = draft.data.get("declaration")
        if isinstance(text, str) and "VAR_TEMP" in text.upper():
            _rewrite_text(draft, text, report)
        _rewrite(draft.children, report)


def _rewrite_text(draft: Draft, text: str, report: ImportReport) -> None:
    found = list(words(text))
    if not found or found[0].text not in _STORED_PER_CALL:
        return
    for word in reversed(found):
        if word.text == "VAR_TEMP":
            text = f"{text[: word.start]}VAR{text[word.end :]}"
    draft.data["declaration"] = text
    note = "VAR_TEMP became VAR: the variables of functions and methods are new in each call"
    report.add("changed", draft.source, note, name=draft.name, line=draft.line)

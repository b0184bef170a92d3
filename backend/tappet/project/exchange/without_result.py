"""Functions without a return type, which other systems allow: the compiler takes them with an attribute."""

from __future__ import annotations

from tappet.iec.tokens import words
from tappet.iec.words import SECTIONS
from tappet.project.exchange.drafts import Draft
from tappet.project.exchange.report import ImportReport

ATTRIBUTE = "{attribute 'no_return_type'}"


def mark_without_result(draft: Draft, report: ImportReport) -> None:
    """Mark a function whose header has no type: its calls are statements (POU-03 asks new texts for one)."""
    text = str(draft.data.get("declaration", ""))
    if draft.kind != "pou" or "FUNCTION" not in text.upper():
        return
    head = None
    for word in words(text):
        if head is None:
            if word.text != "FUNCTION":
                return
            head = word.start
        elif word.text == ":":
            return
        elif word.text in SECTIONS:
            break
    if head is None or ATTRIBUTE in text[:head]:
        return
    draft.data["declaration"] = f"{text[:head]}{ATTRIBUTE}\n{text[head:]}"
    note = f"the function has no return type; it got {ATTRIBUTE}, so that its calls are statements"
    report.add("changed", draft.source, note, name=draft.name, line=draft.line)

"""Persistent variables of CoDeSys 2.3: global ones move into the persistent list (LDEC-80)."""

from __future__ import annotations

import re

from tappet.project.exchange.drafts import Draft
from tappet.project.exchange.report import ImportReport

LIST = "PersistentVars"
_BLOCK = re.compile(
    r"^[ \t]*VAR_GLOBAL[^\n]*?\bPERSISTENT\b.*?^[ \t]*END_VAR\b[^\n]*\n?", re.DOTALL | re.I | re.M
)


def move_persistent(draft: Draft, kept: Draft, report: ImportReport) -> bool:
    """Take the persistent blocks of a variable list over into `kept`; whether the list has nothing else.

    RETAIN stays where it is: it means the same today.
    """
    declaration = draft.data.get("declaration", "")
    if draft.kind != "gvl" or not isinstance(declaration, str):
        return False
    blocks = [match.group().strip("\n") for match in _BLOCK.finditer(declaration)]
    if not blocks:
        return False
    before = kept.data.get("declaration", "")
    kept.data["declaration"] = "\n".join([*([before] if before else []), *blocks])
    rest = _BLOCK.sub("", declaration)
    draft.data["declaration"] = rest
    note = f"its persistent variables are declared in the persistent list '{LIST}' now"
    report.add("changed", draft.source, note, name=draft.name, line=draft.line)
    return "VAR_GLOBAL" not in rest.upper()

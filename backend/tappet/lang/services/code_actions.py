"""What mends the messages of a place. One function for each code of message, in `fix_*.py`."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Final

from tappet.lang.services import fix_members, fix_names, fix_syntax
from tappet.lang.services.documents import Position
from tappet.lang.services.fix_site import Offering, Site, nothing_offered
from tappet.lang.services.reports import report_of
from tappet.lang.services.results import CodeAction
from tappet.lang.services.workspace import Snapshot, View
from tappet.lang.source import Span

_MENDS: Final[dict[str, Callable[[Site], Iterator[CodeAction]]]] = {
    "E0016": fix_syntax.time_prefix,
    "E0101": fix_syntax.expected,
    "E0103": fix_syntax.missing_end,
    "E0110": fix_syntax.missing_end,
    "E0201": fix_names.unknown_name,
    "E0202": fix_names.unknown_type,
    "E0204": fix_names.unknown_member,
    "E0207": fix_names.qualified,
    "E0216": fix_names.unknown_type,
    "E0217": fix_names.unknown_type,
    "E0218": fix_names.unknown_member,
    "E0301": fix_syntax.conversion,
    "E0307": fix_syntax.condition,
    "E0418": fix_members.implement,
    "E0502": fix_names.unknown_parameter,
    "E0510": fix_syntax.arrow,
    "E0511": fix_syntax.arrow,
    "W1001": fix_syntax.conversion,
    "W1002": fix_syntax.conversion,
    "W1003": fix_syntax.conversion,
    "W1103": fix_syntax.unused,
    "W1104": fix_syntax.cases,
    "W1108": fix_syntax.equality,
    "W1115": fix_syntax.label,
}


def code_actions(
    snapshot: Snapshot, document: str, span: Span, offering: Offering = nothing_offered
) -> list[CodeAction]:
    """What mends the messages that touch a range of a document.

    `offering` names the libraries that have something of a name and are not referred to.
    """
    found: list[CodeAction] = []
    seen: set[tuple[str, Span, str]] = set()
    for diagnostic in snapshot.diagnostics:
        mend = _MENDS.get(diagnostic.code)
        text = snapshot.text_of(diagnostic.uri)
        if mend is None or text is None or text.read_only:
            continue
        place = text.place(diagnostic.span)
        if place.document != document or not _touch(place.span, span):
            continue
        begin = Position(place.span.line, place.span.column)
        view = snapshot.view(document, begin)
        # The message may stand at a line of the compiler itself: the position is its own, not the cut one.
        own = View(
            snapshot,
            view.index,
            text,
            view.result,
            Position(diagnostic.span.line, diagnostic.span.column),
        )
        for action in mend(Site(own, diagnostic, report_of(snapshot, diagnostic, place), offering)):
            key = (diagnostic.code, place.span, action.title)
            if key not in seen:
                seen.add(key)
                found.append(action)
    return found


def _touch(message: Span, wanted: Span) -> bool:
    return message[:2] <= wanted[2:] and wanted[:2] <= message[2:]

"""What mends the messages of a place. One function for each code of message, in `fix_*.py`."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator
from typing import Final

from tappet.lang import ast
from tappet.lang.services import fix_declarations, fix_members, fix_names, fix_statements, fix_syntax
from tappet.lang.services.documents import Position
from tappet.lang.services.fix_site import Offering, Site, nothing_offered
from tappet.lang.services.reports import report_of
from tappet.lang.services.results import CodeAction, Edit
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
    "E0220": fix_names.qualified,
    "E0301": fix_syntax.conversion,
    "E0307": fix_syntax.condition,
    "E0418": fix_members.implement,
    "E0502": fix_names.unknown_parameter,
    "E0510": fix_syntax.arrow,
    "E0511": fix_syntax.arrow,
    "S1004": fix_declarations.prefixed,
    "S1007": fix_statements.declared_spelling,
    "S1008": fix_declarations.capitals,
    "S1108": fix_declarations.own_line,
    "S1113": fix_declarations.strict_values,
    "S1205": fix_statements.else_branch,
    "S1206": fix_statements.else_branch,
    "S1209": fix_statements.needless_statement,
    "S1210": fix_statements.needless_statement,
    "S1212": fix_statements.compared_with_bool,
    "S1216": fix_statements.parentheses,
    "S1217": fix_statements.explicit_conversion,
    "S1220": fix_statements.condition_itself,
    "S1223": fix_statements.qualified_value,
    "S1227": fix_statements.neutral_operand,
    "S1242": fix_statements.typed_literal,
    "S1409": fix_syntax.unused,
    "S1415": fix_declarations.constant,
    "S1423": fix_statements.one_path,
    "S1610": fix_declarations.external,
    "W1001": fix_syntax.conversion,
    "W1002": fix_syntax.conversion,
    "W1003": fix_syntax.conversion,
    "W1103": fix_syntax.unused,
    "W1104": fix_syntax.cases,
    "W1108": fix_syntax.equality,
    "W1115": fix_syntax.label,
}

MENDED: Final = frozenset(_MENDS)
"""Codes of messages that may be mended."""
_TOGETHER: Final = frozenset(code for code in _MENDS if code[0] == "S") | {
    "W1001",
    "W1002",
    "W1003",
    "W1103",
    "W1115",
}
"""Codes of which all messages of a text can be mended at once: a mend of one asks for no choice."""


def code_actions(
    snapshot: Snapshot, document: str, span: Span, offering: Offering = nothing_offered
) -> list[CodeAction]:
    """What mends the messages that touch a range of a document.

    `offering` names the libraries that have something of a name and are not referred to.
    """
    found: list[CodeAction] = []
    seen: set[tuple[str, Span, str]] = set()
    for site in _sites(snapshot, document, offering, _MENDS.keys()):
        place = site.report.span
        if not _touch(place, span):
            continue
        for action in _MENDS[site.diagnostic.code](site):
            key = (site.diagnostic.code, place, action.title)
            if key not in seen:
                seen.add(key)
                found.append(action)
    reported = {action.report.code: action for action in found if action.edits and action.preferred}
    return found + [
        together
        for action in reported.values()
        for together in _all_of_kind(snapshot, document, action, offering)
    ]


def _all_of_kind(
    snapshot: Snapshot, document: str, action: CodeAction, offering: Offering
) -> Iterator[CodeAction]:
    """One action for all messages of a code in a document; of mends that touch the same text the first."""
    code = action.report.code
    if code not in _TOGETHER:
        return
    edits: list[Edit] = []
    count = 0
    for site in _sites(snapshot, document, offering, frozenset([code])):
        mend = next((item for item in _MENDS[code](site) if item.preferred and item.edits), None)
        if mend is not None and not any(_meet(one, other) for one in mend.edits for other in edits):
            edits += mend.edits
            count += 1
    if count > 1:
        title = f"All {count} of {code} in this text: {action.title}"
        values = (("code", code), ("count", str(count)))
        yield CodeAction(title, "all", values, action.report, tuple(edits))


def _meet(one: Edit, other: Edit) -> bool:
    """Whether two edits change the same text, or insert at one place."""
    if one.place.document != other.place.document:
        return False
    mine, its = one.place.span, other.place.span
    return mine == its or (mine[:2] < its[2:] and its[:2] < mine[2:])


def _sites(snapshot: Snapshot, document: str, offering: Offering, codes: Collection[str]) -> Iterator[Site]:
    """The messages of a document that have one of the codes."""
    for diagnostic in snapshot.diagnostics:
        text = snapshot.text_of(diagnostic.uri) if diagnostic.code in codes else None
        if text is None or text.read_only or not any(s.document == document for s in text.segments):
            continue
        place = text.place(diagnostic.span)
        if place.document != document:
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
        site = Site(own, diagnostic, report_of(snapshot, diagnostic, place), offering)
        if diagnostic.code[0] != "S" or _is_structured_text(site):
            yield site


def _is_structured_text(site: Site) -> bool:
    """Whether a message of a coding rule stands in ST: statements of other languages have no such text."""
    return not any(isinstance(node, ast.Pou) and node.language != "ST" for node in site.path)


def _touch(message: Span, wanted: Span) -> bool:
    return message[:2] <= wanted[2:] and wanted[:2] <= message[2:]

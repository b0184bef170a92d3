"""From what was found to the shapes of the API."""

from __future__ import annotations

from tappet.project.search.finding import Findings, Hit, ObjectHits
from tappet.project.search.replacing import Replace
from tappet.server.builds.shapes import Part
from tappet.server.search.shapes import SearchHit, SearchObject, SearchReport


def search_report(findings: Findings, replace: Replace | None) -> SearchReport:
    """What was found in a project, with what would replace it."""
    return SearchReport(
        objects=[_object(found, replace) for found in findings.objects],
        next=findings.next,
        searched=findings.searched,
    )


def _object(found: ObjectHits, replace: Replace | None) -> SearchObject:
    item = found.item
    return SearchObject(
        object_id=item.id,
        library=None,
        name=item.name,
        path=found.path,
        kind=item.kind,
        subkind=item.subkind,
        revision=item.revision,
        hits=[hit_reply(hit, replace) for hit in found.hits],
        total=found.total,
    )


def hit_reply(hit: Hit, replace: Replace | None = None) -> SearchHit:
    """One hit."""
    content = hit.content
    path = content.path if content.part is None else content.inner or ()
    return SearchHit(
        number=hit.number,
        area=hit.area,
        part=Part(content.part) if content.part is not None else None,
        element=content.element,
        field=".".join(str(key) for key in path),
        line=hit.line,
        column=hit.column,
        end_line=hit.end_line,
        end_column=hit.end_column,
        before=hit.before,
        match=hit.match,
        after=hit.after,
        replacement=replace(hit.found) if replace is not None and content.writable else None,
        writable=content.writable,
    )

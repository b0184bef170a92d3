"""The documentation of a project as PDF or HTML."""

from __future__ import annotations

import threading
from datetime import datetime
from typing import Annotated, Literal

from fastapi import Query
from fastapi.responses import Response

from tappet.server.dependencies import StoreDep, Viewer
from tappet.server.problems import Problem
from tappet.server.projects.part import PartDep
from tappet.server.projects.routes import download
from tappet.server.routing import Router
from tappet.server.shapes import Line

router = Router(tags=["projects"])
MOST_AT_ONCE = 2
PATIENCE_S = 60.0
_PLACES = threading.BoundedSemaphore(MOST_AT_ONCE)
Note = Annotated[Line, Query(max_length=200)]


@router.get(
    "/projects/{project_id}/documentation",
    response_class=Response,
    responses={
        200: {
            "content": {
                kind: {"schema": {"type": "string", "format": "binary"}}
                for kind in ("application/pdf", "text/html")
            }
        }
    },
)
def document_project(
    project_id: str,
    who: Viewer,
    store: StoreDep,
    part: PartDep,
    format: Literal["pdf", "html"] = "pdf",
    language: Literal["en", "zh"] = "en",
    paper: Literal["a4", "us-letter"] = "a4",
    contents: Annotated[bool, Query(description="With a table of contents.")] = True,
    variables: Annotated[bool, Query(description="With tables of the variables.")] = True,
    cross_references: Annotated[bool, Query(description="With the places of all names, by name.")] = False,
    footer: Note = "",
) -> Response:
    """The project, or objects of it, to be printed: title page, contents, texts with line numbers, tables.

    A PDF with characters that no font of the server has is the problem `missing-glyphs`, which names them;
    one that needs more memory or time than there is for it is `document-too-large`.
    """
    from tappet.documentation.compose import Printing, compose  # only for who prints
    from tappet.documentation.html import write_html
    from tappet.documentation.pdf import write_pdf

    info, project = store.snapshot(project_id)
    printing = Printing(
        language=language,
        paper=paper,
        objects=part.ids(project),
        contents=contents,
        variables=variables,
        cross_references=cross_references,
        author=who.username,
        footer=footer,
    )
    document = compose(project, printing, datetime.now().astimezone(), info.revision)
    if format == "html":
        return download(write_html(document), f"{project.name}.html", "text/html; charset=utf-8")
    if not _PLACES.acquire(timeout=PATIENCE_S):
        raise Problem(503, "printing", "Other documentations are being made; try again in a minute.")
    try:
        return download(write_pdf(document), f"{project.name}.pdf", "application/pdf")
    finally:
        _PLACES.release()

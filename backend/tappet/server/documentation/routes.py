"""The documentation of a project as PDF or HTML."""

from __future__ import annotations

import threading
from datetime import datetime
from typing import Annotated, Literal

from fastapi import Query
from fastapi.responses import Response

from tappet.project.papers import Orientation, Paper
from tappet.project.running_text import PlainLine, RunningText
from tappet.server.dependencies import StoreDep, Viewer
from tappet.server.problems import Problem
from tappet.server.projects.part import PartDep
from tappet.server.projects.routes import download
from tappet.server.routing import Router

router = Router(tags=["projects"])
MOST_AT_ONCE = 2
PATIENCE_S = 60.0
_PLACES = threading.BoundedSemaphore(MOST_AT_ONCE)


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
    paper: Paper | None = None,
    orientation: Orientation | None = None,
    title_page: bool | None = None,
    contents: Annotated[bool | None, Query(description="With a table of contents.")] = None,
    variables: Annotated[bool | None, Query(description="With tables of the variables.")] = None,
    cross_references: Annotated[
        bool | None, Query(description="With the places of all names, by name.")
    ] = None,
    author: Annotated[PlainLine | None, Query()] = None,
    footer: Annotated[
        RunningText | None, Query(description="At the left of the foot, with placeholders such as {project}.")
    ] = None,
) -> Response:
    """The project, or objects of it, to be printed: title page, contents, texts with line numbers, tables.

    What is not given is as the page setup of the project has it, an object of the kind `page_setup`.
    A PDF with characters that no font of the server has is the problem `missing-glyphs`, which names them;
    one that needs more memory or time than there is for it is `document-too-large`.
    """
    from tappet.documentation.compose import compose  # only for who prints
    from tappet.documentation.html import write_html
    from tappet.documentation.pdf import write_pdf
    from tappet.documentation.printing import Printing

    info, project = store.snapshot(project_id)
    printing = Printing(
        language=language,
        objects=part.ids(project),
        paper=paper,
        orientation=orientation,
        title_page=title_page,
        contents=contents,
        variables=variables,
        cross_references=cross_references,
        author=author,
        footer=footer,
        printed_by=who.username,
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

"""`tappet document`: the documentation of a project as PDF or HTML."""

from __future__ import annotations

from argparse import BooleanOptionalAction, Namespace
from pathlib import Path
from typing import get_args

from tappet.cli.arguments import ArgumentParser
from tappet.cli.errors import UsageError
from tappet.cli.inputs import load_project
from tappet.project.papers import Orientation, Paper
from tappet.whole_file import write_output

PARTS = {
    "title-page": "with a title page, or without one",
    "contents": "with a table of contents",
    "variables": "with tables of variables",
    "cross-references": "with the places of all names",
}
FORMATS = {".pdf": "pdf", ".html": "html", ".htm": "html"}


def document_arguments(parser: ArgumentParser) -> None:
    """What to print, and how."""
    parser.add_argument("source", type=Path, metavar="DIR", help="project folder")
    parser.add_argument(
        "-o", "--output", type=Path, required=True, metavar="FILE", help="FILE.pdf, or FILE.html"
    )
    parser.add_argument(
        "--object",
        action="append",
        default=[],
        metavar="PATH",
        help="only this object with all below it, by its path or name; may be given several times",
    )
    parser.add_argument("--language", choices=("en", "zh"), default="en", help="of the words (default: en)")
    parser.add_argument("--paper", choices=get_args(Paper), help="instead of that of the page setup (or a4)")
    parser.add_argument(
        "--orientation", choices=get_args(Orientation), help="instead of that of the page setup"
    )
    parser.add_argument("--author", metavar="NAME", help="for the title page and {author}")
    parser.add_argument(
        "--footer", metavar="TEXT", help="at the left of the foot, with placeholders such as {project}"
    )
    for part, words in PARTS.items():
        parser.add_argument(f"--{part}", action=BooleanOptionalAction, help=words)


def document(given: Namespace) -> int:
    """Writes the file."""
    from datetime import datetime

    from pydantic import ValidationError

    from tappet.documentation.compose import compose
    from tappet.documentation.html import write_html
    from tappet.documentation.pdf import write_pdf
    from tappet.documentation.printing import Printing
    from tappet.project.errors import ProjectError
    from tappet.project.exchange.parts import chosen_ids
    from tappet.project.objects import describe

    kind = FORMATS.get(given.output.suffix.lower())
    if kind is None:
        raise UsageError(f"{given.output}: the name should end in .pdf or .html")
    project = load_project(given.source)
    tops = []
    for path in given.object:
        found = project.find(path) or next((one for one in project.walk() if one.name == path), None)
        if found is None:
            raise UsageError(f"the project '{project.name}' has no object '{path}'")
        tops.append(found.id)
    try:
        printing = Printing(
            language=given.language,
            objects=chosen_ids(project, tops) if tops else None,
            paper=given.paper,
            orientation=given.orientation,
            title_page=given.title_page,
            contents=given.contents,
            variables=given.variables,
            cross_references=given.cross_references,
            author=given.author,
            footer=given.footer,
        )
        composed = compose(project, printing, datetime.now().astimezone())
        content = write_pdf(composed) if kind == "pdf" else write_html(composed)
    except ValidationError as error:
        raise UsageError(describe(error)) from error
    except ProjectError as error:
        raise UsageError(str(error)) from error
    write_output(given.output, content)
    print(f"{project.name}: {len(composed.sections)} sections in {given.output}")
    return 0

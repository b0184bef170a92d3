"""`tappet document`: the documentation of a project as PDF or HTML."""

from __future__ import annotations

from argparse import Namespace
from pathlib import Path

from tappet.cli.arguments import ArgumentParser
from tappet.cli.errors import UsageError
from tappet.cli.inputs import load_project
from tappet.whole_file import write_output

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
    parser.add_argument("--paper", choices=("a4", "us-letter"), default="a4", help="of the PDF (default: a4)")
    parser.add_argument("--author", default="", metavar="NAME", help="for the title page")
    parser.add_argument("--footer", default="", metavar="TEXT", help="at the foot of each page")
    parser.add_argument("--no-contents", action="store_true", help="without a table of contents")
    parser.add_argument("--no-variables", action="store_true", help="without tables of variables")
    parser.add_argument("--cross-references", action="store_true", help="with the places of all names")


def document(given: Namespace) -> int:
    """Writes the file."""
    from datetime import datetime

    from tappet.documentation.compose import Printing, compose
    from tappet.documentation.html import write_html
    from tappet.documentation.pdf import write_pdf
    from tappet.project.errors import ProjectError
    from tappet.project.exchange.parts import chosen_ids

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
    printing = Printing(
        language=given.language,
        paper=given.paper,
        objects=chosen_ids(project, tops) if tops else None,
        contents=not given.no_contents,
        variables=not given.no_variables,
        cross_references=given.cross_references,
        author=given.author,
        footer=given.footer,
    )
    composed = compose(project, printing, datetime.now().astimezone())
    try:
        content = write_pdf(composed) if kind == "pdf" else write_html(composed)
    except ProjectError as error:
        raise UsageError(str(error)) from error
    write_output(given.output, content)
    print(f"{project.name}: {len(composed.sections)} sections in {given.output}")
    return 0

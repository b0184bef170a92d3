"""A documentation as PDF, by typst (one wheel without libraries of the system) in a process of its own.

The texts of the project are strings of a JSON file that the page reads; none of them is markup. The page sees
its own folder only, and there is no network.
"""

from __future__ import annotations

import json
import re
import tempfile
from importlib.resources import files
from pathlib import Path
from typing import Any

from tappet.documentation.document import Document, Listing, Logo, Table
from tappet.documentation.typesetting import PAGE, TypesettingError, typeset
from tappet.limited_process import LimitExceededError
from tappet.project.errors import ProjectError

_MISSING = re.compile(r"the text `\"(?P<text>(?:[^\"\\]|\\.)*)\"` could not be displayed")
_BREAKABLE = 48
"""Characters without a blank after which a line may break."""
_NARROW = re.compile(rf"\S{{{_BREAKABLE}}}(?=\S)")
_BLANKS = re.compile(r"^ +| {2,}")


class PdfError(ProjectError):
    """The PDF could not be made; HTML always can."""

    code = "pdf"


class MissingGlyphsError(PdfError):
    """No font of this machine has some characters of the texts."""

    code = "missing_glyphs"

    def __init__(self, characters: str) -> None:
        shown = characters[:20] + ("..." if len(characters) > 20 else "")
        super().__init__(
            f"No font of this machine can print {shown} ({len(characters)} different characters). Install "
            "one that can, such as Noto Sans CJK SC (fonts-noto-cjk) for Chinese, or choose HTML, which is "
            "shown with the fonts of the reader"
        )
        self.characters = characters


class DocumentTooLargeError(PdfError):
    """The PDF needs more memory or time than there is for one."""

    code = "document_too_large"

    def __init__(self, needed: str) -> None:
        super().__init__(
            f"The PDF needs more than {needed} to be made. Choose HTML, or print fewer objects, or print "
            "without tables of variables and cross references"
        )


def write_pdf(document: Document, *, system_fonts: bool = True) -> bytes:
    """The file, with the fonts of this machine or those of typst alone.

    Raises MissingGlyphsError, which names the characters, DocumentTooLargeError and PdfError.
    """
    page = files("tappet.documentation").joinpath(PAGE).read_bytes()
    with tempfile.TemporaryDirectory(prefix="tappet-document-") as name:
        folder = Path(name)
        (folder / "data.json").write_text(json.dumps(_data(document)), encoding="utf-8")
        (folder / PAGE).write_bytes(page)
        if document.logo is not None:
            (folder / _logo_file(document.logo)).write_bytes(document.logo.picture.content)
        try:
            return typeset(folder, system_fonts=system_fonts)
        except LimitExceededError as error:
            raise DocumentTooLargeError(str(error)) from None
        except TypesettingError as error:
            lost = "".join(json.loads(f'"{match}"') for match in _MISSING.findall(error.diagnostic))
            if lost:
                raise MissingGlyphsError("".join(sorted(set(lost)))) from error
            raise PdfError(f"The PDF could not be made: {error.message}; HTML always can") from error


def _data(document: Document) -> dict[str, Any]:
    """What the page reads."""
    return {
        "title": document.title,
        "description": document.description,
        "facts": document.facts,
        "language": document.language,
        "width": document.sheet.width,
        "height": document.sheet.height,
        "margins": document.sheet.margins,
        "title_page": document.title_page,
        "logo": _logo(document),
        "header": document.header,
        "footer": document.footer,
        "contents": document.contents,
        "sections": [
            {
                "level": section.level,
                "title": _wrapping(section.title),
                "about": section.about,
                "name": section.title,
                "path": section.path,
                "blocks": [_block(block) for block in section.blocks],
            }
            for section in document.sections
        ],
    }


def _logo_file(logo: Logo) -> str:
    return f"logo.{logo.picture.ending}"


def _logo(document: Document) -> dict[str, Any] | None:
    """The file of the picture, and its width and height in mm at its two places."""
    logo = document.logo
    if logo is None:
        return None
    return {
        "file": _logo_file(logo),
        "title": logo.size_on_title_page() if logo.on_title_page else None,
        "place": logo.in_header,
        "header": logo.size_in_header(document.sheet.margins[0]),
    }


def _block(block: Any) -> tuple[str, str, tuple[str, ...], Any]:
    if isinstance(block, Listing):
        lines = [[(run.style, _kept(_wrapping(run.text))) for run in line] for line in block.lines]
        return "listing", block.title, (), lines
    if isinstance(block, Table):
        return "table", block.title, block.heads, [[_wrapping(cell) for cell in row] for row in block.rows]
    return "note", "", (), [block.text]


def _wrapping(text: str) -> str:
    """The text with places where a word may break that no line of the page holds."""
    return _NARROW.sub(lambda match: match[0] + "\u200b", text) if len(text) > _BREAKABLE else text


def _kept(text: str) -> str:
    """A part of a line whose blanks stay as they are."""
    return _BLANKS.sub(lambda match: "\u00a0" * len(match[0]), text)

"""The pages of a printed HTML file: paper, margins, heads and feet, as CSS Paged Media.

Chromium prints all of it except the names of objects: it knows no named strings (CSS GCPM `string()`), which
Prince and WeasyPrint do. A declaration without them stands before the one with them, so that each takes the
last one it can read. Firefox and Safari have no margin boxes; they print paper and margins alone.
"""

from __future__ import annotations

import base64
from collections.abc import Iterator
from urllib.parse import quote

from tappet.documentation.document import Document, Logo, Running
from tappet.project.running_text import Piece

_SIDES = ("left", "center", "right")
_BLANK = r'"\a0 "'
_EMPTY = '""'
_SAFE = " '/:;,=+"
_STRINGS = ("object", "path")
_COUNTERS = ("page", "pages")


def page_css(document: Document) -> Iterator[str]:
    """The rules; every text of the project is a string in which each sign that could end it is escaped."""
    sheet = document.sheet
    margins = " ".join(f"{side:g}mm" for side in sheet.margins)
    yield f"@page {{ size: {sheet.width:g}mm {sheet.height:g}mm; margin: {margins};"
    yield from _boxes("top", document.header, document.logo, sheet.margins[0])
    yield from _boxes("bottom", document.footer, None, sheet.margins[2])
    yield "}"
    if document.title_page:
        none = " ".join(f"@top-{side} {{ content: none; border: 0; background: none; }}" for side in _SIDES)
        yield f"@page :first {{ {none} }}"
    used = {piece.placeholder for text in (*document.header, *document.footer) for piece in text}
    if not used.isdisjoint(_STRINGS):
        yield "h2, h3, h4, h5, h6 { string-set: object attr(data-object), path attr(data-path); }"


def data_uri(logo: Logo) -> str:
    """The picture in the text of the file."""
    return f"data:{logo.picture.media_type};base64,{base64.b64encode(logo.picture.content).decode()}"


def _boxes(edge: str, texts: Running, logo: Logo | None, margin: float) -> Iterator[str]:
    in_header = logo.in_header if logo is not None else "none"
    if not any(texts) and in_header == "none":
        return
    gap = margin * 0.3
    near = f"vertical-align: bottom; padding-bottom: {gap:.2f}mm;"
    if edge == "bottom":
        near = f"vertical-align: top; padding-top: {gap:.2f}mm;"
    for side, text in zip(_SIDES, texts, strict=True):
        # a head or foot without a centre has all the room for its sides
        if not text and (side == "center" or side != in_header) and side != "left":
            continue
        yield f"@{edge}-{side} {{ font-size: 8pt; color: #57606a; {near} white-space: pre-wrap;"
        shown = tuple(piece for piece in text if piece.placeholder not in _STRINGS)
        for pieces in (shown, text) if shown != text else (text,):
            values = [_value(piece) for piece in pieces]
            if logo is not None and side == in_header:
                picture = _sized(logo, margin)
                values = [picture, _BLANK, *values] if side == "left" else [*values, _BLANK, picture]
            yield f"content: {' '.join(values) or _EMPTY};"
        yield "}"


def _sized(logo: Logo, margin: float) -> str:
    """The picture as an SVG of its size on paper: CSS sizes no picture of a margin box, and browsers print no
    backgrounds unless they are asked."""
    width, height = logo.size_in_header(margin)
    svg = (
        f"<svg xmlns='http://www.w3.org/2000/svg' width='{width:g}mm' height='{height:g}mm'>"
        f"<image width='100%' height='100%' href='{data_uri(logo)}'/></svg>"
    )
    return f'url("data:image/svg+xml,{quote(svg, safe=_SAFE)}")'


def _value(piece: Piece) -> str:
    if piece.placeholder in _COUNTERS:
        return f"counter({piece.placeholder})"
    return f"string({piece.placeholder})" if piece.placeholder else _string(piece.text)


def _string(text: str) -> str:
    """A CSS string; escaped, no text can end it, nor the style element it stands in."""
    return '"' + "".join(c if c.isalnum() or c == " " else f"\\{ord(c):x} " for c in text) + '"'

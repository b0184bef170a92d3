"""A documentation as one HTML file that needs nothing else and prints well."""

from __future__ import annotations

from collections.abc import Iterator
from html import escape

from tappet.documentation.document import Document, Listing, Section, Table
from tappet.documentation.page_css import data_uri, page_css

_STYLE = """
:root { color-scheme: light; }
body { margin: 0 auto; max-width: 60rem; padding: 2rem; color: #1b1f24; background: #fff;
  font: 14px/1.5 Inter, "Noto Sans", "Segoe UI", "Noto Sans CJK SC", "Microsoft YaHei", sans-serif; }
header { margin: 20vh 0 4rem; }
header h1 { font-size: 2.4rem; margin: 0 0 1rem; }
header p { white-space: pre-wrap; }
header img { display: block; margin: 0 0 2rem; }
dl { display: grid; grid-template-columns: max-content 1fr; gap: .25rem 1.5rem; }
dt, small, th { color: #57606a; }
dd { margin: 0; }
nav ol { list-style: none; padding: 0; }
nav a { color: inherit; text-decoration: none; }
h2, h3, h4, h5, h6 { margin: 2rem 0 .5rem; break-after: avoid; overflow-wrap: anywhere; }
h2 { border-bottom: 1px solid #d0d7de; }
small { font-weight: 400; margin-left: .5rem; }
.title { margin: 1rem 0 .25rem; font-weight: 600; break-after: avoid; }
table { border-collapse: collapse; width: 100%; }
th, td { border: 1px solid #d0d7de; padding: .2rem .5rem; text-align: left; vertical-align: top;
  overflow-wrap: anywhere; white-space: pre-wrap; }
thead { display: table-header-group; }
tr { break-inside: avoid; }
pre { margin: 0; border: 1px solid #d0d7de; padding: .5rem; counter-reset: line; white-space: pre-wrap;
  font: 12px/1.45 "JetBrains Mono", "DejaVu Sans Mono", Consolas, "Noto Sans Mono CJK SC", monospace; }
pre span.l { display: block; padding-left: 3.5rem; overflow-wrap: anywhere; min-height: 1.45em; }
pre span.l::before { counter-increment: line; content: counter(line); position: absolute;
  margin-left: -3.5rem; width: 2.5rem; text-align: right; color: #6e7781; }
.keyword { color: #0033b3; font-weight: 600; } .type { color: #00627a; } .comment { color: #4b6b3c; }
.string { color: #8a3b12; } .number { color: #7a3e9d; } .pragma { color: #6e5494; }
@media print { body { max-width: none; padding: 0; font-size: 11px; } header { break-after: page; }
  nav { break-after: page; } pre { font-size: 9.5px; border: 0; padding: 0; } }
"""
_POLICY = "default-src 'none'; style-src 'unsafe-inline'; img-src data:"
_TONGUES = {"en": "en", "zh": "zh-Hans"}


def write_html(document: Document) -> bytes:
    """The file, in UTF-8. Every text of the project is escaped."""
    return "\n".join(_page(document)).encode("utf-8", "replace")


def _page(document: Document) -> Iterator[str]:
    title = escape(document.title)
    yield f'<!doctype html><html lang="{_TONGUES[document.language]}"><head><meta charset="utf-8">'
    yield f'<meta http-equiv="Content-Security-Policy" content="{_POLICY}">'
    style = _STYLE + "\n".join(page_css(document))
    yield f"<title>{title}</title><style>{style}</style></head><body>"
    if document.title_page:
        yield from _title_page(document)
    if document.contents:
        yield f"<nav><h2>{escape(document.contents)}</h2><ol>"
        for number, section in enumerate(document.sections):
            indent = f"padding-left: {section.level - 1}rem"
            yield f'<li style="{indent}"><a href="#s{number}">{escape(section.title)}</a></li>'
        yield "</ol></nav>"
    yield "<main>"
    for number, section in enumerate(document.sections):
        yield from _section(number, section)
    yield "</main></body></html>"


def _title_page(document: Document) -> Iterator[str]:
    title = escape(document.title)
    yield "<header>"
    if document.logo is not None and document.logo.on_title_page:
        width, height = document.logo.size_on_title_page()
        size = f"width: {width:g}mm; height: {height:g}mm"
        yield f'<img src="{data_uri(document.logo)}" alt="" style="{size}">'
    yield f"<h1>{title}</h1><p>{escape(document.description)}</p><dl>"
    for name, value in document.facts:
        yield f"<dt>{escape(name)}</dt><dd>{escape(value)}</dd>"
    yield "</dl></header>"


def _section(number: int, section: Section) -> Iterator[str]:
    level = min(6, section.level + 1)
    about = f"<small>{escape(section.about)}</small>" if section.about else ""
    names = f'data-object="{escape(section.title)}" data-path="{escape(section.path)}"'
    yield f'<section><h{level} id="s{number}" {names}>{escape(section.title)}{about}</h{level}>'
    for block in section.blocks:
        if isinstance(block, Listing):
            yield f'<p class="title">{escape(block.title)}</p>'
            # a line end between the lines would be one more line of the text that is preformatted
            lines = "".join(
                '<span class="l">'
                + "".join(f'<span class="{run.style}">{escape(run.text)}</span>' for run in line)
                + "</span>"
                for line in block.lines
            )
            yield f"<pre>{lines}</pre>"
        elif isinstance(block, Table):
            yield from _table(block)
        else:
            yield f"<p>{escape(block.text)}</p>"
    yield "</section>"


def _table(table: Table) -> Iterator[str]:
    if table.title:
        yield f'<p class="title">{escape(table.title)}</p>'
    heads = "".join(f"<th>{escape(head)}</th>" for head in table.heads)
    yield f"<table><thead><tr>{heads}</tr></thead><tbody>"
    for row in table.rows:
        yield "<tr>" + "".join(f"<td>{escape(cell)}</td>" for cell in row) + "</tr>"
    yield "</tbody></table>"

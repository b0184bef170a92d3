"""The text file of an object with code: one plain IEC text, split again when it is read.

A file is the declaration, the implementation and the closing keyword, each from its own line. Where the
implementation begins is found by reading the declaration; where that would give another split (a declaration
that is not finished, say), the number of lines of the declaration is kept in the index beside the file.
"""

from __future__ import annotations

import re
from dataclasses import dataclass

from tappet.iec.sections import declaration_end, subkind_of
from tappet.iec.tokens import words
from tappet.project.kind_registry import kinds
from tappet.project.object_kind import IecText


@dataclass(frozen=True, slots=True)
class Parts:
    """The two texts of an object; None for a part that its kind does not have."""

    declaration: str | None
    implementation: str | None


def write_text(form: IecText, name: str, parts: Parts) -> tuple[str, int | None]:
    """The file of an object, and the number of lines of its declaration where reading would not find it."""
    declaration = parts.declaration or ""
    text = _joined(form, name, parts)
    if read_text(form, name, text) == parts:
        return text, None
    split = declaration.count("\n") + 1 if declaration else 0
    return text, split


def read_text(form: IecText, name: str, text: str, split: int | None = None) -> Parts:
    """The parts of a file; `split` is the number of lines of the declaration where the index has it."""
    body = _without_opening(form, name, text)
    if not (form.declaration and form.implementation):
        content = _without_newline(_without_end(body, _end(form, name, body)))
        return Parts(content, None) if form.declaration else Parts(None, content)
    if split is None:
        content = _without_newline(_without_end(body, _end(form, name, body)))
        cut = declaration_end(content)
        return Parts(content[:cut], content[cut:].removeprefix("\n"))
    lines = body.split("\n")
    declaration = "\n".join(lines[:split])
    rest = "\n".join(lines[split:])
    return Parts(declaration, _without_newline(_without_end(rest, _end(form, name, declaration))))


def implementation_line(form: IecText, name: str, parts: Parts, text: str) -> int | None:
    """The line, from 0, at which the implementation stands in the text of a file; None where it is not in
    it.
    """
    if not parts.implementation:
        return None
    lines, wanted = text.split("\n"), parts.implementation.split("\n")
    declared = parts.declaration.count("\n") + 1 if parts.declaration else 0
    usual = declared + (_opening(form, name) is not None)
    places = (usual, *(line for line in range(len(lines) - len(wanted), -1, -1) if line != usual))
    return next((line for line in places if lines[line : line + len(wanted)] == wanted), None)


def declaration_line(form: IecText, name: str, text: str) -> int:
    """The line, from 0, at which the declaration stands in the text of a file."""
    opening = _opening(form, name)
    return 1 if opening is not None and text.startswith(f"{opening}\n") else 0


def kind_of_text(text: str) -> str | None:
    """The kind that a text says it is of; one that claims some of such texts is asked first."""
    subkind = subkind_of(text)
    forms = {name: kind.folder for name, kind in kinds().items() if isinstance(kind.folder, IecText)}
    fitting = {name: form for name, form in forms.items() if subkind in form.declared_as}
    claiming = (name for name, form in fitting.items() if form.claims is not None and form.claims(text))
    rest = (name for name, form in fitting.items() if form.claims is None)
    return next(claiming, None) or next(rest, None)


def _joined(form: IecText, name: str, parts: Parts) -> str:
    pieces = []
    opening = _opening(form, name)
    if opening:
        pieces.append(opening)
    if parts.declaration is not None and (parts.declaration or not form.implementation):
        pieces.append(parts.declaration)
    if parts.implementation:
        pieces.append(parts.implementation)
    end = _end(form, name, parts.declaration or "")
    if end:
        pieces.append(end)
    return "".join(f"{piece}\n" for piece in pieces)


def _opening(form: IecText, name: str) -> str | None:
    """The line that begins the file of an object whose declaration does not name it."""
    return form.opening(name) if form.opening is not None else None


def _end(form: IecText, name: str, declaration: str) -> str | None:
    """The line that ends the file."""
    return form.end(name, declaration) if form.end is not None else None


def _without_opening(form: IecText, name: str, text: str) -> str:
    opening = _opening(form, name)
    if opening is None or text.startswith(f"{opening}\n"):
        return text if opening is None else text[len(opening) + 1 :]
    scan = words(text)
    first = next(scan, None)
    if first is None or first.text != opening.split()[0]:
        return text
    end = first.end
    if " " in opening:  # a name follows the keyword
        named = next(scan, None)
        end = named.end if named is not None else end
        colon = next(scan, None)
        if colon is not None and colon.text == ":" and "\n" not in text[end : colon.start]:
            end = colon.end
    line, newline, rest = text[end:].partition("\n")
    return text[: first.start].lstrip() + (line.strip() and line.lstrip() + newline) + rest


def _without_end(body: str, end: str | None) -> str:
    """The text before the closing keyword: empty, or whole lines."""
    if end is not None:
        if body == f"{end}\n":
            return ""
        if body.endswith(f"\n{end}\n"):
            return body[: -len(end) - 1]
        found = re.search(rf"(?:^|(?<=\n)|(?<=[\s;])){end}[ \t]*;?\s*\Z", body, re.IGNORECASE)
        if found is not None:
            body = body[: found.start()].rstrip(" \t")
    return body if not body or body.endswith("\n") else f"{body}\n"


def _without_newline(content: str) -> str:
    return content.removesuffix("\n")

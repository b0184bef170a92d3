"""CoDeSys 2.3: `.EXP` exports and library texts, also of TwinCAT 2 and their many relatives.

An export is IEC text with comments of the form `(* @KEY := 'value' *)` that say the folder, the name of a
global variable list and where a declaration ends. Tasks, libraries and other parts have forms of their own.
"""

from __future__ import annotations

import re
from itertools import chain, islice, repeat

from tappet.iec.tokens import COMMENT, STRING, blanked, unnested_comments, words
from tappet.project.exchange.codesys23_parts import without_parts
from tappet.project.exchange.codesys23_persistent import LIST, move_persistent
from tappet.project.exchange.codesys23_words import pointers_of, say_in_words_of_today
from tappet.project.exchange.drafts import Batch, Draft
from tappet.project.exchange.report import ImportReport
from tappet.project.exchange.split_text import split_text
from tappet.project.exchange.standard_tasks import read_configurations

_MARK = re.compile(r"\(\*\s*@(?P<key>[A-Z_]+)\s*:=\s*(?P<value>'(?:\$.|[^'\n])*'|[^*\n]*)(?P<rest>[^*]*)\*\)")
_DRAWN = {f"_{language}_BODY": language for language in ("LD", "FBD", "CFC", "SFC")}
"""The language of a body, by its first word."""
_IL_LINE = re.compile(
    r"\s*(?:\w+:\s*)?(?:LDN?|STN?|CALC?N?|JMPC?N?|ANDN?|ORN?|XORN?|S|R)\s+[\w.%^\[\]]+\s*(?:\(\*.*)?$",
    re.IGNORECASE,
)
_CONFIGURATION = "Variable_Configuration"
"""The name of the list of addresses in CoDeSys 2.3."""


def read_export(source: str, text: str, batch: Batch, report: ImportReport) -> None:
    """Take the objects of an export in. `text` has line feeds only."""
    text = _without_nesting(source, text, report)
    text, marks = _without_marks(text)
    text = without_parts(source, text, batch, report)
    split = split_text(
        source,
        text,
        report,
        list_name="Global_Variables",
        declaration_ends=tuple(at for at, key, _ in marks if key == "END_DECLARATION"),
        list_names=tuple((at, value) for at, key, value in marks if key == "GLOBAL_VARIABLE_LIST"),
    )
    paths = [(at, value) for at, key, value in marks if key == "PATH"]
    lists = (item for item in batch.loose.children if item.kind == "persistent")
    kept = next(lists, None) or Draft("persistent", LIST, {}, source)
    index = 0
    path: tuple[str, ...] = ()
    for offset, draft in split.heads:
        while index < len(paths) and paths[index][0] <= offset:
            path = tuple(part for part in re.split(r"\\?/", paths[index][1]) if part.strip())
            index += 1
        declaration = str(draft.data.get("declaration", ""))
        if draft.kind == "gvl" and not split.list_names and "VAR_CONFIG" in declaration.upper():
            draft.name = _CONFIGURATION  # TwinCAT 2 gives its list no name
        pointers = pointers_of(declaration)
        for item in (draft, *draft.children):
            _report_language(item, report)
            say_in_words_of_today(item, pointers, batch.places, report)
        if not move_persistent(draft, kept, report):
            batch.loose.below(path, source).children.append(draft)
    if kept.data and kept not in batch.loose.children:
        batch.loose.children.append(kept)
    read_configurations(split, batch.loose, report)


def _without_marks(text: str) -> tuple[str, list[tuple[int, str, str]]]:
    """The text with its marks blanked out, and these: offset, key, value. Lines and offsets stay."""
    marks: list[tuple[int, str, str]] = []

    def blank(match: re.Match[str]) -> str:
        marks.append((match.start(), match["key"], match["value"].strip().strip("'")))
        return re.sub(r"[^\n]", " ", match.group())

    return _MARK.sub(blank, text), marks


def _without_nesting(source: str, text: str, report: ImportReport) -> str:
    """Texts made for comments that do not nest: an opening inside a comment is taken apart."""
    flags = [
        (match.start(), match["value"]) for match in _MARK.finditer(text) if match["key"] == "NESTEDCOMMENTS"
    ]
    if not any(value.strip("'").lower() == "no" for _, value in flags):
        return text
    pieces = [text[: flags[0][0]]]
    for number, (start, value) in enumerate(flags):
        stop = flags[number + 1][0] if number + 1 < len(flags) else len(text)
        part = text[start:stop]
        if value.strip("'").lower() == "no":
            flat = unnested_comments(part)
            if flat != part:
                line = text.count("\n", 0, start) + 1
                note = "comments do not nest in this object; '(*' inside a comment became '( *'"
                report.add("changed", source, note, line=line)
            part = flat
        pieces.append(part)
    return "".join(pieces)


def _report_language(draft: Draft, report: ImportReport) -> None:
    """Set the language of a body that is not ST."""
    text = draft.data.get("implementation")
    if not text:
        return
    language = _language(text)
    if language is not None:
        draft.data["language"] = language
    if language not in (None, "IL"):
        note = f"the body in {language} is kept as it is; it cannot be compiled yet"
        report.add("kept", draft.source, note, name=draft.name, line=draft.line)


def _language(text: str) -> str | None:
    """The language of a body, None for ST.

    Charts have a form of their own; steps as IEC 61131-3 writes them are text that compiles.
    """
    first, _, third = islice(chain((word.text for word in words(text)), repeat("")), 3)
    if first in _DRAWN:
        return _DRAWN[first]
    if first in ("_INITIAL_STEP", "_STEP") or first.startswith("_SFC"):
        return "SFC"
    if first == "INITIAL_STEP" and third != ":":
        return "SFC"
    return "IL" if _is_il(text) else None


def _is_il(text: str) -> bool:
    """Whether a body is instruction list: its first lines are, and none ends as a statement does."""
    plain = blanked(text, COMMENT, STRING)
    lines = [line for line in plain.split("\n") if line.strip()]
    return bool(lines) and any(_IL_LINE.match(line) for line in lines[:3]) and ";" not in plain

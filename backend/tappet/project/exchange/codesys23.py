"""CoDeSys 2.3: `.EXP` exports and library texts, also of TwinCAT 2 and their many relatives.

An export is IEC text with comments of the form `(* @KEY := 'value' *)` that say the folder, the name of a
global variable list and where a declaration ends. Other parts (configurations, visualisations, libraries)
have forms of their own and are reported.
"""

from __future__ import annotations

import re

from tappet.project.declaration_text import words
from tappet.project.exchange.codesys23_words import pointers_of, say_in_words_of_today
from tappet.project.exchange.drafts import Batch, Draft, task_configuration
from tappet.project.exchange.report import ImportReport
from tappet.project.exchange.split_text import split_text
from tappet.project.exchange.standard_tasks import read_configurations, task_draft

_MARK = re.compile(r"\(\*\s*@(?P<key>[A-Z_]+)\s*:=\s*(?P<value>'(?:\$.|[^'\n])*'|[^*\n]*)(?P<rest>[^*]*)\*\)")
_PART = re.compile(
    r"^[ \t]*(?P<head>PLC_CONFIGURATION|_?ALARM_?CONFIG\w*|_?WORKSPACE|VISUALISATION|LIBRARY"
    r"|_?TASK_?CONFIG\w*|_?WATCH_?LIST\w*|_?SAMPLING\w*|_?TRACE\w*|_?CNC\w*|_?CAM\w*|RESOURCE|_?NETVAR\w*|_?PARAMETER_?LIST\w*)\b"
    r"[^\n]*$",
    re.MULTILINE,
)
_PART_ENDS = {
    "PLC_CONFIGURATION": r"^[ \t]*PLC_END\b",
    "VISUALISATION": r"^[ \t]*END_VISUALISATION\b",
    "LIBRARY": r"^[ \t]*(?:EndLibrary|END_LIBRARY)\b",
}
_OBJECT_HEAD = re.compile(
    r"^[ \t]*(?:\(\*[ \t]*@NESTEDCOMMENTS|(?:PROGRAM|FUNCTION|FUNCTION_?BLOCK|TYPE|VAR_GLOBAL)\b)",
    re.MULTILINE,
)
_CLOSING = {
    "PROGRAM": frozenset(["END_PROGRAM"]),
    "FUNCTION": frozenset(["END_FUNCTION"]),
    "FUNCTION_BLOCK": frozenset(["END_FUNCTION_BLOCK", "END_FUNCTIONBLOCK"]),
    "FUNCTIONBLOCK": frozenset(["END_FUNCTION_BLOCK", "END_FUNCTIONBLOCK"]),
    "ACTION": frozenset(["END_ACTION"]),
    "TYPE": frozenset(["END_TYPE"]),
    "VAR_GLOBAL": frozenset(["END_VAR"]),
}
"""What closes an object, by what opens it."""
_TASK = re.compile(
    r"\bTASK\s+(?P<name>\w+)\s*\((?P<settings>[^()]*)\)\s*:?\s*(?P<calls>[^;]*);?", re.IGNORECASE
)
_GRAPHICAL = re.compile(r"\s*_(LD|FBD|CFC|SFC)_BODY\b")
_SFC_BODY = re.compile(r"\s*(?:_?INITIAL_STEP|_SFC\w*|_STEP)\b", re.IGNORECASE)
_IL_LINE = re.compile(
    r"\s*(?:\w+:\s*)?(?:LDN?|STN?|CALC?N?|JMPC?N?|ANDN?|ORN?|XORN?|S|R)\s+[\w.%^\[\]]+\s*(?:\(\*.*)?$",
    re.IGNORECASE,
)
_COMMENTS = re.compile(r"\(\*|\*\)")


def read_export(source: str, text: str, batch: Batch, report: ImportReport) -> None:
    """Take the objects of an export in. `text` has line feeds only."""
    text = _without_nesting(source, text, report)
    text, marks = _without_marks(text)
    text = _without_parts(source, text, batch, report)
    split = split_text(
        source,
        text,
        report,
        list_name="Global_Variables",
        declaration_ends=tuple(at for at, key, _ in marks if key == "END_DECLARATION"),
        list_names=tuple((at, value) for at, key, value in marks if key == "GLOBAL_VARIABLE_LIST"),
    )
    paths = [(at, value) for at, key, value in marks if key == "PATH"]
    index = 0
    path: tuple[str, ...] = ()
    for offset, draft in split.heads:
        while index < len(paths) and paths[index][0] <= offset:
            path = tuple(part for part in re.split(r"\\?/", paths[index][1]) if part.strip())
            index += 1
        pointers = pointers_of(draft.data.get("declaration", ""))
        for item in (draft, *draft.children):
            _tell_language(item, report)
            say_in_words_of_today(item, pointers, report)
        batch.loose.below(path, source).children.append(draft)
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
            flat = _flat(part)
            if flat != part:
                line = text.count("\n", 0, start) + 1
                note = "comments do not nest in this object; '(*' inside a comment became '( *'"
                report.add("changed", source, note, line=line)
            part = flat
        pieces.append(part)
    return "".join(pieces)


def _flat(text: str) -> str:
    pieces: list[str] = []
    position, inside = 0, False
    for edge in _COMMENTS.finditer(text):
        pieces.append(text[position : edge.start()])
        opens = edge.group() == "(*"
        pieces.append("( *" if opens and inside else edge.group())
        inside = opens or inside
        if not opens:
            inside = False
        position = edge.end()
    return "".join([*pieces, text[position:]])


def _without_parts(source: str, text: str, batch: Batch, report: ImportReport) -> str:
    """The text with the parts that are no IEC objects blanked out and reported; tasks are read."""
    position = 0
    pieces: list[str] = []
    while (match := _next_part(text, position)) is not None:
        head = match["head"].upper()
        ending = _PART_ENDS.get(head)
        found = re.compile(ending, re.MULTILINE | re.IGNORECASE).search(text, match.end()) if ending else None
        following = _OBJECT_HEAD.search(text, match.end())
        stop = found.end() if found else following.start() if following else len(text)
        part = text[match.start() : stop]
        line = text.count("\n", 0, match.start()) + 1
        if not _read_tasks(source, part, line, batch, report):
            report.add(
                "refused", source, _WHY.get(head, "this part of an export is not read"), name=head, line=line
            )
        pieces += [text[position : match.start()], re.sub(r"[^\n]", " ", part)]
        position = stop
    return "".join([*pieces, text[position:]])


def _next_part(text: str, position: int) -> re.Match[str] | None:
    """The next part that is no IEC object. In objects its words are names; they stand in comments."""
    closing: frozenset[str] = frozenset()
    for word in words(text, position):
        if closing:
            if word.text in closing:
                closing = frozenset()
        elif word.text in _CLOSING:
            closing = _CLOSING[word.text]
        elif word.text[0].isalpha() or word.text[0] == "_":
            match = _PART.match(text, text.rfind("\n", 0, word.start) + 1)
            if match is not None and match.start("head") == word.start:
                return match
    return None


_WHY = {
    "PLC_CONFIGURATION": "the controller configuration is of a device that is not here; add devices anew",
    "VISUALISATION": "visualisations of CoDeSys 2.3 are not read",
    "LIBRARY": "the file names a library; add it in the library manager, or import its own text",
}


def _read_tasks(source: str, part: str, line: int, batch: Batch, report: ImportReport) -> bool:
    found = False
    for match in _TASK.finditer(part):
        at = line + part.count("\n", 0, match.start())
        calls = re.findall(r"[^\W\d]\w*(?=\s*(?:\(|,|$))", match["calls"])
        draft = task_draft(source, at, match["name"], match["settings"], calls, report)
        task_configuration(batch.loose).children.append(draft)
        found = True
    return found


def _tell_language(draft: Draft, report: ImportReport) -> None:
    """Set the language of a body that is not ST."""
    text = draft.data.get("implementation")
    if not text:
        return
    graphical = _GRAPHICAL.match(text)
    language = graphical[1] if graphical else "SFC" if _SFC_BODY.match(text) else None
    if language is None and _is_il(text):
        language = "IL"
    if language is not None:
        draft.data["language"] = language
    if language not in (None, "IL"):
        note = f"the body in {language} is kept as it is; it cannot be compiled yet"
        report.add("kept", draft.source, note, name=draft.name, line=draft.line)


def _is_il(text: str) -> bool:
    """Whether a body is instruction list: its first lines are, and none ends as a statement does."""
    plain = re.sub(r"\(\*.*?\*\)", "", text, flags=re.DOTALL)
    lines = [line for line in plain.split("\n") if line.strip()]
    return bool(lines) and any(_IL_LINE.match(line) for line in lines[:3]) and ";" not in plain

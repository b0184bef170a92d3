"""Parts of a CoDeSys 2.3 export that are no IEC objects: tasks and libraries are read, others reported."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from tappet.iec.tokens import NAME, Word, words
from tappet.project.exchange.drafts import Batch, Draft, library_manager, task_configuration
from tappet.project.exchange.libraries import reference
from tappet.project.exchange.report import ImportReport
from tappet.project.exchange.standard_tasks import read_tasks, task_draft

_PART = re.compile(
    r"^[ \t]*(?P<head>PLC_CONFIGURATION|MACRO|_?ALARM_?CONFIG\w*|_?WORKSPACE|VISUALISATION|LIBRARY"
    r"|_?TASK_?CONFIG\w*|_?WATCH_?LIST\w*|_?SAMPLING\w*|_?TRACE\w*|_?CNC\w*|_?CAM\w*|RESOURCE|_?NETVAR\w*|_?PARAMETER_?LIST\w*)\b"
    r"[^\n]*$",
    re.MULTILINE,
)
_ENDS = {
    "PLC_CONFIGURATION": "PLC_END",
    "VISUALISATION": "END_VISUALISATION",
    "LIBRARY": "EndLibrary|END_LIBRARY",
    "RESOURCE": "END_RESOURCE",
    "MACRO": "END_MACRO",
    "_WORKSPACE": "_END_WORKSPACE",
    "_ALARMCONFIG": "_END_ALARMCONFIG",
}
_OBJECT_HEAD = re.compile(r"^[ \t]*(?:PROGRAM|FUNCTION|FUNCTION_?BLOCK|TYPE|VAR_GLOBAL)\b", re.MULTILINE)
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
_SYSTEM_EVENT = re.compile(r"\{\s*event_task\s*:\s*'(?P<event>\w*)'\s*,\s*'[^']*'\s*,\s*'(?P<call>\w+)'")
_LIBRARY = re.compile(r"LIBRARY\s*\n[ \t]*(?P<name>.+?\.lib)\b", re.IGNORECASE)
_LIBRARY_POU = re.compile(r"^[ \t]*(\w+):[ \t]*\d+[ \t]*$", re.MULTILINE)
_OURS = {"standard": "Standard", "util": "Util"}
_NOT_NEEDED = {"iecsfc": "charts run without it", "analyzation": "charts run without it"}
_NAMES_SHOWN = 12
_NAMED = re.compile(
    r"^_SYMBOLIC_NAME: '(?P<channel>\w*)'\s*\n_COMMENT: '(?P<comment>[^'\n]*)'\s*\n_CHANNEL_MODE: '\w*'\s*\n"
    r"_IECADR: (?P<address>%\S+)|^_BIT \d+: (?P<bit_address>%\S+) '(?P<bit>\w*)' '(?P<bit_comment>[^'\n]*)'",
    re.MULTILINE,
)
_TYPES = {"B": "BYTE", "W": "WORD", "D": "DWORD", "R": "REAL", "L": "LWORD"}
_NAMES_LIST = "PLC_CONFIGURATION"

_WHY = {
    "PLC_CONFIGURATION": "the controller configuration is of a device that is not here; add devices by hand",
    "VISUALISATION": "visualisations of CoDeSys 2.3 are not read",
    "_WORKSPACE": "settings of the other editor are not read",
    "_ALARMCONFIG": "the alarm configuration is not read",
    "MACRO": "macros of the other editor are not read",
}


def without_parts(source: str, text: str, batch: Batch, report: ImportReport) -> str:
    """The text with the parts that are no IEC objects blanked out and reported; lines stay."""
    position = 0
    pieces: list[str] = []
    while (match := _next_part(text, position)) is not None:
        head = match["head"].upper()
        stop = _end_of_part(text, match.end(), head)
        part = text[match.start() : stop]
        line = text.count("\n", 0, match.start()) + 1
        if head == "LIBRARY":
            _read_library(source, part, line, batch, report)
        elif head == "PLC_CONFIGURATION" and _read_names(source, part, line, batch, report):
            pass
        elif not _read_tasks(source, part, line, batch, report):
            why = _WHY.get(head, "this part of an export is not read")
            name = (
                match.group().split()[1] if head == "VISUALISATION" and " " in match.group().strip() else head
            )
            report.add("refused", source, why, name=name, line=line)
        pieces += [text[position : match.start()], re.sub(r"[^\n]", " ", part)]
        position = stop
    return "".join([*pieces, text[position:]])


def _end_of_part(text: str, position: int, head: str) -> int:
    """Where a part ends: behind its own end, or before the object or part that follows."""
    ending = _ENDS.get(head)
    if ending is not None:
        found = re.compile(rf"^[ \t]*(?:{ending})\b", re.MULTILINE | re.IGNORECASE).search(text, position)
        if found is not None:
            return found.end()
    following = [m.start() for m in (_OBJECT_HEAD.search(text, position), _PART.search(text, position)) if m]
    return min(following, default=len(text))


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


def _read_names(source: str, part: str, line: int, batch: Batch, report: ImportReport) -> bool:
    """Take the variables in that a controller configuration declares; False when it names none."""
    rows: list[str] = []
    for match in _NAMED.finditer(part):
        name = match["channel"] or match["bit"]
        if not name:
            continue
        address = match["address"] or match["bit_address"]
        flat = batch.places.flat(address, 0)
        type_ = _TYPES.get(address[2:3].upper(), "BOOL")
        comment = match["comment"] or match["bit_comment"] or ""
        rows.append(
            f"\t{name} AT {flat[1] if flat else address} : {type_};{f' (* {comment} *)' if comment else ''}"
        )
    if not rows:
        return False
    declaration = "\n".join(["VAR_GLOBAL", *rows, "END_VAR"])
    batch.loose.children.append(Draft("gvl", _NAMES_LIST, {"declaration": declaration}, source, line))
    note = (
        f"its {len(rows)} symbolic names became variables with types of the size of the addresses: check"
        " them; the modules themselves are not read"
    )
    report.add("changed", source, note, name=_NAMES_LIST, line=line)
    return True


def _read_tasks(source: str, part: str, line: int, batch: Batch, report: ImportReport) -> bool:
    """Take the tasks of a part in; False when it has none and is no list of them."""
    for event in _SYSTEM_EVENT.finditer(part):
        at = line + part.count("\n", 0, event.start())
        note = f"the system event calls '{event['call']}'; call it from a task"
        report.add("refused", source, note, name=event["event"], line=at)
    tasks = list(read_tasks(part))
    for task in tasks:
        at = line + part.count("\n", 0, task.start)
        calls = list(_called(part, task.behind))
        draft = task_draft(source, at, task.name, task.settings, calls, report)
        task_configuration(batch.loose).children.append(draft)
    first = next(words(part), None)
    return bool(tasks) or (first is not None and first.text == "RESOURCE")


def _called(text: str, scan: Sequence[Word]) -> Iterator[str]:
    """The programs that a task calls: `PLC_PRG();`, `A, B;`."""
    depth = 0
    for i, word in enumerate(scan):
        depth += (word.text == "(") - (word.text == ")")
        following = scan[i + 1].text if i + 1 < len(scan) else ";"
        if depth == 0 and following in "(,;" and NAME.fullmatch(word.text):
            yield text[word.start : word.end]


def _read_library(source: str, part: str, line: int, batch: Batch, report: ImportReport) -> None:
    """Refer to a library that is here, or report what of it is missing."""
    match = _LIBRARY.match(part.lstrip())
    name = re.split(r"[\\/]", match["name"])[-1] if match else "LIBRARY"
    stem = name.rpartition(".")[0].casefold()
    if stem in _OURS:
        references = library_manager(batch.loose).data.setdefault("references", [])
        if not any(item["name"] == _OURS[stem] for item in references):
            references.append(reference(source, _OURS[stem], "", "", report, line))
        return
    if stem in _NOT_NEEDED:
        report.add("changed", source, f"the library is left out: {_NOT_NEEDED[stem]}", name=name, line=line)
        return
    contents = [item for item in _LIBRARY_POU.findall(part) if item.upper() not in ("NUMOFPOUS", "NUMOFGVLS")]
    shown = ", ".join(contents[:_NAMES_SHOWN]) + (" ..." if len(contents) > _NAMES_SHOWN else "")
    note = "the library is not here; import its own export"
    report.add("refused", source, f"{note}: {shown}" if shown else note, name=name, line=line)

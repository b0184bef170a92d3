"""TwinCAT 3: one object a file, `.TcPOU`, `.TcDUT`, `.TcGVL`, `.TcIO` and task files `.TcTTO`.

All are XML with the texts in CDATA sections; methods and the like stand inside the file of their block and
name their folder in an attribute.
"""

from __future__ import annotations

from tappet.project.declaration_text import as_parameter_list, subkind_of
from tappet.project.exchange.drafts import Draft, body, hex_id
from tappet.project.exchange.report import ImportReport
from tappet.project.exchange.standard_tasks import cycle, priority
from tappet.project.exchange.without_result import mark_without_result
from tappet.project.exchange.xml_tree import Element, read_xml, xml_text

ENDINGS = (".tcpou", ".tcdut", ".tcgvl", ".tcio", ".tctto")
"""Endings of the files that hold an object, in lower case."""

NOT_READ = {
    ".tcvis": "visualisations",
    ".tcvmo": "visualisation managers",
    ".tctlo": "text lists",
    ".tctleo": "text lists",
    ".tcgtlo": "text lists",
    ".tcipo": "image pools",
    ".tcrmo": "recipes",
    ".tcrdo": "recipes",
}
"""What files of other kinds hold, by their endings."""

_KINDS = {"POU": "pou", "DUT": "dut", "GVL": "gvl", "Itf": "interface"}
_CHILD_KINDS = {"Method": "method", "Action": "action", "Transition": "transition", "Property": "property"}
_GRAPHICAL = {"NWL": "FBD", "FBD": "FBD", "LD": "LD", "CFC": "CFC", "SFC": "SFC"}
_SILENT = frozenset(["Declaration", "Implementation", "Folder", "LineIds", "ObjectProperties", "Get", "Set"])


def read_object(source: str, content: bytes, report: ImportReport) -> list[Draft]:
    """The objects of a file: one, as a rule. Raises ExchangeError for what is no sound XML."""
    root = read_xml(source, content)
    found: list[Draft] = []
    for item in root if root.tag == "TcPlcObject" else [root]:
        if item.tag in _KINDS:
            found.append(_object(source, item, report))
        elif item.tag == "Task":
            found.append(_task(source, item, report))
        else:
            text = f"objects of the kind <{item.tag}> are not read"
            report.add("refused", source, text, name=item.get("Name"), line=item.line)
    if not found and not report.entries:
        report.add("refused", source, "the file holds no object", line=root.line)
    return found


def _object(source: str, item: Element, report: ImportReport) -> Draft:
    draft = _draft(source, item, _KINDS[item.tag])
    draft.data = {"declaration": _text(item, "Declaration")}
    if draft.kind == "gvl" and item.get("ParameterList").casefold() == "true":
        draft.data["declaration"] = as_parameter_list(draft.data["declaration"])
    if draft.kind == "pou":
        _implementation(draft, item, report, draft.name)
        mark_without_result(draft, report)
    if not draft.data["declaration"] or subkind_of(draft.data["declaration"]) != "function":
        _folders(draft, item)  # a function has none; TwinCAT keeps empty ones in its file
    for child in item:
        if child.tag in _CHILD_KINDS:
            folders = tuple(part for part in child.get("FolderPath").split("\\") if part)
            draft.below(folders).children.append(_child(source, child, report, draft))
        elif child.tag not in _SILENT:
            text = f"parts of the kind <{child.tag}> are not read"
            report.add("refused", source, text, name=draft.name, line=child.line)
    return draft


def _child(source: str, item: Element, report: ImportReport, owner: Draft) -> Draft:
    draft = _draft(source, item, _CHILD_KINDS[item.tag])
    name = f"{owner.name}.{draft.name}"
    if draft.kind == "property":
        draft.data = {"declaration": _text(item, "Declaration")}
        for tag in ("Get", "Set"):
            accessor = item.child(tag)
            if accessor is not None:
                part = _draft(source, accessor, "accessor")
                part.name = tag
                part.data = {"declaration": _text(accessor, "Declaration")}
                _implementation(part, accessor, report, f"{name}.{tag}")
                draft.children.append(part)
        return draft
    if draft.kind == "method":
        draft.data = {"declaration": _text(item, "Declaration")}
    _implementation(draft, item, report, name)
    if draft.kind == "transition":
        report.add(
            "kept",
            source,
            "transitions belong to a drawn chart, which is kept with them",
            name=name,
            line=item.line,
        )
    return draft


def _implementation(draft: Draft, item: Element, report: ImportReport, name: str) -> None:
    """The body: text, or a graphical one as the XML that it is."""
    held = item.child("Implementation")
    part = next(iter(held), None) if held is not None else None
    if held is None or part is None:
        draft.data |= body("ST", "")
    elif part.tag in ("ST", "IL"):
        draft.data |= body(part.tag, _clean(part.text()))
    elif part.tag in _GRAPHICAL:
        draft.data |= body(_GRAPHICAL[part.tag], xml_text(held))
    else:
        draft.data |= body("SFC" if part.tag == "StateChart" else "FBD", xml_text(held))
    language = draft.data["language"]
    if language not in ("ST", "IL"):
        kind = part.tag if part is not None else language
        text = f"the body in {kind} is kept as it is; it cannot be compiled yet"
        report.add("kept", draft.source, text, name=name, line=item.line)


def _folders(draft: Draft, item: Element, above: tuple[str, ...] = ()) -> None:
    for folder in item.children("Folder"):
        path = (*above, folder.get("Name"))
        made = draft.below(path)
        made.id = made.id or hex_id(folder.get("Id"))
        made.line = folder.line
        _folders(draft, folder, path)


def _task(source: str, item: Element, report: ImportReport) -> Draft:
    draft = _draft(source, item, "task")
    micros = _text(item, "CycleTime").strip()
    data: dict[str, object] = {
        "priority": priority(source, item.line, draft.name, _text(item, "Priority").strip(), report),
        "pous": [
            {"name": _text(call, "Name").strip()}
            for call in item.children("PouCall")
            if _text(call, "Name").strip()
        ],
    }
    if micros and micros != "0":
        data["interval"] = cycle(source, item.line, draft.name, micros, report)
    draft.data = data
    return draft


def _draft(source: str, item: Element, kind: str) -> Draft:
    return Draft(kind, item.get("Name"), {}, source, item.line, [], hex_id(item.get("Id")))


def _text(item: Element, tag: str) -> str:
    child = item.child(tag)
    return _clean(child.text()) if child is not None else ""


def _clean(text: str) -> str:
    return text.replace("\r\n", "\n").replace("\r", "\n").removesuffix("\n")

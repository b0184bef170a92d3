"""TwinCAT 3: one object a file, `.TcPOU`, `.TcDUT`, `.TcGVL`, `.TcIO`, `.TcTLEO` and task files `.TcTTO`.

All are XML with the texts in CDATA sections; methods and the like stand inside the file of their block and
name their folder in an attribute.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from tappet.iec.languages import is_plain_text
from tappet.iec.sections import subkind_of
from tappet.project.exchange.drafts import Draft, body, hex_id
from tappet.project.exchange.report import ImportReport
from tappet.project.exchange.standard_tasks import cycle, priority
from tappet.project.exchange.without_result import mark_without_result
from tappet.project.exchange.xml_tree import Element, read_xml, xml_text
from tappet.project.kind_registry import kinds
from tappet.project.object_kind import ObjectKind

ENDINGS = (".tcpou", ".tcdut", ".tcgvl", ".tcio", ".tctleo", ".tctto")
"""Endings of the files that hold an object, in lower case."""

NOT_READ = {
    ".tcvis": "visualisations",
    ".tcvmo": "visualisation managers",
    ".tctlo": "text lists",
    ".tcgtlo": "text lists",
    ".tcipo": "image pools",
    ".tcrmo": "recipes",
    ".tcrdo": "recipes",
}
"""What files of other kinds hold, by their endings."""

_TRANSITION = "Transition"
"""What belongs to a drawn chart; no kind of object."""
_GRAPHICAL = {"NWL": "FBD", "FBD": "FBD", "LD": "LD", "CFC": "CFC", "SFC": "SFC"}
_NOT_USED = frozenset(["LineIds"])
"""Elements that say nothing about the program, and are most of a large file."""
_SILENT = frozenset(["Declaration", "Implementation", "Folder", "ObjectProperties", "Get", "Set"])


def read_object(source: str, content: bytes, report: ImportReport) -> list[Draft]:
    """The objects of a file: one, as a rule. Raises ExchangeError for what is no sound XML."""
    root = read_xml(source, content, _NOT_USED)
    found: list[Draft] = []
    tags = _tags(member=False)
    for item in root if root.tag == "TcPlcObject" else [root]:
        if item.tag in tags:
            found.append(_object(source, item, tags[item.tag], report))
        else:
            text = f"objects of the kind <{item.tag}> are not read"
            report.add("refused", source, text, name=item.get("Name"), line=item.line)
    if not found and not report.entries:
        report.add("refused", source, "the file holds no object", line=root.line)
    return found


@dataclass(frozen=True, slots=True)
class TwinCatElement:
    """An element that is an object, as a kind reads it."""

    source: str
    item: Element
    report: ImportReport
    title: str
    """How messages name the object."""

    def accessors(self, draft: Draft) -> None:
        """Get and Set of a property."""
        for tag in ("Get", "Set"):
            accessor = self.item.child(tag)
            if accessor is not None:
                part = _draft(self.source, accessor, "accessor")
                part.name = tag
                part.data = {"declaration": _text(accessor, "Declaration")}
                _implementation(part, accessor, self.report, f"{self.title}.{tag}")
                draft.children.append(part)

    def task(self, draft: Draft) -> None:
        """When a task runs and what it calls."""
        item, line = self.item, self.item.line
        micros = _text(item, "CycleTime").strip()
        text = _text(item, "Priority").strip()
        draft.data = {
            "priority": priority(self.source, line, draft.name, text, self.report),
            "pous": [
                {"name": _text(call, "Name").strip()}
                for call in item.children("PouCall")
                if _text(call, "Name").strip()
            ],
        }
        if micros and micros != "0":
            draft.data["interval"] = cycle(self.source, line, draft.name, micros, self.report)


def _tags(*, member: bool) -> dict[str, ObjectKind[Any]]:
    """The kinds by the tags of their elements: those of files, or those inside of other objects."""
    forms = [(kind, kind.twincat) for kind in kinds().values()]
    return {
        tag: kind
        for kind, form in forms
        if form is not None and form.member == member
        for tag in (form.tag, *form.other_tags)
    }


def _object(source: str, item: Element, kind: ObjectKind[Any], report: ImportReport) -> Draft:
    draft = _draft(source, item, kind.name)
    _content(source, item, kind, draft, report, draft.name)
    mark_without_result(draft, report)
    if kind.compiled.source is None:
        return draft
    if not draft.data["declaration"] or subkind_of(draft.data["declaration"]) != "function":
        _folders(draft, item)  # a function has none; TwinCAT keeps empty ones in its file
    members = _tags(member=True)
    for child in item:
        if child.tag in members or child.tag == _TRANSITION:
            folders = tuple(part for part in child.get("FolderPath").split("\\") if part)
            made = _child(source, child, members.get(child.tag), report, draft)
            draft.below(folders).children.append(made)
        elif kind.twincat is not None and child.tag in kind.twincat.not_read:
            report.add("changed", source, kind.twincat.not_read[child.tag], name=draft.name, line=child.line)
        elif child.tag not in _SILENT:
            text = f"parts of the kind <{child.tag}> are not read"
            report.add("refused", source, text, name=draft.name, line=child.line)
    return draft


def _content(
    source: str, item: Element, kind: ObjectKind[Any], draft: Draft, report: ImportReport, title: str
) -> None:
    """The texts that the data of a kind have, and what the kind reads itself."""
    if "declaration" in kind.data.model_fields:
        draft.data = {"declaration": _text(item, "Declaration")}
    if "implementation" in kind.data.model_fields:
        _implementation(draft, item, report, title)
    if kind.twincat is not None and kind.twincat.read is not None:
        kind.twincat.read(TwinCatElement(source, item, report, title), draft)


def _child(
    source: str, item: Element, kind: ObjectKind[Any] | None, report: ImportReport, owner: Draft
) -> Draft:
    if kind is not None:
        draft = _draft(source, item, kind.name)
        _content(source, item, kind, draft, report, f"{owner.name}.{draft.name}")
        return draft
    draft = _draft(source, item, _TRANSITION.lower())
    name = f"{owner.name}.{draft.name}"
    _implementation(draft, item, report, name)
    text = "transitions belong to a drawn chart, which is kept with them"
    report.add("kept", source, text, name=name, line=item.line)
    return draft


def _implementation(draft: Draft, item: Element, report: ImportReport, name: str) -> None:
    """The body: text, or a graphical one as the XML that it is."""
    held = item.child("Implementation")
    part = next(iter(held), None) if held is not None else None
    if held is None or part is None:
        draft.data |= body("ST", "")
    elif is_plain_text(part.tag):
        draft.data |= body(part.tag, _clean(part.text()))
    elif part.tag in _GRAPHICAL:
        draft.data |= body(_GRAPHICAL[part.tag], xml_text(held))
    else:
        draft.data |= body("SFC" if part.tag == "StateChart" else "FBD", xml_text(held))
    language = draft.data["language"]
    if not is_plain_text(language):
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


def _draft(source: str, item: Element, kind: str) -> Draft:
    return Draft(kind, item.get("Name"), {}, source, item.line, [], hex_id(item.get("Id")))


def _text(item: Element, tag: str) -> str:
    child = item.child(tag)
    return _clean(child.text()) if child is not None else ""


def _clean(text: str) -> str:
    return text.replace("\r\n", "\n").replace("\r", "\n").removesuffix("\n")

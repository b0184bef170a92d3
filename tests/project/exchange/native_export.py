"""Exchange files as CODESYS V3 writes them, made of short descriptions of objects."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from uuid import UUID
from xml.sax.saxutils import escape

TYPES = {
    "folder": "738bea1e-99bb-4f04-90bb-a7a567e74e3a",
    "device": "225bfe47-7336-4dbc-9419-4105a7c831fa",
    "logic": "40b404f9-e5dc-42c6-907f-c89f4a517386",
    "application": "639b491f-5557-464c-af91-1471bac9f549",
    "tasks": "ae1de277-a207-4a28-9efb-456c06bd52f3",
    "task": "98a2708a-9b18-4f31-82ed-a1465b24fa2d",
    "call": "413e2a7d-adb1-4d2c-be29-6ae6e4fab820",
    "libraries": "adb5cb65-8e1d-4a00-b70a-375ea27582f3",
    "pou": "6f9dac99-8de1-4efc-8465-68ac443b7d08",
    "dut": "2db5746d-d284-4425-9f7f-2663a34b0ebc",
    "gvl": "ffbfa93a-b94d-45fc-a329-229860183b1d",
    "method": "f8a58466-d7f6-439f-bbb8-d4600e41d099",
    "property": "5a3b8626-d3e9-4f37-98b5-66420063d91e",
    "accessor": "792f2eb6-721e-4e64-ba20-bc98351056db",
    "action": "8ac092e5-3128-4e26-9e7e-11016c6684f2",
    "visualisation": "f18bec89-9fef-401d-9953-2f11739a6808",
    "unknown": "00000000-0000-0000-0000-0000000000aa",
}


@dataclass(frozen=True)
class Item:
    """An object of a file."""

    number: int
    """Its id; that of the parent is the number of the parent, 0 for one that is not in the file."""
    parent: int
    type: str
    name: str
    declaration: str | None = None
    body: str | None = None
    path: tuple[str, ...] = ()
    inner: str = ""
    """Further elements of the object."""
    as_lines: bool = False
    """Texts line by line, as up to V3.5 SP16."""
    excluded: bool = False
    properties: Mapping[str, str] = field(default_factory=dict)
    """Further properties, such as those of the build."""


def single(name: str, text: str) -> str:
    """A value."""
    return f'<Single Name="{name}" Type="string">{escape(text)}</Single>'


def _text(name: str, text: str | None, as_lines: bool) -> str:
    if text is None:
        return ""
    held = single("TextBlobForSerialisation", text)
    if as_lines:
        lines = "".join(
            f"<Single>{single('Id', '1')}{single('Text', line)}</Single>" for line in text.split("\n")
        )
        held = f'<Array Name="TextLines">{lines}</Array>'
    return f'<Single Name="{name}"><Single Name="TextDocument">{held}</Single></Single>'


def native(items: Sequence[Item], tag: str = "List2") -> bytes:
    """The file with these objects; lists have the tag of the version that wrote it."""
    entries = []
    for item in items:
        path = "".join(f'<Single Type="string">{escape(part)}</Single>' for part in item.path)
        excluded = single("ExcludeFromBuild", "True") if item.excluded else ""
        excluded += "".join(single(name, text) for name, text in item.properties.items())
        meta = single("Guid", str(UUID(int=item.number))) + single("Name", item.name)
        meta += f'<Dictionary Name="Properties">{excluded}</Dictionary>{single("TypeGuid", TYPES[item.type])}'
        held = _text("Implementation", item.body, item.as_lines)
        held += _text("Interface", item.declaration, item.as_lines) + item.inner
        entries.append(
            f'<Single Method="IArchivable">\n<Single Name="MetaObject">{meta}</Single>'
            f'<Single Name="Object">{held}</Single>{single("ParentSVNodeGuid", str(UUID(int=item.parent)))}'
            f'<Array Name="Path">{path}</Array></Single>'
        )
    return (
        '<ExportFile><StructuredView Guid="{21af5390-2942-461a-bf89-951aaf6999f1}">'
        f'<Single xml:space="preserve"><{tag} Name="EntryList">{"".join(entries)}</{tag}></Single>'
        "</StructuredView></ExportFile>"
    ).encode()

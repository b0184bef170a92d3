"""Types and variables of an application in native memory, for programs that ask for them while they run."""

from __future__ import annotations

from tappet.codegen.symbol_map import SymbolMap
from tappet.codegen.symbol_types import TypeInfo
from tappet.runtime.executive.loader import Executive
from tappet.runtime.executive.records import Block, Record
from tappet.runtime.posix import write_memory

SERVICE = "tappet_types"
"""What code calls that needs the description."""
_OTHER, _LIST, _COMPOSITE = 0, 7, 8
_KINDS = {
    "bool": 1, "bits": 2, "uint": 2, "ltime": 2, "tod": 2, "ltod": 2, "ldate": 2, "ldt": 2, "int": 3,
    "real": 4, "string": 5,
    "wstring": 6, "array": _LIST, "struct": _COMPOSITE, "union": _COMPOSITE, "fb": _COMPOSITE,
    "program": _COMPOSITE, "gvl": _COMPOSITE, "time": 9, "dt": 10, "date": 11,
}  # fmt: skip
"""DESCRIBED_KIND of described_types.st; what is not listed has no value of its own (pointers, references)."""


class DescribedTypes:
    """A DESCRIPTION; never changed once a task may see it."""

    def __init__(self, executive: Executive, symbols: SymbolMap, image: int) -> None:
        types = _with_one_dimension(symbols.types)
        layouts = executive.layouts
        head, kind = layouts["DESCRIPTION"], layouts["DESCRIBED_TYPE"]
        part, root = layouts["DESCRIBED_MEMBER"], layouts["DESCRIBED_ROOT"]
        members = [member for info in types for member in info.members if not member.absolute]
        texts: dict[str, int] = {}
        room = 0
        for name in (*(info.name for info in types), *(member.name for member in members)):
            if name not in texts:
                texts[name] = room
                room += len(name.encode()) + 1
        records = (
            head.size + kind.size * len(types) + part.size * len(members) + root.size * len(symbols.roots)
        )
        self._block = Block(records + room)
        self.address = self._block.address
        at_types = self.address + head.size
        at_members = at_types + kind.size * len(types)
        at_roots = at_members + part.size * len(members)
        at_texts = self.address + records
        for name, offset in texts.items():
            write_memory(at_texts + offset, name.encode() + b"\0")
        description = Record(head, self.address)
        description["typeCount"] = len(types)
        description["pTypes"] = at_types
        description["pMembers"] = at_members
        description["rootCount"] = len(symbols.roots)
        description["pRoots"] = at_roots
        first = 0
        for number, info in enumerate(types):
            record = Record(kind, at_types + number * kind.size)
            own = [member for member in info.members if not member.absolute]
            record["pName"] = at_texts + texts[info.name]
            record["kind"] = _KINDS.get(info.base if info.kind == "enum" else info.kind, _OTHER)
            record["size"] = info.size
            record["element"] = info.elem or 0
            record["count"] = info.bounds[0][1] - info.bounds[0][0] + 1 if info.bounds else len(own)
            record["member"] = first
            for place, member in enumerate(own, start=first):
                entry = Record(part, at_members + place * part.size)
                entry["pName"] = at_texts + texts[member.name]
                entry["kindOf"] = member.type
                entry["offset"] = member.offset
                entry["bit"] = -1 if member.bit is None else member.bit
            first += len(own)
        for number, variable in enumerate(symbols.roots.values()):
            record = Record(root, at_roots + number * root.size)
            record["address"] = image + variable.offset
            record["kindOf"] = variable.type


def _with_one_dimension(types: list[TypeInfo]) -> list[TypeInfo]:
    """The types; an array of several dimensions is one of arrays, which stand at the end without a name."""
    found = list(types)
    for number, info in enumerate(types):
        inner, element = info.elem, info.elem
        if info.kind != "array" or len(info.bounds) < 2 or element is None:
            continue
        for low, high in reversed(info.bounds[1:]):
            assert inner is not None
            size = (high - low + 1) * found[inner].size
            found.append(TypeInfo("", "array", size, elem=inner, bounds=((low, high),)))
            inner = len(found) - 1
        found[number] = TypeInfo(info.name, "array", info.size, elem=inner, bounds=info.bounds[:1])
    return found

"""`__SYSTEM.VAR_INFO`: what `__VARINFO(x)` returns for a variable."""

from __future__ import annotations

from tappet.lang import types as t
from tappet.lang.any_type import TYPE_CLASS, class_of
from tappet.lang.symbols import Storage, TypeSymbol, VarSymbol
from tappet.lang.system_structures import structure

_AREAS = ("UNKNOWN", "MEMORY", "INPUT", "OUTPUT", "RETAIN", "GLOBAL", "LOCAL")
MEMORY_AREA = t.Enum("MEMORY_AREA", t.INT, {f"MEM_{name}": number for number, name in enumerate(_AREAS, -1)})
MEMORY_AREA.qualified_only = True
MEMORY_AREA_SYMBOL = TypeSymbol("MEMORY_AREA", type=MEMORY_AREA)

_MEMBERS: tuple[tuple[str, t.Type, str], ...] = (
    ("ByteAddress", t.DWORD, "Address of the variable; of a bit that of its byte"),
    ("ByteOffset", t.DINT, "Offset of the variable in its list, program, instance or area"),
    ("Area", t.INT, "Number of the memory area; -1: relative to an instance or the stack"),
    ("BitNr", t.INT, "Number of the bit in its byte; -1 for what is no bit"),
    ("BitSize", t.UDINT, "Size in bits"),
    ("BitAddress", t.UDINT, "Bit of the area, for variables at %I, %Q and %M"),
    ("TypeClass", TYPE_CLASS, "Class of the type"),
    ("TypeName", t.String(79), "Name of the type"),
    ("NumElements", t.UDINT, "Elements of an array"),
    ("BaseTypeClass", TYPE_CLASS, "Class of the elements of an array"),
    ("ElemBitSize", t.UDINT, "Size of an element of an array in bits"),
    ("MemoryArea", MEMORY_AREA, "Kind of memory"),
    ("Symbol", t.String(39), "The operand as written"),
    ("Comment", t.String(79), "Comment of the declaration"),
)


VAR_INFO = structure("VAR_INFO", _MEMBERS)
VAR_INFO_SYMBOL = TypeSymbol("VAR_INFO", type=VAR_INFO)


def facts(written: str, type_: t.Type, symbol: VarSymbol | None, bit: int | None) -> dict[str, int | bytes]:
    """The values of the members by upper-case name, but for the address, which is known at run time only."""
    element: t.Type = type_
    count = 0
    while isinstance(element, t.Array):
        count = max(count, 1) * element.count
        element = element.element
    area = symbol.area if symbol is not None and symbol.home is Storage.DIRECT else None
    offset = symbol.offset if symbol is not None else 0
    bit = symbol.bit if bit is None and symbol is not None else bit
    return {
        "BYTEOFFSET": offset,
        "AREA": -1 if area is None else "IQM".index(area),
        "BITNR": -1 if bit is None else bit,
        "BITSIZE": 1 if bit is not None else 8 * type_.size,
        "BITADDRESS": 0 if area is None else 8 * offset + (bit or 0),
        "TYPECLASS": class_of(type_),
        "TYPENAME": str(type_).encode("latin-1", "replace")[:79],
        "NUMELEMENTS": count,
        "BASETYPECLASS": class_of(element) if count else 0,
        "ELEMBITSIZE": 8 * element.size if count else 0,
        "MEMORYAREA": MEMORY_AREA.values[f"MEM_{_area_of(symbol, area)}"],
        "SYMBOL": written.encode("latin-1", "replace")[:39],
        "COMMENT": (_comment(symbol)).encode("latin-1", "replace")[:79],
    }


def _comment(symbol: VarSymbol | None) -> str:
    if symbol is None:
        return ""
    return (symbol.decl.comment if symbol.decl is not None else "") or symbol.comment


def _area_of(symbol: VarSymbol | None, area: str | None) -> str:
    if area is not None:
        return {"I": "INPUT", "Q": "OUTPUT", "M": "MEMORY"}[area]
    if symbol is None:
        return "LOCAL"
    if symbol.flags & {"RETAIN", "PERSISTENT"}:
        return "RETAIN"
    return "GLOBAL" if symbol.home is Storage.GLOBAL else "LOCAL"

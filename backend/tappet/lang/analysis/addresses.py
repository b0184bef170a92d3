"""Direct addresses `%IX7.2`, `%MD48` (spec language_declarations.md section 4).

In IEC mode a number counts in units of its size and bits are `word.bit`; in byte mode numbers are byte
offsets
and bits are `byte.bit` (LDEC-59).
"""

from __future__ import annotations

import re
from dataclasses import dataclass

from tappet.lang import ast
from tappet.lang import types as t
from tappet.lang.analysis.context import Body
from tappet.lang.source import Span
from tappet.lang.symbols import Storage, VarSymbol
from tappet.lang.types import Elementary, Type

_FORM = re.compile(r"%([IQM])([XBWDL]?)(?:(\d+(?:\.\d+)*)|(\*))$", re.IGNORECASE)
_SIZES = {"X": 1, "": 1, "B": 1, "W": 2, "D": 4, "L": 8}
_TYPES: dict[str, Elementary] = {
    "X": t.BOOL, "": t.BOOL, "B": t.BYTE, "W": t.WORD, "D": t.DWORD, "L": t.LWORD,
}  # fmt: skip


@dataclass(frozen=True, slots=True)
class Address:
    """A place in an area: byte offset, bit of that byte or None, bytes named."""

    area: str
    offset: int
    bit: int | None
    size: int
    letter: str


@dataclass(frozen=True, slots=True)
class IncompleteAddress:
    """`%I*`, or `%QW0.0.8192.0`: the area is known, the place comes from VAR_CONFIG or the I/O mapping."""

    area: str
    levels: str = ""
    """An address of more levels than byte and bit, which names a channel of a device: the same everywhere."""


def locate(b: Body, text: str, span: Span) -> Address | IncompleteAddress | None:
    """The place an address names; None after a reported error."""
    match = _FORM.match(text)
    if match is None:
        b.report("E0601", span, address=text)
        return None
    area, letter = match[1].upper(), match[2].upper()
    if match[4]:
        return IncompleteAddress(area)
    numbers = [int(n) for n in match[3].split(".")]
    if len(numbers) > 2:
        return IncompleteAddress(area, text.upper())
    byte_mode = b.session.options.byte_addressing
    bit: int | None = None
    if letter in ("X", ""):
        if len(numbers) != 2:
            b.report("E0601", span, address=text)
            return None
        number, bit = numbers
        highest = 7 if byte_mode else 15
        if bit > highest:
            hint = "Bits are counted in bytes." if byte_mode else "Bits are counted in words."
            b.report("E0602", span, bit=bit, address=text, high=highest, hint=hint)
            return None
        offset = number if byte_mode else 2 * number + bit // 8
        bit %= 8
    else:
        if len(numbers) != 1:
            b.report("E0601", span, address=text)
            return None
        offset = numbers[0] if byte_mode else numbers[0] * _SIZES[letter]
    size = _SIZES[letter]
    limit = b.session.options.area_limits[area]
    if offset + size > limit:
        b.report("E0604", span, address=text, limit=limit)
        return None
    return Address(area, offset, bit, size, letter)


def text_of_place(area: str, offset: int, type_: Type, byte_mode: bool) -> str:
    """The address of a variable of `type_` that begins at a byte of an area: `%IX0.0`, `%QW2`, `%MB7`."""
    if t.value_type(type_) is t.BOOL:
        return f"%{area}X{offset}.0" if byte_mode else f"%{area}X{offset // 2}.{offset % 2 * 8}"
    letter = {2: "W", 4: "D", 8: "L"}.get(type_.size, "B")
    return f"%{area}{letter}{offset if byte_mode else offset // _SIZES[letter]}"


def operand(b: Body, e: ast.Name) -> VarSymbol | None:
    """The anonymous variable that an address used as operand denotes (LDEC-61)."""
    place = locate(b, e.name, e.span)
    if isinstance(place, IncompleteAddress):
        hint = f"Declare a variable AT {place.levels} and use it." if place.levels else ""
        b.report("E0608", e.span, hint=hint)
        return None
    if place is None:
        return None
    b.session.operands.add((place.area, place.offset + place.size))
    return VarSymbol(
        e.name.upper(),
        source=b.source,
        span=e.span,
        type=_TYPES[place.letter],
        storage=Storage.DIRECT,
        offset=place.offset,
        bit=place.bit,
        area=place.area,
        home=Storage.DIRECT,
    )


def leave_incomplete(b: Body, symbol: VarSymbol, place: IncompleteAddress) -> None:
    """Leaves each instance of a variable to VAR_CONFIG, see `configured`."""
    symbol.area = place.area
    b.session.record_of(b.uri).incomplete = True


def place_variable(b: Body, symbol: VarSymbol, address: str, span: Span, type_: Type) -> None:
    """Puts a variable declared AT an address there; an incomplete one keeps its storage (see VAR_CONFIG)."""
    place = locate(b, address, span)
    if place is None:
        return
    if isinstance(place, IncompleteAddress):
        leave_incomplete(b, symbol, place)
        return
    bit = place.bit
    if bit is not None and t.value_type(type_) is not t.BOOL:
        if bit == 0:
            bit = None
        else:
            b.report(
                "E0603", span, name=symbol.name, type=type_, need=type_.size, address=address, size="one bit"
            )
            return
    limit = b.session.options.area_limits[place.area]
    if place.offset + type_.size > limit:
        b.report("E0604", span, address=address, limit=limit)
        return
    symbol.storage = symbol.home = Storage.DIRECT
    symbol.area, symbol.offset, symbol.bit = place.area, place.offset, bit

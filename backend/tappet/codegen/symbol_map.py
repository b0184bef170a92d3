"""The symbol map: from a path such as `PLC_PRG.fb1.aVal[3].x` to bytes in the image, and how to read them.

Plain data without the compiler: a runtime or a browser-side tool needs nothing else to watch variables.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Sequence

from msgspec import Struct, field

from tappet.codegen import values
from tappet.codegen.symbol_types import Bit, MemberInfo, TypeIndex, TypeInfo

MOST_ELEMENTS = 1000
"""Elements of an array in one list; of longer ones its parts are listed first."""
_PART = re.compile(r"^\s*(.+)\[([^\[\]]*?)\.\.([^\[\]]*)\]\s*$", re.DOTALL)
"""A part of an array: `a[1000..1999]`, `m[0, 0..4, 99]`."""


class SymbolError(ValueError):
    """The path names nothing in this application; the message says which part."""


class VarRef(Struct, frozen=True):
    """Where a variable lies in the image and what it is."""

    path: str
    """Full path with the spelling of the declarations."""
    offset: int
    bit: int | None
    """Bit number inside the byte at `offset`, None for whole bytes."""
    size: int
    """Bytes to read; 1 for a bit."""
    type: TypeInfo
    flags: tuple[str, ...] = ()
    section: str = "VAR"


class Child(Struct, frozen=True):
    """One entry below a path, for browsing."""

    name: str
    path: str
    type: str
    kind: str
    leaf: bool
    section: str = "VAR"
    flags: tuple[str, ...] = ()


class Root(Struct, frozen=True, array_like=True):
    """A program or variable list."""

    name: str
    kind: str
    """program or gvl."""
    offset: int
    type: TypeIndex


_TOKEN = re.compile(r"\s*(?:(?P<name>[A-Za-z_]\w*)|(?P<number>-?\d+)|(?P<mark>[.\[\],]))")
_ADDRESS = re.compile(r"%([IQM])([XBWDL]?)(\d+)(?:\.(\d+))?$", re.IGNORECASE)
_ADDRESS_SIZE = {"X": 0, "": 0, "B": 1, "W": 2, "D": 4, "L": 8}
_BIT_TYPE = TypeInfo("BOOL", "bool", 1)
_ADDRESS_TYPES = {
    1: TypeInfo("BYTE", "bits", 1),
    2: TypeInfo("WORD", "bits", 2),
    4: TypeInfo("DWORD", "bits", 4),
    8: TypeInfo("LWORD", "bits", 8),
}


def address_place(size: int, number: int, bit: int | None, byte_addressing: bool) -> tuple[int, int | None]:
    """Byte offset inside the area, and bit, of `%<area><size><number>[.<bit>]` (LDEC-59).

    Word-oriented IEC addressing counts in units of the size and bits as `word.bit` (0..15); byte addressing
    counts bytes and `byte.bit` (0..7).
    """
    if size == 0:
        if byte_addressing:
            return number, bit or 0
        place = number * 16 + (bit or 0)
        return place // 8, place % 8
    return (number if byte_addressing else number * size), None


class SymbolMap(Struct):
    """All variables of an application."""

    types: list[TypeInfo] = field(default_factory=list)
    roots: dict[str, Root] = field(default_factory=dict)
    """Programs and variable lists by upper-case name."""
    globals: dict[str, str] = field(default_factory=dict)
    """Upper-case variable name to the upper-case list it is in; "" when several lists have it."""
    areas: dict[str, tuple[int, int]] = field(default_factory=dict)
    """I, Q, M to (offset, size) in the image."""
    byte_addressing: bool = False
    mapped: dict[str, tuple[str, int, Bit | None]] = field(default_factory=dict)
    """Upper-case path of a variable with an incomplete address to area, byte and bit (LDEC-93)."""

    def __post_init__(self) -> None:
        """Foreign tables are checked here: ValueError when a type is referred to that is not there."""
        used = [m.type for t in self.types for m in t.members]
        used += [t.elem for t in self.types if t.elem is not None]
        used += [root.type for root in self.roots.values()]
        if max(used, default=-1) >= len(self.types):
            raise ValueError(f"type index {max(used)} is out of range: there are {len(self.types)} types")

    # -- look-up -------------------------------------------------------------------------------------

    def resolve(self, path: str) -> VarRef:
        """The variable at `path` (case-insensitive); raises SymbolError naming the part that is wrong.

        Understands `PRG.a.b[1, 2].c`, unqualified global variables, `.3` bits and %IX / %QW / %MD addresses.
        Pointers and references are values here: their targets are not static. A variable `AT %I*` denotes
        its place in the input area, from where every cycle copies it.
        """
        text = path.strip()
        if text.startswith("%"):
            return self._resolve_address(text)
        tokens = _tokenize(text)
        return _Walk(self, text, tokens).run()

    def library_root(self, name: str) -> Root | None:
        """The list of a library that is alone with its name: it needs no namespace in front."""
        ending = f".{name}".upper()
        found = [root for key, root in self.roots.items() if key.endswith(ending)]
        return found[0] if len(found) == 1 else None

    def children(self, path: str = "") -> list[Child]:
        """What lies below `path`; the programs and variable lists for an empty path."""
        if not path.strip():
            return [
                Child(r.name, r.name, r.name, r.kind, False)
                for r in sorted(self.roots.values(), key=lambda r: r.name.upper())
                if not r.name.startswith("__")
            ]
        key = path.strip().upper()
        if key in self.roots:
            root = self.roots[key]
            return self._members(root.name, self.types[root.type])
        if (part := _PART.match(path)) is not None:
            return self._part_of_array(self.resolve(part[1]), part[2], part[3])
        ref = self.resolve(path)
        if ref.type.kind == "array":
            return self._elements(ref, 0, math.prod(high - low + 1 for low, high in ref.type.bounds))
        return self._members(ref.path, ref.type)

    def parts(self, number: int) -> Iterator[tuple[int, int]]:
        """Types and offsets of the members or elements that lie inside a variable of a type."""
        info = self.types[number]
        if info.kind == "array" and info.elem is not None:
            size = self.types[info.elem].size
            for at in range(0, info.size if size else 0, size or 1):
                yield info.elem, at
        elif not info.leaf:
            for member in info.members:
                if not member.absolute:
                    yield member.type, member.offset

    def decode(self, ref: VarRef, data: bytes) -> values.Value:
        """Python value of the raw bytes of `ref` (see `values.decode`)."""
        return values.decode(self.types, ref.type, data, ref.bit)

    def encode(self, ref: VarRef, value: values.Value | str) -> bytes:
        """Raw bytes for a JSON value or an IEC literal; raises ValueError saying what is expected."""
        return values.encode(self.types, ref.type, value)

    def format_literal(self, ref: VarRef, value: values.Value) -> str:
        """`value` as IEC literal: TRUE, T#1s500ms, 'abc', an enumeration name ..."""
        return values.format_literal(self.types, ref.type, value)

    # -- details -------------------------------------------------------------------------------------

    def _resolve_address(self, text: str) -> VarRef:
        match = _ADDRESS.match(text)
        if not match:
            raise SymbolError(f"'{text}' is no address; write for example %IX0.0, %QW2 or %MD48")
        area, letter, number, bit = match[1].upper(), match[2].upper(), int(match[3]), match[4]
        if area not in self.areas:
            raise SymbolError(f"{text}: the application uses no %{area} area")
        size = _ADDRESS_SIZE[letter]
        if size and bit is not None:
            raise SymbolError(f"{text}: only bit addresses have a part after the point")
        limit = 8 if self.byte_addressing else 16
        if bit is not None and int(bit) >= limit:
            raise SymbolError(f"{text}: bit {bit} is outside 0..{limit - 1}")
        place, bit_number = address_place(size, number, int(bit) if bit else None, self.byte_addressing)
        start, length = self.areas[area]
        if place + max(size, 1) > length:
            raise SymbolError(f"{text} lies outside the %{area} area of {length} bytes")
        info = _BIT_TYPE if size == 0 else _ADDRESS_TYPES[size]
        return VarRef(text.upper(), start + place, bit_number, max(size, 1), info)

    def _members(self, path: str, info: TypeInfo) -> list[Child]:
        return [
            self._child(m.name, f"{path}.{m.name}", m.type, m)
            for m in info.members
            if "HIDDEN" not in m.flags
        ]

    def _child(self, name: str, path: str, type_index: int, member: MemberInfo | None = None) -> Child:
        info = self.types[type_index]
        section, flags = (member.section, member.flags) if member else ("VAR", ())
        return Child(name, path, info.name, info.kind, info.leaf, section, flags)

    def _elements(self, ref: VarRef, first: int, end: int) -> list[Child]:
        """Elements of an array by their number in memory; of many the parts that they stand in."""
        assert ref.type.elem is not None
        bounds = ref.type.bounds
        if end - first <= MOST_ELEMENTS:
            texts = (_index_text(bounds, number) for number in range(first, end))
            return [self._child(f"[{t}]", f"{ref.path}[{t}]", ref.type.elem) for t in texts]
        size = MOST_ELEMENTS
        while (end - first) > size * MOST_ELEMENTS:
            size *= MOST_ELEMENTS
        parts = ((at, min(at + size, end) - 1) for at in range(first, end, size))
        names = (f"[{_index_text(bounds, low)}..{_index_text(bounds, high)}]" for low, high in parts)
        element = self.types[ref.type.elem].name
        return [Child(n, f"{ref.path}{n}", f"ARRAY {n} OF {element}", "part", False) for n in names]

    def _part_of_array(self, ref: VarRef, low: str, high: str) -> list[Child]:
        """The elements `a[low..high]`; SymbolError where the array has no such ones."""
        if ref.type.kind != "array":
            raise SymbolError(f"'{ref.path}' is {ref.type.name} and has no elements")
        first, last = (_number_of(ref, text) for text in (low, high))
        if first > last:
            raise SymbolError(f"'{ref.path}[{low}..{high}]': the first index is behind the last one")
        return self._elements(ref, first, last + 1)


def _index_text(bounds: Sequence[tuple[int, int]], number: int) -> str:
    """Indices of an element, such as `3` or `0, 7`; the last one counts fastest."""
    indices: list[int] = []
    for low, high in reversed(bounds):
        number, rest = divmod(number, high - low + 1)
        indices.append(low + rest)
    return ", ".join(map(str, reversed(indices)))


def _number_of(ref: VarRef, text: str) -> int:
    """Number of an element in memory from its indices."""
    parts = [part.strip() for part in text.split(",")]
    bounds = ref.type.bounds
    shown = ", ".join(f"{low}..{high}" for low, high in bounds)
    if len(parts) != len(bounds) or not all(re.fullmatch(r"-?\d{1,19}", part) for part in parts):
        raise SymbolError(f"'{ref.path}[{text}]': write indices of the array [{shown}]")
    number = 0
    for part, (low, high) in zip(parts, bounds, strict=True):
        if not low <= int(part) <= high:
            raise SymbolError(f"'{ref.path}[{text}]': index {part} is outside {low}..{high}")
        number = number * (high - low + 1) + int(part) - low
    return number


def _tokenize(text: str) -> list[str]:
    tokens: list[str] = []
    at = 0
    while at < len(text):
        match = _TOKEN.match(text, at)
        if not match:
            raise SymbolError(f"'{text}': unexpected '{text[at]}' at column {at + 1}")
        tokens.append(match[0].strip())
        at = match.end()
        if text[at:].isspace():
            break
    if not tokens:
        raise SymbolError("the path is empty")
    return tokens


class _Walk:
    """One resolution: position in the tokens, offset so far and the current type."""

    def __init__(self, symbols: SymbolMap, text: str, tokens: list[str]) -> None:
        self.symbols = symbols
        self.text = text
        self.tokens = tokens
        self.at = 0
        self.offset = 0
        self.path = ""
        self.info = _BIT_TYPE
        self.bit: int | None = None
        self.member: MemberInfo | None = None

    def run(self) -> VarRef:
        self.start()
        while self.at < len(self.tokens):
            mark = self.tokens[self.at]
            self.at += 1
            if mark == ".":
                self.dot()
            elif mark == "[":
                self.index()
            else:
                raise SymbolError(f"'{self.text}': expected '.' or '[' after '{self.path}'")
        flags = self.member.flags if self.member else ()
        section = self.member.section if self.member else "VAR"
        size = 1 if self.bit is not None else self.info.size
        return VarRef(self.path, self.offset, self.bit, size, self.info, flags, section)

    def next(self, what: str) -> str:
        if self.at >= len(self.tokens):
            raise SymbolError(f"'{self.text}': {what} is missing at the end")
        token = self.tokens[self.at]
        self.at += 1
        return token

    def start(self) -> None:
        symbols = self.symbols
        if self.tokens[0] == ".":
            self.at = 1
        name = self.next("a name")
        root = symbols.roots.get(name.upper())
        if root is None and self.tokens[self.at : self.at + 1] == ["."] and self.at + 1 < len(self.tokens):
            # a list of a library: Namespace.List
            root = symbols.roots.get(f"{name}.{self.tokens[self.at + 1]}".upper())
            if root is not None:
                self.at += 2
        if root is None and name.upper() not in symbols.globals:
            root = symbols.library_root(name)
        if root is not None:
            self.path, self.offset, self.info = root.name, root.offset, symbols.types[root.type]
            return
        owner = symbols.globals.get(name.upper())
        if owner is None:
            raise SymbolError(f"'{name}' is no program, variable list or global variable of the application")
        if owner == "":
            raise SymbolError(f"'{name}' is declared in several variable lists; write <list>.{name}")
        root = symbols.roots[owner]
        self.path, self.offset, self.info = root.name, root.offset, symbols.types[root.type]
        self.enter(name)

    def dot(self) -> None:
        token = self.next("a member name")
        if token.isdigit():
            self.take_bit(int(token))
        elif token[0].isalpha() or token[0] == "_":
            self.enter(token)
        else:
            raise SymbolError(f"'{self.text}': expected a member name after '{self.path}.'")

    def enter(self, name: str) -> None:
        member = self.find(name.upper())
        longer, at = name, self.at
        while member is None and self.tokens[at : at + 1] == ["."] and at + 1 < len(self.tokens):
            # VAR_INST of a method or property, or the chart of an action
            longer, at = f"{longer}.{self.tokens[at + 1]}", at + 2
            member = self.find(longer.upper())
            self.at = at if member is not None else self.at
        if member is None:
            if self.info.kind in ("pointer", "reference", "interface"):
                raise SymbolError(f"'{self.path}' is a {self.info.kind}; its target has no fixed place")
            raise SymbolError(f"'{self.path}' ({self.info.name}) has no member '{name}'")
        self.path += f".{member.name}"
        self.offset = member.offset if member.absolute else self.offset + member.offset
        self.info = self.symbols.types[member.type]
        self.bit = member.bit
        self.member = member
        if self.symbols.mapped:
            self.at_input()

    def find(self, key: str) -> MemberInfo | None:
        return next((m for m in self.info.members if m.name.upper() == key), None)

    def at_input(self) -> None:
        """Go to the input area for a variable that each cycle overwrites with what lies there."""
        place = self.symbols.mapped.get(self.path.upper())
        if place is not None and place[0] == "I" and "I" in self.symbols.areas:
            self.offset, self.bit = self.symbols.areas["I"][0] + place[1], place[2]

    def take_bit(self, bit: int) -> None:
        kind = self.info.kind
        if kind not in ("bits", "int", "uint") or self.bit is not None:
            raise SymbolError(f"'{self.path}' ({self.info.name}) has no bits")
        if bit >= self.info.size * 8:
            raise SymbolError(f"'{self.path}': bit {bit} is outside 0..{self.info.size * 8 - 1}")
        self.path += f".{bit}"
        self.offset += bit // 8
        self.bit = bit % 8
        self.info = _BIT_TYPE

    def index(self) -> None:
        if self.info.kind in ("string", "wstring"):
            self.character()
            return
        while True:
            if self.info.kind != "array" or self.info.elem is None:
                raise SymbolError(f"'{self.path}' ({self.info.name}) is no array")
            array, indices, closed = self.info, [], False
            for number, (low, high) in enumerate(array.bounds):
                value = self.number()
                if not low <= value <= high:
                    raise SymbolError(f"'{self.path}': index {value} is outside {low}..{high}")
                indices.append(value)
                mark = self.next("']'")
                last = number == len(array.bounds) - 1
                if mark == "]" and not last:
                    raise SymbolError(f"'{self.path}' needs {len(array.bounds)} indices")
                if mark not in ",]":
                    raise SymbolError(f"'{self.text}': expected ',' or ']' in the index")
                closed = mark == "]"
            flat = 0
            for value, (low, high) in zip(indices, array.bounds, strict=True):
                flat = flat * (high - low + 1) + value - low
            assert array.elem is not None
            self.info = self.symbols.types[array.elem]
            self.offset += flat * self.info.size
            self.path += f"[{', '.join(map(str, indices))}]"
            self.bit = None
            if closed:
                return

    def number(self) -> int:
        token = self.next("an index")
        try:
            return int(token)
        except ValueError:
            raise SymbolError(f"'{self.text}': index '{token}' is no number") from None

    def character(self) -> None:
        value = self.number()
        if self.next("']'") != "]":
            raise SymbolError(f"'{self.path}' takes one index")
        wide = 2 if self.info.kind == "wstring" else 1
        if not 0 <= value <= self.info.length:
            raise SymbolError(f"'{self.path}': index {value} is outside 0..{self.info.length}")
        self.path += f"[{value}]"
        self.offset += value * wide
        self.info = _ADDRESS_TYPES[wide]
        self.bit = None

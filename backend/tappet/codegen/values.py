"""Values between the memory image, Python, JSON and IEC literals.

One place decides how bytes read as values, so that watch lists, `tappet run --print` and the tests agree.
"""

from __future__ import annotations

import math
import re
import struct
from collections.abc import Sequence
from typing import TYPE_CHECKING

from tappet.codegen.literals import format_string, format_time, parse_string, parse_time

if TYPE_CHECKING:
    from tappet.codegen.symbol_types import TypeInfo

Value = bool | int | float | str | list["Value"] | dict[str, "Value"] | None
"""bool, int (also times, dates and enumerations, in the unit of their type), float, str, list, dict."""

_INT_CODE = {1: "b", 2: "h", 4: "i", 8: "q"}
_UINT_CODE = {1: "B", 2: "H", 4: "I", 8: "Q"}
_UNSIGNED = {"bits", "uint", "time", "ltime", "date", "tod", "dt", "ldate", "ltod", "ldt"}
_UNSIGNED |= {"pointer", "reference", "interface"}
_TIMES = {"time", "ltime", "date", "tod", "dt", "ldate", "ltod", "ldt"}
_BASED = re.compile(r"(2|8|16)#([0-9A-Fa-f_]+)$")


def decode(types: Sequence[TypeInfo], info: TypeInfo, data: bytes, bit: int | None = None) -> Value:
    """Python value of the raw bytes of a variable; `bit` selects one bit of the first byte.

    STRING reads as latin-1 up to its zero, arrays as flat lists in storage order, structures as dicts.
    """
    if bit is not None:
        return bool(data[0] >> bit & 1)
    kind = info.kind
    if len(data) < info.size:
        raise ValueError(f"{info.name} needs {info.size} bytes, not {len(data)}")
    if kind == "bool":
        return bool(data[0] & 1)
    if kind == "real":
        number: float = struct.unpack_from("<f" if info.size == 4 else "<d", data)[0]
        return number
    if kind == "string":
        return data[: info.size].split(b"\0", 1)[0].decode("latin-1")
    if kind == "wstring":
        return _decode_wide(data[: info.size])
    if kind == "array":
        return _decode_array(types, info, data)
    if kind in ("struct", "union", "fb", "program", "gvl"):
        return {
            m.name: decode(types, types[m.type], data[m.offset :], m.bit)
            for m in info.members
            if not m.absolute and "HIDDEN" not in m.flags
        }
    return _decode_int(info, data)


def _decode_int(info: TypeInfo, data: bytes) -> int:
    unsigned = info.kind in _UNSIGNED or (info.kind == "enum" and info.base != "int")
    code = (_UINT_CODE if unsigned else _INT_CODE)[info.size]
    number: int = struct.unpack_from("<" + code, data)[0]
    return number


def _decode_wide(data: bytes) -> str:
    for at in range(0, len(data) - 1, 2):
        if data[at] == 0 and data[at + 1] == 0:
            data = data[:at]
            break
    return data.decode("utf-16-le", errors="surrogatepass")


def _decode_array(types: Sequence[TypeInfo], info: TypeInfo, data: bytes) -> list[Value]:
    assert info.elem is not None
    element = types[info.elem]
    count = info.size // element.size if element.size else 0
    return [decode(types, element, data[i * element.size : (i + 1) * element.size]) for i in range(count)]


def encode(types: Sequence[TypeInfo], info: TypeInfo, value: Value) -> bytes:
    """Raw bytes of `info.size` for a JSON value or IEC literal text; ValueError says what is expected.

    Bits give one byte 0 or 1; the caller merges it. Arrays take flat lists of the full length.
    """
    kind = info.kind
    if kind == "bool":
        return b"\1" if _boolean(value) else b"\0"
    if kind == "real":
        return _encode_real(info, value)
    if kind in ("string", "wstring"):
        return _encode_string(info, value)
    if kind == "array":
        return _encode_array(types, info, value)
    if kind in ("struct", "union", "fb", "program", "gvl"):
        raise ValueError(f"{info.name}: write its members one by one")
    number = _integer(info, value)
    unsigned = kind in _UNSIGNED or (kind == "enum" and info.base != "int")
    bits = info.size * 8
    low, high = (0, (1 << bits) - 1) if unsigned else (-(1 << bits - 1), (1 << bits - 1) - 1)
    if info.range is not None:
        low, high = info.range
    if not low <= number <= high:
        raise ValueError(f"{number} is outside {low}..{high} of {info.name}")
    return struct.pack("<" + (_UINT_CODE if unsigned else _INT_CODE)[info.size], number)


def _boolean(value: Value) -> bool:
    if isinstance(value, bool):
        return value
    if isinstance(value, int) and value in (0, 1):
        return bool(value)
    if isinstance(value, str):
        text = value.strip().upper().removeprefix("BOOL#")
        if text in ("TRUE", "1"):
            return True
        if text in ("FALSE", "0"):
            return False
    raise ValueError(f"{_show(value)} is no BOOL; write TRUE or FALSE")


def _encode_real(info: TypeInfo, value: Value) -> bytes:
    if isinstance(value, str):
        text = value.strip().replace("_", "").upper().removeprefix("LREAL#").removeprefix("REAL#")
        try:
            value = float(text)
        except ValueError:
            try:
                value = float(_parse_int(text))
            except ValueError:
                raise ValueError(f"'{text}' is no {info.name}; write for example 1.5 or 2.0E-3") from None
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise ValueError(f"{_show(value)} is no {info.name}; write for example 1.5")
    try:
        return struct.pack("<f" if info.size == 4 else "<d", value)
    except OverflowError:
        raise ValueError(f"{value} is outside the range of {info.name}") from None


def _encode_string(info: TypeInfo, value: Value) -> bytes:
    wide = info.kind == "wstring"
    if not isinstance(value, str):
        raise ValueError(f"{_show(value)} is no text")
    quote = '"' if wide else "'"
    text = (
        parse_string(value, wide) if value[:1] == quote and value[-1:] == quote and len(value) > 1 else value
    )
    try:
        raw = text.encode("utf-16-le", "surrogatepass") if wide else text.encode("latin-1")
    except UnicodeEncodeError as error:
        raise ValueError(f"'{text[error.start]}' does not fit an 8-bit STRING; use WSTRING") from None
    unit = 2 if wide else 1
    if len(raw) > info.length * unit:
        raise ValueError(f"text of {len(raw) // unit} characters is longer than {info.name}")
    return raw + bytes(info.size - len(raw))


def _encode_array(types: Sequence[TypeInfo], info: TypeInfo, value: Value) -> bytes:
    assert info.elem is not None
    element = types[info.elem]
    count = info.size // element.size if element.size else 0
    if not isinstance(value, list) or len(value) != count:
        raise ValueError(f"{info.name} takes a list of {count} values")
    return b"".join(encode(types, element, item) for item in value)


def _integer(info: TypeInfo, value: Value) -> int:
    if isinstance(value, bool):
        raise ValueError(f"{_show(value)} is no {info.name}")
    if isinstance(value, int):
        return value
    if isinstance(value, float) and value.is_integer():
        return int(value)
    if not isinstance(value, str):
        raise ValueError(f"{_show(value)} is no {info.name}")
    text = value.strip()
    if info.kind in _TIMES and "#" in text:
        return parse_time(info.kind, text)
    if info.kind == "enum":
        name = text.rpartition(".")[2].upper()
        for known, number in info.values:
            if known.upper() == name:
                return number
    try:
        if info.kind in _TIMES:  # a bare number has no unit
            raise ValueError
        return _parse_int(text)
    except ValueError:
        if info.kind == "enum":
            names = ", ".join(name for name, _ in info.values[:8])
            raise ValueError(f"'{text}' is no value of {info.name}; it has {names}") from None
        sample = format_time(info.kind, 1500) if info.kind in _TIMES else "12 or 16#FF"
        raise ValueError(f"'{text}' is no {info.name}; write for example {sample}") from None


def _parse_int(text: str) -> int:
    """`12`, `-3`, `16#FF`, `2#1001_0011`, `INT#3`."""
    body, sign = text.strip(), 1
    if body[:1] in "+-" and body:
        body, sign = body[1:], -1 if body[0] == "-" else 1
    prefix, mark, rest = body.partition("#")
    if mark and prefix.isalpha():
        body = rest
        if body[:1] == "-":
            body, sign = body[1:], -sign
    based = _BASED.match(body)
    if based:
        return sign * int(based[2].replace("_", ""), int(based[1]))
    if not re.fullmatch(r"\d[\d_]*", body):
        raise ValueError(f"'{text}' is no integer")
    return sign * int(body.replace("_", ""))


def _show(value: Value) -> str:
    if value is None:
        return "null"
    return repr(value) if isinstance(value, str) else str(value)


def format_literal(types: Sequence[TypeInfo], info: TypeInfo, value: Value) -> str:
    """`value` as IEC literal: TRUE, 12, 1.5, T#1s500ms, 'abc', the name of an enumeration value, [1, 2]."""
    kind = info.kind
    if kind == "bool":
        return "TRUE" if value else "FALSE"
    if isinstance(value, list):
        element = types[info.elem] if info.elem is not None else info
        return "[" + ", ".join(format_literal(types, element, item) for item in value) + "]"
    if isinstance(value, dict):
        known = {m.name: types[m.type] for m in info.members}
        parts = (f"{n} := {format_literal(types, known.get(n, info), v)}" for n, v in value.items())
        return "(" + ", ".join(parts) + ")"
    if isinstance(value, str):
        return format_string(value, kind == "wstring")
    if kind == "real" and isinstance(value, int | float):
        return format_real(float(value), info.size)
    if kind in _TIMES and isinstance(value, int):
        return format_time(kind, value)
    if kind == "enum":
        for name, number in info.values:
            if number == value:
                return name
    if kind in ("pointer", "reference", "interface") and isinstance(value, int):
        return f"16#{value:X}"
    return str(value)


def format_real(value: float, size: int) -> str:
    """Shortest text that reads back to the same REAL (size 4) or LREAL (size 8), always with a point."""
    if math.isnan(value):
        return "NaN"
    if math.isinf(value):
        return "Infinity" if value > 0 else "-Infinity"
    text = repr(value)
    if size == 4:
        packed = struct.pack("<f", value)
        for digits in range(6, 10):
            text = f"{value:.{digits}g}"
            if struct.pack("<f", float(text)) == packed:
                break
    mantissa, mark, exponent = text.partition("e")
    if "." not in mantissa:
        mantissa += ".0"
    return f"{mantissa}E{int(exponent)}" if mark else mantissa

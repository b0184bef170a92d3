"""ANY and its groups as types of inputs: the callee gets class, address and size of what is given (LDEC-31).

The input is a structure `__SYSTEM.AnyType`: TypeClass, pValue (POINTER TO BYTE), diSize (bytes).
"""

from __future__ import annotations

from collections.abc import Callable

from tappet.lang import types as t
from tappet.lang.symbols import TypeSymbol
from tappet.lang.system_structures import structure

CLASSES = (
    "BOOL", "BIT", "BYTE", "WORD", "DWORD", "LWORD", "SINT", "INT", "DINT", "LINT", "USINT", "UINT",
    "UDINT", "ULINT", "REAL", "LREAL", "STRING", "WSTRING", "TIME", "DATE", "DATEANDTIME", "TIMEOFDAY",
    "POINTER", "REFERENCE", "SUBRANGE", "ENUM", "ARRAY", "PARAMS", "USERDEF", "NONE", "ANY", "ANYBIT",
    "ANYDATE", "ANYINT", "ANYNUM", "ANYREAL", "LAZY", "LTIME", "BITCONST", "UXINT", "XWORD", "XINT",
    "XSRTING", "VARLENARRAY", "ANYSTRING", "VECTOR", "LDATE", "LDATEANDTIME", "LTIMEOFDAY",
)  # fmt: skip
"""Values of `__SYSTEM.TYPE_CLASS` from 0 on, without TYPE_.

As in the documentation of CODESYS: up to BITCONST its page on `__SYSTEM.TYPE_CLASS`, the others `TypeClass`
of the library Base Interfaces, whose spelling of XSRTING this is.
"""
_OLD_INTERFACE = 0xF000
"""TYPE_INTERFACE, which Base Interfaces has for old projects only: no type is of this class."""

TYPE_CLASS = t.Enum(
    "TYPE_CLASS",
    t.DWORD,
    {f"TYPE_{name}": number for number, name in enumerate(CLASSES)} | {"TYPE_INTERFACE": _OLD_INTERFACE},
)
TYPE_CLASS.qualified_only = True
TYPE_CLASS_SYMBOL = TypeSymbol("TYPE_CLASS", type=TYPE_CLASS)

_LONG_NAMES = {
    "DATE_AND_TIME": "DATEANDTIME",
    "TIME_OF_DAY": "TIMEOFDAY",
    "LDATE_AND_TIME": "LDATEANDTIME",
    "LTIME_OF_DAY": "LTIMEOFDAY",
}
CLASS_OFFSET, VALUE_OFFSET, SIZE_OFFSET = 0, 8, 16
"""Bytes of the members in the structure."""


def _any(name: str) -> t.Struct:
    return structure(
        name,
        [
            ("TypeClass", TYPE_CLASS, "Class of the type"),
            ("pValue", t.Pointer(t.BYTE), "Address of the value"),
            ("diSize", t.DINT, "Size in bytes"),
        ],
    )


def _is(*kinds: t.Kind) -> Callable[[t.Type], bool]:
    return lambda type_: isinstance(type_, t.Elementary) and type_.kind in kinds


_INTEGERS = (t.Kind.SIGNED, t.Kind.UNSIGNED)
_ACCEPTS: dict[str, Callable[[t.Type], bool]] = {
    "ANY": lambda type_: True,
    "ANY_INT": _is(*_INTEGERS),
    "ANY_REAL": _is(t.Kind.REAL),
    "ANY_NUM": _is(*_INTEGERS, t.Kind.REAL),
    "ANY_BIT": lambda type_: type_ == t.BOOL or _is(t.Kind.BITS)(type_),
    "ANY_DATE": _is(t.Kind.DATE),
    "ANY_STRING": lambda type_: isinstance(type_, t.String),
}
ANY_TYPES = {name: _any(name) for name in _ACCEPTS}
"""The groups by name."""


def is_any(type_: t.Type | None) -> bool:
    """Whether an input has the type ANY or one of its groups."""
    return isinstance(type_, t.Struct) and ANY_TYPES.get(type_.name) is type_


def accepts(formal: t.Type, given: t.Type) -> bool:
    """Whether a value of type `given` may be handed to an input of the group `formal`."""
    return is_any(given) or (isinstance(formal, t.Struct) and _ACCEPTS[formal.name](t.value_type(given)))


def class_of(type_: t.Type) -> int:
    """TypeClass of a type, a value of TYPE_CLASS."""
    if isinstance(type_, t.Reference):
        type_ = type_.base
    if isinstance(type_, t.Subrange):
        type_ = type_.base
    if isinstance(type_, t.Elementary):
        name = _LONG_NAMES.get(type_.name, type_.name)
    elif isinstance(type_, t.String):
        name = "WSTRING" if type_.wide else "STRING"
    else:
        kinds = ((t.Enum, "ENUM"), (t.Array, "ARRAY"), (t.Pointer, "POINTER"))
        name = next((known for kind, known in kinds if isinstance(type_, kind)), "USERDEF")
    return CLASSES.index(name)

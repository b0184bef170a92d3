"""The functions for implicit checks have the parameters with which every access calls them.

Source: spec LTYP-81, LTYP-96, LTYP-124, LTYP-154, LOPR-18. Integers of any width are taken, as those of 2.3
projects; more parameters, fewer, or other kinds are not.

Passes:
    FUNCTION CheckBounds : DINT
    VAR_INPUT index, lower, upper : DINT; END_VAR
    VAR inside : DINT; END_VAR
    inside := LIMIT(lower, index, upper);
    CheckBounds := inside;
    END_FUNCTION
Fails:
    FUNCTION CheckBounds : DINT    (* E0446: the bounds are missing *)
    VAR_INPUT index : DINT; END_VAR
    CheckBounds := index;
    END_FUNCTION
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from tappet.lang import types as t

if TYPE_CHECKING:
    from tappet.lang.analysis.context import Session
    from tappet.lang.symbols import PouSymbol

CODES = ("E0446",)
_HEADS = {
    "CheckBounds : DINT": "index : DINT; lower : DINT; upper : DINT",
    "CheckRangeSigned : DINT": "value : DINT; lower : DINT; upper : DINT",
    "CheckRangeUnsigned : UDINT": "value : UDINT; lower : UDINT; upper : UDINT",
    "CheckLRangeSigned : LINT": "value : LINT; lower : LINT; upper : LINT",
    "CheckLRangeUnsigned : ULINT": "value : ULINT; lower : ULINT; upper : ULINT",
    "CheckDivInt : DINT": "divisor : DINT",
    "CheckDivLInt : LINT": "divisor : LINT",
    "CheckDivReal : REAL": "divisor : REAL",
    "CheckDivLReal : LREAL": "divisor : LREAL",
    "CheckDivByte : BYTE": "divisor : BYTE",
    "CheckDivWord : WORD": "divisor : WORD",
    "CheckDivDWord : DWORD": "divisor : DWORD",
    "CheckPointer : POINTER TO BYTE": "ptToTest : POINTER TO BYTE; iSize : DINT; iGran : DINT; bWrite : BOOL",
}
"""Name and result to the parameters."""


def check_program(session: Session) -> None:
    """Compares the check functions of the application with what calls them."""
    for head, parameters in _HEADS.items():
        name, _, result = head.partition(" : ")
        pou = session.analysis.function(name)
        if pou is None or pou.source is None or pou.span is None:
            continue
        wanted = [entry.partition(" : ")[2] for entry in parameters.split("; ")]
        if not _fits(pou, result, wanted):
            session.report(
                "E0446", pou.source.uri, pou.span, name=pou.name, head=head, parameters=f"{parameters};"
            )


def _fits(pou: PouSymbol, result: str, wanted: list[str]) -> bool:
    given = pou.parameters
    return (
        _of_kind(pou.return_type, result)
        and len(given) == len(wanted)
        and all(p.section == "VAR_INPUT" for p in given)
        and all(_of_kind(p.type, kind) for p, kind in zip(given, wanted, strict=True))
    )


def _of_kind(type_: t.Type | None, wanted: str) -> bool:
    """Whether a value of the type serves; a type that is not known has been reported."""
    if type_ is None:
        return False
    value = t.value_type(type_)
    integer = isinstance(value, t.Elementary) and value.is_integer
    if wanted == "POINTER TO BYTE":
        return integer or isinstance(value, t.Pointer)
    if wanted in ("REAL", "LREAL"):
        return value in (t.REAL, t.LREAL)
    return value is t.BOOL if wanted == "BOOL" else integer

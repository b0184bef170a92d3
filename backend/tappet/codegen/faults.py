"""Fault codes: what compiled code hands to `tappet_fault(code, a, b, c)` and what signal handlers report.

The numbers are a contract between object code and runtime; never renumber them.
"""

from __future__ import annotations

from enum import IntEnum


class Fault(IntEnum):
    """Reason of an application exception; `a`, `b`, `c` are the further arguments of `tappet_fault`."""

    DIV_ZERO = 1
    """Integer division or MOD by zero."""
    ARRAY_BOUNDS = 2
    """Array index a outside b..c."""
    NULL_REFERENCE = 3
    """Access through a pointer, reference or interface that is 0."""
    ACCESS_VIOLATION = 4
    """Access to memory that is not there (signal)."""
    STACK_OVERFLOW = 5
    """Calls nested too deep (signal on the guard page)."""
    WATCHDOG = 6
    """The task ran longer than its watchdog allows."""
    ASSERT = 7
    """An assertion of the program failed."""
    ILLEGAL_CONVERSION = 8
    """A value that the conversion cannot take."""
    USER = 9
    """Raised by the program with code a."""
    INVALID_RELEASE = 10
    """`__DELETE` of address b, where nothing of `__NEW` begins; a: RELEASE_ERROR of heap.st."""
    HEAP_DAMAGED = 11
    """Memory of `__NEW` at b, c bytes, was written before (a = 1) or behind its bounds (a = 2)."""
    PROCESS_ENDED = 12
    """The process of the runtime was ended while the application was loaded."""


_MESSAGES: dict[int, str] = {
    Fault.DIV_ZERO: "division by zero",
    Fault.ARRAY_BOUNDS: "array index {a} outside {b}..{c}",
    Fault.NULL_REFERENCE: "access through a null pointer or reference",
    Fault.ACCESS_VIOLATION: "access to invalid address 16#{a:X}",
    Fault.STACK_OVERFLOW: "stack overflow",
    Fault.WATCHDOG: "watchdog: the task exceeded its time",
    Fault.ASSERT: "assertion failed",
    Fault.ILLEGAL_CONVERSION: "value cannot be converted",
    Fault.USER: "exception {a} raised by the program",
    Fault.INVALID_RELEASE: "__DELETE of address 16#{b:X}, {reason}",
    Fault.HEAP_DAMAGED: "memory of __NEW at 16#{b:X}, {c} bytes, was written {reason}",
    Fault.PROCESS_ENDED: "{reason} while this application ran, so it was not started again; download "
    "a corrected application, or start this one anyway",
}

_REASONS: dict[tuple[int, int], str] = {
    (Fault.INVALID_RELEASE, 1): "which is not memory of __NEW",
    (Fault.INVALID_RELEASE, 2): "which lies inside memory of __NEW, not at its begin",
    (Fault.INVALID_RELEASE, 3): "which is not in use: it was given back already, or never made",
    (Fault.HEAP_DAMAGED, 1): "before its begin",
    (Fault.HEAP_DAMAGED, 2): "behind its end",
}


def fault_message(code: int, a: int = 0, b: int = 0, c: int = 0, reason: str = "") -> str:
    """English text of a fault, for example `array index 12 outside 0..9`; `reason` in its place."""
    template = _MESSAGES.get(code)
    if template is None:
        return f"fault {code} ({a}, {b}, {c})"
    return template.format(a=a, b=b, c=c, reason=reason or _REASONS.get((code, a), f"({a})"))

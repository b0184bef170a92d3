"""What a soft PLC refuses."""

from __future__ import annotations


class PlcError(RuntimeError):
    """The PLC cannot do that in its present state; the message says what would be right."""


class DiskFullError(PlcError):
    """There is no room for what has to be kept; nothing was changed."""


class NoApplicationError(PlcError):
    """What is asked for needs an application."""

    def __init__(self) -> None:
        super().__init__("no application is loaded; download one first")


class OtherApplicationError(PlcError):
    """Places are those of another application than the loaded one; nothing was done."""

    def __init__(self) -> None:
        super().__init__("the application was changed meanwhile; nothing was done, try again")


class NoTraceError(PlcError):
    """There is no trace, or no record of one, as it is asked for."""


class DebugError(PlcError):
    """The debugger cannot do this now; the message says why."""


class UnknownBreakpointError(DebugError):
    """There is no breakpoint with this id."""

"""The instrumented variant of an application, and what a debugger has to know of it.

It runs on the same image as the package with the same code id. Before each statement of the application is a
hook: it compares one byte, the flag of this place, and calls the executive when that is set. The variables of
such functions lie in a frame that the executive and the debugger reach (decision 15); frames are chained from
the running function to the program.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Literal

import msgspec
from msgspec import Struct

from tappet.codegen.package import PackageError
from tappet.codegen.symbol_types import TypeIndex, TypeInfo

MAGIC = b"TAPPET-DBG"
VERSION = 1
SITES_PREFIX = "tappet.sites."
"""Symbol of the flags of a function, behind it the linkage name."""
STATEMENT_SERVICE = "tappet_debug_statement"
"""`i32(i32 site, ptr frame)`: called where a flag is set; 0 to go on, else 1 + the site to go to."""

EXIT_SERVICE = "tappet_debug_exit"
"""`void(i32 site, ptr frame)`: the same, where a function is left."""

PREVIOUS, SITES, SITE, MARK, SELF, PENDING, HEADER = 0, 8, 16, 20, 24, 32, 40
"""Members of a frame (DEBUG_FRAME of the executive): the frame of the caller, the flags of the function, the
statement it is at, a mark of the debugger, the own instance, flow control; variables follow."""


class StatementSite(Struct, frozen=True, array_like=True):
    """A place where a function may halt. Lines count from 1 in its text."""

    line: int
    end_line: int
    column: int
    kind: Literal["statement", "loop", "exit"]
    """`loop`: FOR or WHILE looks whether there is another pass, at the place of its head; `exit`: the
    function is left, and nothing halts."""
    loops: tuple[int, ...] = ()
    """The loops around it, the outermost first; only these can be entered by going to it from elsewhere."""
    names: tuple[str, ...] = ()
    """Variables in the statement, as they are written there."""
    head: tuple[int, int] = (0, 0)
    """Its lines without those of statements inside it, as `IF condition THEN`: the first and the last one. In
    IL they begin with the rows whose value the statement takes."""

    def is_same_place(self, other: StatementSite) -> bool:
        """Whether both are of one function's text at the same place: the head of a loop is passed at its
        begin and before each further pass."""
        if "exit" in (self.kind, other.kind):
            return False
        return (self.line, self.column) == (other.line, other.column)


class FrameVariable(Struct, frozen=True, array_like=True):
    """A variable of a function activation."""

    name: str
    type: TypeIndex
    offset: int
    """Bytes from the frame."""
    section: str
    indirect: bool = False
    """The frame has the address of it: VAR_IN_OUT, and what is passed by address."""
    writable: bool = True


class DebugFunction(Struct, frozen=True):
    """One function of the instrumented variant."""

    name: str
    """Linkage name, by which call stacks name it."""
    uri: str
    sites: tuple[StatementSite, ...]
    variables: tuple[FrameVariable, ...] = ()
    this: TypeIndex | None = None
    """Type of the own instance."""
    program: str = ""
    """The program that it is a part of, as the symbol map names it in upper case; empty for other bodies."""
    fixed_order: Literal["", "try", "size"] = ""
    """Why the next statement cannot be set in it: it contains `__TRY`, or too many statements."""


class DebugCode(Struct):
    """The instrumented variant, ready to be linked beside a package."""

    code_id: str
    """Of the package that it is the variant of."""
    objects: list[bytes]
    functions: list[DebugFunction]
    types: list[TypeInfo]
    """Those of the package's symbol map, and behind them those of local variables."""

    def to_bytes(self) -> bytes:
        """Serialise; the inverse of `from_bytes`."""
        return MAGIC + bytes([VERSION]) + msgspec.msgpack.encode(self)

    @classmethod
    def from_bytes(cls, data: bytes) -> DebugCode:
        """Read what `to_bytes` made; raises PackageError saying what is wrong."""
        head = len(MAGIC) + 1
        if data[: len(MAGIC)] != MAGIC or len(data) < head:
            raise PackageError("not a Tappet debug variant")
        if data[len(MAGIC)] != VERSION:
            raise PackageError(f"debug variant version {data[len(MAGIC)]} is not {VERSION}; build again")
        try:
            code = _DECODER.decode(memoryview(data)[head:])
        except (msgspec.MsgspecError, RecursionError, UnicodeDecodeError) as error:
            raise PackageError(f"damaged debug variant: {error}") from error
        code.check()
        return code

    def check(self) -> None:
        """What the types do not say. Raises PackageError."""
        if not all(code[:4] == b"\x7fELF" for code in self.objects):
            raise PackageError("objects: every entry must be an ELF object")
        used = [v.type for f in self.functions for v in f.variables]
        used += [f.this for f in self.functions if f.this is not None]
        if max(used, default=-1) >= len(self.types):
            raise PackageError(f"type index {max(used)} is out of range: there are {len(self.types)} types")

    def numbered(self) -> Iterator[tuple[int, DebugFunction]]:
        """Every function with the number of its first site among all of them."""
        first = 0
        for function in self.functions:
            yield first, function
            first += len(function.sites)


_DECODER = msgspec.msgpack.Decoder(DebugCode)

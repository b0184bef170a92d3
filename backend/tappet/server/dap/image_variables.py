"""Variables of the image as a debugger shows them: read, written, listed by path, now or in the past."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol, TypeVar

from tappet.codegen.package import CodePackage
from tappet.codegen.symbol_map import Child, SymbolError, VarRef
from tappet.runtime.client import RuntimeRefused
from tappet.runtime.operations.declaration import WireOperation
from tappet.runtime.operations.flight import ReadFlight
from tappet.runtime.operations.values import Read, Write
from tappet.server.dap.debuggee import Refused, Variable

T = TypeVar("T")
_MOST_LISTED = 1000
"""Children of one variable that are listed at a time where the client sets no limit."""
_MOST_SHOWN = 64
"""Bytes of a structured value up to which its parts are shown in one line."""


class Call(Protocol):
    """Has a runtime carry an operation out. Raises RuntimeRefused and ConnectionError."""

    async def __call__(self, operation: WireOperation[T]) -> T:
        """The reply."""


class ImageVariables:
    """The variables of the loaded application."""

    def __init__(self, call: Call, package: CodePackage) -> None:
        self._call = call
        self._symbols = package.symbols
        self._code_id = package.code_id

    async def children(self, path: str, start: int, count: int, cycle: int | None) -> list[Variable]:
        """What lies below a path, "" for the programs and variable lists; as it was at the end of a past
        cycle where one is given. Raises Refused."""
        try:
            listed = self._symbols.children(path)[start:][: count or _MOST_LISTED]
            refs = [self._reference(child) for child in listed]
        except SymbolError as error:
            raise Refused(str(error)) from error
        read = [ref for ref in refs if ref is not None and _shown(ref)]
        data = dict(zip((ref.path for ref in read), await self._bytes(read, cycle), strict=True))
        return [self._variable(child.name, ref, child, data) for child, ref in zip(listed, refs, strict=True)]

    async def read(self, path: str, cycle: int | None) -> Variable:
        """A variable. Raises Refused."""
        try:
            ref = self._symbols.resolve(path)
        except SymbolError as error:
            try:  # a program, or a list of variables
                self._symbols.children(path)
            except SymbolError:
                raise Refused(str(error)) from error
            return Variable(path, "", path, None, path, 1, writable=False)
        data = {ref.path: (await self._bytes([ref], cycle))[0]} if _shown(ref) else {}
        return self._variable(path, ref, None, data)

    async def write(self, path: str, value: str) -> Variable:
        """Write a variable at the begin of a cycle; what it is then. Raises Refused."""
        try:
            ref = self._symbols.resolve(path)
            data = self._symbols.encode(ref, value.strip())
        except ValueError as error:
            raise Refused(str(error)) from error
        try:
            await self._call(Write([(ref.offset, data, ref.bit)], self._code_id))
        except RuntimeRefused as error:
            raise Refused(str(error)) from error
        return await self.read(path, None)

    async def write_all(self, values: Sequence[tuple[str, str]]) -> None:
        """Write several together. Raises Refused."""
        try:
            refs = [(self._symbols.resolve(path), value) for path, value in values]
            places = [(ref.offset, self._symbols.encode(ref, value), ref.bit) for ref, value in refs]
        except ValueError as error:
            raise Refused(str(error)) from error
        await self._call(Write(places, self._code_id))

    def _reference(self, child: Child) -> VarRef | None:
        """Where a child lies; None for programs and lists."""
        return None if child.kind in ("program", "gvl") else self._symbols.resolve(child.path)

    async def _bytes(self, refs: Sequence[VarRef], cycle: int | None) -> list[bytes]:
        places = [(ref.offset, ref.size) for ref in refs]
        if not places:
            return []
        try:
            return await self._call(
                Read(places, self._code_id) if cycle is None else ReadFlight(cycle, places, self._code_id)
            )
        except RuntimeRefused as error:
            raise Refused(str(error)) from error

    def _variable(
        self, name: str, ref: VarRef | None, child: Child | None, data: dict[str, bytes]
    ) -> Variable:
        if ref is None:
            assert child is not None
            return Variable(name, child.kind, child.name, None, child.path, 1, writable=False)
        literal = ref.type.name
        if ref.path in data:
            literal = self._symbols.format_literal(ref, self._symbols.decode(ref, data[ref.path]))
        count = self._count(ref)
        writable = "CONSTANT" not in ref.flags
        return Variable(name, ref.type.name, literal, None, ref.path, count, writable=writable)

    def count(self, path: str) -> int:
        """How many children the variable at a path has; 0 where there is none."""
        try:
            return self._count(self._symbols.resolve(path))
        except SymbolError:
            return 0

    def _count(self, ref: VarRef) -> int:
        if ref.type.leaf or ref.bit is not None:
            return 0
        if ref.type.kind != "array":
            return len(ref.type.members)
        count = 1
        for low, high in ref.type.bounds:
            count *= high - low + 1
        return count


def _shown(ref: VarRef) -> bool:
    """Whether the value of a variable is shown beside its name."""
    return ref.size > 0 and (ref.type.leaf or ref.size <= _MOST_SHOWN)

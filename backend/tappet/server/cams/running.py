"""The variables of a cam in a running application, by their places in its memory."""

from __future__ import annotations

from collections.abc import Awaitable, Callable, Mapping, Sequence
from typing import Any, cast

from tappet.codegen import values
from tappet.codegen.symbol_map import SymbolError, VarRef
from tappet.codegen.symbol_types import TypeInfo
from tappet.project.cams.code import LIST, LIST_VARIABLES, VARIABLES
from tappet.project.cams.running import RunningCam
from tappet.project.cams.table import CompileFormat
from tappet.project.cams.variables import ELEMENTS, CamVariables
from tappet.runtime.operations.values import Read, Write
from tappet.server.problems import Problem
from tappet.server.runtimes.links import RuntimeLink


class CamOfApplication:
    """One cam of the application that is loaded in a runtime, as it was when it was read."""

    def __init__(self, link: RuntimeLink, name: str) -> None:
        self._link = link
        self._name = name
        self._symbols, self._code_id = link.loaded_symbols(), link.code_id
        path = f"{VARIABLES.format(name=name)}.{name}"
        cam, elements = self._found(path), self._found(f"{path}_A")
        if cam is None or elements is None:
            text = f"The application in the runtime has no cam '{name}'; load it with the cam first."
            raise Problem(404, "not-found", text)
        self._cam, self._elements = cam, elements
        self._tappets = self._found(f"{path}_T")
        self._list = self._found(f"{LIST_VARIABLES}.{LIST}")
        self._bytes: dict[str, bytes] = {}

    @classmethod
    async def read(cls, link: RuntimeLink, name: str) -> CamOfApplication:
        """All of it at one moment.

        Raises problems: 404 when the application has no such cam, 409 when its elements are elsewhere, and
        those of the runtime.
        """
        cam = cls(link, name)
        refs = [ref for ref in (cam._cam, cam._elements, cam._list, cam._tappets) if ref is not None]
        async with link.client() as client:
            read = await client.call(Read([(ref.offset, ref.size) for ref in refs], cam._code_id))
        cam._bytes = dict(zip((ref.path for ref in refs), read, strict=True))
        cam._check_place()
        return cam

    def variables(self) -> RunningCam:
        """Its values."""
        tappets = self._value(self._tappets) if self._tappets is not None else []
        elements = self._value(self._elements)
        found = elements if isinstance(elements, list) else [elements]
        format, room = self._format(self._elements.type)
        return RunningCam(format, room, len(tappets), self._value(self._cam), found, tappets)

    async def write(self, new: CamVariables, begin: Callable[[], Awaitable[None]]) -> None:
        """Stores everything at the beginning of one cycle; `begin` is called right before."""
        orders: list[tuple[int, bytes, int | None]] = [
            (ref.offset, self._changed(ref, rows), None)
            for ref, rows in ((self._elements, new.elements), (self._tappets, new.tappets))
            if ref is not None
        ]
        for member in self._cam.type.members:
            if member.name in new.cam:
                info = self._symbols.types[member.type]
                data = values.encode(self._symbols.types, info, cast("values.Value", new.cam[member.name]))
                orders.append((self._cam.offset + member.offset, data, None))
        await begin()
        async with self._link.client() as client:
            if not await client.call(Write(orders, self._code_id)):
                text = "The task takes too long; the cam is written at the beginning of its next cycle."
                raise Problem(503, "not-yet-written", text)

    def _found(self, path: str) -> VarRef | None:
        try:
            return self._symbols.resolve(path)
        except SymbolError:
            return None

    def _value(self, ref: VarRef) -> Any:
        return self._symbols.decode(ref, self._bytes[ref.path])

    def _check_place(self) -> None:
        """The list of all cams says where this one lies, and so where its elements are."""
        cams = self._value(self._list) if self._list is not None else []
        if self._value(self._cam)["pce"] - self._elements.offset + self._cam.offset not in cams:
            text = (
                f"The program has made '{self._name}' point to other elements than those that were compiled; "
                "the editor reads and writes only its own."
            )
            raise Problem(409, "other-elements", text)

    def _format(self, info: TypeInfo) -> tuple[CompileFormat, int]:
        if info.kind == "array":
            assert info.elem is not None
            element = self._symbols.types[info.elem].name.rpartition(".")[2]
            format = next(one for one, name in ELEMENTS.items() if name == element)
            low, high = info.bounds[0]
            return format, high - low + 1
        size, columns = info.name.split("_")[-2:]
        return ("two_dimensional" if columns == "2" else "one_dimensional"), int(size)

    def _changed(self, ref: VarRef, rows: Sequence[Mapping[str, Any]]) -> bytes:
        """An array of structures, or one structure, with other members in its first rows."""
        types = self._symbols.types
        element = types[ref.type.elem] if ref.type.kind == "array" and ref.type.elem is not None else ref.type
        changed = bytearray(self._bytes[ref.path])
        for number, row in enumerate(rows):
            for member in element.members:
                if member.name in row:
                    at = number * element.size + member.offset
                    encoded = values.encode(types, types[member.type], row[member.name])
                    changed[at : at + len(encoded)] = encoded
        return bytes(changed)

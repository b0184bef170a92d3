"""Call stacks: the frames of instrumented functions of a halted task, or of one that a fault has ended."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from tappet.codegen import values
from tappet.codegen.debug_code import DebugFunction, FrameVariable, StatementSite
from tappet.codegen.symbol_map import SymbolMap
from tappet.codegen.symbol_types import TypeInfo
from tappet.runtime.debugger.places import code_spot
from tappet.runtime.debugger.shapes import Frame, Scope, Variable
from tappet.runtime.debugger.variant import Variant
from tappet.runtime.places import Place, path_at
from tappet.runtime.posix import read_memory, write_memory

DEEPEST = 1000
"""Levels of a call stack that are read."""
MOST_TEXT = 1000
"""Characters of the text of a variable."""
Read = Callable[[int, int], bytes]


@dataclass(frozen=True, slots=True)
class Activation:
    """One function that is running: its frame, and the statement it is at."""

    address: int
    function: DebugFunction
    number: int
    """Of the statement in the function."""
    this: int
    """Address of the own instance; 0 for none."""

    @property
    def site(self) -> StatementSite:
        """The statement."""
        return self.function.sites[self.number]


@dataclass(frozen=True, slots=True)
class TaskStack:
    """The activations of a task, the innermost first; `read` gets at the memory that they are in."""

    activations: list[Activation]
    read: Read
    live: bool
    """Whether it is memory of the task, which can be written to."""
    bounds: tuple[int, int] = (0, 0)

    def holds(self, address: int) -> bool:
        """Whether an address is in it."""
        return self.bounds[0] <= address < self.bounds[1]


def stack_of_halted(variant: Variant, task: int) -> TaskStack:
    """Of a task that stands at a statement."""
    context = variant.application.contexts.tasks[task]
    low, high = context["stackLow"], context["stackHigh"]

    def read(address: int, size: int) -> bytes:
        return read_memory(address, size) if low <= address and address + size <= high else bytes(size)

    found = _walk(variant, variant.tasks[task]["pFrame"], read, low, high)
    return TaskStack(found, read, True, (low, high))


def stack_of_fault(variant: Variant, task: int) -> TaskStack | None:
    """Of a task whose programs were left by a fault; None when nothing is kept."""
    debug, context = variant.tasks[task], variant.application.contexts.tasks[task]
    size, first = debug["keptSize"], debug["keptFrame"]
    if not size:
        return None
    kept = read_memory(debug["pKept"], size)

    def read(address: int, count: int) -> bytes:
        at = address - first
        return kept[at : at + count] if at >= 0 and at + count <= size else bytes(count)

    return TaskStack(_walk(variant, first, read, first, context["stackHigh"]), read, False)


def _walk(variant: Variant, frame: int, read: Read, low: int, high: int) -> list[Activation]:
    layout = variant.executive.layouts["DEBUG_FRAME"].members
    found: list[Activation] = []
    below = low
    while below <= frame < high and frame % 8 == 0 and len(found) < DEEPEST:

        def member(name: str, at: int = frame) -> int:
            place = layout[name]
            return int.from_bytes(read(at + place.offset, place.size), "little")

        index = variant.function_at(member("pSites"))
        if index is None:
            break
        function = variant.functions[index]
        number = member("site")
        if number >= len(function.sites):
            break
        found.append(Activation(frame, function, number, member("pSelf")))
        below, frame = frame + 1, member("pPrevious")
    return found


class FrameValues:
    """The variables of one activation."""

    def __init__(self, variant: Variant, stack: TaskStack, activation: Activation) -> None:
        self._variant = variant
        self._stack = stack
        self._activation = activation
        self._image = variant.application.image
        self._symbols: SymbolMap = variant.application.package.symbols
        self._types = variant.code.types

    def instance(self) -> str | None:
        """Path of the own instance; None without one, or where it has no path (made by __NEW)."""
        this, function = self._activation.this, self._activation.function
        if not this or function.this is None:
            return None
        offset, known = this - self._image.address, self._types[function.this]
        found = path_at(self._symbols, Place(offset, known.size))
        if found is not None:
            return found
        larger = {t.size for t in self._symbols.types if t.kind == "fb" and t.size > known.size}
        paths = (path_at(self._symbols, Place(offset, size)) for size in sorted(larger))
        return next((path for path in paths if path is not None), None)  # of a derived block

    def all(self) -> list[Variable]:
        """Locals and parameters, then the members of the own instance or program."""
        return [self._local(v) for v in self._activation.function.variables] + self._members()

    def write(self, name: str, value: values.Value) -> Variable:
        """Store a value in a local variable, as it is written in IEC or JSON. Raises ValueError."""
        for variable in self._activation.function.variables:
            if variable.name.upper() == name.upper():
                if not variable.writable or not self._stack.live:
                    why = "of a task that a fault has ended" if variable.writable else "passed by address"
                    raise ValueError(f"'{variable.name}' cannot be written: it is a variable {why}")
                info, address = self._types[variable.type], self._address(variable)
                if variable.indirect and not self._in_image(address) and not self._stack.holds(address):
                    raise ValueError(f"'{variable.name}' cannot be written: it lies outside the task")
                write_memory(address, values.encode(self._types, info, value))
                return self._local(variable)
        known = ", ".join(v.name for v in self._activation.function.variables) or "none"
        raise ValueError(
            f"'{self._activation.function.name}' has no local variable '{name}'; it has {known}. "
            "Variables of instances, programs and lists are written by their path"
        )

    def _address(self, variable: FrameVariable) -> int:
        at = self._activation.address + variable.offset
        return int.from_bytes(self._stack.read(at, 8), "little") if variable.indirect else at

    def _in_image(self, address: int) -> bool:
        return self._image.address <= address < self._image.address + self._image.size

    def _local(self, variable: FrameVariable) -> Variable:
        info = self._types[variable.type]
        at = self._address(variable)
        inside = self._in_image(at)
        data = self._image.read(at - self._image.address, info.size) if inside else None
        if data is None:
            data = self._stack.read(at, info.size)
        path = path_at(self._symbols, Place(at - self._image.address, info.size)) if inside else None
        return self._shown(variable.name, info, data, variable.section, variable.writable, "local", path)

    def _members(self) -> list[Variable]:
        function, this = self._activation.function, self._activation.this
        start = this - self._image.address
        kind: TypeInfo | None = self._types[function.this] if function.this is not None else None
        path = self.instance()
        if function.program:
            root = self._symbols.roots.get(function.program)
            if root is None:
                return []
            start, kind, path = root.offset, self._types[root.type], root.name
        if kind is None or not 0 <= start <= self._image.size - kind.size:
            return []
        found = []
        for member in kind.members:
            if "HIDDEN" in member.flags or member.absolute:
                continue
            info = self._types[member.type]
            data = self._image.read(start + member.offset, max(info.size, 1))
            below = f"{path}.{member.name}" if path else None
            found.append(
                self._shown(member.name, info, data, member.section, False, "this", below, member.bit)
            )
        return found

    def _shown(
        self,
        name: str,
        info: TypeInfo,
        data: bytes,
        section: str,
        writable: bool,
        scope: Scope,
        path: str | None,
        bit: int | None = None,
    ) -> Variable:
        try:
            value = values.decode(self._types, info, data, bit)
            text = values.format_literal(self._types, info, value)
        except ValueError:
            value, text = None, ""
        literal = text if info.leaf else ""
        text = text if len(text) <= MOST_TEXT else f"{text[:MOST_TEXT]}…"
        live = writable and self._stack.live
        return Variable(name, info.name, info.kind, section, value, literal, text, live, scope, path)


def mark(variant: Variant, frame: Activation, number: int) -> None:
    """Let a step end in this activation."""
    place = variant.executive.layouts["DEBUG_FRAME"].members["mark"]
    write_memory(frame.address + place.offset, number.to_bytes(place.size, "little"))


def levels(variant: Variant, stack: TaskStack) -> list[Frame]:
    """The activations of a stack with their places and instances, the innermost first."""
    maps = variant.application.package.source_maps
    return [
        Frame(
            index,
            code_spot(maps, activation.function, activation.site),
            FrameValues(variant, stack, activation).instance(),
        )
        for index, activation in enumerate(stack.activations)
    ]

"""Addresses: places of the core IR as LLVM pointers, with bounds checks and alias scopes."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass, field

from tappet.codegen.debug_info import DebugInfo, Metadata
from tappet.codegen.emit_text import constant, llvm_type, memory_type, symbol
from tappet.codegen.faults import Fault
from tappet.core import ir

COLD = ", !prof !0"
"""Branch weights of a check that never fires; node 0 of every module."""


WRITTEN = 'call void asm sideeffect "", "~{memory}"()'
"""Before an access that may end in a signal which `__TRY` catches: what was assigned so far is in memory.
LLVM knows no loads and stores that do not come back, and would leave out what is overwritten behind them.
The same at the beginning of what may call itself (methods and blocks that call others): a call that touches
no memory may come to the end of the stack, too."""


@dataclass(slots=True)
class ModuleState:
    """What the functions of one LLVM module share."""

    module: ir.Module
    metadata: Metadata
    debug: DebugInfo
    used: set[str] = field(default_factory=set)
    """Symbols of data, constants and runtime functions that the text refers to."""
    called: set[str] = field(default_factory=set)
    """Names of the functions that the text refers to."""
    intrinsics: set[str] = field(default_factory=set)
    """Declarations of LLVM intrinsics in use."""
    sites: dict[str, int] = field(default_factory=dict)
    """Symbols of the flags of statements, with how many there are; in the instrumented variant only."""


@dataclass(slots=True)
class Fallback:
    """A cold block that raises a fault, written behind the function."""

    label: str
    code: int
    args: list[str]
    location: str
    promoted: tuple[ir.Promoted, ...]


class AliasScopes:
    """Alias scopes of one function: a scope per root that is subscripted, one for all others, per base."""

    def __init__(self, metadata: Metadata, roots: dict[ir.Base, set[int]]) -> None:
        self.metadata = metadata
        self.roots = roots
        self.domains: dict[ir.Base, dict[int, str]] = {}

    def text(self, place: ir.Place) -> str:
        """Metadata suffix of an access; empty where nothing is known."""
        if place.root < 0 or isinstance(place.base, ir.Local | ir.Indirect):
            return ""
        roots = self.roots.get(place.base)
        if not roots:
            return ""
        texts = self.domains.get(place.base)
        if texts is None:
            texts = self.domains[place.base] = self._domain(sorted(roots))
        return texts.get(place.root, texts[-1])

    def _domain(self, roots: list[int]) -> dict[int, str]:
        add = self.metadata.add
        domain = self.metadata.reserve()
        self.metadata.define(domain, f"distinct !{{!{domain}}}")
        scopes: dict[int, int] = {}
        for root in [-1, *roots]:
            scope = scopes[root] = self.metadata.reserve()
            self.metadata.define(scope, f"distinct !{{!{scope}, !{domain}}}")
        texts = {}
        for root, scope in scopes.items():
            own = add(f"!{{!{scope}}}")
            others = add("!{" + ", ".join(f"!{s}" for r, s in scopes.items() if r != root) + "}")
            texts[root] = f", !alias.scope !{own}, !noalias !{others}"
        return texts


class PlaceEmitter(ABC):
    """State of one function under emission, and everything about addresses."""

    def __init__(self, state: ModuleState, function: ir.Function) -> None:
        self.state = state
        self.function = function
        self.out: list[str] = []
        self.prologue: list[str] = []
        self.cold: list[Fallback] = []
        self.locals: dict[ir.Local, str] = {}
        self.self_addresses: dict[int, str] = {}
        self.count = 0
        self.labels = 0
        self.block = "entry"
        self.terminated = False
        self.calls = False
        """Whether the function calls others."""
        self.promoted: list[ir.Promoted] = []
        self.subprogram = state.debug.subprogram(function)
        self.locations: dict[int, str] = {}
        self.line = function.line
        """Line of what is being emitted."""
        self.location = self.location_of(function.line)
        self.scopes = AliasScopes(state.metadata, function.subscripted)

    # -- text ----------------------------------------------------------------------------------------

    def value(self, text: str) -> str:
        """Append an instruction with a result; its name."""
        name = f"%{self.count}"
        self.count += 1
        self.out.append(f"{name} = {text}")
        return name

    def new_label(self) -> str:
        """A fresh block name."""
        self.labels += 1
        return f"b{self.labels}"

    def start_block(self, label: str) -> None:
        """Begin a block; falls through from an open one."""
        if not self.terminated:
            self.out.append(f"br label %{label}")
        self.out.append(f"{label}:")
        self.block = label
        self.terminated = False

    def jump(self, label: str) -> None:
        """End the block with a jump."""
        if not self.terminated:
            self.out.append(f"br label %{label}{self.location}")
            self.terminated = True

    def branch(self, condition: str, then: str, otherwise: str, weights: str = "") -> None:
        """End the block with a two-way branch."""
        self.out.append(f"br i1 {condition}, label %{then}, label %{otherwise}{weights}{self.location}")
        self.terminated = True

    def location_of(self, line: int) -> str:
        """Debug location suffix of a line."""
        self.line = line
        text = self.locations.get(line)
        if text is None:
            text = f", !dbg !{self.state.debug.location(self.subprogram, line)}"
            self.locations[line] = text
        return text

    # -- faults --------------------------------------------------------------------------------------

    def fault_if(self, condition: str, code: int, args: list[str]) -> None:
        """Continue unless `condition`; else raise a fault in a cold block. `args` are i64 operands."""
        label, proceed = self.new_label(), self.new_label()
        self.cold.append(Fallback(label, code, args, self.location, tuple(self.promoted)))
        self.branch(condition, label, proceed, COLD)
        self.out.append(f"{proceed}:")
        self.block = proceed
        self.terminated = False

    def write_cold(self) -> None:
        """Write the fault blocks behind the function."""
        for fallback in self.cold:
            self.out.append(f"{fallback.label}:")
            self.location = fallback.location
            for promoted in fallback.promoted:
                self.store_promoted(promoted)
            args = fallback.args + ["0"] * (3 - len(fallback.args))
            numbers = ", ".join(f"i64 {a}" for a in args)
            self.out.append(f"call void @tappet_fault(i32 {fallback.code}, {numbers}) #1{self.location}")
            self.out.append("unreachable")
        if self.cold:
            self.state.used.add("tappet_fault")

    def store_promoted(self, promoted: ir.Promoted) -> None:
        """Write promoted variables back to their homes."""
        for home, local, scalar, written in promoted.variables:
            if written:
                t = memory_type(scalar)
                now = self.value(f"load {t}, ptr {self.local(local)}")
                self.out.append(f"store {t} {now}, ptr {self.address(home)}{self.scopes.text(home)}")

    def load_promoted(self, promoted: ir.Promoted) -> None:
        """Read promoted variables from their homes."""
        for home, local, scalar, _ in promoted.variables:
            t = memory_type(scalar)
            now = self.value(f"load {t}, ptr {self.address(home)}{self.scopes.text(home)}")
            self.out.append(f"store {t} {now}, ptr {self.local(local)}")

    # -- places --------------------------------------------------------------------------------------

    def local(self, local: ir.Local) -> str:
        """Address of a local; allocated in the entry block on first use."""
        name = self.locals.get(local)
        if name is None and local in self.function.aliases:
            name = self.locals[local] = f"%a{self.function.aliases[local]}"
        if name is None:
            name = self.locals[local] = f"%l{len(self.locals)}"
            shape = memory_type(local.type) if local.type else f"[{max(local.size, 1)} x i8]"
            align = max(local.align, 16 if local.size >= 64 and local.type is None else 1)
            self.prologue.append(f"{name} = alloca {shape}, align {align}")
        return name

    def address(self, place: ir.Place) -> str:
        """Pointer operand of a place; checks its subscripts."""
        base = place.base
        offset = place.offset
        if isinstance(base, ir.Data):
            self.state.used.add(base.symbol)
            pointer = symbol(base.symbol)
            if offset:
                pointer = f"getelementptr inbounds (i8, ptr {pointer}, i64 {offset})"
        elif isinstance(base, ir.Self):
            pointer = self.self_address(offset)
        else:
            pointer = self.local(base) if isinstance(base, ir.Local) else self.expr(base.pointer)
            if offset:
                inbounds = "inbounds " if isinstance(base, ir.Local) else ""
                pointer = self.value(f"getelementptr {inbounds}i8, ptr {pointer}, i64 {offset}")
        for subscript in place.subscripts:
            pointer = self.subscript(pointer, subscript, not isinstance(base, ir.Indirect))
        if isinstance(base, ir.Indirect) and not base.own:
            self.write_back()
        return pointer

    def write_back(self) -> None:
        """Before an access through a pointer: see `WRITTEN`."""
        if self.state.module.catches_faults:
            self.out.append(WRITTEN)

    def self_address(self, offset: int) -> str:
        """Address of a member of the own instance; computed once, in the entry block."""
        if offset == 0:
            return "%a0"
        name = self.self_addresses.get(offset)
        if name is None:
            name = self.self_addresses[offset] = f"%s{offset}"
            self.prologue.append(f"{name} = getelementptr inbounds i8, ptr %a0, i64 {offset}")
        return name

    def subscript(self, pointer: str, sub: ir.Subscript, inside: bool) -> str:
        """Pointer to one element."""
        number = self.element_number(sub)
        inbounds = "inbounds nuw " if inside else ""
        return self.value(f"getelementptr {inbounds}[{sub.stride} x i8], ptr {pointer}, i64 {number}")

    def element_number(self, sub: ir.Subscript) -> str:
        """Index counted from 0, checked if need be."""
        index = self.index_operand(sub.index)
        wrapping = "" if sub.checked else "nsw "
        number = self.value(f"sub {wrapping}i64 {index}, {sub.low}") if sub.low else index
        if sub.checked:
            outside = self.value(f"icmp uge i64 {number}, {sub.high - sub.low + 1}")
            t = sub.index.type
            if sub.low < 0 and t.bits == 64 and not t.signed and not isinstance(sub.index, ir.Const):
                beyond = self.value(f"icmp slt i64 {index}, 0")  # it would wrap to where the array is
                outside = self.value(f"or i1 {outside}, {beyond}")
            self.fault_if(outside, Fault.ARRAY_BOUNDS, [index, str(sub.low), str(sub.high)])
        return number

    def index_operand(self, index: ir.Expr) -> str:
        """An index as i64."""
        if isinstance(index, ir.Const):
            return str(int(index.value))
        text = self.expr(index)
        t = index.type
        if t.bits == 64:
            return text
        return self.value(f"{'sext' if t.signed else 'zext'} {llvm_type(t)} {text} to i64")

    @abstractmethod
    def expr(self, expr: ir.Expr) -> str:
        """Operand text of a value."""

    def const(self, expr: ir.Const) -> str:
        """Operand text of a constant."""
        return constant(expr.type, expr.value)

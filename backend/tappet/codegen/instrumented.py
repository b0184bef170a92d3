"""Functions of the instrumented variant as LLVM text: hooks before statements, variables in a frame.

Contract: see `debug_code`. The code computes what the normal variant does; what was proved of variables that
a debugger may now write to (bounds that need no check, counters that do not overflow) is not relied on.
Cost: a store, a load and a comparison a statement; variables are in memory whenever a hook is passed.
Reason: the normal variant stays as it is, and debugging needs nothing of the processor.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Literal, NamedTuple

from msgspec import structs

from tappet.codegen import debug_code
from tappet.codegen.debug_code import HEADER, StatementSite
from tappet.codegen.emit_function import FunctionEmitter
from tappet.codegen.emit_place import COLD, ModuleState
from tappet.codegen.emit_text import llvm_type, symbol
from tappet.core import ir
from tappet.core.walk import visit
from tappet.iec.memory import STACK_SIZE

MOST_JUMPS = 400
"""A body with more statements has no way to set the next one: LLVM needs the square of it in time."""
_INLINED, _NEVER_INLINED = ("#0", "#6"), "#5"
_POINTED = 1 << 61
"""The extent that an index behind a pointer is taken to have is larger than this."""


class StatementHead(NamedTuple):
    """What the text of a statement says of what is executed before any statement inside it."""

    lines: tuple[int, int]
    """The first and the last one."""
    names: tuple[str, ...]
    """Variables in it."""


Heads = Mapping[tuple[int, int], StatementHead]
"""By line and column of the statement."""


@dataclass(eq=False, slots=True)
class FrameLayout:
    """Where the variables of a function lie in its frame."""

    offsets: dict[ir.Local, int] = field(default_factory=dict)
    pointers: list[tuple[int, int]] = field(default_factory=list)
    """(offset, number of the parameter) of addresses that the frame keeps."""
    size: int = HEADER

    def place(self, local: ir.Local) -> int:
        """Offset of a variable."""
        found = self.offsets.get(local)
        if found is None:
            found = self.offsets[local] = self._take(max(local.size, 1), max(local.align, 1))
        return found

    def pointer(self, parameter: int) -> int:
        """Offset of the address that a parameter is."""
        at = self._take(8, 8)
        self.pointers.append((at, parameter))
        return at

    def _take(self, size: int, align: int) -> int:
        at = -(-self.size // align) * align
        self.size = at + size
        return at


class InstrumentedEmitter(FunctionEmitter):
    """Emits one function of the instrumented variant."""

    relies_on_proofs = False

    def __init__(
        self, state: ModuleState, function: ir.Function, layout: FrameLayout, heads: Heads | None = None
    ) -> None:
        super().__init__(state, function)
        self.layout = layout
        self._heads = heads or {}
        self._halts: set[tuple[int, int]] = set()
        self._exit: int | None = None
        self.sites: list[StatementSite] = []
        self.flags = f"{debug_code.SITES_PREFIX}{function.name}"
        self._homes: dict[ir.Local, ir.Place] = {}
        """Variables that the normal variant keeps in registers during a loop."""
        self._around: list[int] = []
        self._loop_count = 0
        self._pass: StatementSite | None = None
        """What the loop that begins passes before each further pass."""
        self._jumps = not function.returns_twice and _statements(function.body) <= MOST_JUMPS

    def _text(self, linkage: str) -> list[str]:
        lines = super()._text(linkage)
        self.state.sites[self.flags] = len(self.sites)
        return lines

    def attributes(self) -> str:
        """Never inlined: each frame lies in a native one, callees below callers."""
        groups = super().attributes()
        return _NEVER_INLINED if groups in _INLINED else groups

    def write_cold(self) -> None:
        """The frame is set up in front, the jump table comes behind."""
        self._jump_table()
        super().write_cold()
        self.prologue = [*self._frame(), *self.prologue]

    def _frame(self) -> list[str]:
        size = -(-self.layout.size // 16) * 16
        lines = [
            f"%frame = alloca [{size} x i8], align 16",
            "%frame.at = ptrtoint ptr %frame to i64",
            f"%frame.stack = and i64 %frame.at, -{STACK_SIZE}",
            "%frame.cell = inttoptr i64 %frame.stack to ptr",
            "%frame.previous = load ptr, ptr %frame.cell",
            "store ptr %frame.previous, ptr %frame",
        ]
        lines += self._member("sites", debug_code.SITES, f"ptr {symbol(self.flags)}")
        lines += self._member("marks", debug_code.SITE, "i64 0")
        lines += self._member("pending", debug_code.PENDING, "i64 0")
        lines += self._member("self", debug_code.SELF, "ptr %a0" if self.function.self_type else "ptr null")
        for offset, parameter in self.layout.pointers:
            lines += self._member(f"p{offset}", offset, f"ptr %a{parameter}")
        lines.append(f"%frame.site = getelementptr inbounds i8, ptr %frame, i64 {debug_code.SITE}")
        lines.append("store ptr %frame, ptr %frame.cell")
        return lines

    def _member(self, name: str, offset: int, value: str) -> list[str]:
        return [
            f"%frame.{name} = getelementptr inbounds i8, ptr %frame, i64 {offset}",
            f"store {value}, ptr %frame.{name}",
        ]

    # -- hooks ---------------------------------------------------------------------------------------

    def _line(self, s: ir.Line) -> None:
        super()._line(s)
        place = (s.line, s.column)
        if s.statement and place not in self._halts:  # of what one place stands for, only the first one halts
            self._halts.add(place)
            self._hook(self._site(s))

    def _site(self, s: ir.Line) -> StatementSite:
        end = s.end_line or s.line
        head = self._heads.get((s.line, s.column), StatementHead((s.line, end), ()))
        return StatementSite(s.line, end, s.column, "statement", (), head.names, head.lines)

    def _hook(self, site: StatementSite) -> None:
        number = len(self.sites)
        self.sites.append(structs.replace(site, loops=tuple(self._around)))
        stop, go_on = f"stop{number}", f"go{number}"
        self.start_block(f"site{number}")
        self.out.append(f"store i32 {number}, ptr %frame.site")
        if self.function.returns_twice:
            self.out.append("store ptr %frame, ptr %frame.cell")  # a fault may have ended callees
        self.branch(self._flag(number), stop, go_on, COLD)
        self.start_block(stop)
        self.state.intrinsics.add(f"declare i32 @{debug_code.STATEMENT_SERVICE}(i32, ptr) cold nounwind")
        target = self.value(
            f"call i32 @{debug_code.STATEMENT_SERVICE}(i32 {number}, ptr %frame){self.location}"
        )
        if self._jumps:
            self.out.append(f"store i32 {target}, ptr %frame.target")
            self.branch(self.value(f"icmp eq i32 {target}, 0"), go_on, "jump", "")
        else:
            self.jump(go_on)
        self.start_block(go_on)

    def _flag(self, number: int) -> str:
        """Whether the flag of a statement is set."""
        at = symbol(self.flags)
        at = f"getelementptr inbounds (i8, ptr {at}, i64 {number})" if number else at
        flag = self.value(f"load volatile i8, ptr {at}")
        return self.value(f"icmp ne i8 {flag}, 0")

    def _leave_hook(self) -> None:
        """Where the function is left, flow control completes its last statement."""
        if not self.sites:
            return
        if self._exit is None:
            self._exit = len(self.sites)
            self.sites.append(StatementSite(self.line, self.line, 0, "exit"))
        seen, go_on = self.new_label(), self.new_label()
        self.branch(self._flag(self._exit), seen, go_on, COLD)
        self.start_block(seen)
        self.state.intrinsics.add(f"declare void @{debug_code.EXIT_SERVICE}(i32, ptr) cold nounwind")
        self.out.append(f"call void @{debug_code.EXIT_SERVICE}(i32 {self._exit}, ptr %frame){self.location}")
        self.start_block(go_on)

    def _jump_table(self) -> None:
        if not self.sites or not self._jumps:
            return
        self.prologue.append("%frame.target = alloca i32")
        self.start_block("jump")
        target = self.value("load i32, ptr %frame.target")
        inside = [n for n, site in enumerate(self.sites) if site.kind != "exit"]
        cases = " ".join(f"i32 {n + 1}, label %site{n}" for n in inside)
        self.out += [f"switch i32 {target}, label %nowhere [{cases}]", "nowhere:", "unreachable"]

    def fixed_order(self) -> Literal["", "try", "size"]:
        """Why the next statement cannot be set in the function; '' when it can."""
        if self.function.returns_twice:
            return "try"
        return "" if self._jumps else "size"

    # -- memory --------------------------------------------------------------------------------------

    def local(self, local: ir.Local) -> str:
        """Variables with a name are in the frame, or where they are at home."""
        home = self._homes.get(local)
        if home is not None:
            return self.address(home)
        if local in self.layout.offsets and local not in self.locals:
            offset = self.layout.offsets[local]
            name = self.locals[local] = f"%f{offset}"
            self.prologue.append(f"{name} = getelementptr inbounds i8, ptr %frame, i64 {offset}")
        return super().local(local)

    def _promote(self, s: ir.Promoted) -> None:
        for home, local, _, _ in s.variables:
            self._homes[local] = home
        self.statements([s.loop])

    def element_number(self, sub: ir.Subscript) -> str:
        """Checked although the normal variant need not: a debugger may have written the index."""
        if not sub.checked and sub.high < _POINTED:
            sub = replace(sub, checked=True)
        return super().element_number(sub)

    # -- flow ----------------------------------------------------------------------------------------

    def _for_(self, s: ir.For) -> None:
        self._store(ir.Store(s.counter, s.start))
        self._pass = self._again(s.line)
        self.stepped(s)

    def _while_(self, s: ir.While) -> None:
        self._pass = self._again(s.line)
        super()._while_(s)

    def _repeat(self, s: ir.Repeat) -> None:
        self._pass = self._site(s.until)
        super()._repeat(s)

    def _again(self, line: int) -> StatementSite | None:
        """The head of a loop before a further pass: the place that was passed last. None for a loop that no
        text has."""
        if not line:
            return None
        head = self.sites[-1] if self.sites else None
        if head is not None and (head.kind, head.line) == ("statement", line):
            return structs.replace(head, kind="loop")
        return StatementSite(line, line, 0, "loop", head=(line, line))

    def _loop_body(self, body: list[ir.Stmt], continue_label: str, break_label: str) -> None:
        """A loop passes a hook before each further pass, so that an empty one can be halted, too."""
        site, before = self._pass, self.new_label()
        self._loop_count += 1
        self._around.append(self._loop_count)
        self.loops.append((before, break_label))
        self.statements(body)
        self.loops.pop()
        self.start_block(before)
        if site is not None:
            self.location = self.location_of(site.line)
            self._hook(site)
        self._around.pop()
        self.jump(continue_label)

    def _return_(self, s: ir.Return) -> None:
        function = self.function
        self._leave_hook()
        value = ""
        if function.result is not ir.VOID:
            assert function.result_local is not None
            value = self.expr(ir.Load(function.result, ir.Place(function.result_local)))
        self.out.append("store ptr %frame.previous, ptr %frame.cell")
        returned = f"{llvm_type(function.result)} {value}" if value else "void"
        self.out.append(f"ret {returned}{self.location}")
        self.terminated = True


_I = InstrumentedEmitter
InstrumentedEmitter.handlers = FunctionEmitter.handlers | {
    ir.Line: _I._line,
    ir.For: _I._for_,
    ir.While: _I._while_,
    ir.Repeat: _I._repeat,
    ir.Promoted: _I._promote,
    ir.Return: _I._return_,
}


def _statements(body: list[ir.Stmt]) -> int:
    count = 0

    def note(node: ir.Expr | ir.Stmt) -> None:
        nonlocal count
        count += isinstance(node, ir.Line) and node.statement

    visit(body, note)
    return count

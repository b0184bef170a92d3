"""Which bounds checks can never fire, and which additions can never overflow.

Sources of knowledge: constants, counters of FOR loops, types of narrow integers, MOD, AND masks, shifts, MIN
and MAX. Intervals over mathematical integers; anything unknown has the range of its type. Guards in IF
conditions are left to LLVM.
"""

from __future__ import annotations

from tappet.core import ir
from tappet.core.walk import blocks_of, children

Interval = tuple[int, int]


def type_range(scalar: ir.Scalar) -> Interval:
    """All values of an integer type."""
    if scalar.bits == 1:
        return 0, 1
    if scalar.signed:
        return -(1 << scalar.bits - 1), (1 << scalar.bits - 1) - 1
    return 0, (1 << scalar.bits) - 1


class Ranges:
    """One function."""

    def __init__(self) -> None:
        self.known: dict[ir.Local, Interval] = {}
        self.dropped = 0
        """Checks found unnecessary."""

    def run(self, function: ir.Function) -> None:
        """Clear `Subscript.checked` and set `Binary.exact` where that is proved."""
        self.block(function.body)

    # -- statements ----------------------------------------------------------------------------------

    def block(self, body: list[ir.Stmt]) -> None:
        """Statements in order."""
        for statement in body:
            self.statement(statement)

    def statement(self, s: ir.Stmt) -> None:
        """One statement with everything inside."""
        if isinstance(s, ir.For):
            self._for(s)
            return
        if isinstance(s, ir.Promoted):
            self.statement(s.loop)
            return
        self._expressions(s)
        if isinstance(s, ir.Store):
            base = s.place.base
            if isinstance(base, ir.Local) and base.once:
                self.known[base] = self.range(s.value)
        for inner in blocks_of(s):
            self.block(inner)

    def _for(self, s: ir.For) -> None:
        self._expressions(s)
        base = s.counter.base
        if not s.fixed or not isinstance(base, ir.Local) or not isinstance(s.step, int) or s.step == 0:
            self.block(s.body)
            return
        start, stop = self.range(s.start), self.range(s.stop)
        low, high = type_range(s.type)
        if s.step > 0:
            # a counter that can pass the end of its type begins again at the other one (LST-29)
            self.known[base] = (start[0] if stop[1] + s.step <= high else low, stop[1])
        else:
            self.known[base] = (stop[0], start[1] if stop[0] + s.step >= low else high)
        self.block(s.body)
        del self.known[base]

    def _expressions(self, s: ir.Stmt) -> None:
        """Look at the places and operators of a statement; nested statements come later."""
        inner = {id(x) for block in blocks_of(s) for x in block}
        parts: list[ir.Expr | ir.Stmt] = []
        children(s, parts)
        todo = [p for p in parts if id(p) not in inner]
        self._node(s)
        while todo:
            node = todo.pop()
            if isinstance(node, ir.Sequence):
                self.block(node.statements)
                todo.append(node.value)
                continue
            self._node(node)
            children(node, todo)

    def _node(self, node: ir.Expr | ir.Stmt) -> None:
        if isinstance(node, ir.Binary):
            if node.type.integer and node.op in ("add", "sub", "mul") and not node.exact:
                self._exact(node)
            return
        subscripts: tuple[ir.Subscript, ...] = ()
        if isinstance(node, ir.Load | ir.Address | ir.Store):
            subscripts = node.place.subscripts
        elif isinstance(node, ir.Copy):
            subscripts = (*node.target.subscripts, *node.source.subscripts)
        elif isinstance(node, ir.Fill):
            subscripts = node.target.subscripts
        elif isinstance(node, ir.CheckIndex):
            subscripts = (node.subscript,)
        for sub in subscripts:
            if sub.checked:
                low, high = self.range(sub.index)
                if sub.low <= low and high <= sub.high:
                    sub.checked = False
                    self.dropped += 1

    def _exact(self, node: ir.Binary) -> None:
        if not node.type.signed:
            return
        exact = self._combine(node.op, self.range(node.left), self.range(node.right))
        low, high = type_range(node.type)
        if exact is not None and low <= exact[0] and exact[1] <= high:
            node.exact = True

    # -- expressions ---------------------------------------------------------------------------------

    def range(self, e: ir.Expr) -> Interval:
        """Interval of the values of an expression, as its type shows them."""
        limits = type_range(e.type) if e.type.integer or e.type.bits == 1 else (-(1 << 64), 1 << 64)
        found = self._range(e)
        if found is None or found[0] < limits[0] or found[1] > limits[1]:
            return limits
        return found

    def _range(self, e: ir.Expr) -> Interval | None:
        if isinstance(e, ir.Const):
            return (int(e.value), int(e.value)) if not e.type.floating else None
        if isinstance(e, ir.Load):
            base = e.place.base
            return self.known.get(base) if isinstance(base, ir.Local) and not e.place.offset else None
        if isinstance(e, ir.Binary):
            if not e.type.integer:
                return None
            return self._combine(e.op, self.range(e.left), self.range(e.right))
        if isinstance(e, ir.Convert):
            return self.range(e.operand) if e.operand.type.integer or e.operand.type.bits == 1 else None
        if isinstance(e, ir.Select):
            a, b = self.range(e.then), self.range(e.otherwise)
            return min(a[0], b[0]), max(a[1], b[1])
        if isinstance(e, ir.Sequence):
            return self.range(e.value)
        if isinstance(e, ir.Unary) and e.type.integer:
            low, high = self.range(e.operand)
            if e.op == "neg":
                return -high, -low
            if e.op == "abs" and low >= 0:
                return low, high
        return None

    def _combine(self, op: str, a: Interval, b: Interval) -> Interval | None:
        if op == "add":
            return a[0] + b[0], a[1] + b[1]
        if op == "sub":
            return a[0] - b[1], a[1] - b[0]
        if op == "mul":
            products = [x * y for x in a for y in b]
            return min(products), max(products)
        if op == "min":
            return min(a[0], b[0]), min(a[1], b[1])
        if op == "max":
            return max(a[0], b[0]), max(a[1], b[1])
        handler = {"div": _divided, "rem": _remainder, "and": _masked, "or": _joined, "xor": _joined,
                   "shr": _shifted_down, "shl": _shifted_up}.get(op)  # fmt: skip
        return handler(a, b) if handler is not None else None


def _divided(a: Interval, b: Interval) -> Interval | None:
    if b[0] <= 0 <= b[1]:
        return None
    quotients = [_truncate(x, y) for x in a for y in b]
    if a[0] < 0 < a[1]:
        quotients.append(0)
    return min(quotients), max(quotients)


def _truncate(x: int, y: int) -> int:
    return abs(x) // abs(y) * (1 if (x < 0) == (y < 0) else -1)


def _remainder(a: Interval, b: Interval) -> Interval | None:
    """The remainder has the sign of the dividend and is smaller than the divisor."""
    largest = max(abs(b[0]), abs(b[1])) - 1
    if largest < 0:
        return None
    return (max(a[0], -largest) if a[0] < 0 else 0), (min(a[1], largest) if a[1] > 0 else 0)


def _masked(a: Interval, b: Interval) -> Interval | None:
    limits = [x[1] for x in (a, b) if x[0] >= 0]
    return (0, min(limits)) if limits else None


def _joined(a: Interval, b: Interval) -> Interval | None:
    if a[0] < 0 or b[0] < 0:
        return None
    return 0, (1 << max(a[1], b[1]).bit_length()) - 1


def _shifted_down(a: Interval, b: Interval) -> Interval | None:
    if a[0] < 0 or b[0] < 0:
        return None
    return a[0] >> min(b[1], 64), a[1] >> b[0]


def _shifted_up(a: Interval, b: Interval) -> Interval | None:
    if a[0] < 0 or b[1] > 63:
        return None
    return a[0] << b[0], a[1] << b[1]

"""`__TRY ... __CATCH ... __FINALLY`: a fault in the body comes back to the place that set the guard.

A guard is a jump buffer of the function; `tappet_guard` makes it the place that the next fault of the task
returns to and gives the one before. Whatever leaves a guarded part on its own (RETURN, EXIT, CONTINUE, JMP)
gives the guard back first, and goes through the code of `__FINALLY`.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from functools import partial

from tappet.core import ir
from tappet.core.body import Body
from tappet.core.guard import Guard

BUFFER_SIZE = 512
"""Bytes of a jmp_buf, more than any C library needs."""
RECORD_SIZE = 640
"""Bytes of what the runtime knows of a fault, at least (FAULT_RECORD)."""


def externals(b: Body) -> None:
    """Import what the runtime offers."""
    for function in (
        ir.External(ir.GUARD, [ir.U64], ir.U64),
        ir.External("tappet_keep_fault", [ir.U64]),
        ir.External("tappet_rethrow", [ir.I32, ir.U64], ir.VOID, noreturn=True),
        ir.External("tappet_exception_code", [ir.I32], ir.U32),
    ):
        b.program.module.externals.setdefault(function.name, function)


def exception_code(fault: ir.Local) -> ir.Expr:
    """The value of `__SYSTEM.ExceptionCode` for a fault."""
    return ir.Call(ir.U32, "tappet_exception_code", [ir.Load(ir.I32, ir.Place(fault))])


def guarded(
    b: Body,
    labels: frozenset[str],
    body: Callable[[], None],
    handler: Callable[[Guard, ir.Local], None],
    final: Callable[[], None] | None = None,
) -> None:
    """Code that runs `body`; a fault in it comes to `handler` with its code. `final` follows in any case."""
    b.function.returns_twice = True
    externals(b)
    number = b.temporaries
    guard = Guard(b.space(BUFFER_SIZE, 16), b.temp(ir.U64, once=False), labels)
    fault = b.temp(ir.I32, once=False)
    if final is not None:
        guard.final = f"__FINALLY.{number}"
        guard.pending = b.temp(ir.I32, once=False)
        _store(b, guard.pending, 0)
    address = ir.Address(ir.PTR, ir.Place(guard.buffer))
    b.emit(ir.Store(ir.Place(guard.before), ir.Call(ir.U64, ir.GUARD, [ir.Convert(ir.U64, address)])))
    b.emit(ir.Store(ir.Place(fault), ir.Intrinsic(ir.I32, "setjmp", [address])))
    with b.block_of() as attempt:
        b.guards.append(guard)
        body()
        b.guards.pop()
        _give_back(b, guard)
    with b.block_of() as caught:
        _give_back(b, guard)
        handler(guard, fault)
    none = ir.Compare(ir.BOOL, "eq", ir.Load(ir.I32, ir.Place(fault)), ir.Const(ir.I32, 0))
    b.emit(ir.If(none, attempt, caught))
    if final is not None:
        b.emit(ir.Label(guard.final))
        final()
        _go_on(b, guard)


def pass_on(b: Body, guard: Guard, fault: ir.Local) -> None:
    """A handler that passes the fault on to the next guard, after `__FINALLY`, which may catch faults of its
    own meanwhile."""
    read = ir.Load(ir.I32, ir.Place(fault))
    record = ir.Convert(ir.U64, ir.Address(ir.PTR, ir.Place(b.space(RECORD_SIZE, 8))))
    b.emit(ir.Evaluate(ir.Call(ir.VOID, "tappet_keep_fault", [record])))
    go_to_final(b, guard, lambda: b.emit(ir.Evaluate(ir.Call(ir.VOID, "tappet_rethrow", [read, record]))))


def leave(b: Body, crossed: Sequence[Guard], exit_: Callable[[], None]) -> None:
    """Emit `exit_`, which leaves the guards `crossed`, the innermost last."""
    for position in range(len(crossed) - 1, -1, -1):
        guard = crossed[position]
        _give_back(b, guard)
        if guard.final:
            go_to_final(b, guard, partial(leave, b, crossed[:position], exit_))
            return
    exit_()


def go_to_final(b: Body, guard: Guard, afterwards: Callable[[], None]) -> None:
    """Go to the code of `__FINALLY`, and on from there."""
    assert guard.pending is not None
    guard.exits.append(afterwards)
    _store(b, guard.pending, len(guard.exits))
    b.emit(ir.Goto(guard.final))


@contextmanager
def loop(b: Body) -> Iterator[None]:
    """EXIT and CONTINUE inside leave the guards that begin inside."""
    b.loop_guards.append(len(b.guards))
    try:
        yield
    finally:
        b.loop_guards.pop()


def leave_loop(b: Body, statement: ir.Stmt) -> None:
    """EXIT or CONTINUE."""
    leave(b, b.guards[b.loop_guards[-1] :], lambda: b.emit(statement))


def leave_by_jump(b: Body, label: str) -> None:
    """JMP to a label, perhaps out of guarded parts."""
    outside = next((n for n, guard in enumerate(b.guards) if label not in guard.labels), len(b.guards))
    leave(b, b.guards[outside:], lambda: b.emit(ir.Goto(label)))


def _go_on(b: Body, guard: Guard) -> None:
    """Behind `__FINALLY`: how the part was left."""
    assert guard.pending is not None
    pending = ir.Load(ir.I32, ir.Place(guard.pending))
    for number, afterwards in enumerate(guard.exits, start=1):
        with b.block_of() as then:
            afterwards()
        b.emit(ir.If(ir.Compare(ir.BOOL, "eq", pending, ir.Const(ir.I32, number)), then, []))


def _give_back(b: Body, guard: Guard) -> None:
    before = ir.Load(ir.U64, ir.Place(guard.before))
    b.emit(ir.Evaluate(ir.Call(ir.U64, ir.GUARD, [before])))


def _store(b: Body, local: ir.Local, value: int) -> None:
    b.emit(ir.Store(ir.Place(local), ir.Const(ir.I32, value)))

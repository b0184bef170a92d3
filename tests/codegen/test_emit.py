"""LLVM text from hand-built core modules: compiled, linked and run."""

from __future__ import annotations

import pytest
from linked_application import ApplicationFault, LoadedApplication

from tappet.codegen.compile_options import LlvmError, OptimiseOptions
from tappet.codegen.emit_module import EmitOptions, emit_module
from tappet.codegen.optimise import compile_text
from tappet.codegen.package import CodePackage, DataObject
from tappet.codegen.symbol_map import SymbolMap
from tappet.core import ir

DATA = ir.Data("tappet.data.P")


def place(offset: int, *subscripts: ir.Subscript) -> ir.Place:
    return ir.Place(DATA, offset, subscripts)


def number(value: int | float, t: ir.Scalar = ir.I32) -> ir.Const:
    return ir.Const(t, value)


def load(offset: int, t: ir.Scalar = ir.I32) -> ir.Load:
    return ir.Load(t, place(offset))


def run(body: list[ir.Stmt], image: bytes = b"", extra: list[ir.Function] | None = None) -> bytes:
    """Image after one run of `body` over 256 bytes of data."""
    main = ir.Function("main", body=body, exported=True, uri="Main", line=1)
    module = ir.Module({f.name: f for f in [*(extra or []), main]}, data={"tappet.data.P": (256, 8)})
    text = emit_module(module, list(module.functions), EmitOptions(), whole=True)
    package = CodePackage(
        "test", "", "", "", [compile_text(text, OptimiseOptions())], 256,
        {"tappet.data.P": DataObject(0, 256)}, image.ljust(256, b"\0"), [], SymbolMap(), exports=["main"],
    )  # fmt: skip
    application = LoadedApplication(package)
    try:
        application.image[:256] = package.initial_image
        application.call("main")
        return bytes(application.image[:256])
    finally:
        application.close()


def int_at(data: bytes, offset: int, size: int = 4, signed: bool = True) -> int:
    return int.from_bytes(data[offset : offset + size], "little", signed=signed)


def test_store_and_arithmetic():
    value = ir.Binary(ir.I32, "mul", ir.Binary(ir.I32, "add", load(0), number(3)), number(7))
    image = run([ir.Store(place(4), value)], (39).to_bytes(4, "little"))
    assert int_at(image, 4) == 294


@pytest.mark.parametrize(
    ("a", "b", "quotient", "rest"),
    [(7, 2, 3, 1), (-7, 2, -3, -1), (7, -1, -7, 0), (-(2**31), -1, -(2**31), 0), (-9, -4, 2, -1)],
)
def test_division_truncates_and_never_traps(a: int, b: int, quotient: int, rest: int):
    body: list[ir.Stmt] = [
        ir.Store(place(8), ir.Binary(ir.I32, "div", load(0), load(4), checked=True)),
        ir.Store(place(12), ir.Binary(ir.I32, "rem", load(0), load(4), checked=True)),
    ]
    image = run(body, a.to_bytes(4, "little", signed=True) + b.to_bytes(4, "little", signed=True))
    assert (int_at(image, 8), int_at(image, 12)) == (quotient, rest)


def test_division_by_zero_faults():
    with pytest.raises(ApplicationFault, match="division by zero") as caught:
        run([ir.Store(place(8), ir.Binary(ir.I32, "div", load(0), load(4), checked=True))])
    assert caught.value.code == 1


def test_bounds_fault_names_index_and_bounds():
    element = place(16, ir.Subscript(load(0), 1, 10, 4))
    with pytest.raises(ApplicationFault, match=r"array index 11 outside 1\.\.10"):
        run([ir.Store(element, number(1))], (11).to_bytes(4, "little"))
    image = run([ir.Store(element, number(99))], (10).to_bytes(4, "little"))
    assert int_at(image, 16 + 9 * 4) == 99


@pytest.mark.parametrize(
    ("t", "start", "stop", "step", "passes", "left"),
    [
        (ir.I16, 1, 5, 1, 5, 6),
        (ir.I16, 5, 1, 1, 0, 5),
        (ir.I16, 5, 1, -2, 3, -1),
        (ir.I32, 0, 10, 3, 4, 12),
        (ir.U8, 250, 253, 2, 2, 254),
        (ir.I64, 10, 1, -4, 3, -2),
    ],
)
@pytest.mark.parametrize("fixed", [False, True])
def test_for_counts_and_leaves_the_next_value(t, start, stop, step, passes, left, fixed):
    count: ir.Stmt = ir.Store(place(64), ir.Binary(ir.I32, "add", load(64), number(1)))
    loop = ir.For(place(0), t, number(start, t), load(8, t), step, [count], fixed=fixed)
    size = t.size
    image = run([loop], bytes(8) + (stop % (1 << t.bits)).to_bytes(size, "little"))
    assert int_at(image, 64) == passes
    assert int_at(image, 0, size, t.signed) == left


def test_while_continue_and_break():
    i, total = place(0), place(4)
    body: list[ir.Stmt] = [
        ir.Store(i, ir.Binary(ir.I32, "add", load(0), number(1))),
        ir.If(ir.Compare(ir.BOOL, "eq", load(0), number(3)), [ir.Continue()], []),
        ir.If(ir.Compare(ir.BOOL, "gt", load(0), number(6)), [ir.Break()], []),
        ir.Store(total, ir.Binary(ir.I32, "add", load(4), load(0))),
    ]
    image = run([ir.While(ir.Const(ir.BOOL, 1), body)])
    assert int_at(image, 4) == 1 + 2 + 4 + 5 + 6


@pytest.mark.parametrize(("value", "expected"), [(1, 10), (5, 10), (2, 20), (15, 30), (500, 40), (21, 0)])
def test_switch_with_ranges(value: int, expected: int):
    def store(n: int) -> list[ir.Stmt]:
        return [ir.Store(place(4), number(n))]

    cases = [
        ir.SwitchCase([(1, 1), (5, 5)], store(10)),
        ir.SwitchCase([(2, 2)], store(20)),
        ir.SwitchCase([(10, 20)], store(30)),
        ir.SwitchCase([(100, 900)], store(40)),
    ]
    image = run([ir.Switch(load(0), cases, store(0))], value.to_bytes(4, "little"))
    assert int_at(image, 4) == expected


@pytest.mark.parametrize(
    ("op", "t", "value", "count", "expected"),
    [
        ("shl", ir.U8, 0x45, 2, 0x14),
        ("shl", ir.U16, 0x45, 2, 0x114),
        ("shr", ir.U8, 0x45, 2, 0x11),
        ("rol", ir.U8, 0x45, 2, 0x15),
        ("ror", ir.U16, 0x45, 2, 0x4011),
        ("shl", ir.U8, 0x45, 9, 0),
        ("shr", ir.U32, 0x45, 32, 0),
        ("shr", ir.I8, 0x80, 20, 0xFF),
        ("rol", ir.U8, 0x81, 9, 0x03),
    ],
)
@pytest.mark.parametrize("constant", [False, True])
def test_shifts(op, t, value, count, expected, constant):
    right: ir.Expr = number(count, ir.U32) if constant else load(8, ir.U32)
    body: list[ir.Stmt] = [ir.Store(place(16), ir.Binary(t, op, load(0, t), right))]
    image = run(body, value.to_bytes(8, "little") + count.to_bytes(4, "little"))
    assert int_at(image, 16, t.size, False) == expected


def test_selected_operand_only_is_evaluated():
    bad = ir.Binary(ir.I32, "div", number(1), load(8), checked=True)
    choice = ir.Select(ir.I32, ir.Compare(ir.BOOL, "eq", load(0), number(0)), number(5), bad)
    image = run([ir.Store(place(4), choice)])
    assert int_at(image, 4) == 5


def test_short_circuit_guards_a_subscript():
    inside = ir.Compare(ir.BOOL, "lt", load(0), number(3))
    item = ir.Load(ir.I32, place(16, ir.Subscript(load(0), 0, 2, 4)))
    both = ir.ShortCircuit(ir.BOOL, "and", inside, ir.Compare(ir.BOOL, "eq", item, number(0)))
    image = run([ir.If(both, [ir.Store(place(4), number(1))], [ir.Store(place(4), number(2))])], b"\7")
    assert int_at(image, 4) == 2


def test_function_result_and_parameters():
    result = ir.Local("twice", 4, 4, ir.I32)
    double = ir.Function(
        "twice",
        [ir.Parameter("x", ir.I32)],
        ir.I32,
        result,
        body=[ir.Store(ir.Place(result), ir.Binary(ir.I32, "mul", ir.Argument(ir.I32, 0), number(2)))],
    )
    image = run([ir.Store(place(0), ir.Call(ir.I32, "twice", [number(21)]))], extra=[double])
    assert int_at(image, 0) == 42


def test_promoted_variable_is_written_back_at_return_and_fault():
    i = ir.Local("i", 4, 4, ir.I32)
    home = place(0)

    def loop(leave: ir.Stmt) -> ir.Stmt:
        step = ir.Store(ir.Place(i), ir.Binary(ir.I32, "add", ir.Load(ir.I32, ir.Place(i)), number(1)))
        done = ir.Compare(ir.BOOL, "eq", ir.Load(ir.I32, ir.Place(i)), number(5))
        return ir.Promoted(
            [(home, i, ir.I32, True)], ir.While(ir.Const(ir.BOOL, 1), [step, ir.If(done, [leave], [])])
        )

    assert int_at(run([loop(ir.Return())]), 0) == 5
    assert int_at(run([loop(ir.Break())]), 0) == 5


@pytest.mark.parametrize(
    ("value", "mode", "expected"),
    [
        (1.5, "round", 2),
        (-1.5, "round", -2),
        (1.4, "round", 1),
        (-1.9, "trunc", -1),
        (1e300, "round", 2**31 - 1),
        (float("nan"), "round", 0),
        (-1e300, "trunc", -(2**31)),
    ],
)
def test_float_to_integer_saturates(value: float, mode: str, expected: int):
    body: list[ir.Stmt] = [ir.Store(place(0), ir.Convert(ir.I32, number(value, ir.F64), mode))]
    assert int_at(run(body), 0) == expected


@pytest.mark.parametrize(("labels", "optimised"), [(400, True), (401, False)])
def test_a_body_of_very_many_labels_is_not_optimised(labels: int, optimised: bool):
    """Optimising jumps back and forth takes minutes: 88 s for 3,000 labels against 2 s."""
    main = ir.Function("main", body=[], exported=True, uri="Main", line=1, labels=labels)
    text = emit_module(ir.Module({"main": main}), ["main"], EmitOptions(), whole=True)
    group = next(line.split()[1] for line in text.splitlines() if line.endswith("optnone }"))
    head = next(line for line in text.splitlines() if line.startswith("define "))
    assert (group in head) != optimised


def test_bad_text_is_reported():
    with pytest.raises(LlvmError):
        compile_text("define void @f( {", OptimiseOptions())

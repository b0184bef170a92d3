"""Expressions that the executive evaluates, against IEC arithmetic in Python and against compiled ST."""

from __future__ import annotations

import math
import random
import struct
from collections.abc import Iterator

import pytest
from expression_values import value_now
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from plc_programs import build

from tappet.codegen.expressions import program as programs
from tappet.codegen.expressions.compiler import (
    compile_condition,
    compile_crossing,
    compile_expression,
    place_of,
)
from tappet.codegen.expressions.places import ExpressionError
from tappet.codegen.expressions.program import ExpressionProgram, Kind, Op, ProgramError, Step, check_program
from tappet.runtime.executive.loader import sources
from tappet.runtime.local import LocalRuntime

TEXT = """
TYPE Mode : (Off, Ready, Run := 5) INT; END_TYPE
TYPE Colour : (Red, Green, Ready) DINT; END_TYPE
TYPE Point : STRUCT x : INT; y : LREAL; flags : WORD; on : BIT; END_STRUCT END_TYPE
FUNCTION_BLOCK Counter
VAR_IN_OUT target : DINT; END_VAR
VAR count : DINT; END_VAR
count := count + 1;
END_FUNCTION_BLOCK
PROGRAM PLC_PRG
VAR
    si : SINT; i : INT; d : DINT; l : LINT; us : USINT; u : UINT; ud : UDINT; ul : ULINT;
    by : BYTE; w : WORD; dw : DWORD; lw : LWORD; r : REAL; lr : LREAL; x : BOOL; y : BOOL;
    mode : Mode; t1 : TIME; t2 : TIME := T#2s; lt : LTIME; day : DATE; colour : Colour;
    p : Point := (x := 3, y := 1.5, flags := 16#8001, on := TRUE);
    grid : ARRAY [1..3, -1..1] OF INT := [11, 12, 13, 21, 22, 23, 31, 32, 33];
    points : ARRAY [0..1] OF Point := [(x := 7), (x := 8, flags := 4)];
    pd : POINTER TO DINT; pp : POINTER TO Point; nowhere : POINTER TO DINT; made : POINTER TO DINT;
    rd : REFERENCE TO DINT; counter : Counter; text : STRING;
    numbers : ARRAY [0..3] OF DINT := [10, 20, 30, 40];
END_VAR
pd := ADR(d); pp := ADR(points[1]); rd REF= d; nowhere := 16#10;
IF made = 0 THEN made := __NEW(DINT); made^ := 77; END_IF
counter(target := d);
END_PROGRAM
"""
INTEGERS = {
    "si": (1, True), "i": (2, True), "d": (4, True), "l": (8, True), "us": (1, False), "u": (2, False),
    "ud": (4, False), "ul": (8, False), "by": (1, False), "w": (2, False), "dw": (4, False), "lw": (8, False),
}  # fmt: skip


@pytest.fixture(scope="module")
def runtime() -> Iterator[LocalRuntime]:
    with LocalRuntime(build(TEXT)) as found:
        found.run(cycles=1)
        yield found


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("PLC_PRG.p.x", 3),
        ("PLC_PRG.p.y * 2", 3.0),
        ("PLC_PRG.p.flags.15", True),
        ("PLC_PRG.p.flags.1", False),
        ("PLC_PRG.p.on", True),
        ("plc_prg.GRID[2, 0]", 22),
        ("PLC_PRG.grid[PLC_PRG.p.x, -1]", 31),
        ("PLC_PRG.grid[PLC_PRG.p.x - 2, PLC_PRG.p.x - 2]", 13),
        ("PLC_PRG.points[PLC_PRG.us + 1].x", 8),
        ("PLC_PRG.points[PLC_PRG.us + 1].flags.2", True),
        ("PLC_PRG.pp^.x", 8),
        ("PLC_PRG.pp^.flags.2", True),
        ("PLC_PRG.made^", 77),
        ("PLC_PRG.made^ > 70 AND PLC_PRG.x = FALSE", True),
        ("PLC_PRG.mode = Mode.Off", True),
        ("PLC_PRG.mode = Off", True),
        ("Run = PLC_PRG.mode", False),
        ("PLC_PRG.mode <> Ready", True),
        ("PLC_PRG.t2 > T#1s999ms", True),
        ("PLC_PRG.t2 + T#1s", 3000),
        ("T#500ms * 3", 1500),
        ("PLC_PRG.day = D#1970-01-01", True),
        ("NOT PLC_PRG.x", True),
        ("-(3 + 4) * 2", -14),
        ("16#FF AND 16#0F", 15),
        ("ABS(-3.5)", 3.5),
        ("MIN(3, PLC_PRG.p.x + 1)", 3),
        ("MAX(2.5, 1)", 2.5),
        ("SQRT(16)", 4.0),
        ("7 / 2", 3),
        ("-7 / 2", -3),
        ("-7 MOD 3", -1),
        ("7.0 / 2", 3.5),
        ("PLC_PRG.numbers[PLC_PRG.p.x]", 40),
        ("PLC_PRG.text[0] = 0", True),
        ("PLC_PRG.x OR PLC_PRG.y XOR TRUE", True),
        (" + ".join(["1"] * 40), 40),
    ],
)
def test_values(runtime: LocalRuntime, text: str, value: float) -> None:
    assert value_now(runtime, text) == value


def test_references_and_pointers_follow_their_variable(runtime: LocalRuntime) -> None:
    runtime.write("PLC_PRG.d", 12)
    assert value_now(runtime, "PLC_PRG.rd + PLC_PRG.pd^ + PLC_PRG.counter.target") == 36
    assert value_now(runtime, "PLC_PRG.pd[0]") == 12


@pytest.mark.parametrize(
    "text",
    [
        "1 / PLC_PRG.us",
        "1 MOD PLC_PRG.us",
        "PLC_PRG.nowhere^",
        "PLC_PRG.nowhere^ = 0 OR TRUE",
        "PLC_PRG.numbers[PLC_PRG.p.x + 1]",
        "PLC_PRG.numbers[PLC_PRG.us - 1]",
        "PLC_PRG.pd[1000000000]",
    ],
)
def test_what_has_no_value_is_not_valid_and_raises_nothing(runtime: LocalRuntime, text: str) -> None:
    assert value_now(runtime, text) is None


def test_and_then_guards_what_stands_behind_it(runtime: LocalRuntime) -> None:
    guarded = "PLC_PRG.x AND_THEN PLC_PRG.nowhere^ = 3"
    assert value_now(runtime, guarded) is False
    assert value_now(runtime, f"NOT (NOT PLC_PRG.x OR_ELSE PLC_PRG.nowhere^ = 3) = ({guarded})") is True


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("PLC_PRG.nix", "has no member 'nix'"),
        ("Nix.a", "'Nix' is no program"),
        ("PLC_PRG.p", "no single number"),
        ("PLC_PRG.text", "no single number"),
        ("PLC_PRG.pp.x", "write ^ before the member 'x'"),
        ("PLC_PRG.x + 1", "not possible"),
        ("PLC_PRG.d +", "expected"),
        ("", "missing"),
        ("Ready", "several enumerations"),
        ("F(1)", "only ABS, SQRT, MIN, MAX, LIMIT can"),
        ("PLC_PRG.numbers[9]", "outside 0..3"),
        ("PLC_PRG.x < PLC_PRG.y", "compared with = and <>"),
        ("1.5 MOD 2", "MOD needs integers"),
        ("ABS(1, 2)", "takes 1 values"),
        ("'a' = 'b'", "no number"),
        ("PLC_PRG.d.40", "bit 40"),
        ("PLC_PRG.numbers[1.5]", "an index is an integer"),
        ("THIS^.a", "THIS means nothing"),
        (" + ".join(["1"] * 600), "at most 1000 characters"),
        ("PLC_PRG.d := 3", "only variables"),
    ],
)
def test_errors_name_what_is_wrong(runtime: LocalRuntime, text: str, said: str) -> None:
    with pytest.raises(ExpressionError, match=said.replace("(", r"\(").replace("^", r"\^")):
        compile_expression(text, runtime.package.symbols)


def test_depth_is_bounded(runtime: LocalRuntime) -> None:
    deep = "(" * 40 + "1" + "+ PLC_PRG.d)" * 40
    assert compile_expression(deep, runtime.package.symbols).steps  # leaning to the left it needs two words
    with pytest.raises(ExpressionError, match="too deep"):
        compile_expression("(PLC_PRG.d + " * 40 + "1" + ")" * 40, runtime.package.symbols)


def test_conditions_and_crossings(runtime: LocalRuntime) -> None:
    symbols = runtime.package.symbols
    assert compile_condition("PLC_PRG.d", symbols).kind == Kind.BOOL
    assert compile_crossing("PLC_PRG.mode", "Run", True, symbols).kind == Kind.BOOL
    with pytest.raises(ExpressionError, match="needs a level"):
        compile_crossing("PLC_PRG.d", " ", True, symbols)
    with pytest.raises(ExpressionError, match="which has no level"):
        compile_crossing("PLC_PRG.x", "1", True, symbols)
    found = place_of("PLC_PRG.grid[2, 0]", symbols)
    assert found is not None
    assert found.offset == symbols.resolve("PLC_PRG.grid[2,0]").offset
    assert place_of("PLC_PRG.pd^", symbols) is None


def test_numbers_of_steps_are_those_of_the_executive() -> None:
    text = next(s.text for s in sources() if s.uri.endswith("/types.st"))
    known = {"EXPRESSION_OP": programs.Op, "EXPRESSION_KIND": programs.Kind}
    for name, numbers in known.items():
        listed = text.split(f"TYPE {name} : (")[1].split(")")[0]
        assert {row.split(":=")[0].strip(): int(row.split(":=")[1]) for row in listed.split(",")} == {
            number.name: number.value for number in numbers
        }


@pytest.mark.parametrize(
    "steps",
    [
        [],
        [Step(99)],
        [Step(Op.ADD)],
        [Step(Op.PUSH)] * 2,
        [Step(Op.PUSH)] * 40 + [Step(Op.ADD)] * 39,
        [Step(Op.LOAD, Kind.LINT, 97)],
        [Step(Op.LOAD, Kind.LINT, -1)],
        [Step(Op.LOAD, 77, 0)],
        [Step(Op.LOAD, 1, 0, 7)],
        [Step(Op.PUSH), Step(Op.SKIP_TRUE, a=5)],
        [Step(Op.PUSH), Step(Op.SKIP_TRUE, a=-1), Step(Op.PUSH)],
        [Step(Op.PUSH), Step(Op.SKIP_TRUE, a=2), Step(Op.PUSH), Step(Op.PUSH), Step(Op.ADD)],
        [Step(Op.PUSH, a=1 << 63)],
        [Step(Op.PUSH)] * 300,
    ],
)
def test_steps_that_are_no_program_are_refused(steps: list[Step]) -> None:
    with pytest.raises(ProgramError):
        check_program(ExpressionProgram(tuple(steps), Kind.LINT, "LINT"), 104)


# -- against IEC arithmetic in Python ------------------------------------------------------------------


def _held(value: int, size: int, signed: bool) -> int:
    value %= 1 << 8 * size
    return value - (1 << 8 * size) if signed and value >> (8 * size - 1) else value


def _meeting(a: tuple[int, bool], b: tuple[int, bool]) -> tuple[int, bool]:
    """Size and sign in which two integers meet (LOPR-03)."""
    size = max(a[0], b[0])
    if size < 4:
        return 4, True
    if a[1] == b[1]:
        return size, a[1]
    if (a[0] if not a[1] else b[0]) == 4 and size == 4:
        return 8, True
    if (a[0] if not a[1] else b[0]) < 8:
        return size, True
    signed_size = a[0] if a[1] else b[0]
    return 8, signed_size == 8


def _expected(op: str, a: int, b: int, meeting: tuple[int, bool]) -> int | bool | None:
    a, b = _held(a, *meeting), _held(b, *meeting)
    if op in ("/", "MOD"):
        if b == 0:
            return None
        quotient = abs(a) // abs(b) * (-1 if (a < 0) != (b < 0) else 1)
        return _held(quotient if op == "/" else a - quotient * b, *meeting)
    found = {"+": a + b, "-": a - b, "*": a * b}.get(op)
    if found is not None:
        return _held(found, *meeting)
    return {"=": a == b, "<>": a != b, "<": a < b, "<=": a <= b, ">": a > b, ">=": a >= b}[op]


@settings(max_examples=300, suppress_health_check=[HealthCheck.function_scoped_fixture], deadline=None)
@given(st.data())
def test_integers_of_all_types_meet_as_the_standard_says(runtime: LocalRuntime, data: st.DataObject) -> None:
    left, right = (data.draw(st.sampled_from(sorted(INTEGERS))) for _ in range(2))
    op = data.draw(st.sampled_from(["+", "-", "*", "/", "MOD", "=", "<>", "<", "<=", ">", ">="]))
    values = {}
    for name in {left, right}:
        size, signed = INTEGERS[name]
        low, high = (-(1 << 8 * size - 1), (1 << 8 * size - 1) - 1) if signed else (0, (1 << 8 * size) - 1)
        values[name] = data.draw(st.integers(low, high) | st.sampled_from([low, high, low + 1, 0, 1]))
        runtime.write(f"PLC_PRG.{name}", values[name])
    found = value_now(runtime, f"PLC_PRG.{left} {op} PLC_PRG.{right}")
    assert found == _expected(op, values[left], values[right], _meeting(INTEGERS[left], INTEGERS[right]))


def _single(value: float) -> float:
    try:
        found: float = struct.unpack("<f", struct.pack("<f", value))[0]
    except OverflowError:
        return math.copysign(math.inf, value)
    return found


@settings(max_examples=200, suppress_health_check=[HealthCheck.function_scoped_fixture], deadline=None)
@given(
    st.floats(width=32, allow_nan=False, allow_infinity=False),
    st.floats(width=32, allow_nan=False, allow_infinity=False),
    st.sampled_from("+-*/"),
)
def test_real_is_rounded_once_and_lreal_not(runtime: LocalRuntime, a: float, b: float, op: str) -> None:
    runtime.write("PLC_PRG.r", a)
    runtime.write("PLC_PRG.lr", b)
    runtime.write("PLC_PRG.p.y", a)
    if op == "/" and b == 0:
        return
    exact = {"+": a + b, "-": a - b, "*": a * b}.get(op)
    exact = a / b if exact is None else exact
    assert value_now(runtime, f"PLC_PRG.p.y {op} PLC_PRG.lr") == exact
    literal = f"REAL#{b!r}"
    assert value_now(runtime, f"PLC_PRG.r {op} {literal}") == _single(exact)


# -- against compiled code -----------------------------------------------------------------------------

_LIMITS = {"ud": (0, 1 << 32), "i": (-(1 << 15), 1 << 15), "us": (0, 256), "l": (-(1 << 62), 1 << 62)}
_WIDE = ["d", "l", "ud", "r", "lr", "i", "us"]


def _random_number(rng: random.Random, depth: int) -> str:
    if depth == 0 or rng.random() < 0.15:
        literals = [str(rng.randint(-99, 99)), f"{rng.uniform(-9, 9):.3f}", "70000", "3000000000"]
        return rng.choice([*(f"v.{name}" for name in _WIDE), rng.choice(literals)])
    if rng.random() < 0.15:
        name = rng.choice(["MIN", "MAX"])
        return f"{name}({_random_number(rng, depth - 1)}, {_random_number(rng, depth - 1)})"
    op = rng.choice(["+", "-", "*"])
    return f"({_random_number(rng, depth - 1)} {op} {_random_number(rng, depth - 1)})"


def _random_condition(rng: random.Random, depth: int) -> str:
    if depth == 0:
        return f"{_random_number(rng, 2)} {rng.choice(['<', '<=', '>', '>='])} {_random_number(rng, 2)}"
    if rng.random() < 0.2:
        return f"NOT ({_random_condition(rng, depth - 1)})"
    op = rng.choice(["AND", "OR", "XOR", "AND_THEN", "OR_ELSE", "=", "<>"])
    return f"(({_random_condition(rng, depth - 1)}) {op} ({_random_condition(rng, depth - 1)}))"


@pytest.mark.parametrize("seed", range(3))
def test_conditions_are_what_compiled_code_finds(seed: int) -> None:
    """What the evaluator can express has the value that the same text has in a program."""
    rng = random.Random(seed)
    texts = [_random_condition(rng, 2) for _ in range(60)]
    declared = "; ".join(f"{name} : {kind}" for name, kind in zip(
        _WIDE, ["DINT", "LINT", "UDINT", "REAL", "LREAL", "INT", "USINT"], strict=True
    ))  # fmt: skip
    body = "\n".join(f"found[{i}] := {text};" for i, text in enumerate(texts))
    text = f"""
TYPE Values : STRUCT {declared}; END_STRUCT END_TYPE
PROGRAM PLC_PRG
VAR found : ARRAY [0..59] OF BOOL; END_VAR
{body}
END_PROGRAM
"""
    with LocalRuntime(build(text, gvls={"GVL": "VAR_GLOBAL v : Values; END_VAR"})) as runtime:
        for _ in range(5):
            for name in _WIDE:
                low, high = _LIMITS.get(name, (-(1 << 31), 1 << 31))
                small = rng.random() < 0.5
                value = rng.randint(0 if low == 0 else -20, 20) if small else rng.randrange(low, high)
                runtime.write(f"v.{name}", value + (rng.random() if name in ("r", "lr") else 0))
            runtime.run(cycles=1)
            for i, expression in enumerate(texts):
                assert value_now(runtime, expression) == runtime.read(f"PLC_PRG.found[{i}]"), expression

"""The stack program of an expression: steps that the executive evaluates, and what they may be.

A stack holds words of 64 bits: integers, BOOL (0 or 1) and addresses as they are, REAL and LREAL as the bits
of an LREAL. Steps only go forwards, so that the time of an evaluation is bounded by their number.
"""

from __future__ import annotations

import struct
from enum import IntEnum

from msgspec import Struct


class Op(IntEnum):
    """What a step does; the same numbers as EXPRESSION_OP of expressions.st, which a test compares."""

    PUSH = 0
    """Push `a`."""
    LOAD = 1
    """Push the value of `kind` at offset `a` of base `b`."""
    ADDRESS = 2
    """Push the address of offset `a` of base `b`."""
    OFFSET = 3
    """Add `a` to the address on top."""
    INDEX = 4
    """Pop an index, which must be within `a` .. `b`, and add its elements of `kind` bytes to the address."""
    FETCH = 5
    """Replace an address by the value of `kind` that is there."""
    ADD = 6
    SUBTRACT = 7
    MULTIPLY = 8
    DIVIDE = 9
    MODULO = 10
    NEGATE = 11
    ABSOLUTE = 12
    MINIMUM = 13
    MAXIMUM = 14
    ROOT = 15
    EQUAL = 16
    NOT_EQUAL = 17
    LESS = 18
    LESS_EQUAL = 19
    GREATER = 20
    GREATER_EQUAL = 21
    BIT_AND = 22
    BIT_OR = 23
    BIT_XOR = 24
    FLIP = 25
    """Flip the bits that are set in `a`."""
    TO_REAL = 26
    """An integer of `kind` becomes LREAL, or REAL where `a` is 1."""
    SKIP_FALSE = 27
    """Pass over the next `a` steps when the top is 0, else pop it."""
    SKIP_TRUE = 28
    """Pass over the next `a` steps when the top is not 0, else pop it."""


class Kind(IntEnum):
    """How a value lies in memory, and in which type an operation computes."""

    BOOL = 0
    SINT = 1
    INT = 2
    DINT = 3
    LINT = 4
    USINT = 5
    UINT = 6
    UDINT = 7
    ULINT = 8
    REAL = 9
    LREAL = 10


KIND_SIZE = {
    Kind.BOOL: 1, Kind.SINT: 1, Kind.INT: 2, Kind.DINT: 4, Kind.LINT: 8, Kind.USINT: 1, Kind.UINT: 2,
    Kind.UDINT: 4, Kind.ULINT: 8, Kind.REAL: 4, Kind.LREAL: 8,
}  # fmt: skip
"""Bytes in memory."""


class Base(IntEnum):
    """What the offsets of a step count from."""

    IMAGE = 0
    THIS = 1
    """The instance whose code runs."""
    FRAME = 2
    """The call whose code runs: locals and inputs of a function or method."""


MOST_STEPS = 256
MOST_STACK = 32


class Step(Struct, frozen=True, array_like=True):
    """One step."""

    op: int
    kind: int = 0
    a: int = 0
    b: int = 0


class ExpressionProgram(Struct, frozen=True):
    """An expression as the executive evaluates it."""

    steps: tuple[Step, ...]
    kind: int
    """Of the result."""
    type_name: str
    """Of the result, as it is declared."""


class ProgramError(ValueError):
    """These steps are no program; the message says which one is wrong."""


_PUSHES = {Op.PUSH, Op.LOAD, Op.ADDRESS}
_POPS_ONE = {
    Op.INDEX, Op.ADD, Op.SUBTRACT, Op.MULTIPLY, Op.DIVIDE, Op.MODULO, Op.MINIMUM, Op.MAXIMUM, Op.EQUAL,
    Op.NOT_EQUAL, Op.LESS, Op.LESS_EQUAL, Op.GREATER, Op.GREATER_EQUAL, Op.BIT_AND, Op.BIT_OR, Op.BIT_XOR,
    Op.SKIP_FALSE, Op.SKIP_TRUE,
}  # fmt: skip
_NEEDS_TWO = _POPS_ONE - {Op.SKIP_FALSE, Op.SKIP_TRUE}


def check_program(program: ExpressionProgram, image_size: int) -> None:
    """Raise ProgramError unless the executive can evaluate `program`: depth of the stack, jumps, places."""
    steps = program.steps
    if not 0 < len(steps) <= MOST_STEPS:
        raise ProgramError(f"an expression has 1 to {MOST_STEPS} steps, not {len(steps)}")
    _known(Kind, program.kind, "result")
    targets: dict[int, int] = {}
    depth = 0
    for number, step in enumerate(steps):
        where = f"step {number + 1}"
        op = Op(_known(Op, step.op, where))
        if op is not Op.INDEX:
            _known(Kind, step.kind, where)
        if targets.get(number, depth) != depth:
            raise ProgramError(f"{where} is reached with stacks of different depth")
        if depth < (2 if op in _NEEDS_TWO else 0 if op in _PUSHES else 1):
            raise ProgramError(f"{where} takes more than there is on the stack")
        if op in (Op.LOAD, Op.ADDRESS):
            _known(Base, step.b, where)
            size = KIND_SIZE[Kind(step.kind)] if op is Op.LOAD else 0
            if step.b == Base.IMAGE and not 0 <= step.a <= image_size - size:
                raise ProgramError(f"{where} reads outside the image of {image_size} bytes")
        if op in (Op.SKIP_FALSE, Op.SKIP_TRUE):
            target = number + 1 + step.a
            if not number + 1 < target <= len(steps):
                raise ProgramError(f"{where} passes over {step.a} steps, which do not follow it")
            if targets.setdefault(target, depth) != depth:
                raise ProgramError(f"step {target + 1} is reached with stacks of different depth")
        depth += 1 if op in _PUSHES else -1 if op in _POPS_ONE else 0
        if depth > MOST_STACK:
            raise ProgramError(f"{where} needs a stack of more than {MOST_STACK} words")
        if not all(-(1 << 63) <= value < 1 << 63 for value in (step.a, step.b)):
            raise ProgramError(f"{where} has a number of more than 64 bits")
    if depth != 1 or targets.get(len(steps), 1) != 1:
        raise ProgramError(f"the expression leaves {depth} values, not one")


def _known(names: type[IntEnum], number: int, where: str) -> int:
    try:
        return names(number)
    except ValueError:
        raise ProgramError(f"{where}: {number} is no {names.__name__.lower()}") from None


def value_of(kind: int, word: int) -> bool | int | float:
    """The Python value of a result word (signed 64 bits)."""
    if kind in (Kind.REAL, Kind.LREAL):
        number: float = struct.unpack("<d", struct.pack("<q", word))[0]
        return number
    if kind == Kind.BOOL:
        return word != 0
    return word % (1 << 64) if kind == Kind.ULINT else word


def real_bits(value: float) -> int:
    """The word that holds an LREAL."""
    bits: int = struct.unpack("<q", struct.pack("<d", value))[0]
    return bits

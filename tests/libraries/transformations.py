"""All transformations of SM3_CNC in one program: rows of numbers in, rows of numbers out."""

from __future__ import annotations

import ctypes
import json
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
from tests.libraries.st_program import Program, run

from tappet.libraries import load
from tappet.libraries.catalog import Item, items

Numbers = npt.NDArray[np.float64]
Given = dict[str, Numbers | float | bool]
ROWS = 20_000
RELATIVE = 1e-12
"""Of the size of a machine: how near it has to come to where it was."""
DATA = Path(__file__).parents[1] / "spec" / "data"
CATALOG: dict[str, dict[str, Any]] = {
    item["name"]: item for item in json.loads((DATA / "SM3_CNC.json").read_text())["items"]
}
OTHERS = {
    *("SMC_CalcDirectionFromVector", "SMC_CoordinateTransformation3D", "SMC_InvCoordinateTransformation3D"),
    *("SMC_TeachCoordinateSystem", "SMC_UnitVectorToRPY", "SMC_DetermineCuboidBearing"),
}
"""Blocks about directions and coordinate systems."""
ROBOT = "ArticulatedRobot_6DOF"
OURS = {item.name: item for item in items(load("SM3_CNC"))}
BLOCKS: dict[str, Item] = {
    name: item
    for name, item in OURS.items()
    if item.kind == "function_block" and (name in OTHERS or name.upper().startswith("SMC_TRAFO"))
}
MEMBERS = {
    "SMC_POSINFO": ("dX", "dY", "dZ", "dA", "dB", "dC", "dA1", "dA6"),
    "SMC_VECTOR3D": ("dX", "dY", "dZ"),
    "AXIS_REF_SM3": ("fSetPosition",),
    "SMC_TrafoConfig_4AxisPalletizer": (
        *("dA1", "dD1", "dL1", "dL2", "dA4", "dD4"),
        *(f"adOffset[{axis}]" for axis in range(4)),
    ),
    "SMC_TrafoConfig_ArticulatedRobot_6DOF": (
        *("dA1", "dA2", "dA3", "dD1", "dD3", "dD4", "dD6"),
        *(f"adOffset[{axis}]" for axis in range(6)),
        "bZUp",
    ),
}
FROM_NUMBER = {"LREAL": "{}", "BOOL": "{} <> 0.0", "INT": "LREAL_TO_INT({})"}
TO_NUMBER = {
    "LREAL": "{}",
    "BOOL": "BOOL_TO_LREAL({})",
    "INT": "INT_TO_LREAL({})",
    "WORD": "WORD_TO_LREAL({})",
}
PER_CYCLE = 1000
WIDTH = 40
"""Numbers of a row."""


@dataclass(frozen=True)
class Number:
    """A number that a block is given or gives: the path below its instance, and its elementary type."""

    path: str
    type: str


def _numbers(name: str, type_name: str) -> Iterator[Number]:
    if type_name in MEMBERS:
        for member in MEMBERS[type_name]:
            yield Number(f"{name}.{member}", "BOOL" if member.startswith("b") else "LREAL")
    elif type_name.startswith("ARRAY"):
        count = int(type_name.partition("..")[2].partition("]")[0]) + 1
        yield from (Number(f"{name}[{index}]", "LREAL") for index in range(count))
    else:
        enumeration = type_name in OURS and OURS[type_name].kind == "enum"
        yield Number(name, "INT" if enumeration else type_name)


INPUTS = {
    name: [number for pin in (*item.in_out, *item.inputs) for number in _numbers(pin.name, pin.type)]
    for name, item in BLOCKS.items()
}
OUTPUTS = {
    name: [number for pin in item.outputs for number in _numbers(pin.name, pin.type)]
    for name, item in BLOCKS.items()
}


def _of_block(name: str) -> str:
    """Declarations of a block and of what it takes by reference."""
    references = (
        f"    {name}_{pin.name} : SM3_Basic.AXIS_REF_VIRTUAL_SM3;"
        if pin.type == "AXIS_REF_SM3"
        else f"    {name}_{pin.name} : SM3_CNC.{pin.type};"
        for pin in BLOCKS[name].in_out
    )
    return "\n".join((f"    {name} : SM3_CNC.{name};", *references))


def _call(number: int, name: str) -> str:
    by_reference = {pin.name for pin in BLOCKS[name].in_out}
    lines = [f"    {number}:"]
    for index, given in enumerate(INPUTS[name]):
        joint = "_" if given.path.partition(".")[0] in by_reference else "."
        value = FROM_NUMBER[given.type].format(f"afIn[n + {index}]")
        lines.append(f"        {name}{joint}{given.path} := {value};")
    pins = ", ".join(f"{pin} := {name}_{pin}" for pin in sorted(by_reference))
    lines.append(f"        {name}({pins});")
    for index, found in enumerate(OUTPUTS[name]):
        lines.append(f"        afOut[n + {index}] := {TO_NUMBER[found.type].format(f'{name}.{found.path}')};")
    return "\n".join(lines)


PROGRAM = f"""
PROGRAM Main
VAR
    afIn   : ARRAY [0..{PER_CYCLE * WIDTH - 1}] OF LREAL;
    afOut  : ARRAY [0..{PER_CYCLE * WIDTH - 1}] OF LREAL;
    uIn    : ULINT;
    uOut   : ULINT;
    iBlock : INT;
    iRows  : DINT;
    i, n   : DINT;
{chr(10).join(map(_of_block, BLOCKS))}
END_VAR
uIn := ADR(afIn);
uOut := ADR(afOut);
FOR i := 0 TO iRows - 1 DO
    n := i * {WIDTH};
    CASE iBlock OF
{chr(10).join(_call(number, name) for number, name in enumerate(BLOCKS, 1))}
    END_CASE
END_FOR
END_PROGRAM
"""


class Transformations:
    """The running program."""

    def __init__(self, program: Program) -> None:
        self._program = program
        self._in = _array(int(program.literal("Main.uIn")))
        self._out = _array(int(program.literal("Main.uOut")))

    def __call__(
        self, block: str, given: Mapping[str, Numbers | float | bool], of: Sequence[str]
    ) -> dict[str, Numbers]:
        """What a block gives for each row that it is given, in turn; inputs that are not named are 0."""
        paths = [number.path for number in INPUTS[block]]
        assert {*given} <= {*paths}, {*given} - {*paths}
        columns = np.broadcast_arrays(*(np.asarray(value, dtype=float) for value in given.values()))
        rows = np.zeros((columns[0].size, WIDTH))
        for path, column in zip(given, columns, strict=True):
            rows[:, paths.index(path)] = column.ravel()
        self._program.set("Main", iBlock=[*BLOCKS].index(block) + 1)
        found = []
        for at in range(0, len(rows), PER_CYCLE):
            part = rows[at : at + PER_CYCLE]
            self._in[: len(part)] = part
            self._program.set("Main", iRows=len(part))
            self._program.cycle()
            found.append(self._out[: len(part)].copy())
        results = np.concatenate(found)
        outputs = [number.path for number in OUTPUTS[block]]
        return {path: results[:, outputs.index(path)] for path in of}


def _array(address: int) -> Numbers:
    """The rows of an array of the program, in place."""
    values = (ctypes.c_double * (PER_CYCLE * WIDTH)).from_address(address)
    return np.ctypeslib.as_array(values).reshape(PER_CYCLE, WIDTH)


@contextmanager
def transformations() -> Iterator[Transformations]:
    with run(PROGRAM, 1) as program:
        yield Transformations(program)


def uniform(random: np.random.Generator, low: float, high: float, *names: str) -> Given:
    return {name: random.uniform(low, high, ROWS) for name in names}


def back_from(
    transform: Transformations, forward: str, axes: Mapping[str, Numbers], given: Given, *of: str
) -> dict[str, Numbers]:
    """What the forward block says with the axes at the results of the inverse one."""
    drives = {f"{name}.fSetPosition": value for name, value in axes.items()}
    return transform(forward, {**drives, **given}, of)


def near(found: Numbers, expected: Numbers | float, scale: Numbers | float) -> None:
    assert np.all(np.abs(found - expected) <= RELATIVE * np.asarray(scale))

"""Random assignments of numbers: the compiler, the reference in Python, and C through gcc agree."""

from __future__ import annotations

import ctypes
import shutil
import subprocess
from pathlib import Path
from random import Random
from typing import Any

import compared
import pytest
import typed_tree as tree
import write_c
import write_st
from arithmetic import same
from expressions import Maker
from typed_tree import BOOL, NUMBERS, Name, Program, Scalar, Variable
from typing_rules import assignable

GCC = shutil.which("gcc")
_NUMBERS = {"signed": "c_int", "unsigned": "c_uint", "bits": "c_uint"}


class Numbers(Maker):
    """Without times, whose arithmetic C does not have."""

    def comparison(self, depth: int) -> Any:
        found = super().comparison(depth)
        return found if getattr(found, "computed", BOOL) in NUMBERS else self.leaf(BOOL)


def program(seed: int, count: int) -> Program:
    r = Random(seed)
    maker = Numbers(r, texts=False)
    types: list[Scalar] = [BOOL, *NUMBERS, *r.choices(NUMBERS, k=6)]
    maker.variables = [Variable(f"v{n}", t, maker.literal_value(t)) for n, t in enumerate(types)]
    body = []
    while len(body) < count:
        target = r.choice(maker.variables)
        assert isinstance(target.type, Scalar)
        sources = [t for t in (BOOL, *NUMBERS) if assignable(t, target.type)]
        value = maker.moving(r.choice(sources), 4)
        if not value.constant and not clocks(value):
            body.append(tree.Assign(Name(target.type, target.type, False, target.name), value))
    return Program([], [], [], maker.variables, body, 2)


def clocks(e: Any) -> bool:
    """Whether an expression has a time or TRUNC, which the C text does not know."""
    if isinstance(e, tree.Clock) or getattr(e, "name", "") == "TRUNC" or getattr(e.held, "unit_ns", 0):
        return True
    parts = [getattr(e, n, None) for n in ("left", "right", "operand", "base")] + getattr(e, "args", [])
    return any(clocks(x) for x in parts if isinstance(x, tree.Expr))


def c_kind(type_: Scalar) -> Any:
    if type_.kind == "real":
        return ctypes.c_float if type_.bits == 32 else ctypes.c_double
    return ctypes.c_uint8 if type_ == BOOL else getattr(ctypes, f"{_NUMBERS[type_.kind]}{type_.bits}")


def by_c(p: Program, folder: Path) -> dict[str, Any]:
    source, library = folder / "a.c", folder / "a.so"
    source.write_text(write_c.program(p), encoding="ascii")
    assert GCC is not None
    flags = ["-O2", "-fwrapv", "-ffp-contract=off", "-shared", "-fPIC", "-w"]
    subprocess.run([GCC, *flags, "-o", str(library), str(source), "-lm"], check=True)
    loaded = ctypes.CDLL(str(library))
    for _ in range(p.cycles):
        loaded.cycle()
    values = {v.name: c_kind(v.type).in_dll(loaded, v.name).value for v in p.variables}  # type: ignore[arg-type]
    return {
        f"PLC_PRG.{v.name}": bool(values[v.name]) if v.type == BOOL else values[v.name] for v in p.variables
    }


def check(seed: int, folder: Path) -> None:
    p = program(seed, 40)
    expected, fault = compared.expected(p)
    if not fault:
        found = by_c(p, folder)
        wrong = [
            f"{k}: C {found[k]!r}, reference {v!r}" for k, v in expected.items() if not same(v, found[k])
        ]
        assert wrong == [], f"seed {seed}\n{write_st.program(p)}"
    assert compared.differences(p, 2) == [], f"seed {seed}\n{write_st.program(p)}"


@pytest.mark.skipif(GCC is None, reason="gcc is not installed")
@pytest.mark.parametrize("seed", range(12))
def test_c_agrees(seed: int, tmp_path: Path) -> None:
    check(seed, tmp_path)


@pytest.mark.slow
@pytest.mark.skipif(GCC is None, reason="gcc is not installed")
@pytest.mark.parametrize("seed", range(1000, 1300))
def test_c_agrees_for_long(seed: int, tmp_path: Path) -> None:
    check(seed, tmp_path)

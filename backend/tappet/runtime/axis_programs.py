"""What the build makes for the axes of a task (`project.axes.cyclic_calls`), as it lies in a package.

Contract: the program `SM3_End_<task>` lets the axes go on by a cycle. While its `xStop` is TRUE it takes
`bDriveStart` from its axes, so that they brake by their ramp, and counts in `udiStood` the cycles since all
of them stand. The exported function `SM3_Brake_<task>` is a cycle of the axes alone, with `xStop`: the
runtime calls it behind a fault, instead of the programs.
"""

from __future__ import annotations

from dataclasses import dataclass

from tappet.codegen.package import CodePackage

END = "SM3_End_"
BRAKE = "SM3_Brake_"


@dataclass(frozen=True, slots=True)
class Brake:
    """What brings the axes of a task to standstill behind a fault."""

    symbol: str
    """Of the function."""
    stood: int
    """Place of `udiStood` in the image."""


def ends_of(package: CodePackage) -> list[str]:
    """The programs that let axes go on, in capital letters."""
    return [name for name in package.symbols.roots if name.startswith(END.upper())]


def brake_of(package: CodePackage, task: str) -> Brake | None:
    """None for a task without axes."""
    symbol = f"{BRAKE}{task}"
    if symbol not in package.exports:
        return None
    return Brake(symbol, package.symbols.resolve(f"{END}{task}.udiStood").offset)

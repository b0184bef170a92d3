"""How LLVM compiles a module: plain data, read without loading LLVM."""

from __future__ import annotations

from dataclasses import dataclass

CPU = "x86-64-v2"
"""Oldest processor that packages run on: SSE4.2 and POPCNT, as every x86-64 industrial PC since 2009 has."""

FLAGS = (
    # A frame set up only on some paths would hide the caller of a faulting leaf from the call stack.
    "-enable-shrink-wrap=false",
    # A 32-bit load of a 16-bit variable just stored waits for the store to reach the cache: some 12 cycles.
    "-x86-promote-anyext-load=false",
)
"""Options of the LLVM library."""


@dataclass(frozen=True, slots=True)
class OptimiseOptions:
    """How hard to try."""

    level: int = 2
    """0..3 as in -O."""
    cpu: str = CPU
    triple: str = "x86_64-unknown-linux-gnu"


class LlvmError(RuntimeError):
    """LLVM refused the text the compiler produced: an error of the compiler, not of the program."""

    def __init__(self, message: str, text: str = "") -> None:
        super().__init__(message)
        self.text = text
        """What was refused."""

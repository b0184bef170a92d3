"""Types of the values that the core IR computes."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Scalar:
    """Type of a value. BOOL is one bit as a value and one byte in memory (its bit 0 counts)."""

    name: str
    bits: int
    signed: bool = False
    floating: bool = False
    pointer: bool = False

    @property
    def size(self) -> int:
        """Bytes in memory."""
        return max(self.bits // 8, 1)

    @property
    def integer(self) -> bool:
        """Whether this is an integer type (BOOL is not)."""
        return not self.floating and not self.pointer and self.bits > 1


BOOL = Scalar("bool", 1)
I8, I16, I32, I64 = (Scalar(f"i{n}", n, signed=True) for n in (8, 16, 32, 64))
U8, U16, U32, U64 = (Scalar(f"u{n}", n) for n in (8, 16, 32, 64))
F32 = Scalar("f32", 32, signed=True, floating=True)
F64 = Scalar("f64", 64, signed=True, floating=True)
PTR = Scalar("ptr", 64, pointer=True)
VOID = Scalar("void", 0)

SIGNED = {8: I8, 16: I16, 32: I32, 64: I64}
UNSIGNED = {8: U8, 16: U16, 32: U32, 64: U64}

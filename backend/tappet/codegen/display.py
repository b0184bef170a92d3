"""How the monitor shows a value: the number format that attribute 'displaymode' fixes (LPRG-21)."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, Final, Literal

from tappet.codegen.symbol_map import SymbolMap, VarRef

Mode = Literal["bin", "dec", "hex"]
MODES: Final[dict[str, Mode]] = {
    "bin": "bin", "binary": "bin", "dec": "dec", "decimal": "dec", "hex": "hex", "hexadecimal": "hex",
}  # fmt: skip
"""Values of the attribute."""
FLAG: Final = "DISPLAY_"
"""Begins the flag of a symbol that has a number format of its own, e.g. DISPLAY_HEX."""
_NUMBERS = frozenset({"int", "uint", "bits"})


def own_mode(flags: Iterable[str]) -> Mode | None:
    """The number format that the flags of a symbol fix."""
    for flag in flags:
        if flag.startswith(FLAG):
            return MODES.get(flag.removeprefix(FLAG).lower())
    return None


def display_text(symbols: SymbolMap, ref: VarRef, value: Any, mode: Mode = "dec") -> str:
    """`value` as the monitor shows it; `mode` is the display mode of the Online menu, which the attribute of
    the variable overrides. Numbers to base 2 and 16 have all digits of their type."""
    mode = own_mode(ref.flags) or mode
    if mode == "dec" or ref.type.kind not in _NUMBERS or not isinstance(value, int):
        return symbols.format_literal(ref, value)
    bits = value & ((1 << 8 * ref.type.size) - 1)
    return f"16#{bits:0{2 * ref.type.size}X}" if mode == "hex" else f"2#{bits:0{8 * ref.type.size}b}"

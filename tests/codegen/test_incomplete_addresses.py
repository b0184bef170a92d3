"""Variables `AT %I*`: their places in the symbol map, and that a written input stays (LDEC-58, LDEC-94)."""

from __future__ import annotations

import msgspec
from compiled_programs import build
from linked_application import loaded

from tappet.codegen.symbol_map import SymbolMap

BLOCKS = """
FUNCTION_BLOCK FB_Door
VAR_INPUT closed AT %I* : BOOL; END_VAR
VAR level AT %I* : INT; lamp AT %Q* : BOOL; END_VAR
VAR_OUTPUT sum : INT; END_VAR
lamp := closed;
sum := sum + level;
END_FUNCTION_BLOCK
PROGRAM PLC_PRG
VAR doors : ARRAY[1..2] OF FB_Door; END_VAR
doors[1](); doors[2]();
{more}
END_PROGRAM
"""


def test_places_are_in_the_symbol_map() -> None:
    symbols = build(BLOCKS.replace("{more}", "")).symbols
    assert symbols.mapped == {
        "PLC_PRG.DOORS[1].CLOSED": ("I", 0, None),
        "PLC_PRG.DOORS[1].LEVEL": ("I", 2, None),
        "PLC_PRG.DOORS[1].LAMP": ("Q", 0, None),
        "PLC_PRG.DOORS[2].CLOSED": ("I", 4, None),
        "PLC_PRG.DOORS[2].LEVEL": ("I", 6, None),
        "PLC_PRG.DOORS[2].LAMP": ("Q", 1, None),
    }
    assert msgspec.convert(msgspec.to_builtins(symbols), SymbolMap).mapped == symbols.mapped


def test_an_input_that_is_written_stays_written() -> None:
    with loaded(build(BLOCKS.replace("{more}", ""))) as application:
        application.write("PLC_PRG.doors[2].level", 5)
        application.write("PLC_PRG.doors[2].closed", True)
        for _ in range(3):
            application.cycle()
        paths = ("PLC_PRG.doors[2].level", "%IW3", "PLC_PRG.doors[2].sum", "%QX0.8", "PLC_PRG.doors[1].sum")
        assert [application.literal(p) for p in paths] == ["5", "5", "15", "TRUE", "0"]


def test_free_places_stay_clear_of_addresses_in_the_code() -> None:
    first = build(BLOCKS.replace("{more}", ""))
    again = build(BLOCKS.replace("{more}", "IF %IX9.0 THEN %QB3 := 1; END_IF"), first)
    assert again.symbols.mapped["PLC_PRG.DOORS[1].CLOSED"] == ("I", 19, None)
    assert again.symbols.mapped["PLC_PRG.DOORS[1].LAMP"] == ("Q", 4, None)

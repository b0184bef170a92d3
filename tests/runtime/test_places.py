"""From bytes back to variables: every variable of a program is found at its own place."""

from plc_programs import build

from tappet.codegen.symbol_map import SymbolMap
from tappet.runtime.places import Place, find_again, path_at

TEXT = """
TYPE POINT : STRUCT x : REAL; y : REAL; label : STRING(5); END_STRUCT END_TYPE
FUNCTION_BLOCK FB
VAR q : BOOL; points : ARRAY [1..3, 0..1] OF POINT; END_VAR
END_FUNCTION_BLOCK
PROGRAM PLC_PRG
VAR
    a : BOOL; b : INT; fb : FB; grid : ARRAY [-1..1] OF FB; w : WORD;
    out AT %QW4 : WORD; flag AT %MX3.5 : BOOL;
END_VAR
fb();
END_PROGRAM
"""
MOVED = TEXT.replace("a : BOOL;", "first : ARRAY [0..9] OF LREAL; a : BOOL;").replace("b : INT", "b : DINT")


def leaves(symbols: SymbolMap, path: str = "") -> list[str]:
    found = []
    for child in symbols.children(path):
        found += [child.path] if child.leaf else leaves(symbols, child.path)
    return found


def test_every_variable_is_found_at_its_place() -> None:
    symbols = build(TEXT).symbols
    paths = leaves(symbols, "PLC_PRG")
    assert "PLC_PRG.grid[1].points[3, 1].label" in paths
    for path in paths:
        ref = symbols.resolve(path)
        found = path_at(symbols, Place(ref.offset, ref.size, ref.bit))
        assert found is not None
        again = symbols.resolve(found)
        assert (again.offset, again.size, again.bit) == (ref.offset, ref.size, ref.bit)


def test_bits_and_addresses() -> None:
    symbols = build(TEXT).symbols
    for path in ("PLC_PRG.w.0", "PLC_PRG.w.13", "%IX2.9", "%QB3", "%MD4"):
        ref = symbols.resolve(path)
        assert path_at(symbols, Place(ref.offset, ref.size, ref.bit)) == path


def test_a_variable_at_an_address_goes_by_its_name() -> None:
    symbols = build(TEXT).symbols
    for address, path in (("%QW4", "PLC_PRG.out"), ("%MX3.5", "PLC_PRG.flag"), ("%QB8", "%QB8")):
        ref = symbols.resolve(address)
        assert path_at(symbols, Place(ref.offset, ref.size, ref.bit)) == path


def test_variables_are_found_again_after_a_change() -> None:
    old, new = build(TEXT).symbols, build(MOVED).symbols
    for path in ("PLC_PRG.a", "PLC_PRG.fb.points[2, 1].y", "PLC_PRG.w.3", "%QW4"):
        before, after = old.resolve(path), new.resolve(path)
        place = find_again(old, new, Place(before.offset, before.size, before.bit))
        assert place == Place(after.offset, after.size, after.bit)
    changed = old.resolve("PLC_PRG.b")
    assert find_again(old, new, Place(changed.offset, changed.size)) is None


def test_part_of_a_variable_moves_with_it() -> None:
    old, new = build(TEXT).symbols, build(MOVED).symbols
    before, after = old.resolve("PLC_PRG.w"), new.resolve("PLC_PRG.w")
    assert find_again(old, new, Place(before.offset + 1, 1)) == Place(after.offset + 1, 1)

"""Variables of all classes, places, types; what each command leaves of them: language_declarations 5.1."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import product

from plc_programs import MAIN, build

from tappet.codegen.package import CodePackage

COMMANDS = (
    "warm", "cold", "origin", "download", "online change", "stop and run", "reboot", "kill",
)  # fmt: skip
KEPT = {
    # class of variable: commands that it outlives; 'reboot' and 'kill' are an end of the process with and
    # without notice. After a reset origin the application is downloaded again, because it was removed.
    "VAR": {"online change", "stop and run"},
    "no_init": {"warm", "cold", "online change", "stop and run"},
    "RETAIN": {"warm", "online change", "stop and run", "reboot", "kill"},
    "no_init RETAIN": {"warm", "cold", "online change", "stop and run", "reboot", "kill"},
    "PERSISTENT": set(COMMANDS) - {"origin"},
    "PERSISTENT RETAIN": set(COMMANDS) - {"origin"},
    "RETAIN PERSISTENT": set(COMMANDS) - {"origin"},
}
"""The table of the specification; PERSISTENT is PERSISTENT RETAIN (note a), no_init is note d."""


@dataclass(frozen=True, slots=True)
class TypeCase:
    """A type, a leaf of its variables, and the value of that leaf at first and when it has been written."""

    declared: str
    leaf: str
    initial: object
    written: object


TYPES = {
    "bit": TypeCase("BOOL", "", False, True),
    "int": TypeCase("INT := 5", "", 5, -77),
    "real": TypeCase("LREAL := 0.5", "", 0.5, 1.25e-3),
    "text": TypeCase("STRING(20) := 'first'", "", "first", "written"),
    "wide": TypeCase('WSTRING(10) := "eins"', "", "eins", "zwölf"),
    "time": TypeCase("TIME := T#3ms", "", 3, 7),
    "list": TypeCase("ARRAY[-1..2] OF INT := [1, 2, 3, 4]", "[1]", 3, 99),
    "table": TypeCase("ARRAY[0..1, 0..1] OF Item", "[1,0].b", "b", "changed"),
    "item": TypeCase("Item := (a := 9)", ".a", 9, 1000),
    "block": TypeCase("Inner", ".n", 4, 44),
}
TYPES_TEXT = """
TYPE Item : STRUCT a : DINT := 2; b : STRING(8) := 'b'; END_STRUCT END_TYPE
FUNCTION_BLOCK Inner
VAR_INPUT i : INT; END_VAR
VAR n : INT := 4; END_VAR
END_FUNCTION_BLOCK
"""


@dataclass(frozen=True, slots=True)
class Cell:
    """One variable of the table."""

    path: str
    kind: str
    case: TypeCase


def _section(scope: str, kind: str) -> str:
    """Variables of every type in one section."""
    words = kind.removeprefix("no_init").replace("VAR", "").strip()
    attribute = "{attribute 'no_init'}\n" if kind.startswith("no_init") else ""
    lines = [f"{attribute}{_prefix(kind)}_{name} : {case.declared};" for name, case in TYPES.items()]
    return "\n".join([f"{scope} {words}", *lines, "END_VAR"])


def _prefix(kind: str) -> str:
    return kind.replace(" ", "_").lower().replace("var", "plain")


def _cells(place: str, kinds: tuple[str, ...]) -> list[Cell]:
    return [
        Cell(f"{place}.{_prefix(kind)}_{name}{case.leaf}", kind, case)
        for kind, (name, case) in product(kinds, TYPES.items())
    ]


OUTSIDE = tuple(kind for kind in KEPT if "PERSISTENT" not in kind)
LISTED = tuple(kind for kind in KEPT if "PERSISTENT" in kind)
EVERYWHERE = tuple(KEPT)

CELLS = [
    *_cells("PLC_PRG", EVERYWHERE),
    *_cells("PLC_PRG.fb", EVERYWHERE),
    *_cells("PLC_PRG.fbs[2]", EVERYWHERE),
    *_cells("PLC_PRG.fb.deeper", EVERYWHERE),
    *_cells("Globals", OUTSIDE),
    *_cells("Lasting", LISTED),
    # an instance that is remanent as a whole: its members are, however they are declared
    Cell("PLC_PRG.whole.n", "RETAIN", TYPES["block"]),
    Cell("Lasting.whole.n", "PERSISTENT", TYPES["block"]),
    Cell("Lasting.wholes[1].n", "PERSISTENT", TYPES["block"]),
    Cell("PLC_PRG.given", "RETAIN", TypeCase("", "", 6, 66)),
    Cell("PLC_PRG.handed", "RETAIN", TypeCase("", "", 7, 77)),
    Cell("PLC_PRG.fb.count", "VAR", TypeCase("", "", 8, 88)),
]


def package(*, added: int = 0, previous: CodePackage | None = None) -> CodePackage:
    """The application; `added` variables stand before the others, so that all of them lie elsewhere."""
    sections = "\n".join(_section("VAR", kind) for kind in EVERYWHERE)
    before = "".join(f"added{i} : LINT;" for i in range(added))
    text = f"""{TYPES_TEXT}
FUNCTION_BLOCK Holder
VAR_STAT count : INT := 8; END_VAR
VAR deeper : Deeper; {before} END_VAR
{sections}
deeper();
END_FUNCTION_BLOCK
FUNCTION_BLOCK Deeper
{sections}
END_FUNCTION_BLOCK
PROGRAM PLC_PRG
VAR_INPUT RETAIN given : INT := 6; END_VAR
VAR_OUTPUT RETAIN handed : INT := 7; END_VAR
VAR {before} fb : Holder; fbs : ARRAY[1..2] OF Holder; cycles : DINT; END_VAR
VAR RETAIN whole : Inner; END_VAR
{sections}
fb(); fbs[1](); fbs[2]();
cycles := cycles + 1;
END_PROGRAM
"""
    lists = {
        "Globals": "\n".join(
            [f"VAR_GLOBAL {before} END_VAR", *(_section("VAR_GLOBAL", kind) for kind in OUTSIDE)]
        ),
        "Lasting": "\n".join(
            [
                f"VAR_GLOBAL PERSISTENT {before} whole : Inner; wholes : ARRAY[0..1] OF Inner; END_VAR",
                *(_section("VAR_GLOBAL", kind) for kind in LISTED),
            ]
        ),
    }
    return build(text, MAIN, gvls=lists, previous=previous)

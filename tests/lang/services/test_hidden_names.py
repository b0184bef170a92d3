"""Names with the attribute hide are not proposed and not shown online (LPRG-24, LPRG-25, LDEC-144)."""

from __future__ import annotations

import pytest
from marked_texts import Project

from tappet.codegen.build import build_application
from tappet.lang.services.completion import complete
from tappet.lang.source import Source

OBJECTS = {
    "POU": """FUNCTION_BLOCK myPOU
        VAR_INPUT
            a : INT;
            {attribute 'hide'}
            a_invisible : BOOL;
            a_visible : BOOL;
        END_VAR
        VAR_OUTPUT b : INT; END_VAR
        VAR own : INT; END_VAR
        END_FUNCTION_BLOCK""",
    "LOCALS": """{attribute 'hide_all_locals'}
        FUNCTION_BLOCK Quiet
        VAR_INPUT a : INT; END_VAR
        VAR_OUTPUT b : BOOL; END_VAR
        VAR c, d : INT; END_VAR
        END_FUNCTION_BLOCK""",
    "SECRET": "{attribute 'hide'}\nFUNCTION Secret : INT VAR_INPUT x : INT; END_VAR END_FUNCTION",
    "NEXT": "FUNCTION Listed : INT VAR_INPUT x : INT; END_VAR Listed := x; END_FUNCTION",
    "Globals": "VAR_GLOBAL\n{attribute 'hide'}\n g_hidden : INT;\n g_shown : INT;\nEND_VAR",
}
VARIABLES = "VAR POU1 : myPOU; quiet : Quiet;\n{attribute 'hide'}\n mine : INT;\n shown : INT; END_VAR"


def labels(code: str) -> list[str]:
    project = Project(PLC_PRG=f"PROGRAM PLC_PRG\n{VARIABLES}\n{code}\nEND_PROGRAM", **OBJECTS)
    return [item.label for item in complete(project.workspace, project.document, project.position)]


@pytest.mark.parametrize(
    ("code", "expected"),
    [
        (
            "POU1.|",
            ["a", "a_visible", "b"],
        ),  # language_pragmas EX-03: only the variable behind the pragma is left out
        ("shown := POU1.|", ["a", "a_visible", "b", "own"]),
        ("quiet.|", ["a", "b"]),
        ("shown := quiet.|", ["a", "b"]),
        ("Globals.|", ["g_shown"]),
    ],
)
def test_components_of_a_list(code: str, expected: list[str]) -> None:
    assert sorted(labels(code)) == expected


def test_names_in_scope() -> None:
    found = set(labels("|"))
    assert {"shown", "g_shown", "Listed"} <= found
    assert not {"mine", "g_hidden", "Secret"} & found


def test_a_hidden_name_may_be_used() -> None:
    """Hiding is for the editors: code that names it compiles, its value is there online, out of the lists."""
    code = "mine := 2; g_hidden := Secret(mine); POU1(a_invisible := TRUE);"
    texts = {**OBJECTS, "PLC_PRG": f"PROGRAM PLC_PRG\n{VARIABLES}\n{code}\nEND_PROGRAM"}
    result = build_application([Source(name, text, name=name) for name, text in texts.items()])
    assert [str(d) for d in result.diagnostics if d.severity == "error"] == []
    assert result.package is not None
    symbols = result.package.symbols
    assert symbols.resolve("PLC_PRG.POU1.a_invisible").size == 1
    shown = {
        path: [c.name for c in symbols.children(path)] for path in ("PLC_PRG", "PLC_PRG.POU1", "Globals")
    }
    assert shown == {
        "PLC_PRG": ["POU1", "quiet", "shown"],
        "PLC_PRG.POU1": ["a", "a_visible", "b", "own"],
        "Globals": ["g_shown"],
    }
    assert [c.name for c in symbols.children("PLC_PRG.quiet")] == ["a", "b"]

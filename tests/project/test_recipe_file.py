"""Recipe files as text: what is written, what is read, and what is refused at which line."""

from __future__ import annotations

from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tappet.project.recipes.definition import RecipeDefinitionData, RecipeManagerData
from tappet.project.recipes.literals import form_of
from tappet.project.recipes.recipe_file import RecipeFileError, read_recipe, write_recipe

CODESYS = """PLC_PRG.bFan:=TRUE
PLC_PRG.iLevel:=12
PLC_PRG.strName:='it$'s := here'
PLC_PRG.tBake:=T#1m30s
PLC_PRG.lrFactor:=0.10000000000000001
"""
"""As CODESYS writes it with the columns variable and current value."""
PATHS = ("PLC_PRG.bFan", "PLC_PRG.iLevel", "PLC_PRG.strName", "PLC_PRG.tBake", "PLC_PRG.lrFactor")
DEFINITION = RecipeDefinitionData.model_validate({"variables": [{"path": path} for path in PATHS]})
VALUES = dict(zip(PATHS, ("TRUE", "12", "'it$'s := here'", "T#1m30s", "0.10000000000000001"), strict=True))


def manager(**data: Any) -> RecipeManagerData:
    return RecipeManagerData.model_validate(data)


def test_a_file_of_codesys_is_read_and_written() -> None:
    found = read_recipe(manager(), DEFINITION, CODESYS)
    assert (found.values, found.unknown, found.missing) == (VALUES, [], [])
    assert write_recipe(manager(), DEFINITION, VALUES) == CODESYS.replace("\n", "\r\n")


def test_what_else_a_file_may_have() -> None:
    text = "\ufeff\n plc_prg.ILEVEL := 5 \n\nPLC_PRG.gone:=1\n"
    found = read_recipe(manager(), DEFINITION, text)
    assert found.values == {"PLC_PRG.iLevel": "5"}
    assert found.unknown == ["PLC_PRG.gone"]
    assert found.missing == [path for path in PATHS if path != "PLC_PRG.iLevel"]


@pytest.mark.parametrize(
    ("text", "line", "message"),
    [
        ("PLC_PRG.iLevel=5", 1, "there are 1 of 2 columns; they are separated by ':='"),
        ("\nPLC_PRG.iLevel:=5;", 2, "'5;' is no value for PLC_PRG.iLevel; write an IEC literal"),
        ("PLC_PRG.iLevel:=", 1, "'' is no value for PLC_PRG.iLevel; write an IEC literal"),
        ("PLC_PRG.strName:='a", 1, "''a' is no value for PLC_PRG.strName; write an IEC literal"),
        ("PLC_PRG.iLevel:=5\nplc_prg.iLevel:=6", 2, "plc_prg.iLevel is there twice; keep one line"),
    ],
)
def test_a_wrong_line_is_named(text: str, line: int, message: str) -> None:
    with pytest.raises(RecipeFileError) as error:
        read_recipe(manager(), DEFINITION, text)
    assert (error.value.line, str(error.value)) == (line, message)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (CODESYS + "A.b:=1", "A.b is not in the definition, and the recipe manager wants an exact match"),
        (
            CODESYS.partition("\n")[2],
            "PLC_PRG.bFan is not in the file, and the recipe manager wants an exact match",
        ),
    ],
)
def test_an_exact_match(text: str, message: str) -> None:
    with pytest.raises(RecipeFileError, match=message):
        read_recipe(manager(exact_match=True), DEFINITION, text)


@given(
    columns=st.permutations(["variable", "type", "name", "minimum", "maximum", "comment", "value"]),
    kept=st.integers(0, 5),
    separator=st.sampled_from([":=", ";", ",", "\t", "|"]),
    text=st.text(
        st.characters(codec="latin-1", exclude_characters="'$", categories=("L", "N", "P", "S")), max_size=9
    ),
)
def test_what_is_written_is_read_again(columns: list[str], kept: int, separator: str, text: str) -> None:
    wanted = [c for c in columns if c in ("variable", "value") or columns.index(c) < kept]
    values = {**VALUES, "PLC_PRG.strName": f"'{text}'"}
    settings = manager(columns=wanted, separator=separator)
    written = write_recipe(settings, DEFINITION, values, {"PLC_PRG.iLevel": "INT"})
    assert read_recipe(settings, DEFINITION, written).values == values


@pytest.mark.parametrize(
    ("text", "form"),
    [
        *[
            (text, "literal")
            for text in (
                "5", "-5", "+7", "16#F0", "2#1010_0001", "INT#5", "INT#-5", "REAL#1.5", "1.5E-3", "1e300",
                ".5"[1:],
                "TRUE", "false", "T#1h2m3s", "TIME#-5s", "LTIME#3us", "D#2026-1-1", "DT#2026-1-1-12:00:00.5",
                "TOD#1:2:3", "'a'", "''", "'$''", '"wide"', '"$00FC"', "STRING#"[:0] + "0",
            )
        ],
        *[(text, "name") for text in ("E_Mode.Auto", "E_Mode#Auto", "cLimit", "GVL.cLimit")],
        *[
            (text, "wrong")
            for text in ("", "5;", "5 + 5", "x := 1", "'a'b'", "'", "'a$'", "{error}", "a..b", "(* *)",
                "1'", "f(1)")
        ],
    ],
)  # fmt: skip
def test_forms_of_values(text: str, form: str) -> None:
    assert form_of(text) == form

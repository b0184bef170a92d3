"""Texts of errors in both languages."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from tests.libraries.st_program import Program, run

from tappet.libraries import load
from tappet.libraries.catalog import items

ERRORS = {
    value.name: int(value.value)
    for item in items(load("SM3_Basic"))
    if item.name == "SMC_ERROR"
    for value in item.values
}
PROGRAM = """
PROGRAM Main
VAR
    eError   : SM3_Basic.SMC_ERROR;
    sEnglish : STRING(200);
    sGerman  : STRING(200);
END_VAR
sEnglish := SM3_Basic.SMC_ErrorString(eError);
sGerman := SM3_Basic.SMC_ErrorString(ErrorID := eError, Language := SM3_Basic.SMC_LANGUAGE_TYPE.deutsch);
END_PROGRAM
"""


@pytest.fixture(scope="module")
def program() -> Iterator[Program]:
    with run(PROGRAM, 0) as running:
        yield running


def texts(program: Program, number: int) -> tuple[str, str]:
    program.set("Main", eError=number)
    program.cycle()
    return program.literal("Main.sEnglish").strip("'"), program.literal("Main.sGerman").strip("'")


def test_every_error_has_a_text_of_its_own_in_both_languages(program: Program) -> None:
    """motion_semantics ERR-02; a text of less than 100 characters cannot have been cut."""
    found = {name: texts(program, number) for name, number in ERRORS.items()}
    for english, german in found.values():
        assert 0 < len(english) < 100
        assert 0 < len(german) < 100
        assert "nknown error " not in english
        assert english != german
    for language in (0, 1):
        assert len({both[language] for both in found.values()}) == len(found)


def test_texts_say_what_the_error_is(program: Program) -> None:
    assert texts(program, 625) == ("No cam is selected", "Keine Kurvenscheibe ausgewählt")
    assert texts(program, 0) == ("No error", "Kein Fehler")


@pytest.mark.parametrize("number", [4, 7777, -1, 32767])
def test_a_number_without_a_text_is_told(program: Program, number: int) -> None:
    assert texts(program, number) == (f"Unknown error {number}", f"Unbekannter Fehler {number}")

"""Languages of bodies as plain data: how a stored body is written, and that one place alone lists them."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from tappet.iec.languages import Form, Language, file_ending, language_of, languages, offered

ROOT = Path(__file__).resolve().parents[2] / "backend" / "tappet"
OWN = ("iec/languages/", "lang/languages/")
WORDS_OF_OTHERS = {
    "lang/rules/reserved_name.py",  # operators of IL
    "project/exchange/codesys23.py",  # how its exports mark drawn bodies
    "project/exchange/codesys_native.py",  # numbers of the editors of CODESYS
    "project/exchange/twincat.py",  # what TwinCAT calls its languages
}


def test_one_place_lists_languages() -> None:
    named = re.compile(rf"[\"']({'|'.join(name for name in languages())})[\"']")
    found = {
        path.relative_to(ROOT).as_posix()
        for path in ROOT.rglob("*.py")
        for line in path.read_text(encoding="utf-8").splitlines()
        if len({match[1] for match in named.finditer(line)}) > 1
    }
    assert {name for name in found if not name.startswith(OWN)} <= WORDS_OF_OTHERS


def test_languages_are_in_the_order_of_lists() -> None:
    assert list(languages()) == ["ST", "IL", "LD", "FBD", "CFC", "SFC"]
    assert offered() == ("ST", "IL")


@pytest.mark.parametrize(
    ("language", "body", "form"),
    [
        ("ST", "a := 1;", "text"),
        ("ST", "<no xml", "text"),
        ("IL", "LD a", "text"),
        ("SFC", "INITIAL_STEP Init: END_STEP", "text"),
        ("SFC", "<SFC/>", "kept"),
        ("FBD", "<FBD/>", "kept"),
        ("FBD", "", "text"),
        ("PLUGGED", "{}", "kept"),
        ("PLUGGED", "", "text"),
    ],
)
def test_form_of_a_stored_body(language: str, body: str, form: Form) -> None:
    assert language_of(language).form_of(body) == form


def test_a_drawn_language_has_a_file_of_its_own() -> None:
    both = Language("BOTH", "Text or drawn", "m:READER", extension="both", begins="STEP")
    drawn = Language("DRAWN", "Drawn", "m:READER", extension="drawn", text=False)
    assert [both.form_of(body) for body in ("{}", "STEP s", "<x/>", "")] == ["drawn", "text", "kept", "text"]
    assert [drawn.form_of(body) for body in ("{}", "no JSON", "<x/>", "")] == [
        "drawn",
        "drawn",
        "kept",
        "drawn",
    ]
    assert file_ending("ST", "a := 1;") is None
    assert file_ending("FBD", "<FBD/>") is None
    assert file_ending("PLUGGED", "{}") == "plugged"


@pytest.mark.parametrize(
    "fields",
    [
        {"name": "Low", "reader": "m:R"},
        {"extension": "st", "reader": "m:R"},
        {"extension": "x"},
        {"extension": "A"},
    ],
)
def test_what_cannot_be_a_language_is_refused(fields: dict[str, str]) -> None:
    with pytest.raises(ValueError, match=r"language|name"):
        Language(**{"name": "NEW", "title": "New", **fields})

"""What the editors in the browser have of the words and the scanner is what is here."""

import json
from pathlib import Path

from iec_texts import CORPUS, corpus

from tappet.iec import textmate
from tappet.iec.typescript import FILE, javascript, module
from tappet.iec.words import OPERATOR_FUNCTIONS
from tappet.lang.services.operators import OPERATOR_HEADS

ROOT = Path(__file__).parents[2]


def test_the_module_is_up_to_date() -> None:
    assert (ROOT / FILE).read_text(encoding="utf-8") == module(), "run 'make generate'"


def test_the_grammar_of_other_editors_is_up_to_date() -> None:
    assert json.loads((ROOT / textmate.FILE).read_text(encoding="utf-8")) == textmate.grammar(), (
        "run 'make generate'"
    )


def test_the_texts_are_up_to_date() -> None:
    assert CORPUS.read_text(encoding="utf-8") == corpus(), "run 'make generate'"


def test_expressions_are_translated() -> None:
    assert javascript(r"[^\W\d]\w*+\#") == r"[\p{L}\p{Nl}\p{No}_][\p{L}\p{N}_]*#"
    assert javascript(r"(?i:ab(?:c))d++/[+-]?+") == r"(?:[Aa][Bb](?:[Cc]))d+\/[+-]?"


def test_operators_in_the_form_of_functions_are_known() -> None:
    assert set(OPERATOR_FUNCTIONS) <= set(OPERATOR_HEADS)

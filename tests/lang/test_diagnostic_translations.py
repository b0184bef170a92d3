"""Messages in Chinese: whole, with the advice of their places and the names of kinds."""

from __future__ import annotations

import ast
import csv
import re
from functools import cache
from importlib.resources import files
from pathlib import Path

import pytest
from sample_stage import diagnose

import tappet.lang
from tappet import libraries
from tappet.iec.words import KEYWORDS
from tappet.lang.diagnostic_translations import Texts, phrase, said, texts
from tappet.lang.diagnostics import TABLE, Diagnostic
from tappet.lang.sample_texts import samples
from tappet.lang.types import ELEMENTARY

KINDS = ("what", "verb", "needed", "given", "count", "expected", "where", "size", "place")
UNITS = ("ns", "ms", "IX", "Sample", "McCabe", "TO", "STRING", "WSTRING")
OPERATORS = ("hasattribute", "hastype", "hasvalue", "RETC")
"""Words of conditions and of IL that are no keywords elsewhere."""
ST = ("head", "parameters", "known", "events")
"""Facts that are written in ST, or are names."""
ROWS = list(
    csv.DictReader(files("tappet.lang").joinpath("phrases_zh.csv").read_text(encoding="utf-8").splitlines())
)


def words(text: str) -> set[str]:
    """The words of a text in capitals; those between underscores are words, too."""
    return {word.upper() for word in re.findall(r"[A-Za-z]{2,}", text)}


@cache
def everywhere() -> set[str]:
    """Words that mean the same in every language: keywords, types, libraries, units."""
    found = words(" ".join([*KEYWORDS, *ELEMENTARY, *libraries.names(), *UNITS, *OPERATORS]))
    rows = [words(row["chinese"]) for row in ROWS if not re.fullmatch(r"[a-z ]+", row["english"])]
    return found.union(*rows)


def left_in_english(d: Diagnostic, source: str) -> set[str]:
    shown = said(d.code, Texts(d.message, d.advice), d.facts, "zh")
    names = [
        value for name, value in d.facts.items() if name not in KINDS and (" " not in value or name in ST)
    ]
    known = everywhere() | words(source) | words(" ".join(names)) | words(" ".join(texts(d.code, "zh")))
    related = [phrase(item.message, "zh") for item in d.related]
    quoted = re.compile("“[^” ]*”")  # what stands in a text or in a library
    return words(quoted.sub(" ", " ".join([*shown, *related]))) - known


@pytest.mark.parametrize("code", sorted(samples()))
def test_no_english_word_is_left_in_a_chinese_message(code: str) -> None:
    for sample in samples()[code]:
        if not sample.passes:
            for diagnostic in diagnose(sample.text):
                assert left_in_english(diagnostic, sample.text) == set(), diagnostic


def test_every_advice_of_a_place_is_in_the_table() -> None:
    """As far as it is written as a whole where it is given."""
    known = {row["english"] for row in ROWS}
    missing = set()
    for path in Path(tappet.lang.__file__).parent.rglob("*.py"):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.keyword) and node.arg == "hint" and isinstance(node.value, ast.Constant):
                missing |= {str(node.value.value)} - known - {""}
    assert {text for text in missing if phrase(text, "zh") == text} == set()


@pytest.mark.parametrize("row", ROWS, ids=lambda row: row["english"])
def test_phrases_keep_their_fields_and_are_found(row: dict[str, str]) -> None:
    field = re.compile(r"\{[a-d]\}")
    assert sorted(set(field.findall(row["english"]))) == sorted(set(field.findall(row["chinese"])))
    example = row["english"]
    for name, text in zip("abcd", ("Q1", "Q2", "Q3", "Q4"), strict=True):
        example = example.replace(f"{{{name}}}", text)
    assert phrase(example, "en") == example
    assert all(text in phrase(example, "zh") for text in re.findall(r"Q\d", example))


def test_phrases_inside_phrases() -> None:
    assert phrase("Did you mean 'TON' (function block)?", "zh") == "是否指“TON”（功能块）？"
    assert phrase("'n' is a variable of type 'INT'.", "zh") == "“n”是“INT”类型的变量。"
    assert phrase("nobody has said this", "zh") == "nobody has said this"


def test_a_name_of_the_program_stays_as_it_is() -> None:
    """A variable may be called like a kind."""
    (found,) = [d for d in diagnose("VAR member, n : INT; END_VAR\nn := 1;") if d.code == "W1103"]
    assert "member" in said(found.code, Texts(found.message, found.advice), found.facts, "zh").message


@pytest.mark.parametrize(
    ("text", "message"),
    [("n := ;", "“;”之前应为表达式"), ("n := (1;", "“;”之前应为“)”"), ("IF n = 1 THEN", "END_IF")],
)
def test_tokens_are_quoted_as_chinese_quotes(text: str, message: str) -> None:
    found = [d for d in diagnose(f"VAR n : INT; END_VAR\n{text}") if d.severity == "error"]
    shown = [said(d.code, Texts(d.message, d.advice), d.facts, "zh").message for d in found]
    assert message in shown[0]
    assert not any("'" in one for one in shown)


def test_a_union_without_members_is_called_one() -> None:
    (found,) = [d for d in diagnose("TYPE U : UNION END_UNION END_TYPE") if d.code == "W1219"]
    assert found.message == "The union 'U' has no members"
    assert (
        said(found.code, Texts(found.message, found.advice), found.facts, "zh").message == "联合体“U”没有成员"
    )


def test_what_is_wrong_with_a_cam_is_said_in_chinese() -> None:
    """Its whole text stands in a pragma, and has words of its own."""
    text = "Cam: The velocity jumps from 1 to -0.5 at X = 10"
    found = said("W1225", Texts(text, TABLE["W1225"].advice), {"text": text}, "zh")
    assert found.message == "Cam：速度在 X = 10 处从 1 跳变到 -0.5"

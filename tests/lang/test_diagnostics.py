"""The one table of messages: complete, used, and shown in the manual."""

from __future__ import annotations

import re
from pathlib import Path
from string import Formatter

import pytest

from tappet.lang import diagnostic_pages
from tappet.lang.diagnostic_translations import Texts, said, texts, translated_codes
from tappet.lang.diagnostics import TABLE, Related, report
from tappet.lang.rules import all_rules
from tappet.lang.source import Span
from tappet.translation.language import language_of

ROOT = Path(__file__).resolve().parents[2]
PACKAGE = ROOT / "backend" / "tappet"


def _used_codes() -> set[str]:
    text = "".join(path.read_text(encoding="utf-8") for path in PACKAGE.rglob("*.py"))
    return set(re.findall(r'"([EWS]\d{4})"', text))


def test_every_code_is_used_and_every_used_code_is_in_the_table() -> None:
    used = _used_codes()
    assert set(TABLE) - used == set()
    assert {code for code in used if code[1] in "01"} - set(TABLE) == set()


@pytest.mark.parametrize("entry", TABLE.values(), ids=lambda entry: entry.code)
def test_entry_is_well_formed(entry: object) -> None:
    assert re.fullmatch(r"[EWS]\d{4}", entry.code)
    assert re.fullmatch(r"[a-z0-9_]+", entry.name)
    assert (entry.severity == "error") == (entry.code[0] == "E")
    assert all(re.fullmatch(r"C\d{4}|SA\d{4}", alias) for alias in entry.aliases)
    assert entry.message
    assert not entry.message.endswith(".")
    assert entry.advice.endswith((".", "}"))
    assert "{hint}" not in entry.advice
    for template in (entry.message, entry.advice):
        assert all(name is None or name.isidentifier() for _, name, _, _ in Formatter().parse(template))


@pytest.mark.parametrize("code", sorted(translated_codes("zh")))
def test_a_translation_says_the_same(code: str) -> None:
    """With the same fields: what a template does not name is lost for its reader."""
    entry = TABLE[code]
    chinese = texts(code, "zh")
    for english, translated in ((entry.message, chinese.message), (entry.advice, chinese.advice)):
        assert translated.strip()
        assert _fields(english) == _fields(translated)
        assert english.count("{{") == translated.count("{{")


def _fields(template: str) -> set[str]:
    return {name for _, name, _, _ in Formatter().parse(template) if name is not None}


def test_messages_are_described_in_chinese() -> None:
    """Every coding rule is; a message that has just come in is shown in English until it has its words."""
    assert {code for code in TABLE if code[0] == "S"} <= translated_codes("zh") <= set(TABLE)
    assert len(translated_codes("zh")) > 0.95 * len(TABLE)


def test_a_message_is_said_in_another_language() -> None:
    span = Span(0, 0, 0, 1)
    made = report("E0301", "PLC_PRG", span, source="INT", target="BYTE")
    english = Texts(made.message, made.advice)
    assert said(made.code, english, made.facts, "en") is english
    assert said(made.code, english, made.facts, "zh").message == "不能将类型“INT”转换为类型“BYTE”"
    hinted = report("E0201", "PLC_PRG", span, name="Spd", hint="Did you mean 'Speed'?")
    shown = said(hinted.code, Texts(hinted.message, hinted.advice), hinted.facts, "zh")
    assert shown == ("标识符“Spd”未定义", "是否指“Speed”？")
    assert [language_of(tag) for tag in ("zh-CN", "zh", "en-US", "de", None)] == [
        "zh",
        "zh",
        "en",
        "en",
        "en",
    ]


def test_names_are_unique() -> None:
    names = [entry.name for entry in TABLE.values()]
    assert len(names) == len(set(names))


def test_report_fills_the_templates() -> None:
    made = report(
        "E0301",
        "PLC_PRG",
        Span(11, 8, 11, 9),
        [Related("declared here", "GVL", Span(0, 0, 0, 1))],
        source="INT",
        target="BYTE",
        hint="Use INT_TO_BYTE(...).",
    )
    assert str(made) == (
        "PLC_PRG:12:9: error E0301: Cannot convert type 'INT' to type 'BYTE'. Use INT_TO_BYTE(...)."
    )
    assert (made.alias, made.name, made.related[0].uri) == ("C0032", "cannot_convert", "GVL")


def test_a_hint_takes_the_place_of_the_advice() -> None:
    place = ("P", Span(0, 0, 0, 1))
    assert report("E0201", *place, name="x", hint="Did you mean 'y'?").advice == "Did you mean 'y'?"
    for hint in ({}, {"hint": ""}):
        assert report("E0201", *place, name="x", **hint).advice == TABLE["E0201"].advice != ""


def test_report_with_a_missing_field_is_a_fault_of_the_caller() -> None:
    with pytest.raises(KeyError):
        report("E0301", "PLC_PRG", Span(0, 0, 0, 0), source="INT")


def test_text_of_the_user_is_never_a_template() -> None:
    made = report("E0201", "P", Span(0, 0, 0, 1), name="{0.__class__}", hint="{x}")
    assert made.message == "Identifier '{0.__class__}' not defined"
    assert made.advice == "{x}"


def test_codes_of_rules_are_in_the_table() -> None:
    assert {code for rule in all_rules() for code in rule.CODES} <= set(TABLE)


def test_manual_pages_are_current() -> None:
    directory = ROOT / "docs" / "diagnostics"
    stored = {path.name: path.read_text(encoding="utf-8") for path in directory.glob("*.md")}
    assert stored == diagnostic_pages.pages(), "run: python -m tappet.lang.diagnostic_pages"


def test_writing_pages_removes_those_of_unknown_codes(tmp_path: Path) -> None:
    (tmp_path / "E9999.md").write_text("old")
    diagnostic_pages.write(tmp_path)
    assert not (tmp_path / "E9999.md").exists()
    assert (tmp_path / "W1104.md").read_text().startswith("# W1104: case covers enum")

"""Chinese texts use the words of docs/vocabulary.md."""

import csv
import json
import re
from collections.abc import Iterator
from pathlib import Path

from tappet.documentation.words import WORDS

ROOT = Path(__file__).resolve().parents[2]
SOURCES = ROOT / "frontend" / "src"
BACKEND = ROOT / "backend" / "tappet"
TABLE = ROOT / "docs" / "vocabulary.md"
CHINESE = re.compile(r"[\u4e00-\u9fff]+")
LATIN_MARK = re.compile(r"[\u3400-\u9fff](?:[,;!?]|: |\.(?:\s|$)|\.\.\.)")
"""Punctuation of the Latin script where that of Chinese belongs."""
CODE = re.compile(r"“[^”]*”|[A-Za-z_]+\([^）)]*\)|VAR_[^，]*")
"""Quoted text and calls, which have the punctuation of the language they are in."""
NAMED = {
    "W1210 advice",
    "expected <project>",
    "damaged object code: {error}",
    "the object code does not define {names}",
    "nothing listens there; is `tappet runtime` running?",
    "unknown mode '{mode}'; known are download and online_change",
}
"""Texts with terms that are names of the language there."""
IN_ANOTHER_SENSE = {
    "Drive interface does not support the window function",
    "Velocity and acceleration values must be given for the ramp_in function",
}
"""Texts with words that are no terms there: what a drive is able to do."""
MECHANICAL = re.compile(r"\b[Tt]orque\b|\[N|\bmotor\b")
"""Beside them a force is one in newtons."""
QUOTED = re.compile(r"“[^”]*”")
HALF_BRACKET = re.compile(r"[\u3400-\u9fff”] ?\((?!.*:=)|(?<![A-Za-z_])\([^):]*[\u3400-\u9fff][^):]*\)")
"""A bracket of the Latin script beside or around Chinese."""
VALUE = re.compile(r"\{\{?\w+\}?\}")
NOTE = re.compile(r"\s*\(.*?\)")


def _rows() -> list[list[str]]:
    lines = [line for line in TABLE.read_text("utf-8").splitlines() if line[:2] == "| "]
    return [[cell.strip() for cell in line.strip("| \n").split("|")] for line in lines[1:]]


def _refused() -> dict[str, str]:
    """Words that are not used, each with the one that is."""
    words: dict[str, str] = {}
    for row in _rows():
        if len(row) == 3:
            words |= dict.fromkeys(CHINESE.findall(row[2]), row[1])
    return words


def _terms() -> dict[str, str]:
    """Terms of up to three words, each with its Chinese word; what longer rows explain is for people."""
    found: dict[str, str] = {}
    for row in _rows():
        english, chinese = (NOTE.sub("", cell) for cell in row[:2])
        both = list(zip(english.split(", "), chinese.split("、"), strict=True))
        found |= {term: word for term, word in both if len(term.split()) <= 3}
    return found


def _texts() -> list[Path]:
    front_end = [path for path in SOURCES.rglob("*.json") if "zh" in path.parts or path.stem == "zh"]
    back_end = [path for path in BACKEND.rglob("*") if path.suffix in (".py", ".csv", ".json", ".txt")]
    return front_end + [path for path in back_end if CHINESE.search(path.read_text("utf-8"))]


def _table(path: str, key: str) -> dict[str, dict[str, str]]:
    with (BACKEND / path).open(encoding="utf-8", newline="") as file:
        return {row[key]: row for row in csv.DictReader(file)}


def _pairs() -> Iterator[tuple[str, str, str]]:
    """Places of the texts of the product, each with its English and its Chinese text."""
    for path in SOURCES.rglob("*.json"):
        if "en" not in (path.stem, path.parent.name):
            continue
        other = path.with_stem("zh") if path.stem == "en" else path.parent.with_name("zh") / path.name
        english, chinese = (json.loads(file.read_text("utf-8")) for file in (path, other))
        for key, text in english.items():
            if key in chinese:  # Chinese has no form of its own for one of a thing.
                yield key, text, chinese[key]
    diagnostics = _table("lang/diagnostics.csv", "code")
    for code, row in _table("lang/diagnostics_zh.csv", "code").items():
        for column in ("message", "advice"):
            yield f"{code} {column}", diagnostics[code][column], row[column]
    for english, row in _table("lang/phrases_zh.csv", "english").items():
        yield english, english, row["chinese"]
    for table in sorted((BACKEND / "translation" / "zh").rglob("*.csv")):
        for english, row in _table(str(table.relative_to(BACKEND)), "english").items():
            yield english, english, row["translation"]
    for words, row in _table("lang/reference.csv", "words").items():
        yield words, row["en"], row["zh"]
    for name, row in _table("server/help/views.csv", "name").items():
        yield f"{name} title", row["title_en"], row["title_zh"]
        yield name, row["en"], row["zh"]
    for key, (english, chinese) in WORDS.items():
        yield key, english, chinese


def test_one_word_for_one_thing() -> None:
    refused, texts = _refused(), _texts()
    assert len(refused) > 10
    assert len(texts) > 15
    found = [
        f"{path.relative_to(ROOT)}:{number}: {word}, say {use}"
        for path in texts
        for number, line in enumerate(path.read_text("utf-8").splitlines(), 1)
        for word, use in refused.items()
        if word in line
    ]
    assert found == []


def test_a_term_has_its_chinese_word() -> None:
    terms, pairs = _terms(), list(_pairs())
    assert len(terms) > 40
    assert len(pairs) > 2000
    # Keywords in upper case are the language's, paths and values in braces the program's.
    either = "|".join(f"[{t[0]}{t[0].upper()}]{t[1:]}" for t in sorted(terms, key=len, reverse=True))
    say = re.compile(rf"(?<![\w'/-])({either})s?(?![\w'-])")
    found = [
        f"{place}: {term} is {terms[term.lower()]}: {english} | {chinese}"
        for place, english, chinese in pairs
        if place not in NAMED | IN_ANOTHER_SENSE
        for term in say.findall(VALUE.sub("", english))
        if terms[term.lower()] not in chinese and not (term == "force" and MECHANICAL.search(english))
    ]
    assert found == [], "\n".join(found)


def test_chinese_has_its_own_punctuation() -> None:
    found = [
        f"{place}: {chinese}"
        for place, _, chinese in _pairs()
        if LATIN_MARK.search(CODE.sub("值", VALUE.sub("值", chinese)))
    ]
    assert found == [], "\n".join(found)


def test_chinese_has_brackets_of_its_own() -> None:
    """Those of the Latin script belong to code such as `LIMIT(最小值, 值, 最大值)`."""
    found = [
        f"{place}: {chinese}"
        for place, _, chinese in _pairs()
        if HALF_BRACKET.search(QUOTED.sub("“x”", VALUE.sub("x", chinese)))
    ]
    assert found == [], "\n".join(found)

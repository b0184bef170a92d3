"""Every sentence of a public pin, block or type of SM3_Basic and of its examples is there in Chinese."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

import pytest

from tappet.libraries import load
from tappet.libraries.catalog import Item
from tappet.manual.examples import read_examples
from tappet.manual.pages import (
    FOLDERS,
    LIBRARY,
    examples_of,
    items_of,
    public_methods,
    sentences_of_examples,
)
from tappet.translation.library_comments import comment, said, sentences, table

CHINESE = re.compile("[一-鿿]")
NUMBER = re.compile(r"(?<![\w.])\d+(?:\.\d+)?(?![\w])")
NAME = re.compile(r"\b(?:[a-z]*_\w+|[A-Z]+_\w+|[a-z]+[A-Z]\w*|[A-Z][a-z]+[A-Z]\w*)\b")
WITHOUT_WORDS = {"[u/s]", "[u/s2]", "[u/s3]", "MC_CamIn.Tappets", "RatioDenominator = 0"}


def _of(item: Item) -> Iterator[str]:
    yield item.summary
    for part in (*item.inputs, *item.outputs, *item.in_out, *item.members, *item.values):
        yield part.comment


def _shown() -> dict[str, set[str]]:
    """Sentences by table."""
    shown: dict[str, set[str]] = {}
    folder = Path(__file__).parents[2] / "docs" / "motion"
    for name in FOLDERS:
        library = load(name)
        shown[name] = {
            sentence
            for item in items_of(name)
            for one in (item, *public_methods(library, item))
            for comment in _of(one)
            for sentence in sentences(comment)
        }
        examples = read_examples(folder / examples_of(name)).values()
        shown[sentences_of_examples(name)] = {s for one in examples for s in sentences(one.comment)}
    return shown


TABLES = [table for name in FOLDERS for table in (name, sentences_of_examples(name))]


@pytest.mark.parametrize("name", TABLES)
def test_every_sentence_has_a_row_and_every_row_a_sentence(name: str) -> None:
    shown, known = _shown()[name], table(name, "zh")
    assert sorted(shown - known.keys()) == [], "write them into translation/zh/libraries"
    assert sorted(known.keys() - shown) == []


@pytest.mark.parametrize("name", TABLES)
def test_rows_are_chinese_with_the_numbers_and_names_of_the_english_sentence(name: str) -> None:
    known = table(name, "zh")
    assert [english for english, zh in known.items() if not CHINESE.search(zh)] == [
        english for english in known if english in WITHOUT_WORDS
    ]
    wrong = [
        (english, chinese)
        for english, chinese in known.items()
        if english not in WITHOUT_WORDS
        for fact in [*NUMBER.findall(english), *NAME.findall(english)]
        if fact not in chinese and fact not in ("2.0",)
    ]
    assert wrong == []


def test_a_comment_is_cut_into_sentences_and_loses_what_it_cites() -> None:
    assert sentences("Ends it. It waits for\nE.g. nothing (at all). Spec TPR-05, cam EX-14 and 10.2.") == [
        "Ends it.",
        "It waits for E.g. nothing (at all).",
    ]
    assert sentences("") == []
    assert sentences("Why") == ["Why"]


def test_a_whole_comment_has_no_blanks_between_chinese_sentences() -> None:
    assert (
        comment("The axis stands. With both inputs TRUE nothing moves.", LIBRARY, "zh")
        == "The axis stands. 两个输入都为 TRUE 时不运动。"
    )
    assert comment(
        "Moves the axis to a position. PLCopen part 1, version 2.0. Spec X-01.", LIBRARY, "zh"
    ) == ("使轴运动到一个位置。PLCopen 第 1 部分，2.0 版本。")
    assert (
        comment("Nobody has\n\nsaid this. Spec X-01.", LIBRARY, "zh") == "Nobody has\n\nsaid this. Spec X-01."
    )


def test_what_has_no_row_stays_english() -> None:
    assert said("The axis. Nobody has said this.", LIBRARY, "zh") == ["The axis.", "Nobody has said this."]
    assert said("The axis", LIBRARY, "zh") == ["轴"]
    assert said("The axis", LIBRARY, "en") == ["The axis"]
    assert said("The axis", "Util", "zh") == ["The axis"]

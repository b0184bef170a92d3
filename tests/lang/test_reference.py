"""The reference of the language has a topic for each of its words, and none for others."""

from __future__ import annotations

import pytest

from tappet.iec import words
from tappet.iec.tokens import pieces
from tappet.lang.analysis.builtins import OPERATORS
from tappet.lang.analysis.type_conversions import is_conversion
from tappet.lang.reference import Topic, topics

WORDS = frozenset(
    [
        *words.KEYWORDS,
        *words.RESERVED,
        *words.MODIFIERS,
        *words.HEADER_WORDS,
        *words.ACCESSORS,
        *words.ELEMENTARY_TYPES,
        *words.TYPE_SYNONYMS,
        *words.STRING_TYPES,
        *words.OPERATOR_FUNCTIONS,
        *words.OPERATORS,
        *OPERATORS,
        words.NULL,
    ]
)


def test_every_word_has_one_topic() -> None:
    named = [word for topic in topics().values() for word in topic.words]
    assert sorted(word for word in named if named.count(word) > 1) == []
    assert sorted(WORDS - set(named)) == []
    assert sorted(word for word in set(named) - WORDS if not is_conversion(word)) == []


@pytest.mark.parametrize("topic", topics().values(), ids=lambda topic: topic.title)
def test_a_topic_is_explained_in_both_languages(topic: Topic) -> None:
    assert topic.text("en").endswith(".")
    assert topic.text("en").isascii()
    assert not topic.text("zh").isascii()
    assert topic.text("zh").endswith("。")
    shown = {piece.text.upper() for piece in pieces(topic.example)}
    assert shown & set(topic.words) or topic.group in ("declaration", "operator", "constant", "modifier")


def test_types_say_their_range() -> None:
    assert topics()["INT"].text("en") == "A whole number, signed. Takes 2 byte(s). Range -32768 to 32767."
    assert topics()["USINT"].text("zh") == "无符号整数。 占 1 个字节。范围 0 至 255。"

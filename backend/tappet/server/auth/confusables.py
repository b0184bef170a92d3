"""User names that people cannot tell apart: written with letters of other scripts, or with invisible ones.

A small part of the table of Unicode UTS #39 (confusables), for what names can hold: letters and digits that
look like Latin ones in common fonts.
"""

from __future__ import annotations

import unicodedata

_LOOKS_LIKE = {
    "a": "аɑα",
    "b": "Ьь",
    "c": "сϲⅽ",
    "d": "ԁⅾ",
    "e": "еҽ",
    "g": "ɡց",
    "h": "һհ",
    "i": "іιıɩ",
    "j": "јϳ",
    "k": "κк",
    "l": "1IӀ|ⅼΙІ",
    "m": "мⅿ",
    "n": "ոп",
    "o": "0οоօσ",
    "p": "рρ",
    "q": "ԛգ",
    "r": "гⲅ",
    "s": "ѕꜱ",
    "t": "тτ",
    "u": "υսʋ",
    "v": "νѵⅴ",
    "w": "ԝѡա",
    "x": "хχⅹ",
    "y": "уγү",
    "z": "ᴢꮓ",
    "A": "АΑ",
    "B": "ВΒ",
    "C": "СϹ",
    "E": "ЕΕ",
    "H": "НΗ",
    "J": "ЈͿ",
    "K": "КΚ",
    "M": "МΜ",
    "N": "ΝⲚ",
    "O": "ОΟՕ",
    "P": "РΡ",
    "S": "ЅՏ",
    "T": "ТΤ",
    "X": "ХΧ",
    "Y": "УΥҮ",
    "Z": "ΖⲌ",
}
_TABLE = str.maketrans({look: letter for letter, looks in _LOOKS_LIKE.items() for look in looks})
_MARKS = range(0x300, 0x370)
"""Accents of Latin, Greek and Cyrillic letters; in other scripts marks are vowels."""


def skeleton(name: str) -> str:
    """Equal for names that look the same; it is no name itself."""
    shown = unicodedata.normalize("NFKD", name)
    kept = "".join(c for c in shown if unicodedata.category(c) != "Cf" and ord(c) not in _MARKS)
    return kept.translate(_TABLE).casefold().translate(_TABLE)

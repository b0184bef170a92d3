"""What CoDeSys 2.3 meant by words and texts that mean something else today.

TRUNC gave an INT (LOPR-77), a character of a STRING was one byte of the Windows code page, a pointer had four
bytes, keywords of object orientation were names like any other, and addresses led through modules.
"""

from __future__ import annotations

from itertools import pairwise

from tappet.iec.languages import is_plain_text
from tappet.iec.tokens import NAME, Word, words
from tappet.project.exchange.codesys23_places import Places
from tappet.project.exchange.drafts import Draft
from tappet.project.exchange.report import ImportReport

_TRUNC = "TRUNC gives INT in CoDeSys 2.3; it became TRUNC_INT"
_BYTES = "characters in texts that are not of Latin-1 became their bytes, such as $80 for the euro sign"
_KEYWORD = "names that are keywords today end in an underscore now: "
_PLACE = "addresses lead through a device that is not here: "
_SHOWN = 8
_POINTER = "a pointer has 4 bytes in CoDeSys 2.3; SIZEOF of a pointer became SIZEOF(DWORD)"


def pointers_of(declaration: str) -> frozenset[str]:
    """The variables of a declaration that are pointers, in upper case."""
    tokens = [word.text for word in words(declaration)]
    found: set[str] = set()
    for at, (colon, type_) in enumerate(pairwise(tokens)):
        if colon != ":" or type_ != "POINTER":
            continue
        found.update(tokens[at - 1 : at])
        while at > 2 and tokens[at - 2] == ",":
            at -= 2
            found.update(tokens[at - 1 : at])
    return frozenset(found)


def say_in_words_of_today(
    draft: Draft, pointers: frozenset[str], places: Places, report: ImportReport
) -> None:
    """Rewrite what is read differently today. `pointers` are the pointers of the POU, in upper case."""
    notes: dict[str, None] = {}
    moved: list[str] = []
    for part in ("declaration", "implementation"):
        text = draft.data.get(part)
        if not text or (part == "implementation" and not is_plain_text(draft.data.get("language", "ST"))):
            continue
        pieces: list[str] = []
        position = 0
        before = ("", "")
        for word in words(text):
            now, note, end = None, "", word.end
            if word.text == "TRUNC":
                now, note = "TRUNC_INT", _TRUNC
            elif word.text.startswith("%") and (found := places.flat(text, word.start)) is not None:
                now, end = found[1], word.start + len(found[0])
                moved.append(f"{found[0]} became {found[1]}")
            elif word.text.startswith("'"):
                now, note = _in_bytes(word.text), _BYTES
            elif word.text in _KEYWORDS and not _is_keyword(text, word, before[1]):
                now = text[word.start : word.end] + "_"
                note = f"{_KEYWORD}{now}"
            elif before == ("SIZEOF", "(") and word.text in pointers and _closes(text, word.end):
                now, note = "DWORD", _POINTER
            before = (before[1], word.text)
            if now is not None and now != word.text:
                notes |= {note: None} if note else {}
                pieces += [text[position : word.start], now]
                position = end
        if pieces:
            draft.data[part] = "".join([*pieces, text[position:]])
    if moved:
        more = f" and {len(moved) - _SHOWN} more" if len(moved) > _SHOWN else ""
        notes[f"{_PLACE}{', '.join(moved[:_SHOWN])}{more}"] = None
    for note in notes:
        report.add("changed", draft.source, note, name=draft.name, line=draft.line)


_KEYWORDS = {
    "CONTINUE": ";",
    "INTERFACE": "name",
    "METHOD": "name",
    "PARAMS": "[",
    "PROPERTY": "name",
    "REFERENCE": "TO",
    "SUPER": "^",
    "THIS": "^",
    "UNION": "name",
}
"""Keywords of today that were none, and what stands behind them where they are meant as such."""


def _is_keyword(text: str, word: Word, before: str) -> bool:
    """Whether a keyword of today is meant by a word; texts of relatives of CoDeSys 2.3 may have it."""
    behind = next(words(text, word.end), None)
    if behind is None or before == ".":
        return False
    if _KEYWORDS[word.text] == "name":
        return NAME.fullmatch(behind.text) is not None
    if word.text == "CONTINUE":
        return behind.text == ";" and (before == ";" or NAME.fullmatch(before) is not None)
    return behind.text == _KEYWORDS[word.text]


def _closes(text: str, position: int) -> bool:
    """Whether a bracket closes at an offset, so that the name before it stands alone."""
    behind = next(words(text, position), None)
    return behind is not None and behind.text == ")"


def _in_bytes(text: str) -> str:
    """A text with the bytes that its characters had in the code page; Latin-1 stays as it is."""
    page = next((page for page in _PAGES if _is_in(page, text)), None)
    if page is None:
        return text
    return "".join(c if ord(c) < 256 and page == "cp1252" else _as_bytes(c, page) for c in text)


_PAGES = ("latin-1", "cp1252", "cp1251", "gbk")


def _is_in(page: str, text: str) -> bool:
    try:
        text.encode(page)
    except UnicodeEncodeError:
        return False
    return True


def _as_bytes(character: str, page: str) -> str:
    if character.isascii() or page == "latin-1":
        return character
    return "".join(f"${byte:02X}" for byte in character.encode(page))

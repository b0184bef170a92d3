"""Bytes of foreign files to text: byte order marks, XML declarations, UTF-8, and Windows code pages."""

from __future__ import annotations

import codecs
import re
from collections.abc import Iterable

from tappet.project.exchange.report import ExchangeError

MAX_FILE_BYTES = 64 << 20
"""Largest single file that is read, as in `folder.archive`."""

_MARKS = (
    (codecs.BOM_UTF8, "utf-8"),
    (codecs.BOM_UTF32_LE, "utf-32-le"),
    (codecs.BOM_UTF32_BE, "utf-32-be"),
    (codecs.BOM_UTF16_LE, "utf-16-le"),
    (codecs.BOM_UTF16_BE, "utf-16-be"),
)
_DECLARED = re.compile(rb"""<\?xml[^>]{0,200}?encoding\s*=\s*["']([A-Za-z0-9._-]{1,40})["']""")
_CYRILLIC_WORD = re.compile(rb"[\xC0-\xFF\xA8\xB8]{3,}")
_PAIRS = re.compile(rb"[\xA1-\xFE][\xA1-\xFE]")
_SAMPLE_BYTES = 4 << 20
_MOST = 0.7
"""Share of the letters beyond ASCII that must look like a script for a text to be taken as of it."""
PAGE_NAMES = {
    "cp1251": "Windows-1251 (Cyrillic)",
    "cp1252": "Windows-1252 (Latin-1)",
    "latin-1": "Windows-1252 (Latin-1)",
    "gbk": "GBK (Chinese)",
}
"""Code pages of texts that are no Unicode, as a report names them."""
_CODE_PAGES = frozenset(["cp1252", "iso8859-1", "iso8859-15", "cp1250", "cp1251", "cp936", "gb2312", "gbk"])
"""Encodings that an XML declaration may name besides Unicode ones; names as `codecs.lookup` gives them."""


def shared_pages(contents: Iterable[bytes]) -> tuple[str, ...]:
    """The code pages that all texts of an import are likely in; none when all are Unicode.

    What one text shows too little of, the others show: a project is written in one country.
    """
    sample = bytearray()
    for content in contents:
        if b"\0" in content:  # UTF-16, or no text
            continue
        try:
            content.decode("utf-8")
        except UnicodeDecodeError:
            sample += content
        if len(sample) > _SAMPLE_BYTES:
            break
    return _likely_pages(bytes(sample)) if sample else ()


def decode_text(source: str, content: bytes, pages: tuple[str, ...] = ()) -> tuple[str, str]:
    """The text of a file with line feeds only, and the name of its encoding.

    Without a byte order mark it is UTF-8, or else the code page that its letters look like: Windows-1251
    (Cyrillic), GBK (Chinese), or Windows-1252, whose unused places are read as Latin-1. `pages` are the
    code pages to try instead.
    Raises ExchangeError for what is no text.
    """
    text, encoding = _decode(source, content, pages)
    position = text.find("\x00")
    if position >= 0:
        raise ExchangeError(source, "is no text file", text.count("\n", 0, position) + 1)
    return text.replace("\r\n", "\n").replace("\r", "\n"), encoding


def decode_xml(source: str, content: bytes) -> str:
    """The text of an XML file: by its mark, else by what it declares, else as `decode_text`."""
    declared = _DECLARED.match(content.lstrip()[:300])
    if declared and not any(content.startswith(mark) for mark, _ in _MARKS):
        try:
            name = codecs.lookup(declared[1].decode()).name
        except LookupError:
            name = ""
        if name in _CODE_PAGES:
            return content.decode(name, errors="replace")
    return _decode(source, content)[0]


def _decode(source: str, content: bytes, pages: tuple[str, ...] = ()) -> tuple[str, str]:
    if len(content) > MAX_FILE_BYTES:
        raise ExchangeError(source, f"is larger than {MAX_FILE_BYTES >> 20} MiB")
    for mark, encoding in _MARKS:
        if content.startswith(mark):
            return _strict(source, content[len(mark) :], encoding), encoding
    for encoding, odd in (("utf-16-le", 1), ("utf-16-be", 0)):
        head = content[:64]
        if len(head) >= 4 and not any(head[odd::2]) and all(head[1 - odd :: 2]):
            return _strict(source, content, encoding), encoding
    try:
        return content.decode("utf-8"), "utf-8"
    except UnicodeDecodeError:
        pass
    for page in pages or _likely_pages(content):
        try:
            return content.decode(page), page
        except UnicodeDecodeError:
            continue
    return content.decode("latin-1"), "latin-1"


def _likely_pages(content: bytes) -> tuple[str, ...]:
    """The code pages that a text may be in, the likeliest first.

    Cyrillic has whole words of letters from 0xC0 on, mostly small ones from 0xE0 on. Chinese has pairs of
    bytes, each from 0xA1 on, whose common characters begin below 0xD8. Western texts have single letters.
    """
    high = sum(byte >= 0x80 for byte in content)
    cyrillic = b"".join(_CYRILLIC_WORD.findall(content))
    words_of_letters = len(cyrillic) >= _MOST * high
    small = sum(byte >= 0xE0 for byte in cyrillic)
    if words_of_letters and small * 2 >= len(cyrillic):
        return ("cp1251", "cp1252")
    pairs = _PAIRS.findall(content)
    common = sum(0xB0 <= pair[0] < 0xD8 or pair[0] < 0xAA for pair in pairs)
    if 2 * len(pairs) >= _MOST * high and common >= _MOST * len(pairs):
        return ("gbk", "cp1251" if words_of_letters else "cp1252", "cp1252")
    return ("cp1251", "cp1252") if words_of_letters else ("cp1252",)


def _strict(source: str, content: bytes, encoding: str) -> str:
    try:
        return content.decode(encoding)
    except UnicodeDecodeError as error:
        line = content[: error.start].decode(encoding, errors="ignore").count("\n") + 1
        raise ExchangeError(source, f"is marked as {encoding.upper()} but is not", line) from error

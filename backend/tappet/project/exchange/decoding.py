"""Bytes of foreign files to text: byte order marks, XML declarations, UTF-8, and Windows code pages."""

from __future__ import annotations

import codecs
import re

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
_CODE_PAGES = frozenset(["cp1252", "iso8859-1", "iso8859-15", "cp1250", "cp1251", "cp936", "gb2312", "gbk"])
"""Encodings that an XML declaration may name besides Unicode ones; names as `codecs.lookup` gives them."""


def decode_text(source: str, content: bytes) -> tuple[str, str]:
    """The text of a file with line feeds only, and the name of its encoding.

    Without a byte order mark it is UTF-8, or else Windows-1252, whose unused places are read as Latin-1.
    Raises ExchangeError for what is no text.
    """
    text, encoding = _decode(source, content)
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


def _decode(source: str, content: bytes) -> tuple[str, str]:
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
    try:
        return content.decode("cp1252"), "cp1252"
    except UnicodeDecodeError:
        return content.decode("latin-1"), "latin-1"


def _strict(source: str, content: bytes, encoding: str) -> str:
    try:
        return content.decode(encoding)
    except UnicodeDecodeError as error:
        line = content[: error.start].decode(encoding, errors="ignore").count("\n") + 1
        raise ExchangeError(source, f"is marked as {encoding.upper()} but is not", line) from error

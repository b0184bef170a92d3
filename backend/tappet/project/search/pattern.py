"""Patterns and replacements: what a query finds in one text.

The engine is RE2, which reads a text once whatever the pattern is: `re` backtracks, so that `(x+x+)+y` of one
user would hold up the server of all. For it, RE2 has no back references and no look-around; it says so.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

import re2

from tappet.project.search.query import MAX_TEXT, InvalidPatternError, InvalidReplacementError, Query

MAX_MEMORY = 16 << 20
"""Bytes that a compiled pattern may take."""


@dataclass(frozen=True, slots=True)
class Found:
    """A match: offsets in code points, and the texts of the groups, the whole match first."""

    start: int
    end: int
    groups: tuple[str, ...]


class Pattern:
    """A query, compiled."""

    def __init__(self, query: Query) -> None:
        """Raises InvalidPatternError."""
        if not query.text:
            raise InvalidPatternError("Say what is searched for")
        if len(query.text) > MAX_TEXT:
            raise InvalidPatternError(f"What is searched for has at most {MAX_TEXT} characters")
        options = re2.Options()
        options.case_sensitive = query.match_case
        options.literal = False
        options.log_errors = False
        options.max_mem = MAX_MEMORY
        source = query.text if query.regular_expression else re2.escape(query.text)
        try:
            self._compiled: Any = re2.compile(f"(?m){source}", options)
        except (re2.error, UnicodeError) as error:
            raise InvalidPatternError(_explained(error)) from None
        self._whole_words = query.whole_words
        self.groups: int = self._compiled.groups
        self.regular_expression = query.regular_expression

    def matches(self, text: str) -> Iterator[Found]:
        """What is found in a text, in order, without overlaps; an empty match is none."""
        data = text.encode()
        plain = len(data) == len(text)
        byte = char = 0
        for match in self._compiled.finditer(data):
            first, last = match.span()
            if first == last:
                continue
            if plain:
                start, end = first, last
            else:
                start = char + len(data[byte:first].decode())
                end = start + len(data[first:last].decode())
                byte, char = last, end
            if self._whole_words and not _is_word(text, start, end):
                continue
            groups = (match.group(), *match.groups())
            yield Found(start, end, tuple((group or b"").decode() for group in groups))


def _explained(error: Exception) -> str:
    said = error.args[0] if error.args else ""
    reason = said.decode(errors="replace") if isinstance(said, bytes) else str(said)
    advice = ""
    if "invalid perl operator" in reason or "invalid escape sequence" in reason:
        advice = "; look-around and back references cannot be searched for"
    return f"This is no regular expression: {reason.replace('(?m)', '')}{advice}"


def _is_word(text: str, start: int, end: int) -> bool:
    """Whether no letter, digit or underscore goes on beyond a match that begins or ends with one."""
    return not (
        (start > 0 and _in_word(text[start - 1]) and _in_word(text[start]))
        or (end < len(text) and _in_word(text[end]) and _in_word(text[end - 1]))
    )


def _in_word(char: str) -> bool:
    return char == "_" or char.isalnum()


_REFERENCE = re.compile(r"\$(?:(\$)|(&)|(\d{1,2})|\{(\d{1,2})\})|\\([nt\\])")
_ESCAPED = {"n": "\n", "t": "\t", "\\": "\\"}


def replacement(pattern: Pattern, text: str) -> Callable[[Found], str]:
    """What replaces a match. In regular expressions `$1` is a group, `$0` or `$&` the whole match, `$$` a
    dollar sign, and `\\n`, `\\t` and `\\\\` are a line break, a tab and a backslash.

    Raises InvalidReplacementError for groups that the pattern has not.
    """
    if not pattern.regular_expression:
        return lambda found: text
    for reference in _REFERENCE.finditer(text):
        number = reference[3] or reference[4]
        if number is not None and int(number) > pattern.groups:
            raise InvalidReplacementError(
                f"{reference[0]} stands for group {int(number)}, but the regular expression has "
                f"{pattern.groups} group(s); write $$ for a dollar sign"
            )

    def replaced(found: Found) -> str:
        def piece(reference: re.Match[str]) -> str:
            if reference[1]:
                return "$"
            if reference[5]:
                return _ESCAPED[reference[5]]
            return found.groups[0 if reference[2] else int(reference[3] or reference[4])]

        return _REFERENCE.sub(piece, text)

    return replaced

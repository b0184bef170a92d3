"""The tokens that are compiled: inactive branches left out, definitions replaced, files included."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass

from tappet.iec.words import ENDS
from tappet.lang.conditional.condition import ConditionError, View, evaluate
from tappet.lang.conditional.facts import Facts
from tappet.lang.diagnostics import report
from tappet.lang.lexer import END, ID, PRAGMA, Lexed, Trivia, lex
from tappet.lang.source import Source, Span

Include = Callable[[str], str | None]
"""The text of an included file by the name in the pragma, None when there is none."""

_DIRECTIVE = re.compile(
    r"\{\s*(IF|ELSIF|ELSE|END_IF|define|undefine|include)\b\s*(.*?)\s*\}$", re.IGNORECASE | re.DOTALL
)
_DEFINE = re.compile(r"([^\W\d]\w*)\s*(.*)$", re.DOTALL)
_MAX_INCLUDES = 20
_HEADS = ("PROGRAM", "FUNCTION", "FUNCTION_BLOCK", "INTERFACE", "TYPE", "METHOD", "ACTION", "PROPERTY")
_OBJECTS = {head: ENDS[head] for head in _HEADS}
_ENDS = frozenset(_OBJECTS.values())


@dataclass(slots=True)
class _Object:
    """An open object: what is defined behind its end is what was defined at its beginning (LPRG-50)."""

    end: str
    defines: dict[str, str]
    replacements: dict[str, Lexed]


@dataclass(slots=True)
class _Branch:
    """An open `{IF}`."""

    span: Span
    outer: bool
    """Whether the text around it is active."""
    active: bool
    taken: bool
    """Whether a branch has been active."""
    last: bool = False
    """Whether `{ELSE}` has been seen."""


class Selection:
    """Copies the active tokens of a text."""

    def __init__(
        self, source: Source, facts: Facts, defines: dict[str, str], include: Include | None
    ) -> None:
        self.source = source
        self.facts = facts
        self.defines = dict(defines)
        self.replacements: dict[str, Lexed] = {}
        self.include = include
        self.includes = 0
        self.branches: list[_Branch] = []
        self.objects: list[_Object] = []
        self.out = Lexed()
        self.inactive: list[Span] = []
        for name, value in defines.items():
            self._define(name, value)

    def run(self, lexed: Lexed) -> Lexed:
        """The tokens of `lexed` that are compiled."""
        out = self.out
        out.unclosed_comment = lexed.unclosed_comment
        self._copy(lexed)
        for branch in self.branches:
            out.diagnostics.append(report("E0020", self.source.uri, branch.span))
        out.kinds.append(END)
        out.texts.append("")
        out.lines.append(lexed.lines[-1])
        out.columns.append(lexed.columns[-1])
        skipped = self.inactive
        out.diagnostics += [
            d for d in lexed.diagnostics if not any(s[:2] <= d.span[:2] < s[2:] for s in skipped)
        ]
        return out

    @property
    def active(self) -> bool:
        """Whether the place reached is compiled."""
        return not self.branches or self.branches[-1].active

    def _copy(self, lexed: Lexed) -> None:
        out = self.out
        for index, kind in enumerate(lexed.kinds):
            for item in lexed.trivia.get(index, ()):
                if item.kind is PRAGMA and self._directive(item):
                    continue
                if self.active:
                    out.trivia.setdefault(len(out.kinds), []).append(item)
            if kind is END or not self.active:
                continue
            if index in lexed.damaged:
                out.damaged.add(len(out.kinds))
            if kind in _OBJECTS:
                self.objects.append(_Object(_OBJECTS[kind], dict(self.defines), dict(self.replacements)))
            elif kind in _ENDS:
                self._leave(kind)
            text, line, column = lexed.texts[index], lexed.lines[index], lexed.columns[index]
            replacement = self.replacements.get(text.upper()) if kind is ID and self.replacements else None
            if replacement is None:
                self._append(kind, text, line, column)
            else:
                for new_kind, new_text in zip(replacement.kinds, replacement.texts, strict=True):
                    if new_kind is not END:
                        self._append(new_kind, new_text, line, column)

    def _leave(self, end: str) -> None:
        """Forget what an object has defined; objects inside it whose end is missing end with it."""
        if all(opened.end != end for opened in self.objects):
            return
        while True:
            opened = self.objects.pop()
            self.defines, self.replacements = opened.defines, opened.replacements
            if opened.end == end:
                return

    def _append(self, kind: str, text: str, line: int, column: int) -> None:
        out = self.out
        out.kinds.append(kind)
        out.texts.append(text)
        out.lines.append(line)
        out.columns.append(column)

    def _directive(self, item: Trivia) -> bool:
        """Carry out a conditional pragma; False for any other."""
        match = _DIRECTIVE.match(item.text)
        if match is None:
            return False
        word, rest = match[1].upper(), match[2]
        if word == "IF":
            outer = self.active
            holds = outer and self._holds(rest, item.span)
            self.branches.append(_Branch(item.span, outer, holds, holds))
            self._mark(item.span, before=outer)
        elif word in ("ELSIF", "ELSE", "END_IF"):
            self._next_branch(word, rest, item.span)
        elif self.active:
            if word == "DEFINE":
                definition = _DEFINE.match(rest)
                if definition is None:
                    self._report("E0022", item.span, reason="an identifier is missing")
                else:
                    self._define(definition[1], definition[2])
            elif word == "UNDEFINE":
                self.defines.pop(rest.upper(), None)
                self.replacements.pop(rest.upper(), None)
            else:
                self._include(rest, item.span)
        return True

    def _next_branch(self, word: str, rest: str, span: Span) -> None:
        if not self.branches or (self.branches[-1].last and word != "END_IF"):
            self._report("E0021", span, found=f"{{{word}}}")
            return
        branch = self.branches[-1]
        was_active = branch.active
        if word == "END_IF":
            self.branches.pop()
        elif word == "ELSE":
            branch.active = branch.outer and not branch.taken
            branch.last = True
        else:
            branch.active = branch.outer and not branch.taken and self._holds(rest, span)
            branch.taken = branch.taken or branch.active
        self._mark(span, before=was_active)

    def _mark(self, span: Span, before: bool) -> None:
        """Keep the places that are left out, for the editor."""
        if before and not self.active:
            self.inactive.append(Span(span.end_line, span.end_column, span.end_line, span.end_column))
        elif not before and self.active and self.inactive:
            start = self.inactive[-1]
            self.inactive[-1] = Span(start.line, start.column, span.line, span.column)
        elif not before and self.inactive:
            start = self.inactive[-1]
            self.inactive[-1] = Span(start.line, start.column, span.end_line, span.end_column)

    def _holds(self, condition: str, span: Span) -> bool:
        pou = self.source.owner or _object_name(self.out)
        try:
            return evaluate(condition, View(self.defines, self.facts, pou))
        except ConditionError as error:
            self._report("E0022", span, reason=str(error))
            return False

    def _define(self, name: str, value: str) -> None:
        key = name.upper()
        self.defines[key] = value
        if value.strip():
            self.replacements[key] = lex(value, self.source.uri)
        else:
            self.replacements.pop(key, None)

    def _include(self, name: str, span: Span) -> None:
        name = name.strip("'\"")
        self.includes += 1
        text = self.include(name) if self.include is not None and self.includes <= _MAX_INCLUDES else None
        if text is None:
            self._report("E0023", span, name=name)
            return
        included = lex(text, name)
        # its places are not of this text: everything stands where the pragma stands
        included.lines = [span.line] * len(included.kinds)
        included.columns = [span.column] * len(included.kinds)
        included.trivia = {
            index: [Trivia(item.kind, item.text, span) for item in items]
            for index, items in included.trivia.items()
        }
        self._copy(included)

    def _report(self, code: str, span: Span, **fields: object) -> None:
        self.out.diagnostics.append(report(code, self.source.uri, span, **fields))


def _object_name(lexed: Lexed) -> str | None:
    """Name behind the first PROGRAM, FUNCTION or FUNCTION_BLOCK of the tokens so far."""
    for index, kind in enumerate(lexed.kinds):
        if kind in ("PROGRAM", "FUNCTION", "FUNCTION_BLOCK") and index + 1 < len(lexed.kinds):
            return lexed.texts[index + 1]
    return None

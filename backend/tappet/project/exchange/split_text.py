"""IEC text with many objects to one draft an object: POUs with their children, types, lists, interfaces.

Nothing is parsed beyond the keywords that open and close objects, so that texts come in which do not compile.
Comments between two objects go to the one behind them.
"""

from __future__ import annotations

import re
from bisect import bisect_right
from dataclasses import dataclass, field

from tappet.iec.sections import declaration_end
from tappet.iec.tokens import NAME, Word, words
from tappet.iec.words import MODIFIERS
from tappet.project.exchange.drafts import Draft, body
from tappet.project.exchange.report import ImportReport, Outcome
from tappet.project.exchange.text_parts import trimmed, type_parts

_POU_ENDS = {
    "PROGRAM": ("END_PROGRAM",),
    "FUNCTION_BLOCK": ("END_FUNCTION_BLOCK", "END_FUNCTIONBLOCK"),
    "FUNCTIONBLOCK": ("END_FUNCTION_BLOCK", "END_FUNCTIONBLOCK"),
    "FUNCTION": ("END_FUNCTION",),
}
_CHILD_ENDS = {
    "METHOD": "END_METHOD",
    "ACTION": "END_ACTION",
    "TRANSITION": "END_TRANSITION",
    "PROPERTY": "END_PROPERTY",
}
_GLOBALS = frozenset(["VAR_GLOBAL", "VAR_CONFIG"])
_HEADS = frozenset([*_POU_ENDS, *_CHILD_ENDS, *_GLOBALS, "TYPE", "INTERFACE", "CONFIGURATION"])


def _ends_name(word: str) -> bool:
    """Whether a word stands behind a name, and is none itself."""
    return word in ("EXTENDS", "IMPLEMENTS") or word.startswith(("VAR", "END_"))


@dataclass(slots=True)
class SplitText:
    """A text on its way into drafts."""

    source: str
    text: str
    report: ImportReport
    declaration_ends: tuple[int, ...] = ()
    """Offsets where declarations end, in order, where the file says so."""
    list_names: tuple[tuple[int, str], ...] = ()
    """Names of global variable lists and the offsets from which on they count, where the file says so."""
    heads: list[tuple[int, Draft]] = field(default_factory=list)
    """Offset of the keyword of each top-level object, and the object; in order."""
    configurations: list[tuple[int, int]] = field(default_factory=list)
    """Ranges of CONFIGURATION ... END_CONFIGURATION."""
    _line_starts: list[int] = field(default_factory=list)

    def line(self, offset: int) -> int:
        """The line of an offset, from 1."""
        if not self._line_starts:
            self._line_starts = [0, *(match.end() for match in re.finditer("\n", self.text))]
        return bisect_right(self._line_starts, offset)

    def drafts(self) -> list[Draft]:
        """The objects of the text, in order."""
        return [draft for _, draft in self.heads]


def split_text(
    source: str,
    text: str,
    report: ImportReport,
    *,
    list_name: str = "Globals",
    declaration_ends: tuple[int, ...] = (),
    list_names: tuple[tuple[int, str], ...] = (),
    owner: Draft | None = None,
    open_ended: bool = False,
) -> SplitText:
    """The objects of a text. `list_name` names global variable lists that have no name in `list_names`.

    Methods, properties and actions that stand alone go below `owner`. `open_ended`: the text holds one
    object, which ends with it and needs no closing keyword.
    """
    split = SplitText(source, text, report, declaration_ends, list_names)
    _Splitter(split, list_name, owner, open_ended).run()
    return split


class _Splitter:
    def __init__(self, split: SplitText, list_name: str, owner: Draft | None, open_ended: bool) -> None:
        self.split = split
        self.text = split.text
        self.list_name = list_name
        self.owner = owner
        self.open_ended = open_ended
        self.scan: list[Word] = list(words(split.text))
        self.i = 0
        self.end = 0
        """Where the object before ended."""

    def run(self) -> None:
        """Read everything."""
        unknown: Word | None = None
        while self.i < len(self.scan):
            word = self.scan[self.i]
            if not self._is_head(self.i):
                if word.text in ("END_NAMESPACE", "NAMESPACE", "USING", ";"):
                    self._wrapper(word)
                    continue
                unknown = unknown or word
                self.i += 1
                continue
            if unknown is not None:
                self._refuse(unknown, word.start)
                unknown = None
            self._object(word)
        if unknown is not None:
            self._refuse(unknown, len(self.text))
        else:
            self._trailing()

    def _wrapper(self, word: Word) -> None:
        """NAMESPACE and USING lines go; what is inside stays."""
        self.i += 1
        if word.text in ("NAMESPACE", "USING"):
            while self.i < len(self.scan) and "\n" not in self.text[word.start : self.scan[self.i].start]:
                self.i += 1
            text = f"the {word.text} line was left out; its contents are in no namespace"
            self._note("changed", text, word)
        self.end = self.scan[self.i - 1].end

    def _is_head(self, i: int) -> bool:
        word = self.scan[i]
        if word.text not in _HEADS or (i and self.scan[i - 1].text in (".", ":=")):
            return False
        if word.text in ("VAR_GLOBAL", "VAR_CONFIG", "TYPE"):
            return True
        if i + 1 >= len(self.scan) or not NAME.fullmatch(self.scan[i + 1].text):
            return False
        return self._begins_line(i) and not (word.text == "TRANSITION" and self._of_chart(i))

    def _of_chart(self, i: int) -> bool:
        """Whether a TRANSITION joins steps in the body: FROM follows, behind a name and a priority."""
        after = [item.text for item in self.scan[i + 1 : i + 3]]
        if len(after) < 2:
            return False
        return after[1] in ("FROM", "(") or (after[0] == "FROM" and after[1] not in (":", ":="))

    def _begins_line(self, i: int) -> bool:
        """Whether only modifiers and closing keywords stand before a word on its line."""
        while i:
            before = self.scan[i - 1]
            if "\n" in self.text[before.end : self.scan[i].start]:
                return True
            if before.text not in MODIFIERS and not before.text.startswith("END_") and before.text != ";":
                return False
            if before.text.startswith("END_"):
                return True
            i -= 1
        return True

    def _object(self, word: Word) -> None:
        keyword = word.text
        if keyword in _POU_ENDS:
            self._pou(word)
        elif keyword in _CHILD_ENDS:
            self._stray_child(word)
        elif keyword == "TYPE":
            self._types(word)
        elif keyword == "INTERFACE":
            self._interface(word)
        elif keyword == "CONFIGURATION":
            start = word.start
            self._skip_to(("END_CONFIGURATION",))
            self.split.configurations.append((start, self.end))
        else:
            self._globals(word)

    # -- POUs

    def _pou(self, word: Word) -> None:
        start, head = self.end, word.start
        ends = _POU_ENDS[word.text]
        name = self._name_at(self.i + 1)
        children: list[Draft] = []
        pieces: list[tuple[int, int]] = []
        piece_start = start
        self.i += 1
        stop = len(self.text)
        closed = False
        while self.i < len(self.scan):
            item = self.scan[self.i]
            if item.text in ends:
                stop, closed = item.start, True
                self._leave(self.i)
                break
            if self._is_head(self.i) and item.text in _CHILD_ENDS:
                piece_end = self._child_start(self.i)
                pieces.append((piece_start, piece_end))
                self.end = piece_end
                children.append(self._child(item))
                piece_start = self.end
                continue
            if self._is_head(self.i) and item.text not in _GLOBALS and item.text != "TYPE":
                stop = self._child_start(self.i)
                self.end = stop
                break
            self.i += 1
        else:
            self.end = stop
        pieces.append((piece_start, stop))
        draft = Draft("pou", name, source=self.split.source, line=self.split.line(head), children=children)
        draft.data = self._parts(pieces, head)
        self.split.heads.append((head, draft))
        if not closed and not self.open_ended:
            self._note("changed", f"{ends[0]} is missing; the object ends where the next begins", word, name)

    def _parts(self, pieces: list[tuple[int, int]], head: int) -> dict[str, object]:
        """Declaration and implementation of the text that is left when the children are taken out."""
        first, last = pieces[0][0], pieces[-1][1]
        marked = next((offset for offset in self.split.declaration_ends if head <= offset < last), None)
        if marked is not None:
            declaration = "".join(self.text[a : min(b, marked)] for a, b in pieces if a < marked)
            implementation = "".join(self.text[max(a, marked) : b] for a, b in pieces if b > marked)
        else:
            content = "".join(self.text[a:b] for a, b in pieces)
            cut = declaration_end(content)
            declaration, implementation = content[:cut], content[cut:]
        assert first <= head, "a declaration begins before its keyword"
        return {"declaration": trimmed(declaration), **body("ST", trimmed(implementation))}

    def _child_start(self, i: int) -> int:
        """Where what belongs to a child begins: behind the line of the token before it."""
        if i == 0:
            return 0
        before = self.scan[i - 1]
        while before.text in MODIFIERS and i > 1:
            i -= 1
            before = self.scan[i - 1]
        start = self.scan[i].start
        if before.end <= self.end:
            return self.end
        line_end = self.text.find("\n", before.end, start)
        return start if line_end < 0 else line_end + 1

    def _child(self, word: Word) -> Draft:
        """A method, action, transition or property; stands at its keyword."""
        keyword, start = word.text, self.end
        line = self.split.line(word.start)
        self.i += 1
        while self._is_modifier(self.i):
            self.i += 1
        name = self._name_at(self.i)
        name_end = self.scan[self.i].end if self.i < len(self.scan) else len(self.text)
        first = self.i + 1
        stop = self._skip_to((_CHILD_ENDS[keyword],), word)
        kind = keyword.lower()
        draft = Draft(kind, name, source=self.split.source, line=line)
        if keyword == "METHOD":
            draft.data = self._parts([(start, stop)], word.start)
        elif keyword == "PROPERTY":
            self._accessors(draft, start, first, stop)
        else:
            if first < len(self.scan) and self.scan[first].text == ":":
                name_end = self.scan[first].end
            above = trimmed(self.text[start : word.start])
            text = trimmed(self.text[name_end:stop].lstrip(" \t"))
            draft.data = body("ST", f"{above}\n{text}" if above else text)
        return draft

    def _accessors(self, draft: Draft, start: int, first: int, stop: int) -> None:
        i, declaration_stop = first, stop
        while i < len(self.scan) and self.scan[i].start < stop:
            word = self.scan[i]
            if word.text in ("GET", "SET") and self._begins_line(i):
                declaration_stop = min(declaration_stop, word.start)
                end = f"END_{word.text}"
                j = i + 1
                while j < len(self.scan) and self.scan[j].start < stop and self.scan[j].text != end:
                    j += 1
                text_end = self.scan[j].start if j < len(self.scan) else stop
                content = self.text[word.end : min(text_end, stop)]
                cut = declaration_end(content) if re.match(r"\s*VAR", content, re.IGNORECASE) else 0
                data = {"declaration": trimmed(content[:cut]), **body("ST", trimmed(content[cut:]))}
                name = word.text.capitalize()
                draft.children.append(
                    Draft("accessor", name, data, self.split.source, self.split.line(word.start))
                )
                i = j
            i += 1
        draft.data = {"declaration": trimmed(self.text[start:declaration_stop])}

    def _stray_child(self, word: Word) -> None:
        """A child behind the end of its POU, as CoDeSys exports actions."""
        self.end = max(self.end, self._child_start(self.i)) if not self.split.heads else self.end
        child = self._child(word)
        owner = self.owner or next((o for _, o in reversed(self.split.heads) if o.kind == "pou"), None)
        if owner is not None:
            owner.children.append(child)
        else:
            self._note(
                "refused", f"there is no POU before it that the {child.kind} belongs to", word, child.name
            )

    # -- types, interfaces, lists

    def _types(self, word: Word) -> None:
        """TYPE ... END_TYPE; each type of a block becomes an object."""
        start, head = self.end, word.start
        self.i += 1
        first = self.i
        stop = self._skip_to(("END_TYPE",), word)
        inside = [item for item in self.scan[first : self.i] if item.start < stop]
        parts = list(type_parts(self.text, inside))
        if not parts:
            self._note("refused", "TYPE without a type", word)
            return
        for number, (name, _, part_end) in enumerate(parts):
            part_start = start if number == 0 else parts[number - 1][2]
            if number == len(parts) - 1:
                part_end = stop
            content = self.text[part_start:part_end]
            lead = "" if number == 0 else "TYPE "
            text = f"{lead}{trimmed(content)}\nEND_TYPE"
            at = head if number == 0 else part_start
            draft = Draft("dut", name, {"declaration": text}, self.split.source, self.split.line(at))
            self.split.heads.append((at, draft))

    def _interface(self, word: Word) -> None:
        start, head = self.end, word.start
        name = self._name_at(self.i + 1)
        draft = Draft("interface", name, source=self.split.source, line=self.split.line(head))
        self.i += 1
        declaration_stop = None
        while self.i < len(self.scan):
            item = self.scan[self.i]
            if item.text == "END_INTERFACE":
                declaration_stop = item.start if declaration_stop is None else declaration_stop
                self._leave(self.i)
                break
            if self._is_head(self.i) and item.text in ("METHOD", "PROPERTY"):
                begins = self._child_start(self.i)
                declaration_stop = begins if declaration_stop is None else declaration_stop
                self.end = begins
                draft.children.append(self._child(item))
                continue
            self.i += 1
        else:
            self.end = len(self.text)
        text = self.text[start : self.end if declaration_stop is None else declaration_stop]
        draft.data = {"declaration": trimmed(text)}
        self.split.heads.append((head, draft))

    def _globals(self, word: Word) -> None:
        """VAR_GLOBAL ... END_VAR with the blocks that follow it at once."""
        start, head = self.end, word.start
        while True:
            self._skip_to(("END_VAR",), word)
            if self.i >= len(self.scan) or self.scan[self.i].text not in _GLOBALS:
                break
            if any(self.end <= at < self.scan[self.i].start for at, _ in self.split.list_names):
                break
        named = [name for at, name in self.split.list_names if start <= at <= head]
        name = named[-1] if named else self.list_name
        draft = Draft("gvl", name, {"declaration": trimmed(self.text[start : self.end])})
        draft.source, draft.line = self.split.source, self.split.line(head)
        self.split.heads.append((head, draft))

    # -- reading on

    def _skip_to(self, ends: tuple[str, ...], opened: Word | None = None) -> int:
        """Go behind the next of these keywords; the offset where it begins."""
        while self.i < len(self.scan):
            word = self.scan[self.i]
            if word.text in ends:
                self._leave(self.i)
                return word.start
            self.i += 1
        self.end = len(self.text)
        if opened is not None and not self.open_ended:
            self._note("changed", f"{ends[0]} is missing; the object ends with the file", opened)
        return self.end

    def _leave(self, i: int) -> None:
        """Go behind a closing keyword and the semicolon that may follow."""
        self.end = self.scan[i].end
        self.i = i + 1
        if self.i < len(self.scan) and self.scan[self.i].text == ";":
            self.end = self.scan[self.i].end
            self.i += 1

    def _name_at(self, i: int) -> str:
        while self._is_modifier(i):
            i += 1
        if i >= len(self.scan):
            return ""
        return self.text[self.scan[i].start : self.scan[i].end]

    def _is_modifier(self, i: int) -> bool:
        """Whether a modifier stands there: such a word without a name behind it is the name itself."""
        if i + 1 >= len(self.scan) or self.scan[i].text not in MODIFIERS:
            return False
        behind = self.scan[i + 1].text
        return NAME.fullmatch(behind) is not None and not _ends_name(behind)

    def _refuse(self, word: Word, stop: int) -> None:
        shown = " ".join(self.text[word.start : stop].split())
        shown = shown if len(shown) <= 60 else shown[:57] + "..."
        self._note("refused", f"no object that is known begins with '{shown}'", word)
        self.end = max(self.end, self._begin_of_comments(stop))

    def _begin_of_comments(self, stop: int) -> int:
        """Where the comments before an offset begin: behind the line of the token before it."""
        before = self.scan[self.i - 1].end if self.i else 0
        line_end = self.text.find("\n", before, stop)
        return stop if line_end < 0 else line_end + 1

    def _trailing(self) -> None:
        """Comments behind the last object stay with it."""
        rest = trimmed(self.text[self.end :])
        if not rest or not self.split.heads:
            return
        data = self.split.heads[-1][1].data
        key = "implementation" if "implementation" in data else "declaration"
        data[key] = f"{data[key]}\n{rest}" if data[key] else rest

    def _note(self, outcome: Outcome, text: str, word: Word, name: str = "") -> None:
        self.split.report.add(outcome, self.split.source, text, name=name, line=self.split.line(word.start))

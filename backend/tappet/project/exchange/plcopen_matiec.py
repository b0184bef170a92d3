"""Bodies for the compiler of Beremiz and OpenPLC: C code in pragmas, times in seconds, long CONCAT."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, field

from tappet.iec.tokens import COMMENT, PRAGMA, SIGN, WORD, Piece, pieces
from tappet.iec.trivia import unnested
from tappet.project.exchange.drafts import Draft
from tappet.project.exchange.plcopen_declarations import CODESYS
from tappet.project.exchange.xml_tree import XHTML, Element
from tappet.project.kinds.library_manager import LibraryReferenceData

_CONVERSION = re.compile(r"TIME_TO_(?P<to>[LSDU]*INT|L?REAL)|(?P<from>[LSDU]*INT|L?REAL)_TO_TIME", re.I)
_C_CODE = re.compile(r"\{\{.*?\}\}|\{[^}]*\}", re.DOTALL)
"""A pragma of matiec, which may go over lines."""

COUNTERS = LibraryReferenceData(name="IEC_Counters")
"""The library with the counters that matiec knows without one."""
_COUNTER = re.compile(r"\bCT(?:U|D|UD)_U?[DL]INT\b", re.IGNORECASE)


def uses_counters(draft: Draft) -> bool:
    """Whether a text of the draft, or of what is below it, names a counter for DINT, LINT, UDINT or ULINT."""
    texts = (draft.data.get("declaration"), draft.data.get("implementation"))
    if any(isinstance(text, str) and _COUNTER.search(text) for text in texts):
        return True
    return any(uses_counters(child) for child in draft.children)


def is_for_matiec(root: Element) -> bool:
    """Whether a file is of Beremiz or of one of its kind: paragraphs hold its texts, and nothing is of 3S."""
    if root.namespace.endswith("tc6.xsd"):
        return True
    paragraphs = False
    for item in root.walk():
        if any(data.get("name").startswith(CODESYS) for data in item.children("data")):
            return False
        paragraphs = paragraphs or (item.tag == "p" and item.namespace == XHTML)
    return paragraphs


def rewritten(text: str) -> tuple[str, list[str]]:
    """A body in ST as it means the same here, and what was changed in it.

    C code between braces becomes a comment: what it does is not in the program any more. A conversion
    between times and numbers counts seconds there and milliseconds here; comments do not nest there.
    """
    bottom = _Part("")
    parts = [bottom]
    position = pragmas = 0
    names: dict[str, None] = {}
    found = list(_pieces(text))
    for i, (kind, piece, start, end) in enumerate(found):
        part = parts[-1]
        part.pieces.append(text[position:start])
        position = end
        called = i + 1 < len(found) and found[i + 1].text == "("
        if kind is PRAGMA:
            inner = piece.replace("(*", "( *").replace("*)", "* )")
            part.pieces.append(f"(* {inner} *)")
            pragmas += 1
        elif kind is WORD and called and (piece.upper() == "CONCAT" or _CONVERSION.fullmatch(piece)):
            parts.append(_Part(piece))
        elif piece == "(":
            part.open += 1
            part.pieces.append("(")
        elif piece == ")" and part.function and part.open == 1:
            parts.pop()
            now = _concatenated(part) if part.function.upper() == "CONCAT" else _seconds(part)
            parts[-1].pieces.append(now or "".join([part.function, *part.pieces, ")"]))
            if now:
                names[part.function.upper()] = None
        else:
            if piece == "," and part.open == 1:
                part.commas.append(len(part.pieces))
            part.open -= piece == ")"
            part.pieces.append(unnested(piece) if kind is COMMENT else piece)
    parts[-1].pieces.append(text[position:])
    for part in parts[1:]:  # parentheses that nothing closes
        bottom.pieces += [part.function, *part.pieces]
    notes = ["CONCAT of more than two texts was nested"] if names.pop("CONCAT", "") is None else []
    if pragmas:
        count = f"{pragmas} pieces of C code" if pragmas > 1 else "a piece of C code"
        notes.append(f"{count} between braces became comments: what C does has to be written again in ST")
    if names:
        notes.append(f"{', '.join(names)} count seconds there and milliseconds here; they were rewritten")
    return "".join(bottom.pieces), notes


def _pieces(text: str) -> Iterator[Piece]:
    """The pieces of a text of matiec, in which comments do not nest and pragmas are C code."""
    position: int | None = 0
    while position is not None:
        start, position = position, None
        for piece in pieces(text, start, nested=False):
            if piece.kind is not PRAGMA:
                yield piece
                continue
            code = _C_CODE.match(text, piece.start)
            end = piece.start + 1 if code is None else code.end()
            yield Piece(SIGN if code is None else PRAGMA, text[piece.start : end], piece.start, end)
            if end != piece.end:
                position = end
                break


@dataclass(slots=True)
class _Part:
    """What is being put together: the whole text, or the arguments of a function from its parenthesis on."""

    function: str
    pieces: list[str] = field(default_factory=list)
    open: int = 0
    commas: list[int] = field(default_factory=list)
    """Pieces that part the arguments."""


def _concatenated(part: _Part) -> str | None:
    """CONCAT of more than two arguments in pairs; None when it has two, or names them."""
    ends = [*part.commas, len(part.pieces)]
    starts = [0, *(comma + 1 for comma in part.commas)]
    texts = ["".join(part.pieces[start:end]).strip() for start, end in zip(starts, ends, strict=True)]
    texts[0] = texts[0].removeprefix("(").strip()
    if len(texts) < 3 or any(":=" in text or "=>" in text for text in texts):
        return None
    nested = texts[0]
    for text in texts[1:]:
        nested = f"CONCAT({nested}, {text})"
    return nested


def _seconds(part: _Part) -> str:
    conversion = _CONVERSION.fullmatch(part.function)
    assert conversion is not None
    argument = "".join(part.pieces).strip().removeprefix("(").strip()
    to, from_ = (conversion["to"] or "").upper(), (conversion["from"] or "").upper()
    if to in ("REAL", "LREAL"):
        return f"(TIME_TO_{to}({argument}) / 1000.0)"
    if to:
        whole = f"TIME_TO_LINT({argument}) / 1000"
        return f"({whole})" if to == "LINT" else f"LINT_TO_{to}({whole})"
    if from_ in ("REAL", "LREAL"):
        return f"{from_}_TO_TIME(1000.0 * ({argument}))"
    return f"LINT_TO_TIME(1000 * TO_LINT({argument}))"

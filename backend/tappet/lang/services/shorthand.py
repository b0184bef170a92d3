"""Short forms of declarations: Ctrl+Enter in a declaration editor (DECL-61..DECL-66, LDEC-142, LDEC-143).

`A B I 2; counts` becomes `A, B: INT := 2; (* counts *)`.
"""

from __future__ import annotations

import re
from typing import Final

from tappet.iec.words import KEYWORDS
from tappet.lang.lexer import ADDRESS, ID, INT, NUMBER, STRING, lex

_TYPES: Final = {
    "B": "BOOL", "BOOL": "BOOL", "I": "INT", "INT": "INT", "R": "REAL", "REAL": "REAL", "S": "STRING",
    "STRING": "STRING",
}  # fmt: skip
"""What the last identifier may be (DECL-62)."""
_CONSTANTS: Final = frozenset([INT, NUMBER, STRING, "TRUE", "FALSE"])
_WHOLE: Final = re.compile(r"[+-]?\d+")


def expand(line: str) -> str | None:
    """The declaration that a typed line denotes; None when it is no short form: it names nothing, is a
    declaration already, or stands inside one."""
    code, mark, comment = line.partition(";")
    lexed = lex(code, "")
    names: list[str] = []
    constant = address = None
    sign = ""
    for kind, text in zip(lexed.kinds, lexed.texts, strict=True):
        if kind is ID:
            names.append(text)
        elif kind is ADDRESS:
            address = text
        elif kind in _CONSTANTS:
            constant = sign + text
        elif kind in (":", ":=") or (kind in KEYWORDS and kind not in ("TRUE", "FALSE")):
            return None
        sign = kind if kind in ("-", "+") else ""
    if not names:
        return None
    type_ = _TYPES.get(names[-1].upper()) if len(names) > 1 else None
    if type_ is None:
        type_ = "BOOL"
    else:
        names.pop()
    found = ", ".join(names)
    if address is not None:
        found += f" AT {address}"
    found += f": {type_}"
    if constant is not None:
        if type_ == "STRING" and _WHOLE.fullmatch(constant):
            found += f"({constant})"
        else:
            found += f" := {_initial(type_, constant)}"
    text = comment.strip()
    indent = line[: len(line) - len(line.lstrip())]
    return f"{indent}{found};" + (f" (* {text} *)" if mark and text else "")


def _initial(type_: str, constant: str) -> str:
    """A constant as literal of a type."""
    if type_ == "REAL" and _WHOLE.fullmatch(constant):
        return f"{constant}.0"
    if type_ == "BOOL" and constant in ("0", "1"):
        return "TRUE" if constant == "1" else "FALSE"
    return constant

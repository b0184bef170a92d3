"""The words of `iec` as a TextMate grammar: it colours texts until a language server has read them.

`python -m tappet.iec.textmate FILE` writes it; a test fails when it is stale.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Iterable
from pathlib import Path
from typing import Any

from tappet.iec import words

FILE = "plugins/vscode/syntaxes/iec-st.tmLanguage.json"
_SCOPE = "source.iec-st"


def _words(names: Iterable[str], scope: str) -> dict[str, Any]:
    """A rule for words of either case; longer ones first, so that none is found inside of another."""
    spelled = sorted(
        {name for name in names if not name.startswith("__")}, key=lambda name: (-len(name), name)
    )
    return {"match": rf"(?i)(?<![\w.#])(?:{'|'.join(spelled)})(?!\w|#)", "name": f"{scope}.iec-st"}


def _string(quote: str, kind: str) -> dict[str, Any]:
    return {
        "begin": quote,
        "end": quote,
        "name": f"string.quoted.{kind}.iec-st",
        "patterns": [
            {"match": r"\$(?:[$'\"LlNnPpRrTt]|[0-9A-Fa-f]{2,4})", "name": "constant.character.escape.iec-st"}
        ],
    }


def grammar() -> dict[str, Any]:
    """The grammar as the JSON that editors read."""
    types = [*words.ELEMENTARY_TYPES, *words.TYPE_SYNONYMS, *words.STRING_TYPES]
    declared = words.KEYWORDS - set(words.STATEMENT_WORDS) - set(words.WORD_OPERATORS)
    declared -= {*words.CONSTANTS, *words.INSTANCES}
    flow = [*words.STATEMENT_WORDS, *words.STATEMENT_ENDS.values()]
    comment = {"name": "comment.block.iec-st", "patterns": [{"include": "#comments"}]}
    date = r"(?i)\b(?:L?TIME_OF_DAY|L?DATE_AND_TIME|L?TOD|L?DT|L?DATE|L?TIME|L?T|L?D)#[-+\w.:]+"
    return {
        "$schema": "https://raw.githubusercontent.com/martinring/tmlanguage/master/tmlanguage.json",
        "name": "IEC 61131-3 Structured Text",
        "scopeName": _SCOPE,
        "patterns": [
            {"include": f"#{name}"}
            for name in ("comments", "pragmas", "strings", "addresses", "literals", "words", "calls", "signs")
        ],
        "repository": {
            "comments": {
                "patterns": [
                    {"match": "//.*$", "name": "comment.line.double-slash.iec-st"},
                    {"begin": r"\(\*", "end": r"\*\)", **comment},
                    {"begin": r"/\*", "end": r"\*/", **comment},
                ]
            },
            "pragmas": {"begin": r"\{", "end": r"\}", "name": "meta.preprocessor.iec-st"},
            "strings": {"patterns": [_string("'", "single"), _string('"', "double")]},
            "addresses": {
                "match": r"(?i)%[IQM](?:[XBWDL]?\d+(?:\.\d+)*|\*)",
                "name": "variable.other.address.iec-st",
            },
            "literals": {
                "patterns": [
                    {"match": date, "name": "constant.other.time.iec-st"},
                    {
                        "match": r"(?i)\b(?:\w+#)?(?:2#[01_]+|8#[0-7_]+|16#[0-9a-f_]+)",
                        "name": "constant.numeric.iec-st",
                    },
                    {
                        "match": r"(?i)(?<![\w.])\d[\d_]*(?:\.\d[\d_]*)?(?:e[-+]?\d+)?",
                        "name": "constant.numeric.iec-st",
                    },
                ]
            },
            "words": {
                "patterns": [
                    _words([*words.CONSTANTS, words.NULL], "constant.language"),
                    _words(words.INSTANCES, "variable.language"),
                    _words(flow, "keyword.control"),
                    _words(words.WORD_OPERATORS, "keyword.operator.word"),
                    _words(types, "storage.type"),
                    _words([*declared, *words.MODIFIERS, *words.HEADER_WORDS], "keyword.declaration"),
                    _words(words.OPERATOR_FUNCTIONS, "support.function"),
                ]
            },
            "calls": {"match": r"(?<![\w])[A-Za-z_]\w*(?=\s*\()", "name": "entity.name.function.iec-st"},
            "signs": {
                "match": "|".join(
                    "".join(f"\\{sign}" for sign in operator)
                    for operator in sorted(words.OPERATORS, key=lambda sign: (-len(sign), sign))
                    if not operator.isalnum()
                ),
                "name": "keyword.operator.iec-st",
            },
        },
    }


if __name__ == "__main__":
    target = Path(sys.argv[1] if len(sys.argv) > 1 else FILE)
    target.write_text(json.dumps(grammar(), indent=2) + "\n", encoding="utf-8")

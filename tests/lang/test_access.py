"""INTERNAL: what only the texts of a library use (LDEC-127)."""

from __future__ import annotations

import pytest

from tappet.lang.analysis import analyse
from tappet.lang.parser import parse
from tappet.lang.source import Scope, Source

LIBRARY = """
FUNCTION INTERNAL Helper : INT
Helper := 1;
END_FUNCTION
TYPE INTERNAL ST_Own : STRUCT x : INT; END_STRUCT END_TYPE
FUNCTION_BLOCK INTERNAL FB_Own
END_FUNCTION_BLOCK
INTERFACE INTERNAL I_Own
END_INTERFACE
FUNCTION_BLOCK FB_Open EXTENDS FB_Own IMPLEMENTS I_Own
VAR INTERNAL count : INT; own : ST_Own; END_VAR
METHOD INTERNAL Step : INT
Step := Helper() + count + Lib.Helper();
END_METHOD
END_FUNCTION_BLOCK
FUNCTION Open : INT
VAR fb : FB_Open; END_VAR
fb.count := fb.Step();
Open := fb.count;
END_FUNCTION
"""


def messages(application: str, *more: Source) -> list[tuple[str, str]]:
    texts = [
        Source("lib", LIBRARY, scope=Scope.LIBRARY, library="Lib", namespace="Lib"),
        *more,
        Source("app", application),
    ]
    found = analyse([parse(text).unit for text in texts]).diagnostics
    return [(d.code, d.message) for d in found if d.severity == "error"]


def test_the_library_itself_uses_what_is_internal() -> None:
    assert messages("PROGRAM P VAR fb : FB_Open; r : INT; END_VAR r := Open(); fb(); END_PROGRAM") == []


@pytest.mark.parametrize(
    ("text", "what"),
    [
        ("PROGRAM P VAR r : INT; END_VAR r := Helper(); END_PROGRAM", "Function 'Helper' of 'Lib'"),
        ("PROGRAM P VAR r : INT; END_VAR r := Lib.Helper(); END_PROGRAM", "Function 'Helper' of 'Lib'"),
        ("PROGRAM P VAR s : ST_Own; END_VAR s.x := 1; END_PROGRAM", "Data type 'ST_Own' of 'Lib'"),
        ("PROGRAM P VAR s : Lib.FB_Own; END_VAR s(); END_PROGRAM", "Function block 'FB_Own' of 'Lib'"),
        ("FUNCTION_BLOCK F EXTENDS FB_Own END_FUNCTION_BLOCK", "Function block 'FB_Own' of 'Lib'"),
        ("FUNCTION_BLOCK F IMPLEMENTS Lib.I_Own END_FUNCTION_BLOCK", "Interface 'I_Own' of 'Lib'"),
        ("INTERFACE I EXTENDS I_Own END_INTERFACE", "Interface 'I_Own' of 'Lib'"),
        (
            "PROGRAM P VAR f : FB_Open; r : INT; END_VAR r := f.Step(); END_PROGRAM",
            "Method 'Step' of 'FB_Open'",
        ),
        ("PROGRAM P VAR f : FB_Open; END_VAR f.count := 1; END_PROGRAM", "Variable 'count' of 'FB_Open'"),
    ],
)
def test_an_application_does_not(text: str, what: str) -> None:
    assert messages(text) == [("E0213", f"{what} is INTERNAL and cannot be used here")]


def test_names_that_are_internal_hide_nothing() -> None:
    other = "FUNCTION Helper : INT\nHelper := 2;\nEND_FUNCTION"
    use = "PROGRAM P VAR r : INT; END_VAR r := Helper(); END_PROGRAM"
    assert (
        messages(use, Source("other", other, scope=Scope.LIBRARY, library="Other", namespace="Other")) == []
    )
    assert messages(use, Source("own", other)) == []

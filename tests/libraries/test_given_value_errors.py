"""A value that a library reference gives and that does not fit is the only error of a build."""

from pathlib import Path

import pytest
from test_parameters import MANAGER, TEXTS, build, messages, reference

from tappet.codegen.build import BuildSession
from tappet.lang.source import Source
from tappet.libraries import archive

BLOCK = Source(
    "FB_Line", "FUNCTION_BLOCK FB_Line\nVAR\n    n : INT;\nEND_VAR\nn := n + 1;\nEND_FUNCTION_BLOCK"
)
MAIN = "PROGRAM Main\nVAR\n    line : FB_Line;\n    belt : Belt;\nEND_VAR\nline();\nEND_PROGRAM"


@pytest.fixture(autouse=True)
def conveyors(library_folder: Path) -> None:
    archive.install(archive.manifest("Conveyors", "1.0.0.0"), TEXTS)


@pytest.mark.parametrize("before", [(), ("7",), ("7", "8"), ("'many'",)])
@pytest.mark.parametrize("text", ["'many'", "UnknownName"])
def test_the_error_of_a_given_value_stays_alone(before: tuple[str, ...], text: str) -> None:
    session = BuildSession()
    for value in before:
        build(reference(cSlots=value), text=MAIN, more=(BLOCK,), session=session)
    result = build(reference(cSlots=text), text=MAIN, more=(BLOCK,), session=session)
    errors = [item for item in messages(result) if item[0].startswith("E")]
    assert errors == [("E0904", MANAGER)]
